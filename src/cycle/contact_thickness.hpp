// Contact stiffness E t, and the thickness of automatic (TYPE3, TYPE5) and variable (TYPE7) gaps, of shells that become thinner or thicker
// (Ithick 1).
#pragma once

#include <span>
#include <vector>

#include "elements/group.hpp"
#include "init/contact_setup.hpp"
#include "state/state.hpp"

namespace abut::cycle {

/// Both follow t/t0: K = K0 t/t0 of a facet's shell, of a held node (TYPE5; TYPE7 with Istf 2 to 5) the sum of its shells' shares; gaps of
/// a held node the largest of its shells. Looked at every `cycles_between` cycles; an interface takes new values when a thickness has
/// changed by `noticed` of itself since it took the last. What an elastic contact stores changes with its stiffness: that is in CX.
class ContactThickness {
 public:
  static constexpr std::int64_t cycles_between = 100;
  static constexpr double noticed = 1e-3;

  ContactThickness() = default;
  ContactThickness(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups,
                   std::span<const init::RunInterface> interfaces);
  /// The thickness of some element is followed.
  [[nodiscard]] bool follows() const { return !followed_.empty(); }
  /// Before the search of a cycle.
  void update(std::int64_t cycle, std::span<const std::unique_ptr<elements::Group>> groups, std::span<init::RunInterface> interfaces);
  /// @param interfaces  when loading they get the values of the checkpoint
  void persist(state::Archive& a, std::span<init::RunInterface> interfaces);

 private:
  /// A facet, or a share of a held node, on a shell whose thickness changes.
  struct Part {
    std::size_t target = 0;  ///< facet, or held node
    std::size_t group = 0;
    Index element = no_index;  ///< of the group
    double initial = 0.0;      ///< t0
    double stiffness = 0.0;    ///< K0 of the part
    double thickness = 0.0;    ///< for gaps, at the start
    double ratio = 1.0;        ///< t/t0 that the interface has
  };
  /// One side of an interface with such parts.
  struct Followed {
    std::size_t interface = 0, side = 0;
    std::vector<Part> parts;
    std::vector<double> stiffness, thickness;  ///< of each target what does not change
  };
  std::vector<Followed> followed_;

  void apply(const Followed& followed, init::RunInterface& interface) const;
};

}  // namespace abut::cycle
