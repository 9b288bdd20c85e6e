// Choices of a group of C0 triangles.
#pragma once

namespace abut::elements {

struct C0Parameters {
  bool large_rotation = true;  ///< Ish3n 2: corrections by in-plane rotation too
  bool midpoint = true;        ///< Profile::StrainIncrement: with it both forms see all of a rotation in the plane
  bool step_bound = true;      ///< Profile::ElementStep::bound
  bool nodal_step = false;     ///< /DT/NODA: which of the reference's nodal stiffnesses
};

}  // namespace abut::elements
