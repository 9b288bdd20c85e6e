// Columns of the time history: names (design: "Names on disk") and where their values come from (numerics.md 8).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cycle/sink.hpp"
#include "output/element_lookup.hpp"

namespace abut::output {

struct HistoryColumn {
  std::string name;  ///< "GLOBAL/IE", "NODE/31/DX"
  std::function<double(const cycle::Snapshot&)> value;
};

struct HistoryColumns {
  std::vector<HistoryColumn> columns;  ///< without the first, `time`
  /// Variables that the deck asks for and abut does not compute, each once: "PART HEAT".
  std::vector<std::string> left_out;
};

/// The balance, then each object of the /TH groups in the deck's order, then interfaces that no group names (their
/// forces are what a contact run is for). Beyond the variables asked for, every interface has its impulses IFNX..IFTZ and
/// CE, FW, DW, CX, NC, every wall, section and rigid body its impulses.
///
/// An object named by several groups has each variable once; the same node asked for in a second skew (id 7) appears as
/// NODE/31:7/DX. Components in a skew are those along its axes at t^n; X, Y, Z stay global.
///
/// The columns refer to `model`, which must outlive them.
[[nodiscard]] HistoryColumns make_history_columns(const model::Model& model, const ElementLookup& lookup);

}  // namespace abut::output
