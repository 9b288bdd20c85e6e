// Looks at the contacts while a run goes on (docs/findings/index.md, "During the run"): T29, T32, T33.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cycle/sink.hpp"
#include "init/contact_inspection.hpp"
#include "output/run_info.hpp"

namespace abut::output {

/// Adds to RunInfo::during what it finds, each code once per interface (and surface). That normals turn away it sees in
/// InterfaceResult::facing, and looks at the geometry itself then.
class ContactWatch final : public cycle::Sink {
 public:
  explicit ContactWatch(std::shared_ptr<RunFindings> log) : log_(std::move(log)) {}
  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override;
  void end(const cycle::Outcome&) override {}
  void persist(state::Archive& a) override;

 private:
  struct Watched {
    std::array<double, 2> facing_at_start{};  ///< NaN: undecided
    double size = 0.0;                        ///< mean facet size of the finer side; 0 for TYPE7, whose normals do not matter
    bool turned = false, deep = false, made = false;
  };
  std::shared_ptr<RunFindings> log_;
  std::vector<Watched> interfaces_;
  double next_look_ = 0.0;
  std::int64_t next_look_cycle_ = 0;  ///< no look before this cycle: a look costs about as much as some cycles

  void look(const cycle::Snapshot& now);
  /// Energy of contact that exists at t = 0 which the first half step takes: m |h a/2|^2/2 of the nodes that it pushes.
  void weigh_first_step(const cycle::Snapshot& now);
  /// Whom it concerns.
  struct Where {
    std::vector<Id> nodes;
    std::vector<std::array<Id, 4>> segments;
  };
  void say(const cycle::Snapshot& now, std::size_t interface, std::string code, double measure, std::string text, Where where = {});
  /// Events of nodes: one finding, with all nodes so far.
  void collect(const cycle::Snapshot& now, std::size_t interface, std::string code, std::span<const Index> nodes,
               const std::function<std::string(std::size_t)>& text);
  [[nodiscard]] static std::string first_ids(const Where& where);
};

}  // namespace abut::output
