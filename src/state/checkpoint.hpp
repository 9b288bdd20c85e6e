// The checkpoint file: a frame that tells whether its content is whole, and who wrote it, before a byte of it is used.
//
//   8 bytes magic "ABUTRST\1" | u32 format | u32 0 | u64 length of the content | content | u64 checksum of all before
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace abut::state {

inline constexpr std::uint32_t checkpoint_format = 1;

/// What stands before and behind a content in its file. The content, as large as the state, is not copied.
struct Seal {
  std::array<std::byte, 24> head{};
  std::array<std::byte, 8> tail{};
};
[[nodiscard]] Seal seal(std::span<const std::byte> content);

/// The content of a file. @throws ArchiveError that says what is wrong: no checkpoint, another format, cut off, damaged
[[nodiscard]] std::span<const std::byte> unseal(std::span<const std::byte> file);

}  // namespace abut::state
