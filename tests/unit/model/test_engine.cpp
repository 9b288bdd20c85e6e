// Engine deck (deck-format.md G): free format, defaults, what is skipped and what is refused.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/model/deck_text.hpp"

namespace abut::model {
namespace {

using namespace base_deck;

Built build_engine(const std::string& engine) { return build_text(base_starter, engine); }
Controls controls(const std::string& engine) { return build_engine(engine).model.controls; }

TEST(Engine, RunHistoryListingAndAnimation) {
  const Controls k = controls(
      "# comment\n/RUN/model_00/1/\n\n   2.5E-3 \n/TFILE/4\n1.0d-5\n/PRINT/ -10\n/RFILE/2\n5000 0\n/ANIM/DT\n.001, "
      ".002\n/ANIM/VECT/ACCEL\n/ANIM/ELEM/PRES\n"
      "/ANIM/ELEM/EPSP\n/ANIM/ELEM/EPSP\n/ANIM/TENS/STRESS/MEMB\n/ANIM/BRIC/TENS/EPSDO\n/ANIM/GZIP\n/ANIM/VERS/44\n/TITLE\n\n/END\n/RUN/"
      "other/1\n9\n");
  EXPECT_EQ(k.run_name, "model_00");
  EXPECT_EQ(k.t_end, 2.5e-3);
  EXPECT_EQ(k.history_interval, 1e-5);
  EXPECT_EQ(k.print_every, 10);
  EXPECT_EQ(k.restart_every, 5000);
  EXPECT_EQ(k.animation_start, .001);
  EXPECT_EQ(k.animation_interval, .002);
  EXPECT_EQ(k.animation_fields,
            (std::vector<std::string>{"VECT/ACC", "ELEM/P", "ELEM/EPSP", "SHELL/TENS/STRESS/MEMB", "BRICK/TENS/EPSDOT"}));
}

TEST(Engine, DefaultsWhenOnlyTheRunIsGiven) {
  const Controls k = controls("/RUN/a/1\n1\n");
  EXPECT_EQ(k.history_interval, infinity);
  EXPECT_EQ(k.animation_interval, infinity);
  EXPECT_EQ(k.brick.scale, 0.9);
  EXPECT_EQ(k.nodal_scale, 0.9);
  EXPECT_EQ(k.contact_scale, 0.9);
  EXPECT_FALSE(k.contact_scale_given);
  EXPECT_EQ(k.brick.action, StepControl::Action::none);
  EXPECT_EQ(k.print_every, 100);
  EXPECT_EQ(k.dt_max, infinity);
}

// The second Engine deck repeats /DT as it is: what /DT/BRICK and the others have said stays, and what they have not follows /DT.
TEST(Engine, GeneralStepOfALaterRunLeavesTheStepsOfTypesAlone) {
  const std::string first = "/RUN/a/1\n1\n/DT\n0.9 0\n/DT/BRICK\n0.3 1e-9\n/DT/NODA/CST\n0.8 1e-8\n/DT/INTER/DEL\n0.6 1e-7\n";
  const Controls k = build_text(base_starter, first, {"/RUN/a/2\n2\n/DT\n0.7 1e-6\n"}).model.controls;
  for (const StepControl& solid : {k.brick, k.tetra}) {
    EXPECT_EQ(solid.scale, 0.3);
    EXPECT_EQ(solid.minimum, 1e-9);
    EXPECT_EQ(solid.action, StepControl::Action::stop);
  }
  EXPECT_EQ(k.nodal_scale, 0.8);
  EXPECT_EQ(k.nodal_minimum, 1e-8);
  EXPECT_EQ(k.contact_scale, 0.6);
  EXPECT_EQ(k.shell.scale, 0.7);
  EXPECT_EQ(k.shell.minimum, 1e-6);
  EXPECT_EQ(k.sh3n.scale, 0.7);
  const Controls changed = build_text(base_starter, first, {"/RUN/a/2\n2\n/DT\n0.7 0\n", "/RUN/a/3\n3\n/DT/BRICK\n0.5\n"}).model.controls;
  EXPECT_EQ(changed.brick.scale, 0.5);
  EXPECT_EQ(changed.brick.action, StepControl::Action::none);
  EXPECT_EQ(changed.shell.scale, 0.7);
}

TEST(Engine, GeneralStepGivesWayToTheStepOfAType) {
  // G.2: order is free. Solids stop and shells are deleted at the general minimum.
  const Controls k = controls("/RUN/a/1\n1\n/DT/SHELL/DEL\n0.5 1e-8\n/DT\n0.67 1e-7\n");
  EXPECT_EQ(k.shell.scale, 0.5);
  EXPECT_EQ(k.shell.minimum, 1e-8);
  EXPECT_EQ(k.shell.action, StepControl::Action::remove);
  EXPECT_EQ(k.sh3n.scale, 0.67);
  EXPECT_EQ(k.sh3n.action, StepControl::Action::remove);
  EXPECT_EQ(k.brick.action, StepControl::Action::stop);
  EXPECT_EQ(k.tetra.minimum, 1e-7);
  EXPECT_EQ(k.nodal_scale, 0.67);
  EXPECT_EQ(k.contact_scale, 0.67);
  EXPECT_FALSE(k.nodal_step);
}

TEST(Engine, ZeroScaleIsTheDefaultScale) {
  const Controls k = controls("/RUN/a/1\n1\n/DT\n0.000000 0.000010\n");
  EXPECT_EQ(k.brick.scale, 0.9);
  EXPECT_EQ(k.brick.minimum, 1e-5);
}

TEST(Engine, StepOfATypeWithoutActionTakesTheTypesOwn) {
  const Controls k = controls("/RUN/a/1\n1\n/DT/BRICK\n0.8 1e-7\n/DT/SH_3N\n0.7 1e-7\n/DT/SHELL/CST\n.6 1e-6\n");
  EXPECT_EQ(k.brick.action, StepControl::Action::stop);
  EXPECT_EQ(k.tetra.scale, 0.8);
  EXPECT_EQ(k.sh3n.action, StepControl::Action::remove);
  EXPECT_EQ(k.shell.action, StepControl::Action::constant);
}

TEST(Engine, NodalStepAndMassScaling) {
  const Controls plain = controls("/RUN/a/1\n1\n/DT/NODA\n0.8 0\n");
  EXPECT_TRUE(plain.nodal_step);
  EXPECT_FALSE(plain.mass_scaling);
  EXPECT_EQ(plain.nodal_scale, 0.8);
  const Controls scaled = controls("/RUN/a/1\n1\n/DT/NODA/CST/0\n0.9 1e-06\n");
  EXPECT_TRUE(scaled.mass_scaling);
  EXPECT_EQ(scaled.nodal_minimum, 1e-6);
  EXPECT_FALSE(scaled.mass_scaling_nodes.has_value());
  const Controls group = controls("/RUN/a/1\n1\n/DT/NODA/CST/1\n0.9 1e-06\n3\n");
  EXPECT_EQ(group.mass_scaling_nodes.value().size(), 4u);
  const Controls groups = controls("/RUN/a/1\n1\n/DT/NODA/CST/1\n0.9 1e-06\n3 2\n5 3\n");
  EXPECT_EQ(groups.mass_scaling_nodes.value().size(), 9u);  // 9 to 16 and 30, each once
  const Built long_step = build_engine("/RUN/a/1\n1\n/DT/NODA/CST\n0.9 2\n");
  EXPECT_TRUE(long_step.has("field 'Tmin': a minimum step of 2 is longer than the whole run, which ends at 1"));
  const Built empty = build_text(with_line(base_starter, "/GRNOD/NODE/3", 2, "        77"), "/RUN/a/1\n1\n/DT/NODA/CST/1\n0.9 1e-06\n3\n");
  EXPECT_TRUE(empty.has("field 'grnd_ID': /GRNOD 3 holds no node; name one that does, or take /1 out for all nodes"));
}

TEST(Engine, ContactStep) {
  const Controls k = controls("/RUN/a/1\n1\n/DT\n.5 0\n/DT/INTER/DEL\n.67 1e-9\n");
  EXPECT_EQ(k.contact_scale, .67);
  EXPECT_TRUE(k.contact_scale_given);
  EXPECT_EQ(k.contact_minimum, 1e-9);
  EXPECT_EQ(k.contact_action, StepControl::Action::remove);
}

TEST(Engine, StepLimitsAndStops) {
  const Controls k = controls("/RUN/a/1\n1\n/DTIX\n0 1.475e-3\n/STOP\n0.5 0.02\n");
  EXPECT_EQ(k.dt_initial, 0.0);
  EXPECT_EQ(k.dt_max, 1.475e-3);
  EXPECT_EQ(k.stop_energy_error, 0.5);
  EXPECT_EQ(k.stop_total_mass, 0.02);
  EXPECT_EQ(k.stop_nodal_mass, 0.0);
  EXPECT_EQ(controls("/RUN/a/1\n1\n/STOP\n1e30 1e30 1e30\n").stop_energy_error, 0.0);
  EXPECT_EQ(controls("/RUN/a/1\n1\n/STOP\n\n").stop_energy_error, 0.0);
}

TEST(Engine, RigidBodiesAreSwitchedByTheirMainNodes) {
  const Built off = build_engine("/RUN/a/1\n1\n/RBODY/OFF\n30 \n");
  EXPECT_FALSE(off.model.rigid_bodies.at(0).active);
  EXPECT_EQ(off.model.controls.rbody_off, std::vector<Id>{30});
  const Built zero = build_engine("/RUN/a/1\n1\n/RBODY/ON\n0 \n");
  EXPECT_FALSE(zero.diagnostics.has_errors());
}

TEST(Engine, HarmlessKeywordsAreSkippedWithANote) {
  const Built b = build_engine(
      "/RUN/a/1\n1\n/TFILE\n1\n/MON/ON\n/PARITH/ON\n/VERS/2019\n/H3D/DT\n0 1\n/H3D/ELEM/VONM\n/PROC/4\n/OUTP/DT\n0 1\n/ATFILE\n1\n");
  EXPECT_EQ(b.messages(),
            (std::vector<std::string>{
                "deck_0001.rad: note: these keywords do not change the mechanics and are skipped: /ATFILE, /H3D, /OUTP, /PROC"}));
}

TEST(Engine, ADeckWithoutOutputsSaysSo) {
  EXPECT_EQ(build_engine("/RUN/a/1\n1\n").messages(),
            std::vector<std::string>{"deck_0001.rad: note: neither /TFILE nor /ANIM/DT gives an interval: the time history has the row of "
                                     "the start, and there is no animation"});
  EXPECT_TRUE(build_engine("/RUN/a/1\n1\n/TFILE\n0.1\n").messages().empty());
  EXPECT_TRUE(build_engine("/RUN/a/1\n1\n/ANIM/DT\n0 0.1\n").messages().empty());
}

}  // namespace
}  // namespace abut::model
