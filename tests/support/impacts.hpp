// Three impacts after the shared decks plates, slide and mixed: shells on shells, bricks on bricks, bricks on shells (kg, m, s).
#pragma once

#include <vector>

#include "support/scene.hpp"

namespace abut::scenes {

/// What tests vary.
struct Variant {
  double lift = 0.0;  ///< the upper body starts higher: another phase of contact within the step
  double step_scale = 0.9;
  bool supported = true;  ///< false: both bodies are free
};

namespace impact {
inline constexpr double young = 210e9, density = 7800.0;  // steel, kg m s
}

/// A shell plate with a spin falls askew on a clamped one; friction, gap 0.5 mm.
inline model::Model plates(const Variant& variant = {}) {
  using impact::density;
  using impact::young;
  Scene s("plates");
  const auto material = s.elastic(density, young, 0.3);
  const auto property = s.shell_property(0.001, 3);
  const auto a = s.part(property, material);
  const auto b = s.part(property, material);
  const auto lower = s.shells(a, 8, 8, [](double u, double v) { return Vec3{0.08 * u, 0.08 * v, 0}; });
  const auto upper = s.shells(
      b, 5, 5,
      [&variant](double u, double v) {
        return Vec3{0.0113 + 0.05 * u, 0.0121 + 0.05 * v, 0.0006 + variant.lift + 0.0002 * u * v};
      },
      true);
  std::vector<Index> rim;
  for (Index j = 0; j <= 8; ++j) {
    for (Index i = 0; i <= 8; ++i) {
      if (i == 0 || i == 8 || j == 0 || j == 8) rim.push_back(lower[static_cast<std::size_t>(i + 9 * j)]);
    }
  }
  if (variant.supported) s.fix(rim, {true, true, true}, {true, true, true});
  s.velocity(upper, {1.0, 0.5, -10.0});
  s.contact(s.shell_surface(a), s.shell_surface(b), 0.2, 0.1, 0.0005);
  s.end(2.2e-4, 0.0, variant.step_scale);
  return s.model;
}

/// A block slides into a fixed base with friction.
inline model::Model slide(const Variant& variant = {}) {
  using impact::density;
  using impact::young;
  Scene s("slide");
  const auto material = s.elastic(density, young, 0.3);
  const auto property = s.solid_property();
  const auto base = s.block(s.part(property, material), {0, 0, -0.02}, {0.08, 0.06, 0.02}, {8, 6, 2});
  const auto block = s.block(s.part(property, material), {0.0113, 0.0121, 2e-6 + variant.lift}, {0.05, 0.03, 0.02}, {4, 3, 2});
  if (variant.supported) s.fix(base.plane(2, false), {true, true, true});
  s.velocity(block.nodes, {3.0, 1.0, -2.0});
  s.contact(s.surface(base, 2, true), s.surface(block, 2, false), 0.2, 0.3);
  s.end(6e-5, 0.0, variant.step_scale);
  return s.model;
}

/// A brick block on a plastic shell plate.
inline model::Model mixed(const Variant& variant = {}) {
  using impact::density;
  using impact::young;
  Scene s("mixed");
  const auto shell = s.part(s.shell_property(0.002, 5), s.johnson_cook(density, young, 0.3, 2e8, 4e8, 0.5));
  const auto lower = s.shells(shell, 8, 8, [](double u, double v) { return Vec3{0.08 * u, 0.08 * v, 0}; });
  const auto block = s.block(s.part(s.solid_property(), s.elastic(density, young, 0.3)), {0.0213, 0.0221, 1e-5 + variant.lift},
                             {0.03, 0.03, 0.02}, {3, 3, 2});
  std::vector<Index> rim;
  for (Index j = 0; j <= 8; ++j) {
    for (Index i = 0; i <= 8; ++i) {
      if (i == 0 || i == 8 || j == 0 || j == 8) rim.push_back(lower[static_cast<std::size_t>(i + 9 * j)]);
    }
  }
  if (variant.supported) s.fix(rim, {true, true, true}, {true, true, true});
  s.velocity(block.nodes, {0.5, 0.3, -8.0});
  s.contact(s.shell_surface(shell), s.surface(block, 2, false), 0.2, 0.2, 0.0);
  s.end(1.2e-4, 0.0, variant.step_scale);
  return s.model;
}

/// A block that hits another one with a corner: the bricks there hourglass, in directions that are none of the axes.
inline model::Model corner(const Variant& variant = {}) {
  using impact::density;
  using impact::young;
  Scene s("corner");
  const auto part = s.part(s.solid_property(), s.elastic(density, young, 0.3));
  const auto base = s.block(part, {0, 0, 0}, {0.04, 0.04, 0.02}, {4, 4, 2});
  const auto block = s.block(part, {0.0223, 0.0231, 0.02001 + variant.lift}, {0.03, 0.03, 0.02}, {3, 3, 2});
  if (variant.supported) s.fix(base.plane(2, false), {true, true, true});
  s.velocity(block.nodes, {8.0, 5.0, -30.0});
  s.contact(s.surface(base, 2, true), s.surface(block, 2, false), 0.2, 0.2);
  s.end(6e-5, 0.0, variant.step_scale);
  return s.model;
}

}  // namespace abut::scenes
