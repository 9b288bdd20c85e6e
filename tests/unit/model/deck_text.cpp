#include "unit/model/deck_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abut::model::base_deck {

const char* const base_starter = R"deck(#RADIOSS STARTER
/BEGIN
base
      2022         0
                  kg                  mm                  ms
                  kg                  mm                  ms
/TITLE
two blocks, two plates
/NODE
         1                   0                   0                   0
         2                   1                   0                   0
         3                   1                   1                   0
         4                   0                   1                   0
         5                   0                   0                   1
         6                   1                   0                   1
         7                   1                   1                   1
         8                   0                   1                   1
         9                   0                   0                 1.1
        10                   1                   0                 1.1
        11                   1                   1                 1.1
        12                   0                   1                 1.1
        13                   0                   0                 2.1
        14                   1                   0                 2.1
        15                   1                   1                 2.1
        16                   0                   1                 2.1
        21                   0                   0                   5
        22                   1                   0                   5
        23                   1                   1                   5
        24                   0                   1                   5
        25                   0                   0                 5.5
        26                   1                   0                 5.5
        27                   1                   1                 5.5
        28                   0                   1                 5.5
        30                 0.5                 0.5                   3
        31                 0.5                 0.5                   9
/MAT/ELAST/1
steel
              7.8E-6                   0
                 210                 0.3
/MAT/PLAS_JOHNS/2
mild steel
              7.8E-6                   0
                 210                 0.3
                 0.3                 0.5                 0.5                   0                   0
                   0                   0         0         0                   0                   0
                   0                   0                   0                   0
/PROP/SOLID/1
one point brick
         1         4                   0         0         0         0         0                   0
                   0                   0                   0
                   0
/PROP/SHELL/2
plate
         1         2         0         0                                       0
                   0                   0                   0                   0                   0
         5         0                 0.5                   0                   0         0
/PART/1
lower
         1         1         0
/PART/2
upper
         1         1         0
/PART/3
plate
         2         2         0
/PART/4
cover
         2         2         0
/BRICK/1
         1         1         2         3         4         5         6         7         8
/BRICK/2
         2         9        10        11        12        13        14        15        16
/SHELL/3
         3        21        22        23        24
/SHELL/4
         4        25        28        27        26
/FUNCT/1
ramp
                   0                   0
                   1                   1
/SKEW/FIX/1
turned
                   0                   0                   0
                   0                   1                   0
                   0                   0                   1
/GRNOD/PART/1
lower nodes
         1
/GRNOD/NODE/2
upper nodes and main node
         9        10        11        12        13        14        15        16        30
/GRNOD/NODE/3
top
        13        14        15        16
/GRNOD/PART/4
cover nodes
         4
/GRNOD/NODE/5
main node
        30
/GRNOD/NODE/6
loose node
        31
/GRNOD/PART/7
plate nodes
         3
/SURF/PART/EXT/1
lower skin
         1
/SURF/PART/EXT/2
upper skin
         2
/SURF/PART/3
plate
         3
/SENSOR/TIME/1
late
                0.01
/BCS/1
clamp
   111 111         0         1
/INIVEL/TRA/1
fall
                   0                   0                 -10         2         0
/IMPVEL/1
push
         1         Z         0         1         4         0         0
                   1                  -2                   0                 0.5
/CLOAD/1
pull
         1         X         1         0         5         0                   0                   3
/PLOAD/1
blow
         3         1         0         0         0         0                   0                   4
/GRAV/1
weight
         1         Z         0         0         2                             0            -9.81E-3
/ADMAS/0/1
ballast
                1E-6         4
/RBODY/1
lid
        30         0         0         0                1E-6         3         0         0         0
                   0                   0                   0
                   0                   0                   0
/RWALL/PLANE/1
floor
         0         2         0         0
                0.75                 0.2                   0                   0         0
                   0                   0                -0.5
                   0                   0                   1
/INTER/TYPE3/1
block to block
         1         2                                                           0
                   0                 0.2                0.01                   0                   0
       000         0         0
                                                                               0
/INTER/TYPE5/2
cover to plate
         4         3                                                 0         0
                   0                 0.1                 0.1                   0                   0
       000                   0         0
         0         0                   0                   0                   0
/INTER/TYPE7/3
cover to block
         4         2         0         0         0                   0         0         0         0
                   0                   0                   0
                   0                   0                   0                   0         0         0
                   0                 0.1                 0.1                   0                   0
       000                             0                   0                   0                   0
         0         0                   0         0         0         0                   0         0
/TH/INTER/1
contact force
DEF
         1         2
/TH/PART/2
energies
DEF
         1         2         3         4
/TH/NODE/3
corner
DEF
        13         0corner
/END
)deck";

const char* const base_engine = R"deck(/RUN/base/1
0.05
/VERS/2022
/TFILE/4
0.0005
/PRINT/-100
/ANIM/DT
0. 0.005
/ANIM/VECT/VEL
/ANIM/ELEM/VONM
/DT
0.9 0.
/DT/BRICK/STOP
0.67 1e-7
/STOP
0.5 0 0 1 1
)deck";

std::string with_line(const std::string& deck, std::string_view keyword, int offset, std::string_view text) {
  const std::string wanted = "\n" + std::string(keyword) + "\n";
  const std::string padded = "\n" + deck;
  std::size_t begin = padded.find(wanted);
  if (begin == std::string::npos) throw std::logic_error("the deck has no line " + std::string(keyword));
  ++begin;
  for (int i = 0; i < offset; ++i) begin = padded.find('\n', begin) + 1;
  const std::size_t end = padded.find('\n', begin);
  return (padded.substr(0, begin) + std::string(text) + padded.substr(end)).substr(1);
}

std::vector<std::string> Built::messages() const {
  std::vector<std::string> all;
  for (const Diagnostic& d : diagnostics.all()) all.push_back(to_string(d));
  return all;
}

bool Built::has(std::string_view part) const {
  const std::vector<std::string> all = messages();
  return std::any_of(all.begin(), all.end(), [&](const std::string& s) { return s.find(part) != std::string::npos; });
}

Built build_text(const std::string& starter, const std::string& engine, const std::vector<std::string>& later) {
  Built b;
  deck::DeckPair pair;
  pair.starter = deck::read_starter_text(starter, "deck_0000.rad", b.diagnostics);
  if (!engine.empty()) {
    pair.engine = deck::read_engine_text(engine, "deck_0001.rad", b.diagnostics);
    pair.has_engine = true;
  }
  int run = 1;
  for (const std::string& text : later) {
    pair.restarts.push_back(deck::read_engine_text(text, fmt::format("deck_{:04}.rad", ++run), b.diagnostics));
  }
  b.model = build(pair, b.diagnostics, run);
  return b;
}

Built build_changed(std::string_view keyword, int offset, std::string_view text) {
  return build_text(with_line(base_starter, keyword, offset, text));
}

std::string integers(const std::vector<std::string>& fields) {
  std::string s;
  for (const std::string& f : fields) s += fmt::format("{:>10}", f);
  return s;
}

std::string reals(const std::vector<std::string>& fields) {
  std::string s;
  for (const std::string& f : fields) s += fmt::format("{:>20}", f);
  return s;
}

}  // namespace abut::model::base_deck
