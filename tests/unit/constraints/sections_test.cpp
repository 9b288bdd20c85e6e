#include "constraints/sections.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "unit/constraints/rig.hpp"

namespace abut::constraints::test {
namespace {

/// A group whose slots the test fills: bricks (4 components) or shells (8).
class FilledGroup : public elements::Group {
 public:
  FilledGroup(model::ElementKind kind, std::vector<Index> members, std::vector<std::vector<Index>> nodes, int components)
      : kind_(kind), nodes_(std::move(nodes)) {
    elements_ = std::move(members);
    layout_.nodes_per_element = static_cast<int>(nodes_[0].size());
    layout_.components = components;
    layout_.blocks = (size() + elements::lanes - 1) / elements::lanes;
  }
  [[nodiscard]] elements::Family family() const override { return elements::Family::inert; }
  [[nodiscard]] elements::ElementNodes nodes(Index e) const override { return std::span<const Index>(nodes_[static_cast<std::size_t>(e)]); }
  [[nodiscard]] model::ElementKind kind() const override { return kind_; }
  void add_masses(std::span<double>, std::span<double>) const override {}
  elements::GroupResult step(const elements::StepInput&, const elements::StepOutput&, parallel::ThreadPool&) override { return {}; }
  void set_rigid(std::span<const std::uint8_t>) override {}
  [[nodiscard]] elements::ElementOutput output(Index) const override { return {}; }
  [[nodiscard]] bool active(Index) const override { return true; }
  [[nodiscard]] double thickness(Index) const override { return 0.0; }
  [[nodiscard]] elements::PartSums part_sums(const Vec3*, const Vec3*, parallel::ThreadPool*) const override { return {}; }
  [[nodiscard]] double element_mass(Index) const override { return 0.0; }
  [[nodiscard]] double element_energy(Index) const override { return 0.0; }
  [[nodiscard]] std::vector<std::span<double>> history() override { return {}; }

 private:
  model::ElementKind kind_;
  std::vector<std::vector<Index>> nodes_;
};

void set(std::vector<double>& slots, const elements::Group& g, Index e, int node, const Vec3& f, const Vec3& m = {}) {
  for (int c = 0; c < 3; ++c) slots[g.layout().at(e, node, c)] = f[c];
  if (g.layout().components == 8) {
    for (int c = 0; c < 3; ++c) slots[g.layout().at(e, node, c + 4)] = m[c];
  }
}

/// A bar along z of two unit bricks under tension N: bottom nodes 0-3 at z = 0, 4-7 at z = 1, 8-11 at z = 2. The section cuts the
/// lower brick at its bottom nodes: the element pulls them along +z.
struct Bar {
  model::Model m = nodes_at(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}});
  std::vector<std::unique_ptr<elements::Group>> groups;
  std::vector<double> slots;
  state::State s;

  explicit Bar(int iframe) {
    groups.push_back(std::make_unique<FilledGroup>(model::ElementKind::brick, std::vector<Index>{0, 1},
                                                   std::vector<std::vector<Index>>{{0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 6, 7, 8, 9, 10, 11}},
                                                   4));
    model::Section card;
    card.id = 1;
    card.frame_nodes = {0, 1, 3};
    card.iframe = iframe;
    card.nodes = {0, 1, 2, 3};
    card.bricks = {0};
    m.sections.push_back(card);
    slots.resize(groups[0]->layout().size());
    // Internal force "to be subtracted": the element pulls its bottom nodes up, its top nodes down.
    for (Index e = 0; e < 2; ++e) {
      for (int k = 0; k < 8; ++k) set(slots, *groups[0], e, k, {0, 0, k < 4 ? -2.5 : 2.5});
    }
    s = state_of(m);
  }
};

TEST(Section, BarInTensionPullsItsSection) {
  Bar bar(0);
  Sections sections(bar.m, bar.groups);
  sections.gather(bar.s, bar.slots);
  sections.book_impulses(0.05);
  sections.gather(bar.s, bar.slots);
  sections.book_impulses(0.15);
  const SectionSums& r = sections.results()[0];
  EXPECT_EQ(r.normal_force, (Vec3{0, 0, 10}));
  EXPECT_EQ(r.tangential_force, (Vec3{}));
  EXPECT_NEAR(r.normal_impulse.z, 2.0, 1e-15);
  // About node 1, in the corner: M = sum x cross f = (5, -5, 0).
  EXPECT_EQ(r.moment, (Vec3{5, -5, 0}));
}

TEST(Section, MomentCentreAndAxesOfIframe) {
  for (const int iframe : {0, 1, 2, 3, 10, 11, 12, 13}) {
    Bar bar(iframe);
    bar.m.sections[0].frame_nodes = {1, 2, 0};  // x' along global y, z' along global z, y' = -x
    bar.s.mass[0] = 7.0;                        // centre of gravity at (0.2, 0.2, 0)
    Sections sections(bar.m, bar.groups);
    sections.gather(bar.s, bar.slots);
    const Vec3 c = iframe % 10 == 0 ? Vec3{1, 0, 0} : iframe % 10 == 1 ? Vec3{0.5, 0.5, 0} : iframe % 10 == 2 ? Vec3{0.2, 0.2, 0} : Vec3{};
    const Vec3 global = cross(Vec3{0.5, 0.5, 0} - c, Vec3{0, 0, 10});
    const Vec3 expected = iframe >= 10 ? global : Vec3{global.y, -global.x, global.z};
    EXPECT_LT(norm(sections.results()[0].moment - expected), 1e-14) << iframe;
    EXPECT_EQ(sections.results()[0].normal_force, (Vec3{0, 0, 10})) << iframe;
  }
}

TEST(Section, TurnsWithItsNodes) {
  Bar bar(0);
  for (auto& x : bar.s.x) x = {x.z, x.x, x.y};  // z -> x, x -> y, y -> z
  for (int k = 0; k < 8; ++k) set(bar.slots, *bar.groups[0], 0, k, {k < 4 ? -2.5 : 2.5, k < 4 ? -1.0 : 1.0, 0});
  Sections sections(bar.m, bar.groups);
  sections.gather(bar.s, bar.slots);
  EXPECT_EQ(sections.results()[0].normal_force, (Vec3{10, 0, 0}));
  EXPECT_EQ(sections.results()[0].tangential_force, (Vec3{0, 4, 0}));
}

// Shells carry nodal moments, elements that are not listed do not count, whatever the block and lane of the element.
TEST(Section, TakesListedShellsWithTheirMoments) {
  auto m = nodes_at({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  std::vector<Index> ids;
  std::vector<std::vector<Index>> nodes;
  for (Index e = 0; e < 12; ++e) {
    ids.push_back(e);
    nodes.push_back({0, 1, 2, 3});
  }
  std::vector<std::unique_ptr<elements::Group>> groups;
  groups.push_back(std::make_unique<FilledGroup>(model::ElementKind::shell4, ids, nodes, 8));
  groups[0]->set_slot_offset(16);
  std::vector<double> slots(16 + groups[0]->layout().size());
  for (Index e = 0; e < 12; ++e) {
    for (int k = 0; k < 4; ++k) set(slots, *groups[0], e, k, {-1.0 * e, 0, 0}, {0, -0.5 * e, 0});
  }
  model::Section card;
  card.iframe = 13;
  card.nodes = {1, 2};
  card.shells = {3, 10};
  m.sections.push_back(card);
  Sections sections(m, groups);
  sections.gather(state_of(m), slots);
  const SectionSums& r = sections.results()[0];
  EXPECT_EQ(r.tangential_force, (Vec3{26, 0, 0}));      // 2 nodes x (3 + 10), global axes without frame nodes
  EXPECT_EQ(r.moment, (Vec3{0, 2 * 0.5 * 13, -13.0}));  // nodal moments; node 2 at y = 1
}

}  // namespace
}  // namespace abut::constraints::test
