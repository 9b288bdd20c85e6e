#include "constraints/rigid_walls.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace abut::constraints {

namespace {

std::vector<Index> touched_nodes(const model::Model& model) {
  std::vector<Index> nodes;
  for (const model::RigidWall& w : model.rigid_walls) {
    nodes.insert(nodes.end(), w.nodes.begin(), w.nodes.end());
    if (w.node != no_index) nodes.push_back(w.node);
  }
  if (!model.rigid_walls.empty()) {  // a body is moved by what touches its nodes
    for (const model::RigidBody& body : model.rigid_bodies) nodes.push_back(body.main);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

constexpr int newton_count =
    20;  ///< of passes for the velocity of a wall with friction; a few do unless nodes change between stick and slip
constexpr int largest_count = 200;  ///< of passes with those by secants that then follow, which cannot circle

/// The solution of (1 + s A) x = b, A given by its columns, without negative eigenvalues.
Vec3 solve(double s, const std::array<Vec3, 3>& a, const Vec3& b) {
  const Vec3 c0 = Vec3{1, 0, 0} + s * a[0], c1 = Vec3{0, 1, 0} + s * a[1], c2 = Vec3{0, 0, 1} + s * a[2];
  const double det = dot(c0, cross(c1, c2));
  return Vec3{dot(b, cross(c1, c2)), dot(c0, cross(b, c2)), dot(c0, cross(c1, b))} / det;
}

}  // namespace

RigidWalls::RigidWalls(const model::Model& model, const RigidBodies& bodies, const BoundaryConditions& conditions,
                       const ImposedMotions& motions, const Profile& profile)
    : model_(&model),
      bodies_(&bodies),
      conditions_(&conditions),
      motions_(&motions),
      same_cycle_(profile.moving_wall == Profile::MovingWall::same_cycle),
      bounded_filter_(profile.wall_filter == Profile::WallFilter::bounded),
      walls_(model.rigid_walls.size()),
      sums_(model.rigid_walls.size()),
      meter_(touched_nodes(model), &bodies),
      stops_(touched_nodes(model)) {
  // Ikrem = 0: secondary nodes of a rigid body are taken out of all walls.
  std::vector<bool> removed(static_cast<std::size_t>(model.node_count()), false);
  for (const model::RigidBody& body : model.rigid_bodies) {
    if (body.keep_in_walls || !body.active || body.sensor != no_index) continue;
    for (const Index node : body.nodes) removed[static_cast<std::size_t>(node)] = true;
  }
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const model::RigidWall& card = model.rigid_walls[i];
    for (const Index node : card.nodes) {
      if (node != card.node && !removed[static_cast<std::size_t>(node)]) walls_[i].nodes.push_back(node);
    }
    if (card.filter_kind != 0) walls_[i].filtered.resize(walls_[i].nodes.size());
    walls_[i].pressing.reserve(walls_[i].nodes.size());
    if (!model.rigid_bodies.empty() || !model.boundary_conditions.empty())
      points_.reserve(std::max(points_.capacity(), walls_[i].nodes.size()));
  }
}

void RigidWalls::initialise(state::State& state) {
  for (const model::RigidWall& card : model_->rigid_walls) {
    if (card.node == no_index) continue;
    state.mass[static_cast<std::size_t>(card.node)] += card.mass;
    state.v[static_cast<std::size_t>(card.node)] = card.velocity;
  }
}

void RigidWalls::add_reaction(state::State& state) {
  if (same_cycle_) return;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Index main = model_->rigid_walls[i].node;
    if (main == no_index) continue;
    const auto k = static_cast<std::size_t>(main);
    const Vec3 before = state.f[k];
    const double mass = state.mass[k];
    Vec3 total = before + walls_[i].reaction;
    if (mass > 0.0) total *= mass / (mass + walls_[i].impacted_mass);
    state.f[k] = total;
    meter_.add_force(main, total - before);
  }
}

void RigidWalls::apply(state::State& state) {
  work_ = 0.0;
  meter_.before(state);
  stops_.before(state);
  for (std::size_t i = 0; i < walls_.size(); ++i) apply_wall(i, state);
  meter_.after(state);
  if (!same_cycle_) return;
  const state::StepTimes& t = state.times;
  momentum_correction_ = (0.5 * t.h_minus / t.h_bar - 1.0) * stops_.gained(state, *bodies_);
}

void RigidWalls::add_forces(std::span<Vec3> force) const {
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Index node = model_->rigid_walls[i].node;
    if (node != no_index) {
      force[static_cast<std::size_t>(node)] += sums_[i].normal_force + sums_[i].tangential_force;
      continue;
    }
    for (const auto& [pressing, f] : walls_[i].pressing) force[static_cast<std::size_t>(pressing)] += f;
  }
}

void RigidWalls::persist(state::Archive& a) {
  a.each(walls_, [&a](Wall& wall) {
    a.fixed(wall.filtered);
    a(wall.reaction);
    a(wall.impacted_mass);
    a(wall.count);
  });
  a.each(sums_, [&a](WallSums& s) {
    for (Vec3* v : {&s.normal_force, &s.tangential_force, &s.normal_impulse, &s.tangential_impulse}) a(*v);
  });
  a(work_);
  meter_.persist(a);
}

double RigidWalls::weight_of_new(const model::RigidWall& card, double h_bar) const {
  constexpr double turn = 2.0 * 3.14159265358979323846;
  if (card.filter_kind == 1) return card.filter;
  if (card.filter_kind == 2) return turn / card.filter;
  if (card.filter_kind != 3) return 1.0;
  const double weight = turn * card.filter * h_bar;
  return bounded_filter_ ? std::min(weight, 1.0) : weight;
}

bool RigidWalls::reaches(const state::State& state, Index node, const Vec3& point, const Vec3& normal) const {
  const auto i = static_cast<std::size_t>(node);
  const Vec3 predicted = state.v[i] + state.times.h_bar * state.a[i];
  return dot(state.x[i] + state.times.h_plus * predicted - point, normal) <= 0.0;
}

bool RigidWalls::is_point(Index node, const Vec3& normal) const {
  if (of_body(node)) return true;
  const BoundaryConditions::Held held = conditions_->held(node, false);
  if (held.count == 0 || held.count == 3) return false;
  constexpr double aligned = 1e-12;
  const double free = dot(normal, held.free_part(normal));
  return free > aligned && free < 1.0 - aligned;
}

RigidBodies::Carrier RigidWalls::carrier_of(Index node) const {
  RigidBodies::Carrier carrier;
  carrier.point = node;
  carrier.body = bodies_->body_of(node) != no_index ? bodies_->body_of(node) : bodies_->main_of(node);
  carrier.node = carrier.body == no_index ? node : model_->rigid_bodies[static_cast<std::size_t>(carrier.body)].main;
  carrier.translation = conditions_->held(carrier.node, false);
  motions_->add_imposed(carrier.node, false, carrier.translation);
  carrier.rotation = conditions_->held(carrier.node, true);
  motions_->add_imposed(carrier.node, true, carrier.rotation);
  return carrier;
}

Vec3 RigidWalls::velocity_after_impact(const Wall& wall, const state::State& state, const model::RigidWall& card, const Vec3& before,
                                       const Vec3& point, const RigidBodies::Carrier& carrier) const {
  const Vec3 n = card.normal, normal_response = bodies_->response(state, carrier, n);
  const bool tied = card.slide == 1;
  std::array<Vec3, 3> response{};
  for (int k = 0; k < 3 && tied; ++k) {
    Vec3 e{};
    e[k] = 1.0;
    response[static_cast<std::size_t>(k)] = bodies_->response(state, carrier, e);
  }
  // The slower the wall gets, the fewer nodes still press on it: shrink the set until it stays. Ends: the set only shrinks.
  Vec3 velocity = before;
  Index count = -1;
  for (;;) {
    double impacted = 0.0;
    Vec3 momentum{};
    Index pressing = 0;
    for (const Index node : wall.nodes) {
      if (!reaches(state, node, point, n) || !tested(node, n)) continue;
      const auto i = static_cast<std::size_t>(node);
      const Vec3 predicted = state.v[i] + state.times.h_bar * state.a[i];
      if (dot(predicted - velocity, n) > 0.0) continue;
      impacted += state.mass[i];
      momentum += state.mass[i] * (predicted - before);
      ++pressing;
    }
    if (pressing == count) return velocity;
    count = pressing;
    velocity = tied ? before + bodies_->response(state, carrier, solve(impacted, response, momentum))
                    : before + dot(momentum, n) / (1.0 + dot(n, normal_response) * impacted) * normal_response;
  }
}

Vec3 RigidWalls::velocity_with_friction(const Wall& wall, const state::State& state, const model::RigidWall& card, const Vec3& before,
                                        const Plane& plane) const {
  const Vec3 n = card.normal;
  const double alpha = weight_of_new(card, state.times.h_bar);
  const auto along_plane = [&n](const Vec3& b) { return b - dot(b, n) * n; };
  Vec3 velocity = plane.velocity;
  for (int pass = 0; pass < largest_count; ++pass) {
    Vec3 impulse{};                // sum J(V)
    std::array<Vec3, 3> change{};  // -dJ/dV by columns
    double fastest = 0.0;
    for (std::size_t k = 0; k < wall.nodes.size(); ++k) {
      const Index node = wall.nodes[k];
      const auto i = static_cast<std::size_t>(node);
      if (!reaches(state, node, plane.point, n) || !tested(node, n)) continue;
      const double mass = state.mass[i];
      const Vec3 u = state.v[i] + state.times.h_bar * state.a[i] - velocity;
      if (dot(u, n) > 0.0) continue;
      Vec3 tangential = alpha * mass * along_plane(u);
      if (card.filter_kind != 0) tangential += (1.0 - alpha) * wall.filtered[k];
      const double limit = -card.friction * mass * dot(u, n), size = norm(tangential);
      const bool slips = size > limit;
      const double share = slips ? limit / size : 1.0;
      const bool newton = slips && pass < newton_count;
      const Vec3 slip = newton ? tangential / size : Vec3{};
      impulse += mass * dot(u, n) * n + share * tangential;
      for (int c = 0; c < 3; ++c) {
        Vec3 e{};
        e[c] = 1.0;
        const Vec3 t = along_plane(e);
        change[static_cast<std::size_t>(c)] +=
            mass * n[c] * n + share * alpha * mass * (t - dot(t, slip) * slip) - card.friction * mass * n[c] * slip;
      }
      fastest = std::max(fastest, norm(u));
    }
    std::array<Vec3, 3> answer{};
    for (std::size_t c = 0; c < 3; ++c) answer[c] = bodies_->response(state, plane.carrier, change[c]);
    const Vec3 step = solve(1.0, answer, before + bodies_->response(state, plane.carrier, impulse) - velocity);
    velocity += step;
    if (norm(step) <= 1e-15 * (fastest + norm(velocity))) break;
  }
  return velocity;
}

void RigidWalls::apply_wall(std::size_t index, state::State& state) {
  const model::RigidWall& card = model_->rigid_walls[index];
  Wall& wall = walls_[index];
  const double h = state.times.h_plus, hb = state.times.h_bar, h_minus = state.times.h_minus;
  const Vec3 n = card.normal;

  Plane plane;
  plane.point = card.point;
  Vec3 &wall_velocity = plane.velocity, &wall_point = plane.point;
  RigidBodies::Carrier& carrier = plane.carrier;
  bool& yields = plane.yields;
  if (card.node != no_index) {
    const auto k = static_cast<std::size_t>(card.node);
    if (same_cycle_) {
      carrier = carrier_of(card.node);
      wall_velocity = bodies_->next_velocity(state, carrier);
      yields = state.mass[static_cast<std::size_t>(carrier.node)] > 0.0;
    } else {
      wall_velocity = state.v[k] + hb * state.a[k];
    }
    wall_point = state.x[k] + h * wall_velocity;
    if (yields) {
      const Vec3 before = wall_velocity;
      wall_velocity = velocity_after_impact(wall, state, card, before, wall_point, carrier);
      if (card.slide == 2) wall_velocity = velocity_with_friction(wall, state, card, before, plane);
    }
  }
  const double alpha = weight_of_new(card, hb);

  Vec3 normal_impulse{}, tangential_impulse{};
  double impacted = 0.0;
  wall.pressing.clear();
  for (std::size_t k = 0; k < wall.nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(wall.nodes[k]);
    const Vec3 predicted = state.v[i] + hb * state.a[i];
    if (!reaches(state, wall.nodes[k], wall_point, n) || !tested(wall.nodes[k], n)) {
      if (card.filter_kind != 0) wall.filtered[k] = Vec3{};
      continue;
    }
    if (dot(predicted - wall_velocity, n) > 0.0) continue;

    const double mass = state.mass[i];
    const Vec3 relative = state.v[i] - wall_velocity;
    const double dv_n = dot(relative, n);
    const double a_n = dot(state.a[i], n);
    const double j_n = mass * (dv_n + a_n * hb);
    Vec3 j_t{};
    work_ -= 0.5 * h_minus / hb * j_n * dot(relative, n);
    const auto slide = [&] {
      state.v[i] -= dv_n * n;
      state.a[i] -= a_n * n;
    };
    const auto tie = [&] {
      state.v[i] = wall_velocity;
      state.a[i] = Vec3{};
    };
    if (card.slide == 0) {
      slide();
    } else {
      j_t = mass * (relative + hb * state.a[i]) - j_n * n;
      if (card.slide == 1) {
        tie();
      } else {
        if (card.filter_kind != 0) wall.filtered[k] = j_t = alpha * j_t + (1.0 - alpha) * wall.filtered[k];
        const double limit = card.friction * (j_n < 0.0 ? -j_n : j_n);
        const double size = norm(j_t);
        if (size <= limit && card.filter_kind == 0) {
          tie();
        } else {
          if (size > limit) j_t *= limit / size;
          slide();
          work_ -= dot(state.v[i] - wall_velocity, j_t);
          if (mass > 0.0) state.a[i] -= j_t / (mass * hb);
        }
      }
    }
    normal_impulse += j_n * n;
    tangential_impulse += j_t;
    impacted += mass;
    wall.pressing.emplace_back(wall.nodes[k], (j_n * n + j_t) / hb);
  }
  if (yields) bodies_->push(state, carrier, normal_impulse + tangential_impulse);
  if (same_cycle_) stop_bodies(index, plane, state, normal_impulse, tangential_impulse);
  wall.count = static_cast<Index>(wall.pressing.size());
  WallSums& sums = sums_[index];
  sums.normal_force = normal_impulse / hb;
  sums.tangential_force = tangential_impulse / hb;
  sums.normal_impulse += normal_impulse;
  sums.tangential_impulse += tangential_impulse;
  wall.reaction = (normal_impulse + tangential_impulse) / hb;
  wall.impacted_mass = impacted;
}

}  // namespace abut::constraints
