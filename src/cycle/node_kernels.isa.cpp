#include "cycle/node_kernels.hpp"

#include "simd/four.hpp"
#include "simd/isa_object.hpp"

namespace abut::cycle::ABUT_ISA {

namespace {

using simd::Four;
using simd::load4;

/// Adds 4 components of the entries of node i.
ABUT_INLINE void add_entries(const double* sums, const std::uint32_t* at, std::uint32_t begin, std::uint32_t end, Four& total) {
  for (std::uint32_t j = begin; j < end; ++j) total += load4(sums + at[j]);
}

/// Asks for entries that later nodes add up: they lie in the sums of many chunks.
ABUT_INLINE void ask_for_entries(const double* sums, const std::uint32_t* at, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t j = begin; j < end; ++j) __builtin_prefetch(sums + at[j + AssembleArgs::ahead], 0, 3);
}

/// Twelve doubles: the vectors of four nodes.
struct Twelve {
  Four p[3];
};
ABUT_INLINE Twelve load12(const double* a) { return {{load4(a), load4(a + 4), load4(a + 8)}}; }
ABUT_INLINE Twelve spread(const double* a) {
  const simd::Triple<Four> s = simd::spread(a);
  return {{s.x, s.y, s.z}};
}
ABUT_INLINE Twelve operator+(const Twelve& a, const Twelve& b) { return {{a.p[0] + b.p[0], a.p[1] + b.p[1], a.p[2] + b.p[2]}}; }
ABUT_INLINE Twelve operator-(const Twelve& a, const Twelve& b) { return {{a.p[0] - b.p[0], a.p[1] - b.p[1], a.p[2] - b.p[2]}}; }
ABUT_INLINE Twelve operator*(const Twelve& a, const Twelve& b) { return {{a.p[0] * b.p[0], a.p[1] * b.p[1], a.p[2] * b.p[2]}}; }
ABUT_INLINE Twelve operator*(Four s, const Twelve& a) { return {{s * a.p[0], s * a.p[1], s * a.p[2]}}; }

/// Sum of the parts of component k, k + 3, ... in order.
ABUT_INLINE double component(const Twelve& a, int k) {
  double all[12];
  for (int i = 0; i < 3; ++i) simd::store(all + 4 * i, a.p[i]);
  return ((all[k] + all[k + 3]) + all[k + 6]) + all[k + 9];
}
/// Sum of the parts of each of the four places.
ABUT_INLINE Four fold(const Twelve& a) { return (a.p[0] + a.p[1]) + a.p[2]; }
ABUT_INLINE double total(Four a) {
  double all[4];
  simd::store(all, a);
  return ((all[0] + all[1]) + all[2]) + all[3];
}

/// One kind of motion of some nodes: translations or rotations.
struct Moving {
  const double *velocity, *acceleration, *inertia, *minus, *plus;  ///< forces: plus (may be null) minus minus
};
struct MovingSums {
  Four star, square, before, after;
  Twelve momentum;
};

ABUT_INLINE void add_four(const Moving& m, std::size_t i, Four half, Four h_bar, MovingSums& s) {
  const Twelve v = load12(m.velocity + 3 * i), a = load12(m.acceleration + 3 * i), j = spread(m.inertia + i);
  const Twelve after = v + h_bar * a, now = v + half * a;
  const Twelve zero{};
  const Twelve g = (m.plus != nullptr ? load12(m.plus + 3 * i) : zero) - load12(m.minus + 3 * i);
  const Twelve momentum = j * now;
  s.star += fold(j * (v * after));
  s.square += fold(momentum * now);
  s.momentum = s.momentum + momentum;
  s.before += fold(g * v);
  s.after += fold(g * after);
}

ABUT_INLINE void sum_moving(const Moving& m, const MotionArgs& args, std::size_t begin, std::size_t end, MovingSums& s) {
  const Four zero(0.0);
  s = {zero, zero, zero, zero, {{zero, zero, zero}}};
  const Four half(args.half), h_bar(args.h_bar);
  std::size_t i = begin;
  for (; i + 4 <= end; i += 4) add_four(m, i, half, h_bar, s);
  if (i == end) return;
  // The last nodes, with nothing in the places of those that are missing.
  double rest[4][12] = {}, inertia[4] = {};
  for (std::size_t k = i; k < end; ++k) inertia[k - i] = m.inertia[k];
  const double* const from[4] = {m.velocity, m.acceleration, m.minus, m.plus};
  for (int q = 0; q < 4; ++q) {
    for (std::size_t k = 3 * i; from[q] != nullptr && k < 3 * end; ++k) rest[q][k - 3 * i] = from[q][k];
  }
  add_four({rest[0], rest[1], inertia, rest[2], rest[3]}, 0, half, h_bar, s);
}

/// a += s b for doubles [begin, end); with `also`, the same step is added there.
ABUT_INLINE void step(double* a, double* also, const double* b, double s, std::size_t begin, std::size_t end) {
  const Four factor(s);
  std::size_t k = begin;
  for (; k + 4 <= end; k += 4) {
    const Four d = factor * load4(b + k);
    simd::store(a + k, load4(a + k) + d);
    if (also != nullptr) simd::store(also + k, load4(also + k) + d);
  }
  for (; k < end; ++k) {
    const double d = s * b[k];
    a[k] += d;
    if (also != nullptr) also[k] += d;
  }
}

/// The step that translations or rotations allow.
struct Limit {
  const double *inertia, *stiffness;
  const std::uint8_t* free;
  bool rotation;
  /// Some of four nodes may be below; 0/0 of nodes without mass and stiffness compares false.
  [[gnu::always_inline]] inline bool may_be_below(std::size_t i, double square) const {
    return simd::any(Four(2.0) * load4(inertia + i) / load4(stiffness + i) < Four(square));
  }
  [[gnu::always_inline]] inline void look(std::size_t i, LimitLeaf& leaf) const {
    if (free != nullptr && free[i] == 0) return;
    if (!(inertia[i] > 0.0)) return;
    const double square = 2.0 * inertia[i] / stiffness[i];
    if (square < leaf.square) leaf = {square, static_cast<std::int64_t>(i), rotation};
  }
};

}  // namespace

void assemble_nodes(const AssembleArgs& args, std::size_t begin, std::size_t end) {
  const Four zero(0.0);
  const bool rotations = args.alpha != nullptr;
  for (std::size_t i = begin; i < end; ++i) {
    Four force = zero, moment = zero;  // and the stiffness in the last place
    if (args.shell_first != nullptr) {
      const std::uint32_t first = args.shell_first[i], last = args.shell_first[i + 1];
      ask_for_entries(args.sums, args.shell_at, first, last);
      add_entries(args.sums, args.shell_at, first, last, force);
      add_entries(args.sums + 4, args.shell_at, first, last, moment);
    }
    if (args.solid_first != nullptr) {
      const std::uint32_t first = args.solid_first[i], last = args.solid_first[i + 1];
      ask_for_entries(args.sums, args.solid_at, first, last);
      add_entries(args.sums, args.solid_at, first, last, force);
    }
    const double mass = args.mass[i];
    Four f = (args.f_external != nullptr ? simd::load3(args.f_external + 3 * i, 0.0) : zero) - force;
    double stiffness = simd::fourth(force);
    if (args.f_contact != nullptr) {
      f += simd::load3(args.f_contact + 3 * i, 0.0);
      stiffness += args.contact_stiffness[i];
    }
    simd::store3(args.f_internal + 3 * i, force);
    args.stiffness[i] = stiffness;
    if (args.f != nullptr) simd::store3(args.f + 3 * i, f);
    simd::store3(args.a + 3 * i, mass > 0.0 ? f / Four(mass) : zero);
    if (!rotations) continue;
    const double inertia = args.inertia[i];
    const Four m = (args.m_external != nullptr ? simd::load3(args.m_external + 3 * i, 0.0) : zero) - moment;
    simd::store3(args.m_internal + 3 * i, moment);
    args.rotational_stiffness[i] = simd::fourth(moment);
    if (args.m != nullptr) simd::store3(args.m + 3 * i, m);
    simd::store3(args.alpha + 3 * i, inertia > 0.0 ? m / Four(inertia) : zero);
  }
}

void limit_nodes(const LimitArgs& args, std::size_t begin, std::size_t end, LimitLeaf& leaf) {
  const bool rotations = args.inertia != nullptr;
  const Limit translation{args.mass, args.stiffness, args.free_translation, false};
  const Limit rotation{args.inertia, args.rotational_stiffness, args.free_rotation, true};
  for (std::size_t i = begin; i < end; i += 4) {
    const bool four = i + 4 <= end;
    if (four && !translation.may_be_below(i, leaf.square) && !(rotations && rotation.may_be_below(i, leaf.square))) continue;
    for (std::size_t k = i; k < (four ? i + 4 : end); ++k) {
      translation.look(k, leaf);
      if (rotations) rotation.look(k, leaf);
    }
  }
}

void sum_nodes(const MotionArgs& args, std::size_t begin, std::size_t end, KineticLeaf& leaf) {
  MovingSums s;
  sum_moving({args.v, args.a, args.mass, args.f_internal, args.f_contact}, args, begin, end, s);
  leaf.star = total(s.star);
  leaf.square = total(s.square);
  leaf.power_before = total(s.before);
  leaf.power_after = total(s.after);
  for (int k = 0; k < 3; ++k) leaf.momentum[k] = component(s.momentum, k);
  leaf.mass = 0.0;
  for (std::size_t i = begin; i < end; ++i) leaf.mass += args.mass[i];
  if (args.w == nullptr) return;
  sum_moving({args.w, args.alpha, args.inertia, args.m_internal, nullptr}, args, begin, end, s);
  leaf.rotation_star = total(s.star);
  leaf.rotation_square = total(s.square);
  leaf.rotation_power_before = total(s.before);
  leaf.rotation_power_after = total(s.after);
}

void integrate_nodes(const MotionArgs& args, std::size_t begin, std::size_t end) {
  step(args.v, nullptr, args.a, args.h_bar, 3 * begin, 3 * end);
  if (args.w != nullptr) step(args.w, nullptr, args.alpha, args.h_bar, 3 * begin, 3 * end);
  step(args.x, args.u, args.v, args.h_plus, 3 * begin, 3 * end);
}

}  // namespace abut::cycle::ABUT_ISA
