#include "contact/enforce/one_sided.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "contact/enforce/check_options.hpp"
#include "contact/project/plain.hpp"

namespace abut::contact {
namespace {

// Sums over nodes run over pieces of so many nodes, then over the pieces: their order does not depend on threads.
constexpr std::size_t piece = 512;
static_assert(piece % SideLoads::block == 0);
std::size_t pieces(std::size_t nodes) { return (nodes + piece - 1) / piece; }

bool canonical(const Options& o) { return o.rules.edges == Edges::closest; }

std::size_t largest_node(const Side& side) {
  Index largest = no_index;
  for (const Index n : side.nodes()) largest = std::max(largest, n);
  return static_cast<std::size_t>(largest + 1);
}

}  // namespace

OneSided::OneSided(Surface first, Surface second, const Options& options) : options_(options), two_passes_(true) {
  check(options);
  std::string shared;
  int count = 0;
  for (const Index n : first.nodes()) {
    if (second.find(n) == no_index) continue;
    if (++count <= 20) shared += (count > 1 ? ", " : "") + std::to_string(n);
  }
  if (count > 0) {
    throw std::invalid_argument("contact: " + std::to_string(count) + " nodes lie on both surfaces: " + shared +
                                (count > 20 ? ", ..." : ""));
  }
  side_ = {Side(std::move(first), canonical(options)), Side(std::move(second), canonical(options))};
  prepare();
}

OneSided::OneSided(std::vector<Index> nodes, std::vector<double> node_stiffness, Surface surface, const Options& options)
    : options_(options), two_passes_(false) {
  check(options);
  if (!node_stiffness.empty() && node_stiffness.size() != nodes.size()) {
    throw std::invalid_argument("contact: " + std::to_string(node_stiffness.size()) + " stiffnesses for " + std::to_string(nodes.size()) +
                                " nodes");
  }
  check_finite(node_stiffness, "node_stiffness");
  check_held_nodes(nodes);
  if (node_stiffness.empty()) {
    options_.rules.one_pass_half_stiffness = true;
    node_stiffness.assign(nodes.size(), 0.0);
  }
  side_ = {Side(std::move(nodes), std::move(node_stiffness)), Side(std::move(surface), canonical(options))};
  prepare();
}

void OneSided::prepare() {
  for (std::size_t k = 0; k < 2; ++k) {
    loads_[k].resize(at(side_[k].node_count()));
    side_[k].set({}, options_.rules.triangle_third_node_twice);
    host_nodes_ = std::max(host_nodes_, largest_node(side_[k]));
  }
  make_passes();
}

void OneSided::make_passes() {
  pass_.clear();
  for (std::size_t k = 0; k < (two_passes_ ? 2U : 1U); ++k) {
    pass_.emplace_back(options_, !two_passes_, at(side_[k].node_count()));
    pass_[k].set_executor(executor_);
  }
}

void OneSided::set_surface(int side, const SurfaceState& state) {
  if (side < 0 || side > 1) throw std::invalid_argument("contact: side " + std::to_string(side) + " is neither 0 nor 1");
  side_[static_cast<std::size_t>(side)].set(state, options_.rules.triangle_third_node_twice);
  for (Pass& pass : pass_) pass.invalidate();
}

// numerics.md 7.2.5: nodes in their order, each on the geometry that its predecessors left; the whole loop twice.
void OneSided::project(Side& held, Side& surface, bool move_surface, std::vector<Vec3>& moved) const {
  constexpr double hair = 1.0 + 1e-8;
  IncrementalSearch search;
  std::vector<Tracked> tracked(at(held.node_count()));
  for (int loop = 0; loop < 2; ++loop) {
    held.gather(moved);
    surface.gather(moved);
    bool surface_moved = false;
    search.start(held, surface, tracked);
    for (Index i = 0; i < held.node_count(); ++i) {
      const Index facet = tracked[at(i)].facet;
      if (facet == no_index) continue;
      const Index node = held.nodes()[at(i)];
      const std::array<Index, 4> corners = surface.surface().facet(facet).node;
      if (std::find(corners.begin(), corners.end(), node) != corners.end()) continue;
      if (surface_moved) surface.gather(moved);
      const PlainPoint p = project_plain(surface.patch(facet), moved[at(node)], options_.gap, true);
      double gap = options_.gap;
      if (options_.automatic_gap) gap = std::max(gap, 0.5 * (held.node_thickness(i) + surface.thickness_at(facet, p.weight)));
      constexpr double starter_tolerance = 0.02;
      if (std::abs(p.raw_s) > 1.0 + starter_tolerance || std::abs(p.raw_t) > 1.0 + starter_tolerance) continue;
      const double outside = p.distance - gap;
      if (outside >= 0.0) continue;
      const Vec3 by = (-outside * hair) * p.normal;
      surface_moved = move_surface || surface.surface().find(node) != no_index;
      if (!move_surface) {
        moved[at(node)] += by;
        continue;
      }
      const std::size_t count = surface.surface().is_triangle(facet) ? 3 : 4;
      for (std::size_t k = 0; k < count; ++k) moved[at(corners[k])] -= by;
    }
  }
}

std::vector<Projection> OneSided::projections(std::span<const Vec3> x, bool move_surface) const {
  std::vector<Vec3> moved(x.begin(), x.end());
  std::array<Side, 2> side = side_;
  project(side[0], side[1], move_surface, moved);
  if (two_passes_) project(side[1], side[0], move_surface, moved);
  std::vector<Projection> out;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 by = moved[i] - x[i];
    if (squared_norm(by) > 0.0) out.push_back({static_cast<Index>(i), by});
  }
  return out;
}

void OneSided::set_executor(Executor executor) {
  executor_ = executor;
  for (Pass& pass : pass_) pass.set_executor(executor);
}

template <class Body>
void OneSided::over_pieces(std::size_t k, const Body& body) const {
  const std::size_t nodes = at(side_[k].node_count());
  const auto range = [nodes, &body](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) body(p * piece, std::min(nodes, (p + 1) * piece));
  };
  if (executor_) {
    executor_(pieces(nodes), std::ref(range));
  } else {
    range(0, pieces(nodes));
  }
}

void OneSided::search(const HostState& host) {
  if (host_nodes_ > host.x.size()) throw std::invalid_argument("contact: the host has fewer nodes than the interface");
  const std::array<Motion, 2> motion = gather(host);
  if (!started_) {
    if (tried_) make_passes();  // the first step again, perhaps from elsewhere
    pass_[0].start(side_[0], side_[1]);
    if (two_passes_) pass_[1].start(side_[1], side_[0]);
  }
  tried_ = true;
  if (host.time < options_.birth || host.time > options_.death) return;
  // A search that no commit followed: lists and x_before then are of different positions.
  if (!stepped_) {
    for (Pass& pass : pass_) pass.invalidate();
  }
  stepped_ = false;
  pass_[0].search(side_[0], side_[1], motion[0]);
  if (two_passes_) pass_[1].search(side_[1], side_[0], motion[1]);
}

std::array<Motion, 2> OneSided::gather(const HostState& host) {
  // Each side is measured against what it and the other side would have done together at the mean velocity of the step before.
  const std::array<Vec3, 2> common{host.dt * mean_velocity_[0], host.dt * mean_velocity_[1]};
  std::array<TwoLargest, 2> largest;  // against common[0], common[1]
  for (std::size_t k = 0; k < 2; ++k) {
    if (committed_) side_[k].swap_positions(loads_[k].x_before);
    std::vector<MotionPart>& parts = parts_[k];
    parts.resize(pieces(at(side_[k].node_count())));
    MotionArgs args{&side_[k].x().data()->x, &loads_[k].x_before.data()->x,  &host.v.data()->x, side_[k].nodes().data(), host.dt, {},
                    static_cast<int>(1 - k), loads_[k].squared_motion.data()};
    for (int c = 0; c < 2; ++c) {
      for (int axis = 0; axis < 3; ++axis) args.common[c][axis] = common[static_cast<std::size_t>(c)][axis];
    }
    over_pieces(k, [&](std::size_t begin, std::size_t end) {
      side_[k].gather(host.x, begin, end);
      if (!started_) {
        const std::span<const Vec3> x = side_[k].x().subspan(begin, end - begin);
        std::copy(x.begin(), x.end(), loads_[k].x_before.begin() + static_cast<std::ptrdiff_t>(begin));
      }
      parts[begin / piece] = motion_kernel()(args, begin, end);
    });
    Vec3 sum{};
    for (const MotionPart& part : parts) {
      sum += Vec3{part.sum[0], part.sum[1], part.sum[2]};
      largest[k].from_a = std::max(largest[k].from_a, part.largest[0]);
      largest[k].from_b = std::max(largest[k].from_b, part.largest[1]);
    }
    largest[k] = {std::sqrt(largest[k].from_a), std::sqrt(largest[k].from_b)};
    if (!parts.empty() && host.dt > 0.0) mean_velocity_[k] = sum / (static_cast<double>(side_[k].node_count()) * host.dt);
  }
  committed_ = false;
  return {Motion{common[1], largest[0].from_b, largest[1].from_b}, Motion{common[0], largest[1].from_a, largest[0].from_a}};
}

StepResult OneSided::evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness) {
  const bool awake = host.time >= options_.birth && host.time <= options_.death;
  acted_ = awake;
  for (std::size_t k = 0; k < 2; ++k) {
    over_pieces(k, [&loads = loads_[k]](std::size_t begin, std::size_t end) { loads.clear(begin, end); });
  }
  std::array<PassTotals, 2> total;
  if (awake) {
    total[0] = pass_[0].evaluate(host, side_[0], side_[1], loads_[0], loads_[1]);
    if (two_passes_) total[1] = pass_[1].evaluate(host, side_[1], side_[0], loads_[1], loads_[0]);
  } else {
    for (std::size_t k = 0; k < pass_.size(); ++k) total[k] = pass_[k].rest(host, side_[k], side_[1 - k]);
  }

  for (std::size_t k = 0; k < 2; ++k) {
    SideLoads& loads = loads_[k];
    loads.work_parts.resize(pieces(loads.loaded.size()));
    over_pieces(k, [&](std::size_t begin, std::size_t end) {
      double work = 0.0;
      loads.for_loaded(begin, end, [&](std::size_t s) {
        const SideLoads::Node& load = loads.node(s);
        const Vec3 f = load.total();
        work += dot(0.5 * (load.force_before + f), side_[k].x()[s] - loads.x_before[s]);
        const std::size_t node = at(side_[k].nodes()[s]);
        force[node] += f;
        stiffness[node] += load.own_stiffness + load.reaction_stiffness;
      });
      loads.work_parts[begin / piece] = work;
    });
    loads.work_step = 0.0;
    for (const double work : loads.work_parts) loads.work_step += work;
  }

  StepResult result;
  friction_step_ = total[0].dissipated + total[1].dissipated;
  damping_step_ = total[0].damped + total[1].damped;
  start_step_ = total[0].started + total[1].started;
  stepped_step_ = total[0].stepped + total[1].stepped;
  result.damping_work = damping_work_ + damping_step_;
  result.elastic = (total[0].potential + total[0].stick) + (total[1].potential + total[1].stick);
  result.friction_work = friction_work_ + friction_step_;
  const double work = (loads_[0].work + loads_[0].work_step) + (loads_[1].work + loads_[1].work_step);
  if (!started_) initial_elastic_ = result.elastic;
  // Whoever opens the time window over nodes in the gap puts the energy there that the springs then hold.
  waiting_step_ = host.time < options_.birth;
  if (waiting_ && awake) start_step_ += (loads_[0].work_step + loads_[1].work_step) + result.elastic + friction_step_ + damping_step_;
  result.start_work = start_work_ + start_step_;
  result.made = work + (result.elastic - initial_elastic_) + result.friction_work + result.damping_work - result.start_work +
                (stepped_work_ + stepped_step_);
  result.normal_force = total[1].normal - total[0].normal;
  result.tangential_force = total[1].tangential - total[0].tangential;
  result.in_contact = total[0].in_contact + total[1].in_contact;
  const std::size_t deeper = total[1].largest_penetration > total[0].largest_penetration ? 1 : 0;
  result.largest_penetration = total[deeper].largest_penetration;
  result.deepest_node = total[deeper].deepest_node;
  result.largest_approach = std::max(total[0].largest_approach, total[1].largest_approach);
  const std::size_t tighter = total[1].kinematic_step < total[0].kinematic_step ? 1 : 0;
  result.kinematic_step = total[tighter].kinematic_step;
  result.kinematic_node = total[tighter].kinematic_node;
  const auto join = [this](std::vector<Index>& all, const std::vector<Index>& (Pass::*of)() const) {
    all.clear();
    for (const Pass& pass : pass_) all.insert(all.end(), (pass.*of)().begin(), (pass.*of)().end());
  };
  join(in_contact_, &Pass::in_contact);
  join(crossed_, &Pass::crossed);
  join(lost_, &Pass::lost);
  result.crossed = static_cast<Index>(crossed_.size());
  result.lost = static_cast<Index>(lost_.size());
  return result;
}

void OneSided::clear(std::span<Vec3> force, std::span<double> stiffness) const {
  for (std::size_t k = 0; k < 2; ++k) {
    over_pieces(k, [&](std::size_t begin, std::size_t end) {
      loads_[k].for_loaded(begin, end, [&](std::size_t s) {
        const std::size_t node = at(side_[k].nodes()[s]);
        force[node] = {};
        stiffness[node] = 0.0;
      });
    });
  }
}

void OneSided::commit() {
  for (Pass& pass : pass_) pass.commit();
  for (std::size_t k = 0; k < 2; ++k) {
    SideLoads& loads = loads_[k];
    loads.work += loads.work_step;
    loads.work_step = 0.0;
    over_pieces(k, [&loads](std::size_t begin, std::size_t end) { loads.commit(begin, end); });
  }
  started_ = true;
  stepped_ = true;
  committed_ = true;
  waiting_ = waiting_step_;
  friction_work_ += friction_step_;
  friction_step_ = 0.0;
  damping_work_ += damping_step_;
  damping_step_ = 0.0;
  start_work_ += start_step_;
  start_step_ = 0.0;
  stepped_work_ += stepped_step_;
  stepped_step_ = 0.0;
}

void OneSided::add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const {
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t s = 0; s < loads_[k].loaded.size(); ++s) {
      if ((loads_[k].loaded[s] & SideLoads::now) == 0) continue;
      const std::size_t node = at(side_[k].nodes()[s]);
      const SideLoads::Node& load = loads_[k].node(s);
      normal[node] += load.own_normal + load.reaction_normal;
      tangential[node] += load.own_tangential + load.reaction_tangential;
    }
  }
}

void OneSided::add_nodal_area(std::span<const Vec3> x, std::span<double> area) const {
  for (const Side& side : side_) {
    Side now = side;
    now.gather(x);
    for (Index s = 0; s < now.node_count(); ++s) {
      if (now.facet_count() > 0) area[at(now.nodes()[at(s)])] += now.tributary_area(s);
    }
  }
}

void OneSided::add_nodal_contact(std::span<NodalContact> nodes) const {
  if (!acted_) return;
  pass_[0].add_nodal_contact(side_[0], side_[1], nodes);
  if (two_passes_) pass_[1].add_nodal_contact(side_[1], side_[0], nodes);
}

void OneSided::save(HistoryWriter& out) const {
  // Room at once: as large as it is, it would be in memory twice whenever it grows.
  std::size_t bytes = 256;
  for (const Side& side : side_) bytes += side.nodes().size() * 2 * (sizeof(Vec3) + sizeof(float));
  for (const Pass& pass : pass_) bytes += pass.saved_bytes();
  out.reserve(bytes);
  out.put(static_cast<std::uint64_t>(started_ ? 1 : 0));
  out.put(static_cast<std::uint64_t>(!started_ ? 0 : !waiting_ ? 1 : 2));
  out.put(initial_elastic_);
  out.put(friction_work_);
  out.put(damping_work_);
  out.put(start_work_);
  out.put(stepped_work_);
  for (std::size_t k = 0; k < 2; ++k) {
    out.put(loads_[k].work);
    out.put(mean_velocity_[k]);
    out.put_all(loads_[k].forces_before());
    out.put_all(loads_[k].own_before);
    out.put_all(loads_[k].springs_before);
    if (committed_) {
      out.put_all(side_[k].x());
    } else {
      out.put_all(loads_[k].x_before);
    }
  }
  for (const Pass& pass : pass_) pass.save(out);
}

void OneSided::load(HistoryReader& in) {
  std::uint64_t started = 0;
  in.get(started);
  started_ = started != 0;
  in.get(started);
  waiting_ = started == 2;
  in.get(initial_elastic_);
  in.get(friction_work_);
  in.get(damping_work_);
  in.get(start_work_);
  in.get(stepped_work_);
  for (std::size_t k = 0; k < 2; ++k) {
    in.get(loads_[k].work);
    in.get(mean_velocity_[k]);
    std::vector<Vec3> force(loads_[k].loaded.size());
    in.get_all(force);
    in.get_all(loads_[k].own_before);
    in.get_all(loads_[k].springs_before);
    loads_[k].set_forces_before(force);
    in.get_all(loads_[k].x_before);
  }
  for (Pass& pass : pass_) pass.load(in);
  tried_ = true;
  stepped_ = false;
  committed_ = false;
  acted_ = false;
}

}  // namespace abut::contact
