// Choices and constants of a group of one-point quadrilaterals.
#pragma once

namespace abut::elements {

struct Q4Parameters {
  int ishell = 1;  ///< 1 to 4
  double hm = 0.01, hf = 0.01, hr = 0.01, dn = 0.0;
  bool frame_v4 = false;               ///< /SHFRA/V4
  bool plain_gamma = false;            ///< hourglass vector (1, -1, 1, -1) instead of the orthogonal one
  bool may_freeze = false;             ///< small strain: now or after a switch
  bool local_rates = false;            ///< may_freeze, midpoint: rates of frozen elements are those of their local coordinates
  bool step_bound = true;              ///< Profile::ElementStep::bound
  bool nodal_step = false;             ///< /DT/NODA: which of the reference's nodal stiffnesses
  bool trapezoidal = true;             ///< Profile::HourglassEnergy
  bool homogeneous = true;             ///< Profile::RotationalHourglass
  bool midpoint = true;                ///< Profile::StrainIncrement
  bool balanced_warp = true;           ///< Profile::WarpedShell
  bool plain_pattern = false;          ///< balanced, with plain_gamma: rates and forces without what rotations make of gamma . x
  double rotation_correction = 0.125;  ///< without midpoint: factor of the second-order terms of Ishell 1 and 2, 1/8 exact, 1/4 reference

  int at_hourglass = -1;      ///< elastic Q_x Q_y Q_z
  int at_hourglass_old = -1;  ///< total q_x q_y q_z mu_x mu_y of the last step (trapezoidal energy)
  int at_normal_old = -1;     ///< N = 1 with dn: normal forces of the last step (trapezoidal energy)
  int at_frozen = -1;         ///< x2 y2 x3 y3 x4 y4 and a flag: 0 free, 1/2 freeze now, 1 frozen; then Q4Shape of the last step
};

}  // namespace abut::elements
