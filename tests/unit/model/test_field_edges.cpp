// Numbers that go over the edge of their field: columns cut them in two, and both parts may be numbers (deck-format.md A.4).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/field_edges.hpp"
#include "unit/model/deck_text.hpp"
#include "unit/model/fixture.hpp"

namespace abut::model {
namespace {

using namespace base_deck;
using Messages = std::vector<std::string>;

std::string blanks(int n) { return std::string(static_cast<std::size_t>(n), ' '); }

const std::string node_16 = "        16                   0                   1";  // but for Z

TEST(FieldEdges, ANumberThatGoesOnBeyondTheLastFieldIsAnError) {
  EXPECT_EQ(
      build_changed("/NODE", 16, node_16 + blanks(17) + "2.15").messages(),
      (Messages{"deck_0000.rad:25: /NODE field 'Z' (columns 51-70): '2.15' goes on to column 71, beyond its field, where '2.1' would be "
                "read; end it in column 70"}));
  EXPECT_TRUE(build_changed("/MAT/ELAST/1", 3, blanks(17) + "210" + blanks(18) + ".33")
                  .has("/MAT/ELAST/1 field 'nu' (columns 21-40): '.33' goes on to column 41, beyond its field, where '.3' would be read"));
  const std::string load = integers({"1", "X", "1", "0", "5", ""}) + reals({"0"});
  EXPECT_TRUE(
      build_changed("/CLOAD/1", 2, load + blanks(14) + "1.25E10")
          .has("/CLOAD/1 field 'Fscale_y' (columns 81-100): '1.25E10' goes on to column 101, beyond its field, where '1.25E1' would"));
  EXPECT_TRUE(build_changed("/SHELL/3", 1, integers({"3", "21", "22", "23", "2"}) + "4")
                  .has("/SHELL/3 field 'n4' (columns 41-50): '24' goes on to column 51, beyond its field, where '2' would be read"));
  EXPECT_TRUE(build_changed("/GRNOD/NODE/3", 2, integers({"13", "14", "15", "16", "13", "14", "15", "16", "13", "1"}) + "4")
                  .has("/GRNOD/NODE/3 field 'node_ID' (columns 91-100): '14' goes on to column 101"));
  const Built full = build_changed("/NODE", 16, node_16 + "2.1000000000000000001E+1");  // fills its field, and its exponent is cut off
  EXPECT_TRUE(full.has("'2.1000000000000000001E+1' goes on to column 74"));
}

TEST(FieldEdges, ANumberThatBeginsLeftOfItsFieldIsAnError) {
  const Built b = build_changed("/RBODY/1", 4, blanks(60) + "\n" + blanks(19) + "10" + blanks(9) + "\n");
  EXPECT_TRUE(
      b.has("/RBODY/1 field 'Ifail' (columns 21-30): '10' begins in column 20, left of its field, where '0' would be read; begin it "
            "in column 21 or right of it"));
  EXPECT_EQ(b.diagnostics.error_count(), 1);
}

TEST(FieldEdges, ANumberOverTheBorderOfTwoFieldsIsAWarning) {
  EXPECT_EQ(
      build_changed("/INIVEL/TRA/1", 2, blanks(17) + "12.5" + blanks(39) + integers({"2", "0"})).messages(),
      (Messages{"deck_0000.rad:124: warning: /INIVEL/TRA/1 field 'Vx' (columns 1-20): '12.5' in columns 18 to 21 goes over the border to "
                "the next field and is read as '12.' and '5'; end a number in the last column of its field, and leave a blank "
                "between two"}));
  EXPECT_TRUE(build_changed("/GRNOD/NODE/3", 2, blanks(9) + "14")
                  .has("field 'node_ID' (columns 1-10): '14' in columns 10 to 11 goes over the border to the next field and is read as '1' "
                       "and '4'"));
}

TEST(FieldEdges, NumbersThatFillTheirFieldsMayTouch) {
  const auto no_message = [](const std::string& keyword, int line, const std::string& text) {
    EXPECT_EQ(build_changed(keyword, line, text).messages(), Messages{}) << text;
  };
  no_message("/NODE", 16, "        16-1.5258789062500E-055.00000000000000E-012.10000000000000E+00");
  no_message("/NODE", 13, "        13                 0.0-1.0000000000000E-01                 2.1");
  no_message("/NODE", 16, "16        0.00                1.00000000000000E+002.1                 ");
  no_message("/INIVEL/TRA/1", 2, "0         " + blanks(10) + "0         " + blanks(10) + "-10       " + blanks(10) + "2         0");
  no_message("/BCS/1", 2, "   111 1110         1         ");                                     // flags stand in fixed columns
  no_message("/TH/PART/2", 0, "/TH/NODE/9\nnames\nDX\n        16         02 left\n/TH/PART/2");  // a name may begin with digits
  no_message("/NODE", 16, node_16 + blanks(17) + "2.1#2.15");                                    // text, not a number
  no_message("/CLOAD/1", 2, integers({"1", "X", "1", "0", "5", ""}) + reals({"0", "3"}) + "end");
}

TEST(FieldEdges, AnUnreadFieldThatIsFullIsANeighbour) {
  FieldEdges edges;
  const std::string filled = "         71234567890";
  edges.take({1, 10});
  edges.take_number(filled, {1, 10}, "id");
  EXPECT_TRUE(edges.findings(filled).empty());
  const std::string cut = "         71234";
  EXPECT_EQ(edges.findings(cut).size(), 1U);
  edges.clear();
  EXPECT_TRUE(edges.findings(cut).empty());
}

TEST(FieldEdges, TheOldLayoutHasItsOwnColumns) {
  const auto node = [](const std::string& z) {
    return build_text("/BEGIN\nold\n        44\n/NODE\n       1               0               0" + z + "\n/ADMAS/5/1/ball\n" +
                      testing::field("1", 16) + testing::field("1", 8) + "\n/END\n");
  };
  EXPECT_EQ(node(testing::field("2.15", 16)).messages(), Messages{});
  EXPECT_TRUE(node(testing::field("2.15", 17)).has("/NODE field 'Z' (columns 41-56): '2.15' goes on to column 57"));
  EXPECT_TRUE(node(testing::field("2.15", 20))
                  .has("warning: /NODE (columns 57-60): '2.15' stands right of the last field, which ends in "
                       "column 56, and is not read"));
}

TEST(FieldEdges, ANumberRightOfAllFieldsIsAWarning) {
  EXPECT_EQ(build_changed("/NODE", 15, "        15                   1                   1" + blanks(20) + "2.1").messages().front(),
            "deck_0000.rad:24: warning: /NODE (columns 71-73): '2.1' stands right of the last field, which ends in column 70, and is not "
            "read");
  EXPECT_TRUE(build_changed("/CLOAD/1", 2, integers({"1", "X", "1", "0", "5", ""}) + reals({"0", "3"}) + "   4")
                  .has("(columns 104-104): '4' stands right of the last field, which ends in column 100, and is not read"));
  EXPECT_TRUE(build_changed("/IMPVEL/1", 3, reals({"1", "-2", "0", "0", "0.5"})).has("/IMPVEL/1 (columns 98-100): '0.5' stands right of"));
  EXPECT_TRUE(build_changed("/INIVEL/TRA/1", 2, reals({"0", "0", "-10"}) + integers({"2", "0", "1"})).has("/INIVEL/TRA/1 (columns 90-90)"));
  EXPECT_TRUE(build_changed("/SKEW/FIX/1", 3, reals({"0", "1", "0", "1"})).has("/SKEW/FIX/1 (columns 80-80): '1' stands right of"));
  EXPECT_TRUE(build_changed("/RWALL/PLANE/1", 5, reals({"0", "0", "1", "1"})).has("/RWALL/PLANE/1 (columns 80-80): '1' stands right of"));
  EXPECT_EQ(build_changed("/FUNCT/1", 3, reals({"1", "1", "2"})).messages(), Messages{});  // real decks have a third column
  EXPECT_TRUE(build_changed("/MAT/ELAST/1", 3, reals({"210", "0", "0.3"})).has("/MAT/ELAST/1 (columns 58-60): '0.3' stands right of the"));
  EXPECT_EQ(build_changed("/PART/3", 2, integers({"2", "2", "0"}) + reals({"0"}) + "         0  # plate 1").messages(), Messages{});
  EXPECT_EQ(build_changed("/NODE", 16, node_16 + reals({"2.1"}) + " corner 4").messages(), Messages{});
}

}  // namespace
}  // namespace abut::model
