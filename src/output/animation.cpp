#include "output/animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include "core/diagnostic.hpp"
#include "output/animation_fields.hpp"
#include "output/cell_shape.hpp"
#include "output/column.hpp"
#include "output/contact_surfaces.hpp"
#include "output/element_lookup.hpp"
#include "output/vtu.hpp"

namespace abut::output {
namespace {

/// Single precision without overflow to infinity: a diverging run stays viewable.
float to_float(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(value > largest ? largest : (value < -largest ? -largest : value));
}

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

struct NamedColumn {
  std::string name;
  Column<float> values;
};

/// Calls visit(kind, table, index in it) for all elements in the order of the cells.
template <class Visit>
void each_element(const model::Model& model, Visit&& visit) {
  const auto table = [&visit](const auto& elements, model::ElementKind kind) {
    for (std::size_t e = 0; e < elements.id.size(); ++e) visit(kind, elements, e);
  };
  table(model.shells, model::ElementKind::shell4);
  table(model.sh3ns, model::ElementKind::shell3);
  table(model.bricks, model::ElementKind::brick);
  table(model.tetras, model::ElementKind::tetra);
}

CellShape shape_of(const model::Model& model, model::ElementKind kind, std::size_t e) {
  switch (kind) {
    case model::ElementKind::shell4: {
      const std::array<Index, 4>& n = model.shells.nodes[e];
      if (n[2] == n[3]) return {CellKind::triangle, {n[0], n[1], n[2]}, 3};
      return {CellKind::quadrilateral, {n[0], n[1], n[2], n[3]}, 4};
    }
    case model::ElementKind::shell3: {
      const std::array<Index, 3>& n = model.sh3ns.nodes[e];
      return {CellKind::triangle, {n[0], n[1], n[2]}, 3};
    }
    case model::ElementKind::brick:
      return brick_shape(model.bricks.nodes[e], model.node_x);
    default:
      return tetra_shape(model.tetras.nodes[e], model.node_x);
  }
}

}  // namespace

/// What a state has that the model does not: it lives until it is written.
struct Animation::Taken {
  explicit Taken(const cycle::Snapshot& now);
  /// The state as a grid. Values go with the arrays.
  [[nodiscard]] static VtuGrid grid(std::unique_ptr<Taken> taken);

 private:
  void take_nodes(const cycle::Snapshot& now, const std::vector<NodeField>& fields);
  void take_cells(const cycle::Snapshot& now, const std::vector<CellField>& fields);

  const model::Model* model_;
  double time_;
  std::int64_t cycle_;
  std::vector<Vec3> x_;  ///< empty: where the model has them
  std::vector<NamedColumn> nodes_, cells_;
  struct Cell {
    model::ElementKind kind;
    Index element;
  };
  std::vector<Cell> left_;  ///< the cells, where some elements are deleted
  bool all_there_ = true;
  std::size_t count_ = 0;  ///< of cells

  [[nodiscard]] Cell cell(std::size_t c) const;
};

Animation::Taken::Taken(const cycle::Snapshot& now) : model_(now.model), time_(now.state->times.t), cycle_(now.state->times.cycle) {
  const AnimationFields fields = select_animation_fields(now.model->controls.animation_fields);
  const auto& x = now.state->x;
  // At the start nothing has moved.
  if (x.size() != model_->node_x.size() || std::memcmp(x.data(), model_->node_x.data(), x.size() * sizeof(Vec3)) != 0) {
    x_.assign(x.begin(), x.end());
  }
  take_nodes(now, fields.nodes);
  take_cells(now, fields.cells);
}

void Animation::Taken::take_nodes(const cycle::Snapshot& now, const std::vector<NodeField>& fields) {
  std::array<double, 9> value{};
  std::array<float, 9> rounded{};
  for (const NodeField& field : fields) {
    Column<float> column(field.components);
    for (std::size_t n = 0; n < now.state->x.size(); ++n) {
      field.write(now, n, value.data());
      std::transform(value.begin(), value.begin() + field.components, rounded.begin(), to_float);
      column.add(rounded.data());
    }
    column.finish();
    nodes_.push_back({field.name, std::move(column)});
  }
}

void Animation::Taken::take_cells(const cycle::Snapshot& now, const std::vector<CellField>& fields) {
  const ElementLookup lookup(*model_, now.groups);
  for (const CellField& field : fields) cells_.push_back({field.name, Column<float>(field.components)});
  const auto is_there = [&](const ElementPlace& place) {
    return !place.exists() || now.groups[static_cast<std::size_t>(place.group)]->active(place.element);
  };
  each_element(*model_, [&](model::ElementKind kind, const auto&, std::size_t e) {
    all_there_ = all_there_ && is_there(lookup.find(kind, static_cast<Index>(e)));
  });
  std::array<double, 9> value{};
  std::array<float, 9> rounded{};
  each_element(*model_, [&](model::ElementKind kind, const auto&, std::size_t e) {
    const ElementPlace place = lookup.find(kind, static_cast<Index>(e));
    if (!is_there(place)) return;
    ElementSample sample;
    if (place.exists()) {
      const elements::Group& group = *now.groups[static_cast<std::size_t>(place.group)];
      sample.output = group.output(place.element);
      sample.mass = group.element_mass(place.element);
      sample.group = &group;
      sample.element = place.element;
      sample.state = now.state;
    }
    if (!all_there_) left_.push_back({kind, static_cast<Index>(e)});
    ++count_;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      fields[f].write(sample, value.data());
      std::transform(value.begin(), value.begin() + fields[f].components, rounded.begin(), to_float);
      cells_[f].values.add(rounded.data());
    }
  });
  for (NamedColumn& column : cells_) column.values.finish();
}

Animation::Taken::Cell Animation::Taken::cell(std::size_t c) const {
  if (!all_there_) return left_[c];
  std::size_t before = 0;
  Cell found{model::ElementKind::none, no_index};
  const auto look = [&](std::size_t size, model::ElementKind kind) {
    if (found.element == no_index && c < before + size) found = {kind, static_cast<Index>(c - before)};
    before += size;
  };
  look(model_->shells.id.size(), model::ElementKind::shell4);
  look(model_->sh3ns.id.size(), model::ElementKind::shell3);
  look(model_->bricks.id.size(), model::ElementKind::brick);
  look(model_->tetras.id.size(), model::ElementKind::tetra);
  return found;
}

VtuGrid Animation::Taken::grid(std::unique_ptr<Taken> taken) {
  using Type = VtuArray::Type;
  VtuGrid grid;
  const std::shared_ptr<Taken> t = std::move(taken);
  const model::Model& model = *t->model_;
  const std::size_t points = model.node_x.size(), cells = t->count_;
  grid.field_data = {VtuArray::of<double>("TimeValue", Type::float64, 1, 1, [time = t->time_](std::size_t) { return time; }),
                     VtuArray::of<std::int64_t>("cycle", Type::int64, 1, 1, [cycle = t->cycle_](std::size_t) { return cycle; })};
  const auto add = [](std::vector<VtuArray>& to, std::vector<NamedColumn>& columns) {
    for (NamedColumn& column : columns) {
      const auto values = std::make_shared<const Column<float>>(std::move(column.values));
      to.push_back(VtuArray::of<float>(column.name, Type::float32, values->components(), values->tuples(),
                                       [values](std::size_t i) { return values->value(i); }));
      if (values->components() == 6) to.back().component_names = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    }
    columns.clear();
  };
  grid.point_data = {VtuArray::of<std::int64_t>("node_id", Type::int64, 1, points, [&model](std::size_t n) { return model.node_id[n]; })};
  add(grid.point_data, t->nodes_);
  const auto with = [&model](const Cell& cell, const auto& use) {
    const auto e = static_cast<std::size_t>(cell.element);
    if (cell.kind == model::ElementKind::shell4) return use(model.shells, e);
    if (cell.kind == model::ElementKind::shell3) return use(model.sh3ns, e);
    if (cell.kind == model::ElementKind::brick) return use(model.bricks, e);
    return use(model.tetras, e);
  };
  grid.cell_data = {VtuArray::of<std::int64_t>("element_id", Type::int64, 1, cells,
                                               [t, with](std::size_t c) {
                                                 return with(t->cell(c), [](const auto& table, std::size_t e) { return table.id[e]; });
                                               }),
                    VtuArray::of<std::int64_t>("part_id", Type::int64, 1, cells, [t, with, &model](std::size_t c) {
                      const Index part = with(t->cell(c), [](const auto& table, std::size_t e) { return table.part[e]; });
                      return model.parts[static_cast<std::size_t>(part)].id;
                    })};
  add(grid.cell_data, t->cells_);
  const auto x = std::make_shared<const std::vector<Vec3>>(std::move(t->x_));
  grid.points = VtuArray::of<double>("Points", Type::float64, 3, points, [x, &model](std::size_t i) {
    const Vec3& at = (x->empty() ? model.node_x : *x)[i / 3];
    return i % 3 == 0 ? at.x : (i % 3 == 1 ? at.y : at.z);
  });

  const auto shape = [t, &model](std::size_t c) {
    const Cell cell = t->cell(c);
    return shape_of(model, cell.kind, static_cast<std::size_t>(cell.element));
  };
  struct Kind {
    std::uint8_t number, corners;
  };
  std::vector<Kind> all;
  all.reserve(cells);
  std::size_t corners = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    const CellShape s = shape(c);
    all.push_back({vtk_number(s.kind), static_cast<std::uint8_t>(s.count)});
    corners += static_cast<std::size_t>(s.count);
  }
  const auto kinds = std::make_shared<const std::vector<Kind>>(std::move(all));
  grid.connectivity = {
      "connectivity", Type::int32, 1, corners,
      [shape, c = std::size_t{0}, corner = 0, now = CellShape{CellKind::triangle, {}, 0}](std::size_t count, void* to) mutable {
        auto* out = static_cast<std::int32_t*>(to);
        for (std::size_t i = 0; i < count; ++i) {
          if (corner == now.count) {
            now = shape(c++);
            corner = 0;
          }
          out[i] = now.nodes[static_cast<std::size_t>(corner++)];
        }
      }};
  grid.offsets = VtuArray::of<std::int64_t>("offsets", Type::int64, 1, cells,
                                            [kinds, end = std::int64_t{0}](std::size_t c) mutable { return end += (*kinds)[c].corners; });
  grid.types = VtuArray::of<std::uint8_t>("types", Type::uint8, 1, cells, [kinds](std::size_t c) { return (*kinds)[c].number; });
  return grid;
}

Animation::Animation(RunFolder folder, Opening opening) : folder_(std::move(folder)), opening_(opening) {}
Animation::~Animation() = default;

void Animation::begin(const cycle::Snapshot&) {
  // States of an earlier run in this folder would be mistaken for this one's; those of a resumed run that lie beyond the
  // checkpoint are written again.
  std::error_code ignored;
  if (opening_ == Opening::fresh) std::filesystem::remove(folder_.animation_index(), ignored);
  if (opening_ == Opening::fresh) std::filesystem::remove(folder_.contact_surfaces(), ignored);
  if (opening_ == Opening::resumed && !times_.empty()) write_index(times_);
  std::set<std::filesystem::path> kept;
  for (std::size_t k = 0; k < times_.size(); ++k) kept.insert(folder_.animation_state(static_cast<int>(k)).filename());
  std::vector<std::filesystem::path> stale;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.animation_folder(), ignored)) {
    const std::string file = entry.path().filename().string();
    if (file.starts_with(folder_.name + "_") && file.ends_with(".vtu") && !kept.contains(file)) stale.push_back(entry.path());
  }
  for (const auto& path : stale) std::filesystem::remove(path, ignored);
}

void Animation::cycle(const cycle::Snapshot& now) {
  if (!now.animation_due) return;
  if (times_.empty()) create_folder(folder_.animation_folder());
  wait_for_writer();
  const model::Model* with_surfaces = times_.empty() && !now.model->interfaces.empty() ? now.model : nullptr;
  auto taken = std::make_unique<Taken>(now);
  times_.push_back(now.state->times.t);
  auto write = [this, with_surfaces, state = std::move(taken), times = times_]() mutable {
    write_vtu(folder_.animation_state(static_cast<int>(times.size()) - 1), Taken::grid(std::move(state)));
    write_index(times);
    if (with_surfaces != nullptr) write_vtu(folder_.contact_surfaces(), contact_surfaces(*with_surfaces));
  };
  try {
    writer_ = std::async(std::launch::async, std::move(write)).share();
  } catch (const std::system_error& error) {
    throw RunError(
        fmt::format("cannot make the thread that writes the animation ({}); raise the limit of processes or of memory "
                    "(ulimit -u, ulimit -v)",
                    error.what()));
  }
}

void Animation::wait_for_writer() {
  if (writer_.valid()) writer_.get();
}

void Animation::write_index(const std::vector<double>& times) const {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (std::size_t k = 0; k < times.size(); ++k) {
    const std::filesystem::path file = folder_.animation_state(static_cast<int>(k)).lexically_relative(folder_.directory);
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times[k], xml_escaped(file.generic_string()));
  }
  text += "  </Collection>\n</VTKFile>\n";
  write_atomically(folder_.animation_index(), text);
}

void Animation::persist(state::Archive& a) {
  wait_for_writer();
  a.growing(times_);
  if (a.loading()) {
    on_disk_ = times_.size();
    return;
  }
  for (; on_disk_ < times_.size(); ++on_disk_) {
    const std::filesystem::path state = folder_.animation_state(static_cast<int>(on_disk_));
    if (std::filesystem::exists(state)) sync_file(state);  // a state that the user has deleted is no reason to have no checkpoint
  }
}

void Animation::end(const cycle::Outcome&) { wait_for_writer(); }

}  // namespace abut::output
