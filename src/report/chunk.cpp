#include "report/chunk.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

#include "core/diagnostic.hpp"

namespace abut::report {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes deflated(const Bytes& raw) {
  constexpr int level = 6;
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  Bytes out(size);
  if (compress2(out.data(), &size, raw.data(), static_cast<uLong>(raw.size()), level) != Z_OK) throw RunError("zlib cannot compress");
  out.resize(size);
  return out;
}

/// Byte k of every value, for k = 0, 1, ...
template <typename T>
Bytes planes(const std::vector<T>& values) {
  Bytes out(values.size() * sizeof(T));
  auto to = out.begin();
  for (std::size_t k = 0; k < sizeof(T); ++k) {
    for (const T v : values) *to++ = static_cast<unsigned char>(v >> (8 * k) & 0xff);
  }
  return out;
}

/// Interleaved to planar differences, zigzag-coded.
template <typename T>
std::vector<T> differences(std::span<const T> values, int components) {
  using Signed = std::make_signed_t<T>;
  constexpr int top = 8 * sizeof(T) - 1;
  const auto width = static_cast<std::size_t>(components);
  std::vector<T> out;
  out.reserve(values.size());
  for (std::size_t c = 0; c < width; ++c) {
    T before = 0;
    for (std::size_t i = c; i < values.size(); i += width) {
      const auto d = static_cast<Signed>(static_cast<T>(values[i] - before));
      before = values[i];
      out.push_back(static_cast<T>(static_cast<T>(static_cast<T>(d) << 1) ^ static_cast<T>(d >> top)));
    }
  }
  return out;
}

Chunk chunk(std::string kind, std::size_t size, int components) {
  return {std::move(kind), size / static_cast<std::size_t>(components), components, {}, {}, {}};
}

}  // namespace

std::string base64(std::span<const unsigned char> data) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((data.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < data.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, data.size() - i);
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < left ? data[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= left ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

Chunk quantised(std::span<const float> values, int components) {
  Chunk out = chunk("q16", values.size(), components);
  const auto width = static_cast<std::size_t>(components);
  std::vector<std::uint16_t> quanta(values.size());
  bool constant = true;
  for (std::size_t c = 0; c < width; ++c) {
    double low = 0.0, high = 0.0;
    bool found = false, gaps = false;
    for (std::size_t i = c; i < values.size(); i += width) {
      const auto v = static_cast<double>(values[i]);
      if (!std::isfinite(v)) {
        gaps = true;
        continue;
      }
      low = found ? std::min(low, v) : v;
      high = found ? std::max(high, v) : v;
      found = true;
    }
    if (low < 0.0 && high > 0.0) {
      // Zero is a value that people look for: one quantum stands for it.
      const double step = (high - low) / (no_value - 2);
      low = -std::ceil(-low / step) * step;
      high = low + step * (no_value - 1);
    }
    const double scale = high > low ? (no_value - 1) / (high - low) : 0.0;
    for (std::size_t i = c; i < values.size(); i += width) {
      const auto v = static_cast<double>(values[i]);
      quanta[i] = std::isfinite(v) ? static_cast<std::uint16_t>(std::lround((v - low) * scale)) : no_value;
    }
    out.low.push_back(low);
    out.high.push_back(high);
    constant = constant && low == high && !gaps;
  }
  if (!constant) out.text = base64(deflated(planes(differences<std::uint16_t>(quanta, components))));
  return out;
}

Chunk integers(std::span<const std::uint32_t> values, int components) {
  Chunk out = chunk("u32", values.size(), components);
  out.text = base64(deflated(planes(differences<std::uint32_t>(values, components))));
  return out;
}

Chunk identifiers(std::span<const std::int64_t> ids) {
  std::vector<std::uint32_t> words;
  words.reserve(2 * ids.size());
  for (const std::int64_t id : ids) {
    words.push_back(static_cast<std::uint32_t>(id));
    words.push_back(static_cast<std::uint32_t>(id >> 32));
  }
  return integers(words, 2);
}

Chunk singles(std::span<const float> values, int components) {
  Chunk out = chunk("f32", values.size(), components);
  const auto width = static_cast<std::size_t>(components);
  std::vector<std::uint32_t> words;
  words.reserve(values.size());
  for (std::size_t c = 0; c < width; ++c) {
    for (std::size_t i = c; i < values.size(); i += width) words.push_back(std::bit_cast<std::uint32_t>(values[i]));
  }
  out.text = base64(deflated(planes(words)));
  return out;
}

Chunk bytes(std::span<const std::uint8_t> values) {
  Chunk out = chunk("u8", values.size(), 1);
  out.text = base64(deflated({values.begin(), values.end()}));
  return out;
}

}  // namespace abut::report
