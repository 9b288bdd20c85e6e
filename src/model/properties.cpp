// /PROP: TYPE0, TYPE1, TYPE14 (deck-format.md B.4 to B.6), defaults made explicit.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "model/mesh.hpp"
#include "model/sort_by_id.hpp"

namespace abut::model {

namespace {

struct Reading {
  Context& context;
  BlockReader& reader;
  std::vector<RefusedFormulation>& refused;
};

/// Saturates: an absurd value stays absurd.
int to_int(Id value) { return static_cast<int>(std::clamp<Id>(value, std::numeric_limits<int>::min(), std::numeric_limits<int>::max())); }

/// A flag whose 0 means `fallback`; outside [low, high] is an error.
int read_flag(BlockReader& r, deck::Columns columns, std::string_view field, Id low, Id high, int fallback) {
  const Id value = r.integer(columns, field);
  if (value == 0) return fallback;
  if (value < low || value > high) {
    r.error("model.bad_choice", columns, field, fmt::format("{} is not between {} and {}", value, low, high));
    return fallback;
  }
  return to_int(value);
}

double read_positive(BlockReader& r, deck::Columns columns, std::string_view field, double fallback, Dimension d = dim::none) {
  const double value = r.real(columns, field, d);
  if (value < 0.0) {
    r.error("model.negative_coefficient", columns, field,
            fmt::format("{:g} is negative: it must be positive, or 0 for the default {:g}", value, fallback));
  }
  return value == 0.0 ? fallback : value;
}

void must_be_zero(BlockReader& r, deck::Columns columns, std::string_view field, std::string_view what) {
  const double value = r.real(columns, field);
  if (value != 0.0) r.error("model.unsupported", columns, field, fmt::format("{} ({:g}) is not supported; write 0", what, value));
}

void refuse(Reading& in, ElementKind kind, deck::Columns columns, std::string_view field, bool by_default, int value,
            std::string_view right) {
  Diagnostic d;
  d.severity = Severity::error;
  d.code = "model.unsupported_formulation";
  d.place = in.reader.place(columns, field);
  d.message = fmt::format(
      "{} {}{} is not supported: {}", field, value,
      by_default ? (kind == ElementKind::shell4 || kind == ElementKind::shell3 ? " (from /DEF_SHELL)" : " (from /DEF_SOLID)") : "", right);
  in.refused.push_back({in.reader.id(), kind, std::move(d)});
}

ShellProperty read_shell(Reading& in) {
  BlockReader& r = in.reader;
  const ShellDefaults& d = in.context.shell_defaults;
  ShellProperty p;
  r.next_card();
  const Id ishell = r.integer({1, 10}, "Ishell");
  p.ishell = ishell == 0 ? d.ishell : to_int(ishell);
  if (p.ishell < 1 || p.ishell > 4) refuse(in, ElementKind::shell4, {1, 10}, "Ishell", ishell == 0, p.ishell, "1, 2, 3 and 4 are");
  const Id ismstr = d.ismstr == -2 ? 0 : r.integer({11, 20}, "Ismstr");
  p.ismstr = ismstr == 0 ? d.ismstr : to_int(ismstr);
  if (p.ismstr == -1 || p.ismstr == -2) p.ismstr = 2;
  if (p.ismstr < 1 || p.ismstr > 4) {
    for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
      refuse(in, kind, {11, 20}, "Ismstr", ismstr == 0, p.ismstr, "1 to 4 are");
    }
  }
  if (p.ismstr == 3 && p.ishell != 2) p.ismstr = 2;
  const Id ish3n = r.integer({21, 30}, "Ish3n");
  p.ish3n = ish3n == 0 ? d.ish3n : to_int(ish3n);
  if (p.ish3n < 1 || p.ish3n > 2) refuse(in, ElementKind::shell3, {21, 30}, "Ish3n", ish3n == 0, p.ish3n, "1 and 2 are");
  const int idrill = read_flag(r, {31, 40}, "Idrill", 1, 2, d.idrill);
  p.idrill = idrill == 1 ? 1 : 0;
  if (p.idrill == 1)
    refuse(in, ElementKind::shell4, {31, 40}, "Idrill", r.blank({31, 40}) || r.text({31, 40}) == "0", 1, "0 (no drilling stiffness) is");
  if (r.integer({41, 50}, "Ipinch") != 0) refuse(in, ElementKind::shell4, {41, 50}, "Ipinch", false, 1, "0 (no pinching) is");
  const double fail = r.real({61, 80}, "P_thickfail");
  if (fail < 0.0 || fail > 1.0) r.error("model.bad_fraction", {61, 80}, "P_thickfail", fmt::format("{:g} is not a fraction: 0 to 1", fail));
  if (fail > 0.0) {
    p.p_thickfail = fail;
    r.warning("model.no_effect", {61, 80}, "P_thickfail", "this field is not used: a shell fails when its most strained point does");
  }

  r.next_card();
  const bool elastoplastic = p.ishell == 3;
  p.hm = read_positive(r, {1, 20}, "hm", elastoplastic ? 0.1 : 0.01);
  p.hf = read_positive(r, {21, 40}, "hf", elastoplastic ? 0.1 : 0.01);
  p.hr = read_positive(r, {41, 60}, "hr", 0.01);
  p.dm = read_positive(r, {61, 80}, "dm", 0.0);
  p.dn = read_positive(r, {81, 100}, "dn", 0.0);

  r.next_card();
  const Id points = r.integer({1, 10}, "N");
  if (points < 0 || points > 10) {
    r.error("model.bad_choice", {1, 10}, "N", fmt::format("{} integration points: 0 (global) to 10 are possible", points));
  } else {
    p.points = to_int(points);
  }
  p.thickness = r.real({21, 40}, "Thick", dim::length);
  if (p.thickness <= 0.0)
    r.error("model.thickness", {21, 40}, "Thick", fmt::format("the thickness is {:g}: it must be positive", p.thickness));
  p.shear_factor = read_positive(r, {41, 60}, "Ashear", 5.0 / 6.0);
  p.thickness_changes = read_flag(r, {71, 80}, "Ithick", 1, 2, d.ithick) == 1;
  p.iplas = read_flag(r, {81, 90}, "Iplas", 1, 2, d.iplas);
  if (in.context.model->version >= 2024) {
    const Id position = r.integer({91, 100}, "Ipos");
    if (position != 0) refuse(in, ElementKind::shell4, {91, 100}, "Ipos", false, to_int(position), "0 (mid-plane) is");
  }
  return p;
}

SolidProperty read_solid(Reading& in) {
  BlockReader& r = in.reader;
  const SolidDefaults& d = in.context.solid_defaults;
  const int version = in.context.model->version;
  const bool old = version < 51;
  SolidProperty p;
  r.next_card();
  const Id isolid = r.integer({1, 10}, "Isolid");
  p.isolid = isolid == 0 ? d.isolid : to_int(isolid);
  if (p.isolid != 1 && p.isolid != 2) refuse(in, ElementKind::brick, {1, 10}, "Isolid", isolid == 0, p.isolid, "1 and 2 are");
  const Id ismstr = d.ismstr == -2 ? 0 : r.integer({11, 20}, "Ismstr");
  p.ismstr = ismstr == 0 ? d.ismstr : to_int(ismstr);
  if (p.ismstr == -1 || p.ismstr == -2) p.ismstr = 4;
  if (p.ismstr < 1 || p.ismstr > 4) {
    for (const ElementKind kind : {ElementKind::brick, ElementKind::tetra}) {
      refuse(in, kind, {11, 20}, "Ismstr", ismstr == 0, p.ismstr, "1 to 4 are");
    }
  }
  if (version >= 2022) {
    const Id iale = r.integer({21, 30}, "Iale");
    if (iale != 0) refuse(in, ElementKind::brick, {21, 30}, "Iale", false, to_int(iale), "0 (Lagrangian) is");
  }
  p.icpre = read_flag(r, {31, 40}, "Icpre", 1, 3, d.icpre);
  if (p.icpre == 1 || p.icpre == 2) {
    r.warning("model.no_effect", {31, 40}, "Icpre", "this field is not used: solids of one point have one pressure");
  }
  p.iframe = d.iframe;
  p.itetra4 = d.itetra4;
  p.imas = d.imas;
  if (!old) {
    const Id itetra4 = r.integer({61, 70}, "Itetra4");
    if (itetra4 != 0) p.itetra4 = to_int(itetra4);
    if (p.itetra4 != 1000) refuse(in, ElementKind::tetra, {61, 70}, "Itetra4", itetra4 == 0, p.itetra4, "1000 (one point) is");
    p.iframe = read_flag(r, {71, 80}, "Iframe", 1, 2, d.iframe);
    p.dn = read_positive(r, {81, 100}, "dn", 0.1);
  }
  r.next_card();
  p.qa = read_positive(r, {1, 20}, "qa", 1.1);
  p.qb = read_positive(r, {21, 40}, "qb", 0.05);
  p.h = read_positive(r, {41, 60}, "h", 0.1);
  if (p.h >= 0.15) r.error("model.hourglass", {41, 60}, "h", fmt::format("the hourglass coefficient is {:g}: it must be below 0.15", p.h));
  if (!old) {
    for (const auto& [columns, field] : {std::pair{deck::Columns{61, 80}, "Lambda"}, std::pair{deck::Columns{81, 100}, "Mu"}}) {
      must_be_zero(r, columns, field, "a numerical viscosity of Navier and Stokes");
    }
    r.next_card();
    p.dt_min = read_positive(r, {1, 20}, "dt_min", 0.0, dim::time);
    if (version >= 2023) {
      const std::array<std::pair<deck::Columns, std::string_view>, 4> shapes{
          {{{21, 40}, "Vdef_min"}, {{41, 60}, "Vdef_max"}, {{61, 80}, "ASP_max"}, {{81, 100}, "COL_min"}}};
      for (const auto& [columns, field] : shapes) must_be_zero(r, columns, field, "deletion by the shape of an element");
    }
  }
  return p;
}

enum class PropertyKind { none, shell, solid, void_kind };

PropertyKind property_kind(const deck::Block& b) {
  if (b.is(1, "SHELL") || b.is(1, "TYPE1") || b.is(1, "TYPE01")) return PropertyKind::shell;
  if (b.is(1, "SOLID") || b.is(1, "TYPE14")) return PropertyKind::solid;
  if (b.is(1, "VOID") || b.is(1, "TYPE0") || b.is(1, "TYPE00")) return PropertyKind::void_kind;
  return PropertyKind::none;
}

}  // namespace

std::vector<RefusedFormulation> read_properties(Context& c) {
  std::vector<RefusedFormulation> refused;
  std::vector<Place> places;
  for (const deck::Block& b : c.deck->blocks) {
    if (!b.is(0, "PROP")) continue;
    const PropertyKind kind = property_kind(b);
    if (kind == PropertyKind::none) continue;  // refused by check_keywords
    BlockReader r(c, b, 2, true);
    Reading in{c, r, refused};
    Property p;
    p.id = r.id();
    p.title = r.title();
    if (kind == PropertyKind::shell) p.data = read_shell(in);
    if (kind == PropertyKind::solid) p.data = read_solid(in);
    if (kind == PropertyKind::void_kind) {
      VoidProperty v;
      r.next_card();
      v.thickness = r.real({1, 20}, "Thick", dim::length);
      if (v.thickness < 0.0)
        r.error("model.thickness", {1, 20}, "Thick", fmt::format("the thickness is {:g}: it must not be negative", v.thickness));
      p.data = v;
    }
    c.model->properties.push_back(std::move(p));
    places.push_back(r.place());
  }
  sort_by_id(c, c.model->properties, places, "/PROP", c.tables.properties);
  return refused;
}

}  // namespace abut::model
