#include "state/archive.hpp"

#include <algorithm>
#include <cstring>

namespace abut::state {

namespace {

using Tag = std::array<char, 8>;

Tag tag_of(std::string_view name) {
  Tag tag{};
  std::copy_n(name.begin(), std::min(name.size(), tag.size()), tag.begin());
  return tag;
}

}  // namespace

void Archive::plain(void* data, std::size_t size) {
  if (size == 0) return;
  done_ += size;
  if (loading_) {
    if (size > rest_.size()) throw ArchiveError("the checkpoint ends too early (in part '" + std::string(where_) + "')");
    std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
    return;
  }
  const auto* next = static_cast<const std::byte*>(data);
  if (!out_) {
    bytes_.insert(bytes_.end(), next, next + size);
    return;
  }
  constexpr std::size_t piece = std::size_t{1} << 20;  // whole words
  while (size > 0) {
    const std::size_t part = std::min(size, piece - bytes_.size());
    bytes_.insert(bytes_.end(), next, next + part);
    next += part;
    size -= part;
    if (bytes_.size() < piece) continue;
    out_(bytes_);
    bytes_.clear();
  }
}

bool Archive::all_zero(std::span<const std::byte> bytes) {
  constexpr std::size_t piece = 4096;
  static constexpr std::array<std::byte, piece> zeros{};
  for (std::size_t i = 0; i < bytes.size(); i += piece) {
    if (std::memcmp(bytes.data() + i, zeros.data(), std::min(piece, bytes.size() - i)) != 0) return false;
  }
  return true;
}

void Archive::operator()(bool& flag) {
  std::uint8_t byte = flag ? 1 : 0;
  plain(&byte, 1);
  if (byte > 1) throw ArchiveError("the checkpoint is damaged (in part '" + std::string(where_) + "')");
  flag = byte == 1;
}

void Archive::operator()(std::string& text) {
  text.resize(count(text.size(), 1));
  plain(text.data(), text.size());
}

void Archive::expect_count(std::size_t expected) {
  std::uint64_t n = expected;
  plain(&n, sizeof n);
  if (n != expected) {
    throw ArchiveError("the checkpoint does not fit the model: part '" + std::string(where_) + "' has " + std::to_string(n) +
                       " values where " + std::to_string(expected) + " are expected");
  }
}

std::size_t Archive::count(std::size_t own, std::size_t least_bytes) {
  std::uint64_t n = own;
  plain(&n, sizeof n);
  if (loading_ && n > rest_.size() / least_bytes) {
    throw ArchiveError("the checkpoint is damaged (in part '" + std::string(where_) + "')");
  }
  return n;
}

std::size_t Archive::open_section(std::string_view tag) {
  where_ = tag;
  Tag stored = tag_of(tag);
  plain(stored.data(), stored.size());
  if (stored != tag_of(tag)) throw ArchiveError("the checkpoint is damaged: part '" + std::string(tag) + "' is missing");
  return done_;
}

void Archive::close_section(std::string_view tag, std::size_t begin) {
  const std::uint64_t own = done_ - begin;
  std::uint64_t length = own;
  plain(&length, sizeof length);
  if (length != own) { throw ArchiveError("the checkpoint does not fit the model (part '" + std::string(tag) + "' has another length)"); }
  where_ = "archive";
}

void Archive::finish() {
  if (loading_ && !rest_.empty()) throw ArchiveError("the checkpoint is damaged: it goes on after its end");
  if (!out_ || bytes_.empty()) return;
  out_(bytes_);
  bytes_.clear();
}

}  // namespace abut::state
