#include "state/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <cstring>

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

}  // namespace

std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (std::size_t i = 0; i < bytes.size(); i += sizeof hash) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    hash = (hash ^ word) * 0x100000001b3ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

std::vector<std::byte> seal(std::span<const std::byte> content) {
  const Head head{magic, checkpoint_format, 0, content.size()};
  std::vector<std::byte> file(sizeof head + content.size() + sizeof(std::uint64_t));
  std::memcpy(file.data(), &head, sizeof head);
  if (!content.empty()) std::memcpy(file.data() + sizeof head, content.data(), content.size());
  const std::uint64_t sum = checksum(std::span(file).first(file.size() - sizeof(std::uint64_t)));
  std::memcpy(file.data() + file.size() - sizeof sum, &sum, sizeof sum);
  return file;
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
  if (sum != checksum(file.first(file.size() - sizeof sum))) throw ArchiveError("it is damaged: its checksum is wrong");
  return file.subspan(sizeof head, head.length);
}

}  // namespace abut::state
