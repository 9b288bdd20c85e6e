// Files that stay readable: appended whole lines at a time, or replaced as a whole.
//
// Every failure (unwritable folder, full disk) is a RunError that names the path and the system's reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/fingerprint.hpp"
#include "state/archive.hpp"

namespace abut::output {

/// Names of a run's files in its folder (design: "Names on disk").
struct RunFolder {
  std::filesystem::path directory;
  std::string name;  ///< run name without _0000

  [[nodiscard]] std::filesystem::path listing() const { return directory / (name + ".out"); }
  [[nodiscard]] std::filesystem::path history() const { return directory / (name + "_th.csv"); }
  [[nodiscard]] std::filesystem::path animation_index() const { return directory / (name + ".pvd"); }
  [[nodiscard]] std::filesystem::path animation_folder() const { return directory / (name + "_anim"); }
  /// State k (0-based) of the animation.
  [[nodiscard]] std::filesystem::path animation_state(int k) const;
  /// Newest checkpoint and the one before it.
  [[nodiscard]] std::filesystem::path checkpoint() const { return directory / (name + ".rst"); }
  [[nodiscard]] std::filesystem::path previous_checkpoint() const { return directory / (name + "_previous.rst"); }
  [[nodiscard]] std::filesystem::path contact_calls(std::int64_t interface) const {
    return directory / (name + "_contact_" + std::to_string(interface) + ".calls");
  }
  /// Segments of the contact surfaces, as the deck has them.
  [[nodiscard]] std::filesystem::path contact_surfaces() const { return directory / (name + "_contact.vtu"); }
  [[nodiscard]] std::filesystem::path manifest() const { return directory / "run.json"; }
  /// Where `abut report` puts its page.
  [[nodiscard]] std::filesystem::path report() const { return directory / "report.html"; }
};

/// The call logs of this run that there are.
[[nodiscard]] std::vector<std::filesystem::path> contact_call_files(const RunFolder& folder);

/// What an earlier run of this name has left in the folder and a new one does not write anew at once: checkpoints, manifest, report, call
/// logs. They would be taken for the new run's. @throws RunError
void remove_earlier_run(const RunFolder& folder);

/// The right to write in a run folder: of one run at a time, of this process or any other, as long as it lives.
class FolderLock {
 public:
  /// Makes the folder when it is not there. @throws RunError when another run has it, or the folder cannot be written
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

 private:
  int descriptor_ = -1;
};

/// Creates a folder and those above it. @throws RunError when it cannot be made or its path is not a folder
void create_folder(const std::filesystem::path& folder);

/// A file under a temporary name beside its place, for those who put it there.
class PendingFile {
 public:
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  void write(std::string_view piece);  ///< @throws RunError

 protected:
  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;

  /// @throws RunError
  explicit PendingFile(std::filesystem::path path);
  ~PendingFile();  ///< what was not put into its place is gone
};

/// Where a file is written whose name a user gave: the file that symbolic links lead to.
/// @throws RunError when there is something else than a file: a folder, a device, a link that leads nowhere
[[nodiscard]] std::filesystem::path file_place(const std::filesystem::path& path);

/// A file that is written in pieces and renamed at the end: readers see the old content or the new.
class AtomicFile : public PendingFile {
 public:
  /// A link to a file stays, the file gets the content. @throws RunError, also when the path names something that is no regular file
  explicit AtomicFile(const std::filesystem::path& path);

  void write(std::string_view piece);  ///< @throws RunError
  /// Over what is there: as long as that. @throws RunError
  void write_at(std::uint64_t position, std::string_view piece);
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Once, at the end. @throws RunError
  void finish();

 private:
  std::uint64_t size_ = 0;
};

/// Writes a file under a temporary name beside `path` and renames it: readers see the old content or the new, never a
/// part of it, also when the process is killed. @throws RunError; the temporary file is gone then
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// Brings a file's content to the disk (fsync): it survives the machine, not only the process. @throws RunError
void sync_file(const std::filesystem::path& path);

/// A file that is written in pieces beside its place, and survives the machine once it is in it.
class DurableFile : public PendingFile {
 public:
  /// @throws RunError
  explicit DurableFile(std::filesystem::path path) : PendingFile(std::move(path)) {}

  /// Once, at the end: content, then name. What was at the path is kept under `previous`, unless that is empty; at every moment at least
  /// one of the two names a complete file. @throws RunError; what was there stays
  void replace(const std::filesystem::path& previous = {});
};

/// Whole file. @throws RunError
[[nodiscard]] std::vector<std::byte> read_bytes(const std::filesystem::path& path);

enum class Opening { fresh, resumed };

/// A text file that grows by whole pieces (lines). A piece is in the file when append() returns, so a killed run is
/// readable up to its last line; a piece that does not fit on the disk is taken back.
class AppendFile {
 public:
  AppendFile() = default;
  /// Creates or empties the file; resumed: opens what is there, persist() then says where to go on. @throws RunError
  explicit AppendFile(std::filesystem::path path, Opening opening = Opening::fresh);
  ~AppendFile();
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] bool empty() const { return good_size_ == 0; }
  void append(std::string_view piece);  ///< @throws RunError
  /// Writing: what is in the file so far is brought to the disk, its length and fingerprint noted. Reading: the file is to go on from that
  /// length; what is behind it goes when something is written, so that a resume that is refused changes nothing.
  /// @throws state::ArchiveError when the file is shorter, or not what it was up to there
  void persist(state::Archive& a);
  void close();  ///< @throws RunError when the system reports a late write error

 private:
  void cut_rest();

  std::filesystem::path path_;
  int descriptor_ = -1;
  long long good_size_ = 0;
  Fingerprint content_;    ///< of the first good_size_ bytes
  bool has_rest_ = false;  ///< the file may be longer: it was opened again
};

}  // namespace abut::output
