// Tributary areas of contact surfaces for output: a facet that serves in several interfaces counts once.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "init/contact_setup.hpp"
#include "model/model.hpp"

namespace abut::cycle {

class ContactArea {
 public:
  ContactArea() = default;
  ContactArea(const model::Model& model, std::span<const init::RunInterface> interfaces);

  /// Per node a quarter (third) of each facet around it that is active in some interface; 0 elsewhere.
  /// @param x     #N by 3
  /// @param area  #N, overwritten
  void write(std::span<const Vec3> x, std::span<const init::RunInterface> interfaces, std::span<double> area) const;

 private:
  struct Use {
    std::size_t interface, side, facet;
  };
  struct Facet {
    std::array<Index, 4> nodes;
    std::vector<Use> uses;
  };
  std::vector<Facet> facets_;  ///< distinct, by their nodes
};

}  // namespace abut::cycle
