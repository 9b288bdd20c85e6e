// Values as bytes, out and in: what the history blob and the call log are made of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut::contact {

/// FNV-1a over 64-bit words, the last one filled with zeros; high bits come down after each, so that every change of a word counts.
[[nodiscard]] inline std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t hash = 0xcbf29ce484222325ULL) {
  for (std::size_t i = 0; i < bytes.size(); i += sizeof hash) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    hash = (hash ^ word) * 0x100000001b3ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof(T));
  }
  /// Number of values, then the values.
  template <class T>
  void put_all(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(T));
  }
  template <class T>
  void put_all(const std::vector<T>& values) {
    put_all(std::span<const T>(values));
  }
  /// Room for so many more bytes, no more than that.
  void reserve(std::size_t more) { bytes_.reserve(bytes_.size() + more); }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 protected:
  std::vector<std::byte> bytes_;

 private:
  void append(const void* from, std::size_t length) {
    const std::size_t size = bytes_.size();
    bytes_.resize(size + length);
    if (length > 0) std::memcpy(bytes_.data() + size, from, length);
  }
};

class ByteReader {
 public:
  /// @param what  names the source in messages: "contact history"
  ByteReader(std::span<const std::byte> bytes, std::string what) : rest_(bytes), what_(std::move(what)) {}

  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    take(&value, sizeof(T));
  }
  template <class T>
  [[nodiscard]] T next() {
    T value{};
    get(value);
    return value;
  }
  /// Resizes `values` to what was written.
  template <class T>
  void get_any(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto size = next<std::uint64_t>();
    if (size > rest_.size() / sizeof(T)) refuse("is too short");
    values.resize(size);
    take(values.data(), size * sizeof(T));
  }
  /// The length must be the one already in `values`.
  template <class T>
  void get_all(std::vector<T>& values) {
    if (next<std::uint64_t>() != values.size()) refuse("was made for another interface");
    take(values.data(), values.size() * sizeof(T));
  }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }
  /// @throws std::invalid_argument when something is left over
  void finish() const {
    if (!rest_.empty()) refuse("is longer than its content");
  }
  [[noreturn]] void refuse(const std::string& why) const { throw std::invalid_argument(what_ + " " + why); }

 protected:
  std::span<const std::byte> rest_;

 private:
  std::string what_;
  void take(void* to, std::size_t length) {
    if (length > rest_.size()) refuse("is too short");
    if (length > 0) std::memcpy(to, rest_.data(), length);
    rest_ = rest_.subspan(length);
  }
};

}  // namespace abut::contact
