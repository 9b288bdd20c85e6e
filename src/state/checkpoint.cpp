#include "state/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "state/archive.hpp"

namespace abut::state {

namespace {

constexpr std::array<char, 8> magic{'A', 'B', 'U', 'T', 'R', 'S', 'T', '\1'};
struct Head {
  std::array<char, 8> magic{};
  std::uint32_t format = checkpoint_format;
  std::uint32_t reserved = 0;
};
struct Tail {
  std::uint64_t length = 0, sum = 0;
};
static_assert(sizeof(Head) == 16 && sizeof(Tail) == 16);

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x100000001b3ULL;
  return hash ^ hash >> 32;
}

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

}  // namespace

void Checksum::add(std::span<const std::byte> bytes) {
  constexpr std::size_t rows = 4, whole = rows * sizeof(std::uint64_t);
  std::size_t i = 0;
  const auto next = [&] {
    const std::size_t size = std::min(sizeof(std::uint64_t), bytes.size() - i);
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, size);
    row_[words_ % rows] = mixed(row_[words_ % rows], word);
    ++words_;
    i += size;
  };
  while (words_ % rows != 0 && i < bytes.size()) next();
  std::array<std::uint64_t, rows> row = row_;
  for (; i + whole <= bytes.size(); i += whole, words_ += rows) {
    std::array<std::uint64_t, rows> word;
    std::memcpy(word.data(), bytes.data() + i, whole);
    for (std::size_t k = 0; k < rows; ++k) row[k] = mixed(row[k], word[k]);
  }
  row_ = row;
  while (i < bytes.size()) next();
}

std::uint64_t Checksum::value() const {
  std::uint64_t sum = start;
  for (const std::uint64_t row : row_) sum = mixed(sum, row);
  return sum;
}

Sealer::Sealer(Out out) : out_(std::move(out)) {
  const Head head{magic, checkpoint_format, 0};
  sum_.add(bytes_of(head));
  out_(bytes_of(head));
}

void Sealer::add(std::span<const std::byte> piece) {
  length_ += piece.size();
  sum_.add(piece);
  out_(piece);
}

void Sealer::finish() {
  sum_.add(bytes_of(length_));
  const Tail tail{length_, sum_.value()};
  out_(bytes_of(tail));
}

std::span<const std::byte> unseal(std::span<const std::byte> file) {
  Head head;
  Tail tail;
  if (file.size() < sizeof head) throw ArchiveError("it is not a checkpoint of abut, or was cut off");
  std::memcpy(&head, file.data(), sizeof head);
  if (head.magic != magic) throw ArchiveError("it is not a checkpoint of abut");
  if (head.format != checkpoint_format) {
    throw ArchiveError("it has checkpoint format " + std::to_string(head.format) + ", this abut reads format " +
                       std::to_string(checkpoint_format));
  }
  if (file.size() < sizeof head + sizeof tail) throw ArchiveError("it was cut off");
  const std::span<const std::byte> content = file.subspan(sizeof head, file.size() - sizeof head - sizeof tail);
  std::memcpy(&tail, content.data() + content.size(), sizeof tail);
  if (tail.length != content.size()) throw ArchiveError("it was cut off");
  Checksum own;
  own.add(file.first(sizeof head));
  own.add(content);
  own.add(bytes_of(tail.length));
  if (tail.sum != own.value()) throw ArchiveError("it is damaged: its checksum is wrong");
  return content;
}

}  // namespace abut::state
