// How far apart two threads are: ns in which a line of the caches goes from one core to another and back, the least of nine times 2000.
// Virtual machines move from one pair of cores to another while they run; two threads share the caches, or have to ask across the machine.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

int main() {
  constexpr int rounds = 2000, runs = 9;
  alignas(64) static std::atomic<int> ball{0};
  const auto wait_for = [](int value) {
    while (ball.load(std::memory_order_acquire) != value) {}
  };
  std::thread other([&] {
    for (int i = 0; i < runs * rounds; ++i) {
      wait_for(2 * i + 1);
      ball.store(2 * i + 2, std::memory_order_release);
    }
  });
  double least = 1e300;
  for (int run = 0; run < runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = run * rounds; i < (run + 1) * rounds; ++i) {
      ball.store(2 * i + 1, std::memory_order_release);
      wait_for(2 * i + 2);
    }
    least = std::min(least, 1e9 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / rounds);
  }
  other.join();
  std::printf("%.0f\n", least);
  return 0;
}
