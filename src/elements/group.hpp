// One group of elements: same family, same part (hence same law and property), in blocks of 8.
//
// A step of a group is gather (node arrays -> block), compute (kernel over Pack), scatter (block -> slots -> sums of its chunk). Slots
// are private to an element and sums to a chunk, so chunks run in parallel; `Assembly` adds the chunks of a node in their order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "core/profile.hpp"
#include "elements/chunks.hpp"
#include "model/model.hpp"
#include "parallel/thread_pool.hpp"
#include "simd/few_values.hpp"

namespace abut::elements {

enum class Family { shell_q4, shell_c0, brick8, tetra4, inert };

/// What a kernel reads (all #N by 3, work units).
struct StepInput {
  const Vec3* x = nullptr;  ///< positions at t^n
  const Vec3* v = nullptr;  ///< velocities at n - 1/2
  const Vec3* w = nullptr;  ///< angular velocities at n - 1/2 (shells)
  double time = 0.0;        ///< t^n
  double dt = 0.0;          ///< h_-, 0 in the first cycle
  bool part_sums = false;   ///< they are wanted
};

/// Where a step leaves its forces; either may be null.
struct StepOutput {
  double* sums = nullptr;   ///< of all groups, per chunk and node (ChunkTable)
  double* slots = nullptr;  ///< of all groups, per element (SlotLayout)
};

/// Sums over a part for the time history (Profile::PartSums, numerics.md 8.3); `v` at the entry of the cycle.
struct PartSums {
  double kinetic_energy = 0.0, rotational_energy = 0.0, mass = 0.0;
  Vec3 momentum;
  PartSums& operator+=(const PartSums& b) {
    kinetic_energy += b.kinetic_energy;
    rotational_energy += b.rotational_energy;
    mass += b.mass;
    momentum += b.momentum;
    return *this;
  }
};

/// What a group says after a step.
struct GroupResult {
  double step = 1e30;             ///< smallest scaled element step s_e * dt_e of the group's active elements
  Index step_element = no_index;  ///< element (group-local) that gives it
  double internal_energy = 0.0;   ///< of the group, without hourglass
  double hourglass_energy = 0.0;
  double removed_energy = 0.0;   ///< internal + hourglass energy that all elements deleted so far held; not in the two above
  Index removed = 0;             ///< elements deleted in this cycle
  Index bad_element = no_index;  ///< first element with a non-finite result or a negative volume, group-local
  PartSums part_sums;            ///< as part_sums() after the step; where they are wanted
};

/// Values of one element for output (numerics.md 8.5, 8.6). Unused members stay 0.
struct ElementOutput {
  double off = 1.0;  ///< activity: 1 active, 0 deleted
  double internal_energy = 0.0, membrane_energy = 0.0, bending_energy = 0.0, hourglass_energy = 0.0;
  double plastic_min = 0.0, plastic_max = 0.0;
  double density = 0.0, volume = 0.0, thickness = 0.0, pressure = 0.0, von_mises = 0.0, bulk_viscosity = 0.0;
  std::array<double, 6> stress{};      ///< mean Cauchy stress xx yy zz xy yz zx, global axes
  std::array<double, 8> resultants{};  ///< shells: F1 F2 F12 Q1 Q2 M1 M2 M12 (numerics.md 8.5), element frame
};

/// A place in the thickness of a shell.
struct ShellLayer {
  enum class Kind { bending, upper, lower, point } kind = Kind::upper;
  int point = 0;  ///< integration point from 1 (bottom), for Kind::point
};

/// Layout of a group's slots: entry of node k (of nodes_per_element), component c (of components), element e = 8 b + l:
///   offset + ((b * nodes_per_element + k) * components + c) * 8 + l.
/// Components: solids fx fy fz K; shells fx fy fz K mx my mz Kr. f, m: internal force and moment *of the element on
/// nothing*, i.e. the vector that is subtracted from the nodal force; K, Kr: nodal stiffness of numerics.md 2.2.
/// Sums of chunks have the same components.
struct SlotLayout {
  std::size_t offset = 0;
  int nodes_per_element = 0;
  int components = 0;
  Index blocks = 0;
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(blocks) * static_cast<std::size_t>(nodes_per_element * components * lanes);
  }
  [[nodiscard]] std::size_t at(Index element, int node, int component) const {
    const auto b = static_cast<std::size_t>(element / lanes);
    const auto l = static_cast<std::size_t>(element % lanes);
    return offset +
           ((b * static_cast<std::size_t>(nodes_per_element) + static_cast<std::size_t>(node)) * static_cast<std::size_t>(components) +
            static_cast<std::size_t>(component)) *
               lanes +
           l;
  }
};

/// Nodes of an element, by value: groups keep them as their kernels want them.
class ElementNodes {
 public:
  ElementNodes() = default;
  ElementNodes(std::span<const Index> nodes) : size_(nodes.size()) { std::copy(nodes.begin(), nodes.end(), node_.begin()); }  // NOLINT
  void push_back(Index node) { node_[size_++] = node; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Index* begin() const { return node_.data(); }
  [[nodiscard]] const Index* end() const { return node_.data() + size_; }
  [[nodiscard]] Index operator[](std::size_t k) const { return node_[k]; }
  operator std::span<const Index>() const& { return {node_.data(), size_}; }  // NOLINT: as good as the nodes
  operator std::span<const Index>() const&& = delete;                         // NOLINT: they end with the statement

 private:
  std::array<Index, 8> node_{};
  std::size_t size_ = 0;
};

class Group {
 public:
  virtual ~Group() = default;

  [[nodiscard]] virtual Family family() const = 0;
  [[nodiscard]] Index part() const { return part_; }
  /// Number of elements (without the padding of the last block).
  [[nodiscard]] Index size() const { return static_cast<Index>(elements_.size()); }
  /// Group-local element -> index in the model's table of that kind.
  [[nodiscard]] std::span<const Index> elements() const { return elements_; }
  /// Nodes of a group-local element (nodes_per_element of them; degenerate bricks repeat).
  [[nodiscard]] virtual ElementNodes nodes(Index element) const = 0;
  [[nodiscard]] virtual model::ElementKind kind() const = 0;

  [[nodiscard]] const SlotLayout& layout() const { return layout_; }
  void set_slot_offset(std::size_t offset) { layout_.offset = offset; }
  /// Empty for elements without forces.
  [[nodiscard]] const ChunkTable& chunks() const { return chunks_; }
  void set_sum_offset(std::size_t offset) { chunks_.set_offset(offset); }

  /// Adds the shares of mass and, where the family has rotations, of inertia to the nodes (numerics.md 1.4, 1.5), element by element.
  virtual void add_masses(std::span<double> mass, std::span<double> inertia) const = 0;

  /// One step: strains over `in.dt`, stresses to t^n, internal forces. Elements that are off or rigid put zeros.
  /// Deterministic for any number of threads.
  virtual GroupResult step(const StepInput& in, const StepOutput& out, parallel::ThreadPool& pool) = 0;
  /// A step may delete elements.
  [[nodiscard]] virtual bool may_delete() const { return false; }

  /// Elements wholly inside a rigid body: no force, no step; in the part sums as the profile says (numerics.md 6.2.1).
  virtual void set_rigid(std::span<const std::uint8_t> rigid) = 0;

  [[nodiscard]] virtual ElementOutput output(Index element) const = 0;
  /// Stress in a layer of a shell, global axes, components as ElementOutput::stress. `bending` is what bending adds at the
  /// upper face, 6 M. A shell with stresses at points has those of its outermost points as upper and lower ones, else F +- 6 M.
  /// Zero for a point that the shell does not have; solids have their mean stress in every layer.
  [[nodiscard]] virtual std::array<double, 6> layer_stress(Index element, ShellLayer layer) const;
  [[nodiscard]] virtual bool active(Index element) const = 0;
  /// Current thickness of a shell (contact updates use it); 0 for solids.
  [[nodiscard]] virtual double thickness(Index element) const = 0;
  /// @param v, w  #N; w null: nothing turns
  /// @param pool  null: by the calling thread; the same bits either way
  [[nodiscard]] virtual PartSums part_sums(const Vec3* v, const Vec3* w, parallel::ThreadPool* pool = nullptr) const = 0;
  [[nodiscard]] virtual double element_mass(Index element) const = 0;
  [[nodiscard]] virtual double element_energy(Index element) const = 0;  ///< internal + hourglass

  /// Every array that carries history from step to step, for the state hash and the checkpoint.
  [[nodiscard]] virtual std::vector<std::span<double>> history() = 0;

 protected:
  /// Mass and, for shells, rotational inertia that the part sums see at each of chunks().nodes(): kept from one call of part_sums() to
  /// the next, because there are fewer nodes than corners.
  struct NodalShares {
    bool valid = false;
    using Values = simd::FewValues<std::uint16_t>;
    Values mass, inertia;
    std::vector<PartSums> leaves;  ///< per chunk
    /// Those of a chunk. @param w  null: nothing turns
    void sum(const ChunkTable& chunks, std::size_t chunk, const Vec3* v, const Vec3* w);
    /// Those of all chunks, in order.
    [[nodiscard]] PartSums total() const;
    [[nodiscard]] PartSums sums(const ChunkTable& chunks, const Vec3* v, const Vec3* w, parallel::ThreadPool* pool);
  };

  Index part_ = no_index;
  std::vector<Index> elements_;
  SlotLayout layout_;
  ChunkTable chunks_;
};

inline std::array<double, 6> Group::layer_stress(Index element, ShellLayer) const { return output(element).stress; }

/// Viscosity counts as the stiffness 2 C/h, h the last step: r/h here, with r = min(1, s/0.9), so that h below the default scale of /DT
/// goes with s as it does without viscosity. (At 0.9 and above h counts as it is: exact at s = 1.)
[[nodiscard]] inline double viscous_rate(double system_scale) { return system_scale < 0.9 ? system_scale / 0.9 : 1.0; }

/// What a group is made of.
struct GroupInput {
  const model::Model* model = nullptr;
  Index part = no_index;
  std::vector<Index> elements;  ///< indices into the model's table of that kind, in the order that sums follow
  Profile profile;
  double step_scale = 0.9;    ///< s_e of the Engine deck for this family
  double system_scale = 0.9;  ///< s of the run's step (model::system_step_scale)
  double step_minimum = 0.0;  ///< Tmin with `step_action`
  model::StepControl::Action step_action = model::StepControl::Action::none;
  bool step_wanted = true;  ///< false: nobody reads GroupResult::step (1e30 then but in the first cycle); saves its roots
};

[[nodiscard]] std::unique_ptr<Group> make_shell_q4(const GroupInput& in);
[[nodiscard]] std::unique_ptr<Group> make_shell_c0(const GroupInput& in);
[[nodiscard]] std::unique_ptr<Group> make_brick8(const GroupInput& in);
[[nodiscard]] std::unique_ptr<Group> make_tetra4(const GroupInput& in);

}  // namespace abut::elements
