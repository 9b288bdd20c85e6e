// Keywords of deck-format.md H.1 ("must") that no deck of the repository uses: each does in a run what it says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

// /IMPDISP, /TETRA4, /TH/BRIC, /TH/SHEL, /TH/SH3N: every node's displacement is 1e-4 x along x. Solids: sigma = (lambda + 2 mu, lambda,
// lambda) e; shells: E/(1 - nu^2) (1, nu) e. Energy half of sigma e V.
TEST(Keywords, ImposedDisplacementsStrainEveryElementAsTheyMust) {
  const double strain = 1e-4;
  const std::string deck =
      materials + nodes(1, cube) + nodes(11, square) + nodes(21, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) +
      nodes(31, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) + part(1, 1, 1) + part(2, 2, 1) + part(3, 2, 1) + part(4, 1, 1) +
      element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}) + element("SHELL", 2, 2, {11, 12, 13, 14}) + element("SH3N", 3, 3, {21, 22, 23}) +
      element("TETRA4", 4, 4, {31, 32, 33, 34}) + group("GRNOD/NODE", 1, {1, 4, 5, 8, 11, 14, 21, 23, 31, 33}) + ints({34}) +
      group("GRNOD/NODE", 2, {2, 3, 6, 7, 12, 13, 22, 32}) + bcs("111 111", 1) + bcs("011 111", 2) + "/FUNCT/1\nramp and rest\n" +
      reals({0, 0}) + reals({1, 1}) + reals({2, 1}) + "/IMPDISP/1\nstretch\n         1         X         0         0         2\n" +
      reals({1, strain, 0, 1e30}) + "/TH/BRIC/1\nbrick\nDEF\n" + ints({1}) + "/TH/SHEL/2\nshell\nDEF\n" + ints({2}) +
      "/TH/SH3N/3\ntriangle\nDEF\n" + ints({3}) + "/TH/PART/4\nparts\nDEF\n" + ints({1, 2, 3, 4});
  const abut::Run run = run_of(deck, engine(1.1));
  const double lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), two_mu = young / (1.0 + poisson);
  const double along = (lambda + two_mu) * strain, plane = young / (1.0 - poisson * poisson) * strain;
  EXPECT_NEAR(last(run, "BRIC/1/SX"), along, 1e-9 * along);
  EXPECT_NEAR(last(run, "BRIC/1/SY"), lambda * strain, 1e-9 * along);
  EXPECT_NEAR(last(run, "SHEL/2/F1"), plane, 1e-9 * plane);
  EXPECT_NEAR(last(run, "SHEL/2/F2"), poisson * plane, 1e-9 * plane);
  EXPECT_NEAR(last(run, "SH3N/3/F1"), plane, strain * plane);  // Ish3n 2 strains with its geometry
  const std::vector<double> stress = run.element_field(ElementKind::tetra, "stress");
  ASSERT_EQ(stress.size(), 6U);
  EXPECT_NEAR(stress[0], along, 1e-9 * along);
  EXPECT_NEAR(stress[1], lambda * strain, 1e-9 * along);
  EXPECT_NEAR(last(run, "PART/4/IE"), 0.5 * along * strain / 6.0, 1e-6 * along * strain);
  EXPECT_NEAR(last(run, "PART/2/IE"), 0.5 * plane * strain * 0.1, 1e-6 * plane * strain);
  EXPECT_NEAR(run.displacements()[1].x, strain, 1e-15);
}

// Every way to name the nodes of one plate: they fly, those of the other one stay.
TEST(Keywords, GroupsOfNodesNameTheSameNodes) {
  const std::vector<std::string> ways{
      group("GRNOD/NODE", 1, {1, 2, 3, 4}),
      group("GRNOD/PART", 1, {1}),
      group("GRNOD/NODE", 2, {1, 2}) + group("GRNOD/NODE", 3, {3, 4}) + group("GRNOD/GRNOD", 1, {2, 3}),
      group("SURF/PART", 1, {1}) + group("GRNOD/SURF", 1, {1}),
      group("GRNOD/GENE", 1, {1, 4}),
      "/SUBSET/1\nflies\n" + ints({}) + group("GRNOD/SUBSET", 1, {1}),
      group("GRSHEL/SHEL", 1, {1}) + group("GRNOD/GRSHEL", 1, {1}),
  };
  const Vec3 speed{1.0, -2.0, 0.5};
  for (const std::string& way : ways) {
    const std::string deck = materials + nodes(1, square) + nodes(11, square) + part(1, 2, 1, 1) + part(2, 2, 1) +
                             element("SHELL", 1, 1, {1, 2, 3, 4}) + element("SHELL", 2, 2, {11, 12, 13, 14}) + way +
                             "/INIVEL/TRA/1\nfly\n" + fmt::format("{:>20g}{:>20g}{:>20g}", speed.x, speed.y, speed.z) + ints({1, 0});
    const abut::Run run = run_of(deck, engine(0.01));
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 expected = i < 4 ? run.time() * speed : Vec3{};
      EXPECT_LT(norm(run.displacements()[i] - expected), 1e-14) << way << i;
    }
    EXPECT_NEAR(run.balance().ke, 0.5 * density * 0.1 * squared_norm(speed), 1e-18) << way;
  }
}

// Nodes of TYPE5 that are on no shell and no free face of a solid (a point mass) are held with half of the surface's stiffness: on a spring
// of s K1/2, K1 = E t, a mass m that comes with v is turned round in half a period, and leaves with v.
TEST(Keywords, PointMassesBounceInType5) {
  const double mass = 1e-3, speed = 0.1, gap = 0.1, start = 0.11;
  const std::string deck = materials + nodes(1, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}) + nodes(11, {{0.3, 0.2, start}}) +
                           part(1, 2, 1) + element("SHELL", 1, 1, {1, 2, 3, 4}) + group("GRNOD/NODE", 1, {1, 2, 3, 4}) + bcs("111 111", 1) +
                           group("GRNOD/NODE", 2, {11}) + group("SURF/PART", 1, {1}) + "/ADMAS/0/1\nmass\n" + fmt::format("{:>20g}", mass) +
                           ints({2}) + "/INIVEL/TRA/1\nfall\n" + reals({0, 0, -speed}).substr(0, 60) + ints({2, 0}) +
                           "/INTER/TYPE5/1\nfive\n" + ints({2, 1}) + reals({0.2, 0, gap, 0, 0}) +
                           "       000         0         0         0\n         0         0\n";
  const double k = 0.5 * 0.2 * young * 0.1;
  const double half_period = std::numbers::pi * std::sqrt(mass / k);
  const abut::Run run = run_of(deck, engine(0.1 + half_period + 0.2));
  const double z = run.displacements()[4].z + start;
  EXPECT_NEAR(run.velocities()[4].z, speed, 1e-3 * speed);
  // The law stiffens: by P/gap some 2 % sooner.
  EXPECT_NEAR(z, gap + speed * (run.time() - 0.1 - half_period), 0.05 * speed * half_period);
}

// Every way to name the skin of a brick and a plate of a quadrilateral and two triangles above it: the same contact, impulse twice the
// momentum for a plate as light as this one would bounce back with.
TEST(Keywords, SurfacesNameTheSameSegments) {
  const std::string surface_1 = group("SURF/PART/EXT", 1, {1}), surface_2 = group("SURF/PART", 2, {2, 3});
  const std::vector<std::string> ways{
      surface_1 + surface_2,
      group("SURF/PART/ALL", 1, {1}) + surface_2,
      group("GRBRIC/BRIC", 1, {1}) + group("SURF/GRBRIC/EXT", 1, {1}) + surface_2,
      group("SURF/PART/EXT", 3, {1}) + group("SURF/SURF", 1, {3}) + surface_2,
      surface_1 + group("GRSHEL/SHEL", 1, {2}) + group("GRSH3N/SH3N", 1, {3, 4}) + group("SURF/GRSHEL", 3, {1}) +
          group("SURF/GRSH3N", 4, {1}) + group("SURF/SURF", 2, {3, 4}),
      surface_1 + "/SURF/SEG/2\nsegments\n" + ints({1, 11, 12, 13, 14}) + ints({2, 14, 13, 15, 15}) + ints({3, 14, 15, 16, 16}),
  };
  double impulse = 0.0;
  for (const std::string& way : ways) {
    // The plate's normals point down, to the brick; its nodes are above the inside of the brick's face.
    const std::string deck =
        materials + nodes(1, {{-1, -1, -1}, {2, -1, -1}, {2, 2, -1}, {-1, 2, -1}, {-1, -1, 0}, {2, -1, 0}, {2, 2, 0}, {-1, 2, 0}}) +
        nodes(11, {{0, 0.2, 0.02}, {0, 1.1, 0.02}, {0.5, 1.1, 0.02}, {0.5, 0.2, 0.02}, {1, 1.1, 0.02}, {1, 0.2, 0.02}}) + part(1, 1, 1) +
        part(2, 2, 1) + part(3, 2, 1) + element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}) + element("SHELL", 2, 2, {11, 12, 13, 14}) +
        "/SH3N/3\n" + ints({3, 14, 13, 15}) + ints({4, 14, 15, 16}) + group("GRNOD/PART", 1, {1}) + group("GRNOD/PART", 2, {2, 3}) + way +
        bcs("111 000", 1) + bcs("110 111", 2) + "/INIVEL/TRA/1\nfall\n" + fmt::format("{:>20g}{:>20g}{:>20g}", 0.0, 0.0, -2.0) +
        ints({2, 0}) + "/INTER/TYPE3/1\ncontact\n" + ints({1, 2, 0, 0, 0, 0, 0, 0}) + reals({0.2, 0, 0.01, 0, 0}) +
        "       000         0         0\n" + reals({0});
    const abut::Run run = run_of(deck, engine(0.02));
    const double found = run.interfaces()[0].normal_impulse.z;
    const double momentum = density * 0.1 * 0.9 * 2.0;
    EXPECT_NEAR(std::fabs(found), 2.0 * momentum, 0.05 * momentum) << way;
    if (impulse == 0.0) impulse = found;
    EXPECT_NEAR(found, impulse, 1e-10 * std::fabs(impulse)) << way;
  }
}

// A void shell has mass and no stiffness: its nodes keep the velocities they have, whatever that does to it.
TEST(Keywords, VoidHasMassAndNothingElse) {
  const std::string deck = materials + nodes(1, square) + part(1, 3, 2) + element("SHELL", 1, 1, {1, 2, 3, 4}) +
                           group("GRNOD/NODE", 1, {3}) + "/INIVEL/TRA/1\nfly\n" + fmt::format("{:>20g}{:>20g}{:>20g}", 2.0, 1.0, 3.0) +
                           ints({1, 0}) + "/TH/PART/1\np\nDEF\n" + ints({1});
  const abut::Run run = run_of(deck, engine(0.1, "/DT\n0.9 0.\n/DTIX\n0.001 0.001\n"));
  for (const double m : run.masses()) EXPECT_NEAR(m, 0.25 * density * 0.1, 1e-20);
  EXPECT_LT(norm(run.displacements()[2] - run.time() * Vec3{2, 1, 3}), 1e-13);
  EXPECT_EQ(norm(run.displacements()[0]), 0.0);
  EXPECT_EQ(run.balance().ie, 0.0);
}

// /DT/NODA scales the step of the nodes; /DT/NODA/CST adds the mass that the step asks for, K h^2/(2 s^2). K does not depend on the step
// without viscosity.
TEST(Keywords, StepsOfNodesFollowTheirCards) {
  const std::string deck = materials + nodes(1, cube) + part(1, 4, 1) + element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  const double half = run_of(deck, engine(0.01, "/DT/NODA\n0.5 0.\n")).step();
  EXPECT_NEAR(run_of(deck, engine(0.01, "/DT/NODA\n0.25 0.\n")).step(), 0.5 * half, 1e-9 * half);
  const double wanted = 1.5 * half;
  const abut::Run scaled = run_of(deck, engine(0.01, fmt::format("/DT/NODA/CST\n0.5 {:.17g}\n", wanted)));
  EXPECT_NEAR(scaled.step(), wanted, 1e-4 * wanted);
  EXPECT_NEAR(scaled.balance().mass, 2.25 * density, 1e-4 * density);
  EXPECT_NEAR(scaled.balance().mass - scaled.balance().added_mass, density, 1e-12 * density);
}

}  // namespace
}  // namespace abut::small_decks
