// /MAT: LAW0, LAW1, LAW2 (deck-format.md B.8, B.9, B.12; numerics.md 5.1, 5.2).
#include <fmt/format.h>

#include "model/mesh.hpp"
#include "model/sort_by_id.hpp"
#include "simd/math.hpp"

namespace abut::model {

namespace {

enum class LawKind { none, void_law, elastic, johnson_cook };

LawKind law_kind(const deck::Block& b) {
  if (b.is(1, "VOID") || b.is(1, "LAW0") || b.is(1, "LAW00")) return LawKind::void_law;
  if (b.is(1, "ELAST") || b.is(1, "LAW1") || b.is(1, "LAW01")) return LawKind::elastic;
  if (b.is(1, "PLAS_JOHNS") || b.is(1, "LAW2") || b.is(1, "LAW02")) return LawKind::johnson_cook;
  return LawKind::none;
}

void read_density(BlockReader& r, Material& m) {
  r.next_card();
  m.density = r.real({1, 20}, "RHO_I", dim::density);
  m.reference_density = r.real({21, 40}, "RHO_0", dim::density);
  if (m.density <= 0.0) r.error("model.density", {1, 20}, "RHO_I", fmt::format("the density is {:g}: it must be positive", m.density));
  if (m.reference_density < 0.0) {
    r.error("model.density", {21, 40}, "RHO_0",
            fmt::format("the reference density is {:g}: it must be positive, or 0 for RHO_I", m.reference_density));
  }
  if (m.reference_density == 0.0) m.reference_density = m.density;
}

/// E and nu of card 3; `lowest` <= nu < 0.5.
void read_elasticity(BlockReader& r, double& young, double& poisson, double lowest) {
  r.next_card();
  young = r.real({1, 20}, "E", dim::pressure);
  poisson = r.real({21, 40}, "nu");
  if (young <= 0.0) r.error("model.young", {1, 20}, "E", fmt::format("Young's modulus is {:g}: it must be positive", young));
  if (!(poisson >= lowest && poisson < 0.5)) {
    r.error("model.poisson", {21, 40}, "nu",
            fmt::format("Poisson's ratio is {:g}: it must be at least {:g} and below 0.5", poisson, lowest));
    poisson = 0.0;
  }
}

LawElastic read_elastic(BlockReader& r) {
  LawElastic law;
  r.last_column(40);
  r.next_card();
  law.young = r.real({1, 20}, "E", dim::pressure);
  law.poisson = r.real({21, 40}, "nu");
  if (law.young <= 0.0) r.error("model.young", {1, 20}, "E", fmt::format("Young's modulus is {:g}: it must be positive", law.young));
  if (law.poisson == 0.5) {
    law.poisson = 0.499;
    r.warning("model.poisson", {21, 40}, "nu", "Poisson's ratio is 0.5, of a material that keeps its volume: 0.499 is used");
  }
  if (!(law.poisson > -1.0 && law.poisson < 0.5)) {
    r.error("model.poisson", {21, 40}, "nu", fmt::format("Poisson's ratio is {:g}: it must lie between -1 and 0.5", law.poisson));
    law.poisson = 0.0;
  }
  return law;
}

void read_void(BlockReader& r, Material& m) {
  LawVoid law;
  r.next_card();
  m.density = r.real({1, 20}, "RHO_I", dim::density);
  m.reference_density = m.density;
  law.young = r.real({21, 40}, "E", dim::pressure);
  law.poisson = r.real({41, 60}, "nu");
  if (m.density < 0.0) r.error("model.density", {1, 20}, "RHO_I", fmt::format("the density is {:g}: it must not be negative", m.density));
  if (law.young < 0.0) r.error("model.young", {21, 40}, "E", fmt::format("Young's modulus is {:g}: it must not be negative", law.young));
  if (!(law.poisson > -1.0 && law.poisson < 0.5)) {
    r.error("model.poisson", {41, 60}, "nu", fmt::format("Poisson's ratio is {:g}: it must lie between -1 and 0.5", law.poisson));
    law.poisson = 0.0;
  }
  m.law = law;
}

/// a, b, n from yield stress, ultimate engineering stress and strain (numerics.md 5.2.2).
void derive_hardening(BlockReader& r, LawJohnsonCook& law, double ultimate_stress, double ultimate_strain) {
  if (ultimate_stress <= 0.0 || ultimate_strain <= 0.0) {
    r.error("model.hardening", {21, 60}, "UTS",
            "Iflag 1 needs a positive ultimate stress and the engineering strain at which it is reached");
    return;
  }
  const double stress = ultimate_stress * (1.0 + ultimate_strain);
  const double strain = simd::log(1.0 + ultimate_strain);
  if (!(stress > law.a)) {
    r.warning("model.hardening", {21, 40}, "UTS",
              fmt::format("the true ultimate stress {:g} is not above the yield stress {:g}: no hardening is assumed", stress, law.a));
    law.n = law.b = 0.0;
    return;
  }
  law.n = stress * strain / (stress - law.a);
  law.b = stress / (law.n * simd::pow(strain, law.n - 1.0));
  if (law.n > 1.0) {
    law.n = 1.0;
    const double plastic = strain - stress / law.young - law.a / law.young;
    if (plastic <= 0.0) {
      r.error("model.hardening", {41, 60}, "EPS_UTS", "the strain at the ultimate stress is not larger than the elastic strain");
      return;
    }
    law.b = (stress - law.a) / plastic;
  }
}

double or_default(double value, double fallback) { return value == 0.0 ? fallback : value; }

LawJohnsonCook read_johnson_cook(BlockReader& r) {
  constexpr double unlimited = 1e20;
  LawJohnsonCook law;
  read_elasticity(r, law.young, law.poisson, 0.0);
  const Id form = r.integer({41, 50}, "Iflag");
  if (form != 0 && form != 1)
    r.error("model.bad_choice", {41, 50}, "Iflag", fmt::format("{} is not 0 (a, b, n) or 1 (yield and ultimate stress)", form));
  const Id rate = r.integer({51, 60}, "VP");
  if (rate < 0 || rate > 3) r.error("model.bad_choice", {51, 60}, "VP", fmt::format("{} is not one of 1, 2, 3", rate));
  law.vp = rate == 0 ? 2 : static_cast<int>(rate);
  law.p_min = or_default(r.real({61, 80}, "P_min", dim::pressure), -unlimited);
  if (law.p_min > 0.0) {
    r.error("model.pressure_limit", {61, 80}, "P_min",
            fmt::format("the least pressure is {:g}: it must be negative (tension), or 0 for none", law.p_min));
  }

  r.next_card();
  law.a = r.real({1, 20}, form == 1 ? "SIG_Y" : "a", dim::pressure);
  if (law.a <= 0.0) {
    r.error("model.yield", {1, 20}, form == 1 ? "SIG_Y" : "a", fmt::format("the initial yield stress is {:g}: it must be positive", law.a));
  }
  const double second = r.real({21, 40}, form == 1 ? "UTS" : "b", dim::pressure);
  const double third = r.real({41, 60}, form == 1 ? "EPS_UTS" : "n");
  if (form == 1) {
    derive_hardening(r, law, second, third);
  } else {
    law.b = second;
    law.n = or_default(third, 1.0);
    if (law.b < 0.0) {
      r.error("model.hardening", {21, 40}, "b",
              fmt::format("the hardening is {:g}: it must not be negative, the yield stress would fall below 0", law.b));
    }
    if (law.n < 0.0)
      r.error("model.hardening", {41, 60}, "n", fmt::format("the hardening exponent is {:g}: it must not be negative", law.n));
  }
  law.eps_max = or_default(r.real({61, 80}, "EPS_p_max"), unlimited);
  law.sigma_max = or_default(r.real({81, 100}, "SIG_max0", dim::pressure), unlimited);
  if (law.eps_max < 0.0) r.error("model.failure_strain", {61, 80}, "EPS_p_max", "a failure strain is positive, or 0 for none");
  if (law.sigma_max < 0.0) r.error("model.yield", {81, 100}, "SIG_max0", "the stress cap is positive, or 0 for none");

  r.next_card();
  law.c = r.real({1, 20}, "c");
  law.eps_rate_0 = r.real({21, 40}, "EPS_DOT_0", dim::rate);
  if (law.c < 0.0) r.error("model.rate", {1, 20}, "c", fmt::format("the rate coefficient is {:g}: it must not be negative", law.c));
  if (law.c > 0.0 && law.eps_rate_0 <= 0.0) {
    r.error("model.rate", {21, 40}, "EPS_DOT_0", "a positive reference strain rate is needed where c is not 0");
  }
  const Id icc = r.integer({41, 50}, "ICC");
  if (icc < 0 || icc > 2)
    r.error("model.bad_choice", {41, 50}, "ICC", fmt::format("{} is not 1 (rate effect on the stress cap) or 2 (none)", icc));
  law.icc = icc == 0 ? 1 : static_cast<int>(icc);
  law.cutoff = r.real({61, 80}, "F_cut", dim::rate);
  if (law.cutoff < 0.0) r.error("model.rate", {61, 80}, "F_cut", "a cut-off frequency is positive, or 0 for no filter");
  if (law.cutoff > 0.0 && law.c > 0.0 && law.vp == 1) {
    r.warning("model.no_effect", {61, 80}, "F_cut", "the plastic strain rate of VP 1 is always filtered at 10 kHz, this field is not used");
  }
  law.kinematic = r.real({81, 100}, "C_hard");
  if (!(law.kinematic >= 0.0 && law.kinematic <= 1.0)) {
    r.error("model.hardening", {81, 100}, "C_hard", fmt::format("{:g} is not between 0 (isotropic) and 1 (kinematic)", law.kinematic));
  }

  r.next_card();
  law.m = or_default(r.real({1, 20}, "m"), 1.0);
  law.t_melt = or_default(r.real({21, 40}, "T_melt"), unlimited);
  law.rho_cp = r.real({41, 60}, "rhoC_p", dim::pressure);
  law.t_ref = r.real({61, 80}, "T_r");
  if (law.t_ref <= 0.0) law.t_ref = 300.0;
  law.t_max = or_default(r.real({81, 100}, "T_max"), unlimited);
  if (law.t_melt <= law.t_ref)
    r.error("model.temperature", {21, 40}, "T_melt",
            fmt::format("the melting temperature {:g} is not above the reference temperature {:g}", law.t_melt, law.t_ref));
  return law;
}

}  // namespace

void read_materials(Context& c) {
  std::vector<Place> places;
  for (const deck::Block& b : c.deck->blocks) {
    if (!b.is(0, "MAT")) continue;
    const LawKind kind = law_kind(b);
    if (kind == LawKind::none) continue;  // refused by check_keywords; parts that use it find no material
    BlockReader r(c, b, 2, true);
    Material m;
    m.id = r.id();
    m.title = r.title();
    if (kind == LawKind::void_law) {
      read_void(r, m);
    } else {
      read_density(r, m);
      if (kind == LawKind::elastic) m.law = read_elastic(r);
      if (kind == LawKind::johnson_cook) m.law = read_johnson_cook(r);
    }
    c.model->materials.push_back(std::move(m));
    places.push_back(r.place());
  }
  sort_by_id(c, c.model->materials, places, "/MAT", c.tables.materials);
}

}  // namespace abut::model
