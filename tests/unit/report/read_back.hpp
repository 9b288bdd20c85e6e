// Reads chunks as src/report/chunk.hpp describes them; written apart from the code that makes them.
#pragma once

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "report/chunk.hpp"

namespace abut::report::test {

inline std::vector<unsigned char> from_base64(std::string_view text) {
  const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> out;
  unsigned word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    out.push_back(static_cast<unsigned char>(word >> bits & 255));
  }
  return out;
}

/// Integers of a chunk, interleaved as they went in.
inline std::vector<std::uint32_t> read_integers(const std::string& kind, std::size_t count, int components, std::string_view text) {
  const std::size_t n = count * static_cast<std::size_t>(components);
  const std::size_t width = kind == "q16" ? 2 : kind == "u8" ? 1 : 4;
  const auto packed = from_base64(text);
  std::vector<unsigned char> raw(n * width);
  uLongf size = raw.size();
  if (uncompress(raw.data(), &size, packed.data(), packed.size()) != Z_OK || size != raw.size()) throw std::runtime_error("damaged chunk");
  std::vector<std::uint32_t> out(n);
  for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t word = 0;
      for (std::size_t k = 0; k < width; ++k) word |= static_cast<std::uint32_t>(raw[k * n + c * count + i]) << (8 * k);
      if (kind == "q16" || kind == "u32") {
        const std::uint32_t difference = (word >> 1) ^ (0u - (word & 1u));
        word = before + difference;
        if (kind == "q16") word &= 0xffffu;
        before = word;
      }
      out[i * static_cast<std::size_t>(components) + c] = word;
    }
  }
  return out;
}

/// Values of a quantised chunk, interleaved.
inline std::vector<double> read_values(const Chunk& chunk) {
  const auto width = static_cast<std::size_t>(chunk.components);
  std::vector<double> out(chunk.count * width);
  const auto quanta =
      chunk.text.empty() ? std::vector<std::uint32_t>(out.size()) : read_integers("q16", chunk.count, chunk.components, chunk.text);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t c = i % width;
    out[i] = quanta[i] == no_value ? std::numeric_limits<double>::quiet_NaN()
                                   : chunk.low[c] + (chunk.high[c] - chunk.low[c]) * quanta[i] / (no_value - 1);
  }
  return out;
}

}  // namespace abut::report::test
