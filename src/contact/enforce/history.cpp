#include "contact/enforce/history.hpp"

#include <array>

namespace abut::contact {
namespace {

struct Head {
  std::uint64_t magic = history_magic, version = history_version, owner = 0, length = 0, sum = 0;
};

}  // namespace

HistoryWriter::HistoryWriter(std::uint64_t owner) : owner_(owner) { bytes_.resize(sizeof(Head)); }

std::vector<std::byte> HistoryWriter::finish() {
  const Head head{.owner = owner_, .length = bytes_.size(), .sum = checksum(std::span(bytes_).subspan(sizeof(Head)))};
  std::memcpy(bytes_.data(), &head, sizeof head);
  return std::move(bytes_);
}

HistoryReader::HistoryReader(std::span<const std::byte> blob, std::uint64_t owner) : ByteReader(blob, "contact history") {
  std::array<std::uint64_t, 2> begin{};  // the same in every version
  if (blob.size() < sizeof begin) refuse("is not a history blob");
  std::memcpy(begin.data(), blob.data(), sizeof begin);
  if (begin[0] != history_magic) refuse("is not a history blob");
  if (begin[1] != history_version) {
    refuse("has version " + std::to_string(begin[1]) + "; this library reads version " + std::to_string(history_version) + " only");
  }
  const auto head = next<Head>();
  if (head.length != blob.size()) {
    refuse("is damaged: it has " + std::to_string(blob.size()) + " bytes of " + std::to_string(head.length));
  }
  if (head.sum != checksum(rest_)) refuse("is damaged: its checksum does not fit");
  if (head.owner != owner) refuse("was made for another interface: other surfaces, or other rules of what is remembered");
}

}  // namespace abut::contact
