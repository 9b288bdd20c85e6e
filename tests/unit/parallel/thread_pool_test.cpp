// Loops of the thread pool: ranges that cover every index once, exceptions that reach the caller, loops within loops, tasks side by side,
// and sums whose order depends on the number of terms only.
#include "parallel/thread_pool.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "abut/diagnostic.hpp"
#include "parallel/ordered_sum.hpp"

namespace abut::parallel {
namespace {

using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

/// The ranges of one loop, in ascending order.
Ranges ranges_of(ThreadPool& pool, std::size_t count, std::size_t grain) {
  Ranges found;
  std::mutex mutex;
  pool.for_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    found.emplace_back(begin, end);
  });
  std::sort(found.begin(), found.end());
  return found;
}

// Before a thread is started.
TEST(ThreadPool, MoreThreadsThanTheLimitAreRefused) {
  try {
    const ThreadPool pool(most_threads + 1);
    FAIL() << "4097 threads were started";
  } catch (const std::invalid_argument& error) { EXPECT_STREQ(error.what(), "threads is 4097, expected at most 4096"); }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadow memory is not for limits
/// In a process of its own: a pool of 1000 threads where there is memory for the stacks of a few more.
[[noreturn]] void make_too_many() {
  ::alarm(20);
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const auto bytes = static_cast<rlim_t>(pages * ::sysconf(_SC_PAGESIZE)) + 100'000'000;
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &limit);
  try {
    const ThreadPool pool(1000);
  } catch (const RunError& error) {
    std::fprintf(stderr, "%s", error.what());
    std::exit(3);
  }
  std::exit(4);
}

// Those that were made end, and the message says what to do.
TEST(ThreadPool, ThreadsThatCannotBeMadeAreAnError) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(make_too_many(), testing::ExitedWithCode(3), "cannot make 1000 threads, only [1-9][0-9]? \\(.*\\); ask for fewer");
}
#endif

// Sorted, no range empty, each begins where the one before ends: every index of [0, count) once.
TEST(ThreadPool, RangesCoverEveryIndexOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (const std::size_t count : {0UL, 1UL, 2UL, 3UL, 7UL, 31UL, 32UL, 33UL, 100UL, 1009UL, 65537UL}) {
      for (const std::size_t grain : {0UL, 1UL, 2UL, 8UL, 64UL, 100000UL}) {
        std::size_t next = 0;
        for (const auto& [begin, end] : ranges_of(pool, count, grain)) {
          EXPECT_EQ(begin, next) << threads << " threads, " << count << " by " << grain;
          EXPECT_LT(begin, end) << threads << " threads, " << count << " by " << grain;
          next = end;
        }
        EXPECT_EQ(next, count) << threads << " threads, " << count << " by " << grain;
      }
    }
  }
}

// No more pieces than the grain allows: a loop shorter than a grain is one piece.
TEST(ThreadPool, PiecesAreNotFinerThanTheGrain) {
  ThreadPool pool(4);
  for (const std::size_t count : {1UL, 63UL, 64UL, 65UL, 640UL, 641UL}) {
    EXPECT_LE(ranges_of(pool, count, 64).size(), (count + 63) / 64) << count;
  }
}

// Each index is written by whoever has it, without a lock; many loops in a row, as in a run.
TEST(ThreadPool, ManyShortLoopsInARowLoseNothing) {
  for (const int threads : {2, 4}) {
    ThreadPool pool(threads);
    std::vector<std::uint32_t> visits(257, 0);
    constexpr std::uint32_t loops = 20000;
    for (std::uint32_t i = 0; i < loops; ++i) {
      pool.for_ranges(visits.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) ++visits[k];
      });
    }
    EXPECT_EQ(std::count(visits.begin(), visits.end(), loops), 257) << threads;
  }
}

// The exception reaches the caller after every other piece has run, and the pool works on.
TEST(ThreadPool, AnExceptionReachesTheCallerAfterAllPieces) {
  for (const int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    const std::size_t pieces = ranges_of(pool, 1000, 1).size();
    for (const std::size_t bad : {0UL, 499UL, 999UL}) {
      std::atomic<std::size_t> ran{0};
      std::string message;
      try {
        pool.for_ranges(1000, 1, [&](std::size_t begin, std::size_t end) {
          ++ran;
          if (begin <= bad && bad < end) throw std::runtime_error("at " + std::to_string(bad));
        });
      } catch (const std::runtime_error& error) { message = error.what(); }
      EXPECT_EQ(message, "at " + std::to_string(bad)) << threads;
      EXPECT_EQ(ran, pieces) << threads;
    }
    std::size_t thrown = 0;
    try {
      pool.for_ranges(1000, 1, [](std::size_t begin, std::size_t) { throw begin; });
    } catch (std::size_t) { ++thrown; }
    EXPECT_EQ(thrown, 1U) << "one of many exceptions is thrown on, " << threads;
    EXPECT_FALSE(ranges_of(pool, 1000, 1).empty()) << "the pool works on";
  }
}

// Within a loop: another pool, and loops on the same pool (they run where they are).
TEST(ThreadPool, LoopsWithinALoop) {
  ThreadPool pool(3);
  std::vector<std::vector<int>> visits(24, std::vector<int>(50, 0));
  pool.for_ranges(visits.size(), 1, [&](std::size_t begin, std::size_t end) {
    ThreadPool inner(2);
    for (std::size_t row = begin; row < end; ++row) {
      const auto visit = [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) ++visits[row][k];
      };
      inner.for_ranges(50, 1, visit);
      pool.for_ranges(50, 1, visit);
    }
  });
  for (const auto& row : visits) EXPECT_EQ(std::count(row.begin(), row.end(), 2), 50);
}

// Two tasks with loops of their own, of different length: each loop covers its range, in the order of its task, and both have ended.
TEST(ThreadPool, TwoTasksSideBySide) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    std::array<std::vector<std::uint32_t>, 2> visits{std::vector<std::uint32_t>(257, 0), std::vector<std::uint32_t>(1009, 0)};
    std::array<bool, 2> in_order{true, true};
    constexpr std::uint32_t rounds = 300;
    for (std::uint32_t round = 0; round < rounds; ++round) {
      std::array<bool, 2> ended{};
      const auto task = [&](std::size_t which, std::uint32_t loops) {
        for (std::uint32_t k = 0; k < loops; ++k) {
          pool.for_ranges(visits[which].size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) ++visits[which][i];
          });
          const std::vector<std::uint32_t>& mine = visits[which];
          in_order[which] =
              in_order[which] && std::all_of(mine.begin(), mine.end(), [&](std::uint32_t n) { return n == round * loops + k + 1; });
        }
        ended[which] = true;
      };
      pool.both([&] { task(0, 7); }, [&] { task(1, 2); });
      ASSERT_TRUE(ended[0] && ended[1]) << threads;
    }
    EXPECT_TRUE(in_order[0] && in_order[1]) << threads;
  }
}

TEST(ThreadPool, AnExceptionOfATaskReachesTheCallerAfterBoth) {
  for (const int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    for (const auto& [first_throws, second_throws] : {std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
      std::atomic<int> visits{0};
      std::string message;
      const auto task = [&](const char* name, bool throws) {
        pool.for_ranges(100, 1, [&](std::size_t begin, std::size_t end) {
          visits += static_cast<int>(end - begin);
          if (throws && begin == 0) throw std::runtime_error(name);
        });
      };
      try {
        pool.both([&, throws = first_throws] { task("first", throws); }, [&, throws = second_throws] { task("second", throws); });
      } catch (const std::runtime_error& error) { message = error.what(); }
      EXPECT_EQ(message, second_throws ? "second" : "first") << threads;
      // On one thread a task that throws ends the pieces behind it, and the task behind it.
      if (threads > 1) { EXPECT_EQ(visits, 200) << threads; }
    }
    EXPECT_FALSE(ranges_of(pool, 1000, 1).empty()) << "the pool works on";
  }
}

// Tasks within a loop or a task run one after the other where they are; loops within the loops of tasks, too.
TEST(ThreadPool, TasksWithinLoopsAndTasks) {
  ThreadPool pool(3);
  std::vector<std::vector<int>> visits(24, std::vector<int>(50, 0));
  const auto visit = [&](std::size_t row) {
    pool.for_ranges(50, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) ++visits[row][k];
    });
  };
  const auto half = [&](std::size_t from) {
    pool.for_ranges(12, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = from + begin; row < from + end; ++row) pool.both([&] { visit(row); }, [&] { visit(row); });
    });
    pool.both([&] { visit(from); }, [&] { visit(from + 1); });
  };
  for (int again = 0; again < 200; ++again) pool.both([&] { half(0); }, [&] { half(12); });
  for (std::size_t row = 0; row < visits.size(); ++row) {
    const int each = row % 12 < 2 ? 600 : 400;
    EXPECT_EQ(std::count(visits[row].begin(), visits[row].end(), each), 50) << row;
  }
}

// 1 + 1e-16 + 1e-16 + ... depends on the order of its terms; the order is that of the leaves for any number of threads.
TEST(OrderedSum, HasTheSameBitsForAnyNumberOfThreads) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  for (const std::size_t count : {0UL, 1UL, 255UL, 256UL, 257UL, 2048UL, 100003UL}) {
    std::vector<double> terms(count);
    for (double& t : terms) t = std::exp2(exponent(random)) * ((random() & 1U) != 0U ? 1.0 : -1.0);
    const auto leaf = [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t i = begin; i < end; ++i) sum += terms[i];
      return sum;
    };
    double expected = 0.0;
    for (std::size_t i = 0; i < count; i += leaf_size) expected += leaf(i, std::min(count, i + leaf_size));
    for (const int threads : {1, 2, 3, 7}) {
      ThreadPool pool(threads);
      std::vector<double> scratch;
      for (int again = 0; again < 3; ++again) {
        const double sum = ordered_sum<double>(count, scratch, pool, leaf);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(sum), std::bit_cast<std::uint64_t>(expected))
            << count << " terms, " << threads << " threads";
      }
    }
  }
}

}  // namespace
}  // namespace abut::parallel
