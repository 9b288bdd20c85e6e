#include "constraints/rigid_walls.hpp"

#include <algorithm>
#include <cstddef>

#include "constraints/rigid_bodies.hpp"

namespace abut::constraints {

namespace {

std::vector<Index> touched_nodes(const model::Model& model) {
  std::vector<Index> nodes;
  for (const model::RigidWall& w : model.rigid_walls) nodes.insert(nodes.end(), w.nodes.begin(), w.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

RigidWalls::RigidWalls(const model::Model& model, const RigidBodies& bodies)
    : model_(&model), walls_(model.rigid_walls.size()), sums_(model.rigid_walls.size()), meter_(touched_nodes(model), &bodies) {
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
  for (std::size_t i = 0; i < walls_.size(); ++i) apply_wall(i, state);
  meter_.after(state);
}

void RigidWalls::apply_wall(std::size_t index, state::State& state) {
  const model::RigidWall& card = model_->rigid_walls[index];
  Wall& wall = walls_[index];
  const double h = state.times.h_plus, hb = state.times.h_bar, h_minus = state.times.h_minus;
  const Vec3 n = card.normal;

  Vec3 wall_velocity{}, wall_point = card.point;
  if (card.node != no_index) {
    const auto k = static_cast<std::size_t>(card.node);
    wall_velocity = state.v[k] + hb * state.a[k];
    wall_point = state.x[k] + h * wall_velocity;
  }
  double alpha = 1.0;  // friction filter: weight of the new value
  if (card.filter_kind == 1) alpha = card.filter;
  if (card.filter_kind == 2) alpha = 2.0 * 3.14159265358979323846 / card.filter;
  if (card.filter_kind == 3) alpha = 2.0 * 3.14159265358979323846 * card.filter * hb;

  Vec3 normal_impulse{}, tangential_impulse{};
  double impacted = 0.0;
  wall.count = 0;
  for (std::size_t k = 0; k < wall.nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(wall.nodes[k]);
    const Vec3 predicted = state.v[i] + hb * state.a[i];
    if (dot(state.x[i] + h * predicted - wall_point, n) > 0.0) {
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
    ++wall.count;
  }
  WallSums& sums = sums_[index];
  sums.normal_force = normal_impulse / hb;
  sums.tangential_force = tangential_impulse / hb;
  sums.normal_impulse += normal_impulse;
  sums.tangential_impulse += tangential_impulse;
  wall.reaction = (normal_impulse + tangential_impulse) / hb;
  wall.impacted_mass = impacted;
}

}  // namespace abut::constraints
