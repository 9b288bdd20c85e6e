// What quadrilateral and triangular shell groups share: blocks, set-up, reductions, output.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "elements/group.hpp"
#include "elements/shell_common/kernel_args.hpp"
#include "elements/shell_common/section.hpp"
#include "simd/aligned.hpp"

namespace abut::elements {

/// Node shares of one element at t = 0.
struct ShellShares {
  std::array<double, 4> mass{};  ///< per node slot; equal for the four of a quadrilateral
  double inertia_per_mass = 0.0;
  bool regular = true;  ///< false: nodes 3 and 4 of a quad coincide
};

/// A frame and area at given positions.
struct ShellFrame {
  std::array<Vec3, 3> axes;
  double area = 0.0;
};

/// Base of the shell groups. The model must outlive the group, and the positions of the last step must stay readable for
/// `output` (the frame is taken from them).
class ShellGroup : public Group {
 public:
  [[nodiscard]] Family family() const final { return section_ ? family_ : Family::inert; }
  [[nodiscard]] model::ElementKind kind() const final { return kind_; }
  [[nodiscard]] ElementNodes nodes(Index element) const final;
  void add_masses(std::span<double> mass, std::span<double> inertia) const final;
  GroupResult step(const StepInput& in, const StepOutput& out, parallel::ThreadPool& pool) final;
  [[nodiscard]] bool may_delete() const final;
  /// @param rigid one flag per element of the group (group-local index)
  void set_rigid(std::span<const std::uint8_t> rigid) final;
  [[nodiscard]] ElementOutput output(Index element) const final;
  [[nodiscard]] std::array<double, 6> layer_stress(Index element, ShellLayer layer) const final;
  [[nodiscard]] bool active(Index element) const final;
  [[nodiscard]] double thickness(Index element) const final;
  [[nodiscard]] PartSums part_sums(const Vec3* v, const Vec3* w, parallel::ThreadPool* pool) const final;
  [[nodiscard]] double element_mass(Index element) const final;
  [[nodiscard]] double element_energy(Index element) const final;
  [[nodiscard]] std::vector<std::span<double>> history() final;

 protected:
  ShellGroup(const GroupInput& in, Family family, model::ElementKind kind, int nodes_per_element);

  /// Fills blocks; called by the constructor of the family once `section_` is set and `section_->variables` is final.
  void set_up();

  virtual void run(const ShellKernelArgs& args, std::size_t begin, std::size_t end) const = 0;
  [[nodiscard]] virtual ShellShares shares(std::span<const Vec3> corners, double thickness, double density) const = 0;
  [[nodiscard]] virtual ShellFrame frame(std::span<const Vec3> corners) const = 0;

  /// One variable of one element.
  [[nodiscard]] double& variable(Index element, int which);
  [[nodiscard]] double variable(Index element, int which) const;

  GroupInput in_;                        ///< but for `elements`, which are elements_
  std::optional<ShellSection> section_;  ///< none: void, mass only
  int at_frozen_flag_ = -1;              ///< variable that asks for small strain (1/2) or has it (1)

 private:
  struct ChunkResult {
    double step = 1e30, internal = 0.0, hourglass = 0.0, removed_energy = 0.0;
    double on = -1.0;  ///< elements with activity; < 0: to be counted
    Index element = 0, removed = 0;
  };
  using FinishBlock = void (*)(const ShellKernelArgs& args, std::size_t block);

  [[nodiscard]] double constant(Index element, int which) const;
  [[nodiscard]] int mass_count() const { return per_element_ == 4 ? 1 : 3; }
  [[nodiscard]] double mass_of_corner(Index element, int k) const {
    return constant(element, shell_constant::mass + std::min(k, mass_count() - 1));
  }
  [[nodiscard]] double initial_thickness(Index element) const;
  [[nodiscard]] std::array<Vec3, 4> corners(Index element, const Vec3* x) const;
  void run_chunk(ShellKernelArgs args, const StepOutput& out, std::size_t chunk);
  [[nodiscard]] bool acts_on_small_steps() const;
  [[nodiscard]] double count_on(std::size_t chunk) const;
  void act_on_small_steps(const ShellKernelArgs& args, std::size_t block);
  [[nodiscard]] Index first_bad_element(std::size_t chunk) const;

  Family family_;
  model::ElementKind kind_;
  std::size_t per_element_;
  std::size_t constant_count_;  ///< of shell_constant
  simd::AlignedVector<double> state_;
  simd::AlignedVector<double> constants_;
  simd::AlignedVector<std::int32_t> nodes_;
  std::vector<ChunkResult> results_;
  FinishBlock finish_block_ = nullptr;
  mutable NodalShares shares_;

  void share_masses() const;
  const Vec3* last_x_ = nullptr;
};

}  // namespace abut::elements
