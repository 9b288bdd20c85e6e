// Binary archive of a run's state: tagged, length-prefixed sections of plain numbers, one description for both directions.
//
// Each owner of state has one function `void persist(state::Archive& a)` that names its members in order. With a writing archive
// it appends them, with a reading one it replaces them; a reading archive trusts nothing: every length is compared with
// what the owner expects or with what is left, every flag must be 0 or 1, a section must have been as long as it says at its end. Numbers
// are little-endian as in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "abut/diagnostic.hpp"
#include "abut/vec3.hpp"

namespace abut::state {

/// A checkpoint that cannot be used; what() says why.
class ArchiveError : public RunError {
 public:
  using RunError::RunError;
};

class Archive {
 public:
  using Out = std::function<void(std::span<const std::byte>)>;

  Archive() = default;                                 ///< writes into bytes()
  explicit Archive(Out out) : out_(std::move(out)) {}  ///< hands on what is written, in pieces of whole 8-byte words
  /// Reads; the bytes must outlive it.
  explicit Archive(std::span<const std::byte> bytes) : rest_(bytes), loading_(true) {}

  [[nodiscard]] bool loading() const { return loading_; }
  /// What was written and not handed on.
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  /// Writing: hands on the rest. Reading: @throws ArchiveError when something is left over
  void finish();

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& value) { plain(&value, sizeof(T)); }
  void operator()(bool& flag);
  void operator()(Vec3& v) { plain(&v, sizeof(Vec3)); }
  void operator()(std::string& text);
  template <class T, std::size_t N>
  void operator()(std::array<T, N>& values) {
    for (T& value : values) (*this)(value);
  }

  /// Values whose number the owner knows. @throws ArchiveError when the file has another number
  template <class T>
  void fixed(std::span<T> values) {
    static_assert(std::is_arithmetic_v<T> || std::is_same_v<T, Vec3>);
    expect_count(values.size());
    plain(values.data(), values.size_bytes());
  }
  template <class T>
  void fixed(std::vector<T>& values) {
    fixed(std::span<T>(values));
  }
  /// The same of values that are often all zero: nothing more is written of them then.
  template <class T>
  void fixed_or_zero(std::span<T> values) {
    static_assert(std::is_arithmetic_v<T> || std::is_same_v<T, Vec3>);
    const bool zero = all_zero(std::as_bytes(values));
    bool none = zero;
    (*this)(none);
    if (!none) {
      fixed(values);
    } else if (!zero) {
      std::fill(values.begin(), values.end(), T{});
    }
  }
  /// Values whose number only the file knows.
  template <class T>
  void growing(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    values.resize(count(values.size(), sizeof(T)));
    plain(values.data(), values.size() * sizeof(T));
  }
  /// Records: body(record) for each. The number is the owner's.
  template <class T, class Body>
  void each(std::vector<T>& records, Body&& body) {
    expect_count(records.size());
    for (T& record : records) body(record);
  }
  /// Records whose number only the file knows; each takes at least one byte.
  template <class T, class Body>
  void each_growing(std::vector<T>& records, Body&& body) {
    records.resize(count(records.size(), 1));
    for (T& record : records) body(record);
  }

  /// A part with a name of at most 8 characters, and its length behind it.
  template <class Body>
  void section(std::string_view tag, Body&& body) {
    const std::size_t begin = open_section(tag);
    body();
    close_section(tag, begin);
  }

 private:
  void plain(void* data, std::size_t size);
  [[nodiscard]] static bool all_zero(std::span<const std::byte> bytes);
  void expect_count(std::size_t expected);
  [[nodiscard]] std::size_t count(std::size_t own, std::size_t least_bytes);
  [[nodiscard]] std::size_t open_section(std::string_view tag);
  void close_section(std::string_view tag, std::size_t begin);

  std::vector<std::byte> bytes_;
  Out out_;
  std::size_t done_ = 0;  ///< bytes written or read so far
  std::span<const std::byte> rest_;
  std::string_view where_ = "archive";
  bool loading_ = false;
};

}  // namespace abut::state
