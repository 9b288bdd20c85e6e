// Which way the segments of an interface look (deck-format.md E.1, numerics.md 7.2.2).
#pragma once

#include <map>
#include <tuple>

#include "model/reader.hpp"

namespace abut::model {

/// Cleans and turns the segments of interface surfaces. A surface that changes is copied: another user of it (a pressure, an
/// interface with another flag) keeps its own.
class SegmentOrientation {
 public:
  /// @param flag Irs or Irm: 0 segments on one solid look out of it, 1 all are reversed, 2 none is
  /// @return index of the surface to use
  Index apply(Context& c, Index surface, int flag, const Place& place);

 private:
  std::map<std::tuple<Index, int>, Index> done_;
};

}  // namespace abut::model
