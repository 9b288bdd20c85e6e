// The validated, immutable model: what a deck means, every default made explicit, all references resolved to indices.
//
// Units are the work units of the deck: a consistent system that nobody below this stage needs to know.
// Nodes, elements, parts, ... are sorted by id, so that the order in which a deck lists them has no effect.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "abut/model.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "core/diagnostic.hpp"
#include "model/ids.hpp"

namespace abut::model {

inline constexpr double infinity = 1e30;  ///< "never", "no limit" of the deck format

using abut::Units;

// ---- materials (numerics.md 5) ------------------------------------------------------------------------------------

struct LawVoid {
  double young = 0.0, poisson = 0.0;
};  ///< LAW0
struct LawElastic {
  double young = 0.0, poisson = 0.0;
};  ///< LAW1
/// LAW2, Johnson-Cook; a, b, n already derived when the card gave yield and ultimate stress (Iflag 1).
struct LawJohnsonCook {
  double young = 0.0, poisson = 0.0;
  double a = 0.0, b = 0.0, n = 1.0;
  double eps_max = 1e20, sigma_max = 1e20;
  double c = 0.0, eps_rate_0 = 0.0;
  int icc = 1;
  int vp = 2;              ///< 1 plastic, 2 total, 3 deviatoric strain rate
  double cutoff = 0.0;     ///< F_cut, 0 = no filter
  double kinematic = 0.0;  ///< C_hard
  double m = 1.0, t_melt = 1e20, rho_cp = 0.0, t_ref = 300.0, t_max = 1e20;
  double p_min = -1e20;
};
using Law = std::variant<LawVoid, LawElastic, LawJohnsonCook>;

struct Material {
  Id id = 0;
  std::string title;
  double density = 0.0;            ///< rho_i: gives the masses
  double reference_density = 0.0;  ///< rho_0
  Law law;
};

// ---- properties (deck-format.md B.4 to B.6; defaults of /DEF_SHELL, /DEF_SOLID applied) ----------------------------

struct ShellProperty {
  int ishell = 1, ismstr = 2, ish3n = 2, idrill = 0;
  double p_thickfail = 0.999999;
  double hm = 0.01, hf = 0.01, hr = 0.01, dm = 0.0, dn = 0.0;
  int points = 0;  ///< N: 0 = global integration
  double thickness = 0.0, shear_factor = 5.0 / 6.0;
  bool thickness_changes = false;  ///< Ithick == 1
  int iplas = 2;
};
struct SolidProperty {
  int isolid = 1, ismstr = 4, iframe = 1, icpre = 0, itetra4 = 1000;
  int imas = 2;  ///< /DEF_SOLID: 2 homogeneous mass split, 1 by node angle
  double qa = 1.1, qb = 0.05, h = 0.1, dt_min = 0.0, dn = 0.1;
};
struct VoidProperty {
  double thickness = 0.0;
};

struct Property {
  Id id = 0;
  std::string title;
  std::variant<ShellProperty, SolidProperty, VoidProperty> data;
};

struct Part {
  Id id = 0;
  std::string title;
  Index property = no_index;
  Index material = no_index;
  double contact_thickness = 0.0;  ///< virtual thickness; 0 = use the property's
};

// ---- mesh ---------------------------------------------------------------------------------------------------------

/// #E elements of N nodes. `thickness` (shells only): 0 = use the property's; empty: of all.
template <std::size_t N>
struct Elements {
  Ids id;
  std::vector<Index> part;
  std::vector<std::array<Index, N>> nodes;
  std::vector<double> thickness;
  [[nodiscard]] Index size() const { return static_cast<Index>(id.size()); }
  [[nodiscard]] double own_thickness(std::size_t e) const { return thickness.empty() ? 0.0 : thickness[e]; }
};

using abut::ElementKind;

struct ElementRef {
  ElementKind kind = ElementKind::none;
  Index index = no_index;
};

// ---- sets ---------------------------------------------------------------------------------------------------------

struct NodeGroup {
  Id id = 0;
  std::string title;
  std::vector<Index> nodes;  ///< sorted, distinct
};

/// One face; a triangle repeats its third node. Positive side: right-hand rule over the nodes.
struct Segment {
  std::array<Index, 4> nodes{no_index, no_index, no_index, no_index};
  ElementRef element;  ///< the element behind it: a shell wins over a solid (T18); none = no stiffness
};
struct Surface {
  Id id = 0;
  std::string title;
  std::vector<Segment> segments;
};

struct Function {
  Id id = 0;
  std::vector<double> x, y;
};

/// Fixed axes, or axes that follow three nodes. `axes[k]` is the k-th unit axis (at t = 0 for moving skews).
struct Skew {
  Id id = 0;
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  std::array<Index, 3> nodes{no_index, no_index, no_index};  ///< moving when nodes[0] is set
  int direction = 0;                                         ///< 0 X, 1 Y, 2 Z (numerics.md 6.6.2)
};

struct Sensor {
  Id id = 0;
  double t_on = 0.0;
  double t_off = infinity;
};

// ---- conditions (deck-format.md D) --------------------------------------------------------------------------------
// skew == no_index: global axes.   function == no_index: constant 1.   sensor == no_index: none.

struct BoundaryCondition {
  Id id = 0;
  std::array<bool, 3> translation{}, rotation{};
  Index skew = no_index;
  std::vector<Index> nodes;
};

/// v = value, `rotational`: w = value, `about_axis` (/INIVEL/AXIS): v = value + spin x (x - origin) and w = spin. Global axes.
struct InitialVelocity {
  Id id = 0;
  bool rotational = false;
  Vec3 value;
  std::vector<Index> nodes;
  bool about_axis = false;
  Vec3 spin{}, origin{};
};

/// /IMPVEL, /IMPDISP, /IMPACC: value(t) = scale_y * f(t / scale_x)
struct ImposedMotion {
  enum class Kind { velocity, displacement, acceleration };
  Id id = 0;
  Kind kind = Kind::velocity;
  Index function = no_index;
  int direction = 0;  ///< 0..2 translation, 3..5 rotation
  Index skew = no_index, sensor = no_index;
  double scale_x = 1.0, scale_y = 1.0, t_start = 0.0, t_stop = infinity;
  std::vector<Index> nodes;
};

struct ConcentratedLoad {
  Id id = 0;
  Index function = no_index;
  int direction = 0;  ///< 0..2 force, 3..5 moment
  Index skew = no_index, sensor = no_index;
  double scale_x = 1.0, scale_y = 1.0;
  std::vector<Index> nodes;
};

struct PressureLoad {
  Id id = 0;
  Index function = no_index, sensor = no_index;
  double scale_x = 1.0, scale_y = 1.0;
  std::vector<std::array<Index, 4>> segments;
};

struct Gravity {
  Id id = 0;
  Index function = no_index;
  int direction = 2;
  Index skew = no_index, sensor = no_index;
  double scale_x = 1.0, scale_y = 1.0;
  std::vector<Index> nodes;  ///< resolved: all nodes when the card names no group
};

/// Mass added to a node (all /ADMAS forms resolved to nodes).
struct AddedMass {
  Index node = no_index;
  double mass = 0.0;
};

struct RigidBody {
  Id id = 0;
  Index main = no_index;
  Index sensor = no_index, skew = no_index;
  int ispher = 2, icog = 1;
  bool keep_in_walls = false;  ///< Ikrem == 1
  double mass = 0.0;
  Vec3 j_diagonal, j_off;    ///< Jxx Jyy Jzz; Jxy Jyz Jxz
  std::vector<Index> nodes;  ///< secondary nodes, main excluded
  bool active = true;        ///< /RBODY/OFF of the Engine switches it off
};

struct RigidWall {
  Id id = 0;
  std::string title;
  Index node = no_index;  ///< moving wall: attached to this node
  int slide = 0;          ///< 0 frictionless, 1 tied, 2 friction
  double friction = 0.0, filter = 0.0;
  int filter_kind = 0;  ///< ifq
  double mass = 0.0;
  Vec3 velocity;             ///< initial velocity of the moving wall
  Vec3 point, normal;        ///< plane through `point`, unit normal into the admissible side
  std::vector<Index> nodes;  ///< resolved: Dsearch plus group 1 minus group 2
};

// ---- interfaces (deck-format.md E) --------------------------------------------------------------------------------

struct InterfaceType3 {
  Index surface_1 = no_index, surface_2 = no_index;
  int irs = 0, irm = 0;
};
struct InterfaceType5 {
  std::vector<Index> nodes;
  Index surface = no_index;
  int irm = 0, inacti = 0;
};
struct InterfaceType7 {
  std::vector<Index> nodes;
  Index surface = no_index;
  int istf = 0, igap = 0, inacti = 0, iform = 1;
  double gap_scale = 1.0, gap_max = infinity, mesh_size = 0.4;
  double st_min = 0.0, st_max = infinity, dt_min = 0.0, pen_max = 0.0;
  double vis_s = 0.05, vis_f = 1.0;
  bool gap_given = false;  ///< Gapmin was typed; else the automatic default applies
};
struct Interface {
  Id id = 0;
  std::string title;
  std::variant<InterfaceType3, InterfaceType5, InterfaceType7> type;
  int idel = 0;
  double stfac = 0.2, friction = 0.0, gap = 0.0;
  double t_start = 0.0, t_stop = infinity;
  std::array<bool, 3> ibc{};
  double ptlim = infinity;
  int ifric = 0, ifiltr = 0;
  double xfreq = 0.0;
  std::array<double, 6> c{};
  Index sensor = no_index;
  Place place;  ///< where the deck defines it: findings of the inspection name it
};

/// Surfaces on the two sides of an interface; no_index: a set of nodes.
[[nodiscard]] inline std::array<Index, 2> surfaces_of(const Interface& card) {
  if (const auto* t3 = std::get_if<InterfaceType3>(&card.type)) return {t3->surface_1, t3->surface_2};
  if (const auto* t5 = std::get_if<InterfaceType5>(&card.type)) return {no_index, t5->surface};
  return {no_index, std::get<InterfaceType7>(card.type).surface};
}

struct Section {
  Id id = 0;
  std::array<Index, 3> frame_nodes{no_index, no_index, no_index};
  int iframe = 0;
  std::vector<Index> nodes;
  std::vector<Index> shells, sh3ns, bricks;
  std::vector<Index> interfaces;
};

/// /ACCEL: the acceleration of a node along the axes of a skew, low-pass filtered.
struct Accelerometer {
  Id id = 0;
  Index node = no_index;
  Index skew = no_index;
  double cut_off = 0.0;  ///< frequency, 1/time; 0: not filtered
};

// ---- outputs ------------------------------------------------------------------------------------------------------

enum class ThKind { node, part, shell, sh3n, brick, inter, rwall, rbody, section, accelerometer };

/// One object of a /TH group with its variables expanded (DEF, STRESS, ... replaced by names).
struct ThRequest {
  ThKind kind = ThKind::node;
  Id id = 0;
  Index index = no_index;  ///< into the table of that kind
  Index skew = no_index;
  std::string name;
  std::vector<std::string> variables;
};

// ---- Engine deck (deck-format.md G) -------------------------------------------------------------------------------

struct StepControl {
  double scale = 0.9, minimum = 0.0;
  enum class Action { none, stop, remove, constant } action = Action::none;
  bool own = false;  ///< from a card of the type, not from the general /DT
};

struct Controls {
  std::string run_name;
  int run_number = 1;
  double t_end = 0.0;
  double history_interval = infinity;
  double animation_start = infinity, animation_interval = infinity;
  std::vector<std::string> animation_fields;  ///< "VECT/DISP", "ELEM/VONM", "SHELL/TENS/STRESS/MEMB", ... upper case
  int print_every = 100;
  StepControl shell, sh3n, brick, tetra;
  bool nodal_step = false;  ///< /DT/NODA in any form
  double nodal_scale = 0.9, nodal_minimum = 0.0;
  bool mass_scaling = false;                             ///< /DT/NODA/CST
  std::optional<std::vector<Index>> mass_scaling_nodes;  ///< sorted, distinct; none: all
  double contact_scale = 0.9, contact_minimum = 0.0;
  bool contact_scale_given = false;
  StepControl::Action contact_action = StepControl::Action::none;
  double dt_initial = 0.0, dt_max = infinity;                                    ///< /DTIX
  double stop_energy_error = 0.0, stop_total_mass = 0.0, stop_nodal_mass = 0.0;  ///< /STOP; 0 = not checked
  bool stop_positive_only = false;                                               ///< /STOP, NERR_POSIT: energy that is lost does not stop
  int restart_every = 0;                                                         ///< /RFILE cycles, 0 = none
  std::vector<Id> rbody_on, rbody_off;
};

/// Keyword of the deck that abut reads past because it cannot change physics; listed in the summary.
struct SkippedKeyword {
  std::string keyword;
  int count = 0;
};

struct Model {
  std::string name, title;
  int version = 0;  ///< Invers
  Units units;
  bool shell_frame_v4 = false;  ///< /SHFRA/V4

  Ids node_id;
  std::vector<Vec3> node_x;

  std::vector<Material> materials;
  std::vector<Property> properties;
  std::vector<Part> parts;
  Elements<4> shells;
  Elements<3> sh3ns;
  Elements<8> bricks;
  Elements<4> tetras;

  std::vector<NodeGroup> node_groups;
  std::vector<Surface> surfaces;
  std::vector<Function> functions;
  std::vector<Skew> skews;
  std::vector<Sensor> sensors;

  std::vector<BoundaryCondition> boundary_conditions;
  std::vector<InitialVelocity> initial_velocities;  ///< in the order of the deck: the last one that names a node wins
  std::vector<ImposedMotion> imposed_motions;
  std::vector<ConcentratedLoad> concentrated_loads;
  std::vector<PressureLoad> pressure_loads;
  std::vector<Gravity> gravities;
  std::vector<AddedMass> added_masses;
  std::vector<RigidBody> rigid_bodies;
  std::vector<RigidWall> rigid_walls;
  std::vector<Interface> interfaces;
  std::vector<Section> sections;
  std::vector<Accelerometer> accelerometers;
  std::vector<ThRequest> th_requests;
  Controls controls;
  std::vector<SkippedKeyword> skipped;

  [[nodiscard]] Index node_count() const { return static_cast<Index>(node_id.size()); }
};

}  // namespace abut::model
