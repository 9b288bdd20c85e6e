#include "contact/enforce/history.hpp"

namespace abut::contact {
namespace {

constexpr std::size_t head = 4 * sizeof(std::uint64_t);

std::uint64_t checksum(std::span<const std::byte> bytes) {  // FNV-1a
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

void HistoryWriter::append(const void* from, std::size_t length) {
  const std::size_t size = bytes_.size();
  bytes_.resize(size + length);
  if (length > 0) std::memcpy(bytes_.data() + size, from, length);
}

std::vector<std::byte> HistoryWriter::finish() {
  const std::uint64_t header[4] = {history_magic, history_version, bytes_.size(), checksum(std::span(bytes_).subspan(head))};
  std::memcpy(bytes_.data(), header, head);
  return std::move(bytes_);
}

HistoryReader::HistoryReader(std::span<const std::byte> blob) {
  std::uint64_t header[4] = {};
  if (blob.size() < head) throw std::invalid_argument("contact history: not a history blob");
  std::memcpy(header, blob.data(), head);
  if (header[0] != history_magic) throw std::invalid_argument("contact history: not a history blob");
  if (header[1] != history_version) throw std::invalid_argument("contact history: of another version");
  rest_ = blob.subspan(head);
  if (header[2] != blob.size() || header[3] != checksum(rest_)) throw std::invalid_argument("contact history: damaged");
}

void HistoryReader::take(void* to, std::size_t length) {
  if (length > rest_.size()) throw std::invalid_argument("contact history: too short");
  if (length > 0) std::memcpy(to, rest_.data(), length);
  rest_ = rest_.subspan(length);
}

void HistoryReader::finish() const {
  if (!rest_.empty()) throw std::invalid_argument("contact history: made for another interface");
}

}  // namespace abut::contact
