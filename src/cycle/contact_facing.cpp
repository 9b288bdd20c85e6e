#include "cycle/contact_facing.hpp"

#include <algorithm>
#include <cmath>

namespace abut::cycle {

namespace {

constexpr double moved_share = 0.25;  // of a facet: what turns a facet by a right angle moves a node of it by more

std::vector<Index> nodes_of(const contact::InspectionInput& input) {
  std::vector<Index> nodes;
  for (const contact::InspectedSide& side : input.side) {
    for (const contact::Facet& f : side.facets) nodes.insert(nodes.end(), f.node.begin(), f.node.end());
    nodes.insert(nodes.end(), side.nodes.begin(), side.nodes.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  nodes.shrink_to_fit();
  return nodes;
}

/// By more than `limit` since `seen`.
bool has_moved(std::span<const Index> nodes, std::span<const std::array<float, 3>> seen, std::span<const Vec3> start,
               std::span<const Vec3> x, double limit) {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto n = static_cast<std::size_t>(nodes[k]);
    const Vec3 then = seen.empty() ? Vec3{} : Vec3{seen[k][0], seen[k][1], seen[k][2]};
    if (squared_norm((x[n] - start[n]) - then) > limit * limit) return true;
  }
  return false;
}

/// How far nodes are from where the model has them; empty when all are there.
std::vector<std::array<float, 3>> moved(std::span<const Index> nodes, std::span<const Vec3> start, std::span<const Vec3> x) {
  std::vector<std::array<float, 3>> out;
  const auto by = [&](Index n) { return x[static_cast<std::size_t>(n)] - start[static_cast<std::size_t>(n)]; };
  if (std::all_of(nodes.begin(), nodes.end(), [&](Index n) { return squared_norm(by(n)) == 0.0; })) return out;
  out.reserve(nodes.size());
  for (const Index n : nodes) out.push_back({static_cast<float>(by(n).x), static_cast<float>(by(n).y), static_cast<float>(by(n).z)});
  return out;
}

void take(const std::array<double, 2>& fraction, InterfaceResult& result) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (!std::isnan(fraction[k])) result.facing[k] = fraction[k];
  }
}

}  // namespace

ContactFacing::ContactFacing(const model::Model& model, const init::FacingShares& at_start)
    : time_between_(model.controls.t_end / looks), model_(&model), interfaces_(model.interfaces.size()), at_start_(at_start) {
  const std::span<const Vec3> x(model.node_x);
  for (std::size_t i = 0; i < interfaces_.size(); ++i) {
    const model::Interface& card = model.interfaces[i];
    if (std::holds_alternative<model::InterfaceType7>(card.type)) continue;
    Watched& w = interfaces_[i];
    const init::InspectedInterface geometry(model, card, x);
    w.nodes = nodes_of(geometry.input(x));
    w.limit = moved_share * geometry.facet_size(x);
  }
}

void ContactFacing::look(const state::State& state, std::span<InterfaceResult> results) {
  const std::span<const Vec3> x(state.x);
  for (std::size_t i = 0; i < interfaces_.size(); ++i) {
    Watched& w = interfaces_[i];
    if (w.limit == 0.0) continue;
    const bool opens = state.times.reached(model_->interfaces[i].t_start);
    if (w.looked && !opens && (state.times.cycle < w.cycle + cycles_between || state.times.t < w.time + time_between_)) continue;
    const bool decided = !std::isnan(results[i].facing[0]) || !std::isnan(results[i].facing[1]);
    w.cycle = state.times.cycle;
    w.time = state.times.t;
    if (w.looked && decided && !has_moved(w.nodes, w.seen, model_->node_x, x, w.limit)) continue;
    w.seen = moved(w.nodes, model_->node_x, x);
    const bool known = !w.looked && !at_start_.empty() && w.seen.empty() && results[i].in_contact == 0;
    w.looked = true;
    if (known) {
      take(at_start_[i], results[i]);
      continue;
    }
    const init::InspectedInterface geometry(*model_, model_->interfaces[i], model_->node_x);
    contact::InspectionInput input = geometry.input(x);
    std::array<std::vector<std::int8_t>, 2> outward;
    if (results[i].in_contact > 0) {
      // Surfaces that feel each other are taken as surfaces of bodies: a penetration is an overlap, not a turned normal.
      for (std::size_t k = 0; k < 2; ++k) {
        outward[k].assign(input.side[k].outward.begin(), input.side[k].outward.end());
        std::replace(outward[k].begin(), outward[k].end(), std::int8_t{0}, std::int8_t{1});
        input.side[k].outward = outward[k];
      }
    }
    const std::array<contact::Facing, 2> facing = w.watch.look(input);
    take({facing[0].fraction(), facing[1].fraction()}, results[i]);
  }
}

void ContactFacing::persist(state::Archive& a) {
  a.each(interfaces_, [&a](Watched& w) {
    a(w.looked);
    a.growing(w.seen);
    a(w.cycle);
    a(w.time);
    if (!w.seen.empty() && w.seen.size() != w.nodes.size()) throw state::ArchiveError("the checkpoint does not fit the model (facing)");
  });
}

}  // namespace abut::cycle
