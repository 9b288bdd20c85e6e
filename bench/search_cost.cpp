// The two candidates for the contact search, measured alone: a box tree (contact/search/box_tree.hpp) and a uniform grid (here).
//
//   search_cost [NODES_MOST [ONLY]]   CSV rows: surface, nodes, facets, search, found, ns_build, ns_query: per node, and a check that both
//                                     find the same. ONLY, e.g. flat,tree: that one alone, in the largest size (for instruction counts)
//
// A sheet of N nodes is searched by as many points above it, each with a box of 0.75 facets around it, as held nodes do. flat: facets of
// size 1. curved: the same on two thirds of a cylinder. mixed: half of the facets of size 1, half of size 100. CPU time of one thread, the
// median of five.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "contact/search/box_tree.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::contact::Bounds;
using abut::contact::BoxTree;

double seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Boxes in the cells of a uniform grid, cells in a hash table (the bounding box of a curved sheet has far more cells than facets): built
/// by counting, O(N). A box is visited once, from the lowest cell that it shares with the query.
class UniformGrid {
 public:
  void build(const std::vector<Bounds>& boxes) {
    boxes_ = boxes;
    double sum = 0.0;
    for (const Bounds& b : boxes) {
      const Vec3 w = b.high - b.low;
      sum += std::max({w.x, w.y, w.z});
    }
    cell_ = sum / static_cast<double>(boxes.size());
    std::size_t entries = 0;
    for (const Bounds& b : boxes) over(b, [&](const Cell&) { ++entries; });
    buckets_ = 1;
    while (buckets_ < entries) buckets_ *= 2;
    first_.assign(buckets_ + 1, 0);
    items_.resize(entries);
    for (const Bounds& b : boxes) over(b, [&](const Cell& c) { ++first_[bucket(c) + 1]; });
    for (std::size_t k = 0; k < buckets_; ++k) first_[k + 1] += first_[k];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      over(boxes[i], [&](const Cell& c) { items_[next[bucket(c)]++] = {c, static_cast<Index>(i)}; });
    }
  }
  template <class Visit>
  void query(const Bounds& query, Visit&& visit) const {
    const Cell low = cell_of(query.low);
    over(query, [&](const Cell& c) {
      const std::size_t b = bucket(c);
      for (std::uint32_t k = first_[b]; k < first_[b + 1]; ++k) {
        const Item& item = items_[k];
        if (item.cell != c) continue;
        const Bounds& box = boxes_[static_cast<std::size_t>(item.box)];
        if (!box.meets(query)) continue;
        const Cell its = cell_of(box.low);
        const Cell shared{std::max(low[0], its[0]), std::max(low[1], its[1]), std::max(low[2], its[2])};
        if (shared == c) visit(item.box);
      }
    });
  }

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Item {
    Cell cell;
    Index box;
  };
  double cell_ = 1.0;
  std::size_t buckets_ = 1;
  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> first_;
  std::vector<Item> items_;

  [[nodiscard]] Cell cell_of(const Vec3& x) const {
    return {static_cast<std::int32_t>(std::floor(x.x / cell_)), static_cast<std::int32_t>(std::floor(x.y / cell_)),
            static_cast<std::int32_t>(std::floor(x.z / cell_))};
  }
  [[nodiscard]] std::size_t bucket(const Cell& c) const {
    const auto u = [](std::int32_t i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
    std::uint64_t h = (u(c[0]) * 0x9E3779B97F4A7C15ULL) ^ (u(c[1]) * 0xC2B2AE3D27D4EB4FULL) ^ (u(c[2]) * 0x165667B19E3779F9ULL);
    h ^= h >> 32;
    return static_cast<std::size_t>(h) & (buckets_ - 1);
  }
  template <class Body>
  void over(const Bounds& b, Body&& body) const {
    const Cell low = cell_of(b.low), high = cell_of(b.high);
    for (std::int32_t i = low[0]; i <= high[0]; ++i) {
      for (std::int32_t j = low[1]; j <= high[1]; ++j) {
        for (std::int32_t k = low[2]; k <= high[2]; ++k) body(Cell{i, j, k});
      }
    }
  }
};

struct Scene {
  std::vector<Bounds> facets, points;
};

/// n by n nodes.
Scene scene(const std::string& surface, int n) {
  const double radius = 2.0 * n / 3.0;
  const auto line = [&](double u) {  // of the mixed sheet: half of the columns 100 wide
    const double half = 0.5 * n;
    return surface != "mixed" || u <= half ? u : half + 100.0 * (u - half);
  };
  const auto at = [&](double i, double j, double height) -> Vec3 {
    if (surface != "curved") return {line(i), line(j), height};
    return {(radius + height) * std::sin(i / radius), j, (radius + height) * std::cos(i / radius)};
  };
  Scene s;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Vec3 x = at(i + 0.31, j + 0.37, 0.05);
      Bounds box{x, x};
      box.inflate(0.75);
      s.points.push_back(box);
      if (i + 1 == n || j + 1 == n) continue;
      Bounds facet;
      for (const auto& [a, b] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) facet.include(at(i + a, j + b, 0.0));
      s.facets.push_back(facet);
    }
  }
  return s;
}

/// The library's tree, as it is used.
class Tree {
 public:
  void build(const std::vector<Bounds>& boxes) {
    tree_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) tree_.set(static_cast<Index>(i), boxes[i]);
    tree_.update();
  }
  template <class Visit>
  void query(const Bounds& box, Visit&& visit) const {
    tree_.query(box, visit);
  }

 private:
  BoxTree tree_;
};

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

/// @return sum over all visits that does not depend on their order
template <class Search>
std::uint64_t measure(const char* name, const std::string& surface, const Scene& s, int repeat) {
  std::vector<double> build, query;
  std::uint64_t digest = 0, found = 0;
  for (int r = 0; r < repeat; ++r) {
    Search search;
    const double start = seconds();
    search.build(s.facets);
    const double built = seconds();
    digest = found = 0;
    for (std::size_t p = 0; p < s.points.size(); ++p) {
      search.query(s.points[p], [&](Index f) {
        // The tree's boxes are a little larger.
        if (!s.facets[static_cast<std::size_t>(f)].meets(s.points[p])) return;
        digest += (p + 1) * (static_cast<std::uint64_t>(f) + 1);
        ++found;
      });
    }
    build.push_back(built - start);
    query.push_back(seconds() - built);
  }
  const double per = 1e9 / static_cast<double>(s.points.size());
  std::printf("%s,%zu,%zu,%s,%.2f,%.1f,%.1f\n", surface.c_str(), s.points.size(), s.facets.size(), name,
              static_cast<double>(found) / static_cast<double>(s.points.size()), per * median(build), per * median(query));
  std::fflush(stdout);
  return digest;
}

}  // namespace

int main(int argc, char** argv) {
  const int most = argc > 1 ? std::atoi(argv[1]) : 1000000;
  const std::string only = argc > 2 ? argv[2] : "";
  std::printf("surface,nodes,facets,search,found,ns_build,ns_query\n");
  bool same = true;
  for (const std::string surface : {"flat", "curved", "mixed"}) {
    for (int nodes = only.empty() ? 1000 : most; nodes <= most; nodes *= 10) {
      const bool tree = only.empty() || only == surface + ",tree", grid = only.empty() || only == surface + ",grid";
      if (!tree && !grid && only != surface + ",none") continue;
      const Scene s = scene(surface, static_cast<int>(std::lround(std::sqrt(nodes))));
      const int repeat = only.empty() ? 5 : 1;
      const std::uint64_t a = tree ? measure<Tree>("tree", surface, s, repeat) : 0;
      const std::uint64_t b = grid ? measure<UniformGrid>("grid", surface, s, repeat) : 0;
      same = same && (a == b || !only.empty());
    }
  }
  if (!same) std::fprintf(stderr, "search_cost: tree and grid do not find the same facets\n");
  return same ? 0 : 1;
}
