#include "model/keyword_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "deck/text.hpp"
#include "model/animation_names.hpp"

namespace abut::model {

namespace {

constexpr std::size_t probe_cards = 12;

struct ProbeCards {
  std::string first, others;
};

/// A Starter deck of /BEGIN, a little model that the ids of a probe find (nodes 1 to 3, part 1), and one block, whose first data card may
/// differ from the others.
class Probe {
 public:
  /// @param words  of the block's keyword line; none: the deck without it
  Probe(std::vector<std::string> words, const ProbeCards& cards, int version) {
    deck_.files = {"probe"};
    if (version < 50) {
      deck_.header = fmt::format("#RADIOSS STARTER{:>8}probe", version);
    } else {
      add({"BEGIN"}, {"probe", fmt::format("{:>10}", version), "", ""});
    }
    add_model(version < 50);
    if (words.empty()) return;
    std::vector<std::string> all(probe_cards, cards.others);
    all[version < 50 ? 0 : 1] = cards.first;  // from 51 on a title comes before it
    add(std::move(words), all);
  }

  [[nodiscard]] const deck::Deck& deck() const { return deck_; }

 private:
  std::string_view keep(std::string text) { return texts_.emplace_back(std::move(text)); }

  /// @param old  fields of 8 columns, no titles
  void add_model(bool old) {
    const auto fields = [old](const std::vector<std::string>& texts, int width) {
      std::string card;
      for (const std::string& text : texts) card += fmt::format("{:>{}}", text, old ? width * 8 / 10 : width);
      return card;
    };
    const auto titled = [old](std::vector<std::string> cards) {
      if (!old) cards.insert(cards.begin(), "probe");
      return cards;
    };
    add({"NODE"}, {fields({"1"}, 10) + fields({"0", "0", "0"}, 20), fields({"2"}, 10) + fields({"1", "0", "0"}, 20),
                   fields({"3"}, 10) + fields({"0", "1", "0"}, 20)});
    add({"MAT", "ELAST", "1"}, titled({fields({"1"}, 20), fields({"1", "0"}, 20)}));
    add({"PROP", "SHELL", "1"}, titled({"", "", fields({"0", "0"}, 10) + fields({"1"}, 20)}));
    add({"PART", "1"}, titled({fields({"1", "1"}, 10)}));
  }

  void add(std::vector<std::string> words, const std::vector<std::string>& cards) {
    deck::Block block;
    std::string line;
    for (const std::string& word : words) line += "/" + word;
    block.keyword_line = keep(line);
    for (std::string& word : words) block.words.push_back(keep(std::move(word)));
    for (const std::string& card : cards) block.cards.push_back({keep(card), 0, 1});
    deck_.blocks.push_back(std::move(block));
  }

  deck::Deck deck_;
  std::deque<std::string> texts_;
};

bool of_begin(const FieldUse& use) {
  return use.name == "name" || use.name == "Invers" || use.name.starts_with("input ") || use.name.starts_with("work ");
}

using Reading = std::pair<std::vector<FieldUse>, Diagnostics>;

Reading read_deck(const std::vector<std::string>& words, const ProbeCards& cards, int version) {
  const Probe probe(words, cards, version);
  Model model;
  std::pair<std::vector<FieldUse>, Diagnostics> found;
  Context c;
  c.deck = &probe.deck();
  c.model = &model;
  c.diagnostics = &found.second;
  c.field_log = &found.first;
  read_control(c);
  if (!words.empty() && words.front() == "BEGIN") return found;
  std::erase_if(found.first, of_begin);  // the probe has one of its own
  read_entities(c);
  return found;
}

/// Lets the Starter's readers read one block. @returns the fields they looked at in it and what they said
Reading read_probe(const std::vector<std::string>& words, const ProbeCards& cards, int version) {
  static std::map<int, std::vector<FieldUse>> models;  // what is looked at without the block
  auto model = models.find(version);
  if (model == models.end()) model = models.emplace(version, read_deck({}, {}, version).first).first;
  Reading found = read_deck(words, cards, version);
  if (words.front() == "BEGIN") return found;
  for (const FieldUse& use : model->second) {
    const auto same = std::find_if(found.first.begin(), found.first.end(), [&use](const FieldUse& f) {
      return f.card == use.card && f.name == use.name && f.columns.first == use.columns.first && f.columns.last == use.columns.last;
    });
    if (same != found.first.end()) found.first.erase(same);
  }
  return found;
}

bool is_history(const std::string& keyword) { return keyword.ends_with("TH") && keyword.size() <= 4; }

/// Cards that make the readers take their branches: nothing, and a small number in every field. Time histories begin with a line of names.
std::vector<ProbeCards> probes_of(const std::string& keyword, int version) {
  std::vector<ProbeCards> all(1);
  for (int number = 1; number <= 3; ++number) {
    std::string card;
    for (int field = 0; field < 10; ++field) card += fmt::format("{:>{}}", number, version < 50 ? 8 : 10);
    all.push_back({is_history(keyword) ? "DEF" : card, card});
  }
  return all;
}

std::vector<std::string> words_of(const KeywordSupport& k) {
  std::vector<std::string> words;
  for (std::size_t begin = 1; begin <= k.keyword.size();) {
    const std::size_t end = std::min(k.keyword.find('/', begin), k.keyword.size());
    words.push_back(k.keyword.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

/// A keyword line with a type, "PART/EXT" being two words, and id 1.
std::vector<std::string> line_of(std::vector<std::string> words, const std::string& type) {
  for (std::size_t begin = 0; begin < type.size();) {
    const std::size_t end = std::min(type.find('/', begin), type.size());
    words.push_back(type.substr(begin, end - begin));
    begin = end + 1;
  }
  words.emplace_back("1");
  return words;
}

/// What the Starter's readers did with a block by what they said, and why.
std::pair<Treatment, std::string> judge(const Diagnostics& said) {
  static const std::set<std::string_view> refusals{"model.unsupported_keyword", "model.unknown_type", "model.unsupported"};
  std::pair<Treatment, std::string> found{Treatment::taken, {}};
  for (const Diagnostic& d : said.all()) {
    if (d.severity == Severity::error && refusals.contains(d.code)) return {Treatment::refused, d.message};
    if (d.code == "model.left_out") found = {Treatment::harmless, {}};
  }
  return found;
}

/// Second words that a reader of sets may know; which it takes is asked.
std::vector<std::string> known_types(const std::string& keyword) {
  static const std::set<std::string> sets{"/GRNOD", "/GRSHEL", "/GRSH3N", "/GRBRIC", "/GRPART", "/SURF", "/BOX", "/SET"};
  static const std::vector<std::string> set_types{
      "NODE",    "NODENS",  "PART",        "PART/EXT", "PART/ALL", "SUBSET", "SUBSET/EXT", "SUBSET/ALL", "SUBMODEL", "MAT",
      "MAT/EXT", "MAT/ALL", "PROP",        "PROP/EXT", "PROP/ALL", "BOX",    "BOX/EXT",    "BOX/ALL",    "BOX2",     "SURF",
      "SEG",     "LINE",    "GENE",        "GEN_INCR", "GRNOD",    "GRSHEL", "GRSH3N",     "GRBRIC",     "GRPART",   "GRBRIC/EXT",
      "GRQUAD",  "GRTRUS",  "GRBRIC/FREE", "GRBEAM",   "SHEL",     "SH3N",   "BRIC",       "RECTA",      "CYLIN",    "SPHER",
      "GENERAL", "COLLECT", "PLANE",       "ELLIPS",   "MDELLIPS", "DSURF"};
  static const std::map<std::string, std::vector<std::string>> other_types{{"/ADMAS", {"0", "1", "2", "3", "4", "5", "6", "7"}},
                                                                           {"/SKEW", {"FIX", "MOV", "MOV2"}},
                                                                           {"/UNIT", {"MASS", "LENGTH", "TIME"}},
                                                                           {"/RANDOM", {"GRNOD"}},
                                                                           {"/SHFRA", {"V4"}}};
  static const std::vector<std::string> history_types{"NODE",  "PART",  "SHEL",   "SH3N",  "BRIC",   "INTER",
                                                      "RWALL", "RBODY", "SECTIO", "ACCEL", "SPRING", "GRNOD"};
  const auto other = other_types.find(keyword);
  const std::vector<std::string> candidates = sets.count(keyword) > 0      ? set_types
                                              : is_history(keyword)        ? history_types
                                              : other != other_types.end() ? other->second
                                                                           : std::vector<std::string>{};
  std::vector<std::string> taken;
  for (const std::string& type : candidates) {
    if (keyword != "/SURF" && type.find('/') != std::string::npos) continue;  // of other sets the word after the type is the id
    const bool refused = judge(read_probe(line_of({keyword.substr(1)}, type), {}, 2022).second).first != Treatment::taken;
    if (!refused) taken.push_back(type);
  }
  return taken;
}

/// A field is the same in all versions that have its name in its columns; its card is the one of the newest of them.
std::vector<FieldSupport> fields_of(const KeywordSupport& k) {
  using Key = std::tuple<std::string, int, int>;
  std::map<Key, FieldSupport> fields;
  std::vector<std::string> types = k.types;
  types.emplace_back();  // some have a form without a type too
  for (const int version : probed_versions()) {
    std::map<Key, std::size_t> card_of;  // lists repeat their fields in every card: the first one stands for all
    for (const std::string& type : types) {
      std::vector<std::string> line = line_of(words_of(k), type);
      if (k.keyword == "/RANDOM" && type.empty()) line.pop_back();
      for (const ProbeCards& cards : probes_of(k.keyword, version)) {
        for (const FieldUse& use : read_probe(line, cards, version).first) {
          std::size_t& first = card_of.try_emplace({use.name, use.columns.first, use.columns.last}, use.card).first->second;
          first = std::min(first, use.card);
        }
      }
    }
    for (const auto& [key, card] : card_of) {
      const auto& [name, first, last] = key;
      FieldSupport& field = fields[key];
      field.use = {card, {first, last}, name};
      field.versions.push_back(version);
    }
  }
  std::vector<FieldSupport> sorted;
  for (auto& [key, field] : fields) sorted.push_back(std::move(field));
  std::sort(sorted.begin(), sorted.end(), [](const FieldSupport& a, const FieldSupport& b) {
    const auto order = [](const FieldSupport& f) { return std::tuple(f.use.card, f.use.columns.first, f.use.columns.last, f.use.name); };
    return order(a) < order(b);
  });
  return sorted;
}

}  // namespace

const std::vector<int>& probed_versions() {
  static const std::vector<int> versions{41, 42, 44, 51, 90, 110, 120, 130, 140, 2017, 2019, 2022, 2024, 2026};
  return versions;
}

std::vector<KeywordSupport> starter_keywords() {
  std::vector<KeywordSupport> all = keyword_rules();
  all.insert(all.begin(), {{"#INCLUDE", Treatment::taken, {}, {}, {}}, {"/END", Treatment::taken, {}, {}, {}}});  // of the scanner
  for (KeywordSupport& k : all) {
    if (k.treatment != Treatment::taken) continue;
    k.types = known_types(k.keyword);
    k.fields = fields_of(k);
  }
  return all;
}

std::vector<KeywordSupport> engine_keywords() {
  static const std::vector<std::string> candidates{
      "RUN/probe/1",  "VERS",         "TITLE",      "TFILE",     "PRINT",     "RFILE",       "STOP",         "KILL",
      "DT",           "DT/BRICK",     "DT/SHELL",   "DT/SH_3N",  "DT/NODA",   "DT/NODA/CST", "DT/NODA/STOP", "DT/INTER",
      "DT/INTER/DEL", "DT/INTER/CST", "DT/BEAM",    "DT/SPRING", "DTIX",      "ANIM/DT",     "ANIM/GZIP",    "RBODY/ON",
      "RBODY/OFF",    "MON/ON",       "PARITH/ON",  "PROC",      "DEBUG",     "OUTP/DT",     "STATE/DT",     "DYNAIN/DT",
      "H3D/DT",       "ATFILE",       "DAMP",       "DEL/SHELL", "DEL/BRICK", "DELINT",      "BCS/TRA",      "VEL/TRA",
      "INIV/TRA",     "KEREL",        "ADYREL",     "DYREL",     "SENSOR",    "RERUN",       "IMPL/LINEAR",  "ALE/ON",
      "UPWIND",       "SHVER",        "DT1",        "DTSDE",     "INTER",     "AMS",         "FUNCT",        "NEGVOL/STOP",
      "TH/VERS",      "TH/TITLE",     "CHECKPOINT", "THREAD",    "NOISE",     "ABF",         "IOFLAG",       "END"};
  std::vector<KeywordSupport> all{{"#INCLUDE", Treatment::refused, "write the lines into the Engine deck", {}, {}}};
  for (const std::string& name : candidates) {
    all.push_back(engine_line("/" + name));
    all.back().keyword = "/" + name.substr(0, name.find("/probe"));
  }
  for (const std::string& name : animation_names()) all.push_back(engine_line("/ANIM/" + name));
  return all;
}

KeywordSupport starter_line(const std::string& line) {
  KeywordSupport k;
  k.keyword = line;
  Diagnostics unused;
  const deck::Deck typed = deck::read_starter_text(line + "\n", "probe", unused);
  if (typed.blocks.empty()) return k;  // the end of the deck
  std::vector<std::string> words;
  for (const std::string_view word : typed.blocks.front().words) words.emplace_back(word);
  const Probe probe(words, {}, 2022);
  Model model;
  Diagnostics said;
  Context c;
  c.deck = &probe.deck();
  c.model = &model;
  c.diagnostics = &said;
  read_control(c);
  read_entities(c);
  check_keywords(c);
  std::tie(k.treatment, k.reason) = judge(said);
  if (!model.skipped.empty()) k.treatment = Treatment::harmless;
  return k;
}

KeywordSupport engine_line(const std::string& line) {
  Diagnostics said;
  const bool runs = deck::same_word(std::string_view(line).substr(0, 5), "/RUN/");
  const deck::Deck engine =
      deck::read_engine_text("#RADIOSS ENGINE\n" + std::string(runs ? "" : "/RUN/probe/1\n1.0\n") + line + "\n0.9 1e-6\n", "probe", said);
  const Probe starter({"TITLE"}, {}, 2022);
  Model model;
  Context c;
  c.deck = &starter.deck();
  c.model = &model;
  c.diagnostics = &said;
  read_engine(c, engine, 1);
  const auto says = [&said](std::string_view code) {
    return std::any_of(said.all().begin(), said.all().end(), [code](const Diagnostic& d) { return d.code == code; });
  };
  KeywordSupport k;
  k.keyword = line;
  k.treatment = says("engine.unsupported")                          ? Treatment::refused
                : says("engine.skipped") || says("engine.left_out") ? Treatment::harmless
                                                                    : Treatment::taken;
  return k;
}

}  // namespace abut::model
