#include "init/locality.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "elements/chunks.hpp"

namespace abut::init {

namespace {

struct Point {
  Vec3 x;
  Index element;
};

void halve(std::span<Point> points) {
  if (points.size() <= elements::lanes) {
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.element < b.element; });
    return;
  }
  Vec3 low = points[0].x, high = low;
  for (const Point& p : points) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p.x[k]);
      high[k] = std::max(high[k], p.x[k]);
    }
  }
  const Vec3 extent = high - low;
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (extent[k] > extent[axis]) axis = k;
  }
  // The first half fills whole chunks (powers of two of blocks), or else chunks would straddle halves.
  constexpr std::size_t largest_chunk = 64 * elements::lanes;
  std::size_t unit = elements::lanes;
  while (unit < largest_chunk && 4 * unit <= points.size()) unit *= 2;
  const std::size_t half = (points.size() / 2 + unit - 1) / unit * unit;
  std::nth_element(
      points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half), points.end(),
      [axis](const Point& a, const Point& b) { return a.x[axis] != b.x[axis] ? a.x[axis] < b.x[axis] : a.element < b.element; });
  halve(points.first(half));
  halve(points.subspan(half));
}

}  // namespace

void order_for_locality(std::vector<Index>& list, const std::function<Vec3(Index)>& centre) {
  std::vector<Point> points;
  points.reserve(list.size());
  for (const Index e : list) points.push_back({centre(e), e});
  halve(points);
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = points[i].element;
}

}  // namespace abut::init
