// Words of the contact library's choices.
#pragma once

#include "abut/contact/both_sides.hpp"
#include "abut/contact/inspect.hpp"
#include "abut/contact/options.hpp"
#include "names.hpp"

namespace abut::python {

inline constexpr Names<contact::Law, 2> laws{{{"stiffening", contact::Law::stiffening}, {"constant", contact::Law::constant}}};
inline constexpr Names<contact::Edges, 2> edge_rules{{{"closest", contact::Edges::closest}, {"plain", contact::Edges::plain}}};
inline constexpr Names<contact::Initial, 4> initials{{{"keep", contact::Initial::keep},
                                                      {"offset", contact::Initial::offset},
                                                      {"project", contact::Initial::project},
                                                      {"ignore", contact::Initial::ignore}}};
inline constexpr Names<contact::FrictionLaw::Model, 5> friction_models{{{"coulomb", contact::FrictionLaw::Model::coulomb},
                                                                        {"polynomial", contact::FrictionLaw::Model::polynomial},
                                                                        {"darmstadt", contact::FrictionLaw::Model::darmstadt},
                                                                        {"renard", contact::FrictionLaw::Model::renard},
                                                                        {"exponential", contact::FrictionLaw::Model::exponential}}};
inline constexpr Names<contact::Severity, 3> contact_severities{
    {{"note", contact::Severity::note}, {"warning", contact::Severity::warning}, {"error", contact::Severity::error}}};

using BothSides = contact::BothSidesOptions;
inline constexpr Names<BothSides::Stiffness, 5> stiffness_rules{{{"facet", BothSides::Stiffness::facet},
                                                                 {"mean", BothSides::Stiffness::mean},
                                                                 {"larger", BothSides::Stiffness::larger},
                                                                 {"smaller", BothSides::Stiffness::smaller},
                                                                 {"series", BothSides::Stiffness::series}}};
inline constexpr Names<BothSides::Friction, 2> friction_forms{
    {{"viscous", BothSides::Friction::viscous}, {"incremental", BothSides::Friction::incremental}}};
inline constexpr Names<BothSides::Initial, 5> both_sides_initials{{{"keep", BothSides::Initial::keep},
                                                                   {"offset", BothSides::Initial::offset},
                                                                   {"offset_with_margin", BothSides::Initial::offset_with_margin},
                                                                   {"drop_nodes", BothSides::Initial::drop_nodes},
                                                                   {"drop_facets", BothSides::Initial::drop_facets}}};

}  // namespace abut::python
