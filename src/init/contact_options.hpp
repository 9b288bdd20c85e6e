// The cards of an interface -> options of the contact library.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "abut/contact/both_sides.hpp"
#include "abut/contact/options.hpp"
#include "abut/model.hpp"
#include "core/profile.hpp"
#include "model/model.hpp"

namespace abut::init {

/// What a run asks of its interfaces of TYPE3 and TYPE5 beyond their cards.
using InterfaceChoices = std::vector<InterfaceChoice>;
/// All that they say of one interface.
[[nodiscard]] InterfaceChoice choice_of(const InterfaceChoices& choices, Id interface_id);

/// Thickness behind a segment for gaps: virtual thickness of the part, else the element's, else the property's; 0 for solids.
[[nodiscard]] double gap_thickness(const model::Model& model, const model::ElementRef& e);
/// Largest such thickness of the shells around each node, #N; 0 without.
[[nodiscard]] std::vector<double> nodal_thickness(const model::Model& model);

/// What variable gaps of TYPE7 take for thickness: with Igap 2 and 3 times Fscale. #nodes, #F.
[[nodiscard]] std::vector<double> gap_thickness_of_nodes(const model::Model& model, const model::InterfaceType7& t7);
[[nodiscard]] std::vector<double> gap_thickness_of_facets(const model::Model& model, const model::InterfaceType7& t7);

/// Half of the largest thicknesses of both sides of an interface of TYPE3 or TYPE5.
[[nodiscard]] double largest_automatic_gap(const model::Model& model, const model::Interface& card);

/// TYPE3 and TYPE5.
[[nodiscard]] contact::Options one_sided_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                                                 const InterfaceChoices& choices);

/// TYPE7; gaps and sizes from the elements (numerics.md 7.7.1).
[[nodiscard]] contact::BothSidesOptions both_sides_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                                                           std::span<const Vec3> x);

}  // namespace abut::init
