// Impact of rigid bodies, and of nodes that are held oblique to it, on a wall: plastic, at all points that would cross (rigid_walls.hpp).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "constraints/rigid_walls.hpp"

namespace abut::constraints {

namespace {

constexpr double small = 1e-13;     ///< of the approach: a change of velocity that ends the sweeps
constexpr int largest_count = 500;  ///< of sweeps; a block on its corners needs some ten

/// The larger eigenvalue of the symmetric 2 x 2 matrix [a c; c b].
double largest_eigenvalue(double a, double b, double c) {
  const double half = 0.5 * (a - b);
  return 0.5 * (a + b) + std::sqrt(half * half + c * c);
}

}  // namespace

double RigidWalls::press(const model::RigidWall& card, Point& point, Plane& plane, state::State& state) const {
  const Vec3 n = card.normal;
  const Vec3 v = bodies_->next_velocity(state, point.carrier);
  const Vec3 x = state.x[static_cast<std::size_t>(point.carrier.point)] + state.times.h_plus * v;
  const bool presses = dot(point.impulse, n) > 0.0;
  Vec3 slip = v - plane.velocity;
  if (!presses && (dot(x - plane.point, n) > 0.0 || dot(slip, n) >= 0.0)) return 0.0;

  const auto gained = [&](const Vec3& p) {  // relative velocity by an impulse on the point and its opposite on the wall
    const Vec3 g = bodies_->response(state, point.carrier, p);
    return plane.yields ? g + bodies_->response(state, plane.carrier, p) : g;
  };
  const Vec3 along = gained(n);
  const double yield = dot(along, n);
  if (!(yield > 0.0)) return 0.0;  // held along the normal
  const double before = dot(point.impulse, n);
  const double normal = std::max(0.0, before - dot(slip, n) / yield);
  Vec3 change = (normal - before) * n;
  if (card.slide != 0) {
    slip += (normal - before) * along;
    const Vec3 e1 = normalized(std::fabs(n.x) < 0.6 ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0})), e2 = cross(n, e1);
    const Vec3 g1 = gained(e1), g2 = gained(e2);
    const double rate = largest_eigenvalue(dot(e1, g1), dot(e2, g2), dot(e1, g2));
    const Vec3 old = point.impulse - before * n;
    Vec3 tangential = rate > 0.0 ? old - (slip - dot(slip, n) * n) / rate : Vec3{};
    const double limit = card.slide == 2 ? card.friction * normal : (normal > 0.0 ? std::numeric_limits<double>::infinity() : 0.0);
    const double size = norm(tangential);
    if (size > limit) tangential *= limit / size;
    change += tangential - old;
  }
  if (change == Vec3{}) return 0.0;
  point.impulse += change;
  bodies_->push(state, point.carrier, change);
  if (plane.yields) {
    const Vec3 wall = bodies_->response(state, plane.carrier, change);
    plane.velocity -= wall;
    plane.point -= state.times.h_plus * wall;
    bodies_->push(state, plane.carrier, -1.0 * change);
  }
  return norm(gained(change));
}

void RigidWalls::stop_bodies(std::size_t index, Plane& plane, state::State& state, Vec3& normal_impulse, Vec3& tangential_impulse) {
  const model::RigidWall& card = model_->rigid_walls[index];
  Wall& wall = walls_[index];
  points_.clear();
  double fastest = 0.0;
  for (const Index node : wall.nodes) {
    if (!is_point(node, card.normal)) continue;
    const RigidBodies::Carrier carrier = carrier_of(node);
    if (card.node != no_index && carrier.body != no_index && carrier.body == plane.carrier.body) continue;  // the wall moves with this body
    points_.push_back({carrier, {}});
    fastest = std::max(fastest, norm(bodies_->next_velocity(state, carrier) - plane.velocity));
  }
  for (int sweep = 0; sweep < largest_count; ++sweep) {
    double largest = 0.0;
    for (Point& point : points_) largest = std::max(largest, press(card, point, plane, state));
    if (largest <= small * fastest) break;
  }
  for (const Point& point : points_) {
    if (point.impulse == Vec3{}) continue;
    const Vec3 normal = -dot(point.impulse, card.normal) * card.normal;
    normal_impulse += normal;
    tangential_impulse -= point.impulse + normal;
    wall.pressing.emplace_back(point.carrier.point, -1.0 / state.times.h_bar * point.impulse);
  }
}

}  // namespace abut::constraints
