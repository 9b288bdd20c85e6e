// A study of another author against the installed library: a deck in memory, run to its end in steps of its own choice.
//
// One brick, 1 by 1 by 1, density 2, flies freely with v = (3, 0, 0): its mass is 2 and its kinetic energy 9 at all times, it moves
// by v t, and nothing deforms. Half-way its velocity is doubled: the energy is 36 then, the difference is external work.
#include <abut/model.hpp>
#include <abut/run.hpp>
#include <cmath>
#include <cstdio>
#include <string>

namespace {

const char* const starter = R"(#RADIOSS STARTER
/BEGIN
brick
      2022         0
                  kg                   m                   s
                  kg                   m                   s
/MAT/ELAST/1
steel
                   2
                1000                 0.3
/PROP/SOLID/1
brick
         1         4                   0         0         0         0         0
                   0                   0                   0                   0                   0
                   0
/NODE
         1                   0                   0                   0
         2                   1                   0                   0
         3                   1                   1                   0
         4                   0                   1                   0
         5                   0                   0                   1
         6                   1                   0                   1
         7                   1                   1                   1
         8                   0                   1                   1
/PART/1
brick
         1         1
/BRICK/1
         1         1         2         3         4         5         6         7         8
/GRNOD/NODE/1
all
         1         2         3         4         5         6         7         8
/INIVEL/TRA/1
flight
                   3                   0                   0         1         0
/END
)";
const char* const engine = R"(#RADIOSS ENGINE
/RUN/brick/1
  0.5
/TFILE/4
  0.05
/DT
  0.9 0
)";

int fail(const char* what, double got, double expected) {
  std::printf("consumer: %s is %.17g, expected %.17g\n", what, got, expected);
  return 1;
}

bool close(double a, double b) { return std::abs(a - b) <= 1e-10 * (1.0 + std::abs(b)); }

}  // namespace

int main() {
  const abut::Model model = abut::Model::from_text({.starter = starter, .engines = {engine}, .name = "brick"});
  if (model.node_ids().size() != 8) return fail("the number of nodes", static_cast<double>(model.node_ids().size()), 8);
  const abut::ElementTable bricks = model.elements(abut::ElementKind::brick);
  if (bricks.size() != 1 || bricks.nodes_per_element != 8) return fail("the number of bricks", static_cast<double>(bricks.size()), 1);
  const abut::Inspection inspection = model.inspect();
  if (!close(inspection.part_mass[0], 2.0)) return fail("the mass of the part", inspection.part_mass[0], 2.0);

  abut::Run run(model, {.threads = 2});
  int seen = 0;
  run.advance_to(0.25, [&seen](abut::Run&) { return ++seen >= 0; });
  if (seen != run.cycle()) return fail("the number of calls", seen, static_cast<double>(run.cycle()));
  const double half = run.time();
  if (!close(run.balance().ke, 9.0)) return fail("the kinetic energy", run.balance().ke, 9.0);
  for (abut::Vec3& v : run.edit_velocities()) v *= 2.0;
  run.advance();
  const double turned = run.time() - run.step();
  run.advance_to_end();
  if (!run.is_over() || run.outcome().kind != abut::Outcome::Kind::finished) return fail("the outcome", 1, 0);
  const abut::Balance& b = run.balance();
  if (!close(b.ke, 36.0)) return fail("the kinetic energy after the change", b.ke, 36.0);
  if (!close(b.extw, 27.0)) return fail("the external work", b.extw, 27.0);
  if (!close(b.ledger, 0.0) || !close(b.err, 0.0)) return fail("the balance", b.err, 0.0);
  const double expected = 3.0 * half + 6.0 * (run.time() - turned);
  if (!close(run.displacements()[0].x, expected)) return fail("the displacement", run.displacements()[0].x, expected);
  for (const double s : run.element_field(abut::ElementKind::brick, "stress")) {
    if (std::abs(s) > 1e-9) return fail("the stress", s, 0.0);
  }
  const abut::History& history = run.history();
  if (history.rows() < 5 || history.names[0] != "time")
    return fail("the rows of the time history", static_cast<double>(history.rows()), 10);
  if (history.values[0] != 0.0) return fail("the first time", history.values[0], 0.0);

  try {
    (void)abut::Model::from_text(
        {.starter = std::string(starter).replace(std::string(starter).find("0.3"), 3, "0.7"), .engines = {engine}});
    return fail("the number of errors", 0, 1);
  } catch (const abut::InputError& error) { std::printf("consumer: as it should be: %s\n", error.what()); }
  std::printf("consumer: %s, %zu history columns\n", to_string(run.outcome()).c_str(), history.names.size());
  return 0;
}
