// Mass, momentum and kinetic energy of a shell group for the time history (Profile::PartSums).
#include <utility>

#include "elements/shell_common/shell_group.hpp"

namespace abut::elements {

void ShellGroup::share_masses() const {
  if (shares_.valid) return;
  std::vector<double> masses(chunks_.nodes().size(), 0.0), inertias(chunks_.nodes().size(), 0.0);
  const bool nodal = in_.profile.part_sums == Profile::PartSums::nodal;
  for (Index e = 0; e < size(); ++e) {
    if (nodal ? !active(e) : constant(e, shell_constant::active) == 0.0) continue;
    const double equal = element_mass(e) / static_cast<double>(per_element_);
    const std::array<Vec3, 4> x = corners(e, in_.model->node_x.data());
    const double t = initial_thickness(e), area = frame(std::span<const Vec3>(x.data(), per_element_)).area;
    const double inertia = nodal ? constant(e, shell_constant::inertia) : (t * t + area) / 12.0;
    for (int k = 0; k < layout_.nodes_per_element; ++k) {
      const std::size_t place = chunks_.place(e, k);
      const double share = nodal ? mass_of_corner(e, k) : equal;
      masses[place] += share;
      inertias[place] += share * inertia;
    }
  }
  shares_.mass = NodalShares::Values(std::move(masses));
  shares_.inertia = NodalShares::Values(std::move(inertias));
  shares_.leaves.resize(static_cast<std::size_t>(chunks_.size()));
  shares_.valid = true;
}

PartSums ShellGroup::part_sums(const Vec3* v, const Vec3* w, parallel::ThreadPool* pool) const {
  share_masses();
  return shares_.sums(chunks_, v, w, pool);
}

}  // namespace abut::elements
