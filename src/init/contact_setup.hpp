// Model interfaces -> contact::Interface objects, and what keeps them in step with eroding elements.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "abut/contact/interface.hpp"
#include "core/diagnostic.hpp"
#include "core/profile.hpp"
#include "elements/group.hpp"
#include "init/contact_options.hpp"
#include "init/contact_stiffness.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::init {

/// One interface of the model with its facets' elements.
struct RunInterface {
  Index model_index = no_index;
  contact::Interface contact;
  /// Per side (0 first, 1 second) and facet: own stiffness, activity, and the elements that contain the facet (Idel).
  struct Side {
    std::vector<double> stiffness;  ///< what is not given again (empty) stays; of held nodes without a surface: of TYPE5, of TYPE7 once
                                    ///< shells have become thinner
    std::vector<double> thickness;  ///< of facets or held nodes; empty without a gap from thickness
    std::vector<model::ElementRef> shell;  ///< behind each facet; none of a solid
    std::vector<NodeShare> shares;         ///< of the held nodes of TYPE5 and TYPE7
    std::vector<std::uint8_t> active;
    std::vector<Index> nodes;  ///< surface nodes (contact::Surface::nodes()) or held nodes
    std::vector<std::uint8_t> node_active;
    std::vector<std::vector<model::ElementRef>> elements;
    std::vector<std::array<Index, 4>> corners;
  };
  std::vector<Side> sides;  ///< two for TYPE3, {unused, main} otherwise
};

/// @param state  initial state after rigid bodies moved their main nodes
/// @throws std::logic_error when settle_initial_penetrations() was left out for a model that asks for it
[[nodiscard]] std::vector<RunInterface> make_interfaces(const model::Model& model, const Profile& profile, const InterfaceChoices& choices,
                                                        state::State& state);

/// Moves nodes out of initial penetrations where an interface asks for it (Inacti 3: its nodes, 4: the nodes of the segments;
/// numerics.md 7.2.5, 7.7.1) and says so: one note per interface. For a model as read, before anything is computed from its nodes.
void settle_initial_penetrations(model::Model& model, Diagnostics& findings);

/// The same for interfaces of TYPE3 and TYPE5 whose choice is `project`: their held nodes are moved. Adds notes.
void project_initial_penetrations(model::Model& model, const InterfaceChoices& choices, Diagnostics& findings);

/// Hands a side's stiffness, thickness and activity to its interface.
void set_surface(RunInterface& interface, std::size_t side);

/// Switches off facets whose elements were deleted: Idel 1 when all of them are, Idel 2 when one is or a node of the facet is left
/// without elements; nodes without elements are let go unless Idel is negative (numerics.md 7.4.7).
/// @param alive  tells whether an element is still active
void update_erosion(const model::Model& model, std::span<RunInterface> interfaces,
                    const std::function<bool(const model::ElementRef&)>& alive);

}  // namespace abut::init
