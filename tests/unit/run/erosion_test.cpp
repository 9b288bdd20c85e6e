// What deleted elements leave behind.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

const std::string flying_plates = materials + nodes(1, square) + nodes(11, {{3, 0, 0}, {3.1, 0, 0}, {3.1, 0.1, 0}, {3, 0.1, 0}}) +
                                  part(1, 2, 1) + part(2, 2, 1) + element("SHELL", 1, 1, {1, 2, 3, 4}) +
                                  element("SHELL", 2, 2, {11, 12, 13, 14});
/// Deletes the small plate in the first cycle.
const std::string deleting = engine(0.02, "/DT/SHELL/DEL\n0.9 5e-5\n/DTIX\n0.0001 0.0001\n");

// p A t on the plate that is left; the other one has felt the pressure of its only cycle.
TEST(Erosion, TakesThePressureOff) {
  const double p = 1e-6;
  const std::string deck = flying_plates + group("SURF/PART", 1, {1, 2}) + "/PLOAD/1\npressure\n" + ints({1, 0, 0, 0, 0, 0}).substr(0, 60) +
                           fmt::format("{:>20g}{:>20g}\n", 1.0, p);
  const abut::Run run = run_of(deck, deleting);
  const double faster = p / (density * 0.1);  // per time
  EXPECT_NEAR(run.velocities()[0].z, faster * run.time(), 0.01 * faster * run.time());
  EXPECT_LT(run.velocities()[4].z, 2.0 * faster * 1e-4);
}

// Nodes that no element holds apart may meet: a deleted plate without area has no result to be looked at.
TEST(Erosion, LetsADeletedElementCollapse) {
  RunSettings settings;
  settings.threads = 1;
  settings.allow_findings = true;
  abut::Run run(Model::from_text({.starter = flying_plates + "/END\n", .engines = {deleting}, .name = "keywords"}), settings);
  run.advance();
  const std::vector<Vec3> x(run.positions().begin() + 4, run.positions().begin() + 8);
  for (std::size_t k = 0; k < 4; ++k) run.edit_velocities()[4 + k] = (1.0 / run.step()) * (x[0] - x[k]);
  run.advance();
  for (std::size_t k = 0; k < 4; ++k) run.edit_velocities()[4 + k] = Vec3{};
  run.advance_to_end();
  EXPECT_EQ(run.outcome().kind, Outcome::Kind::finished) << run.outcome().message;
  EXPECT_LT(norm(run.positions()[6] - x[0]), 1e-12);
}

// A plate that is pulled until it fails: its energy goes from IE to XE, and the run says what went and when.
TEST(Erosion, BooksTheEnergyAndSaysWhatWent) {
  const std::string failing = "/MAT/PLAS_JOHNS/5\nfailing\n" + reals({density}) + reals({young, poisson}) + reals({0.3, 0, 1, 0.02}) +
                              reals({0}) + reals({0}) + "/PROP/SHELL/5\nthree points\n" + ints({1, 2}) + reals({0, 0, 0, 0, 0}) +
                              "         3         0                 0.1                   0                   0         0\n";
  const std::string deck = materials + failing + nodes(1, square) + nodes(11, {{3, 0, 0}, {4, 0, 0}, {4, 1, 0}, {3, 1, 0}}) +
                           part(7, 5, 5) + part(8, 2, 1) + element("SHELL", 7, 21, {1, 2, 3, 4}) +
                           element("SHELL", 8, 22, {11, 12, 13, 14}) + group("GRNOD/NODE", 1, {1, 4}) + group("GRNOD/NODE", 2, {2, 3}) +
                           bcs("111 111", 1) + "/FUNCT/1\nconstant\n" + reals({0, 1}) + reals({10, 1}) +
                           "/IMPVEL/1\npull\n         1         X         0         0         2         0         0\n" +
                           reals({0, 0.2, 0, 0}) + "/TH/PART/1\nparts\nDEF\n" + ints({7, 8});
  const abut::Run run = run_of(deck, engine(0.3));
  const Balance& b = run.balance();
  EXPECT_EQ(b.ie + b.he, 0.0);
  EXPECT_NEAR(b.xe, 0.3 * 0.1 * 0.02, 0.1 * 0.3 * 0.1 * 0.02);  // the yield stress over the failure strain
  EXPECT_LT(std::fabs(b.err), 0.01);
  EXPECT_EQ(last(run, "PART/7/MASS"), 0.0);
  EXPECT_NEAR(last(run, "PART/8/MASS"), 0.1 * density, 1e-14 * density);
  ASSERT_EQ(run.findings().size(), 2U);
  const RunFinding& deleted = run.findings()[0];
  EXPECT_EQ(deleted.diagnostic.code, "run.elements_deleted");
  EXPECT_NE(deleted.diagnostic.message.find("1 of 1 elements of part 7 are deleted, the first is element 21"), std::string::npos)
      << deleted.diagnostic.message;
  EXPECT_GT(deleted.time, 0.0);
  EXPECT_EQ(run.findings()[1].diagnostic.code, "run.part_deleted");
}

}  // namespace
}  // namespace abut::small_decks
