// Cards of TYPE5 and TYPE7 as interfaces: stiffness, gaps, sensors, moved nodes, erosion (numerics.md 7.2, 7.4.7, 7.7.1).
#include "init/contact_setup.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "init/contact_inspection.hpp"
#include "model/build.hpp"

namespace abut::init {
namespace {

/// A plate of two shells 1 x 1 (thickness 0.02 and 0.04) at z = 0 and a shell (thickness 0.03, E = 3) above it at z = `height`.
struct Plates {
  model::Model m;
  model::InterfaceType7 t7;
  model::Interface card;

  explicit Plates(double height) {
    const auto node = [&](double x, double y, double z) {
      m.node_id.push_back(static_cast<Id>(m.node_id.size()) + 1);
      m.node_x.push_back({x, y, z});
    };
    for (const double y : {0.0, 1.0}) {
      for (const double x : {0.0, 1.0, 2.0}) node(x, y, 0.0);
    }
    for (const Vec3 p : {Vec3{0.3, 0.3, 0}, Vec3{1.3, 0.3, 0}, Vec3{1.3, 0.7, 0}, Vec3{0.3, 0.7, 0}}) node(p.x, p.y, height);
    for (const double young : {2.0, 3.0}) m.materials.push_back({1, "", 1.0, 1.0, model::LawElastic{young, 0.0}});
    for (const double t : {0.02, 0.04, 0.03}) {
      model::ShellProperty p;
      p.thickness = t;
      m.properties.push_back({1, "", p});
    }
    for (Index k = 0; k < 3; ++k) {
      m.parts.push_back({k + 1, "", k, k < 2 ? 0 : 1, 0.0});
      m.shells.id.push_back(k + 1);
      m.shells.part.push_back(k);
      m.shells.thickness.push_back(0.0);
    }
    m.shells.nodes = {{0, 1, 4, 3}, {1, 2, 5, 4}, {6, 7, 8, 9}};
    m.surfaces.push_back({1, "", {{{0, 1, 4, 3}, {model::ElementKind::shell4, 0}}, {{1, 2, 5, 4}, {model::ElementKind::shell4, 1}}}});
    t7.nodes = {6, 7, 8, 9};
    t7.surface = 0;
    t7.vis_f = 0.0;
    card.id = 1;
    card.stfac = 1.0;
  }
  void add() {
    card.type = t7;
    m.interfaces.push_back(card);
  }
  [[nodiscard]] state::State state() const {
    state::State s = state::State::zeros(m.node_count());
    for (std::size_t i = 0; i < s.x.size(); ++i) s.x[i] = m.node_x[i];
    s.mass.assign(s.x.size(), 1.0);
    return s;
  }
  /// z force on a node at `time`.
  [[nodiscard]] double force(RunInterface& r, Index node, double time = 0.0) const {
    const state::State s = state();
    std::vector<Vec3> f(s.x.size());
    std::vector<double> k(s.x.size());
    const contact::HostState host{s.x, s.v, s.mass, time, 0.0, 0.0};
    r.contact.search(host);
    (void)r.contact.evaluate(host, f, k);
    r.contact.commit(0.0);
    return f[static_cast<std::size_t>(node)].z;
  }
  double force(Index node) {
    add();
    state::State s = state();
    auto run = make_interfaces(m, Profile::standard(), {}, s);
    return force(run[0], node);
  }
};

double law(double k, double gap, double height) { return 0.5 * k * gap / height * (gap - height); }

TEST(Type7Setup, stiffness_rules) {
  // Node 6 lies over the first facet: K_m = 2 x 0.02; K_s = 3 x 0.03.
  const double main = 0.04, own = 0.09;
  const std::array<double, 6> expected{main, 2 * 0.7, 0.5 * (main + own), own, main, main * own / (main + own)};
  for (int istf = 0; istf <= 5; ++istf) {
    Plates p(0.05);
    p.t7.istf = istf;
    p.t7.gap_given = true;
    p.card.gap = 0.1;
    if (istf == 1) p.card.stfac = 0.7;
    EXPECT_NEAR(p.force(6), law(expected[static_cast<std::size_t>(istf)], 0.1, 0.05), 1e-14) << istf;
  }
  Plates p(0.05);
  p.t7.istf = 3;
  p.t7.st_max = 0.01;
  p.t7.gap_given = true;
  p.card.gap = 0.1;
  EXPECT_NEAR(p.force(6), law(0.01, 0.1, 0.05), 1e-14);
}

TEST(Type7Setup, gap_rules) {
  const auto force = [](double height, Index node, auto&& change) {
    Plates p(height);
    change(p);
    return p.force(node);
  };
  const double h = 0.005;
  // Igap 0: the mean thickness of the main shells; 1: the smallest is the least gap, halves of both sides count.
  EXPECT_NEAR(force(h, 6, [](Plates&) {}), law(0.04, 0.03, h), 1e-14);
  EXPECT_NEAR(force(h, 6, [](Plates& p) { p.t7.igap = 1; }), law(0.04, 0.025, h), 1e-14);
  EXPECT_NEAR(force(h, 7, [](Plates& p) { p.t7.igap = 1; }), law(0.08, 0.035, h), 1e-14);
  // 2: with the scale and the largest gap.
  const auto scaled = [](double largest) {
    return [largest](Plates& p) {
      p.t7.igap = 2;
      p.t7.gap_scale = 2.0;
      p.t7.gap_max = largest;
    };
  };
  EXPECT_NEAR(force(h, 7, scaled(1e30)), law(0.08, 0.07, h), 1e-14);
  EXPECT_NEAR(force(h, 7, scaled(0.06)), law(0.08, 0.06, h), 1e-14);
  // 3: nodes that are not on the main surface know no limit by the mesh.
  EXPECT_NEAR(force(h, 7, [](Plates& p) { p.t7.igap = 3, p.t7.mesh_size = 1e-3; }), law(0.08, 0.035, h), 1e-14);
  // No more than half of the shortest side.
  EXPECT_NEAR(force(h, 6, [](Plates& p) { std::get<model::ShellProperty>(p.m.properties[0].data).thickness = 3.0; }), law(6.0, 0.5, h),
              1e-12);
  // The part's virtual thickness takes the place of the property's in gaps.
  EXPECT_NEAR(force(h, 6, [](Plates& p) { p.m.parts[0].contact_thickness = 0.06; }), law(0.04, 0.05, h), 1e-14);
}

// With a sensor the interface is born when it fires; Tstart and Tstop do not count.
// Gapmin left blank is the mean thickness of the surface, 0.03: nodes that start at 0.02 are 0.01 within it, and the inspection says
// so. Inacti 5 begins with the gap that is there, and a given gap below the distance leaves nothing to say.
TEST(Type7Setup, initial_penetrations_are_found) {
  const auto found = [](double gap, int inacti) {
    Plates p(0.02);
    p.t7.gap_given = gap > 0.0;
    p.card.gap = gap;
    p.t7.inacti = inacti;
    p.add();
    for (const ContactFinding& c : inspect_contacts(p.m, {})) {
      if (c.finding.code == "contact.initial_penetration") return c;
    }
    return ContactFinding{};
  };
  const ContactFinding blank = found(0.0, 0);
  EXPECT_EQ(blank.finding.severity, contact::Severity::warning);
  EXPECT_EQ(blank.nodes, (std::vector<Id>{7, 8, 9, 10}));
  EXPECT_NEAR(blank.finding.measure, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(
      blank.finding.what,
      "4 nodes of this side start within the gap, the deepest 33.3 % of it; the gap of 0.03 follows from the thickness (Gapmin is not "
      "given)");
  const ContactFinding given = found(0.021, 0);
  EXPECT_EQ(given.finding.severity, contact::Severity::note);
  EXPECT_NEAR(given.finding.measure, 0.001 / 0.021, 1e-12);
  EXPECT_TRUE(found(0.0, 5).nodes.empty());
  EXPECT_TRUE(found(0.019, 0).nodes.empty());
}

TEST(Type7Setup, sensor_is_the_birth) {
  Plates p(0.005);
  p.m.sensors.push_back({1, 2.0, 3.0});
  p.card.sensor = 0;
  p.card.t_start = 0.0;
  p.card.t_stop = 1.0;
  p.add();
  state::State s = p.state();
  auto run = make_interfaces(p.m, Profile::standard(), {}, s);
  EXPECT_EQ(p.force(run[0], 6, 0.5), 0.0);
  EXPECT_GT(p.force(run[0], 6, 2.5), 0.0);
  EXPECT_EQ(p.force(run[0], 6, 3.5), 0.0);
}

// Inacti 3 and 4 move the model's nodes once, with a note; left out, the set-up refuses.
TEST(Settle, moves_nodes_and_says_so) {
  for (const int inacti : {3, 4}) {
    Plates p(0.005);
    p.t7.inacti = inacti;
    p.t7.gap_given = true;
    p.card.gap = 0.02;
    p.add();
    state::State s = p.state();
    EXPECT_THROW((void)make_interfaces(p.m, Profile::standard(), {}, s), std::logic_error);
    Diagnostics findings;
    settle_initial_penetrations(p.m, findings);
    ASSERT_EQ(findings.all().size(), 1u);
    EXPECT_EQ(findings.all()[0].code, "init.nodes_moved");
    EXPECT_NE(findings.all()[0].message.find("the farthest by 0.015"), std::string::npos) << findings.all()[0].message;
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(p.m.node_x[i].z, inacti == 4 ? -0.015 : 0.0, 1e-9);
    for (std::size_t i = 6; i < 10; ++i) EXPECT_NEAR(p.m.node_x[i].z, inacti == 3 ? 0.02 : 0.005, 1e-9);
    s = p.state();
    auto run = make_interfaces(p.m, Profile::standard(), {}, s);
    EXPECT_EQ(p.force(run[0], 6), 0.0);
  }
  Plates five(0.005);
  model::InterfaceType5 t5;
  t5.nodes = {6, 7, 8, 9};
  t5.surface = 0;
  t5.inacti = 3;
  five.card.gap = 0.02;
  five.card.stfac = 0.2;
  five.card.type = t5;
  five.m.interfaces.push_back(five.card);
  Diagnostics findings;
  settle_initial_penetrations(five.m, findings);
  for (std::size_t i = 6; i < 10; ++i) EXPECT_NEAR(five.m.node_x[i].z, 0.02, 1e-9);
}

/// A solid of `keyword` with E = 2 on nodes 1 to 6 (a half cube), below a plate that it touches as interfaces of all types.
std::string block_under_a_plate(const std::string& keyword, const std::vector<int>& nodes) {
  const auto card = [](const std::vector<std::string>& fields, int width) {
    std::string s;
    for (const std::string& f : fields) s += fmt::format("{:>{}}", f, width);
    return s + "\n";
  };
  const auto node = [&](int id, const char* x, const char* y, const char* z) {
    return card({std::to_string(id)}, 10).substr(0, 10) + card({x, y, z}, 20);
  };
  std::string deck = "/BEGIN\nblock\n      2022\n" + card({"kg", "m", "s"}, 20) + card({"kg", "m", "s"}, 20) + "/NODE\n";
  deck += node(1, "0", "0", "0") + node(2, "1", "0", "0") + node(3, "1", "1", "0") + node(4, "0", "1", "0");
  deck += node(5, "0", "0", "1") + node(6, "1", "0", "1") + node(7, "1", "1", "1");
  deck += node(11, "-1", "-1", "1.05") + node(12, "2", "-1", "1.05") + node(13, "2", "2", "1.05") + node(14, "-1", "2", "1.05");
  deck += "/MAT/ELAST/1\nm\n" + card({"1"}, 20) + card({"2", ".25"}, 20);
  deck += "/PROP/SOLID/1\np\n" + card({"1"}, 10) + "/PROP/SHELL/2\np\n" + card({"1"}, 10) + "\n" + card({"0", "0", "", ".1"}, 10);
  deck += "/PART/1\nblock\n" + card({"1", "1"}, 10) + "/PART/2\nplate\n" + card({"2", "1"}, 10);
  deck += "/" + keyword + "/1\n         1";
  for (const int n : nodes) deck += fmt::format("{:>10}", n);
  deck += "\n/SHELL/2\n" + card({"2", "11", "14", "13", "12"}, 10) + "/SURF/PART/EXT/1\nblock\n" + card({"1"}, 10);
  deck += "/SURF/PART/2\nplate\n" + card({"2"}, 10) + "/GRNOD/PART/1\nblock\n" + card({"1"}, 10);
  deck += "/INTER/TYPE3/1\nt\n" + card({"1", "2"}, 10) + card({"0", "0", ".1"}, 20);
  deck += "/INTER/TYPE5/2\nt\n" + card({"1", "2"}, 10) + card({"0", "0", ".1"}, 20);
  deck += "/INTER/TYPE7/3\nt\n" + card({"1", "2"}, 10) + "\n\n" + card({"0", "0", ".1"}, 20);
  return deck + "/END\n";
}

// Degenerate solids have sides that are no faces; their nodes are pressed down by the plate like those of any other.
TEST(DegenerateSolids, touch_in_interfaces_of_every_type) {
  const std::vector<std::pair<std::string, std::vector<int>>> solids{{"PENTA6", {1, 2, 3, 5, 6, 7}},
                                                                     {"BRICK", {1, 2, 3, 5, 6, 7}},
                                                                     {"BRICK", {1, 2, 3, 1, 5, 6, 7, 5}},
                                                                     {"BRICK", {1, 2, 3, 4, 5, 5, 5, 5}},
                                                                     {"BRICK", {1, 2, 3, 5}}};
  for (const auto& [keyword, nodes] : solids) {
    SCOPED_TRACE(keyword + fmt::format(" {}", fmt::join(nodes, " ")));
    Diagnostics findings;
    deck::DeckPair decks;
    decks.starter = deck::read_starter_text(block_under_a_plate(keyword, nodes), "t_0000.rad", findings);
    const model::Model m = model::build(decks, findings);
    for (const Diagnostic& d : findings.all()) EXPECT_NE(d.severity, Severity::error) << to_string(d);
    state::State s = state::State::zeros(m.node_count());
    s.x = m.node_x;
    s.mass.assign(s.x.size(), 1.0);
    auto run = make_interfaces(m, Profile::standard(), {}, s);
    ASSERT_EQ(run.size(), 3u);
    for (RunInterface& r : run) {
      std::vector<Vec3> f(s.x.size());
      std::vector<double> k(s.x.size());
      const contact::HostState host{s.x, s.v, s.mass, 0.0, 0.0, 0.0};
      r.contact.search(host);
      (void)r.contact.evaluate(host, f, k);
      EXPECT_LT(f[4].z, 0.0);  // node 5, at the top of all of them
      EXPECT_TRUE(std::isfinite(f[4].z));
    }
  }
}

// Nodes without a live element leave the interface, unless Idel is negative.
TEST(Erosion, held_nodes_leave_with_their_elements) {
  for (const int idel : {1, -1}) {
    Plates p(0.005);
    p.card.idel = idel;
    p.add();
    state::State s = p.state();
    auto run = make_interfaces(p.m, Profile::standard(), {}, s);
    EXPECT_GT(p.force(run[0], 6), 0.0);
    update_erosion(p.m, run, [](const model::ElementRef& e) { return e.index != 2; });
    EXPECT_EQ(p.force(run[0], 6) > 0.0, idel == -1);
    update_erosion(p.m, run, [](const model::ElementRef& e) { return e.index != 0; });
    EXPECT_EQ(p.force(run[0], 6), 0.0);  // over the dead facet (Idel 1: never comes back)
    EXPECT_GT(p.force(run[0], 7), 0.0);  // over the other
  }
}

}  // namespace
}  // namespace abut::init
