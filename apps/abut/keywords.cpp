#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "model/keyword_table.hpp"

namespace abut::app {

namespace {

using model::KeywordSupport;
using model::Treatment;

/// "", " (from 51)", " (41 to 44, 2026)": the versions in which a field is read, where that is not all.
std::string when(const std::vector<int>& versions) {
  const std::vector<int>& all = model::probed_versions();
  if (versions.size() == all.size()) return "";
  std::vector<std::string> runs;
  for (std::size_t k = 0; k < versions.size();) {
    const auto begin = std::find(all.begin(), all.end(), versions[k]);
    const std::size_t first = k;
    for (auto next = begin; k < versions.size() && next != all.end() && *next == versions[k]; ++next) ++k;
    const int from = versions[first], to = versions[k - 1];
    runs.push_back(from == to ? fmt::to_string(from) : to == all.back() ? fmt::format("from {}", from) : fmt::format("{} to {}", from, to));
  }
  return fmt::format(" ({})", fmt::join(runs, ", "));
}

/// "**1** surf_ID1 1-10, surf_ID2 11-20<br>**2** ...". Three and more fields of one name in a card are a list.
std::string fields_text(const std::vector<model::FieldSupport>& fields) {
  if (fields.empty()) return "no cards";
  std::string text;
  std::size_t card = 0;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const model::FieldSupport& f = fields[k];
    const auto alike = [&f](const model::FieldSupport& g) {
      return g.use.name == f.use.name && g.use.card == f.use.card && g.versions == f.versions;
    };
    const bool list = std::count_if(fields.begin(), fields.end(), alike) > 2;
    if (list && std::find_if(fields.begin(), fields.end(), alike) - fields.begin() != static_cast<std::ptrdiff_t>(k)) continue;
    if (f.use.card != card) {
      text += fmt::format("{}**{}** ", text.empty() ? "" : "<br>", f.use.card);
    } else {
      text += ", ";
    }
    card = f.use.card;
    const deck::Columns c = f.use.columns;
    const std::string columns = list                ? fmt::format("list from {}", c.first)
                                : c.first == c.last ? fmt::to_string(c.first)
                                                    : fmt::format("{}-{}", c.first, c.last);
    text += fmt::format("{} {}{}", f.use.name, columns, when(f.versions));
  }
  return text;
}

bool is_line(const std::string& word) { return word.starts_with('/'); }

/// Whether a row of the table is about the word: in its keyword or in one of its types. The start of a keyword line fits from the start.
bool fits(const KeywordSupport& k, const std::string& word) {
  const auto in = [&word](const std::string& text) {
    return is_line(word) ? text.starts_with(word) : text.find(word) != std::string::npos;
  };
  return in(k.keyword) || std::any_of(k.types.begin(), k.types.end(), [&](const std::string& type) { return in(k.keyword + "/" + type); });
}

using Rows = std::vector<KeywordSupport>;

Rows fitting(const Rows& all, const std::string& word) {
  Rows rows;
  std::copy_if(all.begin(), all.end(), std::back_inserter(rows), [&word](const KeywordSupport& k) { return fits(k, word); });
  return rows;
}

/// "/INTER/TYPE3" begins "/INTER/TYPE3/1".
bool begins(const std::string& keyword, const std::string& line) { return (line + "/").starts_with(keyword + "/"); }

/// A row for a line that the table does not spell out: what its reader says. None where the table does not know its first word either.
Rows asked(const Rows& all, const KeywordSupport& said) {
  const std::string first = said.keyword.substr(0, said.keyword.find('/', 1));
  if (said.treatment == Treatment::refused && std::none_of(all.begin(), all.end(), [&](const auto& k) { return begins(first, k.keyword); }))
    return {};
  const KeywordSupport* row = &said;  // of several rows that begin the line, the longest has its fields
  for (const KeywordSupport& k : all) {
    const bool better = row == &said || k.keyword.size() > row->keyword.size();
    if (said.treatment == Treatment::taken && k.treatment == Treatment::taken && begins(k.keyword, said.keyword) && better) row = &k;
  }
  return {*row};
}

std::string name_of(const KeywordSupport& k) { return fmt::format("`{}`", k.keyword); }

/// Keywords with their types, which those that follow each other with the same ones name once.
std::string names_of(const std::vector<KeywordSupport>& all) {
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += (text.empty() ? "" : ", ") + name_of(all[i]);
    const bool last = i + 1 == all.size() || all[i + 1].types != all[i].types;
    if (last && !all[i].types.empty()) text += fmt::format("/ {}", fmt::join(all[i].types, ", "));
  }
  return text;
}

std::vector<std::string> names_of(const Rows& all, Treatment treatment) {
  std::vector<std::string> names;
  for (const KeywordSupport& k : all) {
    if (k.treatment == treatment) names.push_back(name_of(k));
  }
  return names;
}

void print_list(std::string_view heading, const std::vector<std::string>& names) {
  if (!names.empty()) fmt::print("\n## {}\n\n{}\n", heading, fmt::join(names, ", "));
}

}  // namespace

int keywords_command(const KeywordsArguments& arguments) {
  std::string word = arguments.word;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char x) { return static_cast<char>(std::toupper(x)); });
  const Rows all_starter = model::starter_keywords(), all_engine = model::engine_keywords();
  Rows starter = fitting(all_starter, word), engine = fitting(all_engine, word);
  if (starter.empty() && engine.empty() && word.starts_with('#')) {
    fmt::print(stderr, "abut: {}: lines that begin with # are comments, but for #include FILE\n", arguments.word);
    return 1;
  }
  if (starter.empty() && engine.empty()) {
    const std::string line = is_line(word) ? word : "/" + word;
    starter = asked(all_starter, model::starter_line(line));
    engine = asked(all_engine, model::engine_line(line));
    if (starter.empty() && engine.empty()) {
      fmt::print(stderr, "abut: {} is not known to abut; a Starter or an Engine deck with it is refused\n", line);
      return 1;
    }
  }

  fmt::print(
      "# Keywords\n\nWritten by `abut keywords` from the reader's own tables and by letting its readers read; do not edit. A keyword whose "
      "words are\n"
      "not here is refused, for it may change the mechanics; fields of `/ANIM` that are not here are left out with a warning. `abut "
      "keywords "
      "LINE` asks\n"
      "the readers what they do with a line, e.g. `/SURF/SEG/1`. Format versions 41 to 2026; \"(from 51)\" and the like: versions in which "
      "the "
      "field is read\n"
      "where that is not all. Columns are those of the layout with 10 columns (from 51 on). Numbers in other fields are not looked at; one "
      "that\n"
      "crosses the edge of a field is an error, or a warning where both parts are read, for columns would cut it in two.\n");
  if (!names_of(starter, Treatment::taken).empty()) {
    fmt::print(
        "\n## Starter: read\n\nA number in bold is the card, counted without the title (of the newest layout).\n\n| keyword | cards: "
        "fields and columns "
        "|\n|---|---|\n");
    Rows alike;  // keywords that follow each other with the same fields share a row
    const auto print_row = [&alike] {
      if (!alike.empty()) fmt::print("| {} | {} |\n", names_of(alike), fields_text(alike.front().fields));
      alike.clear();
    };
    for (const KeywordSupport& k : starter) {
      if (k.treatment != Treatment::taken) continue;
      if (!alike.empty() && fields_text(k.fields) != fields_text(alike.front().fields)) print_row();
      alike.push_back(k);
    }
    print_row();
  }
  print_list("Starter: passed over, does not change the mechanics", names_of(starter, Treatment::harmless));
  if (!names_of(starter, Treatment::refused).empty()) {
    fmt::print(
        "\n## Starter: refused\n\nWhere a line above names a type, this is about the other types.\n\n| keyword | why |\n|---|---|\n");
    for (const KeywordSupport& k : starter) {
      if (k.treatment == Treatment::refused) fmt::print("| {} | {} |\n", name_of(k), k.reason);
    }
  }
  print_list("Engine: read", names_of(engine, Treatment::taken));
  print_list("Engine: passed over, does not change the mechanics", names_of(engine, Treatment::harmless));
  print_list("Engine: refused", names_of(engine, Treatment::refused));
  return 0;
}

}  // namespace abut::app
