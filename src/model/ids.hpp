// Ids of nodes or elements, in the order of the model.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "abut/types.hpp"

namespace abut::model {

/// Meshes number in ranges of consecutive ids, of which the first one and its place are kept: 12 bytes for a range, however long.
class Ids {
 public:
  Ids() = default;
  Ids(std::initializer_list<Id> ids) {
    for (const Id id : ids) push_back(id);
  }
  void push_back(Id id) {
    if (empty() || id != back() + 1) {
      first_.push_back(id);
      begin_.push_back(static_cast<std::uint32_t>(size_));
    }
    ++size_;
  }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Id operator[](std::size_t i) const {
    const auto range = first_.size() == 1 ? begin_.begin() : std::upper_bound(begin_.begin(), begin_.end(), i) - 1;
    return first_[static_cast<std::size_t>(range - begin_.begin())] + static_cast<Id>(i - *range);
  }
  [[nodiscard]] Id front() const { return first_.front(); }
  [[nodiscard]] Id back() const { return first_.back() + static_cast<Id>(size_ - begin_.back()) - 1; }
  [[nodiscard]] std::vector<Id> all() const {
    std::vector<Id> ids;
    ids.reserve(size_);
    for (std::size_t r = 0; r < first_.size(); ++r) {
      const std::size_t end = r + 1 < begin_.size() ? begin_[r + 1] : size_;
      for (std::size_t i = begin_[r]; i < end; ++i) ids.push_back(first_[r] + static_cast<Id>(i - begin_[r]));
    }
    return ids;
  }
  bool operator==(const Ids&) const = default;

 private:
  std::size_t size_ = 0;
  std::vector<Id> first_;             ///< id of each range
  std::vector<std::uint32_t> begin_;  ///< its position
};

}  // namespace abut::model
