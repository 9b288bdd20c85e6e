// A fixed set of threads that run one loop at a time, or the loops of two tasks side by side.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace abut::parallel {

/// More are refused: nobody has as many processors, and the system gives up long before a pool of 100 000 is made.
inline constexpr int most_threads = 4096;

/// Runs loops over ranges in parallel. Which thread takes which chunk never influences a result: bodies write only to
/// what belongs to their own range, and sums over a range are done afterwards in a fixed order.
class ThreadPool {
 public:
  /// @param threads number of threads that work, the caller included; at least 1
  /// @throws std::invalid_argument for more than most_threads; RunError when the system does not give so many
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int threads() const;

  /// Calls body(begin, end) on disjoint ranges that cover [0, count); returns when all are done.
  /// The first exception that a body throws is rethrown here after all bodies have ended. A loop that a body starts on the same pool runs
  /// on the thread of that body. Not for two threads that start loops at the same time.
  /// @param grain smallest range worth a thread of its own
  template <class Body>
  void for_ranges(std::size_t count, std::size_t grain, Body&& body) {
    using Plain = std::remove_reference_t<Body>;
    run(
        count, grain, [](const void* b, std::size_t begin, std::size_t end) { (*static_cast<Plain*>(const_cast<void*>(b)))(begin, end); },
        std::addressof(body));
  }

  /// Two tasks that do not touch each other's data, side by side; each may run loops on this pool. `first` runs on the caller's thread, and
  /// returns when both have ended. A thread that has nothing to do helps with the loops of either. With one thread, and within a loop or a
  /// task of this pool: `second`, then `first`. An exception of `second` is rethrown rather than one of `first`.
  template <class First, class Second>
  void both(First&& first, Second&& second) {
    using PlainFirst = std::remove_reference_t<First>;
    using PlainSecond = std::remove_reference_t<Second>;
    run_both([](const void* t) { (*static_cast<PlainFirst*>(const_cast<void*>(t)))(); }, std::addressof(first),
             [](const void* t) { (*static_cast<PlainSecond*>(const_cast<void*>(t)))(); }, std::addressof(second));
  }

 private:
  // Bodies and tasks without ownership: nothing is allocated per loop.
  using Call = void (*)(const void*, std::size_t, std::size_t);
  using Task = void (*)(const void*);
  void run(std::size_t count, std::size_t grain, Call call, const void* body);
  void run_both(Task first, const void* of_first, Task second, const void* of_second);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace abut::parallel
