// An interface as Python holds it, and what the files contact*.cpp share.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "abut/contact/interface.hpp"
#include "parallel/thread_pool.hpp"

namespace abut::python {

/// An interface with what its host need not know: how many nodes it reads, the steps that were committed.
struct HeldInterface {
  HeldInterface(contact::Interface i, pybind11::ssize_t needed, std::array<pybind11::ssize_t, 2> f, std::array<pybind11::ssize_t, 2> h)
      : interface(std::move(i)), nodes_needed(needed), facets(f), held(h) {}

  std::ofstream log;  ///< of record(); goes after the interface that writes to it
  contact::Interface interface;
  pybind11::ssize_t nodes_needed;
  std::array<pybind11::ssize_t, 2> facets, held;  ///< of each side
  double last_step = 0.0, step_before = 0.0;
  bool evaluated = false;
  bool busy = false;  ///< another thread is inside, without the lock of the interpreter
  std::shared_ptr<parallel::ThreadPool> pool;
};

/// The interpreter's lock is free while an interface works; a second thread that comes in is refused, also one that only looks.
class Work {
 public:
  explicit Work(HeldInterface& i) : interface_(i) {
    if (i.busy) throw std::runtime_error("this interface is at work in another thread");
    i.busy = true;
  }
  ~Work() { interface_.busy = false; }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

 private:
  HeldInterface& interface_;
};

using InterfaceClass = pybind11::class_<HeldInterface>;

void bind_interface_looks(InterfaceClass& interface);

}  // namespace abut::python
