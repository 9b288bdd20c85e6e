// TYPE7 behind Interface: every pair of a held node and a facet within the gap acts on its own (numerics.md 7.7).
#pragma once

#include <vector>

#include "abut/contact/both_sides.hpp"
#include "contact/enforce/both_sides_pair.hpp"
#include "contact/enforce/interface_model.hpp"
#include "contact/search/candidates.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {

class BothSides final : public InterfaceModel {
 public:
  BothSides(std::vector<Index> nodes, Surface surface, BothSidesOptions options);

  void set_surface(int side, const SurfaceState& state) override;
  void search(const HostState& host) override;
  StepResult evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness) override;
  void commit(double) override {}
  void add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const override;
  void add_nodal_area(std::span<const Vec3> x, std::span<double> area) const override;
  [[nodiscard]] std::span<const Index> nodes_in_contact() const override { return in_contact_; }
  [[nodiscard]] std::vector<std::byte> history() const override;
  void restore(std::span<const std::byte> history) override;

 private:
  /// A pair with p > 0 and what it carries to the next cycle.
  struct Pair {
    Index node = no_index, facet = no_index;
    double offset = 0.0;  ///< p_0
    Vec3 friction;        ///< F
  };
  /// Sums over the pairs of one cycle.
  struct Sums {
    double elastic = 0.0, friction_rate = 0.0, damping_rate = 0.0;
  };

  [[nodiscard]] double pair_gap(Index node, Index facet) const;
  [[nodiscard]] double reach(Index node) const;
  [[nodiscard]] bool acts(const HostState& host) const { return host.time >= options_.birth && host.time <= options_.death; }
  void add_pair(const HostState& host, Index node, Index facet, const Pair& old, std::span<double> stiffness, StepResult& result,
                Sums& sums);
  [[nodiscard]] double offset_of(const Pair& old, double gap, double penetration) const;
  void speed_limit(const HostState& host, StepResult& result) const;
  [[nodiscard]] double discrete_work(const HostState& host);

  BothSidesOptions options_;
  Side held_, surface_;
  Candidates candidates_;
  std::vector<Index> own_;                                     // host nodes of the interface, each once, by key order of the sides
  std::vector<Index> held_own_, surface_own_;                  // side-local -> own
  std::vector<Pair> pairs_, previous_;                         // by node, then facet
  std::vector<Vec3> normal_, tangential_, old_force_, old_x_;  // #own
  std::vector<std::uint8_t> gone_;                             // #held: left the interface for good
  std::vector<Index> in_contact_, scratch_;
  bool started_ = false;
  double friction_work_ = 0.0, damping_work_ = 0.0, contact_work_ = 0.0;
};

}  // namespace abut::contact
