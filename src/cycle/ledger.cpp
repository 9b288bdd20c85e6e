#include "cycle/ledger.hpp"

#include "parallel/ordered_sum.hpp"

namespace abut::cycle {

KineticSums& KineticSums::operator+=(const KineticSums& b) {
  translation += b.translation;
  rotation += b.rotation;
  mass += b.mass;
  momentum += b.momentum;
  return *this;
}

KineticSums Ledger::kinetic(const state::State& s, bool product_form, parallel::ThreadPool& pool) {
  const double half = 0.5 * s.times.h_minus;
  const double h = s.times.h_bar;
  const bool first = s.times.cycle == 0;
  return parallel::ordered_sum(s.mass.size(), leaves_, pool, [&](std::size_t begin, std::size_t end) {
    KineticSums sum;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 v = s.v[i] + half * s.a[i];
      const Vec3 w = s.w[i] + half * s.alpha[i];
      if (!product_form) {
        sum.translation += 0.5 * s.mass[i] * squared_norm(v);
        sum.rotation += 0.5 * s.inertia[i] * squared_norm(w);
      } else if (!first) {
        sum.translation += 0.5 * s.mass[i] * dot(s.v[i], s.v[i] + h * s.a[i]);
        sum.rotation += 0.5 * s.inertia[i] * dot(s.w[i], s.w[i] + h * s.alpha[i]);
      } else {
        // Cycle 0 kicks by half a step from v(0). Potentials are booked by the trapezoidal rule, which gives their first force
        // a whole step: h~^2 f.a/2 more work than the kick does. The start of the balance takes it off.
        sum.translation += 0.5 * (s.mass[i] * squared_norm(s.v[i]) - h * h * dot(s.f_contact[i] - s.f_internal[i], s.a[i]));
        sum.rotation += 0.5 * (s.inertia[i] * squared_norm(s.w[i]) + h * h * dot(s.m_internal[i], s.alpha[i]));
      }
      sum.mass += s.mass[i];
      sum.momentum += s.mass[i] * v;
    }
    return sum;
  });
}

double Ledger::close(const state::State& s, double kinetic, double constraint_work) {
  // Internal forces are subtracted from the nodes: their work carries a minus sign.
  works_ += constraint_work - elements_.settle(s, s.f_internal, s.m_internal) + contact_.settle(s, s.f_contact);
  return kinetic - start_ - works_;
}

}  // namespace abut::cycle
