// The animation of a run as chunks: the mesh once, then what each state shows of it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/chunk.hpp"
#include "report/report.hpp"

namespace abut::report {

using Json = nlohmann::ordered_json;

/// Chunks in the order in which they were made; `add` says where a chunk is.
class ChunkStore {
 public:
  /// {id, kind, count, components, low, high}; id -1 for a constant chunk, which has no text.
  [[nodiscard]] Json add(Chunk chunk);
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::vector<std::string> texts_;
};

struct StateFile {
  double time = 0.0;
  std::filesystem::path file;
};

/// Adds "mesh", "contact", "fields" and "frames" to `document` (viewer/src/data/document.ts says what they hold), and "first": the frame
/// to open with, the one with the largest contact pressure.
/// @param contact_file  contact surfaces; may not exist
Written add_states(const std::vector<StateFile>& states, const std::filesystem::path& contact_file, Fields fields, ChunkStore& store,
                   Json& document);

/// Files that an animation index (.pvd) names, with their times. Empty when there is no index.
[[nodiscard]] std::vector<StateFile> read_index(const std::filesystem::path& index);

}  // namespace abut::report
