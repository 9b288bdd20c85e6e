// How an interface was made, as its host gave it: enough to make it again, in a log or beside the original.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/interface.hpp"
#include "contact/record/bytes.hpp"

namespace abut::contact {

/// What set_surface() was given last, in the host's order.
struct SurfaceValues {
  std::vector<double> stiffness, thickness;
  std::vector<std::uint8_t> active, node_active;

  [[nodiscard]] SurfaceState spans() const { return {stiffness, thickness, active, node_active}; }
};

/// What of it was given, and what a side does not know of it.
struct SurfaceFlags {
  bool stiffness = false, thickness = false;
  std::vector<std::uint8_t> active, node_active;

  /// Spans that are not empty replace what is there.
  void take(const SurfaceState& state);
};

struct Recipe {
  enum class Kind : std::uint32_t { two_surfaces, nodes_to_surface, both_sides };
  /// A surface by its facets and the order of its nodes, which is all that its keys say.
  struct Topology {
    std::vector<Facet> facets;
    std::vector<Index> order;  ///< nodes by key

    Topology() = default;
    explicit Topology(const Surface& surface);
    [[nodiscard]] Surface surface() const;
  };

  Kind kind = Kind::two_surfaces;
  std::array<Topology, 2> side;  ///< [0] is empty where nodes are held
  std::vector<Index> nodes;
  std::vector<double> node_stiffness;
  Options options;            ///< two_surfaces, nodes_to_surface
  BothSidesOptions both;      ///< both_sides
  std::vector<Index> hosted;  ///< host nodes of the interface, ascending, each once

  /// Fills `hosted`. Call when the rest is there.
  void collect();
  /// The same with node hosted[i] called i: what is left of the host's numbering is its order.
  [[nodiscard]] Recipe compact() const;
  /// Same for interfaces that understand each other's history: same topology up to compact(), same rules of what is remembered.
  [[nodiscard]] std::uint64_t fingerprint() const;
  [[nodiscard]] Interface make() const;

  void write(ByteWriter& out) const;
  /// @throws std::invalid_argument on node numbers or choices that do not exist
  static Recipe read(ByteReader& in);
};

}  // namespace abut::contact
