#include "support/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut::scenes {

using model::ElementKind;

std::vector<Index> Block::plane(int axis, bool high) const {
  std::vector<Index> out;
  for (int k = 0; k <= cells[2]; ++k) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int i = 0; i <= cells[0]; ++i) {
        const std::array<int, 3> p{i, j, k};
        const auto a = static_cast<std::size_t>(axis);
        if (p[a] == (high ? cells[a] : 0)) out.push_back(at(i, j, k));
      }
    }
  }
  return out;
}

Scene::Scene(std::string name) {
  model.name = std::move(name);
  model.version = 2022;
  model.controls.run_name = model.name;
}

Index Scene::add_node(const Vec3& x) {
  model.node_id.push_back(static_cast<Id>(model.node_id.size()) + 1);
  model.node_x.push_back(x);
  return static_cast<Index>(model.node_id.size()) - 1;
}

Index Scene::elastic(double density, double young, double poisson) {
  const Id id = static_cast<Id>(model.materials.size()) + 1;
  model.materials.push_back({id, "elastic", density, density, model::LawElastic{young, poisson}});
  return static_cast<Index>(id) - 1;
}

Index Scene::johnson_cook(double density, double young, double poisson, double a, double b, double n) {
  const Id id = static_cast<Id>(model.materials.size()) + 1;
  model::LawJohnsonCook law;
  law.young = young;
  law.poisson = poisson;
  law.a = a;
  law.b = b;
  law.n = n;
  model.materials.push_back({id, "plastic", density, density, law});
  return static_cast<Index>(id) - 1;
}

Index Scene::solid_property(int isolid) {
  const Id id = static_cast<Id>(model.properties.size()) + 1;
  model::SolidProperty p;
  p.isolid = isolid;
  model.properties.push_back({id, "solid", p});
  return static_cast<Index>(id) - 1;
}

Index Scene::linear_solid_property() {
  const Index index = solid_property();
  auto& p = std::get<model::SolidProperty>(model.properties[static_cast<std::size_t>(index)].data);
  p.ismstr = 1;
  p.qa = 0.0;
  p.qb = 0.0;
  return index;
}

Index Scene::shell_property(double thickness, int points) {
  const Id id = static_cast<Id>(model.properties.size()) + 1;
  model::ShellProperty p;
  p.thickness = thickness;
  p.points = points;
  model.properties.push_back({id, "shell", p});
  return static_cast<Index>(id) - 1;
}

Index Scene::part(Index property, Index material) {
  const Id id = static_cast<Id>(model.parts.size()) + 1;
  model.parts.push_back({id, "part", property, material, 0.0});
  return static_cast<Index>(id) - 1;
}

Block Scene::block(Index part, const Vec3& o, const Vec3& size, std::array<int, 3> n, const std::function<Vec3(const Vec3&)>& shape) {
  Block b;
  b.cells = n;
  for (int k = 0; k <= n[2]; ++k) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int i = 0; i <= n[0]; ++i) {
        const Vec3 p{o.x + size.x * i / n[0], o.y + size.y * j / n[1], o.z + size.z * k / n[2]};
        b.nodes.push_back(add_node(shape ? shape(p) : p));
      }
    }
  }
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        model.bricks.id.push_back(static_cast<Id>(model.bricks.id.size()) + 1);
        model.bricks.part.push_back(part);
        model.bricks.nodes.push_back({b.at(i, j, k), b.at(i + 1, j, k), b.at(i + 1, j + 1, k), b.at(i, j + 1, k), b.at(i, j, k + 1),
                                      b.at(i + 1, j, k + 1), b.at(i + 1, j + 1, k + 1), b.at(i, j + 1, k + 1)});
      }
    }
  }
  return b;
}

std::vector<Index> Scene::shells(Index part, int nu, int nv, const std::function<Vec3(double, double)>& shape, bool flip) {
  std::vector<Index> nodes;
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) nodes.push_back(add_node(shape(static_cast<double>(i) / nu, static_cast<double>(j) / nv)));
  }
  const auto at = [&](int i, int j) { return nodes[static_cast<std::size_t>(i + (nu + 1) * j)]; };
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      model.shells.id.push_back(static_cast<Id>(model.shells.id.size()) + 1);
      model.shells.part.push_back(part);
      model.shells.thickness.push_back(0.0);
      if (flip) {
        model.shells.nodes.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
      } else {
        model.shells.nodes.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return nodes;
}

void Scene::brick(Index part, const std::array<Index, 8>& nodes) {
  model.bricks.id.push_back(static_cast<Id>(model.bricks.id.size()) + 1);
  model.bricks.part.push_back(part);
  model.bricks.nodes.push_back(nodes);
}

Index Scene::surface(const std::vector<std::array<Index, 4>>& faces) {
  std::vector<std::vector<Index>> bricks_of(model.node_id.size());
  for (Index e = 0; e < model.bricks.size(); ++e) {
    for (const Index n : model.bricks.nodes[static_cast<std::size_t>(e)]) bricks_of[static_cast<std::size_t>(n)].push_back(e);
  }
  model::Surface s;
  s.id = static_cast<Id>(model.surfaces.size()) + 1;
  for (const auto& face : faces) {
    model::Segment segment;
    segment.nodes = face;
    for (const Index e : bricks_of[static_cast<std::size_t>(face[0])]) {
      const auto& nodes = model.bricks.nodes[static_cast<std::size_t>(e)];
      const bool owner =
          std::all_of(face.begin(), face.end(), [&nodes](Index n) { return std::find(nodes.begin(), nodes.end(), n) != nodes.end(); });
      if (owner) segment.element = {ElementKind::brick, e};
    }
    s.segments.push_back(segment);
  }
  model.surfaces.push_back(std::move(s));
  return static_cast<Index>(model.surfaces.size()) - 1;
}

Index Scene::surface(const Block& b, int axis, bool high) {
  model::Surface s;
  s.id = static_cast<Id>(model.surfaces.size()) + 1;
  const int a1 = (axis + 1) % 3;
  const int a2 = (axis + 2) % 3;
  std::vector<std::vector<Index>> bricks_of(model.node_x.size());
  for (Index e = 0; e < model.bricks.size(); ++e) {
    for (const Index n : model.bricks.nodes[static_cast<std::size_t>(e)]) bricks_of[static_cast<std::size_t>(n)].push_back(e);
  }
  for (int q = 0; q < b.cells[static_cast<std::size_t>(a2)]; ++q) {
    for (int p = 0; p < b.cells[static_cast<std::size_t>(a1)]; ++p) {
      const auto corner = [&](int dp, int dq) {
        std::array<int, 3> c{};
        c[static_cast<std::size_t>(axis)] = high ? b.cells[static_cast<std::size_t>(axis)] : 0;
        c[static_cast<std::size_t>(a1)] = p + dp;
        c[static_cast<std::size_t>(a2)] = q + dq;
        return b.at(c[0], c[1], c[2]);
      };
      model::Segment seg;
      seg.nodes = high ? std::array<Index, 4>{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}
                       : std::array<Index, 4>{corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)};
      for (const Index e : bricks_of[static_cast<std::size_t>(seg.nodes[0])]) {
        const auto& nodes = model.bricks.nodes[static_cast<std::size_t>(e)];
        int found = 0;
        for (const Index n : seg.nodes) {
          for (const Index m : nodes) found += n == m ? 1 : 0;
        }
        if (found == 4) seg.element = {ElementKind::brick, e};
      }
      s.segments.push_back(seg);
    }
  }
  model.surfaces.push_back(std::move(s));
  return static_cast<Index>(model.surfaces.size()) - 1;
}

Index Scene::shell_surface(Index part) {
  model::Surface s;
  s.id = static_cast<Id>(model.surfaces.size()) + 1;
  for (Index e = 0; e < model.shells.size(); ++e) {
    if (model.shells.part[static_cast<std::size_t>(e)] != part) continue;
    s.segments.push_back({model.shells.nodes[static_cast<std::size_t>(e)], {ElementKind::shell4, e}});
  }
  model.surfaces.push_back(std::move(s));
  return static_cast<Index>(model.surfaces.size()) - 1;
}

void Scene::velocity(const std::vector<Index>& nodes, const Vec3& v) {
  model.initial_velocities.push_back({static_cast<Id>(model.initial_velocities.size()) + 1, false, v, nodes});
}

Index Scene::rigid_body(const std::vector<Index>& nodes, const Vec3& centre) {
  model::RigidBody body;
  body.id = static_cast<Id>(model.rigid_bodies.size()) + 1;
  body.main = node(centre);
  body.nodes = nodes;
  model.rigid_bodies.push_back(body);
  return body.main;
}

void Scene::fix(const std::vector<Index>& nodes, std::array<bool, 3> translation, std::array<bool, 3> rotation) {
  model.boundary_conditions.push_back({static_cast<Id>(model.boundary_conditions.size()) + 1, translation, rotation, no_index, nodes});
}

Index Scene::function(std::vector<double> x, std::vector<double> y) {
  model.functions.push_back({static_cast<Id>(model.functions.size()) + 1, std::move(x), std::move(y)});
  return static_cast<Index>(model.functions.size()) - 1;
}

void Scene::load(const std::vector<Index>& nodes, int direction, double total, Index function) {
  model::ConcentratedLoad load;
  load.id = static_cast<Id>(model.concentrated_loads.size()) + 1;
  load.function = function;
  load.direction = direction;
  load.scale_y = total / static_cast<double>(nodes.size());
  load.nodes = nodes;
  model.concentrated_loads.push_back(std::move(load));
}

void Scene::traction(const Block& b, int axis, bool high, int direction, double total, Index function) {
  const auto p = static_cast<std::size_t>((axis + 1) % 3);
  const auto q = static_cast<std::size_t>((axis + 2) % 3);
  std::array<std::vector<Index>, 3> shared;  // by number of borders on which a node lies: quarter shares 4, 2, 1
  for (int k = 0; k <= b.cells[q]; ++k) {
    for (int j = 0; j <= b.cells[p]; ++j) {
      std::array<int, 3> c{};
      c[static_cast<std::size_t>(axis)] = high ? b.cells[static_cast<std::size_t>(axis)] : 0;
      c[p] = j;
      c[q] = k;
      const std::size_t borders = (j == 0 || j == b.cells[p] ? 1U : 0U) + (k == 0 || k == b.cells[q] ? 1U : 0U);
      shared[borders].push_back(b.at(c[0], c[1], c[2]));
    }
  }
  const double facet = total / (b.cells[p] * b.cells[q]);
  for (std::size_t borders = 0; borders < 3; ++borders) {
    const double share = facet / static_cast<double>(1U << borders);
    if (!shared[borders].empty()) load(shared[borders], direction, share * static_cast<double>(shared[borders].size()), function);
  }
}

void Scene::displacement(const std::vector<Index>& nodes, int direction, double value, Index function, Index skew) {
  model::ImposedMotion m;
  m.id = static_cast<Id>(model.imposed_motions.size()) + 1;
  m.kind = model::ImposedMotion::Kind::displacement;
  m.function = function;
  m.direction = direction;
  m.skew = skew;
  m.scale_y = value;
  m.nodes = nodes;
  model.imposed_motions.push_back(std::move(m));
}

Index Scene::skew_about_z(double angle) {
  const Id id = static_cast<Id>(model.skews.size()) + 1;
  model::Skew skew;
  skew.id = id;
  skew.axes = {Vec3{std::cos(angle), std::sin(angle), 0.0}, Vec3{-std::sin(angle), std::cos(angle), 0.0}, Vec3{0, 0, 1}};
  model.skews.push_back(skew);
  return static_cast<Index>(id) - 1;
}

void Scene::pressure(const std::vector<std::array<Index, 4>>& faces, double value, Index function) {
  model::PressureLoad load;
  load.id = static_cast<Id>(model.pressure_loads.size()) + 1;
  load.function = function;
  load.scale_y = -value;
  load.segments = faces;
  model.pressure_loads.push_back(std::move(load));
}

void Scene::gravity(int direction, double value) {
  model::Gravity g;
  g.id = static_cast<Id>(model.gravities.size()) + 1;
  g.direction = direction;
  g.scale_y = value;
  for (Index i = 0; i < model.node_count(); ++i) g.nodes.push_back(i);
  model.gravities.push_back(std::move(g));
}

Index Scene::contact(Index surface_1, Index surface_2, double stfac, double friction, double gap) {
  model::Interface i;
  i.id = static_cast<Id>(model.interfaces.size()) + 1;
  i.type = model::InterfaceType3{surface_1, surface_2, 0, 0};
  i.stfac = stfac;
  i.friction = friction;
  i.gap = gap;
  model.interfaces.push_back(std::move(i));
  return static_cast<Index>(model.interfaces.size()) - 1;
}

void Scene::history_node(Index node) {
  model.th_requests.push_back(
      {model::ThKind::node, model.node_id[static_cast<std::size_t>(node)], node, no_index, "", {"DX", "DY", "DZ", "VX", "VY", "VZ"}});
}

void Scene::end(double time, double history_interval, double step_scale) {
  model.controls.t_end = time;
  if (history_interval > 0.0) model.controls.history_interval = history_interval;
  model.controls.shell.scale = model.controls.sh3n.scale = step_scale;
  model.controls.brick.scale = model.controls.tetra.scale = step_scale;
  model.controls.print_every = 0;
}

}  // namespace abut::scenes
