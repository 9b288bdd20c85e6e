#include "parallel/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace abut::parallel {

namespace {

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

// A loop is handed out by raising `generation` and is over when `pending` has fallen to zero. Both are waited for awake for a while
// (the loops of a cycle follow each other within microseconds), then asleep: whoever changes them takes the mutex before it wakes
// others, so that nobody falls asleep over a change.
struct ThreadPool::Impl {
  std::vector<std::thread> workers;
  int patience = 0;  // turns of waiting awake
  std::mutex mutex;
  std::condition_variable start;
  std::condition_variable done;
  Call call = nullptr;
  const void* body = nullptr;
  std::size_t count = 0;
  std::size_t parts = 0;
  std::atomic<std::uint64_t> generation{0};
  std::atomic<std::size_t> pending{0};
  std::atomic<bool> quit{false};
  std::exception_ptr error;

  template <class Ready>
  void wait(std::condition_variable& signal, Ready ready) {
    for (int i = 0; i < patience; ++i) {
      if (ready()) return;
      pause();
    }
    std::unique_lock lock(mutex);
    signal.wait(lock, ready);
  }

  void run_part(std::size_t part) {
    try {
      const std::size_t begin = count * part / parts;
      const std::size_t end = count * (part + 1) / parts;
      if (begin < end) call(body, begin, end);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
  }

  void work(std::size_t self) {
    std::uint64_t seen = 0;
    for (;;) {
      wait(start, [&] { return quit.load(std::memory_order_acquire) || generation.load(std::memory_order_acquire) != seen; });
      if (quit.load(std::memory_order_acquire)) return;
      ++seen;
      if (self < parts) run_part(self);
      if (pending.fetch_sub(1, std::memory_order_acq_rel) == 1) {
        const std::lock_guard lock(mutex);
        done.notify_one();
      }
    }
  }
};

ThreadPool::ThreadPool(int threads) : impl_(std::make_unique<Impl>()) {
  // About 50 us. With more threads than processors whoever waits awake keeps others from working.
  if (threads <= static_cast<int>(std::thread::hardware_concurrency())) impl_->patience = 1000;
  for (int i = 1; i < threads; ++i) {
    impl_->workers.emplace_back([this, i] { impl_->work(static_cast<std::size_t>(i)); });
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->quit.store(true, std::memory_order_release);
  }
  impl_->start.notify_all();
  for (std::thread& t : impl_->workers) t.join();
}

int ThreadPool::threads() const { return static_cast<int>(impl_->workers.size()) + 1; }

void ThreadPool::run(std::size_t count, std::size_t grain, Call call, const void* body) {
  if (count == 0) return;
  const std::size_t most = (count + std::max<std::size_t>(grain, 1) - 1) / std::max<std::size_t>(grain, 1);
  const std::size_t parts = std::min<std::size_t>(most, impl_->workers.size() + 1);
  if (parts <= 1) {
    call(body, 0, count);
    return;
  }
  impl_->call = call;
  impl_->body = body;
  impl_->count = count;
  impl_->parts = parts;
  impl_->error = nullptr;
  impl_->pending.store(impl_->workers.size(), std::memory_order_relaxed);
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->generation.fetch_add(1, std::memory_order_acq_rel);
  }
  impl_->start.notify_all();
  impl_->run_part(0);
  impl_->wait(impl_->done, [this] { return impl_->pending.load(std::memory_order_acquire) == 0; });
  if (impl_->error) std::rethrow_exception(impl_->error);
}

}  // namespace abut::parallel
