// Files appear whole or not at all, grow by whole pieces, and failures name the path and the reason.
#include "output/files.hpp"

#include <sys/stat.h>

#include "core/diagnostic.hpp"
#include "scene.hpp"
#include "support/size_limit.hpp"

namespace abut::output {
namespace {

using test::slurp;

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

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

/// A file that a checkpoint counts on: `rows` in it then, `later` behind them.
std::vector<std::byte> checkpoint_of(const std::filesystem::path& path, const std::string& rows, const std::string& later) {
  AppendFile file(path);
  file.append(rows);
  state::Archive written;
  file.persist(written);
  file.append(later);
  return {written.bytes().begin(), written.bytes().end()};
}

TEST(AppendFile, WhatIsBehindTheCheckpointGoesWhenSomethingIsWritten) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "rows";
  const std::vector<std::byte> checkpoint = checkpoint_of(path, "1\n2\n", "3\n");
  const auto opened = [&] {
    AppendFile file(path, Opening::resumed);
    state::Archive a{std::span<const std::byte>(checkpoint)};
    file.persist(a);
    return file;
  };
  { const AppendFile file = opened(); }
  EXPECT_EQ(slurp(path), "1\n2\n3\n");  // nothing was written: as after a resume that is refused
  AppendFile file = opened();
  file.append("x\n");
  file.append("y\n");
  file.close();
  EXPECT_EQ(slurp(path), "1\n2\nx\ny\n");
  AppendFile ended = opened();
  ended.close();
  EXPECT_EQ(slurp(path), "1\n2\n");  // and a run that ends without another row ends there
}

TEST(AppendFile, AFileThatIsNotWhatItWasIsRefusedAndLeftAsItIs) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "rows";
  const std::vector<std::byte> checkpoint = checkpoint_of(path, "1\n2\n", "3\n");
  for (const std::string changed : {"1\r\n2\r\n3\r\n", "1\n4\n3\n", "1\n2"}) {
    write_atomically(path, changed);
    AppendFile file(path, Opening::resumed);
    state::Archive a{std::span<const std::byte>(checkpoint)};
    EXPECT_THROW(file.persist(a), state::ArchiveError) << changed;
    file.close();
    EXPECT_EQ(slurp(path), changed);
  }
}

TEST(FolderLock, OneAtATime) {
  const test::TemporaryFolder temporary;
  const auto folder = temporary.path() / "new" / "run";
  {
    const FolderLock lock(folder);
    EXPECT_THROW(FolderLock{folder}, RunError);
  }
  FolderLock first(folder);
  const FolderLock second = std::move(first);
  EXPECT_THROW(FolderLock{folder}, RunError);
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

TEST(WriteAtomically, WriteThroughALinkAndLeaveWhatIsNoFile) {
  const abut::test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file", link = folder.path() / "link", queue = folder.path() / "queue";
  write_atomically(file, "old");
  std::filesystem::create_symlink("file", link);
  write_atomically(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(abut::test::slurp(file), "new");
  ASSERT_EQ(::mkfifo(queue.c_str(), 0600), 0);
  std::filesystem::create_symlink("queue", folder.path() / "to_queue");
  std::filesystem::create_symlink("nowhere", folder.path() / "dangling");
  const auto said = [](const std::filesystem::path& path) -> std::string {
    try {
      write_atomically(path, "text");
    } catch (const RunError& e) { return e.what(); }
    return "";
  };
  for (const std::filesystem::path& path : {queue, folder.path() / "to_queue"})
    EXPECT_EQ(said(path), "cannot write '" + path.string() + "': it is no regular file");
  EXPECT_EQ(said(folder.path()), "cannot write '" + folder.path().string() + "': Is a directory");
  EXPECT_EQ(said(folder.path() / "dangling"), "cannot write '" + (folder.path() / "dangling").string() + "': No such file or directory");
  EXPECT_TRUE(std::filesystem::is_fifo(queue));
}

}  // namespace
}  // namespace abut::output
