// The formulas of held_kernel.hpp over a number type. Always inlined: nothing of it may survive as a symbol of its own.
#pragma once

#include "contact/enforce/held_kernel.hpp"
#include "simd/gather.hpp"

namespace abut::contact::held {

template <class T>
using V = simd::Triple<T>;

template <class T>
ABUT_INLINE V<T> unit(const V<T>& a) {
  const T scale = T(1.0) / simd::sqrt(dot(a, a));
  return scale * a;
}
template <class T>
ABUT_INLINE V<T> select(decltype(T(0.0) < T(0.0)) c, const V<T>& a, const V<T>& b) {
  return {simd::select(c, a.x, b.x), simd::select(c, a.y, b.y), simd::select(c, a.z, b.z)};
}
template <class T>
ABUT_INLINE T load(const double* p) {
  return simd::NumberTraits<T>::load(p);
}
template <class T>
ABUT_INLINE void store(double* p, T a) {
  simd::NumberTraits<T>::store(p, a);
}
template <class T>
ABUT_INLINE V<T> load3(const double (*p)[HeldBatch::size], int k) {
  return {load<T>(p[0] + k), load<T>(p[1] + k), load<T>(p[2] + k)};
}
template <class T>
ABUT_INLINE void store3(double (*p)[HeldBatch::size], int k, const V<T>& a) {
  store(p[0] + k, a.x);
  store(p[1] + k, a.y);
  store(p[2] + k, a.z);
}

/// -u - ln(1 - u) for 0 <= u < 0.9; law.hpp has the same for one number, and why there are two ways.
template <class T>
ABUT_INLINE T minus_u_minus_log(T u) {
  const T one = T(1.0);
  const auto small = u < T(0.125);
  T series = T(0.0), whole = T(0.0);
  if (simd::any(small)) {
    constexpr double c[] = {1. / 20, 1. / 19, 1. / 18, 1. / 17, 1. / 16, 1. / 15, 1. / 14, 1. / 13, 1. / 12, 1. / 11,
                            1. / 10, 1. / 9,  1. / 8,  1. / 7,  1. / 6,  1. / 5,  1. / 4,  1. / 3,  1. / 2};
    series = T(c[0]);
    for (int k = 1; k < 19; ++k) series = series * u + T(c[k]);
    series = series * (u * u);
  }
  if (simd::any(u >= T(0.125))) {
    constexpr double ln2 = 0.693147180559945309417232121458;
    T y = one - u, log = T(0.0);
    for (int k = 0; k < 4; ++k) {
      const auto low = y < T(0.70710678);
      y = simd::select(low, y + y, y);
      log = simd::select(low, log - T(ln2), log);
    }
    const T z = (y - one) / (y + one), zz = z * z;
    constexpr double c[] = {1. / 23, 1. / 21, 1. / 19, 1. / 17, 1. / 15, 1. / 13, 1. / 11, 1. / 9, 1. / 7, 1. / 5, 1. / 3, 1.};
    T sum = T(c[0]);
    for (int k = 1; k < 12; ++k) sum = sum * zz + T(c[k]);
    whole = -u - (log + T(2.0) * (z * sum));
  }
  return simd::select(small, series, whole);
}

/// A bilinear facet seen from the node, X = c + a s + b t + g s t, and the closest point on it.
template <class T>
struct Foot {
  using Mask = decltype(T(0.0) < T(0.0));
  V<T> c, a, b, g;
  T s, t;
  V<T> xs, xt, r;           ///< tangents, node less contact point
  T a11, a22, a12;          ///< of the Hessian A
  T metric;                 ///< square of the shorter tangent at the middle
  Mask found;               ///< the only minimum
  Mask at_end_s, at_end_t;  ///< over an edge, both: over a corner

  [[gnu::always_inline]] inline void look() {
    xs = a + t * g;
    xt = b + s * g;
    r = V<T>{-c.x, -c.y, -c.z} - s * xs - t * b;
    a11 = dot(xs, xs);
    a22 = dot(xt, xt);
    a12 = dot(xs, xt) - dot(r, g);
  }
};

/// The sides of a facet, or of what is open of it: |t|, |s| at sides 0 to 3.
template <class T>
struct Sides {
  T low_t, high_s, high_t, low_s;
};

template <class T>
ABUT_INLINE T within(T low, T value, T high) {
  return simd::max(-low, simd::min(value, high));
}

/// The closest point of what lies between the sides, where that of the whole surface, which is known, does not.
template <class T>
ABUT_INLINE void move_to_sides(Foot<T>& q, const Sides<T>& sides) {
  const T zero = T(0.0);
  const auto out_s = (q.s >= sides.high_s) | (-q.s >= sides.low_s), out_t = (q.t >= sides.high_t) | (-q.t >= sides.low_t);
  q.at_end_s = out_s;
  q.at_end_t = out_t;
  const auto out = out_s | out_t;
  if (!simd::any(out)) return;
  // Sides are straight: one step along each. Where both are left behind, the nearer of the two points.
  const T end_s = within(sides.low_s, q.s, sides.high_s), end_t = within(sides.low_t, q.t, sides.high_t);
  const V<T> along_t = q.b + end_s * q.g, from_s = q.c + end_s * q.a;
  const V<T> along_s = q.a + end_t * q.g, from_t = q.c + end_t * q.b;
  const T t_there = within(sides.low_t, -(dot(from_s, along_t) / dot(along_t, along_t)), sides.high_t);
  const T s_there = within(sides.low_s, -(dot(from_t, along_s) / dot(along_s, along_s)), sides.high_s);
  const V<T> way_s = from_s + t_there * along_t, way_t = from_t + s_there * along_s;
  const auto by_s = out_s & ((!out_t) | (dot(way_s, way_s) <= dot(way_t, way_t)));
  const auto by_t = out & (!by_s);
  q.s = simd::select(by_s, end_s, simd::select(by_t, s_there, q.s));
  q.t = simd::select(by_t, end_t, simd::select(by_s, t_there, q.t));
  q.at_end_s = out & ((q.s >= sides.high_s) | (-q.s >= sides.low_s));
  q.at_end_t = out & ((q.t >= sides.high_t) | (-q.t >= sides.low_t));
  q.look();
  // A minimum goes down outwards at every end that it lies at.
  const T up_s = -dot(q.r, q.xs) * q.s, up_t = -dot(q.r, q.xt) * q.t;
  q.found = q.found & ((!q.at_end_s) | (up_s <= zero)) & ((!q.at_end_t) | (up_t <= zero));
}

/// @param reach  square of the furthest |s|, |t| of the facet with its strips
template <class T>
ABUT_INLINE void project(Foot<T>& q, T reach, const Sides<T>& sides) {
  // With |g| at most half of the shorter tangent (`folds`) and tangents no flatter than `flattest`, Newton's steps go down as e' < 200 e^2:
  // after a step of 1e-8 less than 1e-13 is left.
  constexpr double last_step = 1e-8, flattest = 1e-2;
  constexpr int most = 12;
  const T zero = T(0.0), one = T(1.0);
  q.s = zero;
  q.t = zero;
  auto done = one < zero;
  auto regular = zero < one;
  for (int i = 0; i < most; ++i) {
    q.look();
    const T gs = -dot(q.r, q.xs), gt = -dot(q.r, q.xt);
    const T det = q.a11 * q.a22 - q.a12 * q.a12;
    regular = regular & (done | (det > T(flattest) * (q.a11 * q.a22)));
    const T inverse = one / det;
    const T ds = (q.a12 * gt - q.a22 * gs) * inverse, dt = (q.a12 * gs - q.a11 * gt) * inverse;
    q.s = simd::select(done, q.s, q.s + ds);
    q.t = simd::select(done, q.t, q.t + dt);
    const T largest = simd::max(simd::abs(ds), simd::abs(dt));
    done = done | (largest < T(last_step));
    if (!simd::any((!done) & regular)) break;
  }
  q.look();
  q.found = done & regular;
  move_to_sides(q, sides);
  q.metric = simd::min(dot(q.a, q.a), dot(q.b, q.b));
  const T twist = dot(q.g, q.g);
  const auto folds = twist * reach > T(0.25) * q.metric;
  const auto far = (twist > T(1e-8) * q.metric) & (dot(q.r, q.r) * twist > T(0.04) * (q.metric * q.metric));
  q.found = q.found & (!folds) & (!far);
}

/// One over a mass; 0 where there is none.
template <class T>
ABUT_INLINE T inverse(T mass) {
  const auto some = mass > T(0.0);
  return simd::select(some, T(1.0) / simd::select(some, mass, T(1.0)), T(0.0));
}

template <class T>
ABUT_INLINE void ordinary_nodes(const HeldRules& rules, HeldBatch& b, int k) {
  const T zero = T(0.0), one = T(1.0), half = T(0.5), quarter = T(0.25);
  const V<T> x = simd::gather3(b.held_x, b.node + k, T());
  V<T> corner[4];
  for (int i = 0; i < 4; ++i) corner[i] = simd::gather3(b.surface_x, b.corner[i] + k, T()) - x;

  Foot<T> q;
  q.c = quarter * ((corner[0] + corner[1]) + (corner[2] + corner[3]));
  q.a = quarter * ((corner[1] - corner[0]) + (corner[2] - corner[3]));
  q.b = quarter * ((corner[3] - corner[0]) + (corner[2] - corner[1]));
  q.g = quarter * ((corner[0] - corner[1]) + (corner[2] - corner[3]));
  // A free border is no end: over the flat part of its strip a node is as over the inside.
  const Sides<T> flat{load<T>(b.end[0] + k), load<T>(b.end[1] + k), load<T>(b.end[2] + k), load<T>(b.end[3] + k)};
  const auto end = [one](T of_flat) { return simd::select(of_flat > one, T(1e30), one); };
  project(q, load<T>(b.reach + k), {end(flat.low_t), end(flat.high_s), end(flat.high_t), end(flat.low_s)});
  auto ordinary = q.found & (q.s <= flat.high_s) & (-q.s <= flat.low_s) & (q.t <= flat.high_t) & (-q.t <= flat.low_t);
  const V<T>&r = q.r, &xs = q.xs, &xt = q.xt;
  V<T> n = unit(cross(xs, xt));
  const auto at_end = q.at_end_s | q.at_end_t;
  if (simd::any(at_end)) {
    // In front, or the last normal says that it is not.
    ordinary = ordinary & ((!at_end) | (dot(r, r) > T(1e-12) * q.metric));
    n = select<T>(at_end, unit(r), n);
  }
  const T d = dot(n, r);
  const T s0 = one - q.s, s1 = one + q.s, t0 = quarter * (one - q.t), t1 = quarter * (one + q.t);
  const T h[4] = {s0 * t0, s1 * t0, s1 * t1, s0 * t1};
  store(b.squared_distance + k, dot(r, r));
  store(b.distance + k, d);
  store3(b.normal, k, n);
  for (int i = 0; i < 4; ++i) store(b.weight[i] + k, h[i]);

  // Normal law.
  const T gap = T(rules.gap);
  const T p = gap - d;
  // Within rounding of the gap the general way alone says whether there is a contact.
  ordinary = ordinary & (p > T(rules.smallest));
  T phi, slope_of_phi;
  if (rules.stiffens) {
    const T u = p / gap;
    ordinary = ordinary & (u < T(0.9));
    slope_of_phi = p / (one - u);
    phi = (gap * gap) * minus_u_minus_log(simd::max(zero, simd::min(u, T(0.9))));
  } else {
    slope_of_phi = p;
    phi = half * (p * p);
  }

  // Stiffness of the pair and its gradient.
  T k1[4], c1 = zero;
  for (int i = 0; i < 4; ++i) {
    k1[i] = load<T>(b.corner_stiffness[i] + k);
    c1 = c1 + h[i] * k1[i];
  }
  const T lowest = simd::min(simd::min(k1[0], k1[1]), simd::min(k1[2], k1[3]));
  const T highest = simd::max(simd::max(k1[0], k1[1]), simd::max(k1[2], k1[3]));
  const auto clipped = (c1 < lowest) | (c1 > highest);
  c1 = simd::max(lowest, simd::min(c1, highest));
  const T k2 = load<T>(b.node_stiffness + k);
  ordinary = ordinary & (c1 > zero) & (k2 > zero);
  const T share = k2 / (c1 + k2);
  const T kappa = T(rules.stiffness_scale) * (c1 * share);
  const T slope = simd::select(clipped, zero, T(rules.stiffness_scale) * (share * share));
  const T ks = slope * (t0 * (k1[1] - k1[0]) + t1 * (k1[2] - k1[3]));
  const T kt = slope * (quarter * (s0 * (k1[3] - k1[0]) + s1 * (k1[2] - k1[1])));
  const T det = q.a11 * q.a22 - q.a12 * q.a12;
  const T by = phi / det;
  T cs = by * (q.a22 * ks - q.a12 * kt), ct = by * (q.a11 * kt - q.a12 * ks);
  if (simd::any(at_end)) {  // along the edge alone
    cs = simd::select(q.at_end_s, zero, simd::select(q.at_end_t, phi * ks / q.a11, cs));
    ct = simd::select(q.at_end_t, zero, simd::select(q.at_end_s, phi * kt / q.a22, ct));
  }
  const V<T> sideways = cs * xs + ct * xt;
  const T force = kappa * slope_of_phi;
  const V<T> on_node = force * n - sideways;
  store(b.penetration + k, p);
  store(b.force + k, force);
  store(b.potential + k, kappa * phi);
  store(b.stiffness + k, kappa);
  store3(b.on_node, k, on_node);
  const T cs4 = quarter * cs, across[4] = {-(cs4 * (one - q.t)) - quarter * (ct * s0), cs4 * (one - q.t) - quarter * (ct * s1),
                                           cs4 * (one + q.t) + quarter * (ct * s1), quarter * (ct * s0) - cs4 * (one + q.t)};
  for (int i = 0; i < 4; ++i) {
    const V<T> f = h[i] * on_node + across[i] * r;
    store3(b.on_corner[i], k, V<T>{-f.x, -f.y, -f.z});
  }

  // Motion.
  V<T> v = simd::gather3(b.v, b.node_v + k, T());
  V<T> v_last = v;
  // As Springs has it.
  const T reach_of_weights = (simd::abs(h[0]) + simd::abs(h[1])) + (simd::abs(h[2]) + simd::abs(h[3]));
  const T over_weights = one / reach_of_weights;
  const T pairs = T(rules.pairs), on_node_known = load<T>(b.springs[4] + k);
  const auto counted = [&](int i, T w) {
    const T known = load<T>(b.springs[i] + k);
    return simd::select(known > zero, w * simd::max(w, simd::min(known, pairs * simd::sqrt(w))) * over_weights, pairs * (w * w));
  };
  T inverse_mass = simd::select(on_node_known > zero, simd::max(one, on_node_known), pairs) * inverse(load<T>(b.mass[4] + k));
  for (int i = 0; i < 4; ++i) {
    const V<T> vi = simd::gather3(b.v, b.corner_v[i] + k, T());
    v = v - h[i] * vi;
    v_last = v_last - load<T>(b.last[i] + k) * vi;
    inverse_mass = inverse_mass + counted(i, simd::abs(h[i])) * inverse(load<T>(b.mass[i] + k));
  }
  const T step = T(rules.step);
  const T rate = dot(v, n), closing = -rate;
  store(b.rate + k, rate);
  store(b.acceleration + k, force * inverse_mass);
  store(b.approach + k, rules.gap > 0.0 ? simd::select(closing * step >= T(-0.25) * p, closing * step / gap, zero) : zero);
  // Along the normal that it was taken along before: where the normal turns, that is no acceleration.
  const V<T> last_normal = load3<T>(b.normal_before, k);
  const T gained = dot(v, last_normal) - load<T>(b.rate_before + k);
  ordinary = ordinary & (dot(n, last_normal) >= T(turns));
  // Account: what the step has made, before and with this force.
  const T by_step = quarter * load<T>(b.force_before + k) * T(rules.step_before - rules.step) * gained;
  const T half_step = T(0.5 * rules.step);
  const T made = load<T>(b.made_before + k) - load<T>(b.stored_before + k) + half_step * dot(load3<T>(b.push_before, k), v_last) + by_step;
  store(b.made + k, load<T>(b.reckoned + k) * (made + half_step * dot(on_node, v) + kappa * phi));
  store(b.stepped + k, by_step);
  if (rules.corrects_switching) {
    // Neither ends in the coming step as switching.hpp and the account see it.
    T others = zero;
    if (rules.mean_step > 0.0) others = gained / T(rules.mean_step) - load<T>(b.acceleration_before + k);
    ordinary = ordinary & (rate * step + (step * step) * (inverse_mass * force + others) <= p);
    const T leaves = rate + T(0.5 * (1.0 + step_growth)) * (step * (inverse_mass * force + others));
    ordinary = ordinary & (leaves * (T(step_growth) * step) <= p);
  }

  // Stiffness for the coming step.
  const T nearing = simd::max(closing, zero);
  T tangent = one;
  T bends = one;  // phi'' now
  if (rules.stiffens) {
    const T left = one - p / gap;
    bends = one / (left * left);
  }
  store(b.light + k, simd::select(inverse_mass * kappa * bends * (step * step) > T(light_pair), one, zero));
  if (rules.stiffens) {
    const T u = simd::max(p + T(step_growth) * (step * nearing), T(rules.smallest)) / gap;
    const T rest = one - u;
    tangent = simd::select(u > T(0.9), T(1.0 / ((1.0 - 0.9) * (1.0 - 0.9))), one / (rest * rest));
    const T room = half * simd::max(gap - p, T(1.0 - 0.9) * gap);
    const auto soon = (closing > zero) & (room < T(2.0) * (step * closing));
    store(b.kinematic_step + k, simd::select(soon, room / simd::select(soon, closing, one), T(1e30)));
  } else {
    store(b.kinematic_step + k, T(1e30));
  }
  const T extra = simd::sqrt(dot(sideways, sideways)) * (slope_of_phi / phi);
  // Over a strip weights extrapolate.
  const T spread = simd::select(simd::max(simd::abs(q.s), simd::abs(q.t)) > one, half * (one + reach_of_weights), one);
  store(b.spring + k, kappa * tangent);
  store(b.step_stiffness + k, spread * (T(rules.step_factor) * (kappa * tangent + extra)));

  if (rules.rubs) {
    const T kt_now = T(rules.tangential_ratio) * kappa;
    const V<T> along = corner[2] - corner[0];
    const V<T> fa = unit(along), fn = unit(cross(along, corner[3] - corner[1])), fb = cross(fn, fa);
    const V<T> e = load3<T>(b.slip_before, k), m = load3<T>(b.slip_normal_before, k);
    const V<T> slip = e.x * fa + e.y * fb + e.z * fn;
    const V<T> was = m.x * fa + m.y * fb + m.z * fn;
    const T cosine = dot(was, n);
    const V<T> axis = cross(was, n);
    const auto turns = cosine > T(-0.999999);
    const T part = dot(axis, slip) / simd::select(turns, one + cosine, one);
    V<T> elastic = select(turns, cosine * slip + cross(axis, slip) + part * axis, slip);
    elastic = elastic - dot(elastic, n) * n;
    const V<T> force_before = load<T>(b.tangential_stiffness_before + k) * elastic;
    V<T> increment{zero, zero, zero};
    for (int i = 0; i < 4; ++i) increment = increment + (h[i] - load<T>(b.anchor[i] + k)) * corner[i];
    increment = increment - dot(increment, n) * n;
    // A stiffer spring takes over the force, a softer one the slip (rub.cpp).
    const T kt_before = load<T>(b.tangential_stiffness_before + k);
    const T stored_before = half * (kt_before * dot(elastic, elastic));
    elastic = simd::select(kt_now > kt_before, kt_before / kt_now, one) * elastic;
    const V<T> trial = elastic + increment;
    const T limit = T(rules.friction) * force;
    const T size = kt_now * simd::sqrt(dot(trial, trial));
    const auto slides = size > limit;
    const V<T> now = simd::select(slides, limit / simd::select(slides, size, one), one) * trial;
    const V<T> friction = kt_now * now;
    const T work = half * dot(force_before + friction, trial - now);
    const T at_change = half * dot(force_before + friction, increment) - (half * (kt_now * dot(now, now)) - stored_before);
    const T of_slip = simd::select(slides, simd::max(work, zero), zero);
    const auto same = (kt_now <= kt_before) & (kt_now >= kt_before);
    store(b.dissipated + k, simd::select(same, of_slip, simd::max(at_change, zero)));
    store(b.stick + k, half * (kt_now * dot(now, now)));
    store(b.slips + k, simd::select(size >= T(1.0 - 1e-9) * limit, one, zero));
    store(b.tangential_stiffness + k, kt_now);
    store3(b.on_surface, k, friction);
    // Its couple. X_ss = X_tt = 0: the metric has the diagonal of A.
    const T g12 = dot(xs, xt), over = one / (q.a11 * q.a22 - g12 * g12);
    T i11 = over * q.a22, i12 = -(over * g12), i22 = over * q.a11;
    if (simd::any(at_end)) {
      i12 = simd::select(at_end, zero, i12);
      i11 = simd::select(q.at_end_s, zero, simd::select(q.at_end_t, one / q.a11, i11));
      i22 = simd::select(q.at_end_t, zero, simd::select(q.at_end_s, one / q.a22, i22));
    }
    const T fs = dot(friction, xs), ft = dot(friction, xt);
    const T with_s = i11 * fs + i12 * ft, with_t = i12 * fs + i22 * ft;
    const T s4[4] = {-(quarter * s0), -(quarter * s1), quarter * s1, quarter * s0}, t4[4] = {-t0, t0, t1, -t1};
    const T square_of_r = dot(r, r);
    T arm[4], arms = one;
    for (int i = 0; i < 4; ++i) {
      const V<T> f = load3<T>(b.on_corner[i], k);
      store3(b.on_corner[i], k, f - (with_s * t4[i] + with_t * s4[i]) * r);
      const T square = (i11 * (t4[i] * t4[i]) + T(2.0) * (i12 * (t4[i] * s4[i]))) + i22 * (s4[i] * s4[i]);
      arm[i] = simd::sqrt(h[i] * h[i] + square_of_r * simd::max(square, zero));
      arms = arms + arm[i];
    }
    const T weights = one + reach_of_weights;
    for (int i = 0; i < 4; ++i) store(b.couple_stiffness[i] + k, half * (kt_now * (arm[i] * arms - simd::abs(h[i]) * weights)));
    store(b.couple_stiffness[4] + k, half * (kt_now * (arms - weights)));
    store3(b.slip, k, V<T>{dot(now, fa), dot(now, fb), dot(now, fn)});
    store3(b.slip_normal, k, V<T>{dot(n, fa), dot(n, fb), dot(n, fn)});
  }
  store(b.ordinary + k, simd::select(ordinary, one, zero));
}

}  // namespace abut::contact::held
