// One fault, one error: every number of the base deck is replaced in turn by what is no number, by an id that is not there, by a negative
// one, by 0 and by nothing; no replacement may give two errors, nor an error and a warning.
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <string>
#include <vector>

#include "unit/model/deck_text.hpp"

namespace abut::model {
namespace {

using namespace base_deck;

struct Token {
  std::size_t begin, end;
  std::string line;
};

/// Words of data lines that hold a number.
std::vector<Token> numbers_of(const std::string& deck) {
  std::vector<Token> tokens;
  std::string keyword;
  for (std::size_t i = 0; i < deck.size();) {
    const std::size_t end = deck.find('\n', i);
    const std::string line = deck.substr(i, end - i);
    if (line[0] == '/' || line[0] == '#') {
      keyword = line;
    } else {
      for (std::size_t k = 0; k < line.size();) {
        if (line[k] == ' ') {
          ++k;
          continue;
        }
        std::size_t last = line.find(' ', k);
        if (last == std::string::npos) last = line.size();
        const std::string word = line.substr(k, last - k);
        const bool number = word.find_first_not_of("0123456789+-.eE") == std::string::npos;
        if (number) tokens.push_back({i + k, i + last, keyword + ": " + line});
        k = last;
      }
    }
    i = end + 1;
  }
  return tokens;
}

/// The word, right-aligned in its place with as many blanks as it has to take from before it.
std::string replaced(const std::string& deck, const Token& t, const std::string& word) {
  std::string out = deck;
  const std::size_t width = t.end - t.begin;
  if (word.size() <= width) return out.replace(t.begin, width, std::string(width - word.size(), ' ') + word);
  const std::size_t more = word.size() - width;
  if (out.substr(t.begin - more, more).find_first_not_of(' ') != std::string::npos) return {};
  return out.replace(t.begin - more, width + more, word);
}

/// Node 2 in place of node 9 turns the brick inside out and makes the bodies share a node: each has to be said.
bool is_two_faults(const std::string& word, const std::string& line) { return word == "2" && line.starts_with("/BRICK/2: "); }

class OneFault : public ::testing::TestWithParam<const char*> {};

TEST_P(OneFault, GivesOneError) {
  const std::string word = GetParam();
  const auto base = build_text(base_starter, base_engine).messages();
  int mutants = 0, errors = 0;
  std::map<std::string, int> seen;
  for (const bool in_starter : {true, false}) {
    const std::string& deck = in_starter ? base_starter : base_engine;
    for (const Token& token : numbers_of(deck)) {
      const std::string changed = replaced(deck, token, word);
      if (changed.empty()) continue;
      const Built b = in_starter ? build_text(changed, base_engine) : build_text(base_starter, changed);
      ++mutants;
      std::vector<std::string> bad;
      int found = 0;
      for (const std::string& m : b.messages()) {
        const bool error = m.find("warning: ") == std::string::npos && m.find("note: ") == std::string::npos;
        found += error ? 1 : 0;
        if (m.find("note: ") == std::string::npos) bad.push_back(m);
      }
      errors += found;
      if (found == 0 || bad.size() < 2 || is_two_faults(word, token.line)) continue;
      std::string all = "'" + word + "' at column " + std::to_string(token.begin) + " in " + token.line;
      for (const std::string& m : bad) all += "\n    " + m;
      ADD_FAILURE() << all;
    }
  }
  EXPECT_GT(mutants, 100);
  std::printf("[found] '%s': %d decks, %d errors\n", word.c_str(), mutants, errors);
}

INSTANTIATE_TEST_SUITE_P(Words, OneFault, ::testing::Values("7,5", "?", "9999", "-1", "-2.5", "0", "", "1e30", "2"));

}  // namespace
}  // namespace abut::model
