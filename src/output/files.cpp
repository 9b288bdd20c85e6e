#include "output/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/diagnostic.hpp"

namespace abut::output {
namespace {

[[noreturn]] void fail(std::string_view action, const std::filesystem::path& path, int error) {
  throw RunError(fmt::format("cannot {} '{}': {}", action, path.string(), std::generic_category().message(error)));
}

/// Writes all of `content`; returns 0 or the errno of the failure.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

constexpr int open_mode = 0666;

}  // namespace

std::filesystem::path RunFolder::animation_state(int k) const { return animation_folder() / fmt::format("{}_{:05}.vtu", name, k); }

std::vector<std::filesystem::path> contact_call_files(const RunFolder& folder) {
  const std::string start = folder.name + "_contact_";
  std::vector<std::filesystem::path> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder.directory, none)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".calls" || !stem.starts_with(start)) continue;
    if (stem.find_first_not_of("0123456789", start.size()) == std::string::npos) found.push_back(entry.path());
  }
  std::ranges::sort(found);
  return found;
}

void remove_earlier_run(const RunFolder& folder) {
  std::vector<std::filesystem::path> stale = contact_call_files(folder);
  for (auto path : {folder.checkpoint(), folder.previous_checkpoint(), folder.manifest(), folder.report()}) stale.push_back(path);
  std::error_code error;
  for (const auto& path : stale) {
    if (!std::filesystem::remove(path, error) && error) fail("remove", path, error.value());
  }
}

FolderLock::FolderLock(const std::filesystem::path& folder) {
  create_folder(folder);
  const std::filesystem::path file = folder / ".abut_lock";
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, open_mode);
  if (descriptor_ < 0) fail("write", file, errno);
  int error = 0;
  while (error == 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) error = errno == EINTR ? 0 : errno;
  if (error != EWOULDBLOCK) return;  // a file system that has no locks: nothing more can be done
  ::close(descriptor_);
  throw RunError(
      fmt::format("cannot write in '{}': another abut is writing there (or, in a program, a Run that was not finished)", folder.string()));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder, error) && !error) error = std::make_error_code(std::errc::not_a_directory);
  if (error) fail("create the folder", folder, error.value());
}

namespace {

std::filesystem::path temporary_of(const std::filesystem::path& path) {
  std::filesystem::path temporary = path;
  temporary.replace_filename("." + path.filename().string() + ".part");
  return temporary;
}

}  // namespace

PendingFile::PendingFile(std::filesystem::path path) : path_(std::move(path)), temporary_(temporary_of(path_)) {
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, open_mode);
  if (descriptor_ < 0) fail("write", path_, errno);
}

PendingFile::~PendingFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void PendingFile::write(std::string_view piece) {
  if (const int error = write_all(descriptor_, piece); error != 0) fail("write", path_, error);
}

std::filesystem::path file_place(const std::filesystem::path& path) {
  std::error_code error;
  const bool link = std::filesystem::is_symlink(path, error);
  const std::filesystem::file_status there = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(there)) fail("write", path, EISDIR);
  if (link && !std::filesystem::exists(there)) fail("write", path, ENOENT);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
    throw RunError(fmt::format("cannot write '{}': it is no regular file", path.string()));
  }
  return link ? std::filesystem::canonical(path) : path;
}

AtomicFile::AtomicFile(const std::filesystem::path& path) : PendingFile(file_place(path)) {}

void AtomicFile::write(std::string_view piece) {
  PendingFile::write(piece);
  size_ += piece.size();
}

void AtomicFile::write_at(std::uint64_t position, std::string_view piece) {
  int error = ::lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0 ? errno : write_all(descriptor_, piece);
  if (error == 0 && ::lseek(descriptor_, 0, SEEK_END) < 0) error = errno;
  if (error != 0) fail("write", path_, error);
}

void AtomicFile::finish() {
  int error = ::close(std::exchange(descriptor_, -1)) != 0 ? errno : 0;
  if (error == 0 && ::rename(temporary_.c_str(), path_.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary_.c_str());
    fail("write", path_, error);
  }
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.finish();
}

void sync_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("write", path, errno);
  int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error == EINVAL) error = 0;  // a file system that cannot: nothing more can be done
  if (error != 0) fail("write", path, error);
}

void DurableFile::replace(const std::filesystem::path& previous) {
  int error = ::fsync(descriptor_) != 0 && errno != EINVAL ? errno : 0;
  if (::close(std::exchange(descriptor_, -1)) != 0 && error == 0) error = errno;
  if (!previous.empty()) {
    // A second name, not a rename: `path` names a complete file all the time.
    if (error == 0 && ::unlink(previous.c_str()) != 0 && errno != ENOENT) error = errno;
    if (error == 0 && ::link(path_.c_str(), previous.c_str()) != 0 && errno != ENOENT) {
      // No hard links here: between these two renames only `previous` names a file.
      if (::rename(path_.c_str(), previous.c_str()) != 0) error = errno;
    }
  }
  if (error == 0 && ::rename(temporary_.c_str(), path_.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary_.c_str());
    fail("write", path_, error);
  }
  sync_file(path_.parent_path().empty() ? std::filesystem::path(".") : path_.parent_path());
}

std::vector<std::byte> read_bytes(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("read", path, errno);
  std::vector<std::byte> bytes;
  constexpr std::size_t piece = std::size_t{1} << 20;
  for (;;) {
    const std::size_t size = bytes.size();
    bytes.resize(size + piece);
    const ssize_t got = ::read(descriptor, bytes.data() + size, piece);
    const int error = errno;
    bytes.resize(size + static_cast<std::size_t>(got > 0 ? got : 0));
    if (got < 0 && error == EINTR) continue;
    if (got > 0) continue;
    ::close(descriptor);
    if (got < 0) fail("read", path, error);
    return bytes;
  }
}

namespace {

/// Of the first `size` bytes of a file, which is at least as long.
Fingerprint fingerprint_of_start(const std::filesystem::path& path, std::int64_t size) {
  Fingerprint fingerprint;
  std::ifstream file(path, std::ios::binary);
  std::array<char, 1 << 16> piece;
  while (size > 0 && file.read(piece.data(), std::min<std::int64_t>(size, piece.size()))) {
    fingerprint.add_bytes({piece.data(), static_cast<std::size_t>(file.gcount())});
    size -= file.gcount();
  }
  return fingerprint;
}

}  // namespace

AppendFile::AppendFile(std::filesystem::path path, Opening opening) : path_(std::move(path)) {
  const int start = opening == Opening::fresh ? O_CREAT | O_TRUNC : 0;
  descriptor_ = ::open(path_.c_str(), O_WRONLY | start | O_APPEND | O_CLOEXEC, open_mode);
  if (descriptor_ < 0) fail("write", path_, errno);
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      good_size_(other.good_size_),
      content_(other.content_),
      has_rest_(other.has_rest_) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  if (this != &other) {
    if (descriptor_ >= 0) ::close(descriptor_);
    path_ = std::move(other.path_);
    descriptor_ = std::exchange(other.descriptor_, -1);
    good_size_ = other.good_size_;
    content_ = other.content_;
    has_rest_ = other.has_rest_;
  }
  return *this;
}

void AppendFile::cut_rest() {
  if (!std::exchange(has_rest_, false)) return;
  if (::ftruncate(descriptor_, good_size_) != 0) fail("write", path_, errno);
}

void AppendFile::append(std::string_view piece) {
  cut_rest();
  if (const int error = write_all(descriptor_, piece); error != 0) {
    // Best effort: the message about the full disk matters more than a torn last line.
    [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, good_size_);
    fail("write", path_, error);
  }
  good_size_ += static_cast<long long>(piece.size());
  content_.add_bytes(piece);
}

void AppendFile::persist(state::Archive& a) {
  std::int64_t size = good_size_;
  std::uint64_t content = content_.value();
  a(size);
  a(content);
  if (!a.loading()) {
    cut_rest();
    if (::fsync(descriptor_) != 0 && errno != EINVAL) fail("write", path_, errno);
    return;
  }
  const off_t there = ::lseek(descriptor_, 0, SEEK_END);
  if (size < 0 || there < size) {
    throw state::ArchiveError(
        fmt::format("'{}' is shorter than when the checkpoint was written ({} bytes, then {})", path_.string(), there, size));
  }
  content_ = fingerprint_of_start(path_, size);
  if (content_.value() != content) {
    throw state::ArchiveError(
        fmt::format("'{}' was changed since the checkpoint was written: its first {} bytes are others", path_.string(), size));
  }
  good_size_ = size;
  has_rest_ = true;
}

void AppendFile::close() {
  if (descriptor_ < 0) return;
  cut_rest();
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("write", path_, errno);
}

}  // namespace abut::output
