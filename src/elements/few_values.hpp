// Many numbers of which few differ.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace abut::elements {

/// The same bits as the numbers that it is made of. Masses of nodes are sums of few kinds of elements: where there are at most 2^16
/// different ones, each takes two bytes.
class FewValues {
 public:
  FewValues() = default;
  explicit FewValues(std::vector<double> values) {
    constexpr std::size_t most = std::size_t{1} << 16;
    std::unordered_map<std::uint64_t, std::uint16_t> number;
    number_.reserve(values.size());
    for (const double v : values) {
      const auto [found, added] = number.try_emplace(std::bit_cast<std::uint64_t>(v), static_cast<std::uint16_t>(different_.size()));
      if (added && different_.size() == most) {
        std::vector<std::uint16_t>().swap(number_);
        different_ = std::move(values);
        return;
      }
      if (added) different_.push_back(v);
      number_.push_back(found->second);
    }
  }
  [[nodiscard]] bool empty() const { return different_.empty(); }
  [[nodiscard]] double operator[](std::size_t i) const { return number_.empty() ? different_[i] : different_[number_[i]]; }

 private:
  std::vector<double> different_;
  std::vector<std::uint16_t> number_;  ///< empty: every value has its own
};

}  // namespace abut::elements
