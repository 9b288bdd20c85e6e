#include "state/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "state/archive.hpp"

namespace abut::state {

namespace {

constexpr std::array<char, 8> magic{'A', 'B', 'U', 'T', 'R', 'S', 'T', '\1'};
struct Head {
  std::array<char, 8> magic{};
  std::uint32_t format = checkpoint_format;
  std::uint32_t reserved = 0;
  std::uint64_t length = 0;
};
static_assert(sizeof(Head) == 24);

/// FNV-1a over 64-bit words, the last one filled with zeros. Any single change of a word changes it.
class Checksum {
 public:
  /// @param bytes  whole words, but for the last piece
  void add(std::span<const std::byte> bytes) {
    for (std::size_t i = 0; i < bytes.size(); i += sizeof hash_) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
      hash_ = (hash_ ^ word) * 0x100000001b3ULL;
      hash_ ^= hash_ >> 32;
    }
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

Seal seal(std::span<const std::byte> content) {
  const Head head{magic, checkpoint_format, 0, content.size()};
  Seal out;
  static_assert(sizeof out.head == sizeof head);
  std::memcpy(out.head.data(), &head, sizeof head);
  Checksum sum;
  sum.add(out.head);
  sum.add(content);
  const std::uint64_t value = sum.value();
  std::memcpy(out.tail.data(), &value, sizeof value);
  return out;
}

std::span<const std::byte> unseal(std::span<const std::byte> file) {
  Head head;
  if (file.size() < sizeof head) throw ArchiveError("it is not a checkpoint of abut, or was cut off");
  std::memcpy(&head, file.data(), sizeof head);
  if (head.magic != magic) throw ArchiveError("it is not a checkpoint of abut");
  if (head.format != checkpoint_format) {
    throw ArchiveError("it has checkpoint format " + std::to_string(head.format) + ", this abut reads format " +
                       std::to_string(checkpoint_format));
  }
  constexpr std::size_t around = sizeof head + sizeof(std::uint64_t);
  if (file.size() < around || head.length != file.size() - around) throw ArchiveError("it was cut off");
  std::uint64_t sum = 0;
  std::memcpy(&sum, file.data() + file.size() - sizeof sum, sizeof sum);
  Checksum own;
  own.add(file.first(file.size() - sizeof sum));
  if (sum != own.value()) throw ArchiveError("it is damaged: its checksum is wrong");
  return file.subspan(sizeof head, head.length);
}

}  // namespace abut::state
