// Values of a state that wait to be written, in single or double precision.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace abut::output {

/// Tuples in their order. A piece in which all are alike, to the last bit, takes the room of one: most of a model feels no contact, and at
/// the start nothing is displaced, strained or stressed.
template <class T>
class Column {
 public:
  explicit Column(int components) : components_(static_cast<std::size_t>(components)) { buffer_.reserve(piece * components_); }

  [[nodiscard]] int components() const { return static_cast<int>(components_); }
  [[nodiscard]] std::size_t tuples() const { return tuples_; }
  /// @param tuple  #components
  void add(const T* tuple) {
    buffer_.insert(buffer_.end(), tuple, tuple + components_);
    ++tuples_;
    if (buffer_.size() == piece * components_) keep();
  }
  /// Once, behind the last tuple.
  void finish() {
    if (!buffer_.empty()) keep();
    std::vector<T>().swap(buffer_);
  }
  /// Value i: component i % #components of tuple i / #components. @pre finish()
  [[nodiscard]] T value(std::size_t i) const {
    const Kept& k = kept_[i / (piece * components_)];
    return values_[k.first + (k.alike ? i % components_ : i % (piece * components_))];
  }

 private:
  static constexpr std::size_t piece = 1024;  // tuples
  struct Kept {
    std::size_t first;
    bool alike;
  };
  std::size_t components_, tuples_ = 0;
  std::vector<T> buffer_, values_;
  std::vector<Kept> kept_;

  void keep() {
    // Each tuple is the one before it.
    const bool alike = std::memcmp(buffer_.data(), buffer_.data() + components_, (buffer_.size() - components_) * sizeof(T)) == 0;
    kept_.push_back({values_.size(), alike});
    values_.insert(values_.end(), buffer_.begin(), alike ? buffer_.begin() + static_cast<std::ptrdiff_t>(components_) : buffer_.end());
    buffer_.clear();
  }
};

}  // namespace abut::output
