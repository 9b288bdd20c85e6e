// A run as Python holds it, and what the files run*.cpp share.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "abut/run.hpp"

namespace abut::python {

/// `going` is read and written under the interpreter's lock: true while a thread is inside without it.
struct HeldRun {
  std::atomic<bool> interrupt = false;
  bool going = false;
  std::int64_t edits = 0;  ///< times that velocities were changed from outside
  std::unique_ptr<Run> run;
  const Vec3* own_velocities = nullptr;  ///< what velocities() shows while nothing is edited
  const Vec3* own_angular = nullptr;

  [[nodiscard]] Run& idle() const {
    if (going) throw std::runtime_error("the run goes on in another thread: look at it from a callback, or when it has stopped");
    return *run;
  }
};

using RunClass = pybind11::class_<HeldRun>;

/// A result with the interface it is of, and the nodes that its spans show until the next cycle only.
struct NamedResult {
  NamedResult(Id of, const InterfaceResult& r)
      : id(of), result(r), crossed(r.crossed.begin(), r.crossed.end()), lost(r.lost.begin(), r.lost.end()) {
    result.crossed = result.lost = {};
  }

  Id id;
  InterfaceResult result;
  std::vector<Index> crossed, lost;
};

void bind_results(pybind11::module_& m);
void bind_making(RunClass& run);
void bind_going(RunClass& run);

}  // namespace abut::python
