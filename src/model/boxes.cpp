#include "model/boxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/sort_by_id.hpp"

namespace abut::model {

namespace {

constexpr double edge_tolerance = 1e-12;  ///< "on the box", relative to the box's size and place
constexpr int deepest_nesting = 100;

Vec3 read_point(Context& c, BlockReader& r, Index node, std::array<std::string_view, 3> names) {
  r.next_card();
  const Vec3 typed{r.real({1, 20}, names[0], dim::length), r.real({21, 40}, names[1], dim::length),
                   r.real({41, 60}, names[2], dim::length)};
  return node == no_index ? typed : c.model->node_x[static_cast<std::size_t>(node)];
}

}  // namespace

Boxes::Boxes(Context& c) : context_(&c) {
  for (const deck::Block& b : c.deck->blocks) {
    if (b.is(0, "BOX")) read(c, b);
  }
  sort_by_id(c, boxes_, places_, "/BOX", by_id_);
}

void Boxes::read(Context& c, const deck::Block& b) {
  Box box;
  if (b.is(1, "RECTA")) {
    box.kind = Box::Kind::cuboid;
  } else if (b.is(1, "CYLIN")) {
    box.kind = Box::Kind::cylinder;
  } else if (b.is(1, "SPHER")) {
    box.kind = Box::Kind::sphere;
  } else if (b.is(1, "BOX")) {
    box.kind = Box::Kind::list;
  } else {
    c.diagnostics->error("model.unknown_type", c.deck->place(b), "the types of /BOX are RECTA, CYLIN, SPHER and BOX");
    return;
  }
  BlockReader r(c, b, 2, true);
  box.id = r.id();
  if (box.kind == Box::Kind::list) {
    box.members = r.id_list("box_ID");
  } else {
    r.next_card();
    const auto node = [&](deck::Columns columns, std::string_view field) {
      return r.resolve(c.tables.nodes, r.integer(columns, field), "/NODE", columns, field);
    };
    const Index n1 = node({1, 10}, "N1");
    const Index n2 = box.kind == Box::Kind::sphere ? no_index : node({11, 20}, "N2");
    if (box.kind == Box::Kind::cuboid) {
      const Index skew = r.resolve(c.tables.skews, r.integer({21, 30}, "skew_ID"), "/SKEW", {21, 30}, "skew_ID");
      if (skew != no_index) box.axes = c.model->skews[static_cast<std::size_t>(skew)].axes;
    } else {
      box.diameter = r.real({31, 50}, "Diameter", dim::length);
      if (box.diameter <= 0.0)
        r.error("model.box_size", {31, 50}, "Diameter", fmt::format("the diameter is {:g}: it must be positive", box.diameter));
    }
    box.p1 = read_point(c, r, n1, {"X1", "Y1", "Z1"});
    if (box.kind != Box::Kind::sphere) box.p2 = read_point(c, r, n2, {"X2", "Y2", "Z2"});
    if (box.kind == Box::Kind::cylinder && box.p1 == box.p2) {
      r.error("model.box_size", {1, 60}, "X2", "the two end points of the axis coincide");
    }
  }
  box.place = r.place();
  places_.push_back(box.place);
  boxes_.push_back(std::move(box));
}

bool Boxes::inside(const Box& box, const Vec3& x) {
  const double scale = edge_tolerance * (norm(box.p1) + norm(box.p2) + box.diameter + norm(x));
  if (box.kind == Box::Kind::cuboid) {
    for (const Vec3& axis : box.axes) {
      const double a = dot(axis, box.p1);
      const double b = dot(axis, box.p2);
      const double s = dot(axis, x);
      if (s < std::min(a, b) - scale || s > std::max(a, b) + scale) return false;
    }
    return true;
  }
  const double radius = 0.5 * box.diameter + scale;
  if (box.kind == Box::Kind::sphere) return norm(x - box.p1) <= radius;
  const double length = norm(box.p2 - box.p1);
  const Vec3 axis = normalized(box.p2 - box.p1);
  const double along = dot(axis, x - box.p1);
  return along >= -scale && along <= length + scale && norm(x - box.p1 - along * axis) <= radius;
}

void Boxes::evaluate(Box& box) {
  const std::vector<Vec3>& x = context_->model->node_x;
  box.nodes.assign(x.size(), false);
  if (box.kind != Box::Kind::list) {
    for (std::size_t k = 0; k < x.size(); ++k) box.nodes[k] = inside(box, x[k]);
    return;
  }
  for (const bool removing : {false, true}) {
    for (const Id member : box.members) {
      if ((member < 0) != removing) continue;
      const Id id = std::abs(member);
      const std::vector<bool>* other = nodes_inside(id);
      if (other == nullptr && by_id_.count(id) == 0) {
        context_->diagnostics->error("model.unknown_reference", box.place, fmt::format("no /BOX with id {}", id));
      }
      for (std::size_t k = 0; other != nullptr && k < x.size(); ++k) {
        if ((*other)[k]) box.nodes[k] = !removing;
      }
    }
  }
}

const std::vector<bool>* Boxes::nodes_inside(Id id) {
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) return nullptr;
  Box& box = boxes_[static_cast<std::size_t>(found->second)];
  if (box.state == Box::State::in_progress || depth_ >= deepest_nesting) {
    context_->diagnostics->error("model.circular_reference", box.place, "the box contains itself, or boxes are nested too deeply");
    return nullptr;
  }
  if (box.state == Box::State::unknown) {
    box.state = Box::State::in_progress;
    ++depth_;
    evaluate(box);
    --depth_;
    box.state = Box::State::done;
  }
  return &box.nodes;
}

}  // namespace abut::model
