// Many numbers of which few differ.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace abut::simd {

/// The same bits as the numbers that it is made of. On an even mesh few of them differ (areas, depths, nodal masses): as long as a `Number`
/// can count them each takes one, and where all are alike they take the room of one.
template <class Number>
class FewValues {
 public:
  FewValues() = default;
  explicit FewValues(std::vector<double> values) : count_(values.size()) {
    constexpr std::size_t most = std::size_t{std::numeric_limits<Number>::max()} + 1;
    std::unordered_map<std::uint64_t, Number> number;
    number_.reserve(count_);
    for (const double v : values) {
      const auto [found, added] = number.try_emplace(std::bit_cast<std::uint64_t>(v), static_cast<Number>(different_.size()));
      if (added && different_.size() == most) {
        different_ = std::move(values);
        break;
      }
      if (added) different_.push_back(v);
      number_.push_back(found->second);
    }
    if (different_.size() == 1) each_ = 0;
    if (different_.size() == 1 || different_.size() > most) std::vector<Number>().swap(number_);
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] double operator[](std::size_t i) const { return different_[number_.empty() ? i & each_ : number_[i]]; }

 private:
  std::size_t count_ = 0, each_ = ~std::size_t{0};  ///< each_: 0 where one stands for all
  std::vector<double> different_;
  std::vector<Number> number_;  ///< empty: one stands for all, or every value has its own
};

}  // namespace abut::simd
