// What the fixed order of sums costs: assembly of brick forces alone, ns per element, one thread, AVX2.
//
//   assembly_cost [bricks per edge] [repetitions]
//
//   chunks   as the program does it (elements/chunks.hpp): block -> sums of its chunk, then chunk sums -> node
//   direct   block -> node, nothing between: the fastest way there is, and right for one thread only
//   copies   direct, into a copy per thread (two), which are added at the end: other bits with every number of threads
// Slots of a block are in the first cache, as they are behind a kernel. All three read and write the same four components per node.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "elements/add_block.hpp"
#include "elements/chunks.hpp"
#include "init/locality.hpp"

namespace {

using namespace abut;

/// Nodes of n^3 bricks, #E by 8, in the order of the program.
std::vector<Index> bricks(int n) {
  const auto node = [n](int i, int j, int k) { return static_cast<Index>((k * (n + 1) + j) * (n + 1) + i); };
  std::vector<Index> order(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  for (std::size_t e = 0; e < order.size(); ++e) order[e] = static_cast<Index>(e);
  init::order_for_locality(order, [n](Index e) {
    return Vec3{static_cast<double>(e % n), static_cast<double>(e / n % n), static_cast<double>(e / n / n)};
  });
  std::vector<Index> nodes;
  for (const Index e : order) {
    const int i = e % n, j = e / n % n, k = e / n / n;
    for (const int up : {0, 1}) {
      for (const Index corner : {node(i, j, k + up), node(i + 1, j, k + up), node(i + 1, j + 1, k + up), node(i, j + 1, k + up)})
        nodes.push_back(corner);
    }
  }
  return nodes;
}

using simd::Four;

/// One block straight to the nodes. @param offsets  4 times the node, corner by corner, 8 lanes each
void add_direct(const double* slots, const std::int32_t* offsets, double* sums) {
  for (int k = 0; k < 8; ++k) {
    for (int lane = 0; lane < 8; lane += 4) {
      const double* s = slots + k * 32 + lane;
      Four m[4] = {simd::load4(s), simd::load4(s + 8), simd::load4(s + 16), simd::load4(s + 24)};
      simd::transpose(m);
      for (int l = 0; l < 4; ++l) {
        double* sum = sums + offsets[k * 8 + lane + l];
        simd::store(sum, simd::load4(sum) + m[l]);
      }
    }
  }
}

template <class Body>
double least_ns(int repetitions, std::size_t elements, Body&& body) {
  double best = 1e30;
  for (int r = 0; r < repetitions; ++r) {
    const auto start = std::chrono::steady_clock::now();
    body();
    const std::chrono::duration<double, std::nano> t = std::chrono::steady_clock::now() - start;
    best = std::min(best, t.count() / static_cast<double>(elements));
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const int n = std::max(argc > 1 ? std::atoi(argv[1]) : 40, 2), repetitions = argc > 2 ? std::atoi(argv[2]) : 50;
  const std::vector<Index> nodes = bricks(n);
  const std::size_t count = nodes.size() / 8, blocks = count / 8;  // whole blocks only
  const std::size_t node_count = static_cast<std::size_t>(n + 1) * static_cast<std::size_t>(n + 1) * static_cast<std::size_t>(n + 1);
  const elements::ChunkTable chunks(nodes, 8, 4);
  std::vector<std::int32_t> offsets(blocks * 64);
  for (std::size_t e = 0; e < blocks * 8; ++e) {
    for (std::size_t k = 0; k < 8; ++k) offsets[(e / 8 * 8 + k) * 8 + e % 8] = 4 * nodes[e * 8 + k];
  }
  std::vector<std::uint32_t> first(node_count + 1, 0), at(chunks.nodes().size());
  for (const Index i : chunks.nodes()) ++first[static_cast<std::size_t>(i) + 1];
  for (std::size_t i = 0; i < node_count; ++i) first[i + 1] += first[i];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::size_t k = 0; k < at.size(); ++k) at[next[static_cast<std::size_t>(chunks.nodes()[k])]++] = static_cast<std::uint32_t>(4 * k);

  alignas(64) double slots[8 * 4 * 8];
  for (int i = 0; i < 256; ++i) slots[i] = 1.0 + 1e-3 * i;
  std::vector<double> sums(chunks.sum_count()), total(4 * node_count), copy(4 * node_count);

  const double by_chunks = least_ns(repetitions, count, [&] {
    for (std::size_t c = 0; c < static_cast<std::size_t>(chunks.size()); ++c) {
      double* own = sums.data() + chunks.sum_offset(c);
      std::fill_n(own, chunks.nodes(c).size() * 4, 0.0);
      for (std::size_t b = chunks.first_block(c); b < std::min(chunks.end_block(c), blocks); ++b)
        elements::add_block<8, 4>(slots, chunks.positions() + b * 64, own);
    }
    for (std::size_t i = 0; i < node_count; ++i) {
      Four sum(0.0);
      for (std::uint32_t j = first[i]; j < first[i + 1]; ++j) sum += simd::load4(sums.data() + at[j]);
      simd::store(total.data() + 4 * i, sum);
    }
  });
  const double direct = least_ns(repetitions, count, [&] {
    std::fill(total.begin(), total.end(), 0.0);
    for (std::size_t b = 0; b < blocks; ++b) add_direct(slots, offsets.data() + b * 64, total.data());
  });
  const double copies = least_ns(repetitions, count, [&] {
    std::fill(total.begin(), total.end(), 0.0);
    std::fill(copy.begin(), copy.end(), 0.0);
    for (std::size_t b = 0; b < blocks; ++b) add_direct(slots, offsets.data() + b * 64, b < blocks / 2 ? total.data() : copy.data());
    for (std::size_t i = 0; i < node_count; ++i)
      simd::store(total.data() + 4 * i, simd::load4(total.data() + 4 * i) + simd::load4(copy.data() + 4 * i));
  });
  std::printf("bricks,chunks_ns,direct_ns,copies_ns\n%zu,%.2f,%.2f,%.2f\n", count, by_chunks, direct, copies);
  return 0;
}
