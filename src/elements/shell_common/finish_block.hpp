// What follows the forces of a block of shells: its slots into the sums of its chunk, its energies and step into the chunk's book.
#pragma once

#include "elements/add_block.hpp"
#include "elements/shell_common/kernel_args.hpp"
#include "elements/shell_common/section.hpp"

namespace abut::elements {

/// Lane by lane, so that the sums do not depend on the register width.
template <class T>
ABUT_INLINE void book_block(const ShellKernelArgs& args, std::size_t block) {
  using N = simd::NumberTraits<T>;
  ShellBook& book = *args.book;
  const double* state = args.state + block * static_cast<std::size_t>(args.section->variables * shell_lanes);
  const bool steps = args.section->step_wanted || !(args.h > 0.0);  // else all are 1e30
#pragma GCC unroll 8
  for (int l = 0; l < shell_lanes; l += N::width) {
    const auto value = [&](int variable) { return N::load(state + variable * shell_lanes + l); };
    const auto add = [l](double* sums, T a) { N::store(sums + l, N::load(sums + l) + a); };
    const T internal = value(shell_state::membrane_energy) + value(shell_state::bending_energy);
    const T hourglass = value(shell_state::hourglass_energy), zero = T(0.0);
    const auto on = value(shell_state::off) > zero;
    add(book.internal, select(on, internal, zero));
    add(book.hourglass, select(on, hourglass, zero));
    add(book.removed, select(on, zero, internal + hourglass));
    add(book.on, select(on, T(1.0), zero));
    if (!steps) continue;
    const T step = N::load(args.steps + block * args.step_stride + l), least = N::load(book.step + l);
    const auto smaller = step < least;
    N::store(book.step + l, select(smaller, step, least));
    N::store(book.block + l, select(smaller, T(static_cast<double>(block)), N::load(book.block + l)));
  }
}

template <class T, int corners>
ABUT_INLINE void finish_block(const ShellKernelArgs& args, std::size_t block) {
  if (args.sums != nullptr) {
    add_block<corners, 8>(args.slots + block * args.slot_stride, args.positions + block * (corners * shell_lanes), args.sums);
  }
  if (args.book != nullptr) book_block<T>(args, block);
}

}  // namespace abut::elements
