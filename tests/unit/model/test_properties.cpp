// Materials and properties with their defaults: deck-format.md A.12, B.4 to B.12; numerics.md 5.2.2.
#include <gtest/gtest.h>

#include <cmath>

#include "fixture.hpp"

namespace abut::model::testing {
namespace {

std::string ten(const Strings& values) {
  std::string s;
  for (const std::string& v : values) s += field(v, 10);
  return s + "\n";
}

TEST(Materials, ElasticDefaultsAndZeroPaddedName) {
  Reading r;
  r.read(std::string(begin_2022) + "/MAT/LAW01/3\n m \n" + reals({"7800"}) + reals({"2.1E11"}) + "/MAT/ELAST/2\n\n" + reals({"1", "2"}) +
         reals({"5", ".5"}));
  EXPECT_EQ(r.errors(), Strings{});
  ASSERT_EQ(r.model.materials.size(), 2u);
  EXPECT_EQ(r.model.materials[0].id, 2);
  EXPECT_EQ(r.model.materials[0].reference_density, 2.0);
  EXPECT_EQ(std::get<LawElastic>(r.model.materials[0].law).poisson, 0.499);
  EXPECT_EQ(r.model.materials[1].title, "m");
  EXPECT_EQ(r.model.materials[1].reference_density, 7800.0);
  EXPECT_EQ(std::get<LawElastic>(r.model.materials[1].law).poisson, 0.0);
}

TEST(Materials, Surprise9VoidMayBeATitleAlone) {
  Reading r;
  r.read(std::string(begin_2022) + "/MAT/VOID/3\nempty\n/MAT/LAW0/4\nvoid\n" + reals({"1", "2", ".3"}) + "/PROP/VOID/1\nv\n");
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.materials[0].density, 0.0);
  EXPECT_EQ(std::get<LawVoid>(r.model.materials[1].law).young, 2.0);
  EXPECT_EQ(std::get<VoidProperty>(r.model.properties[0].data).thickness, 0.0);
}

TEST(Materials, JohnsonCookZeroMeansDefault) {
  Reading r;
  r.read(std::string(begin_2022) + "/MAT/PLAS_JOHNS/1\nm\n" + reals({"7800", "0"}) + reals({"2E11", ".3"}) + reals({"1E8", "2E8"}));
  EXPECT_EQ(r.errors(), Strings{});
  const auto& law = std::get<LawJohnsonCook>(r.model.materials[0].law);
  EXPECT_EQ(law.a, 1e8);
  EXPECT_EQ(law.b, 2e8);
  EXPECT_EQ(law.n, 1.0);
  EXPECT_EQ(law.eps_max, 1e20);
  EXPECT_EQ(law.sigma_max, 1e20);
  EXPECT_EQ(law.icc, 1);
  EXPECT_EQ(law.vp, 2);
  EXPECT_EQ(law.m, 1.0);
  EXPECT_EQ(law.t_melt, 1e20);
  EXPECT_EQ(law.t_ref, 300.0);
  EXPECT_EQ(law.t_max, 1e20);
  EXPECT_EQ(law.p_min, -1e20);
  EXPECT_EQ(law.cutoff, 0.0);
}

TEST(Materials, JohnsonCookReadsEveryField) {
  Reading r;
  r.read("/BEGIN\nt\n      2025\n" + reals({"kg", "mm", "ms"}) + reals({"kg", "m", "s"}) + "/MAT/LAW2/1\nm\n" + reals({"7.8E-6"}) +
         field("210", 20) + field(".3", 20) + ten({"0", "3"}).substr(0, 20) + field("-5", 20) + "\n" +
         reals({".1", ".2", ".5", ".6", ".7"}) + reals({".05", ".001"}).substr(0, 40) + ten({"2", "1"}).substr(0, 20) +
         reals({"10", ".25"}) + reals({"1.5", "1800", "4E-3", "293", "1000"}));
  EXPECT_EQ(r.errors(), Strings{});
  const Material& m = r.model.materials[0];
  const auto& law = std::get<LawJohnsonCook>(m.law);
  EXPECT_DOUBLE_EQ(m.density, 7800.0);
  EXPECT_DOUBLE_EQ(law.young, 210e9);
  EXPECT_EQ(law.vp, 3);
  EXPECT_DOUBLE_EQ(law.p_min, -5e9);
  EXPECT_DOUBLE_EQ(law.a, 0.1e9);
  EXPECT_DOUBLE_EQ(law.b, 0.2e9);
  EXPECT_EQ(law.n, 0.5);
  EXPECT_EQ(law.eps_max, 0.6);
  EXPECT_DOUBLE_EQ(law.sigma_max, 0.7e9);
  EXPECT_EQ(law.c, 0.05);
  EXPECT_DOUBLE_EQ(law.eps_rate_0, 1.0);
  EXPECT_EQ(law.icc, 2);
  EXPECT_DOUBLE_EQ(law.cutoff, 1e4);
  EXPECT_EQ(law.kinematic, 0.25);
  EXPECT_EQ(law.m, 1.5);
  EXPECT_EQ(law.t_melt, 1800.0);
  EXPECT_DOUBLE_EQ(law.rho_cp, 4e6);
  EXPECT_EQ(law.t_ref, 293.0);
  EXPECT_EQ(law.t_max, 1000.0);
}

std::string ultimate_form(const std::string& yield, const std::string& stress, const std::string& strain) {
  return std::string(begin_2022) + "/MAT/PLAS_JOHNS/1\nm\n" + reals({"7800"}) + field("2E5", 20) + field(".3", 20) + field("1", 10) + "\n" +
         reals({yield, stress, strain});
}

TEST(Materials, UltimateStressFormReachesItsMaximumLoadAtTheGivenStrain) {
  Reading r;
  r.read(ultimate_form("200", "400", "0.2"));
  EXPECT_EQ(r.errors(), Strings{});
  const auto& law = std::get<LawJohnsonCook>(r.model.materials[0].law);
  const double strain = std::log(1.2);
  const double true_stress = 480.0;
  EXPECT_NEAR(law.a + law.b * std::pow(strain, law.n), true_stress, 1e-10);        // the curve meets the ultimate point
  EXPECT_NEAR(law.n * law.b * std::pow(strain, law.n - 1.0), true_stress, 1e-10);  // Considere: dS/de = S there
}

TEST(Materials, UltimateStressFormCapsTheExponentAtOne) {
  Reading r;
  r.read(ultimate_form("300", "310", "0.3"));
  const auto& law = std::get<LawJohnsonCook>(r.model.materials[0].law);
  EXPECT_EQ(law.n, 1.0);
  const double stress = 310.0 * 1.3;
  EXPECT_NEAR(law.b, (stress - 300.0) / (std::log(1.3) - stress / 2e5 - 300.0 / 2e5), 1e-10);
}

TEST(Materials, UltimateStressBelowYieldMeansNoHardening) {
  Reading r;
  r.read(ultimate_form("300", "200", "0.1"));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.diagnostics.warning_count(), 1);
  EXPECT_EQ(std::get<LawJohnsonCook>(r.model.materials[0].law).b, 0.0);
}

TEST(Materials, BadValuesSayWhatWouldBeRight) {
  Reading r;
  r.read(std::string(begin_2022) + "/MAT/ELAST/1\nm\n" + reals({"0"}) + reals({"-1", ".7"}) + "/MAT/LAW2/2\nm\n" + reals({"1"}) +
         reals({"1", "-.1"}) + reals({"0"}) + reals({".1", "0"}) + "/MAT/ELAST/1\nagain\n" + reals({"1"}) + reals({"1"}) + "/MAT/LAW2/3\n");
  EXPECT_EQ(r.errors(),
            (Strings{
                "t_0000.rad:8: /MAT/ELAST/1 field 'RHO_I' (columns 1-20): the density is 0: it must be positive",
                "t_0000.rad:9: /MAT/ELAST/1 field 'E' (columns 1-20): Young's modulus is -1: it must be positive",
                "t_0000.rad:9: /MAT/ELAST/1 field 'nu' (columns 21-40): Poisson's ratio is 0.7: it must lie between -1 and 0.5",
                "t_0000.rad:13: /MAT/LAW2/2 field 'nu' (columns 21-40): Poisson's ratio is -0.1: it must be at least 0 and below 0.5",
                "t_0000.rad:14: /MAT/LAW2/2 field 'a' (columns 1-20): the initial yield stress is 0: it must be positive",
                "t_0000.rad:15: /MAT/LAW2/2 field 'EPS_DOT_0' (columns 21-40): a positive reference strain rate is needed where c is not 0",
                "t_0000.rad:20: /MAT/LAW2/3 field 'RHO_I' (columns 1-20): the density is 0: it must be positive",
                "t_0000.rad:20: /MAT/LAW2/3 field 'E' (columns 1-20): Young's modulus is 0: it must be positive",
                "t_0000.rad:20: /MAT/LAW2/3 field 'a' (columns 1-20): the initial yield stress is 0: it must be positive",
                "t_0000.rad:16: /MAT/ELAST/1: a second /MAT with id 1 (the first is at t_0000.rad:6): ids must be unique",
            }));
}

TEST(Properties, Surprise11ZeroMeansDefault) {
  Reading r;
  r.read(std::string(begin_2022) + shell_property + solid_property);
  EXPECT_EQ(r.errors(), Strings{});
  const auto& shell = std::get<ShellProperty>(r.model.properties[0].data);
  EXPECT_EQ(shell.ishell, 1);
  EXPECT_EQ(shell.ismstr, 2);
  EXPECT_EQ(shell.ish3n, 2);
  EXPECT_EQ(shell.hm, 0.01);
  EXPECT_EQ(shell.hf, 0.01);
  EXPECT_EQ(shell.hr, 0.01);
  EXPECT_EQ(shell.points, 0);
  EXPECT_EQ(shell.shear_factor, 5.0 / 6.0);
  EXPECT_FALSE(shell.thickness_changes);
  EXPECT_EQ(shell.iplas, 2);
  EXPECT_EQ(shell.p_thickfail, 0.999999);
  const auto& solid = std::get<SolidProperty>(r.model.properties[1].data);
  EXPECT_EQ(solid.isolid, 1);
  EXPECT_EQ(solid.ismstr, 4);
  EXPECT_EQ(solid.iframe, 1);
  EXPECT_EQ(solid.itetra4, 1000);
  EXPECT_EQ(solid.qa, 1.1);
  EXPECT_EQ(solid.qb, 0.05);
  EXPECT_EQ(solid.h, 0.1);
  EXPECT_EQ(solid.imas, 2);
}

TEST(Properties, DefaultsOfTheDeckFillZeros) {
  Reading r;
  r.read(std::string(begin_2022) + shell_property + solid_property +
         "/DEF_SHELL\n         3         4         1         1         0                             1         0\n/DEF_SOLID\n         2   "
         "      1         0         0         0         0         1         2\n");
  const auto& shell = std::get<ShellProperty>(r.model.properties[0].data);
  EXPECT_EQ(shell.ishell, 3);
  EXPECT_EQ(shell.ismstr, 4);
  EXPECT_EQ(shell.ish3n, 1);
  EXPECT_EQ(shell.hm, 0.1);
  EXPECT_EQ(shell.hf, 0.1);
  EXPECT_EQ(shell.hr, 0.01);
  EXPECT_TRUE(shell.thickness_changes);
  EXPECT_EQ(shell.iplas, 1);
  const auto& solid = std::get<SolidProperty>(r.model.properties[1].data);
  EXPECT_EQ(solid.isolid, 2);
  EXPECT_EQ(solid.ismstr, 1);
  EXPECT_EQ(solid.iframe, 2);
  EXPECT_EQ(solid.imas, 1);
}

TEST(Properties, UnsupportedFormulationsAreErrorsWhereElementsUseThem) {
  const std::string nodes = "/NODE\n" + node(1, "0", "0", "0") + node(2, "1", "0", "0") + node(3, "1", "1", "0") + node(4, "0", "1", "0");
  const std::string property =
      "/PROP/SHELL/1\np\n" + ten({"24", "0", "30"}) + "\n" + ten({"0", "0"}).substr(0, 20) + field(".01", 20) + "\n";
  Reading quad;
  quad.read(std::string(begin_2022) + steel + property + shell_part + nodes + "/SHELL/1\n" + ints({1, 1, 2, 3, 4}));
  EXPECT_EQ(quad.errors(),
            Strings{"t_0000.rad:12: /PROP/SHELL/1 field 'Ishell' (columns 1-10): Ishell 24 is not supported: 1, 2, 3 and 4 are"});
  Reading triangle;
  triangle.read(std::string(begin_2022) + steel + property + shell_part + nodes + "/SH3N/1\n" + ints({1, 1, 2, 3}));
  EXPECT_EQ(triangle.errors(),
            Strings{"t_0000.rad:12: /PROP/SHELL/1 field 'Ish3n' (columns 21-30): Ish3n 30 is not supported: 1 and 2 are"});
  Reading unused;
  unused.read(std::string(begin_2022) + steel + property + shell_part + nodes);
  EXPECT_EQ(unused.errors(), Strings{});
  Reading by_default;
  by_default.read(std::string(begin_2022) + "/DEF_SOLID\n        24\n" + steel + solid_property + solid_part + nodes +
                  node(5, "0", "0", "1") + "/BRICK/2\n" + ints({1, 1, 3, 2, 5}));
  EXPECT_EQ(
      by_default.errors(),
      Strings{"t_0000.rad:14: /PROP/SOLID/2 field 'Isolid' (columns 1-10): Isolid 24 (from /DEF_SOLID) is not supported: 1 and 2 are"});
}

TEST(Properties, BadValuesSayWhatWouldBeRight) {
  Reading r;
  r.read(std::string(begin_2022) + "/PROP/SHELL/1\np\n" + ten({"x"}) + reals({"-1"}) + ten({"11", "0"}).substr(0, 20) + field("0", 20) +
         "\n" + "/PROP/SOLID/2\np\n\n" + reals({"0", "0", ".2"}) + "/PROP/VOID/3\nv\n" + reals({"-1"}) + "/PROP/SHELL\n\n\n\n" +
         ten({"0", "0"}).substr(0, 20) + field("1", 20) + "\n");
  EXPECT_EQ(r.errors(),
            (Strings{
                "t_0000.rad:8: /PROP/SHELL/1 field 'Ishell' (columns 1-10): 'x' is not an integer",
                "t_0000.rad:9: /PROP/SHELL/1 field 'hm' (columns 1-20): -1 is negative: it must be positive, or 0 for the default 0.01",
                "t_0000.rad:10: /PROP/SHELL/1 field 'N' (columns 1-10): 11 integration points: 0 (global) to 10 are possible",
                "t_0000.rad:10: /PROP/SHELL/1 field 'Thick' (columns 21-40): the thickness is 0: it must be positive",
                "t_0000.rad:14: /PROP/SOLID/2 field 'h' (columns 41-60): the hourglass coefficient is 0.2: it must be below 0.15",
                "t_0000.rad:17: /PROP/VOID/3 field 'Thick' (columns 1-20): the thickness is -1: it must not be negative",
                "t_0000.rad:18: /PROP/SHELL: the keyword line needs an id: a positive integer",
            }));
}

}  // namespace
}  // namespace abut::model::testing
