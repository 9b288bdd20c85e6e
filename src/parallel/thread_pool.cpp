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

// A loop is cut into some pieces per thread. Every thread begins with a share of its own, which in all loops over the same things is the
// same part of them and so in its caches, and goes on with the pieces that others have not come to: a thread that the system has sent
// away, or whose pieces take longer, holds up no more than a piece. `left` counts the pieces of a share that nobody has taken; the loop is
// over when `unfinished` has fallen to zero. While a piece is unfinished the loop's data stay, so a thread reads them after it has taken a
// piece, never before. Counters are waited for awake for a while (the loops of a cycle follow each other within microseconds), then
// asleep: whoever changes them takes the mutex before it wakes others, so that nobody falls asleep over a change.
struct ThreadPool::Impl {
  static constexpr std::size_t pieces_per_thread = 8;
  struct alignas(64) Share {
    std::atomic<std::size_t> left{0};
  };

  std::vector<std::thread> workers;
  int patience = 0;  // turns of waiting awake
  std::mutex mutex;
  std::condition_variable start;
  std::condition_variable done;
  Call call = nullptr;
  const void* body = nullptr;
  std::size_t count = 0;
  std::size_t pieces = 0;
  std::vector<Share> shares;  // one per thread, the caller's first
  std::atomic<std::size_t> unfinished{0};
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

  explicit Impl(std::size_t threads) : shares(threads) {}

  /// Pieces before those of a share.
  [[nodiscard]] std::size_t first_piece(std::size_t share) const { return pieces * share / shares.size(); }
  [[nodiscard]] bool any_left() const {
    return std::any_of(shares.begin(), shares.end(), [](const Share& s) { return s.left.load(std::memory_order_acquire) > 0; });
  }

  /// Takes pieces, its own first, and runs them until none is left.
  void run_pieces(std::size_t own) {
    for (std::size_t k = 0; k < shares.size(); ++k) run_share((own + k) % shares.size());
  }

  void run_share(std::size_t share) {
    std::atomic<std::size_t>& left = shares[share].left;
    std::size_t n = left.load(std::memory_order_acquire);
    while (n > 0) {
      if (!left.compare_exchange_weak(n, n - 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      run_piece(first_piece(share + 1) - n);
      if (unfinished.fetch_sub(1, std::memory_order_acq_rel) == 1) {
        const std::lock_guard lock(mutex);
        done.notify_one();
      }
      n = left.load(std::memory_order_acquire);
    }
  }

  void run_piece(std::size_t piece) {
    try {
      const std::size_t begin = count * piece / pieces;
      const std::size_t end = count * (piece + 1) / pieces;
      if (begin < end) call(body, begin, end);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
  }

  void work(std::size_t own) {
    for (;;) {
      wait(start, [this] { return quit.load(std::memory_order_acquire) || any_left(); });
      if (quit.load(std::memory_order_acquire)) return;
      run_pieces(own);
    }
  }
};

ThreadPool::ThreadPool(int threads) : impl_(std::make_unique<Impl>(static_cast<std::size_t>(std::max(threads, 1)))) {
  // Some 100 us, longer than what a cycle of a large model does on one thread between two loops: waking up costs as much. With more threads
  // than processors whoever waits awake keeps others from working.
  if (threads <= static_cast<int>(std::thread::hardware_concurrency())) impl_->patience = 5000;
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
  // While a piece is unfinished the caller is in one: a loop within a loop of the same pool.
  if (most <= 1 || impl_->workers.empty() || impl_->unfinished.load(std::memory_order_acquire) > 0) {
    call(body, 0, count);
    return;
  }
  impl_->call = call;
  impl_->body = body;
  impl_->count = count;
  impl_->pieces = std::min(most, Impl::pieces_per_thread * (impl_->workers.size() + 1));
  impl_->error = nullptr;
  impl_->unfinished.store(impl_->pieces, std::memory_order_relaxed);
  {
    const std::lock_guard lock(impl_->mutex);
    for (std::size_t s = 0; s < impl_->shares.size(); ++s) {
      impl_->shares[s].left.store(impl_->first_piece(s + 1) - impl_->first_piece(s), std::memory_order_release);
    }
  }
  impl_->start.notify_all();
  impl_->run_pieces(0);
  impl_->wait(impl_->done, [this] { return impl_->unfinished.load(std::memory_order_acquire) == 0; });
  if (impl_->error) std::rethrow_exception(impl_->error);
}

}  // namespace abut::parallel
