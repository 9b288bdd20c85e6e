#include "state/state.hpp"

namespace abut::state {

State State::zeros(Index n) {
  const auto count = static_cast<std::size_t>(n);
  State s;
  for (std::vector<Vec3>* array :
       {&s.x, &s.v, &s.w, &s.u, &s.a, &s.alpha, &s.f, &s.m, &s.f_internal, &s.m_internal, &s.f_external, &s.m_external, &s.f_contact}) {
    array->resize(count);
  }
  for (std::vector<double>* array : {&s.mass, &s.inertia, &s.stiffness, &s.rotational_stiffness}) array->resize(count);
  return s;
}

}  // namespace abut::state
