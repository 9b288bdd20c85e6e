#include "output/animation.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>
#include <utility>

#include "core/diagnostic.hpp"
#include "output/animation_fields.hpp"
#include "output/cell_shape.hpp"
#include "output/element_lookup.hpp"

namespace abut::output {
namespace {

constexpr std::array<const char*, 6> tensor_components{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

int vtk_type(CellKind kind) {
  switch (kind) {
    case CellKind::triangle: return VTK_TRIANGLE;
    case CellKind::quadrilateral: return VTK_QUAD;
    case CellKind::tetrahedron: return VTK_TETRA;
    case CellKind::wedge: return VTK_WEDGE;
    case CellKind::pyramid: return VTK_PYRAMID;
    case CellKind::hexahedron: return VTK_HEXAHEDRON;
  }
  return VTK_EMPTY_CELL;
}

/// Single precision without overflow to infinity: a diverging run stays viewable.
float to_float(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(value > largest ? largest : (value < -largest ? -largest : value));
}

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

template <typename Array>
Array* add_array(vtkDataSetAttributes* attributes, const std::string& name, int components, vtkIdType tuples) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  if (components == 6) {
    for (int c = 0; c < 6; ++c) array->SetComponentName(c, tensor_components[static_cast<std::size_t>(c)]);
  }
  attributes->AddArray(array);
  return array;
}

}  // namespace

/// Topology made once; the arrays are refilled for each state.
struct Animation::Grid {
  explicit Grid(const cycle::Snapshot& first);
  [[nodiscard]] std::string serialise(const cycle::Snapshot& now);

 private:
  void fill_points(const cycle::Snapshot& now);
  void fill_cells(const cycle::Snapshot& now);

  AnimationFields fields_;
  std::vector<ElementPlace> places_;  ///< per cell
  std::vector<Id> ids_, part_ids_;    ///< per cell
  vtkNew<vtkUnstructuredGrid> grid_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkDoubleArray> time_;
  vtkNew<vtkIdTypeArray> cycle_;
  std::vector<vtkFloatArray*> node_arrays_, cell_arrays_;  ///< owned by grid_
  vtkUnsignedCharArray* hidden_ = nullptr;                 ///< owned by grid_
};

Animation::Grid::Grid(const cycle::Snapshot& first) : fields_(select_animation_fields(first.model->controls.animation_fields)) {
  const model::Model& model = *first.model;
  const std::span<const Vec3> x = model.node_x;
  const ElementLookup lookup(model, first.groups);
  const Index cells = model.shells.size() + model.sh3ns.size() + model.bricks.size() + model.tetras.size();
  points_->SetDataTypeToDouble();
  points_->SetNumberOfPoints(model.node_count());
  grid_->SetPoints(points_);
  grid_->Allocate(cells);

  const auto add_table = [&](const auto& table, model::ElementKind kind, const auto& shape_of) {
    for (std::size_t e = 0; e < table.id.size(); ++e) {
      const Id part_id = model.parts[static_cast<std::size_t>(table.part[e])].id;
      const auto& nodes = table.nodes[e];
      const CellShape shape = shape_of(nodes);
      std::array<vtkIdType, 8> corners{};
      std::copy(shape.nodes.begin(), shape.nodes.end(), corners.begin());
      grid_->InsertNextCell(vtk_type(shape.kind), shape.count, corners.data());
      ids_.push_back(table.id[e]);
      part_ids_.push_back(part_id);
      places_.push_back(lookup.find(kind, static_cast<Index>(e)));
    }
  };
  add_table(model.shells, model::ElementKind::shell4, [](const std::array<Index, 4>& n) {
    if (n[2] == n[3]) return CellShape{CellKind::triangle, {n[0], n[1], n[2]}, 3};
    return CellShape{CellKind::quadrilateral, {n[0], n[1], n[2], n[3]}, 4};
  });
  add_table(model.sh3ns, model::ElementKind::shell3,
            [](const std::array<Index, 3>& n) { return CellShape{CellKind::triangle, {n[0], n[1], n[2]}, 3}; });
  add_table(model.bricks, model::ElementKind::brick, [x](const std::array<Index, 8>& n) { return brick_shape(n, x); });
  add_table(model.tetras, model::ElementKind::tetra, [x](const std::array<Index, 4>& n) { return tetra_shape(n, x); });

  auto* node_id = add_array<vtkIdTypeArray>(grid_->GetPointData(), "node_id", 1, model.node_count());
  for (Index n = 0; n < model.node_count(); ++n) node_id->SetValue(n, model.node_id[static_cast<std::size_t>(n)]);
  for (const NodeField& field : fields_.nodes) {
    node_arrays_.push_back(add_array<vtkFloatArray>(grid_->GetPointData(), field.name, field.components, model.node_count()));
  }
  auto* element_id = add_array<vtkIdTypeArray>(grid_->GetCellData(), "element_id", 1, cells);
  auto* part_id = add_array<vtkIdTypeArray>(grid_->GetCellData(), "part_id", 1, cells);
  for (std::size_t c = 0; c < ids_.size(); ++c) {
    element_id->SetValue(static_cast<vtkIdType>(c), ids_[c]);
    part_id->SetValue(static_cast<vtkIdType>(c), part_ids_[c]);
  }
  for (const CellField& field : fields_.cells) {
    cell_arrays_.push_back(add_array<vtkFloatArray>(grid_->GetCellData(), field.name, field.components, cells));
  }
  hidden_ = add_array<vtkUnsignedCharArray>(grid_->GetCellData(), vtkDataSetAttributes::GhostArrayName(), 1, cells);

  time_->SetName("TimeValue");
  time_->SetNumberOfTuples(1);
  cycle_->SetName("cycle");
  cycle_->SetNumberOfTuples(1);
  grid_->GetFieldData()->AddArray(time_);
  grid_->GetFieldData()->AddArray(cycle_);
}

void Animation::Grid::fill_points(const cycle::Snapshot& now) {
  const std::size_t count = now.state->x.size();
  std::array<double, 9> value{};
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3& x = now.state->x[n];
    points_->SetPoint(static_cast<vtkIdType>(n), x.x, x.y, x.z);
  }
  points_->Modified();
  for (std::size_t f = 0; f < fields_.nodes.size(); ++f) {
    const NodeField& field = fields_.nodes[f];
    const auto components = static_cast<std::size_t>(field.components);
    float* out = node_arrays_[f]->GetPointer(0);
    for (std::size_t n = 0; n < count; ++n) {
      field.write(now, n, value.data());
      for (std::size_t c = 0; c < components; ++c) *out++ = to_float(value[c]);
    }
    node_arrays_[f]->Modified();
  }
}

void Animation::Grid::fill_cells(const cycle::Snapshot& now) {
  std::array<double, 9> value{};
  for (std::size_t e = 0; e < places_.size(); ++e) {
    ElementSample sample;
    if (places_[e].exists()) {
      const elements::Group& group = *now.groups[static_cast<std::size_t>(places_[e].group)];
      sample.output = group.output(places_[e].element);
      sample.mass = group.element_mass(places_[e].element);
    }
    for (std::size_t f = 0; f < fields_.cells.size(); ++f) {
      const auto components = static_cast<std::size_t>(fields_.cells[f].components);
      fields_.cells[f].write(sample, value.data());
      float* out = cell_arrays_[f]->GetPointer(static_cast<vtkIdType>(e * components));
      for (std::size_t c = 0; c < components; ++c) out[c] = to_float(value[c]);
    }
    hidden_->SetValue(static_cast<vtkIdType>(e), sample.output.off == 0.0 ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  for (vtkFloatArray* array : cell_arrays_) array->Modified();
  hidden_->Modified();
}

std::string Animation::Grid::serialise(const cycle::Snapshot& now) {
  time_->SetValue(0, now.state->times.t);
  cycle_->SetValue(0, now.state->times.cycle);
  fill_points(now);
  fill_cells(now);
  grid_->Modified();
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid_);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw RunError(fmt::format("cannot encode the animation state at time {}", now.state->times.t));
  return writer->GetOutputString();
}

Animation::Animation(RunFolder folder) : folder_(std::move(folder)) {}
Animation::~Animation() = default;

void Animation::begin(const cycle::Snapshot& first) {
  // States of an earlier run in this folder would be mistaken for this one's.
  std::error_code ignored;
  std::filesystem::remove(folder_.animation_index(), ignored);
  std::vector<std::filesystem::path> stale;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.animation_folder(), ignored)) {
    const std::string file = entry.path().filename().string();
    if (file.starts_with(folder_.name + "_") && file.ends_with(".vtu")) stale.push_back(entry.path());
  }
  for (const auto& path : stale) std::filesystem::remove(path, ignored);
  grid_ = std::make_unique<Grid>(first);
}

void Animation::cycle(const cycle::Snapshot& now) {
  if (!now.animation_due) return;
  if (times_.empty()) create_folder(folder_.animation_folder());
  write_atomically(folder_.animation_state(static_cast<int>(times_.size())), grid_->serialise(now));
  times_.push_back(now.state->times.t);
  write_index();
}

void Animation::write_index() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const std::filesystem::path file = folder_.animation_state(static_cast<int>(k)).lexically_relative(folder_.directory);
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times_[k], xml_escaped(file.generic_string()));
  }
  text += "  </Collection>\n</VTKFile>\n";
  write_atomically(folder_.animation_index(), text);
}

void Animation::end(const cycle::Outcome&) { grid_.reset(); }

}  // namespace abut::output
