#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
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

bool chosen(const KeywordSupport& k, const std::string& word) { return k.keyword.find(word) != std::string::npos; }

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

std::vector<std::string> rows_of(const std::vector<KeywordSupport>& all, Treatment treatment, const std::string& word) {
  std::vector<std::string> rows;
  for (const KeywordSupport& k : all) {
    if (k.treatment == treatment && chosen(k, word)) rows.push_back(name_of(k));
  }
  return rows;
}

void print_list(std::string_view heading, const std::vector<std::string>& names) {
  if (!names.empty()) fmt::print("\n## {}\n\n{}\n", heading, fmt::join(names, ", "));
}

}  // namespace

int keywords_command(const KeywordsArguments& arguments) {
  std::string word = arguments.word;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char x) { return static_cast<char>(std::toupper(x)); });
  const std::vector<KeywordSupport> starter = model::starter_keywords();
  const std::vector<KeywordSupport> engine = model::engine_keywords();
  const auto any = [&](const std::vector<KeywordSupport>& all) {
    return std::any_of(all.begin(), all.end(), [&](const KeywordSupport& k) { return chosen(k, word); });
  };
  if (!any(starter) && !any(engine)) {
    fmt::print(stderr, "abut: no keyword in the table contains {}; a deck with it is refused\n", word);
    return 1;
  }

  fmt::print(
      "# Keywords\n\nWritten by `abut keywords` from the reader's own tables and by letting its readers read; do not edit. A keyword that "
      "is not\n"
      "here is refused, for it may change the mechanics. Format versions 41 to 2026; \"(from 51)\" and the like: versions in which the "
      "field is read\n"
      "where that is not all. Columns are those of the layout with 10 columns (from 51 on). Numbers in other fields are not looked at.\n");
  if (!rows_of(starter, Treatment::taken, word).empty()) {
    fmt::print(
        "\n## Starter: read\n\nA number in bold is the card, counted without the title (of the newest layout).\n\n| keyword | cards: "
        "fields and columns "
        "|\n|---|---|\n");
    std::vector<KeywordSupport> alike;  // keywords that follow each other with the same fields share a row
    const auto print_row = [&alike] {
      if (!alike.empty()) fmt::print("| {} | {} |\n", names_of(alike), fields_text(alike.front().fields));
      alike.clear();
    };
    for (const KeywordSupport& k : starter) {
      if (k.treatment != Treatment::taken || !chosen(k, word)) continue;
      if (!alike.empty() && fields_text(k.fields) != fields_text(alike.front().fields)) print_row();
      alike.push_back(k);
    }
    print_row();
  }
  print_list("Starter: passed over, does not change the mechanics", rows_of(starter, Treatment::harmless, word));
  if (!rows_of(starter, Treatment::refused, word).empty()) {
    fmt::print(
        "\n## Starter: refused\n\nWhere a line above names a type, this is about the other types.\n\n| keyword | why |\n|---|---|\n");
    for (const KeywordSupport& k : starter) {
      if (k.treatment == Treatment::refused && chosen(k, word)) fmt::print("| {} | {} |\n", name_of(k), k.reason);
    }
  }
  print_list("Engine: read", rows_of(engine, Treatment::taken, word));
  print_list("Engine: passed over, does not change the mechanics", rows_of(engine, Treatment::harmless, word));
  print_list("Engine: refused", rows_of(engine, Treatment::refused, word));
  return 0;
}

}  // namespace abut::app
