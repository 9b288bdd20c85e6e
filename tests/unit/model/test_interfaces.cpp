// Interfaces of a deck: defaults, options, orientation of segments (deck-format.md E.1 to E.3; type3.md T3, T5, T14, T18, T19, T27, T28).
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "model/measure.hpp"
#include "unit/model/deck_text.hpp"

namespace abut::model {
namespace {

using namespace base_deck;

const InterfaceType3& type3(const Model& m) { return std::get<InterfaceType3>(m.interfaces.at(0).type); }

Vec3 centre(const Model& m, const Segment& s) {
  Vec3 sum;
  for (const Index n : s.nodes) sum += m.node_x[static_cast<std::size_t>(n)];
  return sum / 4.0;
}

std::array<Id, 4> ids(const Model& m, const Segment& s) {
  std::array<Id, 4> result{};
  for (std::size_t i = 0; i < 4; ++i) result[i] = m.node_id[static_cast<std::size_t>(s.nodes[i])];
  return result;
}

/// The base deck whose surface 2 is typed segment by segment.
std::string with_segments(const std::string& segments) {
  std::string deck = with_line(base_starter, "/SURF/PART/EXT/2", 2, segments);
  return with_line(deck, "/SURF/PART/EXT/2", 0, "/SURF/SEG/2");
}

TEST(Interfaces, Type3DefaultsAreExplicit) {  // T14, T19, T28
  const Built b = build_changed("/INTER/TYPE3/1", 3, reals({"0", "0", "0", "0", "0"}));
  const Interface& i = b.model.interfaces.at(0);
  EXPECT_EQ(i.stfac, 0.2);
  EXPECT_EQ(i.friction, 0.0);
  EXPECT_EQ(i.gap, 0.0);
  EXPECT_EQ(i.t_start, 0.0);
  EXPECT_EQ(i.t_stop, infinity);
  EXPECT_EQ(i.ptlim, infinity);
  EXPECT_EQ(i.title, "block to block");
  EXPECT_EQ(i.place.keyword, "/INTER/TYPE3/1");
  EXPECT_EQ(b.model.surfaces.at(static_cast<std::size_t>(type3(b.model).surface_1)).id, 1);
  EXPECT_EQ(b.model.surfaces.at(static_cast<std::size_t>(type3(b.model).surface_2)).id, 2);
}

TEST(Interfaces, Type3TakesAllFieldsAndConvertsThem) {
  std::string deck = with_line(base_starter, "/BEGIN", 4, reals({"kg", "m", "s"}));
  deck = with_line(deck, "/INTER/TYPE3/1", 2, integers({"1", "2"}) + std::string(50, ' ') + integers({"-2"}));
  deck = with_line(deck, "/INTER/TYPE3/1", 3, reals({".5", ".3", ".02", "1", "2"}));
  deck = with_line(deck, "/INTER/TYPE3/1", 4, "       101" + integers({"2", "2"}));
  deck = with_line(deck, "/INTER/TYPE3/1", 5, std::string(60, ' ') + reals({".25"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  const Interface& i = b.model.interfaces.at(0);
  EXPECT_EQ(i.idel, -2);
  EXPECT_EQ(i.stfac, .5);
  EXPECT_EQ(i.friction, .3);
  EXPECT_DOUBLE_EQ(i.gap, 2e-5);
  EXPECT_DOUBLE_EQ(i.t_start, 1e-3);
  EXPECT_DOUBLE_EQ(i.t_stop, 2e-3);
  EXPECT_EQ(i.ibc, (std::array{true, false, true}));
  EXPECT_DOUBLE_EQ(i.ptlim, .25e9);
}

TEST(Interfaces, MissingPtlimCardIsBlank) {  // all real TYPE3 blocks lack it (A.5)
  const Built b = build_changed("/INTER/TYPE3/1", 5, "#");
  EXPECT_EQ(b.messages(), std::vector<std::string>{});
  EXPECT_EQ(b.model.interfaces.at(0).ptlim, infinity);
}

TEST(Interfaces, SegmentsOnSolidsLookOutward) {  // Irs = 0
  // The lower face of the upper block typed inside out (towards +z, into the block), its top face outward.
  const Built b = build_text(with_segments(integers({"1", "9", "10", "11", "12"}) + "\n" + integers({"2", "13", "14", "15", "16"})));
  ASSERT_FALSE(b.diagnostics.has_errors());
  const Model& m = b.model;
  const Surface& used = m.surfaces.at(static_cast<std::size_t>(type3(m).surface_2));
  EXPECT_EQ(ids(m, used.segments.at(0)), (std::array<Id, 4>{12, 11, 10, 9}));
  EXPECT_EQ(ids(m, used.segments.at(1)), (std::array<Id, 4>{13, 14, 15, 16}));
  EXPECT_TRUE(b.has("1 of 2 segments of surface 2 looked into their solid and were turned"));
  const Vec3 inside{.5, .5, 1.6};
  for (const Segment& s : used.segments) EXPECT_GT(dot(face_area(m, s.nodes), centre(m, s) - inside), 0.0);
}

TEST(Interfaces, OriginalSurfaceStaysForOtherUsers) {
  std::string deck = with_segments(integers({"1", "9", "10", "11", "12"}));
  deck = with_line(deck, "/PLOAD/1", 2, integers({"2", "1", "0", "0", "0", "0"}) + reals({"0", "4"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  const auto& loaded = b.model.pressure_loads.at(0).segments.at(0);
  EXPECT_EQ(b.model.node_id[static_cast<std::size_t>(loaded[0])], 9);
  const Index used = type3(b.model).surface_2;
  EXPECT_EQ(b.model.surfaces.at(static_cast<std::size_t>(used)).id, 2);
  EXPECT_EQ(ids(b.model, b.model.surfaces[static_cast<std::size_t>(used)].segments[0])[0], 12);
}

TEST(Interfaces, FlagOneReversesAndFlagTwoLeaves) {
  const std::string segments = with_segments(integers({"1", "9", "10", "11", "12"}) + "\n" + integers({"2", "13", "14", "15"}));
  const Built reversed = build_text(with_line(segments, "/INTER/TYPE3/1", 4, "       000" + integers({"0", "1"})));
  const Surface& r = reversed.model.surfaces.at(static_cast<std::size_t>(type3(reversed.model).surface_2));
  EXPECT_EQ(ids(reversed.model, r.segments.at(0)), (std::array<Id, 4>{10, 9, 12, 11}));
  EXPECT_EQ(ids(reversed.model, r.segments.at(1)), (std::array<Id, 4>{14, 13, 15, 15}));
  const Built left = build_text(with_line(segments, "/INTER/TYPE3/1", 4, "       000" + integers({"0", "2"})));
  const Surface& l = left.model.surfaces.at(static_cast<std::size_t>(type3(left.model).surface_2));
  EXPECT_EQ(ids(left.model, l.segments.at(0)), (std::array<Id, 4>{9, 10, 11, 12}));
}

TEST(Interfaces, ShellSegmentsKeepTheirSide) {  // T5: the user's responsibility
  const Built b = build_text(base_starter);
  const auto& t5 = std::get<InterfaceType5>(b.model.interfaces.at(1).type);
  const Segment& s = b.model.surfaces.at(static_cast<std::size_t>(t5.surface)).segments.at(0);
  EXPECT_EQ(ids(b.model, s), (std::array<Id, 4>{21, 22, 23, 24}));
  EXPECT_EQ(s.element.kind, ElementKind::shell4);
}

TEST(Interfaces, FaceBetweenTwoSolidsIsNotTurned) {
  // A third brick below the upper block shares its lower face: no outside, so the segment stays as typed.
  std::string deck = with_segments(integers({"1", "9", "10", "11", "12"}));
  deck = with_line(deck, "/BRICK/2", 1,
                   integers({"2", "9", "10", "11", "12", "13", "14", "15", "16"}) + "\n/NODE\n" + integers({"41"}) +
                       reals({"0", "0", "1.05"}) + "\n" + integers({"42"}) + reals({"1", "0", "1.05"}) + "\n" + integers({"43"}) +
                       reals({"1", "1", "1.05"}) + "\n" + integers({"44"}) + reals({"0", "1", "1.05"}) + "\n/BRICK/2\n" +
                       integers({"3", "41", "42", "43", "44", "9", "10", "11", "12"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  const Surface& used = b.model.surfaces.at(static_cast<std::size_t>(type3(b.model).surface_2));
  EXPECT_EQ(ids(b.model, used.segments.at(0)), (std::array<Id, 4>{9, 10, 11, 12}));
}

TEST(Interfaces, TrianglesOnSolidsAreTurnedBySwappingTheirFirstNodes) {
  // A degenerate brick (wedge) whose triangular end is typed inwards.
  std::string deck = with_segments(integers({"1", "9", "10", "11"}));
  deck = with_line(deck, "/BRICK/2", 1, integers({"2", "9", "10", "11", "9", "13", "14", "15", "13"}));
  deck = with_line(deck, "/GRNOD/NODE/3", 2, integers({"13", "14", "15"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  const Surface& used = b.model.surfaces.at(static_cast<std::size_t>(type3(b.model).surface_2));
  EXPECT_EQ(ids(b.model, used.segments.at(0)), (std::array<Id, 4>{10, 9, 11, 11}));
}

TEST(Interfaces, RepeatedCornersBecomeTriangles) {
  const std::string flags = "       000" + integers({"0", "2"});
  const Built b =
      build_text(with_line(with_segments(integers({"1", "9", "9", "10", "11"}) + "\n" + integers({"2", "13", "14", "14", "15"}) + "\n" +
                                         integers({"3", "13", "14", "15", "13"})),
                           "/INTER/TYPE3/1", 4, flags));
  const Surface& used = b.model.surfaces.at(static_cast<std::size_t>(type3(b.model).surface_2));
  EXPECT_EQ(ids(b.model, used.segments.at(0)), (std::array<Id, 4>{9, 10, 11, 11}));
  EXPECT_EQ(ids(b.model, used.segments.at(1)), (std::array<Id, 4>{13, 14, 15, 15}));
  EXPECT_EQ(ids(b.model, used.segments.at(2)), (std::array<Id, 4>{13, 14, 15, 15}));
  EXPECT_TRUE(b.has("warning: /INTER/TYPE3/1: 3 segments of surface 2 name a corner twice"));
}

TEST(Interfaces, Type5ReadsFrictionLawsWithTheirDimensions) {
  std::string deck = with_line(base_starter, "/BEGIN", 4, reals({"kg", "m", "s"}));
  deck = with_line(deck, "/INTER/TYPE5/2", 4, "       000" + integers({"", "1", "3"}));
  deck = with_line(deck, "/INTER/TYPE5/2", 5,
                   integers({"2", "3"}) + reals({"7"}) + std::string(10, ' ') + integers({"1"}) + reals({".5"}) + "\n" +
                       reals({"1", "2", "3", "4", "5"}) + "\n" + reals({"6"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  const Interface& i = b.model.interfaces.at(1);
  const auto& t5 = std::get<InterfaceType5>(i.type);
  EXPECT_EQ(t5.irm, 1);
  EXPECT_EQ(t5.inacti, 3);
  EXPECT_EQ(t5.nodes.size(), 4u);
  EXPECT_EQ(i.ifric, 2);
  EXPECT_EQ(i.ifiltr, 3);
  EXPECT_DOUBLE_EQ(i.xfreq, 7e3);   // 1/ms
  EXPECT_DOUBLE_EQ(i.c[0], 1e-18);  // 1/GPa^2
  EXPECT_DOUBLE_EQ(i.c[1], 2.0);    // ms/mm = s/m
  EXPECT_DOUBLE_EQ(i.c[2], 3e-9);   // 1/GPa
  EXPECT_DOUBLE_EQ(i.c[4], 5.0);
  EXPECT_DOUBLE_EQ(i.c[5], 6.0);
  EXPECT_EQ(i.sensor, 0);
  EXPECT_DOUBLE_EQ(i.ptlim, .5e9);
}

TEST(Interfaces, Type7DefaultsAreExplicit) {
  const Built b = build_text(base_starter);
  const Interface& i = b.model.interfaces.at(2);
  const auto& t7 = std::get<InterfaceType7>(i.type);
  EXPECT_EQ(i.stfac, 1.0);
  EXPECT_EQ(i.gap, .1);
  EXPECT_TRUE(t7.gap_given);
  EXPECT_EQ(t7.istf, 0);
  EXPECT_EQ(t7.igap, 0);
  EXPECT_EQ(t7.iform, 1);
  EXPECT_EQ(t7.vis_s, .05);
  EXPECT_EQ(t7.vis_f, 1.0);  // there is friction
  EXPECT_EQ(t7.st_max, infinity);
}

TEST(Interfaces, Type7StiffnessIsAStiffnessWithFlagOneOrANegativeSign) {
  std::string deck = with_line(base_starter, "/BEGIN", 4, reals({"kg", "m", "s"}));
  const std::string negative = with_line(deck, "/INTER/TYPE7/3", 5, reals({"-3", ".1", ".1", "0", "0"}));
  const std::string flag = with_line(with_line(deck, "/INTER/TYPE7/3", 5, reals({"3", ".1", ".1", "0", "0"})), "/INTER/TYPE7/3", 2,
                                     integers({"4", "2", "1", "0", "1000", "", "0", "1000", "0", "0"}));
  for (const std::string& text : {negative, flag}) {
    const Built b = build_text(text);
    ASSERT_FALSE(b.diagnostics.has_errors());
    EXPECT_EQ(std::get<InterfaceType7>(b.model.interfaces.at(2).type).istf, 1);
    EXPECT_DOUBLE_EQ(b.model.interfaces.at(2).stfac, 3e6);  // kg/ms2
  }
}

TEST(Interfaces, Type7WithoutGroupIsSelfContact) {
  const Built b = build_changed("/INTER/TYPE7/3", 2, integers({"0", "2", "0", "0", "0", "", "0", "0", "0", "0"}));
  ASSERT_FALSE(b.diagnostics.has_errors());
  EXPECT_EQ(std::get<InterfaceType7>(b.model.interfaces.at(2).type).nodes.size(), 8u);
}

// Nodes closer than the gap on their own surface: not left out, and Irem_gap 2 asks for it. A group of the surface's own nodes is self
// contact as much as none.
TEST(Interfaces, Type7LeavesNoNodesOutInSelfContact) {
  const std::string wanted =
      with_line(base_starter, "/INTER/TYPE7/3", 4,
                "                   0                   0                   0                   0         2         0");
  const auto with_group = [&wanted](const char* group) {
    return build_text(with_line(wanted, "/INTER/TYPE7/3", 2, integers({group, "2", "0", "0", "0", "", "0", "0", "0", "0"})));
  };
  EXPECT_FALSE(with_group("4").diagnostics.has_errors()) << "no node of the surface: nothing to leave out";
  for (const char* group : {"0", "3"}) {
    const Built b = with_group(group);
    ASSERT_EQ(b.diagnostics.error_count(), 1) << group;
    EXPECT_EQ(
        to_string(b.diagnostics.all().front()),
        "deck_0000.rad:168: /INTER/TYPE7/3 field 'Irem_gap' (columns 81-90): leaving out nodes closer than the gap in self contact (2) "
        "is not supported; write 1");
  }
}

TEST(Interfaces, OldLayoutOfTheThreeTypes) {
  const auto narrow = [](const std::vector<std::string>& fields, std::size_t width) {
    std::string s;
    for (const std::string& f : fields) s += std::string(width - f.size(), ' ') + f;
    return s;
  };
  const auto node = [&](int id, const char* x, const char* y, const char* z) {
    return narrow({std::to_string(id)}, 8) + narrow({x, y, z}, 16) + "\n";
  };
  std::string deck = "#RADIOSS STARTER      44old                    0\n/NODE\n";
  deck += node(1, "0.", "0.", "0.") + node(2, "1.", "0.", "0.") + node(3, "1.", "1.", "0.") + node(4, "0.", "1.", "0.");
  deck += node(5, "0.", "0.", "1.") + node(6, "1.", "0.", "1.") + node(7, "1.", "1.", "1.") + node(8, "0.", "1.", "1.");
  deck += "/MAT/ELAST/1/steel\n" + narrow({"7.8e-6", "0."}, 16) + "\n" + narrow({"210.", "0.3"}, 16) + "\n";
  deck += "/PROP/SHELL/1/plate\n" + narrow({"1", "2"}, 8) + "\n\n" + narrow({"0", "0"}, 8) + narrow({".1", "0."}, 16) + "\n";
  deck += "/PART/1/a\n" + narrow({"1", "1", "0"}, 8) + "\n/PART/2/b\n" + narrow({"1", "1", "0"}, 8) + "\n";
  deck += "/SHELL/1\n" + narrow({"1", "1", "2", "3", "4"}, 8) + "\n/SHELL/2\n" + narrow({"2", "5", "8", "7", "6"}, 8) + "\n";
  deck += "/SURF/PART/1/a\n" + narrow({"1"}, 8) + "\n/SURF/PART/2/b\n" + narrow({"2"}, 8) + "\n/GRNOD/PART/1/b\n" + narrow({"2"}, 8) + "\n";
  deck += "/INTER/TYPE3/1\nfirst title\n" + narrow({"1", "2"}, 8) + "\n" + narrow({".3", ".1", ".05", "0.", "2."}, 16) + "\n     010" +
          narrow({"1", "2"}, 8) + "\n";
  deck += "/INTER/TYPE5/2\nsecond title\n" + narrow({"1", "1", "", "", "", "", "2"}, 8) + "\n" +
          narrow({".4", ".2", ".06", "0.", "0."}, 16) + "\n     001" + narrow({"", "1"}, 8) + "\n" + narrow({"1", "1"}, 8) +
          narrow({".5"}, 16) + "\n" + narrow({"1.", "2.", "3.", "4.", "5."}, 16) + "\n";
  deck += "/INTER/TYPE7/3/third title\n" + narrow({"1", "1", "0", "", "0", "0", "0", "1"}, 8) + "\n" +
          narrow({".5", ".3", ".07", "0.", "0."}, 16) + "\n     100" + narrow({"", "", "5"}, 8) + narrow({".06", "0.9"}, 16) + "\n" +
          narrow({"0", "0"}, 8) + narrow({"0."}, 16) + narrow({"2"}, 8) + "\n/END\n";
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors()) << b.diagnostics.all().front().message;
  ASSERT_EQ(b.model.interfaces.size(), 3u);
  const Interface& i3 = b.model.interfaces[0];
  EXPECT_EQ(i3.title, "first title");
  EXPECT_EQ(i3.stfac, .3);
  EXPECT_EQ(i3.gap, .05);
  EXPECT_EQ(i3.t_stop, 2.);
  EXPECT_EQ(i3.ibc, (std::array{false, true, false}));
  EXPECT_EQ(type3(b.model).irs, 1);
  EXPECT_EQ(type3(b.model).irm, 2);
  const Interface& i5 = b.model.interfaces[1];
  EXPECT_EQ(i5.title, "second title");
  EXPECT_EQ(i5.idel, 2);
  EXPECT_EQ(i5.ifric, 1);
  EXPECT_EQ(i5.ifiltr, 1);
  EXPECT_EQ(i5.xfreq, .5);
  EXPECT_EQ(i5.c[4], 5.);
  const Interface& i7 = b.model.interfaces[2];
  EXPECT_EQ(i7.title, "third title");
  EXPECT_EQ(i7.idel, 1);
  EXPECT_EQ(i7.gap, .07);
  EXPECT_EQ(std::get<InterfaceType7>(i7.type).inacti, 5);
  EXPECT_EQ(std::get<InterfaceType7>(i7.type).vis_s, .06);
  EXPECT_EQ(std::get<InterfaceType7>(i7.type).iform, 2);
}

}  // namespace
}  // namespace abut::model
