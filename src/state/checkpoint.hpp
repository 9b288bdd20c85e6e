// The checkpoint file: a frame that tells whether its content is whole, and who wrote it, before a byte of it is used.
//
//   8 bytes magic "ABUTRST\1" | u32 format | u32 0 | content | u64 length of the content | u64 checksum of all before
//
// Length and checksum stand at the end, so that a content as large as the state is written as it comes and held nowhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace abut::state {

/// Rises with every change of the frame. 1: the length stood before the content. 2: checksum of one row of words.
inline constexpr std::uint32_t checkpoint_format = 5;

/// FNV-1a over 64-bit words, the last one filled with zeros: four rows of every fourth word, which need not wait for each other, and in the
/// end over the four. Any single change of a word changes it.
class Checksum {
 public:
  /// @param bytes  whole words, but for the last piece
  void add(std::span<const std::byte> bytes);
  [[nodiscard]] std::uint64_t value() const;

 private:
  static constexpr std::uint64_t start = 0xcbf29ce484222325ULL;
  std::array<std::uint64_t, 4> row_{start, start, start, start};
  std::size_t words_ = 0;
};

/// Frames a content on its way to `out`.
class Sealer {
 public:
  using Out = std::function<void(std::span<const std::byte>)>;
  explicit Sealer(Out out);  ///< writes what stands before the content
  /// The next piece of the content: whole 8-byte words, but for the last one.
  void add(std::span<const std::byte> piece);
  /// Writes what stands behind it.
  void finish();

 private:
  Out out_;
  Checksum sum_;
  std::uint64_t length_ = 0;
};

/// The content of a file. @throws ArchiveError that says what is wrong: no checkpoint, another format, cut off, damaged
[[nodiscard]] std::span<const std::byte> unseal(std::span<const std::byte> file);

}  // namespace abut::state
