// Files appear whole or not at all, grow by whole pieces, and failures name the path and the reason.
#include "output/files.hpp"

#include <sys/resource.h>

#include <csignal>

#include "core/diagnostic.hpp"
#include "scene.hpp"

namespace abut::output {
namespace {

using test::slurp;

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

/// Files of this process may not grow beyond `bytes` while this lives: a full disk for whoever writes.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*handler_)(int);
};

TEST(WriteAtomically, ReplacesTheWholeContentAndLeavesNothingElse) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "index";
  write_atomically(path, "a long first version");
  write_atomically(path, "second");
  EXPECT_EQ(slurp(path), "second");
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(WriteAtomically, AFailureKeepsTheOldContentAndLeavesNoTemporaryFile) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "index";
  write_atomically(path, "old");
  std::string message;
  {
    const SizeLimit limit(1000);
    try {
      write_atomically(path, std::string(5000, 'x'));
    } catch (const RunError& e) { message = e.what(); }
  }
  EXPECT_EQ(message, "cannot write '" + path.string() + "': File too large");
  EXPECT_EQ(slurp(path), "old");
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(WriteAtomically, NewFileDoesNotAppearWhenTheDiskIsFull) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "index";
  {
    const SizeLimit limit(1000);
    EXPECT_THROW(write_atomically(path, std::string(5000, 'x')), RunError);
  }
  EXPECT_EQ(entries(folder.path()), 0U);
}

TEST(AppendFile, APieceThatDoesNotFitIsTakenBack) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "rows";
  AppendFile file(path);
  const std::string row(400, 'r');
  file.append(row);
  file.append(row);
  {
    const SizeLimit limit(1000);
    EXPECT_THROW(file.append(row), RunError);
  }
  EXPECT_EQ(slurp(path), row + row);
  file.append("more");  // room again
  EXPECT_EQ(slurp(path), row + row + "more");
}

TEST(CreateFolder, SaysWhichPathAndWhy) {
  const test::TemporaryFolder folder;
  write_atomically(folder.path() / "file", "");
  const auto path = folder.path() / "file" / "run";
  try {
    create_folder(path);
    FAIL() << "nothing was thrown";
  } catch (const RunError& e) { EXPECT_EQ(std::string(e.what()), "cannot create the folder '" + path.string() + "': Not a directory"); }
  try {
    create_folder(folder.path() / "file");
    FAIL() << "nothing was thrown";
  } catch (const RunError& e) {
    EXPECT_EQ(std::string(e.what()), "cannot create the folder '" + (folder.path() / "file").string() + "': Not a directory");
  }
}

TEST(AppendFile, AnUnwritableFolderIsNamed) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "missing" / "NAME.out";
  try {
    const AppendFile file(path);
    FAIL() << "nothing was thrown";
  } catch (const RunError& e) { EXPECT_EQ(std::string(e.what()), "cannot write '" + path.string() + "': No such file or directory"); }
}

}  // namespace
}  // namespace abut::output
