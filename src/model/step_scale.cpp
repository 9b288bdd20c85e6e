#include "model/step_scale.hpp"

#include <algorithm>

namespace abut::model {

double system_step_scale(const Model& model) {
  const Controls& c = model.controls;
  if (c.nodal_step) return c.nodal_scale;
  double scale = 1e30;
  if (model.shells.size() > 0) scale = std::min(scale, c.shell.scale);
  if (model.sh3ns.size() > 0) scale = std::min(scale, c.sh3n.scale);
  if (model.bricks.size() > 0) scale = std::min(scale, c.brick.scale);
  if (model.tetras.size() > 0) scale = std::min(scale, c.tetra.scale);
  if (scale > 1e29) scale = 0.9;
  if (c.contact_scale_given) scale = std::min(scale, c.contact_scale);
  return scale;
}

}  // namespace abut::model
