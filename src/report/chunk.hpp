// Arrays on their way into the page: quantised, made small, written as text. viewer/src/data/chunk.ts reads them back.
//
// A chunk is planar (all values of component 0, then of component 1, ...). Integers become differences to the value before them
// in their component (the first to 0) modulo their width, zigzag-coded (0, -1, 1, -2 -> 0, 1, 2, 3), so that smooth fields turn into
// small numbers; then all low bytes, all next bytes, ... (planes); then zlib; then base64.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut::report {

/// One array: what the page needs to read it, and its text. An array whose components are constant has no text.
struct Chunk {
  std::string kind;       ///< "q16", "u32", "f32", "u8"
  std::size_t count = 0;  ///< values per component
  int components = 1;
  std::vector<double> low;   ///< q16: value of quantum 0, per component
  std::vector<double> high;  ///< q16: value of quantum 65534
  std::string text;          ///< base64
};

/// Value of a q16 chunk that stands for "no value" (NaN).
inline constexpr std::uint16_t no_value = 65535;

/// 16 bits per value between the smallest and the largest finite value of each component; |error| <= (high - low)/131068 with `low` and
/// `high` of the chunk. Where both signs occur the ends move outward by up to a quantum so that 0 is hit exactly. Values that are not
/// finite become `no_value`.
/// @param values  #count * components, interleaved (x y z x y z ...)
[[nodiscard]] Chunk quantised(std::span<const float> values, int components);
/// @param values  #count * components, interleaved
[[nodiscard]] Chunk integers(std::span<const std::uint32_t> values, int components);
/// Ids that may be beyond 32 bits: u32 of two components, the low word and the high one.
[[nodiscard]] Chunk identifiers(std::span<const std::int64_t> ids);
[[nodiscard]] Chunk singles(std::span<const float> values, int components);
[[nodiscard]] Chunk bytes(std::span<const std::uint8_t> values);

[[nodiscard]] std::string base64(std::span<const unsigned char> data);

}  // namespace abut::report
