#include "parallel/thread_pool.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace abut::parallel {

using Body = std::function<void(std::size_t, std::size_t)>;

struct ThreadPool::Impl {
  std::vector<std::thread> workers;
  std::mutex mutex;
  std::condition_variable start;
  std::condition_variable done;
  const Body* body = nullptr;
  std::size_t count = 0;
  std::size_t parts = 0;
  std::uint64_t generation = 0;
  std::size_t pending = 0;
  bool quit = false;
  std::exception_ptr error;

  void run_part(std::size_t part, const Body& f, std::size_t n, std::size_t p) {
    try {
      const std::size_t begin = n * part / p;
      const std::size_t end = n * (part + 1) / p;
      if (begin < end) f(begin, end);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
  }

  void work(std::size_t self) {
    std::uint64_t seen = 0;
    for (;;) {
      std::unique_lock lock(mutex);
      start.wait(lock, [&] { return quit || generation != seen; });
      if (quit) return;
      seen = generation;
      const Body* f = body;
      const std::size_t n = count;
      const std::size_t p = parts;
      lock.unlock();
      if (self < p) run_part(self, *f, n, p);
      lock.lock();
      if (--pending == 0) done.notify_one();
    }
  }
};

ThreadPool::ThreadPool(int threads) : impl_(std::make_unique<Impl>()) {
  for (int i = 1; i < threads; ++i) {
    impl_->workers.emplace_back([this, i] { impl_->work(static_cast<std::size_t>(i)); });
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->quit = true;
  }
  impl_->start.notify_all();
  for (std::thread& t : impl_->workers) t.join();
}

int ThreadPool::threads() const { return static_cast<int>(impl_->workers.size()) + 1; }

void ThreadPool::for_ranges(std::size_t count, std::size_t grain, const Body& body) {
  if (count == 0) return;
  const std::size_t most = (count + std::max<std::size_t>(grain, 1) - 1) / std::max<std::size_t>(grain, 1);
  const std::size_t parts = std::min<std::size_t>(most, impl_->workers.size() + 1);
  if (parts <= 1) {
    body(0, count);
    return;
  }
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->body = &body;
    impl_->count = count;
    impl_->parts = parts;
    impl_->pending = impl_->workers.size();
    impl_->error = nullptr;
    ++impl_->generation;
  }
  impl_->start.notify_all();
  impl_->run_part(0, body, count, parts);
  std::unique_lock lock(impl_->mutex);
  impl_->done.wait(lock, [&] { return impl_->pending == 0; });
  if (impl_->error) std::rethrow_exception(impl_->error);
}

}  // namespace abut::parallel
