#include "state/archive.hpp"

#include <algorithm>
#include <cstring>
#include <new>

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
  if (!loading_) {
    if (size_ + size > capacity_) {
      capacity_ = size_ + size + size_ / 2;
      auto* grown = static_cast<std::byte*>(std::realloc(bytes_.get(), capacity_));
      if (grown == nullptr) throw std::bad_alloc();
      (void)bytes_.release();
      bytes_.reset(grown);
    }
    std::memcpy(bytes_.get() + size_, data, size);
    size_ += size;
    return;
  }
  if (size > rest_.size()) throw ArchiveError("the checkpoint ends too early (in part '" + std::string(where_) + "')");
  std::memcpy(data, rest_.data(), size);
  rest_ = rest_.subspan(size);
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
  std::uint64_t length = 0;
  plain(stored.data(), stored.size());
  if (stored != tag_of(tag)) throw ArchiveError("the checkpoint is damaged: part '" + std::string(tag) + "' is missing");
  plain(&length, sizeof length);
  if (!loading_) return size_;
  if (length > rest_.size()) throw ArchiveError("the checkpoint ends too early (in part '" + std::string(tag) + "')");
  return rest_.size() - length;  // what must be left when the part is used up
}

void Archive::close_section(std::string_view tag, std::size_t mark) {
  if (!loading_) {
    const std::uint64_t length = size_ - mark;
    std::memcpy(bytes_.get() + mark - sizeof length, &length, sizeof length);
  } else if (rest_.size() != mark) {
    throw ArchiveError("the checkpoint does not fit the model (part '" + std::string(tag) + "' has another length)");
  }
  where_ = "archive";
}

void Archive::finish() const {
  if (loading_ && !rest_.empty()) throw ArchiveError("the checkpoint is damaged: it goes on after its end");
}

}  // namespace abut::state
