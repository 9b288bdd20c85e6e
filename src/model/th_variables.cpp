#include "model/th_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace abut::model {

namespace {

struct KindTable {
  std::string_view word;
  std::vector<std::string> variables;
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;  ///< the first one is DEF
};

using Names = std::vector<std::string>;

const Names stress{"SX", "SY", "SZ", "SXY", "SYZ", "SXZ"};
const Names local_stress{"LSX", "LSY", "LSZ", "LSXY", "LSYZ", "LSXZ"};
const Names brick_strain{"EPSXX", "EPSYY", "EPSZZ", "EPSXY", "EPSYZ", "EPSXZ"};
const Names normal_force{"FNX", "FNY", "FNZ"}, tangential_force{"FTX", "FTY", "FTZ"};
const Names both_forces{"FNX", "FNY", "FNZ", "FTX", "FTY", "FTZ"};

KindTable shell_table(std::string_view word) {
  Names variables{"F1",   "F2",   "F12", "Q1", "Q2",  "M1",  "M2",  "M12", "IEM", "IEB", "OFF", "THIC",
                  "EMIN", "EMAX", "E1",  "E2", "E12", "SH1", "SH2", "K1",  "K2",  "K12", "EPSD"};
  for (int i = 1; i <= 10; ++i) {
    for (const char* s : {"SX", "SY", "SXY", "SYZ", "SZX", "EPSP"}) variables.push_back(fmt::format("{}_{}", s, i));
  }
  std::vector<std::pair<std::string, Names>> groups{{"DEF", {"F1", "F2", "F12", "M1", "M2", "M12", "IEM", "IEB", "OFF", "EMIN", "EMAX"}},
                                                    {"STRESS", {"F1", "F2", "F12", "Q1", "Q2", "M1", "M2", "M12"}},
                                                    {"STRAIN", {"E1", "E2", "E12", "SH1", "SH2", "K1", "K2", "K12"}},
                                                    {"PLAS", {"EMIN", "EMAX"}}};
  for (int i = 1; i <= 10; ++i) {
    Names point;
    for (const char* s : {"SX", "SY", "SXY", "SYZ", "SZX"}) point.push_back(fmt::format("{}_{}", s, i));
    groups.emplace_back(fmt::format("SIG_{}", i), std::move(point));
  }
  return {word, std::move(variables), std::move(groups)};
}

/// In the order of ThKind.
const std::array<KindTable, 10>& tables() {
  static const std::array<KindTable, 10> all{
      KindTable{"NODE",
                {"DX",  "DY", "DZ", "VX", "VY",   "VZ",    "AX",    "AY",    "AZ",     "VRX",    "VRY",    "VRZ", "ARX", "ARY",
                 "ARZ", "X",  "Y",  "Z",  "TEMP", "REACX", "REACY", "REACZ", "REACXX", "REACYY", "REACZZ", "DRX", "DRY", "DRZ"},
                {{"DEF", {"DX", "DY", "DZ", "VX", "VY", "VZ"}},
                 {"D", {"DX", "DY", "DZ"}},
                 {"V", {"VX", "VY", "VZ"}},
                 {"A", {"AX", "AY", "AZ"}},
                 {"VR", {"VRX", "VRY", "VRZ"}},
                 {"AR", {"ARX", "ARY", "ARZ"}},
                 {"XYZ", {"X", "Y", "Z"}}}},
      KindTable{"PART",
                {"IE",    "KE",  "XMOM", "YMOM", "ZMOM", "MASS", "HE",  "HEAT", "ERODED", "TURBKE", "XCG", "YCG", "ZCG", "XXMOM", "YYMOM",
                 "ZZMOM", "IXX", "IYY",  "IZZ",  "IXY",  "IYZ",  "IZX", "RIE",  "KERB",   "RKERB",  "RKE", "VX",  "VY",  "VZ",    "PW"},
                {{"DEF", {"IE", "KE", "XMOM", "YMOM", "ZMOM", "MASS", "HE", "HEAT", "ERODED"}}}},
      shell_table("SHEL"),
      shell_table("SH3N"),
      KindTable{"BRIC",
                {"OFF",  "SX",   "SY",   "SZ",    "SXY",   "SYZ",   "SXZ",   "IE",    "DENS",  "BULK",   "VOL",
                 "PLAS", "TEMP", "PLSR", "DAM1",  "DAM2",  "DAM3",  "DAM4",  "DAM5",  "LSX",   "LSY",    "LSZ",
                 "LSXY", "LSYZ", "LSXZ", "EPSXX", "EPSYY", "EPSZZ", "EPSXY", "EPSYZ", "EPSXZ", "VSTRAIN"},
                {{"DEF", {"OFF", "SX", "SY", "SZ", "SXY", "SYZ", "SXZ", "IE", "DENS", "PLAS", "TEMP"}},
                 {"STRESS", stress},
                 {"LOCSTRS", local_stress},
                 {"LOCSTRESS", local_stress},
                 {"STRAIN", brick_strain}}},
      KindTable{"INTER",
                {"FNX",  "FNY",   "FNZ",  "FTX",  "FTY",  "FTZ",      "|FNX|",   "|FNY|",   "|FNZ|", "||FN||", "|FX|",  "|FY|",
                 "|FZ|", "||F||", "MX",   "MY",   "MZ",   "CE_ELAST", "CE_FRIC", "CE_DAMP", "CAREA", "SFW",    "QFRIC", "IFNX",
                 "IFNY", "IFNZ",  "IFTX", "IFTY", "IFTZ", "CE",       "FW",      "DW",      "CX",    "NC",     "SW"},
                {{"DEF", both_forces},
                 {"FN", normal_force},
                 {"FT", tangential_force},
                 {"|FN|", {"|FNX|", "|FNY|", "|FNZ|", "||FN||"}},
                 {"|F|", {"|FX|", "|FY|", "|FZ|", "||F||"}}}},
      KindTable{"RWALL", both_forces, {{"DEF", both_forces}, {"FN", normal_force}, {"FT", tangential_force}}},
      KindTable{"RBODY",
                {"FX",  "FY",  "FZ",  "MX",  "MY",  "MZ",   "RX",  "RY",  "RZ",  "FXI", "FYI", "FZI", "MXI",   "MYI",
                 "MZI", "X",   "Y",   "Z",   "DX",  "DY",   "DZ",  "VX",  "VY",  "VZ",  "AX",  "AY",  "AZ",    "VRX",
                 "VRY", "VRZ", "ARX", "ARY", "ARZ", "MASS", "IXX", "IYY", "IZZ", "IXY", "IYZ", "IZX", "STATUS"},
                {{"DEF", {"FX", "FY", "FZ", "MX", "MY", "MZ", "RX", "RY", "RZ"}},
                 {"F", {"FX", "FY", "FZ"}},
                 {"M", {"MX", "MY", "MZ"}},
                 {"R", {"RX", "RY", "RZ"}},
                 {"FI", {"FXI", "FYI", "FZI"}},
                 {"MI", {"MXI", "MYI", "MZI"}},
                 {"XYZ", {"X", "Y", "Z"}},
                 {"D", {"DX", "DY", "DZ"}},
                 {"V", {"VX", "VY", "VZ", "VRX", "VRY", "VRZ"}},
                 {"A", {"AX", "AY", "AZ", "ARX", "ARY", "ARZ"}}}},
      KindTable{"SECTIO",
                {"FNX", "FNY", "FNZ", "FTX", "FTY", "FTZ", "M1", "M2", "M3",   "MX",
                 "MY",  "MZ",  "CX",  "CY",  "CZ",  "F1",  "F2", "F3", "WORK", "WORKR"},
                {{"DEF", {"FNX", "FNY", "FNZ", "FTX", "FTY", "FTZ", "M1", "M2", "M3"}},
                 {"FN", normal_force},
                 {"FT", tangential_force},
                 {"M", {"M1", "M2", "M3"}},
                 {"CENTER", {"CX", "CY", "CZ"}},
                 {"GLOBAL", {"FNX", "FNY", "FNZ", "FTX", "FTY", "FTZ", "MX", "MY", "MZ"}},
                 {"LOCAL", {"M1", "M2", "M3", "F1", "F2", "F3"}}}},
      KindTable{"ACCEL", {"AX", "AY", "AZ", "WX", "WY", "WZ"}, {{"DEF", {"AX", "AY", "AZ"}}, {"W", {"WX", "WY", "WZ"}}}}};
  return all;
}

const KindTable& table_of(ThKind kind) { return tables()[static_cast<std::size_t>(kind)]; }

std::string upper(std::string_view text) {
  std::string s(text);
  for (char& x : s) x = static_cast<char>(std::toupper(static_cast<unsigned char>(x)));
  return s;
}

}  // namespace

std::optional<ThKind> th_kind(std::string_view word) {
  std::string name = upper(word);
  if (name == "SHELL") name = "SHEL";
  if (name == "BRICK") name = "BRIC";
  for (std::size_t i = 0; i < tables().size(); ++i) {
    if (tables()[i].word == name) return static_cast<ThKind>(i);
  }
  return std::nullopt;
}

std::string_view th_word(ThKind kind) { return table_of(kind).word; }

const std::vector<std::string>& th_variables(ThKind kind) { return table_of(kind).variables; }

std::vector<std::string> th_expand(ThKind kind, std::string_view name) {
  const std::string wanted = upper(name);
  const KindTable& table = table_of(kind);
  for (const auto& [group, variables] : table.groups) {
    if (group == wanted) return variables;
  }
  if (std::find(table.variables.begin(), table.variables.end(), wanted) != table.variables.end()) return {wanted};
  return {};
}

}  // namespace abut::model
