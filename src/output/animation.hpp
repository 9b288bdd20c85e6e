// Animation: one VTK unstructured grid per state (NAME_anim/NAME_00000.vtu, ...) and the index NAME.pvd that ParaView opens.
#pragma once

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "cycle/sink.hpp"
#include "output/files.hpp"

namespace abut::output {

/// Writes a state whenever `animation_due`, then the index; each file appears under its name only when it is complete, so
/// whatever the index names can be read, also after the run was killed.
/// A state is copied in cycle() and compressed and written by a thread of its own while the run goes on; the next state, a checkpoint and
/// the end wait for it. A failure to write is thrown there.
///
/// Points are all nodes at their positions x(t) (double precision; the initial ones are points - displacement). Cells are
/// all elements in the order shells, 3-node shells, bricks, tetrahedra, each by id; degenerate bricks become wedges,
/// pyramids or tetrahedra. Deleted elements are left out from the state on in which they are gone (a "hidden" flag would
/// not do: ParaView's default surface still draws such cells, torn between their free nodes); `element_id` tells which
/// cell is which, and points never change. Fields (animation_fields.hpp) are single precision.
/// Field data: TimeValue, cycle.
class Animation final : public cycle::Sink {
 public:
  explicit Animation(RunFolder folder, Opening opening = Opening::fresh);
  ~Animation() override;

  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override;
  void end(const cycle::Outcome& outcome) override;
  void persist(state::Archive& a) override;

 private:
  void write_index(const std::vector<double>& times) const;
  void wait_for_writer();

  struct Taken;
  RunFolder folder_;
  Opening opening_;
  std::size_t on_disk_ = 0;          ///< states that a checkpoint has brought to the disk
  std::vector<double> times_;        ///< of the states so far
  std::shared_future<void> writer_;  ///< of the last state, with its failure for all who ask; last member: it uses the others
};

}  // namespace abut::output
