// What the reader does with each keyword, from the reader itself: `abut keywords` and docs/guide/keywords.md are made of it.
//
// The treatment of Starter keywords is that of the table in keywords.cpp. Fields, types of sets and the treatment of Engine keywords are
// found by letting the readers read: they are handed cards of blanks and of small numbers in the layout of every version, and say which
// fields they look at.
#pragma once

#include <string>
#include <vector>

#include "model/reader.hpp"

namespace abut::model {

enum class Treatment { taken, harmless, refused };

struct FieldSupport {
  FieldUse use;
  std::vector<int> versions;  ///< format versions in which the reader looks at the field, ascending
};

struct KeywordSupport {
  std::string keyword;  ///< "/INTER/TYPE3"
  Treatment treatment = Treatment::taken;
  std::string reason;                ///< why it is refused; empty otherwise
  std::vector<std::string> types;    ///< second words that the reader takes, where the keyword has such and the table does not list them
  std::vector<FieldSupport> fields;  ///< in the order of cards and columns; empty unless taken
};

/// Versions that are probed: each whose layout differs from its predecessor's, and the newest.
[[nodiscard]] const std::vector<int>& probed_versions();

/// The table of keywords.cpp, without fields.
[[nodiscard]] std::vector<KeywordSupport> keyword_rules();

/// The table with fields and types. Takes half a second: some ten thousand little decks are read.
[[nodiscard]] std::vector<KeywordSupport> starter_keywords();
[[nodiscard]] std::vector<KeywordSupport> engine_keywords();

/// What the readers do with a keyword line as typed ("/SURF/SEG/1"), whatever its cards are; no fields. `reason` is what they say then.
[[nodiscard]] KeywordSupport starter_line(const std::string& line);
[[nodiscard]] KeywordSupport engine_line(const std::string& line);

}  // namespace abut::model
