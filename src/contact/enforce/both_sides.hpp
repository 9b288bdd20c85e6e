// TYPE7 behind Interface: every pair of a held node and a facet within the gap acts on its own (numerics.md 7.7).
#pragma once

#include <vector>

#include "abut/contact/both_sides.hpp"
#include "abut/contact/mobility.hpp"
#include "contact/enforce/both_sides_pair.hpp"
#include "contact/enforce/interface_model.hpp"
#include "contact/search/candidates.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {

class BothSides final : public InterfaceModel {
 public:
  BothSides(std::vector<Index> nodes, Surface surface, BothSidesOptions options);

  [[nodiscard]] const Side& side(std::size_t k) const override { return k == 0 ? held_ : surface_; }
  void set_surface(int side, const SurfaceState& state) override;
  [[nodiscard]] std::vector<Projection> projections(std::span<const Vec3> x, bool move_surface) const override;
  void search(const HostState& host) override;
  StepResult evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness) override;
  void clear(std::span<Vec3> force, std::span<double> stiffness) const override;
  void commit() override { evaluated_ = false; }
  [[nodiscard]] bool begun() const override { return started_; }
  void add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const override;
  void add_nodal_area(std::span<const Vec3> x, std::span<double> area) const override;
  void add_nodal_contact(std::span<NodalContact> nodes) const override;
  [[nodiscard]] std::span<const Index> nodes_in_contact() const override { return in_contact_; }
  void save(HistoryWriter& out) const override;
  void load(HistoryReader& in) override;

 private:
  /// Pairs that will touch are looked for up to this share of the least gap beyond their own, which is more than any node moves in a step
  /// (`kinematic`); the search lists hold them.
  static constexpr double foresight = 1.0, kinematic = 0.9;

  /// What a pair did in the last cycle: p > 0 but for `apart`; its steps were once long for its stiffness; its last force was tried.
  enum class State : std::int64_t { apart, acts, light, settled };
  /// A pair with p > 0 and what it carries to the next cycle.
  struct Pair {
    Index node = no_index, facet = no_index;
    double offset = 0.0;        ///< p_0
    Vec3 friction{};            ///< F
    double damping = 0.0;       ///< damping force along the normal
    double spring = 0.0;        ///< tangential stiffness of the incremental form
    double rate = 0.0;          ///< normal speed, and
    double acceleration = 0.0;  ///< what the pair's own normal force gave it
    double force = 0.0;         ///< normal force, with the damper's
    double push = 0.0;          ///< force of the normal spring alone,
    double held = 0.0;          ///< energy that it held,
    double made = 0.0;          ///< and its account (account.hpp): what it has made since it began
    State acts = State::apart;  ///< in the last cycle
  };
  struct Opening {
    Vec3 velocity;              ///< of the node relative to the facet's point under it
    double rate = 0.0;          ///< its part along the normal, > 0 opening
    double inverse_mass = 0.0;  ///< 0 where the host gives no masses
  };
  struct Spring {
    double force, stored;
  };
  /// Half of the stiffness, gap and depth of a pair less its offset, with what the law says there.
  struct PairLaw {
    double k0, gap, p;
    BothSidesForce force;
  };
  /// Geometry of a pair with its full gap.
  struct Met {
    BothSidesContact contact;
    double gap = 0.0;
  };
  /// Sums over the pairs of one cycle.
  struct Sums {
    double elastic = 0.0, friction_work = 0.0, damping_work = 0.0, stepped = 0.0;
  };

  void bound_gaps();
  [[nodiscard]] bool variable_gap() const { return !options_.node_gap.empty(); }
  [[nodiscard]] Met meet(const Side& held, const Side& surface, Index node, Index facet, double gap) const;
  /// Facets that the node can meet: listed, active, not its own; ascending.
  [[nodiscard]] std::span<const Index> facets_of(const Candidates& candidates, Index node, std::vector<Index>& scratch) const;
  [[nodiscard]] double pair_stiffness(Index node, Index facet) const;
  [[nodiscard]] double mass_of(const HostState& host, std::size_t n) const { return host.mass.empty() ? 0.0 : host.mass[n]; }
  [[nodiscard]] Vec3 friction_of(const HostState& host, const Pair& old, Pair& pair, const Vec3& normal, const Vec3& v, double vn,
                                 double pressing, double critical, Sums& sums, bool& slips) const;
  /// Initial penetrations: who leaves, what is switched off (numerics.md 7.7.1).
  /// @param awake  false: the interface is born later, what is there now is kept for then
  void settle(bool awake);
  [[nodiscard]] double pair_gap(Index node, Index facet) const;
  [[nodiscard]] double reach(Index node) const;
  [[nodiscard]] bool acts(const HostState& host) const { return host.time >= options_.birth && host.time <= options_.death; }
  [[nodiscard]] Opening opening(const HostState& host, Index node, Index facet, const BothSidesContact& c) const;
  void gather_pressed();
  [[nodiscard]] Spring spring(const HostState& host, const Pair& old, Pair& pair, const PairLaw& law, const Opening& m,
                              StepResult& result) const;
  [[nodiscard]] double stepped(const HostState& host, const Pair& old, double rate) const;
  [[nodiscard]] double stop_depth(double k0, double gap, double p, const Opening& m) const;
  bool add_pair(const HostState& host, Index node, Index facet, const Pair& old, std::span<double> stiffness, StepResult& result,
                Sums& sums);
  [[nodiscard]] double offset_of(const Pair& old, double gap, double penetration) const;
  void foresee(const HostState& host, const Pair& pair, std::span<double> stiffness, StepResult& result) const;
  void end(const HostState& host, const Pair& old, Sums& sums) const;
  [[nodiscard]] double friction_spring(const HostState& host, Index node, Index facet) const;
  [[nodiscard]] double handed(const HostState& host, double elastic, const BothSidesForce& law, double spring, const Opening& m) const;
  [[nodiscard]] double looked_ahead() const;
  [[nodiscard]] double foreseen_way() const;
  [[nodiscard]] double fastest(const HostState& host) const;
  [[nodiscard]] double discrete_work(const HostState& host);

  BothSidesOptions options_;
  Side held_, surface_;
  Candidates candidates_;
  std::vector<Vec3> held_last_, surface_last_;                 // positions at the last search
  std::vector<Index> own_;                                     // host nodes of the interface, each once, by key order of the sides
  std::vector<Index> held_own_, surface_own_;                  // side-local -> own
  std::vector<Pair> pairs_, previous_;                         // by node, then facet
  std::vector<Vec3> normal_, tangential_, old_force_, old_x_;  // #own
  bool evaluated_ = false;                                     // and not committed: evaluate() moves the pairs
  bool acted_ = false;                                         // in the last evaluate(), since a history was loaded
  std::vector<std::uint8_t> gone_;                             // #held: left the interface for good
  std::vector<std::uint8_t> slips_;                            // #held: some friction of the node is at its limit (output only, no history)
  std::vector<Mobility> pressed_;                              // #own: sum of k n n^T over the pairs that act; a corner's k is H k
  std::vector<Index> in_contact_, scratch_;
  std::vector<std::uint8_t> off_;          // #F: without stiffness for good (drop_facets)
  double widest_ = 0.0, narrowest_ = 0.0;  // largest gap of a facet; smallest gap of any pair
  double longest_step_ = 0.0;              // so far
  double fastest_ = 0.0;                   // bound of the speed of any node relative to any facet in this cycle
  bool started_ = false, stale_ = true;
  double initial_elastic_ = 0.0;
  double damping_owed_ = 0.0;  // <= 0: what DW is too large by
  double friction_work_ = 0.0, damping_work_ = 0.0, contact_work_ = 0.0, stepped_work_ = 0.0;
  double start_work_ = 0.0;  // put in by whoever opened the time window over nodes in the gap
  bool waiting_ = false;     // the last step was before the window
};

}  // namespace abut::contact
