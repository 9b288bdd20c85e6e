// Starter decks put together from their blocks, and their runs.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "abut/run.hpp"

namespace abut::small_decks {

inline constexpr double young = 210.0, poisson = 0.3, density = 7.8e-6;  // kg, mm, ms: kN/mm2

inline std::string ints(const std::vector<int>& fields) {
  std::string s;
  for (const int f : fields) s += fmt::format("{:>10}", f);
  return s + "\n";
}
inline std::string reals(const std::vector<double>& fields) {
  std::string s;
  for (const double f : fields) s += fmt::format("{:>20g}", f);
  return s + "\n";
}
inline std::string nodes(int first, const std::vector<Vec3>& x) {
  std::string s = "/NODE\n";
  for (const Vec3& p : x) s += fmt::format("{:>10}", first++) + reals({p.x, p.y, p.z});
  return s;
}
inline std::string element(const char* keyword, int part, int id, std::vector<int> corners) {
  corners.insert(corners.begin(), id);
  return fmt::format("/{}/{}\n", keyword, part) + ints(corners);
}
inline std::string part(int id, int property, int material, int subset = 0) {
  return fmt::format("/PART/{}\npart\n", id) + ints({property, material, subset});
}
inline std::string group(const char* keyword, int id, const std::vector<int>& members) {
  return fmt::format("/{}/{}\ngroup\n", keyword, id) + ints(members);
}
inline std::string bcs(const char* code, int nodes_of) {
  return fmt::format("/BCS/{}\nheld\n   {}         0", nodes_of, code) + ints({nodes_of});
}

inline const std::string unit_system = "                  kg                  mm                  ms\n";
/// Steel of small strain: property 1 bricks, 2 shells of 0.1 mm, 3 void of 0.1 mm, 4 bricks without viscosity; material 1 steel, 2 void.
inline const std::string materials =
    "#RADIOSS STARTER\n/BEGIN\nkeywords\n      2022         0\n" + unit_system + unit_system + "/MAT/ELAST/1\nsteel\n" + reals({density}) +
    reals({young, poisson}) + "/MAT/VOID/2\nvoid\n" + reals({density, young, poisson}) + "/PROP/SOLID/1\nbrick\n" +
    "         1         1                   0         0         0         0         0                   0\n" + reals({0, 0, 0}) +
    reals({0}) + "/PROP/SHELL/2\nshell\n" + "         1         1         0         0                                       0\n" +
    reals({0, 0, 0, 0, 0}) + "         0         0                 0.1                   0                   0         0\n" +
    "/PROP/VOID/3\nvoid\n" + reals({0.1}) + "/PROP/SOLID/4\nwithout viscosity\n" +
    "         1         1                   0         0         0         0         0                   0\n" +
    reals({1e-12, 1e-12, 1e-12}) + reals({0});

inline std::string engine(double end, const std::string& more = "/DT\n0.9 0.\n") {
  return fmt::format("/RUN/keywords/1\n{:g}\n/VERS/2022\n/TFILE/4\n{:g}\n/PRINT/-100\n/ANIM/DT\n0. {:g}\n", end, end / 20.0, end) + more;
}

inline abut::Run run_of(const std::string& starter, const std::string& engine_deck) {
  RunSettings settings;
  settings.threads = 1;
  settings.allow_findings = true;
  abut::Run run(Model::from_text({.starter = starter + "/END\n", .engines = {engine_deck}, .name = "keywords"}), settings);
  run.advance_to_end();
  EXPECT_EQ(run.outcome().kind, Outcome::Kind::finished) << run.outcome().message;
  return run;
}

/// Value of a column of the time history in a row, from 0.
inline double value(const abut::Run& run, const std::string& name, std::size_t row) {
  const History& h = run.history();
  const auto found = std::find(h.names.begin(), h.names.end(), name);
  if (found == h.names.end()) {
    ADD_FAILURE() << "no column " << name << " in " << fmt::format("{}", fmt::join(h.names, " "));
    return 0.0;
  }
  return h.values.at(row * h.names.size() + static_cast<std::size_t>(found - h.names.begin()));
}
inline double first(const abut::Run& run, const std::string& name) { return value(run, name, 0); }
inline double last(const abut::Run& run, const std::string& name) {
  return value(run, name, run.history().values.size() / run.history().names.size() - 1);
}

inline const std::vector<Vec3> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
inline const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

}  // namespace abut::small_decks
