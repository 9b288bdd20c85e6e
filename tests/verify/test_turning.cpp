// Bodies that turn many times, and that vibrate in all their modes, keep their energy (docs/theory/elements.md, strain increments).
//
// With the reference's increments a turn shows as a stretch of (omega h)^2/2 per step and stress lags half a step behind the body; what
// that makes of the energy is printed beside.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Profile;
using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;
namespace model = abut::model;

struct Form {
  const char* name;
  model::ElementKind kind;
  int variant;  ///< Ishell, Ish3n, Iframe
};

constexpr double side = 0.1;

/// A plate of 4 by 4 quadrilaterals or 4 by 4 by 2 triangles, or a block of 3 by 3 by 3 bricks, each cut into six tetrahedra or not.
Scene body(const Form& form) {
  Scene s("turning");
  const Index steel = s.elastic(7800.0, 210e9, 0.3);
  if (form.kind == model::ElementKind::shell4 || form.kind == model::ElementKind::shell3) {
    const Index property = s.shell_property(0.002);
    auto& shell = std::get<model::ShellProperty>(s.model.properties[0].data);
    (form.kind == model::ElementKind::shell4 ? shell.ishell : shell.ish3n) = form.variant;
    s.shells(s.part(property, steel), 4, 4, [](double u, double v) { return Vec3{side * (u - 0.5), side * (v - 0.5), 0}; });
    if (form.kind == model::ElementKind::shell3) {
      for (const auto& q : s.model.shells.nodes) {
        for (const auto& t : {std::array<Index, 3>{q[0], q[1], q[2]}, std::array<Index, 3>{q[2], q[3], q[0]}}) {
          s.model.sh3ns.id.push_back(static_cast<abut::Id>(s.model.sh3ns.id.size()) + 1);
          s.model.sh3ns.part.push_back(0);
          s.model.sh3ns.thickness.push_back(0.0);
          s.model.sh3ns.nodes.push_back(t);
        }
      }
      s.model.shells = {};
    }
    return s;
  }
  const Index property = s.solid_property();
  std::get<model::SolidProperty>(s.model.properties[0].data).iframe = form.variant;
  s.block(s.part(property, steel), Vec3{-0.5, -0.5, -0.5} * side, Vec3{1, 1, 1} * side, {3, 3, 3});
  if (form.kind == model::ElementKind::tetra) {
    constexpr int corners[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    for (const auto& b : s.model.bricks.nodes) {
      for (const auto& t : corners) {
        const auto at = [&](int k) { return b[static_cast<std::size_t>(t[k])]; };
        s.model.tetras.id.push_back(static_cast<abut::Id>(s.model.tetras.id.size()) + 1);
        s.model.tetras.part.push_back(0);
        s.model.tetras.nodes.push_back({at(0), at(1), at(2), at(3)});
      }
    }
    s.model.bricks = {};
  }
  return s;
}

/// @return energy at the end over that of the start; infinite where the run failed
double kept(Scene& s, double time, const Profile& profile) {
  s.end(time);
  abut::cycle::RunOptions options;
  options.profile = profile;
  Recorder r;
  const auto report = abut::cycle::run(s.model, options, r);
  if (report.outcome.kind != abut::cycle::Outcome::Kind::finished) return INFINITY;
  const auto &first = r.samples.front().balance, &last = r.samples.back().balance;
  return (last.ie + last.ke + last.ker + last.he) / (first.ke + first.ker);
}

constexpr Form forms[] = {
    {"Ishell 1", model::ElementKind::shell4, 1}, {"Ishell 2", model::ElementKind::shell4, 2}, {"Ishell 3", model::ElementKind::shell4, 3},
    {"Ishell 4", model::ElementKind::shell4, 4}, {"Ish3n 1", model::ElementKind::shell3, 1},  {"Ish3n 2", model::ElementKind::shell3, 2},
    {"Iframe 1", model::ElementKind::brick, 1},  {"Iframe 2", model::ElementKind::brick, 2},  {"TETRA4", model::ElementKind::tetra, 1}};

bool flat(const Form& form) { return form.kind == model::ElementKind::shell4 || form.kind == model::ElementKind::shell3; }

/// Turns the body about its middle, shells with their rotations, and shakes every node by up to `shake` in each direction.
void turn(Scene& s, const Form& form, const Vec3& omega, double shake) {
  std::mt19937 numbers(1);
  const auto any = [&numbers, shake] { return shake * (2.0 * static_cast<double>(numbers()) / 4294967295.0 - 1.0); };
  std::vector<Index> all(static_cast<std::size_t>(s.model.node_count()));
  std::iota(all.begin(), all.end(), Index{0});
  for (const Index n : all) {
    const double x = any(), y = any(), z = any();
    s.velocity({n}, cross(omega, s.model.node_x[static_cast<std::size_t>(n)]) + Vec3{x, y, z});
  }
  if (flat(form)) s.model.initial_velocities.push_back({static_cast<abut::Id>(all.size()) + 1, true, omega, all});
}

TEST(Turning, FifteenTurnsKeepTheEnergy) {
  const Vec3 omega = 1000.0 * Vec3{0, 0, 1};
  for (const Form& form : forms) {
    const auto turned = [&](int turns, const Profile& profile) {
      Scene s = body(form);
      for (Index n = 0; n < s.model.node_count(); ++n) s.velocity({n}, cross(omega, s.model.node_x[static_cast<std::size_t>(n)]));
      return kept(s, turns * 2.0 * std::numbers::pi / 1000.0, profile);
    };
    const double fifteen = turned(15, Profile::standard());
    std::printf("[found] turning, %s: energy after 15 turns %.6f; reference profile after 2 %.4f, after 20 %.4g\n", form.name, fifteen,
                turned(2, Profile::reference()), turned(20, Profile::reference()));
    EXPECT_NEAR(fifteen, 1.0, 1e-4) << form.name;
  }
}

// About any axis, also one in the plane of a shell that is neither of its sides: the slopes of v_z shear it, a step's worth each.
TEST(Turning, TheAxisIsOfNoConsequence) {
  for (const Form& form : forms) {
    double worst = 0.0, reference = 0.0;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 2, 3}}) {
      const auto turned = [&](const Profile& profile) {
        Scene s = body(form);
        turn(s, form, (1000.0 / norm(axis)) * axis, 0.0);
        return kept(s, 15 * 2.0 * std::numbers::pi / 1000.0, profile);
      };
      worst = std::max(worst, std::abs(turned(Profile::standard()) - 1.0));
      reference = std::max(reference, turned(Profile::reference()));
    }
    std::printf("[found] turning about three axes, %s: energy after 15 turns off by %.1e; reference profile %.4g times\n", form.name, worst,
                reference);
    EXPECT_LT(worst, 1e-4) << form.name;
  }
}

// Turning and vibrating: bending, shear and hourglass motion too must be those of mid-step, or the moments drive the turning.
TEST(Turning, VibrationsOfTurningBodiesMakeNoEnergy) {
  for (const Form& form : forms) {
    const auto turned = [&](const Profile& profile) {
      Scene s = body(form);
      turn(s, form, {0, 0, 1000}, 1.0);
      return kept(s, 5 * 2.0 * std::numbers::pi / 1000.0, profile);
    };
    const double end = turned(Profile::standard());
    std::printf("[found] turning and vibrating, %s: energy after 5 turns %.5f; reference profile %.4g\n", form.name, end,
                turned(Profile::reference()));
    EXPECT_LT(end, 1.002) << form.name;
  }
}

// Random velocities of 1 m/s, up to strains of some 1e-3, a few thousand steps: steps of strain along closed paths must close.
TEST(Turning, VibrationsInAllModesMakeNoEnergy) {
  for (const Form& form : forms) {
    const auto vibrated = [&form](const Profile& profile) {
      Scene s = body(form);
      std::mt19937 numbers(1);
      const auto any = [&numbers] { return 2.0 * static_cast<double>(numbers()) / 4294967295.0 - 1.0; };
      for (Index n = 0; n < s.model.node_count(); ++n) {
        const double x = any(), y = any(), z = any();
        s.velocity({n}, {x, y, flat(form) ? 0.0 : z});
      }
      return kept(s, 5e-3, profile);
    };
    const double end = vibrated(Profile::standard());
    std::printf("[found] vibrating, %s: energy at the end %.5f; reference profile %.4g\n", form.name, end, vibrated(Profile::reference()));
    EXPECT_LT(end, 1.01) << form.name;
  }
}

/// Angular momentum and energy of hourglass forces, over those of the start, of a block of bricks whose nodes are moved by up to 10 % and
/// that spins for 10 ms, 1 rad.
void spin_irregular(int isolid, const Profile& profile, double& spin, double& hourglass) {
  const Vec3 omega{0, 0, 100};
  Scene s("turning");
  const Index property = s.solid_property();
  std::get<model::SolidProperty>(s.model.properties[0].data).isolid = isolid;
  s.block(s.part(property, s.elastic(7800.0, 210e9, 0.3)), Vec3{-0.5, -0.5, -0.5} * side, Vec3{1, 1, 1} * side, {4, 4, 4});
  std::mt19937 numbers(1);
  const auto any = [&numbers] { return 0.1 * side / 4 * (2.0 * static_cast<double>(numbers()) / 4294967295.0 - 1.0); };
  for (Index n = 0; n < s.model.node_count(); ++n) {
    Vec3& place = s.model.node_x[static_cast<std::size_t>(n)];
    const double x = any(), y = any(), z = any();
    place += Vec3{x, y, z};
    s.velocity({n}, cross(omega, place));
  }
  s.end(1e-2);
  abut::cycle::RunOptions options;
  options.profile = profile;
  Recorder r;
  (void)abut::cycle::run(s.model, options, r);
  double before = 0.0, after = 0.0;
  for (std::size_t n = 0; n < s.model.node_x.size(); ++n) {
    before += r.last_state.mass[n] * cross(s.model.node_x[n], cross(omega, s.model.node_x[n])).z;
    after += r.last_state.mass[n] * cross(r.last_state.x[n], r.last_state.v[n]).z;
  }
  spin = after / before;
  hourglass = r.samples.back().balance.he / r.samples.front().balance.ke;
}

// Hourglass modes that see a rotation brake it: in Isolid 1 none may. Isolid 2 is what it is (model.braked_rotation says so).
TEST(Turning, IrregularBricksKeepTheirSpin) {
  double spin, hourglass, spin_of_three, spin_of_none, unused;
  spin_irregular(1, Profile::standard(), spin, hourglass);
  spin_irregular(1, Profile::reference(), spin_of_three, unused);
  spin_irregular(2, Profile::standard(), spin_of_none, unused);
  std::printf("[found] irregular bricks, 1 rad: angular momentum %.9f, hourglass energy %.1e; reference profile %.3f, Isolid 2 %.3f\n",
              spin, hourglass, spin_of_three, spin_of_none);
  EXPECT_NEAR(spin, 1.0, 1e-6);
  EXPECT_LT(hourglass, 1e-6);
  EXPECT_LT(spin_of_three, 0.7);
  EXPECT_LT(spin_of_none, 0.3);
}

// Warped quadrilaterals: hourglass forces at the heights of the corners, and what their rates see of v_z (membranes, N = 1) or of
// rotations.
TEST(Turning, WarpedShellsKeepEnergyAndMomentum) {
  for (const auto& [ishell, points] : {std::pair{1, 1}, {2, 1}, {3, 1}, {4, 1}, {1, 3}, {2, 3}, {3, 3}, {4, 3}}) {
    const auto vibrated = [ishell = ishell, points = points](const Profile& profile, double& moment) {
      Scene s("turning");
      const Index property = s.shell_property(0.002);
      auto& shell = std::get<model::ShellProperty>(s.model.properties[0].data);
      shell.ishell = ishell;
      shell.points = points;
      s.shells(s.part(property, s.elastic(7800.0, 210e9, 0.3)), 4, 4, [points](double u, double v) {
        const double odd = (std::lround(4 * u) + std::lround(4 * v)) % 2 == 0 ? 1.0 : -1.0;
        return Vec3{side * (u - 0.5), side * (v - 0.5), (points == 1 ? 0.02 : 0.1) * side * odd};
      });
      std::mt19937 numbers(1);
      const auto any = [&numbers] { return 2.0 * static_cast<double>(numbers()) / 4294967295.0 - 1.0; };
      std::vector<Vec3> start;
      for (Index n = 0; n < s.model.node_count(); ++n) {
        const double x = any(), y = any(), z = any();
        start.push_back((points == 1 ? 1e-6 : 1.0) * Vec3{x, y, z});
        s.velocity({n}, start.back());
      }
      s.end(1e-2);
      abut::cycle::RunOptions options;
      options.profile = profile;
      Recorder r;
      const auto report = abut::cycle::run(s.model, options, r);
      if (profile.warped_shell == Profile::WarpedShell::balanced) { EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished); }
      Vec3 before, after;
      double size = 0.0;
      for (std::size_t n = 0; n < s.model.node_x.size(); ++n) {
        const double m = r.last_state.mass[n];
        before += m * cross(s.model.node_x[n], start[n]);
        after += m * cross(r.last_state.x[n], r.last_state.v[n]) + r.last_state.inertia[n] * r.last_state.w[n];
        size += m * norm(s.model.node_x[n]) * norm(start[n]);
      }
      moment = norm(after - before) / size;
      const auto& last = r.samples.back().balance;
      return (last.ie + last.ke + last.ker + last.he) / r.samples.front().balance.ke;
    };
    double moment, reference_moment;
    const double end = vibrated(Profile::standard(), moment), reference = vibrated(Profile::reference(), reference_moment);
    std::printf(
        "[found] warped, Ishell %d, N = %d: energy at the end %.5f, angular momentum changes by %.1e; reference profile %.4g, %.1e\n",
        ishell, points, end, moment, reference, reference_moment);
    EXPECT_LT(end, 1.001) << ishell;
    EXPECT_LT(moment, 1e-6) << ishell;
  }
}

// A warped plate of irregular quadrilaterals turns freely: what a rotation makes of the corners' heights and of gamma . x is no hourglass.
TEST(Turning, WarpedShellsTurnFreely) {
  for (const auto& [ishell, points] : {std::pair{1, 1}, {2, 1}, {3, 1}, {4, 1}, {1, 3}, {2, 3}, {3, 3}, {4, 3}}) {
    const auto turned = [ishell = ishell, points = points](const Profile& profile, double& hourglass) {
      Scene s("turning");
      const Index property = s.shell_property(0.002);
      auto& shell = std::get<model::ShellProperty>(s.model.properties[0].data);
      shell.ishell = ishell;
      shell.points = points;
      s.shells(s.part(property, s.elastic(7800.0, 210e9, 0.3)), 4, 4, [](double u, double v) {
        const double bent = 0.1 * std::sin(7 * u) * std::cos(5 * v);
        return side * Vec3{u - 0.5 + 0.5 * bent, v - 0.5 - 0.3 * bent, bent};
      });
      turn(s, forms[0], (100.0 / std::sqrt(14.0)) * Vec3{1, 2, 3}, 0.0);
      s.end(2.0 * std::numbers::pi / 100.0);
      abut::cycle::RunOptions options;
      options.profile = profile;
      Recorder r;
      EXPECT_EQ(abut::cycle::run(s.model, options, r).outcome.kind, abut::cycle::Outcome::Kind::finished);
      const auto &first = r.samples.front().balance, &last = r.samples.back().balance;
      hourglass = last.he / (first.ke + first.ker);
      return (last.ke + last.ker) / (first.ke + first.ker);
    };
    double hourglass, flat_hourglass;
    Profile sees_rotations = Profile::standard();
    sees_rotations.warped_shell = Profile::WarpedShell::reference;
    const double kept = turned(Profile::standard(), hourglass), flat_kept = turned(sees_rotations, flat_hourglass);
    std::printf(
        "[found] warped and turning, Ishell %d, N = %d: after a turn kinetic energy %.6f, hourglass energy %.1e; rates that see the "
        "rotation %.4f, %.1e\n",
        ishell, points, kept, hourglass, flat_kept, flat_hourglass);
    EXPECT_NEAR(kept, 1.0, 1e-4) << ishell;
    EXPECT_LT(hourglass, 1e-4) << ishell;  // membranes: what centrifugal forces do to the heights
  }
}

// Small strain: gradients of cycle 0, a frame that turns; rates that hold the spin times a displacement would drive the vibration.
TEST(Turning, SmallStrainShellsKeepTheEnergy) {
  for (const int ishell : {1, 2, 3, 4}) {
    for (const double irregular : {0.0, 0.1}) {
      Scene s("turning");
      const Index property = s.shell_property(0.002);
      auto& shell = std::get<model::ShellProperty>(s.model.properties[0].data);
      shell.ishell = ishell;
      shell.ismstr = ishell == 2 ? 3 : 1;
      s.shells(s.part(property, s.elastic(7800.0, 210e9, 0.3)), 4, 4, [irregular](double u, double v) {
        const double aside = irregular * std::sin(7 * u) * std::cos(5 * v);
        return side * Vec3{u - 0.5 + aside, v - 0.5 - 0.6 * aside, 0};
      });
      turn(s, forms[0], (1000.0 / std::sqrt(14.0)) * Vec3{1, 2, 3}, 1.0);
      const double end = kept(s, 5 * 2.0 * std::numbers::pi / 1000.0, Profile::standard());
      std::printf("[found] turning and vibrating with small strain, Ishell %d, %s: energy after 5 turns %.5f\n", ishell,
                  irregular > 0.0 ? "irregular" : "squares", end);
      EXPECT_NEAR(end, 1.0, 1e-3) << ishell;
    }
  }
}

}  // namespace
