// /INTER/TYPE3, TYPE5 and TYPE7 (deck-format.md E.1 to E.3, numerics.md 7.2.1).
#include <fmt/format.h>

#include <cmath>

#include "model/condition_fields.hpp"
#include "model/orientation.hpp"

namespace abut::model {

namespace {

Index required_surface(BlockReader& r, deck::Columns c, std::string_view field) {
  const Id id = r.integer(c, field);
  if (id == 0) r.error("model.missing_reference", c, field, "no surface is given; write the id of a /SURF");
  return r.resolve(r.context().tables.surfaces, id, "/SURF", c, field);
}

double non_negative(BlockReader& r, deck::Columns c, std::string_view field, Dimension d, std::string_view what) {
  const double value = r.real(c, field, d);
  if (value < 0.0) r.error("model.out_of_range", c, field, fmt::format("{} cannot be negative; write 0 or more", what));
  return value;
}

/// 0 none, 1 when all, 2 when one of the elements at a segment is deleted; negative: free nodes stay. Others count as 0 (E.1).
int read_idel(BlockReader& r, deck::Columns c) {
  const Id idel = r.integer(c, "Idel");
  if (idel == 1000) return 0;
  if (idel >= -2 && idel <= 2) return static_cast<int>(idel);
  r.warning("model.out_of_range", c, "Idel", fmt::format("{} is not 0, 1, 2, -1 or -2; 0 (no deletion) is used", idel));
  return 0;
}

void read_ibc(BlockReader& r, Interface& i) {
  constexpr std::array<std::string_view, 3> names{"IBC_x", "IBC_y", "IBC_z"};
  for (int k = 0; k < 3; ++k) i.ibc[static_cast<std::size_t>(k)] = r.flag(8 + k, names[static_cast<std::size_t>(k)]);
  r.only_flags({1, 10}, {8, 9, 10}, "IBC",
               old_layout(r.context()) ? "the directions x, y, z go in columns 6 to 8" : "the directions x, y, z go in columns 8 to 10");
}

void read_times(BlockReader& r, Interface& i) {
  i.t_start = r.real({61, 80}, "Tstart", dim::time);
  i.t_stop = stop_time(r, {81, 100}, "Tstop");
  if (i.t_stop <= i.t_start) r.error("model.out_of_range", {81, 100}, "Tstop", "Tstop must be later than Tstart, or 0 for never");
}

/// Card 3 of TYPE3 and TYPE5.
void read_stiffness_card(BlockReader& r, Interface& i) {
  i.stfac = r.real({1, 20}, "Stfac");
  if (i.stfac < 0.0) {
    r.error("model.out_of_range", {1, 20}, "Stfac",
            "a stiffness factor cannot be negative: contact would pull; write a value between 0 and 1, or 0 for 0.2");
  }
  if (i.stfac == 0.0) i.stfac = 0.2;
  if (i.stfac >= 1.0) {
    r.warning("model.stiff_contact", {1, 20}, "Stfac",
              fmt::format("{} is not below 1; contact this stiff lowers the time step, 0.2 is usual", i.stfac));
  }
  i.friction = non_negative(r, {21, 40}, "Fric", dim::none, "a friction coefficient");
  i.gap = non_negative(r, {41, 60}, "Gap", dim::length, "a gap");
  read_times(r, i);
}

void read_ptlim(BlockReader& r, Interface& i) {
  const double ptlim = non_negative(r, {61, 80}, "Ptlim", dim::pressure, "a limit of friction stress");
  const double never = infinity * r.context().factor(dim::pressure, r.unit_id());
  if (ptlim > 0.0 && ptlim < never) i.ptlim = ptlim;
}

/// Dimensions of C1 to C6 by friction law (E.2).
Dimension coefficient_dimension(int ifric, int k) {
  constexpr Dimension p1{-1, 1, 2}, p2{-2, 2, 4}, v1{0, -1, 1}, v2{0, -2, 2}, pv{-1, 0, 3};
  constexpr std::array<std::array<Dimension, 6>, 4> table{{{p1, v1, pv, p2, v2, dim::none},
                                                           {p2, v1, p1, v1, dim::none, v1},
                                                           {dim::none, dim::none, dim::none, dim::none, dim::velocity, dim::velocity},
                                                           {dim::none, v1, dim::none, dim::none, dim::none, dim::none}}};
  return table[static_cast<std::size_t>(ifric - 1)][static_cast<std::size_t>(k)];
}

void read_coefficients(BlockReader& r, Interface& i) {
  if (i.ifric <= 0) return;
  constexpr std::array<std::string_view, 6> names{"C1", "C2", "C3", "C4", "C5", "C6"};
  r.next_card();
  for (int k = 0; k < 5; ++k) {
    i.c[static_cast<std::size_t>(k)] =
        r.real({20 * k + 1, 20 * k + 20}, names[static_cast<std::size_t>(k)], coefficient_dimension(i.ifric, k));
  }
  if (i.ifric <= 1) return;
  r.next_card();
  i.c[5] = r.real({1, 20}, names[5], coefficient_dimension(i.ifric, 5));
  if (i.ifric != 3) return;
  if (!(i.c[4] > 0.0 && i.c[5] > i.c[4])) {
    r.error("model.out_of_range", {1, 20}, names[5],
            "Ifric 3 (Renard) needs speeds 0 < C5 < C6: C5 where friction is largest, C6 where it is smallest");
  }
  if (i.c[3] > i.c[1] || i.c[0] < 0.0 || i.c[3] < 0.0) {
    r.error("model.out_of_range", {1, 20}, names[5],
            "Ifric 3 (Renard) needs C1 >= 0 and 0 <= C4 <= C2: C4 is the smallest coefficient, C2 the one at high speed");
  }
}

void read_filter(BlockReader& r, Interface& i) {
  i.ifiltr = integer_in(r, {11, 20}, "Ifiltr", 0, 3, "a filter; write 0 (none), 1, 2 or 3");
  i.xfreq = filter_factor(r, {21, 40}, "Xfreq", i.ifiltr, "Ifiltr");
  if (i.xfreq == 0.0) i.ifiltr = 0;
}

Interface start(BlockReader& r) {
  Interface i;
  i.id = r.id();
  i.title = r.title();
  i.place = r.place();
  return i;
}

/// v41 to v44: the title of TYPE3 and TYPE5 is a card although those of other keywords stand on the keyword line.
void read_old_title(BlockReader& r, Interface& i) {
  if (!old_layout(r.context())) return;
  r.next_card();
  i.title = std::string(r.text({1, 100}));
}

Interface read_type3(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 2, true);
  Interface i = start(r);
  InterfaceType3 t;
  read_old_title(r, i);
  r.next_card();
  t.surface_1 = required_surface(r, {1, 10}, "surf_ID1");
  t.surface_2 = required_surface(r, {11, 20}, "surf_ID2");
  if (t.surface_1 != no_index && t.surface_1 == t.surface_2) {
    r.error("model.same_surface", {11, 20}, "surf_ID2",
            "both surfaces are the same; TYPE3 joins two surfaces without a common node (self contact is /INTER/TYPE7)");
  }
  if (!old_layout(c)) i.idel = read_idel(r, {71, 80});
  r.next_card();
  read_stiffness_card(r, i);
  r.next_card();
  read_ibc(r, i);
  t.irs = integer_in(r, {11, 20}, "Irs", 0, 2, "0 (turn segments out of their solid), 1 (reverse all) or 2 (leave all)");
  t.irm = integer_in(r, {21, 30}, "Irm", 0, 2, "0 (turn segments out of their solid), 1 (reverse all) or 2 (leave all)");
  r.next_card();
  if (!old_layout(c)) read_ptlim(r, i);
  i.type = t;
  return i;
}

Interface read_type5(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 2, true);
  Interface i = start(r);
  InterfaceType5 t;
  const bool old = old_layout(c);
  const int version = c.model->version;
  read_old_title(r, i);
  r.next_card();
  t.nodes = required_group(r, {1, 10}, "grnd_IDs");
  t.surface = required_surface(r, {11, 20}, "surf_IDm");
  if (old && version == 42) {
    i.ifric = integer_in(r, {41, 50}, "Ifric", 0, 3, "a friction law; write 0 (Coulomb), 1, 2 or 3");
  } else if (!old || version == 44) {
    i.idel = read_idel(r, old ? deck::Columns{61, 70} : deck::Columns{71, 80});
  }
  r.next_card();
  read_stiffness_card(r, i);
  r.next_card();
  read_ibc(r, i);
  t.irm = integer_in(r, {21, 30}, "Irm", 0, 2, "0 (turn segments out of their solid), 1 (reverse all) or 2 (leave all)");
  if (!old) t.inacti = integer_in(r, {31, 40}, "Inacti", 0, 4, "0, 1, 3 (move nodes) or 4 (move segments)");
  if (t.inacti == 2) {
    r.error("model.out_of_range", {31, 40}, "Inacti", "TYPE5 has no Inacti 2; write 0 (full forces), 3 (move nodes) or 4 (move segments)");
  } else if (t.inacti == 1) {
    r.warning("model.no_effect", {31, 40}, "Inacti",
              "Inacti 1 does nothing in TYPE5: nodes that penetrate at the start are pushed with their full force; 3 or 4 moves them out");
  }
  if (!old || version == 44) {
    r.next_card();
    i.ifric = integer_in(r, {1, 10}, "Ifric", 0, 3, "a friction law; write 0 (Coulomb), 1, 2 or 3");
    read_filter(r, i);
    if (!old) {
      i.sensor = read_sensor(r, {51, 60}, "sens_ID");
      read_ptlim(r, i);
    }
  }
  read_coefficients(r, i);
  if (i.sensor != no_index) {  // E.2: with a sensor the times of the card do not count
    i.t_start = 0.0;
    i.t_stop = infinity;
  }
  i.type = std::move(t);
  return i;
}

void refuse_option(BlockReader& r, deck::Columns c, std::string_view field, Id right, std::string_view what) {
  const Id value = r.integer(c, field);
  if (value != 0 && value != right && value != 1000) {
    r.error("model.unsupported", c, field, fmt::format("{} ({}) is not supported; write {}", what, value, right));
  }
}

int flag_or(BlockReader& r, deck::Columns c, std::string_view field, int high, std::string_view what_is_right) {
  const Id value = r.integer(c, field);
  if (value == 1000) return 0;  // "the default"
  if (value < 0 || value > high) {
    r.error("model.out_of_range", c, field, fmt::format("{} is not {}", value, what_is_right));
    return 0;
  }
  return static_cast<int>(value);
}

/// Nodes of a surface, sorted; none of no_index.
std::vector<Index> nodes_on(const Context& c, Index surface) {
  std::vector<Index> nodes;
  if (surface == no_index) return nodes;
  for (const Segment& s : c.model->surfaces[static_cast<std::size_t>(surface)].segments)
    nodes.insert(nodes.end(), s.nodes.begin(), s.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Cards 2 to 4 of TYPE7: what touches what, stiffness and gap.
void read_type7_head(BlockReader& r, Interface& i, InterfaceType7& t) {
  Context& c = r.context();
  r.next_card();
  const Id group = r.integer({1, 10}, "grnd_IDs");
  const Index nodes = r.resolve(c.tables.node_groups, group, "/GRNOD", {1, 10}, "grnd_IDs");
  t.surface = required_surface(r, {11, 20}, "surf_IDm");
  if (nodes != no_index) t.nodes = c.model->node_groups[static_cast<std::size_t>(nodes)].nodes;
  const std::vector<Index> main = nodes_on(c, t.surface);
  if (group == 0) t.nodes = main;  // self contact: the nodes of the surface itself
  t.istf = flag_or(r, {21, 30}, "Istf", 5, "a stiffness rule; write 0 (main side) to 5");
  t.igap = flag_or(r, {41, 50}, "Igap", 3, "a gap rule; write 0 (constant), 1, 2 or 3");
  i.idel = read_idel(r, {71, 80});
  if (old_layout(c)) return;
  refuse_option(r, {31, 40}, "Ithe", 0, "heat through the contact");
  refuse_option(r, {81, 90}, "Icurv", 0, "a curved gap");
  refuse_option(r, {91, 100}, "Iadm", 0, "a mesh that adapts");
  r.next_card();
  const double scale = non_negative(r, {1, 20}, "Fscale_gap", dim::none, "a gap scale");
  if (scale > 0.0) t.gap_scale = scale;
  const double largest = non_negative(r, {21, 40}, "Gap_max", dim::length, "a gap");
  if (largest > 0.0) t.gap_max = largest;
  t.pen_max = non_negative(r, {41, 60}, "Fpenmax", dim::none, "a penetration limit");
  refuse_option(r, {81, 90}, "Itied", 0, "a tied contact");
  if (c.model->version >= 2026) refuse_option(r, {91, 100}, "Ists", 0, "this stiffness option");
  r.next_card();
  t.st_min = non_negative(r, {1, 20}, "Stmin", dim::stiffness, "a stiffness");
  const double stiffest = non_negative(r, {21, 40}, "Stmax", dim::stiffness, "a stiffness");
  if (stiffest > 0.0) t.st_max = stiffest;
  const double mesh = non_negative(r, {41, 60}, "%mesh_size", dim::none, "a mesh share");
  if (mesh > 0.0) t.mesh_size = mesh;
  t.dt_min = non_negative(r, {61, 80}, "dtmin", dim::time, "a time step");
  const auto on_main = [&main](Index node) { return std::binary_search(main.begin(), main.end(), node); };
  const deck::Columns left_out{81, 90};
  if (std::any_of(t.nodes.begin(), t.nodes.end(), on_main)) {
    refuse_option(r, left_out, "Irem_gap", 1, "leaving out nodes closer than the gap in self contact");
  } else {
    (void)r.integer(left_out, "Irem_gap");  // nothing to leave out
  }
}

/// A stiffness with Istf 1 and a factor otherwise; a negative value swaps the two (E.3).
void read_type7_stiffness(BlockReader& r, Interface& i, InterfaceType7& t) {
  i.stfac = r.real({1, 20}, "Stfac");
  if (i.stfac == 0.0) {
    if (t.istf == 1) {
      r.error("model.missing_value", {1, 20}, "Stfac",
              "Istf 1 asks for the stiffness itself; write it here, or Istf 0 for the stiffness of the main side");
    }
    i.stfac = 1.0;
    return;
  }
  if (i.stfac < 0.0 && t.istf > 1) {
    r.error("model.out_of_range", {1, 20}, "Stfac",
            "a negative stiffness factor has a meaning with Istf 0 or 1 only; write a positive value");
  }
  const bool is_stiffness = (t.istf == 1) != (i.stfac < 0.0);
  i.stfac = std::abs(i.stfac);
  if (t.istf <= 1) t.istf = is_stiffness ? 1 : 0;
  if (t.istf == 1) i.stfac *= r.context().factor(dim::stiffness, r.unit_id());
}

Interface read_type7(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 2, true);
  Interface i = start(r);
  InterfaceType7 t;
  read_type7_head(r, i, t);
  r.next_card();
  read_type7_stiffness(r, i, t);
  i.friction = non_negative(r, {21, 40}, "Fric", dim::none, "a friction coefficient");
  i.gap = non_negative(r, {41, 60}, "Gapmin", dim::length, "a gap");
  t.gap_given = i.gap > 0.0;
  read_times(r, i);
  r.next_card();
  read_ibc(r, i);
  t.inacti = flag_or(r, {31, 40}, "Inacti", 6, "a treatment of initial penetrations; write 0 (none) to 6");
  const double damping = non_negative(r, {41, 60}, "VIS_S", dim::none, "a damping share");
  if (damping > 0.0) t.vis_s = damping;
  const double tangential = non_negative(r, {61, 80}, "VIS_F", dim::none, "a damping share");
  if (c.model->version != 41) {
    r.next_card();
    i.ifric = integer_in(r, {1, 10}, "Ifric", 0, 4, "a friction law; write 0 (Coulomb) to 4");
    read_filter(r, i);
    t.iform = flag_or(r, {41, 50}, "Iform", 2, "a friction form; write 1 (viscous) or 2 (stiffness)");
    if (t.iform == 0) t.iform = 1;
    if (!old_layout(c)) {
      i.sensor = read_sensor(r, {51, 60}, "sens_ID");
      if (r.integer({61, 70}, "fct_IDF") != 0) {
        r.error("model.unsupported", {61, 70}, "fct_IDF", "friction as a function of temperature is not supported; write 0");
      }
      if (r.integer({91, 100}, "fric_ID") != 0) {
        r.error("model.unsupported", {91, 100}, "fric_ID", "/FRICTION tables are not supported; write 0 and the coefficient in Fric");
      }
    }
    read_coefficients(r, i);
  }
  const bool rubs = i.friction > 0.0 || i.ifric > 0;
  t.vis_f = t.iform == 2 ? 0.0 : tangential > 0.0 ? tangential : rubs ? 1.0 : 0.0;
  i.type = std::move(t);
  return i;
}

void orient(Context& c) {
  SegmentOrientation orientation;
  for (Interface& i : c.model->interfaces) {
    if (auto* t3 = std::get_if<InterfaceType3>(&i.type)) {
      t3->surface_1 = orientation.apply(c, t3->surface_1, t3->irs, i.place);
      t3->surface_2 = orientation.apply(c, t3->surface_2, t3->irm, i.place);
    } else if (auto* t5 = std::get_if<InterfaceType5>(&i.type)) {
      t5->surface = orientation.apply(c, t5->surface, t5->irm, i.place);
    } else if (auto* t7 = std::get_if<InterfaceType7>(&i.type)) {
      t7->surface = orientation.apply(c, t7->surface, 2, i.place);  // TYPE7 works on both sides of a segment
    }
  }
}

}  // namespace

/// /INTTHICK/V5 takes the property's thickness for gaps where elements have their own.
void refuse_property_thickness(const Context& c) {
  const auto own = [](const std::vector<double>& thickness) {
    return std::any_of(thickness.begin(), thickness.end(), [](double t) { return t > 0.0; });
  };
  if (!own(c.model->shells.thickness) && !own(c.model->sh3ns.thickness)) return;
  const auto derived = [](const Interface& i) {
    const auto* t7 = std::get_if<InterfaceType7>(&i.type);
    return t7 != nullptr && (!t7->gap_given || t7->igap > 0);
  };
  if (std::none_of(c.model->interfaces.begin(), c.model->interfaces.end(), derived)) return;
  for (const deck::Block& b : c.deck->blocks) {
    if (!is_keyword(b, "INTTHICK")) continue;
    c.diagnostics->error(
        "model.unsupported", c.deck->place(b),
        "gaps of TYPE7 are made from the thickness of each element here, and shells of this deck have their own: take /INTTHICK out "
        "to run so, or give Gapmin with Igap 0");
  }
}

void read_interfaces(Context& c) {
  for (const deck::Block& block : c.deck->blocks) {
    if (is_keyword(block, "INTER", "TYPE3")) c.model->interfaces.push_back(read_type3(c, block));
    if (is_keyword(block, "INTER", "TYPE5")) c.model->interfaces.push_back(read_type5(c, block));
    if (is_keyword(block, "INTER", "TYPE7")) c.model->interfaces.push_back(read_type7(c, block));
  }
  order_by_id(c, c.model->interfaces, "INTER", false);
  fill_table(c.tables.interfaces, c.model->interfaces);
  orient(c);
  refuse_property_thickness(c);
}

}  // namespace abut::model
