// A folder of a test, gone with it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace abut {

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() / ("abut_run_test_" + std::to_string(::getpid()) + "_" + std::to_string(count_++))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path file(const char* name) const { return path_ / name; }

 private:
  static inline int count_ = 0;
  std::filesystem::path path_;
};

}  // namespace abut
