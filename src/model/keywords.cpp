// What abut does with each Starter keyword: take it, read past it, or refuse the deck (deck-format.md A.13, H.1).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "deck/text.hpp"
#include "model/keyword_table.hpp"
#include "model/reader.hpp"

namespace abut::model {

namespace {

struct Rule {
  std::string_view keyword;
  std::string_view type;  ///< second word; empty: every other one
  Treatment treatment = Treatment::taken;
  std::string_view reason = {};
};

constexpr std::string_view element_reason = "abut has no elements of this kind; SHELL, SH3N, BRICK, TETRA4 and PENTA6 are supported";
constexpr std::string_view property_reason =
    "abut does not have this property; SHELL (TYPE1), SOLID (TYPE14) and VOID (TYPE0) are supported";
constexpr std::string_view law_reason = "abut does not have this law; VOID (LAW0), ELAST (LAW1) and PLAS_JOHNS (LAW2) are supported";
constexpr std::string_view interface_reason = "abut does not have this interface; TYPE3, TYPE5 and TYPE7 are supported";
constexpr std::string_view outside_reason = "outside the scope of abut (explicit dynamics of shells and solids in contact)";
constexpr std::string_view unknown_reason = "not known to abut; it may change the mechanics";

using enum Treatment;

/// The first rule whose keyword and type fit counts; a keyword without a rule is refused.
constexpr std::array rules{
    // control
    Rule{"BEGIN", ""},
    Rule{"UNIT", ""},
    Rule{"TITLE", ""},
    Rule{"DEF_SHELL", ""},
    Rule{"DEF_SOLID", ""},
    Rule{"ANALY", ""},
    Rule{"RANDOM", ""},
    Rule{"SHFRA", ""},
    Rule{"IOFLAG", "", harmless},
    Rule{"SPMD", "", harmless},
    Rule{"MEMORY", "", harmless},
    Rule{"ARCH", "", harmless},
    Rule{"INTTHICK", "", harmless},
    Rule{"CAA", "", harmless},
    Rule{"ALTDOCTAG", "", harmless},
    Rule{"SYNTAX", "", harmless},
    Rule{"PRIVATE", "", harmless},
    Rule{"REFER", "", harmless},
    Rule{"VERS", "", harmless},
    Rule{"KEY", "", harmless},
    Rule{"CHECKSUM", "", harmless},
    Rule{"ASSEMBLY", "", harmless},
    Rule{"POSITION", "", harmless},
    Rule{"DUMMY_START", "", harmless},
    Rule{"DUMMY_END", "", harmless},
    Rule{"HPOINT", "", harmless},
    Rule{"AMS", "", harmless},
    // mesh
    Rule{"NODE", ""},
    Rule{"PART", ""},
    Rule{"SUBSET", ""},
    Rule{"SHELL", ""},
    Rule{"SH3N", ""},
    Rule{"BRICK", ""},
    Rule{"TETRA4", ""},
    Rule{"PENTA6", ""},
    Rule{"TETRA10", "", refused, element_reason},
    Rule{"BRIC20", "", refused, element_reason},
    Rule{"SHEL16", "", refused, element_reason},
    Rule{"BEAM", "", refused, element_reason},
    Rule{"TRUSS", "", refused, element_reason},
    Rule{"SPRING", "", refused, element_reason},
    Rule{"QUAD", "", refused, element_reason},
    Rule{"TRIA", "", refused, element_reason},
    Rule{"SPHCEL", "", refused, element_reason},
    Rule{"XELEM", "", refused, element_reason},
    Rule{"PROP", "SHELL"},
    Rule{"PROP", "TYPE1"},
    Rule{"PROP", "TYPE01"},
    Rule{"PROP", "SOLID"},
    Rule{"PROP", "TYPE14"},
    Rule{"PROP", "VOID"},
    Rule{"PROP", "TYPE0"},
    Rule{"PROP", "TYPE00"},
    Rule{"PROP", "", refused, property_reason},
    Rule{"MAT", "VOID"},
    Rule{"MAT", "LAW0"},
    Rule{"MAT", "LAW00"},
    Rule{"MAT", "ELAST"},
    Rule{"MAT", "LAW1"},
    Rule{"MAT", "LAW01"},
    Rule{"MAT", "PLAS_JOHNS"},
    Rule{"MAT", "LAW2"},
    Rule{"MAT", "LAW02"},
    Rule{"MAT", "", refused, law_reason},
    Rule{"FUNCT", ""},
    Rule{"MOVE_FUNCT", ""},
    Rule{"SKEW", ""},
    // A function, frame, line, sensor or group of these kinds does nothing by itself: who refers to it reports that it is missing.
    Rule{"FUNCT_PYTHON", "", harmless},
    Rule{"FUNCT_SMOOTH", "", harmless},
    Rule{"TABLE", "", harmless},
    Rule{"FRAME", "", harmless},
    Rule{"LINE", "", harmless},
    Rule{"GRQUAD", "", harmless},
    Rule{"GRTRIA", "", harmless},
    Rule{"GRTRUS", "", harmless},
    Rule{"GRBEAM", "", harmless},
    Rule{"GRSPRI", "", harmless},
    // sets
    Rule{"GRNOD", ""},
    Rule{"GRSHEL", ""},
    Rule{"GRSH3N", ""},
    Rule{"GRBRIC", ""},
    Rule{"GRPART", ""},
    Rule{"BOX", ""},
    Rule{"SURF", ""},
    Rule{"SET", ""},
    // conditions
    Rule{"BCS", "LAGMUL", refused, "conditions by Lagrange multipliers are not supported: use /BCS"},
    Rule{"BCS", ""},
    Rule{"INIVEL", "TRA"},
    Rule{"INIVEL", "ROT"},
    Rule{"INIVEL", "T+G"},
    Rule{"INIVEL", "AXIS"},
    Rule{"INIVEL", "NODE"},
    Rule{"INIVEL", "GRID", harmless},
    Rule{"INIVEL", "FVM", harmless},
    Rule{"INIVEL", "", refused, "initial velocities of types TRA, ROT, T+G, AXIS and NODE are supported"},
    Rule{"IMPVEL", "FGEO", refused, unknown_reason},
    Rule{"IMPVEL", "LAGMUL", refused, unknown_reason},
    Rule{"IMPVEL", ""},
    Rule{"IMPDISP", "FGEO", refused, unknown_reason},
    Rule{"IMPDISP", ""},
    Rule{"IMPACC", ""},
    Rule{"CLOAD", ""},
    Rule{"PLOAD", ""},
    Rule{"GRAV", ""},
    Rule{"ADMAS", ""},
    Rule{"RBODY", "LAGMUL", refused, unknown_reason},
    Rule{"RBODY", ""},
    Rule{"RWALL", "PLANE"},
    Rule{"RWALL", "", refused, "rigid walls of type PLANE are supported"},
    Rule{"SENSOR", "TIME"},
    Rule{"SENSOR", "", harmless},
    Rule{"ACTIV", "", refused, "elements cannot be switched on and off by sensors"},
    Rule{"DAMP", "", refused, "Rayleigh damping is not supported"},
    Rule{"ALE", "BCS", harmless},
    Rule{"ALE", "", refused, outside_reason},
    // interfaces
    Rule{"INTER", "TYPE3"},
    Rule{"INTER", "TYPE5"},
    Rule{"INTER", "TYPE7"},
    Rule{"INTER", "", refused, interface_reason},
    // outputs
    Rule{"TH", ""},
    Rule{"SECT", ""},
    Rule{"ACCEL", ""},
    Rule{"ATH", ""},
    Rule{"BTH", ""},
    Rule{"CTH", ""},
    Rule{"DTH", ""},
    Rule{"ETH", ""},
    Rule{"FTH", ""},
    Rule{"GTH", ""},
    Rule{"HTH", ""},
    Rule{"ITH", ""},
    Rule{"THPART", "", harmless},
    Rule{"GAUGE", "", harmless},
    Rule{"STATE", "", harmless},
    Rule{"OUTP", "", harmless},
    Rule{"H3D", "", harmless},
    Rule{"ANIM", "", harmless},
    // known to be out of reach
    Rule{"/SUBMODEL", "", refused, "sub-models shift ids and units: write the model as one deck"},
    Rule{"/ENDSUB", "", harmless},
    Rule{"TRANSFORM", "", refused, "sub-models and groups are not moved: write the final coordinates"},
    Rule{"PARAMETER", "", refused, "parameters are not supported: write the numbers"},
    Rule{"FAIL", "", refused, "failure models are not supported; LAW2 has a failure strain"},
    Rule{"INIBRI", "", refused, "initial states of elements are not supported"},
    Rule{"INISHE", "", refused, "initial states of elements are not supported"},
    Rule{"INISH3", "", refused, "initial states of elements are not supported"},
    Rule{"IMPLICIT", "", refused, outside_reason},
    Rule{"EIG", "", refused, outside_reason},
    Rule{"STAMPING", "", refused, outside_reason},
    Rule{"PERTURB", "", refused, outside_reason},
    Rule{"EOS", "", refused, outside_reason},
    Rule{"MONVOL", "", refused, outside_reason},
    Rule{"EBCS", "", refused, outside_reason},
    Rule{"XREF", "", refused, outside_reason},
    Rule{"REFSTA", "", refused, outside_reason},
};

Rule rule_for(const deck::Block& b) {
  const auto found =
      std::find_if(rules.begin(), rules.end(), [&](const Rule& r) { return b.is(0, r.keyword) && (r.type.empty() || b.is(1, r.type)); });
  return found != rules.end() ? *found : Rule{"", "", refused, unknown_reason};
}

/// "  /BCS/1" -> "/BCS/1" where the word is a keyword of the table; empty: the line is data.
std::string_view indented_keyword(std::string_view line) {
  const std::string_view text = deck::trimmed(line);
  if (text.empty() || text.front() != '/' || line.front() == '/') return {};
  const std::string_view word = deck::trimmed(text.substr(1, text.find('/', 1) - 1));
  const bool known = std::any_of(rules.begin(), rules.end(), [word](const Rule& r) { return deck::same_word(word, r.keyword); });
  return known ? text : std::string_view{};
}

void check_indented(Context& c, const deck::Block& b) {
  for (const deck::Card& card : b.cards) {
    const std::string_view keyword = indented_keyword(card.text);
    if (keyword.empty()) continue;
    c.diagnostics->error("deck.indented_keyword", c.deck->place(b, card),
                         fmt::format("'{}' does not begin in column 1 and would be taken for data; take out the blanks before it",
                                     deck::printable(keyword.substr(0, deck::card_width))));
    return;
  }
}

/// "/INTER/TYPE11", "/BEAM": the words before the id.
std::string spelling(const deck::Block& b) {
  std::string name = "/" + deck::to_upper(b.word(0));
  const std::string_view second = b.word(1);
  if (!second.empty() && !deck::parse_integer(second)) name += "/" + deck::to_upper(second);
  return deck::printable(std::string_view(name).substr(0, deck::card_width));
}

}  // namespace

std::vector<KeywordSupport> keyword_rules() {
  std::vector<KeywordSupport> all;
  for (const Rule& r : rules) {
    std::string keyword = "/" + std::string(r.keyword);
    if (!r.type.empty()) keyword += "/" + std::string(r.type);
    all.push_back({keyword, r.treatment, std::string(r.reason), {}, {}});
  }
  return all;
}

bool is_refused(const deck::Block& block) { return rule_for(block).treatment == refused; }

void check_keywords(Context& c) {
  struct Refusal {
    const deck::Block* first;
    std::string_view reason;
    int blocks = 0;
    std::size_t lines = 0;
  };
  std::map<std::string, Refusal> refusals;
  std::map<std::string, int> skipped;
  Place place_of_ams;
  for (const deck::Block& b : c.deck->blocks) {
    check_indented(c, b);
    if (b.is(0, "AMS")) place_of_ams = c.deck->place(b);
    const Rule rule = rule_for(b);
    if (rule.treatment == harmless) ++skipped[spelling(b)];
    if (rule.treatment != refused) continue;
    Refusal& r = refusals.try_emplace(spelling(b), Refusal{&b, rule.reason}).first->second;
    ++r.blocks;
    r.lines += b.cards.size();
  }
  for (const auto& [name, count] : skipped) {
    c.model->skipped.push_back({name, count});
    if (name == "/AMS")
      c.diagnostics->warning("model.mass_scaling", place_of_ams,
                             "advanced mass scaling (/AMS) is not done: the time step is smaller than with it");
  }
  for (const auto& [name, r] : refusals) {
    std::string count = r.blocks == 1 ? "" : fmt::format(" ({} blocks)", r.blocks);
    if (r.reason == element_reason) count = fmt::format(" ({} blocks with {} lines)", r.blocks, r.lines);
    c.diagnostics->error("model.unsupported_keyword", c.deck->place(*r.first),
                         fmt::format("{}{} is not supported: {}", name, count, r.reason));
  }
}

}  // namespace abut::model
