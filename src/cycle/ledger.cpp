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
  // Cycle 0 kicks by half a step from v(0): its leap-frog neighbours are v(0) -+ h~ a, and their product is v.v - (h~ a)^2.
  const double back = s.times.cycle == 0 ? h : 0.0;
  return parallel::ordered_sum(s.mass.size(), leaves_, pool, [&](std::size_t begin, std::size_t end) {
    KineticSums sum;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 v = s.v[i] + half * s.a[i];
      const Vec3 w = s.w[i] + half * s.alpha[i];
      const double vv = product_form ? dot(s.v[i] - back * s.a[i], s.v[i] + h * s.a[i]) : squared_norm(v);
      const double ww = product_form ? dot(s.w[i] - back * s.alpha[i], s.w[i] + h * s.alpha[i]) : squared_norm(w);
      sum.translation += 0.5 * s.mass[i] * vv;
      sum.rotation += 0.5 * s.inertia[i] * ww;
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
