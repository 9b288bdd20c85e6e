// Options and results of an interface.
#include <algorithm>
#include <string>

#include "abut/contact/both_sides.hpp"
#include "abut/contact/options.hpp"
#include "arrays.hpp"
#include "contact/enforce/check_options.hpp"
#include "contact_names.hpp"
#include "parts.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using contact::FrictionFilter;
using contact::FrictionLaw;
using contact::Options;
using contact::Rules;
using contact::StepResult;

/// A property of an enumeration that reads and takes words.
template <class Owner, class Enum, std::size_t N, class Class>
void word_property(Class& owner, const char* name, Enum Owner::*member, const Names<Enum, N>& names, const char* doc) {
  owner.def_property(
      name, [member, &names](const Owner& o) { return name_of(o.*member, names); },
      [member, name, &names](Owner& o, const std::string& word) { o.*member = named(word, name, names); }, doc);
}

FrictionLaw friction_law(const std::string& model, const std::vector<double>& c) {
  FrictionLaw law{named(model, "model", friction_models), {}};
  if (c.size() > law.c.size()) throw py::value_error("c has " + std::to_string(c.size()) + " coefficients, expected at most 6");
  std::copy(c.begin(), c.end(), law.c.begin());
  return law;
}

void bind_friction(py::module_& m) {
  py::class_<FrictionLaw> law(m, "FrictionLaw",
                              "Coulomb coefficient as a function of pressure P and sliding speed v; C1..C6 = c, mu = Options.friction.\n\n"
                              "coulomb: mu; polynomial: mu + (C1 + C4 P) P + (C2 + C3 P) v + C5 v^2;\n"
                              "darmstadt: mu + C1 exp(C2 v) P^2 + C3 exp(C4 v) P + C5 exp(C6 v);\n"
                              "renard: C1 static, C2 dynamic, C3 largest, C4 smallest coefficient, C5 and C6 the speeds of C3 and C4;\n"
                              "exponential: C1 + (mu - C1) exp(-C2 v).");
  law.def(py::init(&friction_law), "model"_a = "coulomb", "c"_a = std::vector<double>{},
          "c: up to six coefficients, the others are 0. Raises ValueError for more, or for another model.");
  word_property(law, "model", &FrictionLaw::model, friction_models, "coulomb, polynomial, darmstadt, renard or exponential");
  law.def_readwrite("c", &FrictionLaw::c, "(6,) C1 to C6, in the host's units");

  py::class_<FrictionFilter>(m, "FrictionFilter", "F <- a F + (1 - a) F_old: a constant share, or a = min(1, 2 pi frequency h).")
      .def(py::init([](double share, double frequency) {
             const FrictionFilter filter{share, frequency};
             contact::check(filter);
             return filter;
           }),
           "share"_a = 1.0, "frequency"_a = 0.0, "Raises ValueError for a share outside of (0, 1] or a negative frequency.")
      .def_readwrite("share", &FrictionFilter::share, "a; 1: no filter")
      .def_readwrite("frequency", &FrictionFilter::frequency, "1/time; 0: `share` counts");
}

void bind_rules(py::module_& m) {
  py::class_<Rules> rules(m, "Rules", "Rules on which the standard and the reference profile differ (docs/guide/profiles.md).");
  rules.def(
      py::init([](const std::string& law, const std::string& edges, bool one_pass_half_stiffness, bool triangle_third_node_twice,
                  bool reference_friction, bool area_ratio_projection, bool switch_correction, bool unlimited_depth, bool limits_step) {
        return Rules{named(law, "law", laws),
                     named(edges, "edges", edge_rules),
                     one_pass_half_stiffness,
                     triangle_third_node_twice,
                     reference_friction,
                     area_ratio_projection,
                     switch_correction,
                     unlimited_depth,
                     limits_step};
      }),
      py::kw_only(), "law"_a = "stiffening", "edges"_a = "closest", "one_pass_half_stiffness"_a = false,
      "triangle_third_node_twice"_a = false, "reference_friction"_a = false, "area_ratio_projection"_a = false,
      "switch_correction"_a = true, "unlimited_depth"_a = false, "limits_step"_a = true,
      "Every rule is a property too, described there. Raises ValueError for a word that there is not.");
  word_property(rules, "law", &Rules::law, laws, "'stiffening': F = K gap/(gap - P) P; 'constant': F = K P");
  word_property(rules, "edges", &Rules::edges, edge_rules,
                "'closest': closest point on faces, edges and corners; 'plain': one normal per facet");
  rules.def_readwrite("one_pass_half_stiffness", &Rules::one_pass_half_stiffness, "one pass takes half of the facet's stiffness")
      .def_readwrite("triangle_third_node_twice", &Rules::triangle_third_node_twice,
                     "a triangle's third node counts twice in nodal stiffness")
      .def_readwrite("reference_friction", &Rules::reference_friction, "the reference program's friction anchors instead of return mapping")
      .def_readwrite("area_ratio_projection", &Rules::area_ratio_projection, "projection by area ratios instead of Newton's")
      .def_readwrite("switch_correction", &Rules::switch_correction, "first and last forces of a contact make no energy")
      .def_readwrite("unlimited_depth", &Rules::unlimited_depth, "no limit on how deep a node may lie behind a facet")
      .def_readwrite("limits_step", &Rules::limits_step, "the interface hands stiffness and a kinematic limit to the time step")
      .def_static("standard", &Rules::standard, "The default rules.")
      .def_static("reference", &Rules::reference, "The reference program's rules.");
}

Options one_sided(double stiffness_scale, double friction, const FrictionLaw& law, const FrictionFilter& filter, double tangential_ratio,
                  double gap, bool automatic_gap, double birth, double death, double start_duration, double shear_limit, double damping,
                  const std::string& initial, double depth_limit, const Rules& rules) {
  Options o;
  o.stiffness_scale = stiffness_scale;
  o.friction = friction;
  o.friction_law = law;
  o.filter = filter;
  o.tangential_ratio = tangential_ratio;
  o.gap = gap;
  o.automatic_gap = automatic_gap;
  o.birth = birth;
  o.death = death;
  o.start_duration = start_duration;
  o.shear_limit = shear_limit;
  o.damping = damping;
  o.initial = named(initial, "initial", initials);
  o.depth_limit = depth_limit;
  o.rules = rules;
  contact::check(o);
  return o;
}

void bind_one_sided(py::module_& m) {
  py::class_<Options> options(m, "Options", "Options of a one-sided interface: two surfaces (TYPE3) or nodes on a surface (TYPE5).");
  options.def(py::init(&one_sided), py::kw_only(), "stiffness_scale"_a = 0.2, "friction"_a = 0.0, "friction_law"_a = FrictionLaw{},
              "filter"_a = FrictionFilter{}, "tangential_ratio"_a = 0.1, "gap"_a = 0.0, "automatic_gap"_a = false, "birth"_a = 0.0,
              "death"_a = 1e30, "start_duration"_a = 0.0, "shear_limit"_a = 1e30, "damping"_a = 0.0, "initial"_a = "keep",
              "depth_limit"_a = 0.0, "rules"_a = Rules{},
              "Every option is a property too, described there. Raises ValueError for a value out of its range.");
  options.def_readwrite("stiffness_scale", &Options::stiffness_scale, "s of K = s K1 K2/(K1 + K2), > 0")
      .def_readwrite("friction", &Options::friction, "Coulomb coefficient, >= 0")
      .def_readwrite("friction_law", &Options::friction_law, "how the coefficient depends on pressure and speed")
      .def_readwrite("filter", &Options::filter, "of the trial friction force")
      .def_readwrite("tangential_ratio", &Options::tangential_ratio, "tangential over normal stiffness, > 0")
      .def_readwrite("gap", &Options::gap, "length at which a surface starts to repel, >= 0")
      .def_readwrite("automatic_gap", &Options::automatic_gap,
                     "gap of a pair from thickness (set_surface): half of the node's and half of the facet's, at least `gap`")
      .def_readwrite("birth", &Options::birth, "time from which the interface acts")
      .def_readwrite("death", &Options::death, "time after which it does not")
      .def_readwrite("start_duration", &Options::start_duration, "time over which what overlaps at birth is pushed apart; 0: at once")
      .def_readwrite("shear_limit", &Options::shear_limit, "largest friction stress, force/length^2")
      .def_readwrite("damping", &Options::damping, "normal viscosity, fraction of critical, 0 to 1")
      .def_readwrite("depth_limit", &Options::depth_limit,
                     "how far behind a facet a node is still held when first met, length; 0: from facet size")
      .def_readwrite("rules", &Options::rules, "rules on which the profiles differ");
  word_property(options, "initial", &Options::initial, initials, "what penetrates at the start: 'keep', 'offset', 'project' or 'ignore'");
}

/// A property of an array: read as a copy, taken as anything that is one; None: none.
template <class Class>
void list_property(Class& owner, const char* name, std::vector<double> BothSides::*member, const char* doc) {
  owner.def_property(
      name, [member](const BothSides& o) { return take(o.*member); },
      [member, name](BothSides& o, const std::optional<ArrayLike>& value) {
        const Reals values = reals(value, name);
        (o.*member).assign(values.span.begin(), values.span.end());
      },
      doc);
}

BothSides two_sided(double gap, const std::string& stiffness, double stiffness_min, double stiffness_max, double friction,
                    const FrictionLaw& law, const FrictionFilter& filter, const std::string& friction_form, double damping,
                    double friction_viscosity, const std::string& initial, double largest_penetration, double birth, double death,
                    const std::optional<ArrayLike>& node_gap, const std::optional<ArrayLike>& facet_gap, double gap_max,
                    const std::optional<ArrayLike>& node_size, const std::optional<ArrayLike>& facet_size, double step_minimum,
                    double step_scale, bool reference_step, bool switch_correction, bool all_pieces) {
  const auto list = [](const std::optional<ArrayLike>& value, const char* name) {
    const Reals values = reals(value, name);
    return std::vector<double>(values.span.begin(), values.span.end());
  };
  BothSides o;
  o.gap = gap;
  o.node_gap = list(node_gap, "node_gap");
  o.facet_gap = list(facet_gap, "facet_gap");
  o.gap_max = gap_max;
  o.node_size = list(node_size, "node_size");
  o.facet_size = list(facet_size, "facet_size");
  o.stiffness = named(stiffness, "stiffness", stiffness_rules);
  o.stiffness_min = stiffness_min;
  o.stiffness_max = stiffness_max;
  o.friction = friction;
  o.friction_law = law;
  o.filter = filter;
  o.friction_form = named(friction_form, "friction_form", friction_forms);
  o.damping = damping;
  o.friction_viscosity = friction_viscosity;
  o.initial = named(initial, "initial", both_sides_initials);
  o.largest_penetration = largest_penetration;
  o.birth = birth;
  o.death = death;
  o.step_minimum = step_minimum;
  o.step_scale = step_scale;
  o.reference_step = reference_step;
  o.switch_correction = switch_correction;
  o.all_pieces = all_pieces;
  contact::check(o);
  return o;
}

void bind_two_sided(py::module_& m) {
  const BothSides d;
  py::class_<BothSides> options(
      m, "BothSidesOptions",
      "Options of an interface that repels nodes on both sides of a surface (TYPE7).\n\n"
      "Gap of a pair: max(gap, min(node_gap + facet_gap, gap_max, node_size + facet_size)); `gap` alone without the\n"
      "arrays. S is the number of held nodes, F that of facets.");
  options.def(py::init(&two_sided), py::kw_only(), "gap"_a, "stiffness"_a = "facet", "stiffness_min"_a = d.stiffness_min,
              "stiffness_max"_a = d.stiffness_max, "friction"_a = d.friction, "friction_law"_a = FrictionLaw{},
              "filter"_a = FrictionFilter{}, "friction_form"_a = "viscous", "damping"_a = d.damping,
              "friction_viscosity"_a = d.friction_viscosity, "initial"_a = "keep", "largest_penetration"_a = d.largest_penetration,
              "birth"_a = d.birth, "death"_a = d.death, "node_gap"_a = py::none(), "facet_gap"_a = py::none(), "gap_max"_a = d.gap_max,
              "node_size"_a = py::none(), "facet_size"_a = py::none(), "step_minimum"_a = d.step_minimum, "step_scale"_a = d.step_scale,
              "reference_step"_a = d.reference_step, "switch_correction"_a = d.switch_correction, "all_pieces"_a = d.all_pieces,
              "Every option is a property too, described there. Raises ValueError for a value out of its range.");
  options.def_readwrite("gap", &BothSides::gap, "length at which a facet starts to repel, at least; > 0")
      .def_readwrite("gap_max", &BothSides::gap_max, "length: upper limit of node_gap + facet_gap (Igap 2, 3)")
      .def_readwrite("stiffness_min", &BothSides::stiffness_min, "force/length: a pair's stiffness is not below; not for 'facet'")
      .def_readwrite("stiffness_max", &BothSides::stiffness_max, "force/length: a pair's stiffness is not above; not for 'facet'")
      .def_readwrite("friction", &BothSides::friction, "Coulomb coefficient, >= 0")
      .def_readwrite("friction_law", &BothSides::friction_law, "how the coefficient depends on pressure and speed")
      .def_readwrite("filter", &BothSides::filter, "of the friction force (viscous) or of its increment (incremental)")
      .def_readwrite("damping", &BothSides::damping, "fraction of critical (VIS_s), >= 0")
      .def_readwrite("friction_viscosity", &BothSides::friction_viscosity, "of the viscous friction form (VIS_F), >= 0")
      .def_readwrite("largest_penetration", &BothSides::largest_penetration,
                     "share of the gap: nodes deeper than this at the start leave (Fpenmax); 0: off")
      .def_readwrite("birth", &BothSides::birth, "time from which the interface acts")
      .def_readwrite("death", &BothSides::death, "time after which it does not")
      .def_readwrite("step_minimum", &BothSides::step_minimum, "time: nodes whose contact step falls below leave for good; 0: off")
      .def_readwrite("step_scale", &BothSides::step_scale, "factor of that test")
      .def_readwrite("reference_step", &BothSides::reference_step,
                     "what dampers hand to the nodal stiffness: True c/h as the reference program, False 2 c/h and the friction spring too")
      .def_readwrite("switch_correction", &BothSides::switch_correction, "first and last forces of a pair make no energy")
      .def_readwrite("all_pieces", &BothSides::all_pieces,
                     "quadrilaterals: True the reference program's mean over their triangles within reach, False the nearest one");
  list_property(options, "node_gap", &BothSides::node_gap, "(S,) lengths (Igap 1 to 3), empty: none; a copy, assign to change");
  list_property(options, "facet_gap", &BothSides::facet_gap, "(F,) lengths, together with node_gap; a copy, assign to change");
  list_property(options, "node_size", &BothSides::node_size, "(S,) lengths (Igap 3), 1e30: no limit, empty: none; a copy");
  list_property(options, "facet_size", &BothSides::facet_size, "(F,) lengths, together with node_size; a copy");
  word_property(options, "stiffness", &BothSides::stiffness, stiffness_rules,
                "of a pair: 'facet', or of facet and node 'mean', 'larger', 'smaller' or in 'series' (Istf)");
  word_property(options, "friction_form", &BothSides::friction_form, friction_forms, "'viscous' or 'incremental'");
  word_property(options, "initial", &BothSides::initial, both_sides_initials,
                "what penetrates at the start: 'keep', 'offset', 'offset_with_margin', 'drop_nodes' or 'drop_facets' (Inacti)");
}

void bind_result(py::module_& m) {
  py::class_<StepResult>(m, "StepResult", "What an interface says after evaluate(). Energies are cumulative, in the host's unit of work.")
      .def_readonly("elastic", &StepResult::elastic, "CE: stored now in normal springs and elastic stick")
      .def_readonly("friction_work", &StepResult::friction_work, "FW: dissipated by slip, never decreases")
      .def_readonly("damping_work", &StepResult::damping_work, "DW: dissipated by damping")
      .def_readonly("start_work", &StepResult::start_work, "SW: work that a gradual start has put in")
      .def_readonly("made", &StepResult::made, "CX: energy made (> 0) or lost by the numerics")
      .def_property_readonly(
          "normal_force", [](const StepResult& r) { return copy(r.normal_force); }, "(3,) on the second surface")
      .def_property_readonly(
          "tangential_force", [](const StepResult& r) { return copy(r.tangential_force); }, "(3,) on the second surface")
      .def_readonly("in_contact", &StepResult::in_contact, "held nodes that touch, both passes")
      .def_readonly("largest_penetration", &StepResult::largest_penetration, "length, of held nodes of both passes")
      .def_readonly("crossed", &StepResult::crossed, "nodes that would have jumped through in this step, and were caught")
      .def_readonly("lost", &StepResult::lost, "nodes that were held and have gone over a free border in this step")
      .def_readonly("deepest_node", &StepResult::deepest_node, "the host's node that has the largest penetration; -1: none")
      .def_readonly("largest_approach", &StepResult::largest_approach, "normal approach in the last step, in units of gap")
      .def_readonly("kinematic_step", &StepResult::kinematic_step, "time: upper limit of the coming step; 1e30: none")
      .def_readonly("kinematic_node", &StepResult::kinematic_node, "the host's node that gives it; -1: none")
      .def("__repr__", [](const StepResult& r) {
        return "StepResult(in_contact=" + std::to_string(r.in_contact) + ", elastic=" + std::to_string(r.elastic) +
               ", friction_work=" + std::to_string(r.friction_work) + ")";
      });
}

}  // namespace

void bind_contact_options(py::module_& m) {
  bind_friction(m);
  bind_rules(m);
  bind_one_sided(m);
  bind_two_sided(m);
  bind_result(m);
}

}  // namespace abut::python
