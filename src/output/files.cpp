#include "output/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
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

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder, error) && !error) error = std::make_error_code(std::errc::not_a_directory);
  if (error) fail("create the folder", folder, error.value());
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  std::filesystem::path temporary = path;
  temporary.replace_filename("." + path.filename().string() + ".part");
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, open_mode);
  if (descriptor < 0) fail("write", path, errno);
  int error = write_all(descriptor, content);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail("write", path, error);
  }
}

AppendFile::AppendFile(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, open_mode);
  if (descriptor_ < 0) fail("write", path_, errno);
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), good_size_(other.good_size_) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  if (this != &other) {
    if (descriptor_ >= 0) ::close(descriptor_);
    path_ = std::move(other.path_);
    descriptor_ = std::exchange(other.descriptor_, -1);
    good_size_ = other.good_size_;
  }
  return *this;
}

void AppendFile::append(std::string_view piece) {
  if (const int error = write_all(descriptor_, piece); error != 0) {
    // Best effort: the message about the full disk matters more than a torn last line.
    [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, good_size_);
    fail("write", path_, error);
  }
  good_size_ += static_cast<long long>(piece.size());
}

void AppendFile::close() {
  if (descriptor_ < 0) return;
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("write", path_, errno);
}

}  // namespace abut::output
