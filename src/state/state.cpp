#include "state/state.hpp"

#include <span>

namespace abut::state {

State State::zeros(Index n) {
  const auto count = static_cast<std::size_t>(n);
  State s;
  for (ZeroArray<Vec3>* array :
       {&s.x, &s.v, &s.w, &s.u, &s.a, &s.alpha, &s.f, &s.m, &s.f_internal, &s.m_internal, &s.f_external, &s.m_external, &s.f_contact}) {
    array->resize(count);
  }
  for (ZeroArray<double>* array : {&s.mass, &s.inertia, &s.stiffness, &s.rotational_stiffness}) array->resize(count);
  return s;
}

void State::persist(Archive& a) {
  a(times.cycle);
  a(times.t);
  a(times.h_minus);
  a(times.h_plus);
  a(times.h_bar);
  a(times.h_bar_old);
  for (ZeroArray<Vec3>* array :
       {&x, &v, &w, &u, &this->a, &alpha, &f, &m, &f_internal, &m_internal, &f_external, &m_external, &f_contact}) {
    a.fixed_or_zero(std::span(*array));
  }
  for (ZeroArray<double>* array : {&mass, &inertia, &stiffness, &rotational_stiffness}) a.fixed_or_zero(std::span(*array));
}

}  // namespace abut::state
