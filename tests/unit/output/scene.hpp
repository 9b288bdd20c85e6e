// A small model with one element of each shape, a made-up state, and a folder that goes away: what the output tests share.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cycle/sink.hpp"
#include "output/files.hpp"

namespace abut::test {

/// Reads a whole file.
inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream s;
  s << in.rdbuf();
  return s.str();
}

class TemporaryFolder {
 public:
  TemporaryFolder() {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() / ("abut_output_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A group whose output depends on the element's index in the model's table and on `scale` in a known way.
class FakeGroup final : public elements::Group {
 public:
  FakeGroup(model::ElementKind kind, Index part, std::vector<Index> members) : kind_(kind) {
    part_ = part;
    elements_ = std::move(members);
    deleted_.assign(elements_.size(), false);
  }
  static elements::ElementOutput expected(Index element, double scale) {
    elements::ElementOutput o;
    const double e = scale * (1.0 + element);
    o.internal_energy = 2.0 * e;
    o.membrane_energy = 1.5 * e;
    o.bending_energy = 0.5 * e;
    o.hourglass_energy = 0.25 * e;
    o.plastic_min = 0.01 * e;
    o.plastic_max = 0.02 * e;
    o.density = 7.0 + e;
    o.volume = 3.0 + e;
    o.thickness = 0.5 * e;
    o.pressure = -4.0 * e;
    o.von_mises = 40.0 * e;
    o.bulk_viscosity = 0.125 * e;
    for (std::size_t k = 0; k < 6; ++k) o.stress[k] = e * (10.0 + static_cast<double>(k));
    for (std::size_t k = 0; k < 8; ++k) o.resultants[k] = e * (100.0 + static_cast<double>(k));
    return o;
  }
  void remove(Index element) { deleted_[static_cast<std::size_t>(element)] = true; }
  double scale = 1.0;

  elements::Family family() const override { return elements::Family::inert; }
  elements::ElementNodes nodes(Index) const override { return {}; }
  model::ElementKind kind() const override { return kind_; }
  void add_masses(std::span<double>, std::span<double>) const override {}
  elements::GroupResult step(const elements::StepInput&, const elements::StepOutput&, parallel::ThreadPool&) override { return {}; }
  void set_rigid(std::span<const std::uint8_t>) override {}
  elements::ElementOutput output(Index element) const override {
    elements::ElementOutput o = expected(elements_[static_cast<std::size_t>(element)], scale);
    o.off = active(element) ? 1.0 : 0.0;
    return o;
  }
  bool active(Index element) const override { return !deleted_[static_cast<std::size_t>(element)]; }
  double thickness(Index) const override { return 0.0; }
  elements::PartSums part_sums(const Vec3*, const Vec3*, parallel::ThreadPool*) const override { return {}; }
  double element_mass(Index element) const override { return 4.0 + elements_[static_cast<std::size_t>(element)]; }
  double element_energy(Index) const override { return 0.0; }
  std::vector<std::span<double>> history() override { return {}; }

 private:
  model::ElementKind kind_;
  std::vector<bool> deleted_;
};

/// Two stacked unit cubes of nodes (ids 101 to 112) that carry one element of each shape, and results with values that
/// differ everywhere.
struct Scene {
  model::Model model;
  state::State state;
  state::Balance balance;
  std::vector<std::unique_ptr<elements::Group>> groups;
  std::vector<cycle::PartResult> parts;
  std::vector<cycle::InterfaceResult> interfaces;
  std::vector<Vec3> contact_normal, contact_tangential;
  std::vector<double> contact_area;
  std::vector<cycle::WallResult> walls;
  std::vector<cycle::BodyResult> bodies;
  std::vector<cycle::SectionResult> sections;
  std::vector<cycle::AccelerometerResult> accelerometers;

  Scene() {
    model.name = "scene";
    model.title = "one of each";
    model.controls.t_end = 1.0;
    for (int k = 0; k < 3; ++k) {
      for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
        model.node_id.push_back(101 + static_cast<Id>(model.node_id.size()));
        model.node_x.push_back({x, y, static_cast<double>(k)});
      }
    }
    model.materials.push_back({.id = 1, .title = "steel", .density = 8.0, .reference_density = 8.0, .law = model::LawElastic{210.0, 0.3}});
    model.properties.push_back({.id = 1, .title = "plate", .data = model::ShellProperty{}});
    model.properties.push_back({.id = 2, .title = "body", .data = model::SolidProperty{}});
    model.parts.push_back({.id = 11, .title = "shells", .property = 0, .material = 0});
    model.parts.push_back({.id = 22, .title = "solids", .property = 1, .material = 0});
    add(model.shells, 31, 0, {0, 1, 2, 3});
    add(model.sh3ns, 32, 0, {8, 9, 10});
    add(model.bricks, 41, 1, {0, 1, 2, 3, 4, 5, 6, 7});
    add(model.bricks, 42, 1, {4, 5, 6, 6, 8, 9, 10, 10});    // wedge
    add(model.bricks, 43, 1, {4, 4, 6, 6, 11, 11, 10, 10});  // tetrahedron
    add(model.tetras, 51, 1, {4, 6, 7, 11});
    groups.push_back(std::make_unique<FakeGroup>(model::ElementKind::shell4, 0, std::vector<Index>{0}));
    groups.push_back(std::make_unique<FakeGroup>(model::ElementKind::shell3, 0, std::vector<Index>{0}));
    groups.push_back(std::make_unique<FakeGroup>(model::ElementKind::brick, 1, std::vector<Index>{0, 1, 2}));
    groups.push_back(std::make_unique<FakeGroup>(model::ElementKind::tetra, 1, std::vector<Index>{0}));
    model.interfaces.resize(2);
    model.interfaces[0].id = 3;
    model.interfaces[0].title = "a with b";
    model.interfaces[1].id = 7;
    model.interfaces[1].type = model::InterfaceType5{};
    model.rigid_walls.emplace_back().id = 5;
    model.rigid_bodies.emplace_back().id = 6;
    model.rigid_bodies[0].main = 2;
    model.sections.emplace_back().id = 8;

    const std::size_t n = model.node_x.size();
    const auto vectors = [n](double seed) {
      std::vector<Vec3> v(n);
      for (std::size_t i = 0; i < n; ++i) {
        const double s = seed + 0.1 * static_cast<double>(i);
        v[i] = {s, -2.0 * s, 3.0 * s + 0.5};
      }
      return v;
    };
    state.u = vectors(0.01);
    state.v = vectors(1.0);
    state.w = vectors(2.0);
    state.a = vectors(3.0);
    state.alpha = vectors(4.0);
    state.f_internal = vectors(5.0);
    state.f_external = vectors(6.0);
    for (std::size_t i = 0; i < n; ++i) state.x.push_back(model.node_x[i] + state.u[i]);
    state.mass.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) state.mass[i] = 1.0 + static_cast<double>(i);
    contact_normal = vectors(7.0);
    contact_tangential = vectors(-8.0);
    contact_area.assign(n, 0.25);
    contact_area[2] = 0.0;
    parts.resize(2);
    interfaces.resize(2);
    walls.resize(1);
    bodies.resize(1);
    sections.resize(1);
    accelerometers.resize(1);
  }

  template <std::size_t N>
  static void add(model::Elements<N>& table, Id id, Index part, std::array<Index, N> nodes) {
    table.id.push_back(id);
    table.part.push_back(part);
    table.nodes.push_back(nodes);
    table.thickness.push_back(0.0);
  }
  FakeGroup& group(std::size_t g) { return static_cast<FakeGroup&>(*groups[g]); }

  cycle::Snapshot snapshot() {
    cycle::Snapshot s;
    s.model = &model;
    s.state = &state;
    s.balance = &balance;
    s.groups = groups;
    s.parts = parts;
    s.interfaces = interfaces;
    s.contact_normal = contact_normal;
    s.contact_tangential = contact_tangential;
    s.contact_area = contact_area;
    s.walls = walls;
    s.bodies = bodies;
    s.sections = sections;
    s.accelerometers = accelerometers;
    return s;
  }
};

}  // namespace abut::test
