// Splits text into blocks of cards; knows line kinds (deck-format.md A.2) and includes, but no keyword's meaning.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "deck/deck.hpp"

namespace abut::deck {

/// Whole file as bytes; false: it cannot be read.
[[nodiscard]] bool read_file(const std::filesystem::path& path, std::string& text);

/// Offset of the line after "/END/ENGINE" when the text is a one-file deck (A.9), else 0.
[[nodiscard]] std::size_t starter_offset(std::string_view text);

class StarterScanner {
 public:
  /// @param path of the main file (includes are searched beside it first); empty: text in memory, includes are refused
  StarterScanner(Deck& deck, Diagnostics& diagnostics, const std::filesystem::path& path);

  /// Scans the main file; `start` skips the Engine part of a one-file deck.
  void scan_main(std::string text, std::string name, std::size_t start);

 private:
  /// `keyword` starts a new block; `text` is the whole line.
  void open_block(std::string_view text, int file, int line);
  void close_block();
  void scan(int file, std::size_t start, const std::filesystem::path& folder);
  void include(std::string_view line_text, int file, int line, const std::filesystem::path& folder);

  Deck& deck_;
  Diagnostics& diagnostics_;
  std::filesystem::path main_folder_;
  std::vector<std::filesystem::path> stack_;  ///< files being read, outermost first
  int include_count_ = 0;
  std::vector<Block>* open_ = nullptr;  ///< cards belong to its last block; none: before the first keyword, or below a faulty one
  bool skipping_ = false;               ///< below a faulty keyword
  bool told_stray_ = false;
  bool ended_ = false;  ///< the main file has its /END
};

void scan_engine(Deck& deck, Diagnostics& diagnostics, std::string text, std::string name);

}  // namespace abut::deck
