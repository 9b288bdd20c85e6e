// Effective mass of a pair: what a unit impulse between a node and the point of a facet does to their opening speed.
//
//   1/m = sum over free nodes w_i^2/m_i + sum over mobilities c (u_c n).T_c (u_c n) + a_c.R_c a_c,
//   u_c = sum w_i,  a_c = sum w_i (x_i - centre_c) x n       over the nodes of c,
// w = 1 for the node and -H_i for the corners. With a body's tensors this is 1/M + (r x n).J^-1 (r x n) at the facet's point, however its
// corners' weights are spread; two nodes of one body do not open at all; a node that is held along n counts as infinitely heavy.
#pragma once

#include <array>
#include <cstddef>

#include "abut/contact/interface.hpp"

namespace abut::contact {

class EffectiveMass {
 public:
  explicit EffectiveMass(const HostState& host) : host_(host) {}

  /// @param node  of the host   @param weight  +1 for the held node, -H_i for corners
  void add(Index node, double weight) {
    if (weight == 0.0 || host_.mass.empty()) return;
    const auto n = static_cast<std::size_t>(node);
    const Index entry = host_.constrained.empty() ? no_index : host_.constrained[n];
    if (entry == no_index) {
      free_ += weight * weight * (host_.mass[n] > 0.0 ? 1.0 / host_.mass[n] : 0.0);
      return;
    }
    const Mobility& mobility = host_.mobility[static_cast<std::size_t>(entry)];
    std::size_t g = 0;
    while (g < count_ && group_[g].entry != entry) ++g;
    if (g == count_) group_[count_++] = {entry, 0.0, {}};
    group_[g].sum += weight;
    group_[g].arm += weight * (host_.x[n] - mobility.centre);
  }

  /// 1/m along unit `n`; 0: unknown, or nothing that the pair touches can move along n.
  [[nodiscard]] double inverse(const Vec3& n) const {
    double sum = free_;
    for (std::size_t g = 0; g < count_; ++g) {
      const Mobility& mobility = host_.mobility[static_cast<std::size_t>(group_[g].entry)];
      const Vec3 arm = cross(group_[g].arm, n);
      sum += group_[g].sum * group_[g].sum * dot(n, mobility.translation * n) + dot(arm, mobility.rotation * arm);
    }
    return sum;
  }

 private:
  struct Group {
    Index entry = no_index;
    double sum = 0.0;
    Vec3 arm;
  };
  const HostState& host_;
  double free_ = 0.0;
  std::array<Group, 5> group_{};
  std::size_t count_ = 0;
};

/// Mass of a node that is free or cannot move at all (0); below zero: neither, its mobility must be asked.
[[nodiscard]] inline double plain_mass(const HostState& host, Index node) {
  const auto n = static_cast<std::size_t>(node);
  if (host.constrained.empty() || host.constrained[n] == no_index) return host.mass[n];
  return host.mobility[static_cast<std::size_t>(host.constrained[n])].immobile() ? 0.0 : -1.0;
}

}  // namespace abut::contact
