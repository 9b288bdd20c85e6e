// The history blob: magic, version, whose it is, length, checksum, then plain values in a fixed order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/record/bytes.hpp"

namespace abut::contact {

inline constexpr std::uint64_t history_magic = 0x3143544354554241ULL;  // "ABUTCTC1"
/// Rises with every change of what is written. 1: before free borders had strips. 2: free borders. 3: owner in the head, normal force
/// and start work, strips that widen. 4: other order of a node's values, accounts of pairs. 5: a byte for a node that remembers nothing. 6:
/// mean velocities of the sides. 7: checksum by words. 8: springs of the last step, start work of two-sided interfaces.
inline constexpr std::uint64_t history_version = 8;

class HistoryWriter : public ByteWriter {
 public:
  /// @param owner  fingerprint of the interface
  explicit HistoryWriter(std::uint64_t owner);
  [[nodiscard]] std::vector<std::byte> finish();

 private:
  std::uint64_t owner_;
};

class HistoryReader : public ByteReader {
 public:
  /// @throws std::invalid_argument unless magic, version, owner, length and checksum fit; the message says which does not
  HistoryReader(std::span<const std::byte> blob, std::uint64_t owner);
};

}  // namespace abut::contact
