#include "deck/scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include "deck/fields.hpp"
#include "deck/text.hpp"

namespace abut::deck {

namespace {

constexpr std::size_t include_depth_limit = 100;
constexpr int include_count_limit = 10000;

/// Walks over the lines of a text; a final CR is cut off.
class Lines {
 public:
  Lines(std::string_view text, std::size_t start, int line) : text_(text), next_(start), line_(line) {}

  bool next(std::string_view& out) {
    if (next_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', next_), text_.size());
    out = text_.substr(next_, end - next_);
    if (!out.empty() && out.back() == '\r') out.remove_suffix(1);
    next_ = end + 1;
    ++line_;
    return true;
  }
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::size_t position() const { return std::min(next_, text_.size()); }

 private:
  std::string_view text_;
  std::size_t next_;
  int line_;
};

bool starts_with_word(std::string_view line, std::string_view upper_case) {
  return line.size() >= upper_case.size() && same_word(line.substr(0, upper_case.size()), upper_case);
}

bool is_include(std::string_view line) { return starts_with_word(line, "#INCLUDE") && line.size() > 8 && is_blank(line[8]); }

/// "#includem.inc", " #include m.inc": not an include, but meant as one. A comment may begin with "#included ..." or "#includes".
bool is_misspelt_include(std::string_view line) {
  const std::string_view text = trimmed(line);
  if (!starts_with_word(text, "#INCLUDE") || is_include(line)) return false;
  const std::string_view rest = text.substr(8);
  if (text.size() == 8 || is_blank(rest.front())) return true;
  const std::string_view name = rest.substr(0, rest.find_first_of(" \t"));
  return name.size() == rest.size() && name.find('.') != std::string_view::npos && name.back() != '.';
}

bool is_end_of_data(std::string_view line) { return starts_with_word(line, "#ENDDATA") && trimmed(line).size() == 8; }

bool is_header(std::string_view line) { return starts_with_word(line, "#RADIOSS") || starts_with_word(line, "# RADIOSS"); }

bool is_comment(std::string_view line) { return !line.empty() && (line.front() == '#' || line.front() == '$'); }

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t from = 1;
  if (line.size() > 1 && line[1] == '/') {  // "//SUBMODEL": the second slash is part of the word
    from = std::min(line.find('/', 2), line.size());
    words.push_back(trimmed(line.substr(1, from - 1)));
    ++from;
  }
  while (from <= line.size()) {
    const std::size_t to = std::min(line.find('/', from), line.size());
    words.push_back(trimmed(line.substr(from, to - from)));
    from = to + 1;
  }
  while (!words.empty() && words.back().empty()) words.pop_back();
  return words;
}

/// A line of a /SET: a word, alone or with an id in the second field.
bool is_clause(std::string_view line) {
  return field_text(line, {11, card_width}).empty() || parse_integer(field_text(line, {11, 20})).has_value();
}

/// Whether the lines before the first keyword of an included file are prose (H.2, item 3): there are some, and none starts like a number.
/// @param in_set  the file is included in a /SET, whose lines start with a word
bool head_is_prose(std::string_view text, bool in_set) {
  Lines lines(text, 0, 0);
  std::string_view line;
  bool any = false;
  while (lines.next(line)) {
    if (!line.empty() && line.front() == '/') break;
    if (is_end_of_data(line)) break;
    if (is_comment(line) || is_blank_card(line)) continue;
    const char c = trimmed(line).front();
    if ((c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.') return false;
    if (in_set && !any && is_clause(line)) return false;
    any = true;
  }
  return any;
}

void trim_blank_cards(Block& block) {
  while (!block.cards.empty() && is_blank_card(block.cards.back().text)) block.cards.pop_back();
}

int add_text(Deck& deck, std::string text, std::string name) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.compare(0, byte_order_mark.size(), byte_order_mark) == 0) text.erase(0, byte_order_mark.size());
  deck.files.push_back(std::move(name));
  deck.texts.push_back(std::move(text));
  return static_cast<int>(deck.files.size()) - 1;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.parent_path().empty() ? std::filesystem::path(".") : file.parent_path();
}

Place line_place(const Deck& deck, int file, int line) {
  Place place;
  place.file = deck.files[static_cast<std::size_t>(file)];
  place.line = line;
  return place;
}

}  // namespace

bool read_file(const std::filesystem::path& path, std::string& text) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return false;
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) return false;
  text.clear();
  const auto size = std::filesystem::file_size(path, error);
  if (!error) text.reserve(static_cast<std::size_t>(size));
  char buffer[1 << 16];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) text.append(buffer, n);
  return std::ferror(file.get()) == 0;
}

std::size_t starter_offset(std::string_view text) {
  Lines lines(text, 0, 0);
  std::string_view line;
  while (lines.next(line)) {
    if (!starts_with_word(line, "/END")) continue;
    const std::vector<std::string_view> words = split_words(line);
    if (!same_word(words.front(), "END")) continue;
    return words.size() > 1 && same_word(words[1], "ENGINE") ? lines.position() : 0;
  }
  return 0;
}

StarterScanner::StarterScanner(Deck& deck, Diagnostics& diagnostics, const std::filesystem::path& path)
    : deck_(deck), diagnostics_(diagnostics) {
  if (path.empty()) return;
  std::error_code error;
  main_folder_ = folder_of(path);
  stack_.push_back(std::filesystem::weakly_canonical(path, error));
}

void StarterScanner::scan_main(std::string text, std::string name, std::size_t start) {
  const int file = add_text(deck_, std::move(text), std::move(name));
  Lines lines(deck_.texts.front(), 0, 0);
  std::string_view line;
  while (lines.next(line) && (line.empty() || line.front() != '/')) {
    if (!is_header(line)) continue;
    deck_.header = printable(line);
    break;
  }
  scan(file, std::min(start, deck_.texts.front().size()), main_folder_);
  close_block();
  if (deck_.blocks.empty()) {
    diagnostics_.error("deck.no_keyword", line_place(deck_, file, 0),
                       "no keyword line (a line that starts with '/') found: this is not a Starter deck");
  } else if (!ended_) {
    const bool within_line = deck_.texts.front().back() != '\n';
    diagnostics_.warning("deck.no_end", line_place(deck_, file, 0),
                         fmt::format("there is no /END: the file may be cut off{}; end a whole deck with /END",
                                     within_line ? ", and within a line, where a number would be cut too" : ""));
  }
}

void StarterScanner::open_block(std::string_view text, int file, int line) {
  close_block();
  Block block;
  block.keyword_line = text;
  block.words = split_words(text);
  block.file = file;
  block.line = line;
  if (block.words.empty()) {
    diagnostics_.error("deck.bad_keyword", line_place(deck_, file, line),
                       "a keyword line holds nothing but '/': a keyword such as /NODE is needed");
    skipping_ = true;
    return;
  }
  // A deck included in another one brings its own /BEGIN: the outer one rules (A.8).
  open_ = file > 0 && block.is(0, "BEGIN") ? &deck_.inner_begins : &deck_.blocks;
  open_->push_back(std::move(block));
}

void StarterScanner::close_block() {
  if (open_ != nullptr) trim_blank_cards(open_->back());
  open_ = nullptr;
  skipping_ = false;
}

void StarterScanner::scan(int file, std::size_t start, const std::filesystem::path& folder) {
  const std::string_view text = deck_.texts[static_cast<std::size_t>(file)];
  const bool included = file > 0;
  const auto skipped = text.substr(0, start);
  Lines lines(text, start, static_cast<int>(std::count(skipped.begin(), skipped.end(), '\n')));
  const bool in_set = open_ != nullptr && same_word(open_->back().word(0), "SET");
  bool in_prose = included && head_is_prose(text, in_set);
  int prose_lines = 0;
  std::string_view line;
  while (lines.next(line)) {
    if (!line.empty() && line.front() == '/') {
      in_prose = false;
      const std::vector<std::string_view> words = split_words(line);
      if (!words.empty() && same_word(words.front(), "END")) {
        ended_ = ended_ || !included;
        break;
      }
      open_block(line, file, lines.line());
    } else if (is_misspelt_include(line)) {
      diagnostics_.error("deck.include", line_place(deck_, file, lines.line()),
                         fmt::format("'{}' does not include a file: write '#include FILE' from column 1 on, with a blank before the name",
                                     printable(trimmed(line).substr(0, card_width))));
    } else if (is_comment(line)) {
      if (is_include(line)) include(line, file, lines.line(), folder);
      if (included && is_end_of_data(line)) break;
    } else if (in_prose) {
      if (!is_blank_card(line)) ++prose_lines;
    } else if (open_ != nullptr) {
      open_->back().cards.push_back({line, file, lines.line()});
    } else if (!skipping_ && !told_stray_ && !is_blank_card(line)) {
      told_stray_ = true;
      diagnostics_.warning("deck.stray_line", line_place(deck_, file, lines.line()),
                           "data before the first keyword is ignored: a data line belongs below a keyword line");
    }
  }
  if (prose_lines > 0) {
    diagnostics_.note("deck.plain_text", line_place(deck_, file, 0),
                      fmt::format("{} lines of plain text in an included file are skipped", prose_lines));
  }
}

void StarterScanner::include(std::string_view line_text, int file, int line, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const Place here = line_place(deck_, file, line);
  const std::string_view name = trimmed(line_text.substr(8));
  if (main_folder_.empty()) {
    diagnostics_.error("deck.include", here, "#include needs a deck that is read from a file, not from memory");
    return;
  }
  if (name.empty()) {
    diagnostics_.error("deck.include", here, "#include without a file name: write '#include FILE'");
    return;
  }
  std::error_code error;
  fs::path path = folder / fs::path(name);
  std::string text;
  if (!fs::exists(path, error)) path = fs::path(name);
  if (!fs::is_regular_file(path, error) || !read_file(path, text)) {
    diagnostics_.error("deck.include", here,
                       fmt::format("included file '{}' not found or not readable; searched in '{}' and in the working directory",
                                   printable(name), folder.string()));
    return;
  }
  const fs::path identity = fs::weakly_canonical(path, error);
  if (std::find(stack_.begin(), stack_.end(), identity) != stack_.end() || stack_.size() >= include_depth_limit) {
    diagnostics_.error("deck.include", here, fmt::format("file '{}' includes itself, directly or through others", printable(name)));
    return;
  }
  if (++include_count_ > include_count_limit) {
    if (include_count_ == include_count_limit + 1) {
      diagnostics_.error("deck.include", here, fmt::format("more than {} included files", include_count_limit));
    }
    return;
  }
  stack_.push_back(identity);
  const int index = add_text(deck_, std::move(text), printable(path.string()));
  scan(index, 0, folder_of(path));
  stack_.pop_back();
}

void scan_engine(Deck& deck, Diagnostics& diagnostics, std::string text, std::string name) {
  const int file = add_text(deck, std::move(text), std::move(name));
  Lines lines(deck.texts.front(), 0, 0);
  std::string_view line;
  bool told_stray = false;
  while (lines.next(line)) {
    if (is_include(line)) {
      diagnostics.error("deck.include", line_place(deck, file, lines.line()), "#include is not allowed in an Engine deck");
    }
    if (is_header(line) && deck.header.empty()) deck.header = printable(line);
    if (is_comment(line) || is_blank_card(line)) continue;
    if (line.front() == '/') {
      Block block;
      block.keyword_line = line;
      block.words = split_words(line);
      block.file = file;
      block.line = lines.line();
      if (block.words.empty()) {
        diagnostics.error("deck.bad_keyword", line_place(deck, file, lines.line()),
                          "a keyword line holds nothing but '/': a keyword such as /RUN is needed");
        continue;
      }
      if (block.is(0, "END")) break;
      deck.blocks.push_back(std::move(block));
    } else if (!deck.blocks.empty()) {
      deck.blocks.back().cards.push_back({line, file, lines.line()});
    } else if (!told_stray) {
      told_stray = true;
      diagnostics.warning("deck.stray_line", line_place(deck, file, lines.line()),
                          "data before the first keyword is ignored: a data line belongs below a keyword line");
    }
  }
}

}  // namespace abut::deck
