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

using abut::GradualStart;

/// What a run asks of its interfaces beyond their cards.
struct InterfaceChoices {
  std::optional<contact::Law> law;   ///< overrides the profile's normal law
  std::vector<GradualStart> starts;  ///< of TYPE3 and TYPE5
};

/// TYPE3 and TYPE5.
[[nodiscard]] contact::Options one_sided_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                                                 const InterfaceChoices& choices);

/// TYPE7; gaps and sizes from the elements (numerics.md 7.7.1).
[[nodiscard]] contact::BothSidesOptions both_sides_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                                                           std::span<const Vec3> x);

}  // namespace abut::init
