// One pass: the nodes of one side held against the facets of the other.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/enforce/effective_mass.hpp"
#include "contact/enforce/facet_views.hpp"
#include "contact/enforce/held_kernel.hpp"
#include "contact/enforce/history.hpp"
#include "contact/enforce/law.hpp"
#include "contact/enforce/node_states.hpp"
#include "contact/enforce/pair.hpp"
#include "contact/enforce/side_loads.hpp"
#include "contact/search/candidates.hpp"
#include "contact/search/incremental.hpp"
#include "contact/search/nearest.hpp"

namespace abut::contact {

struct PassTotals {
  Vec3 normal, tangential;  ///< on the held nodes
  double potential = 0.0, stick = 0.0, dissipated = 0.0, damped = 0.0;
  double started = 0.0;  ///< work of a growing gap
  double stepped = 0.0;  ///< energy that leap-frog made by steps that changed under contact forces
  double largest_penetration = 0.0, largest_approach = 0.0;
  double kinematic_step = 1e30;
  Index kinematic_node = no_index, deepest_node = no_index;
  Index in_contact = 0;

  /// Adds those of the next nodes.
  PassTotals& operator+=(const PassTotals& b);
};

class Pass {
 public:
  Pass(const Options& options, bool one_pass, std::size_t held_nodes);

  void set_executor(Executor executor) { executor_ = std::move(executor); }

  /// Once, on the first geometry: depth limits, nearest nodes, anchors of contacts that exist at the start.
  void start(const Side& held, const Side& surface);
  /// @param motion  since the last search
  void search(const Side& held, const Side& surface, const Motion& motion);
  PassTotals evaluate(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, SideLoads& surface_loads);
  /// Outside the time window: contacts end.
  PassTotals rest(const HostState& host, const Side& held, const Side& surface);
  void commit();

  /// Merges opening, penetration and friction state of the held nodes into #N values of the host. After evaluate().
  void add_nodal_contact(const Side& held, const Side& surface, std::span<NodalContact> nodes) const;
  /// Host indices of held nodes with P > 0.
  [[nodiscard]] const std::vector<Index>& in_contact() const { return in_contact_; }
  /// Those that the swept test caught, those that went over a free border, in the last evaluate.
  [[nodiscard]] const std::vector<Index>& crossed() const { return crossed_; }
  [[nodiscard]] const std::vector<Index>& lost() const { return lost_; }
  [[nodiscard]] std::size_t saved_bytes() const;  ///< that save() writes, at most
  void save(HistoryWriter& out) const;
  void load(HistoryReader& in);
  /// Forces the next search to rebuild its lists (activity changed).
  void invalidate() { stale_ = true; }

 private:
  // One node in this cycle.
  struct Touch {
    Index facet = no_index;
    bool known = false;  ///< facet, point, normal, distance are valid
    bool contact = false;
    bool fresh_hit = false;
    bool widens = false;
    bool lost = false;  ///< was held, and is now beyond the end of a free border, or went through and over it in one step
    bool far = false;   ///< cannot touch now or in the coming step: not measured
    bool away = false;  ///< beyond reach: nothing is said of it
    std::array<double, 4> weight{};
    Vec3 point, normal;
    double distance = 0.0;
    double penetration = 0.0;
    double full_gap = 0.0;  ///< of the pair as seen from its point (outer_gap()), whatever initial penetration takes from it
    NormalLaw law;
    Measure measure;                ///< what `pair` is made from, where it is not made yet
    double gap = 0.0;               ///< the same: of that facet, less what initial penetration takes
    bool pair_open = false;         ///< a free node out of contact: `pair` is made if the coming step may need its stiffness
    PairForce pair;                 ///< where several facets are equally near: the mean of theirs
    std::size_t first_further = 0;  ///< further facets that the force acts on: GroupSums::further from here
    std::size_t further = 0;
    int equals = 1;  ///< facets at the same distance
  };
  // A further facet that the node acts on: as near as the first (the node's force is the mean over all, whatever their ids), or one
  // that stores more though it is less near.
  struct Further {
    Measure measure;
    double gap = 0.0;  ///< of the node with it, less what initial penetration takes from it
    NormalLaw law;
    PairForce own;       ///< as if it were the nearest, but for what widens its strips
    bool equal = false;  ///< as near as the first
    bool acts = false;
    std::array<Vec3, 4> on_facet{};  ///< its share
  };
  // What a node does to the corners of its facet; added in the order of the nodes when all are measured. Whoever makes one writes all of
  // it, where it is kept: zeros and copies of what was just written take longer than the rest.
  struct Reaction {
    struct Part {
      double x, y, z;
      Part& operator=(const Vec3& a) { return x = a.x, y = a.y, z = a.z, *this; }
      operator Vec3() const { return {x, y, z}; }  // NOLINT: a vector like any other
    };
    Index facet;
    double springs;
    std::array<double, 4> weight, stiffness;
    std::array<Part, 4> normal;
    Part tangential;

    /// @param spring  kappa phi'', of which k is made
    Reaction(Index f, double k, double spring, const std::array<double, 4>& w)
        : facet(f),
          springs(spring),
          weight(w),  // NOLINT
          stiffness{std::abs(w[0]) * k, std::abs(w[1]) * k, std::abs(w[2]) * k, std::abs(w[3]) * k} {}
  };
  // Results of `group` consecutive nodes, which one thread handles.
  struct GroupSums {
    PassTotals totals;
    std::vector<Reaction> reactions;
    std::vector<Index> in_contact, crossed, lost;
    bool outgrown = false;
    std::vector<Further> further;
  };
  struct Scene {
    const HostState& host;
    const Side& held;
    const Side& surface;
    SideLoads& held_loads;
    SideLoads& surface_loads;
  };
  // What a thread needs for a group.
  struct Work {
    std::array<Touch, NodeStates::group> touches;
    NodeStates::Scratch scratch;
    std::vector<Further> further;
    std::vector<Reaction> reactions;
    HeldBatch batch;
    FacetViews facets;
    Looks looks;  ///< at the node in hand
  };
  // A node that comes nearer by less than this share of its way to the gap in a step is not looked at. What is said of others, that a
  // step may bring into contact, must not depend on how old the lists are: it is said of nodes that come nearer than that.
  static constexpr double passed_over = 0.4;
  static constexpr double rounding = 1.0 + 1e-9;  // of the clock's sums: nobody is near() whom far() passed over
  static constexpr double flight_share = 0.1;     // of a facet: nodes that fly further in a step look ahead on their own
  static_assert(1.5 * step_growth * passed_over < 1.0 && 0.5 / passed_over > step_growth);
  // A node that nothing happened to: its two copies of the state agree, and it stays out of reach for a while.
  enum Quiet : std::uint8_t { awake, in_front, seen_in_front, nothing_listed, beyond_reach };
  // Of a block of nodes that are all quiet, when the first of them is due: of those in front (or without facets), of those beyond reach.
  struct Due {
    double in_front = 1e300, beyond = 1e300;
  };
  struct Kinematics {
    double rate = 0.0;  ///< of opening, n.(v - v_point)
    Vec3 tangential_velocity;
  };

  Options options_;
  double largest_gap_ = 0.0;  ///< of any pair
  bool two_passes_ = false;
  bool half_of_facet_ = false;
  bool stale_ = true;
  bool outgrown_ = false;  ///< a held node went deeper than its list was made for
  bool started_ = false;
  bool committed_ = false;  ///< the states before are of this step, not those after
  bool settled_ = false;    ///< initial penetrations are dealt with
  double keep_ = 1.0;       ///< share of every node's offset that the gradual start leaves in this step
  double skin_ = 0.0, smallest_depth_ = 0.0, largest_depth_ = 0.0, size_ = 0.0;
  Values depth_;          ///< per facet: how far behind a node is still met
  Values widening_;       ///< per facet: 1 / its length at the start
  double longest_ = 0.0;  ///< length of the largest facet at the start
  NodeStates states_;
  std::vector<contact::Due> covered_;  ///< of every held node: distance within which its list has every facet
  std::vector<Tracked> tracked_;
  std::vector<Index> in_contact_, crossed_, lost_;
  std::vector<GroupSums> groups_;
  // Of every held node, no history: the last measurement found it in front (unlike NodeState::in_front even where only the age of the
  // lists says whether it is measured); Quiet.
  std::vector<std::uint8_t> in_front_, quiet_;
  std::vector<std::uint8_t> slips_;  ///< of every held node in contact: its friction is at its limit (output only, no history)
  std::vector<double> seen_gap_;     ///< the same where gaps are automatic: its gap (Touch::full_gap)
  Executor executor_;
  Candidates candidates_;
  IncrementalSearch incremental_;
  double surface_step_ = 0.0;  ///< largest motion of a surface node in the last step, relative to the surface's mean
  Vec3 mean_step_;
  std::vector<Due> block_due_;

  [[nodiscard]] PairForce force_of(const Side& held, const Side& surface, const Measure& m, Index i, Depth p, bool widens) const;
  [[nodiscard]] PairForce force_of(const Side& held, const Side& surface, const Measure& m, Index i, double gap, bool widens) const {
    return force_of(held, surface, m, i, Depth{gap - m.distance, m.distance}, widens);
  }
  /// Largest stiffness that the node can have with any facet.
  [[nodiscard]] double strongest(const Side& held, const Side& surface, Index i) const;
  /// How much less near than the nearest a facet that stores more can be; `stiffness` that of the nearest, at penetration p.
  [[nodiscard]] double reach_of_stronger(double stiffness, double strongest, double p) const;
  /// How much of a node's offset the gradual start gives back to its gap in this step.
  [[nodiscard]] double growth(const NodeState& before) const;
  struct OuterGap {
    double gap = 0.0, of_facet = 0.0;
  };
  /// Gap of node i at its nearest point, by the facet whose outer face it is deepest in: a facet j that is less near by D counts for
  /// g_j - D delta/(delta - D) (docs/theory/contact.md, 3). Where thickness is uneven, this may not be the nearest facet.
  /// @param by  what the nearest one, m, was looked for with
  [[nodiscard]] OuterGap outer_gap(const Side& held, const Side& surface, Index i, const Measure& m, const HeldBy& by, double strip,
                                   bool was_held, Looks& looks) const;
  /// Calls use(measure, as near as m) for each facet on the node's side, other than m, that is less near by less than `beyond`.
  template <class Use>
  void each_beside(const Side& surface, Index i, const Vec3& x, const Measure& m, const HeldBy& by, double strip, bool was_held,
                   double beyond, Looks& looks, const Use& use) const;
  [[nodiscard]] bool uneven_gap(const Side& surface) const { return options_.automatic_gap && !surface.evenly_thick(); }
  /// Gap of a node at this distance, less what initial penetration takes from it.
  [[nodiscard]] double gap_of(double full_gap, double distance, double depth, NodeState& after) const;
  /// Gap of a pair: the interface's, or from the thickness of both sides.
  [[nodiscard]] double full_gap(const Side& held, const Side& surface, Index i, Index facet, const std::array<double, 4>& weight) const;
  [[nodiscard]] NormalLaw law_of(double full_gap) const { return {options_.rules.law == Law::stiffening ? full_gap : 0.0}; }
  [[nodiscard]] bool closest() const { return options_.rules.edges == Edges::closest; }
  /// @param near_by  far() was asked in this step, and said no
  /// @param work     looks that have begun with this node
  void measure_closest(const Scene& scene, Index i, bool near_by, Touch& touch, Work& work, GroupSums& sums);
  /// Adds the facets that are as near as the one in `touch`, and those that store more (pair.hpp).
  /// @param by  what the nearest one, m, was looked for with
  void look_further(const Side& held, const Side& surface, const Measure& m, Index i, const HeldBy& by, double strip, bool was_held,
                    Looks& looks, Touch& touch, GroupSums& sums);
  /// The pair of facet `nearest` and node i, with whichever of `all` stores the most for it.
  void add_strongest(const Side& held, const Side& surface, Index i, bool widens, Further& nearest, std::span<Further> all, double share,
                     PairForce& sum) const;
  void measure_plain(const Side& held, const Side& surface, Index i, Touch& touch);
  /// Stiffness of a node with a facet, neither interpolated nor tapered (T13; TYPE5: half of the facet's).
  [[nodiscard]] double plain_stiffness(const Side& held, const Side& surface, Index i, Index facet) const;
  /// Nearest of the facets that push in about the same direction as this one, from the tree.
  [[nodiscard]] Measure nearest_pushing_alike(const Side& held, const Side& surface, Index i, Index facet) const;
  /// Nearest active facet at any distance, from the tree: for nodes whose list is empty.
  [[nodiscard]] Measure nearest_of_all(const Side& held, const Side& surface, Index i) const;
  [[nodiscard]] Index swept_facet(const Side& held, const Side& surface, const SideLoads& held_loads, const SideLoads& surface_loads,
                                  Index i) const;
  /// Velocity of a held node relative to a material point of the surface.
  [[nodiscard]] static Vec3 velocity_over(const HostState& host, const Side& held, const Side& surface, Index i, const SurfacePoint& point);
  [[nodiscard]] Kinematics kinematics(const HostState& host, const Side& held, const Side& surface, Index i, const Touch& touch) const;
  /// 1/m of a node with its facet along a unit vector; 0: unknown
  /// @param springs  which act on the same motion; {}: this pair alone
  [[nodiscard]] double inverse_mass(const Scene& scene, Index i, const Touch& touch, const Vec3& along, const Springs& springs) const;
  /// A pair that may give no more than it has taken (account.hpp): it began, or came to a facet or deeper into a strip, where it holds
  /// more by the law than it was given on the way there.
  /// @param moved_in  along the normal in the last step
  /// @param made  account of the pair with this cycle's force
  [[nodiscard]] bool keeps_its_account(const Touch& touch, const NodeState& before, double moved_in, double made) const;
  /// What leap-frog made by a changed step under the last force of a node that has no facet any more (eroded, moved away, contact over).
  [[nodiscard]] double stepped_without_facet(const HostState& host, const Side& held, const Side& surface, Index i) const;
  /// Tells the host of the strips of free borders that the node, behind the gap and beyond their ends, may reach in the coming step,
  /// whatever holds it now.
  void foresee_strips(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, Index i, GroupSums& sums);
  struct StripAhead {
    double stiffness = 0.0;  ///< 0: its end is out of reach
    double clear = 0.0;      ///< by the clock, how long it stays so
  };
  /// @param end  the facet's closest point
  [[nodiscard]] StripAhead strip_ahead(const HostState& host, const Side& held, const Side& surface, Index i, Index facet,
                                       const ClosestPoint& end) const;
  void limit_depths();
  [[nodiscard]] const NodeState& now(Index i) const { return committed_ ? states_.before(i) : states_.after(i); }
  /// Signed distance of a held node to the other side less the pair's gap, whatever it touches; NaN when nothing is near.
  [[nodiscard]] double opening_of(const Side& held, const Side& surface, Index i) const;
  /// True while the node cannot touch, now or in the coming step.
  /// @param seen  it remembers that it was seen in front, and no initial penetration: it has nothing to remember from coming near
  [[nodiscard]] bool far(const Scene& scene, Index i, bool seen, FacetViews& facets);
  /// Measures the heights over planes at free borders (Candidates::border_due).
  void look_at_borders(const Side& surface, Index i, const Vec3& x, FacetViews& facets);
  /// Quiet, and still without anything to say.
  /// @param near_by  it is not, because far() said so
  [[nodiscard]] bool asleep(const Scene& scene, Index i, FacetViews& facets, bool& near_by);
  /// The same of all nodes of a block at once, or false.
  [[nodiscard]] bool block_asleep(const Scene& scene, std::size_t number) const;
  void settle_block(std::size_t number);
  /// Larger of the squares of a node's motions in the last and in the coming step, relative to the surface's mean.
  [[nodiscard]] double squared_motion(const HostState& host, const Side& held, const SideLoads& held_loads, Index i) const;
  /// Neither motion comes near the share of the way that may be passed over, when the nearest facet is due at `due`.
  [[nodiscard]] bool clears(double squared_motion, double due) const {
    const double clear = clearance(due);
    return clear > 0.0 && squared_motion < clear * clear;
  }
  /// Measured at this distance, whatever the age of the lists.
  [[nodiscard]] bool near(const HostState& host, const Side& held, const SideLoads& held_loads, Index i, double distance) const;
  /// Distance within which lists have every facet: where contact is, and where it may begin in the coming step.
  [[nodiscard]] double reach() const {
    return std::max({largest_gap_, largest_depth_, skin_ + stronger_within * longest_}) + flight_share * size_;
  }
  /// A held node whose facets are asked for within this distance may soon need more than its list has.
  [[nodiscard]] bool outgrows(Index i, double distance) const { return distance + flight_share * size_ > covered_[at(i)]; }
  /// A node that was beyond reach still is, and neither motion is one that the swept test or look_ahead() asks about.
  [[nodiscard]] bool stays_beyond(double squared_motion, double due) const {
    const double still = std::min(smallest_depth_ - surface_step_, (reach() - largest_gap_ - 2.0 * surface_step_) / (1.5 * step_growth));
    return still > 0.0 && squared_motion < still * still && due - candidates_.clock() > rounding * reach();
  }
  /// What the motion of a node in the last and in the coming step must stay below, when the nearest facet is due at `due`.
  [[nodiscard]] double clearance(double due) const {
    return passed_over * std::min(smallest_depth_, due - candidates_.clock() - largest_gap_) - surface_step_;
  }
  void evaluate_group(const Scene& scene, std::size_t number, Work& work, GroupSums& sums);
  void measure(const Scene& scene, Index i, bool near_by, Touch& touch, Work& work, GroupSums& sums);
  void end_contact(const Scene& scene, Index i, const Touch& touch, bool any, GroupSums& sums);
  /// True where every ordinary held node goes through held_kernel().
  [[nodiscard]] bool in_batches(const HostState& host) const;
  [[nodiscard]] HeldRules held_rules(const HostState& host) const;
  /// Held by a quadrilateral, with nothing in its history that held_kernel() leaves out.
  [[nodiscard]] bool may_be_ordinary(const Scene& scene, Index i) const;
  void put_in(const Scene& scene, Index i, HeldBatch& batch) const;
  void run_batch(const Scene& scene, HeldBatch& batch) const;
  void add_reactions(const GroupSums& sums, const Side& surface, SideLoads& surface_loads) const;
  /// No other facet can be as near as the one that holds the node, nor store more.
  [[nodiscard]] bool alone(const Scene& scene, const HeldBatch& batch, int lane, Index i, Looks& looks, GroupSums& sums);
  void finish_ordinary(const Scene& scene, const HeldBatch& batch, int lane, Index i, GroupSums& sums);
  void finish_node(const Scene& scene, Index i, Touch& touch, bool rub, GroupSums& sums);
  [[nodiscard]] Vec3 rub_by_return_mapping(const HostState& host, const Side& surface, const Touch& touch, const Kinematics& motion,
                                           double limit, double fraction, const NodeState& before, NodeState& after,
                                           PassTotals& totals) const;
  [[nodiscard]] Vec3 rub_by_anchor(const HostState& host, const Side& surface, const Touch& touch, double limit, const NodeState& before,
                                   NodeState& after, PassTotals& totals) const;
  void look_ahead(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, Index i) const;
};

}  // namespace abut::contact
