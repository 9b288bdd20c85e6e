// The cards of an interface -> options of the contact library.
#pragma once

#include <optional>
#include <span>

#include "abut/contact/both_sides.hpp"
#include "abut/contact/options.hpp"
#include "core/profile.hpp"
#include "model/model.hpp"

namespace abut::init {

/// TYPE3 and TYPE5. @param law  overrides the profile's normal law when set
[[nodiscard]] contact::Options one_sided_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                                                 std::optional<contact::Law> law);

/// TYPE7; gaps and sizes from the elements (numerics.md 7.7.1).
[[nodiscard]] contact::BothSidesOptions both_sides_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                                                           std::span<const Vec3> x);

}  // namespace abut::init
