// Friction where the closest point jumps over the bisector of an inward fold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/run.hpp"

namespace abut {
namespace {

const std::string starter = R"deck(#RADIOSS STARTER
/BEGIN
mn45_0.3
      2022         0
                  kg                   m                   s
                  kg                   m                   s
/TITLE
mn45_0.3
/MAT/ELAST/1
elastic 1
                7800
        210000000000                 0.3
/MAT/ELAST/2
elastic 2
                2700
         70000000000                0.33
/PROP/SHELL/1
shell 1
         0         0         0         0
                   0                   0                   0                   0                   0
         3         0               0.002                   0                   0         0
/PROP/SHELL/2
shell 2
         0         0         0         0
                   0                   0                   0                   0                   0
         3         0               0.003                   0                   0         0
/PROP/SOLID/3
solid 3
         1         0         0         0         0         0                   0
                   0                   0                   0
                   0
/PROP/SOLID/4
solid 4
         1         0         0         0         0         0                   0
                   0                   0                   0
                   0
/NODE
         1               -0.04                   0                0.04
         2               -0.04                0.06                0.04
         3                   0                   0                   0
         4                   0                0.06                   0
         5                0.04                   0                0.04
         6                0.04                0.06                0.04
         7              -0.025                0.01     0.0281112698372
         8              -0.025                0.05     0.0281112698372
         9                   0                0.01    0.00311126983722
        10                   0                0.05    0.00311126983722
        11               0.025                0.01     0.0281112698372
        12               0.025                0.05     0.0281112698372
/PART/1
part 1
         1         1         0
/SHELL/1
         1         1         3         4         2
         2         3         5         6         4
/PART/2
part 2
         2         2         0
/SHELL/2
         3         7         8        10         9
         4         9        10        12        11
/SURF/PART/1
surface 1
         1
/SURF/PART/2
surface 2
         2
/GRNOD/NODE/2
group 2
         7         8         9        10        11        12
/INIVEL/TRA/1
inivel 1
                 0.3                   0                  -5         2
/INTER/TYPE3/1
interface 1
         1         2                                                                     0
                   0                 0.3               0.002                   0                   0
       000         0         0
                                                                               0
/TH/PART/1
th 1
DEF       
         1         2
/TH/INTER/2
th 2
DEF       
         1
/END
)deck";

const std::string engine = R"deck(/RUN/mn45_0.3/1
              0.0003
/VERS/2022
/TFILE/4
               1e-07
/ANIM/DT
                   0                   1
/ANIM/VECT/DISP
/ANIM/VECT/VEL
/ANIM/VECT/CONT
/PRINT/-100
/DT
                 0.45                   0
)deck";

// T19 to T23 (type3.md): two free folded pairs of shells, one falls into the other. Nothing is fixed and nothing acts from outside:
// friction takes what the bodies lose and no more. At half the default step, for the frictionless pair leaves 3 % on the way at 0.9 too.
TEST(FoldFriction, TakesWhatTheBodiesLose) {
  const Model model = Model::from_text({.starter = starter, .engines = {engine}, .name = "fold"});
  RunSettings settings;
  settings.threads = 1;
  abut::Run run(model, settings);
  ASSERT_TRUE(run.advance());
  const double energy = run.balance().ke;
  ASSERT_GT(energy, 0.0);
  double made = 0.0;
  while (run.advance()) made = std::max(made, std::abs(run.balance().cx));
  const Balance& b = run.balance();
  EXPECT_GT(b.fw, 0.01 * energy) << "they rub";
  EXPECT_LT(b.fw, 0.3 * energy);
  EXPECT_LT(std::abs(b.cx), 0.01 * energy);
  EXPECT_LT(made, 0.03 * energy) << "on the way";
}

}  // namespace
}  // namespace abut
