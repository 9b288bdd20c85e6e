#include "output/contact_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace abut::output {

namespace {

constexpr std::int64_t cycles_between_looks = 50;
constexpr int looks = 100;             // per run
constexpr double deep_share = 0.95;    // of the gap
constexpr double energy_share = 0.02;  // of the largest energy term

std::string counted(std::size_t nodes) { return nodes == 1 ? "1 node" : fmt::format("{} nodes", nodes); }

std::vector<Id> ids_of(const cycle::Snapshot& now, std::span<const Index> nodes) {
  std::vector<Id> ids;
  for (const Index n : nodes) ids.push_back(now.model->node_id[static_cast<std::size_t>(n)]);
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<std::array<Id, 4>> segments_away(const cycle::Snapshot& now, const contact::InspectedSide& side,
                                             const contact::Facing& facing) {
  std::vector<std::array<Id, 4>> out;
  for (std::size_t f = 0; f < side.facets.size(); ++f) {
    if (facing.facet[f] >= 0) continue;
    std::array<Id, 4> ids{};
    for (std::size_t k = 0; k < 4; ++k) ids[k] = now.model->node_id[static_cast<std::size_t>(side.facets[f].node[k])];
    out.push_back(ids);
  }
  return out;
}

}  // namespace

/// ": nodes 1, 2" or ": segments (1 2 3 4)", twenty at most.
std::string ContactWatch::first_ids(const Where& where) {
  constexpr std::size_t listed = 20;
  std::string text;
  const auto add = [&](std::size_t count, const char* name, const auto& one) {
    for (std::size_t i = 0; i < std::min(count, listed); ++i) text += (i == 0 ? fmt::format(": {} ", name) : ", ") + one(i);
    if (count > listed) text += fmt::format(" (and {} more)", count - listed);
  };
  add(where.nodes.size(), where.nodes.size() == 1 ? "node" : "nodes", [&](std::size_t i) { return fmt::format("{}", where.nodes[i]); });
  add(where.segments.size(), "segments", [&](std::size_t i) {
    const auto& s = where.segments[i];
    return fmt::format("({} {} {} {})", s[0], s[1], s[2], s[3]);
  });
  return text;
}

void ContactWatch::begin(const cycle::Snapshot& first) {
  const bool told = !interfaces_.empty();  // by a checkpoint, of the start of the run
  interfaces_.resize(first.model->interfaces.size());
  if (told) return;
  const std::span<const Vec3> x(first.model->node_x);
  for (std::size_t i = 0; i < interfaces_.size(); ++i) {
    const model::Interface& card = first.model->interfaces[i];
    Watched& w = interfaces_[i];
    if (std::holds_alternative<model::InterfaceType7>(card.type)) continue;
    w.facing_at_start = first.interfaces[i].facing;
    w.size = init::InspectedInterface(*first.model, card, x).facet_size(x);
  }
}

void ContactWatch::persist(state::Archive& a) {
  a.each_growing(interfaces_, [&a](Watched& w) {
    a(w.facing_at_start);
    a(w.size);
    for (bool* said : {&w.turned, &w.deep, &w.made}) a(*said);
  });
  a(next_look_);
  a(next_look_cycle_);
  a.each_growing(*log_, [&a](RunFinding& f) {
    Place& p = f.diagnostic.place;
    for (std::string* text : {&f.diagnostic.code, &f.diagnostic.message, &p.file, &p.keyword, &p.field}) a(*text);
    for (int* n : {&p.line, &p.first_column, &p.last_column}) a(*n);
    a(f.interface_id);
    a(f.time);
    a(f.cycle);
    a(f.measure);
    a.growing(f.nodes);
    a.growing(f.segments);
    f.diagnostic.severity = Severity::warning;
  });
}

void ContactWatch::cycle(const cycle::Snapshot& now) {
  for (std::size_t i = 0; i < interfaces_.size(); ++i) {
    Watched& w = interfaces_[i];
    const cycle::InterfaceResult& r = now.interfaces[i];
    const model::Interface& card = now.model->interfaces[i];
    collect(now, i, "contact.crossed", r.crossed, [](std::size_t nodes) {
      return fmt::format(
          "{} would have jumped through the surface within one step and {} caught; lower the time step or make the gap larger",
          counted(nodes), nodes == 1 ? "was" : "were");
    });
    collect(now, i, "contact.lost_over_border", r.lost, [](std::size_t nodes) {
      return fmt::format(
          "{} slid over a free border of the other surface while pressed on it and {} held no more; let the surface go on "
          "to where they can get",
          counted(nodes), nodes == 1 ? "is" : "are");
    });
    const double limit = card.gap > 0.0 ? deep_share * card.gap : 0.5 * w.size;
    if (!w.deep && w.size > 0.0 && r.largest_penetration > limit) {
      w.deep = true;
      say(now, i, "contact.deep_penetration", r.largest_penetration / limit,
          fmt::format("a node has penetrated by {:.4g} ({}); raise Stfac, the gap, or refine the mesh", r.largest_penetration,
                      card.gap > 0.0 ? fmt::format("{:.3g} of the gap", r.largest_penetration / card.gap)
                                     : fmt::format("{:.3g} of a segment", r.largest_penetration / w.size)),
          {ids_of(now, std::span(&r.deepest_node, 1)), {}});
    }
    const double largest = now.balance->largest;
    if (!w.made && largest > 0.0 && std::abs(r.cx) > energy_share * largest) {
      w.made = true;
      say(now, i, "contact.energy_made", r.cx / largest,
          fmt::format(
              "the interface has {} {:.3g} % of the largest energy; a smaller time step (/DT scale) shows whether the result depends on it",
              r.cx > 0.0 ? "made" : "lost", 100.0 * std::abs(r.cx) / largest));
    }
  }
  const state::StepTimes& times = now.state->times;
  if (times.cycle == 0) weigh_first_step(now);
  const auto& cards = now.model->interfaces;
  const bool opens = std::any_of(cards.begin(), cards.end(), [&](const model::Interface& card) { return times.reached(card.t_start); });
  const bool due = times.t >= next_look_ && times.cycle >= next_look_cycle_;
  if (due) {
    next_look_ = std::max(times.t, next_look_ + now.model->controls.t_end / looks);
    next_look_cycle_ = times.cycle + cycles_between_looks;
  }
  if (due || opens) look(now);
}

void ContactWatch::weigh_first_step(const cycle::Snapshot& now) {
  double stored = 0.0, lost = 0.0;
  for (const cycle::InterfaceResult& r : now.interfaces) stored += r.ce;
  if (!(stored > 0.0)) return;
  const state::State& s = *now.state;
  std::vector<Index> pushed;
  for (std::size_t i = 0; i < s.mass.size(); ++i) {
    if (!(squared_norm(s.f_contact[i]) > 0.0)) continue;
    lost += 0.5 * s.mass[i] * squared_norm(s.times.h_bar * s.a[i]);
    pushed.push_back(static_cast<Index>(i));
  }
  if (!(lost > energy_share * now.balance->largest)) return;
  const auto most =
      std::max_element(now.interfaces.begin(), now.interfaces.end(), [](const auto& a, const auto& b) { return a.ce < b.ce; });
  say(now, static_cast<std::size_t>(most - now.interfaces.begin()), "contact.first_step", lost / stored,
      fmt::format("contact holds {:.4g} before anything has moved; the first step takes {:.3g} % of it, which no term of the balance shows "
                  "(the kinetic energy of cycle 0 is lower by it): begin without penetrations, or with half the step (/DT scale, a fourth "
                  "of the loss)",
                  stored, 100.0 * lost / stored),
      {ids_of(now, pushed), {}});
}

void ContactWatch::look(const cycle::Snapshot& now) {
  const double t = now.state->times.t;
  const std::span<const Vec3> x(now.state->x);
  for (std::size_t i = 0; i < interfaces_.size(); ++i) {
    Watched& w = interfaces_[i];
    const std::array<double, 2>& faces = now.interfaces[i].facing;
    if (w.turned || (!(faces[0] < 0.5) && !(faces[1] < 0.5))) continue;
    const model::Interface& card = now.model->interfaces[i];
    // While nodes are in contact the surfaces feel each other, whatever small overlaps make of the facing rule.
    if (t < card.t_start || t > card.t_stop || now.interfaces[i].in_contact > 0) continue;
    const init::InspectedInterface geometry(*now.model, card, now.model->node_x);
    const contact::InspectionInput input = geometry.input(x);
    const auto facing = contact::facing(input);
    for (std::size_t k = 0; k < 2; ++k) {
      if (facing[k].distance > card.gap + w.size || !(w.facing_at_start[k] >= 0.5) || !(facing[k].fraction() < 0.5)) continue;
      w.turned = true;
      say(now, i, "contact.turned_away", facing[k].fraction(),
          fmt::format("the normals of surface {} have turned away: only {:.3g} % of it near the other side faces it (at the start {:.3g} "
                      "%), at a distance "
                      "of {:.4g}; contact is not felt there any more: choose the surfaces for the deformed shape too",
                      now.model->surfaces[static_cast<std::size_t>(geometry.surface(static_cast<int>(k)))].id, 100.0 * facing[k].fraction(),
                      100.0 * w.facing_at_start[k], facing[k].distance),
          {{}, segments_away(now, input.side[k], facing[k])});
    }
  }
}

void ContactWatch::collect(const cycle::Snapshot& now, std::size_t interface, std::string code, std::span<const Index> nodes,
                           const std::function<std::string(std::size_t)>& text) {
  if (nodes.empty()) return;
  std::vector<Id> ids = ids_of(now, nodes);
  const Id id = now.model->interfaces[interface].id;
  const auto known =
      std::find_if(log_->begin(), log_->end(), [&](const RunFinding& f) { return f.interface_id == id && f.diagnostic.code == code; });
  if (known == log_->end()) {
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    const std::size_t count = ids.size();
    say(now, interface, std::move(code), static_cast<double>(count), text(count), {std::move(ids), {}});
    return;
  }
  std::vector<Id> all;
  std::sort(ids.begin(), ids.end());
  std::set_union(known->nodes.begin(), known->nodes.end(), ids.begin(), ids.end(), std::back_inserter(all));
  all.erase(std::unique(all.begin(), all.end()), all.end());
  if (all.size() == known->nodes.size()) return;
  known->nodes = std::move(all);
  known->measure = static_cast<double>(known->nodes.size());
  known->diagnostic.message = fmt::format("from time {:.6g} (cycle {}) on: {}{}. [{}]", known->time, known->cycle,
                                          text(known->nodes.size()), first_ids({known->nodes, {}}), code);
}

void ContactWatch::say(const cycle::Snapshot& now, std::size_t interface, std::string code, double measure, std::string text, Where where) {
  const model::Interface& card = now.model->interfaces[interface];
  const double t = now.state->times.t;
  Diagnostic d{Severity::warning, code, card.place,
               fmt::format("at time {:.6g} (cycle {}): {}{}. [{}]", t, now.state->times.cycle, text, first_ids(where), code)};
  log_->push_back({std::move(d), card.id, t, now.state->times.cycle, measure, std::move(where.nodes), std::move(where.segments)});
}

}  // namespace abut::output
