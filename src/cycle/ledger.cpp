#include "cycle/ledger.hpp"

#include <utility>

#include "parallel/ordered_sum.hpp"

namespace abut::cycle {

KineticSums& KineticSums::operator+=(const KineticSums& b) {
  translation += b.translation;
  rotation += b.rotation;
  mass += b.mass;
  momentum += b.momentum;
  return *this;
}

Works& Works::operator+=(const Works& b) {
  kinetic += b.kinetic;
  elements += b.elements;
  contact += b.contact;
  loads += b.loads;
  constraints += b.constraints;
  return *this;
}

Ledger::Ledger(std::vector<std::uint8_t> counted)
    : counted_(std::move(counted)), v_entry_(counted_.size()), w_entry_(counted_.size()), previous_(counted_.size()) {}

KineticSums Ledger::kinetic(const state::State& s, parallel::ThreadPool& pool) {
  const double half = 0.5 * s.times.h_minus;
  return parallel::ordered_sum(s.mass.size(), kinetic_leaves_, pool, [&](std::size_t begin, std::size_t end) {
    KineticSums sum;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 v = s.v[i] + half * s.a[i];
      const Vec3 w = s.w[i] + half * s.alpha[i];
      sum.translation += 0.5 * s.mass[i] * squared_norm(v);
      sum.rotation += 0.5 * s.inertia[i] * squared_norm(w);
      sum.mass += s.mass[i];
      sum.momentum += s.mass[i] * v;
    }
    return sum;
  });
}

void Ledger::enter(const state::State& s) {
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    v_entry_[i] = s.v[i];
    w_entry_[i] = s.w[i];
  }
}

double Ledger::close(const state::State& s, parallel::ThreadPool& pool) {
  const double h = s.times.h_bar;
  const bool first = s.times.cycle == 0;
  const Works now = parallel::ordered_sum(counted_.size(), work_leaves_, pool, [&](std::size_t begin, std::size_t end) {
    Works sum;
    for (std::size_t i = begin; i < end; ++i) {
      if (counted_[i] == 0) continue;
      const Vec3 v = v_entry_[i];
      const Vec3 w = w_entry_[i];
      const Vec3 v_exit = s.v[i] + h * s.a[i];
      const Vec3 w_exit = s.w[i] + h * s.alpha[i];
      Impulses now_at;
      now_at.elements = -h * s.f_internal[i];
      now_at.contact = h * s.f_contact[i];
      now_at.loads = h * s.f_external[i];
      now_at.rest = s.mass[i] * (v_exit - v) - now_at.elements - now_at.contact - now_at.loads;
      now_at.angular_elements = -h * s.m_internal[i];
      now_at.angular_loads = h * s.m_external[i];
      now_at.angular_rest = s.inertia[i] * (w_exit - w) - now_at.angular_elements - now_at.angular_loads;
      Impulses& old = previous_[i];
      sum.elements += 0.5 * (dot(v, now_at.elements + old.elements) + dot(w, now_at.angular_elements + old.angular_elements));
      sum.contact += 0.5 * dot(v, now_at.contact + old.contact);
      sum.loads += 0.5 * (dot(v, now_at.loads + old.loads) + dot(w, now_at.angular_loads + old.angular_loads));
      sum.constraints += 0.5 * (dot(v, now_at.rest + old.rest) + dot(w, now_at.angular_rest + old.angular_rest));
      sum.kinetic += 0.5 * (s.mass[i] * dot(v, v_exit) + s.inertia[i] * dot(w, w_exit));
      if (first) sum.kinetic -= 0.5 * (s.mass[i] * dot(v, v) + s.inertia[i] * dot(w, w));
      old = now_at;
    }
    return sum;
  });
  works_.elements += now.elements;
  works_.contact += now.contact;
  works_.loads += now.loads;
  works_.constraints += now.constraints;
  works_.kinetic = now.kinetic;
  if (first) {
    // KE(0) = m v.v/2 and the half kick of cycle 0 is the first work: `kinetic` held the difference only.
    start_ = 0.0;
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      if (counted_[i] != 0) start_ += 0.5 * (s.mass[i] * squared_norm(v_entry_[i]) + s.inertia[i] * squared_norm(w_entry_[i]));
    }
    works_.kinetic += start_;
  }
  return works_.kinetic - start_ - works_.elements - works_.contact - works_.loads - works_.constraints;
}

}  // namespace abut::cycle
