// The inspection of a model's interfaces: contact::inspect() in the deck's ids, and what only the model knows (kinematic conflicts, the
// same pair twice).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/inspect.hpp"
#include "abut/model.hpp"
#include "core/diagnostic.hpp"
#include "core/profile.hpp"
#include "init/contact_options.hpp"
#include "model/model.hpp"

namespace abut::init {

using abut::ContactFinding;

/// What the first cycle knows. Spans may be empty, the step 0, where it is not known.
struct InspectedState {
  std::span<const Vec3> x;       ///< #N; empty: the model's
  std::span<const Vec3> v;       ///< #N
  std::span<const double> mass;  ///< #N
  double element_step = 0.0;     ///< without interfaces
};

/// Of every interface of a model the share of each surface that faces the other one; NaN: not decided, or TYPE7.
using FacingShares = std::vector<std::array<double, 2>>;

/// All interfaces, in the order of the model.
/// @param facing  not null: what was found on the way, #interfaces
[[nodiscard]] std::vector<ContactFinding> inspect_contacts(const model::Model& model, const InspectedState& state,
                                                           const InterfaceChoices& choices = {}, FacingShares* facing = nullptr);

/// One line for people: what, the first 20 ids, what to do, the code.
[[nodiscard]] Diagnostic to_diagnostic(const ContactFinding& finding);

/// A surface that was turned.
struct TurnedSurface {
  Index interface = no_index;  ///< of the model
  int side = 0;                ///< 0 first, 1 second surface of the card
  Id surface_id = 0;
  std::size_t total = 0;                    ///< segments of the surface
  std::vector<std::array<Id, 4>> segments;  ///< those that were turned, as they were
  bool ambiguous = false;                   ///< part of it has no clear answer and was left alone
};

/// Turns segments so that the surfaces of TYPE3 and TYPE5 face each other (`--orient auto`). A surface that changes is copied.
[[nodiscard]] std::vector<TurnedSurface> orient_contacts(model::Model& model);
[[nodiscard]] Diagnostic to_diagnostic(const model::Model& model, const TurnedSurface& turned);

/// Surfaces of an interface as the inspection takes them. Owns what the spans refer to; x are positions, #N.
class InspectedInterface {
 public:
  InspectedInterface(const model::Model& model, const model::Interface& card, std::span<const Vec3> x,
                     const InterfaceChoices& choices = {});
  InspectedInterface(const InspectedInterface&) = delete;
  InspectedInterface& operator=(const InspectedInterface&) = delete;
  [[nodiscard]] contact::InspectionInput input(std::span<const Vec3> x) const;
  /// Index into model.surfaces; no_index: a set of nodes.
  [[nodiscard]] Index surface(int side) const { return surface_[static_cast<std::size_t>(side)]; }
  /// Mean size of the facets of the finer surface; 1e300 without facets.
  [[nodiscard]] double facet_size(std::span<const Vec3> x) const;

 private:
  std::array<Index, 2> surface_;
  std::array<std::vector<contact::Facet>, 2> facets_;
  std::array<std::vector<double>, 2> stiffness_;
  std::array<std::vector<std::int8_t>, 2> outward_;
  std::span<const Index> nodes_;
  std::optional<contact::BothSidesOptions> pairs_;  ///< TYPE7
  double stiffness_scale_ = 0.2, gap_ = 0.0;
};

/// Codes of the findings that inspect_contacts adds to contact::inspection_codes().
inline constexpr std::string_view model_codes[] = {"contact.bound_by_wall", "contact.bound_by_condition", "contact.bound_by_body",
                                                   "contact.same_pair"};

}  // namespace abut::init
