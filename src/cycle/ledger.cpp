#include "cycle/ledger.hpp"

#include "parallel/ordered_sum.hpp"

namespace abut::cycle {

Ledger::Leaf& Ledger::Leaf::operator+=(const Leaf& b) {
  star += b.star;
  square += b.square;
  rotation_star += b.rotation_star;
  rotation_square += b.rotation_square;
  power_before += b.power_before;
  power_after += b.power_after;
  rotation_power_before += b.rotation_power_before;
  rotation_power_after += b.rotation_power_after;
  mass += b.mass;
  for (int k = 0; k < 3; ++k) momentum[k] += b.momentum[k];
  return *this;
}

KineticSums Ledger::sum(const state::State& s, bool product_form, parallel::ThreadPool& pool) {
  const double h = s.times.h_bar;
  MotionArgs args;
  args.f_internal = &s.f_internal.data()->x;
  args.f_contact = &s.f_contact.data()->x;
  args.m_internal = &s.m_internal.data()->x;
  args.mass = s.mass.data();
  args.inertia = s.inertia.data();
  args.a = &s.a.data()->x;
  args.alpha = &s.alpha.data()->x;
  args.v = const_cast<double*>(&s.v.data()->x);  // the sums write nothing
  args.w = rotations_ ? const_cast<double*>(&s.w.data()->x) : nullptr;
  args.half = 0.5 * s.times.h_minus;
  args.h_bar = h;
  const NodeKernels& kernels = node_kernels();
  const Leaf all = parallel::ordered_sum(s.mass.size(), leaves_, pool, [&](std::size_t begin, std::size_t end) {
    Leaf leaf;
    kernels.sum(args, begin, end, leaf);
    return leaf;
  });
  KineticSums kinetic;
  kinetic.translation = 0.5 * (product_form ? all.star : all.square);
  kinetic.rotation = 0.5 * (product_form ? all.rotation_star : all.rotation_square);
  if (product_form && s.times.cycle == 0) {
    // Cycle 0 kicks by half a step from v(0), which v(n) is then. Potentials are booked by the trapezoidal rule, which gives their first
    // force a whole step: h~^2 f.a/2 more work than the kick does, h~ a = v' - v. The start of the balance takes it off.
    kinetic.translation = 0.5 * (all.square - h * (all.power_after - all.power_before));
    kinetic.rotation = 0.5 * (all.rotation_square - h * (all.rotation_power_after - all.rotation_power_before));
  }
  kinetic.leapfrog = 0.5 * (all.star + all.rotation_star);
  kinetic.mass = all.mass;
  kinetic.momentum = {all.momentum[0], all.momentum[1], all.momentum[2]};
  booked_ = 0.5 * h * (all.power_before + all.rotation_power_before) + second_half_;
  second_half_ = 0.5 * h * (all.power_after + all.rotation_power_after);
  return kinetic;
}

double Ledger::close(double kinetic, double constraint_work) {
  works_ += constraint_work + booked_;
  return kinetic - start_ - works_;
}

}  // namespace abut::cycle
