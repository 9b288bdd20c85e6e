#include "cycle/ledger.hpp"

#include "parallel/ordered_sum.hpp"

namespace abut::cycle {

Ledger::Leaf& Ledger::Leaf::operator+=(const Leaf& b) {
  kinetic.translation += b.kinetic.translation;
  kinetic.rotation += b.kinetic.rotation;
  kinetic.mass += b.kinetic.mass;
  kinetic.momentum += b.kinetic.momentum;
  kinetic.leapfrog += b.kinetic.leapfrog;
  internal_before += b.internal_before;
  internal_after += b.internal_after;
  contact_before += b.contact_before;
  contact_after += b.contact_after;
  return *this;
}

KineticSums Ledger::sum(const state::State& s, bool product_form, parallel::ThreadPool& pool) {
  const double half = 0.5 * s.times.h_minus;
  const double h = s.times.h_bar;
  // Cycle 0 kicks by half a step from v(0). Potentials are booked by the trapezoidal rule, which gives their first force a
  // whole step: h~^2 f.a/2 more work than the kick does. The start of the balance takes it off.
  const bool first = s.times.cycle == 0;
  const Leaf all = parallel::ordered_sum(s.mass.size(), leaves_, pool, [&](std::size_t begin, std::size_t end) {
    Leaf sum;
    KineticSums& k = sum.kinetic;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 before = s.v[i], a = s.a[i];
      const Vec3 after = before + h * a;
      const Vec3 now = before + half * a;
      const double m = s.mass[i];
      const double star = dot(before, after);
      const double start = first ? dot(before, before) * m - h * h * dot(s.f_contact[i] - s.f_internal[i], a) : m * star;
      k.translation += 0.5 * (product_form ? start : m * squared_norm(now));
      k.leapfrog += 0.5 * m * star;
      k.mass += m;
      k.momentum += m * now;
      sum.internal_before += dot(s.f_internal[i], before);
      sum.internal_after += dot(s.f_internal[i], after);
      sum.contact_before += dot(s.f_contact[i], before);
      sum.contact_after += dot(s.f_contact[i], after);
    }
    if (!rotations_) return sum;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 before = s.w[i], alpha = s.alpha[i];
      const Vec3 after = before + h * alpha;
      const double j = s.inertia[i];
      const double star = dot(before, after);
      const double start = first ? dot(before, before) * j + h * h * dot(s.m_internal[i], alpha) : j * star;
      k.rotation += 0.5 * (product_form ? start : j * squared_norm(before + half * alpha));
      k.leapfrog += 0.5 * j * star;
      sum.internal_before += dot(s.m_internal[i], before);
      sum.internal_after += dot(s.m_internal[i], after);
    }
    return sum;
  });
  // Internal forces are subtracted from the nodes: their work carries a minus sign.
  booked_ = 0.5 * h * (all.contact_before - all.internal_before) + second_half_;
  second_half_ = 0.5 * h * (all.contact_after - all.internal_after);
  return all.kinetic;
}

double Ledger::close(double kinetic, double constraint_work) {
  works_ += constraint_work + booked_;
  return kinetic - start_ - works_;
}

}  // namespace abut::cycle
