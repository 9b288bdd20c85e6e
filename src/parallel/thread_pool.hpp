// A fixed set of threads that run one loop at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace abut::parallel {

/// Runs loops over ranges in parallel. Which thread takes which chunk never influences a result: bodies write only to
/// what belongs to their own range, and sums over a range are done afterwards in a fixed order.
class ThreadPool {
 public:
  /// @param threads number of threads that work, the caller included; at least 1
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int threads() const;

  /// Calls body(begin, end) on disjoint ranges that cover [0, count); returns when all are done.
  /// The first exception that a body throws is rethrown here after all bodies have ended.
  /// @param grain smallest range worth a thread of its own
  void for_ranges(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace abut::parallel
