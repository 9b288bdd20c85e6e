// What brick and tetra groups share: blocks of state, the chunked step, output and sums. The families add geometry and kernel.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "elements/group.hpp"
#include "elements/solid/solid_kernels.hpp"
#include "elements/solid/solid_layout.hpp"
#include "simd/aligned.hpp"

namespace abut::elements {

/// Initial geometry of one element, by its family.
struct SolidGeometry {
  double volume = 0.0;             ///< positive for a valid element
  std::vector<double> frozen;      ///< geometry of cycle 0 for small strain, in the element frame if co-rotational
  std::vector<double> mass_share;  ///< m_I/m_e per node
};

class SolidGroup : public Group {
 public:
  [[nodiscard]] ElementNodes nodes(Index element) const override;
  void add_masses(std::span<double> mass, std::span<double> inertia) const override;
  GroupResult step(const StepInput& in, const StepOutput& out, parallel::ThreadPool& pool) override;
  [[nodiscard]] bool may_delete() const override { return config_.remove_small_step; }
  /// @param rigid one flag per group-local element
  void set_rigid(std::span<const std::uint8_t> rigid) override;
  [[nodiscard]] ElementOutput output(Index element) const override;
  [[nodiscard]] bool active(Index element) const override;
  [[nodiscard]] double thickness(Index /*element*/) const override { return 0.0; }
  [[nodiscard]] PartSums part_sums(const Vec3* v, const Vec3* w, parallel::ThreadPool* pool) const override;
  [[nodiscard]] double element_mass(Index element) const override;
  [[nodiscard]] double element_energy(Index element) const override;
  [[nodiscard]] std::vector<std::span<double>> history() override;

  /// Runs another kernel from now on (tests compare instruction sets with it).
  void use_kernel(SolidKernel kernel) { kernel_ = kernel; }

 protected:
  /// @throws InputError when the part's law or property has a choice that these elements do not have
  SolidGroup(const GroupInput& in, int nodes_per_element, SolidKernel kernel);

  /// Fills state and masses; `config_` is set. Called by the families' constructors.
  /// @param element_nodes  #E by nodes_per_element, right-handed
  /// @param frozen_fields fields that small strain needs; @param share_fields 0, or twice the nodes per element
  void set_up(const std::vector<Vec3>& x, std::span<const Index> element_nodes, int frozen_fields, int share_fields);
  [[nodiscard]] virtual SolidGeometry geometry(std::span<const Vec3> corners) const = 0;

  [[nodiscard]] double& at(Index element, int field);
  [[nodiscard]] double at(Index element, int field) const;

  SolidConfig config_;
  double density_ = 0.0;              ///< rho_i, gives the masses
  bool reference_part_mass_ = false;  ///< small strain: part sums with rho^n V_0 (4.3.4)
  bool nodal_part_sums_ = true;
  int nodes_per_element_ = 0;

 private:
  SolidKernel kernel_ = nullptr;
  simd::AlignedVector<std::int32_t> block_offsets_;
  simd::AlignedVector<double> state_;
  std::vector<SolidChunk> results_;
  mutable NodalShares shares_;

  [[nodiscard]] double mass_share(Index element, int corner) const;
  void share_masses() const;
};

}  // namespace abut::elements
