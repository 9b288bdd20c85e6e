// The history blob: magic, version, length, checksum, then plain arrays in a fixed order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace abut::contact {

inline constexpr std::uint64_t history_magic = 0x3143544354554241ULL;  // "ABUTCTC1"
inline constexpr std::uint64_t history_version = 2;

class HistoryWriter {
 public:
  HistoryWriter() : bytes_(4 * sizeof(std::uint64_t)) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof(T));
  }
  template <class T>
  void put_all(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(T));
  }
  [[nodiscard]] std::vector<std::byte> finish();

 private:
  std::vector<std::byte> bytes_;
  void append(const void* from, std::size_t length);
};

class HistoryReader {
 public:
  /// @throws std::invalid_argument unless magic, version, length and checksum fit
  explicit HistoryReader(std::span<const std::byte> blob);

  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    take(&value, sizeof(T));
  }
  /// The length must be the one already in `values`.
  template <class T>
  void get_all(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::uint64_t size = 0;
    get(size);
    if (size != values.size()) throw std::invalid_argument("contact history: made for another interface");
    take(values.data(), values.size() * sizeof(T));
  }
  /// @throws std::invalid_argument when something is left over
  void finish() const;

 private:
  std::span<const std::byte> rest_;
  void take(void* to, std::size_t length);
};

}  // namespace abut::contact
