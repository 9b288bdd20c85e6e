// Equivalent strain rate of an element as a whole, for outputs (numerics.md 5.2.3).
//
//   solids  e' = sqrt(2/3 dev D : dev D),  D = sym(sum_I v_I (x) grad N_I) at the centre
//   shells  e'^2 = 4/3 (exx^2 + eyy^2 + exx eyy + gxy^2 / 4) + t^2 / 9 (kxx^2 + kyy^2 + kxx kyy + kxy^2 / 4)
// with membrane rates e and rates of curvature k at the centre. Both are the rate of uniaxial stretching of an incompressible body:
// for shells ezz = -exx - eyy, and the mean square over the thickness. Transverse shear does not count. LAW2 with VP = 3 sees this rate
// in solids, with VP = 2 (the default) in shells; its filter (F_cut) is not in it.
#pragma once

#include <span>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "elements/group.hpp"

namespace abut::elements {

/// @param x, v, w  #N by 3: positions, velocities, angular velocities @return 1 / time; 0 for elements without area or volume
[[nodiscard]] double equivalent_strain_rate(const Group& group, Index element, std::span<const Vec3> x, std::span<const Vec3> v,
                                            std::span<const Vec3> w);

}  // namespace abut::elements
