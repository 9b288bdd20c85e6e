// The checkpoint file: a frame that tells whether its content is whole, and who wrote it, before a byte of it is used.
//
//   8 bytes magic "ABUTRST\1" | u32 format | u32 0 | u64 length of the content | content | u64 checksum of all before
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace abut::state {

inline constexpr std::uint32_t checkpoint_format = 1;

/// Checksum of bytes: FNV-1a over 64-bit words, the last one filled with zeros. Any single change of a word changes it.
[[nodiscard]] std::uint64_t checksum(std::span<const std::byte> bytes);

/// The file around a content.
[[nodiscard]] std::vector<std::byte> seal(std::span<const std::byte> content);

/// The content of a file. @throws ArchiveError that says what is wrong: no checkpoint, another format, cut off, damaged
[[nodiscard]] std::span<const std::byte> unseal(std::span<const std::byte> file);

}  // namespace abut::state
