// Share of each contact surface that faces the other one, while the run goes on (docs/findings/index.md, "The facing rule"; T33).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "abut/results.hpp"
#include "init/contact_inspection.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::cycle {

/// Looks at the surfaces of TYPE3 and TYPE5 again when a node of them has moved by a quarter of a facet since, or nothing is decided yet,
/// at least `cycles_between` cycles and 1/`looks` of the run later, and when an interface begins (Tstart): a look costs about as much as
/// five cycles. What it says depends on positions, times and cycle numbers only.
class ContactFacing {
 public:
  static constexpr std::int64_t cycles_between = 200;
  static constexpr double looks = 100.0;

  ContactFacing() = default;
  /// @param at_start  what the first look would say where the model has its nodes and nothing touches; empty: not known
  ContactFacing(const model::Model& model, const init::FacingShares& at_start);
  /// Brings InterfaceResult::facing of all interfaces up to date where a look is due. While nodes touch, surfaces that have passed each
  /// other by less than half a facet count as undecided there, not as turned.
  void look(const state::State& state, std::span<InterfaceResult> results);
  void persist(state::Archive& a);

 private:
  struct Watched {
    contact::FacingWatch watch;
    double limit = 0.0;        ///< motion that asks for another look; 0: TYPE7, whose normals do not matter
    std::vector<Index> nodes;  ///< of both surfaces, without repetition
    bool looked = false;
    std::vector<std::array<float, 3>> seen;  ///< how far they were at the last look from where the model has them; empty: nowhere else
    std::int64_t cycle = 0;                  ///< in which it was last asked whether a look is due
    double time = 0.0;                       ///< the same
  };
  double time_between_ = 0.0;
  const model::Model* model_ = nullptr;
  std::vector<Watched> interfaces_;
  init::FacingShares at_start_;
};

}  // namespace abut::cycle
