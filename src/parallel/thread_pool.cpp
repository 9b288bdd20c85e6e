#include "parallel/thread_pool.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "abut/diagnostic.hpp"

namespace abut::parallel {

namespace {

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

// A loop is cut into some pieces per thread. Every thread begins with a share of its own, which in all loops over the same things is the
// same part of them and so in its caches, and goes on with the pieces that others have not come to: a thread that the system has sent
// away, or whose pieces take longer, holds up no more than a piece. `left` counts the pieces of a share that nobody has taken; the loop is
// over when `unfinished` has fallen to zero. While a piece is unfinished the loop's data stay, so a thread reads them after it has taken a
// piece, never before.
struct Loop {
  static constexpr std::size_t pieces_per_thread = 8;
  struct alignas(64) Share {
    std::atomic<std::size_t> left{0};
  };

  void (*call)(const void*, std::size_t, std::size_t) = nullptr;
  const void* body = nullptr;
  std::size_t count = 0;
  std::size_t pieces = 0;
  std::vector<Share> shares;  // one per thread, the pool's owner's first
  std::atomic<std::size_t> unfinished{0};
  std::exception_ptr error;

  explicit Loop(std::size_t threads) : shares(threads) {}

  /// Pieces before those of a share.
  [[nodiscard]] std::size_t first_piece(std::size_t share) const { return pieces * share / shares.size(); }
  [[nodiscard]] bool any_left() const {
    return std::any_of(shares.begin(), shares.end(), [](const Share& s) { return s.left.load(std::memory_order_acquire) > 0; });
  }
  [[nodiscard]] bool over() const { return unfinished.load(std::memory_order_acquire) == 0; }
};

// The thread works for a task of a pool, or for one of its loops; both know by it whose loops they start.
struct Place {
  const void* pool;
  std::size_t thread;
  std::size_t loop;
  const Place* outer;  // the same of the pool in whose loop this one was started
};
thread_local const Place* here = nullptr;

class Entered {
 public:
  Entered(const void* pool, std::size_t thread, std::size_t loop) : place_{pool, thread, loop, here} { here = &place_; }
  ~Entered() { here = place_.outer; }
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;

 private:
  Place place_;
};

}  // namespace

// One loop of each of two tasks can be open. Counters are waited for awake for a while (the loops of a cycle follow each other within
// microseconds), then asleep: whoever changes them takes the mutex before it wakes others, so that nobody falls asleep over a change.
struct ThreadPool::Impl {
  enum : std::uint8_t { none, offered, taken, ended };  // of the second task

  std::vector<std::thread> workers;
  int patience = 0;  // turns of waiting awake
  std::mutex mutex;
  std::condition_variable start;
  std::condition_variable done;
  std::array<Loop, 2> loops;  // of the first task, or of the only one; of the second
  Task task = nullptr;
  const void* of_task = nullptr;
  std::atomic<std::uint8_t> second{none};
  std::exception_ptr task_error;
  std::atomic<bool> quit{false};

  explicit Impl(std::size_t threads) : loops{Loop(threads), Loop(threads)} {}
  ~Impl() {
    quit.store(true, std::memory_order_release);
    wake(start);
    for (std::thread& t : workers) t.join();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  template <class Ready>
  void wait(std::condition_variable& signal, Ready ready) {
    for (int i = 0; i < patience; ++i) {
      if (ready()) return;
      pause();
    }
    std::unique_lock lock(mutex);
    signal.wait(lock, ready);
  }
  void wake(std::condition_variable& signal) {
    { const std::lock_guard lock(mutex); }
    signal.notify_all();
  }

  [[nodiscard]] bool any_left() const { return loops[0].any_left() || loops[1].any_left(); }

  /// Takes pieces, the thread's own first, and runs them until none is left.
  void run_pieces(std::size_t which, std::size_t thread) {
    const std::size_t shares = loops[which].shares.size();
    for (std::size_t k = 0; k < shares; ++k) run_share(which, thread, (thread + k) % shares);
  }

  void run_share(std::size_t which, std::size_t thread, std::size_t share) {
    Loop& loop = loops[which];
    std::atomic<std::size_t>& left = loop.shares[share].left;
    std::size_t n = left.load(std::memory_order_acquire);
    while (n > 0) {
      if (!left.compare_exchange_weak(n, n - 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      const Entered entered(this, thread, which);
      run_piece(loop, loop.first_piece(share + 1) - n);
      if (loop.unfinished.fetch_sub(1, std::memory_order_acq_rel) == 1) wake(done);
      n = left.load(std::memory_order_acquire);
    }
  }

  void run_piece(Loop& loop, std::size_t piece) {
    try {
      const std::size_t begin = loop.count * piece / loop.pieces;
      const std::size_t end = loop.count * (piece + 1) / loop.pieces;
      if (begin < end) loop.call(loop.body, begin, end);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!loop.error) loop.error = std::current_exception();
    }
  }

  /// The second task, when it is offered and nobody else takes it.
  void run_second(std::size_t thread) {
    std::uint8_t state = offered;
    if (!second.compare_exchange_strong(state, taken, std::memory_order_acq_rel, std::memory_order_acquire)) return;
    try {
      const Entered entered(this, thread, 1);
      task(of_task);
    } catch (...) { task_error = std::current_exception(); }
    second.store(ended, std::memory_order_release);
    wake(start);  // whoever waits for it helps its loops
  }

  void help(std::size_t thread) {
    run_second(thread);
    for (std::size_t which = 0; which < loops.size(); ++which) run_pieces(which, thread);
  }

  void work(std::size_t thread) {
    for (;;) {
      wait(start,
           [this] { return quit.load(std::memory_order_acquire) || second.load(std::memory_order_acquire) == offered || any_left(); });
      if (quit.load(std::memory_order_acquire)) return;
      help(thread);
    }
  }
};

ThreadPool::ThreadPool(int threads) : impl_(std::make_unique<Impl>(static_cast<std::size_t>(std::clamp(threads, 1, most_threads)))) {
  if (threads > most_threads) {
    throw std::invalid_argument("threads is " + std::to_string(threads) + ", expected at most " + std::to_string(most_threads));
  }
  // Some 100 us, longer than what a cycle of a large model does on one thread between two loops: waking up costs as much. With more threads
  // than processors whoever waits awake keeps others from working.
  if (threads <= static_cast<int>(std::thread::hardware_concurrency())) impl_->patience = 5000;
  try {
    for (int i = 1; i < threads; ++i) {
      impl_->workers.emplace_back([pool = impl_.get(), i] { pool->work(static_cast<std::size_t>(i)); });
    }
  } catch (const std::exception& why) {
    throw RunError("cannot make " + std::to_string(threads) + " threads, only " + std::to_string(this->threads()) + " (" + why.what() +
                   "); ask for fewer, or raise the limit of processes or of memory (ulimit -u, ulimit -v)");
  }
}

ThreadPool::~ThreadPool() = default;

int ThreadPool::threads() const { return static_cast<int>(impl_->workers.size()) + 1; }

void ThreadPool::run(std::size_t count, std::size_t grain, Call call, const void* body) {
  if (count == 0) return;
  const Place* place = here;
  while (place != nullptr && place->pool != impl_.get()) place = place->outer;
  const std::size_t thread = place != nullptr ? place->thread : 0, which = place != nullptr ? place->loop : 0;
  Loop& loop = impl_->loops[which];
  const std::size_t most = (count + std::max<std::size_t>(grain, 1) - 1) / std::max<std::size_t>(grain, 1);
  // While a piece is unfinished the caller is in one: a loop within a loop of the same pool.
  if (most <= 1 || impl_->workers.empty() || !loop.over()) {
    call(body, 0, count);
    return;
  }
  loop.call = call;
  loop.body = body;
  loop.count = count;
  loop.pieces = std::min(most, Loop::pieces_per_thread * loop.shares.size());
  loop.error = nullptr;
  loop.unfinished.store(loop.pieces, std::memory_order_relaxed);
  for (std::size_t s = 0; s < loop.shares.size(); ++s) {
    loop.shares[s].left.store(loop.first_piece(s + 1) - loop.first_piece(s), std::memory_order_release);
  }
  impl_->wake(impl_->start);
  impl_->run_pieces(which, thread);
  impl_->wait(impl_->done, [&loop] { return loop.over(); });
  if (loop.error) std::rethrow_exception(loop.error);
}

void ThreadPool::run_both(Task first, const void* of_first, Task second, const void* of_second) {
  const Place* place = here;
  while (place != nullptr && place->pool != impl_.get()) place = place->outer;
  if (impl_->workers.empty() || place != nullptr) {
    second(of_second);
    first(of_first);
    return;
  }
  impl_->task = second;
  impl_->of_task = of_second;
  impl_->task_error = nullptr;
  impl_->second.store(Impl::offered, std::memory_order_release);
  impl_->wake(impl_->start);
  std::exception_ptr error;
  try {
    const Entered entered(impl_.get(), 0, 0);
    first(of_first);
  } catch (...) { error = std::current_exception(); }
  const auto ended = [this] { return impl_->second.load(std::memory_order_acquire) == Impl::ended; };
  while (!ended()) {
    impl_->help(0);
    impl_->wait(impl_->start, [&] { return ended() || impl_->any_left(); });
  }
  impl_->second.store(Impl::none, std::memory_order_relaxed);
  if (impl_->task_error) std::rethrow_exception(impl_->task_error);
  if (error) std::rethrow_exception(error);
}

}  // namespace abut::parallel
