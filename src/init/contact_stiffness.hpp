// Own stiffness of contact segments and nodes, from the elements behind them (T16 to T18; numerics.md 7.7.1).
#pragma once

#include <span>
#include <vector>

#include "init/face_owners.hpp"
#include "model/model.hpp"

namespace abut::init {

[[nodiscard]] Index part_of(const model::Model& model, const model::ElementRef& e);
/// Of a shell or void property; 0 for others.
[[nodiscard]] double property_thickness(const model::Property& p);

/// Own stiffness of a segment: E t for a shell (property thickness), B A^2 / V for a brick or tetrahedron face (T16..T18);
/// 0 without an element behind it.
[[nodiscard]] double segment_stiffness(const model::Model& model, const model::Segment& segment, std::span<const Vec3> x);

/// K_s of a secondary node of TYPE7 (numerics.md 7.7.1): mean E t of the shells around it, plus B (2 V)^(1/3) with V its share of
/// the solids around it and B their bulk modulus weighted with volume.
[[nodiscard]] std::vector<double> secondary_stiffness(const model::Model& model, std::span<const Index> nodes, std::span<const Vec3> x);

/// An element's share of the stiffness of a node.
struct NodeShare {
  std::size_t node = 0;  ///< position in the list of nodes
  model::ElementRef element;
  double stiffness = 0.0;
};
/// The same of TYPE7's nodes: E t over their number of each shell around the node, and what its solids give (no element). Their sums are
/// secondary_stiffness(), but for rounding. Shell after shell.
[[nodiscard]] std::vector<NodeShare> secondary_shares(const model::Model& model, std::span<const Index> nodes, std::span<const Vec3> x);
/// Own stiffness of nodes that no surface describes (TYPE5): a quarter (triangles: a third) of E t of every shell around
/// the node and of B A^2/V of every free solid face; where a shell lies on a face, the shell's (T18). Node after node.
/// @param of_others  that of nodes on none of these (no element)
[[nodiscard]] std::vector<NodeShare> node_shares(const model::Model& model, const FaceOwners& owners, std::span<const Index> nodes,
                                                 std::span<const Vec3> x, double of_others);
/// Of the facets of a surface: what a node without a stiffness of its own (a mass, a node of a rigid body) has in TYPE5, for K = s K1/2.
[[nodiscard]] double mean_stiffness(std::span<const double> facets);
/// Sums of shares over their nodes, #nodes.
[[nodiscard]] std::vector<double> node_stiffness(std::span<const NodeShare> shares, std::size_t nodes);

}  // namespace abut::init
