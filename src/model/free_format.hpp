// The data lines of an Engine keyword: blanks and commas separate numbers, missing ones at the end are 0.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic.hpp"
#include "deck/deck.hpp"

namespace abut::model {

class FreeFormat {
 public:
  FreeFormat(const deck::Deck& deck, const deck::Block& block, Diagnostics& diagnostics);
  /// Warns of lines and of text that no number was read from, unless the block has an error.
  ~FreeFormat();
  FreeFormat(const FreeFormat&) = delete;
  FreeFormat& operator=(const FreeFormat&) = delete;

  [[nodiscard]] bool empty() const { return lines_.empty(); }
  /// k-th number of the first line that is not blank.
  double real(std::size_t k, std::string_view field);
  /// A value that cannot be negative.
  double positive(std::size_t k, std::string_view field);
  /// All integers from line `first` on.
  std::vector<Id> integers(std::size_t first, std::string_view field);
  /// @param line counts the lines that are not blank
  void bad(std::size_t line, std::string_view field, std::string message, Severity severity = Severity::error);

 private:
  [[nodiscard]] Place place(std::size_t line) const;

  const deck::Deck& deck_;
  const deck::Block& block_;
  Diagnostics& diagnostics_;
  int errors_before_;
  std::vector<std::pair<std::size_t, std::vector<std::string_view>>> lines_;  ///< card and its words
  std::size_t words_read_ = 0;                                                ///< of the first line
  std::size_t lines_read_ = 0;
};

}  // namespace abut::model
