#include "contact/enforce/facet_views.hpp"

namespace abut::contact {

void FacetViews::look(const Side& surface, Index f, FacetView& view) const {
  static_cast<MeanPlane&>(view) = mean_plane(surface.bare_patch(f));
  view.facet = f;
  view.step = step_;
  view.moves_known = false;
}

const FacetView& FacetViews::moving(const Side& surface, std::span<const Vec3> before, std::span<const Vec3> v, double dt, Index f) {
  FacetView& view = place(surface, f);
  if (view.moves_known) return view;
  const std::array<Index, 4>& corner = surface.surface().local()[at(f)];
  const auto of_corners = [&](const auto& motion) {
    return std::array<Vec3, 4>{motion(corner[0]), motion(corner[1]), motion(corner[2]), motion(corner[3])};
  };
  const auto spread = [](const std::array<Vec3, 4>& each, Vec3& mean) {
    mean = 0.25 * ((each[0] + each[1]) + (each[2] + each[3]));
    double squared = 0.0;
    for (const Vec3& one : each) squared = std::max(squared, squared_norm(one - mean));
    return std::sqrt(squared);
  };
  const std::array<Vec3, 4> last = of_corners([&](Index s) { return surface.x()[at(s)] - before[at(s)]; });
  const std::array<Vec3, 4> coming = of_corners([&](Index s) { return dt * v[at(surface.nodes()[at(s)])]; });
  view.last_spread = spread(last, view.last);
  view.coming_spread = spread(coming, view.coming);
  view.rises = -1e300;
  for (const Vec3& one : coming) view.rises = std::max(view.rises, dot(view.normal, one));
  view.moves_known = true;
  const Patch patch = surface.bare_patch(f);
  // As in closest_point.cpp; s and t are right within a few hundredths where these hold.
  constexpr double twist = 1e-4, slant = 0.25;
  const Vec3 a = 0.25 * ((patch.x[1] - patch.x[0]) + (patch.x[2] - patch.x[3]));
  const Vec3 b = 0.25 * ((patch.x[3] - patch.x[0]) + (patch.x[2] - patch.x[1]));
  const Vec3 g = 0.25 * ((patch.x[0] - patch.x[1]) + (patch.x[2] - patch.x[3]));
  const double a11 = squared_norm(a), a22 = squared_norm(b), a12 = dot(a, b), det = a11 * a22 - a12 * a12;
  view.narrow = std::min(a11, a22);
  view.flat = !patch.triangle && squared_norm(g) < twist * view.narrow && det > slant * a11 * a22;
  if (!view.flat) return view;
  view.along_s = (1.0 / det) * (a22 * a - a12 * b);
  view.along_t = (1.0 / det) * (a11 * b - a12 * a);
  return view;
}

}  // namespace abut::contact
