// Tributary areas of contact surfaces for output: a facet that serves in several interfaces counts once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "init/contact_setup.hpp"
#include "model/model.hpp"

namespace abut::cycle {

class ContactArea {
 public:
  ContactArea(const model::Model& model, std::span<const init::RunInterface> interfaces);

  /// Adds to each node a quarter (third) of each facet around it that is active in some interface.
  /// @param x     #N by 3
  /// @param area  #N
  void write(std::span<const Vec3> x, std::span<const init::RunInterface> interfaces, std::span<double> area) const;

 private:
  /// A facet of a side of an interface.
  struct Use {
    std::uint32_t interface = 0, side = 0;
    std::size_t facet = 0;
  };
  struct Facet {
    std::array<Index, 4> nodes{};
    std::size_t uses_end = 0;  ///< its uses end here, and begin where those of the facet before it end
  };
  std::vector<Facet> facets_;  ///< distinct, by their nodes
  std::vector<Use> uses_;
};

}  // namespace abut::cycle
