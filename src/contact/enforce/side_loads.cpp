#include "contact/enforce/side_loads.hpp"

namespace abut::contact {

void SideLoads::resize(std::size_t nodes) {
  x_before.resize(nodes);
  own_before.resize(nodes);
  springs_before.resize(nodes);
  loaded.resize(nodes);
  squared_motion.resize((nodes + block - 1) / block);
  pages_.resize((nodes + page - 1) / page);
}

void SideLoads::clear(std::size_t begin, std::size_t end) {
  for_loaded(begin, end, [this](std::size_t s) {
    if ((loaded[s] & now) == 0) return;
    Node& one = node(s);
    const Vec3 force = one.force_before;
    one = {};
    one.force_before = force;
    loaded[s] &= before;
  });
}

void SideLoads::commit(std::size_t begin, std::size_t end) {
  for_loaded(begin, end, [this](std::size_t s) {
    Node& one = node(s);
    one.force_before = one.total();
    own_before[s] = static_cast<float>(one.own_springs);
    springs_before[s] = static_cast<float>(one.own_springs + one.reaction_springs);
    loaded[s] = (loaded[s] & now) != 0 ? now | before : 0;
  });
}

std::vector<Vec3> SideLoads::forces_before() const {
  std::vector<Vec3> force(loaded.size());
  for_loaded(0, loaded.size(), [&](std::size_t s) { force[s] = node(s).force_before; });
  return force;
}

void SideLoads::set_forces_before(std::span<const Vec3> force) {
  clear(0, loaded.size());  // an evaluation that was not committed leaves nothing behind
  for (std::size_t s = 0; s < loaded.size(); ++s) {
    if (loaded[s] == 0 && squared_norm(force[s]) == 0.0 && springs_before[s] == 0.0F) continue;
    load(static_cast<Index>(s)).force_before = force[s];
    loaded[s] = now | before;
  }
}

}  // namespace abut::contact
