#include "output/animation.hpp"

#include <fmt/format.h>
#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
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
#include <set>
#include <system_error>
#include <utility>

#include "core/diagnostic.hpp"
#include "output/animation_fields.hpp"
#include "output/cell_shape.hpp"
#include "output/contact_surfaces.hpp"
#include "output/element_lookup.hpp"

namespace abut::output {
namespace {

constexpr std::array<const char*, 6> tensor_components{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

int vtk_type(CellKind kind) {
  switch (kind) {
    case CellKind::triangle:
      return VTK_TRIANGLE;
    case CellKind::quadrilateral:
      return VTK_QUAD;
    case CellKind::tetrahedron:
      return VTK_TETRA;
    case CellKind::wedge:
      return VTK_WEDGE;
    case CellKind::pyramid:
      return VTK_PYRAMID;
    case CellKind::hexahedron:
      return VTK_HEXAHEDRON;
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

/// One state, as VTK takes it. It lives until it is written: states are rare and the grid takes as much memory as the run.
struct Animation::Grid {
  explicit Grid(const cycle::Snapshot& first);
  void take(const cycle::Snapshot& now);
  /// The state that was taken, as the content of a file.
  [[nodiscard]] std::string encoded() const;

 private:
  void fill_points(const cycle::Snapshot& now);
  void fill_cells(const cycle::Snapshot& now);

  AnimationFields fields_;
  vtkNew<vtkUnstructuredGrid> grid_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkDoubleArray> time_;
  vtkNew<vtkIdTypeArray> cycle_;
};

Animation::Grid::Grid(const cycle::Snapshot& first) : fields_(select_animation_fields(first.model->controls.animation_fields)) {
  points_->SetDataTypeToDouble();
  points_->SetNumberOfPoints(first.model->node_count());
  grid_->SetPoints(points_);
  time_->SetName("TimeValue");
  time_->SetNumberOfTuples(1);
  cycle_->SetName("cycle");
  cycle_->SetNumberOfTuples(1);
  grid_->GetFieldData()->AddArray(time_);
  grid_->GetFieldData()->AddArray(cycle_);
}

void Animation::Grid::fill_points(const cycle::Snapshot& now) {
  const std::size_t count = now.state->x.size();
  const auto tuples = static_cast<vtkIdType>(count);
  std::array<double, 9> value{};
  for (std::size_t n = 0; n < count; ++n) {
    const Vec3& x = now.state->x[n];
    points_->SetPoint(static_cast<vtkIdType>(n), x.x, x.y, x.z);
  }
  auto* node_id = add_array<vtkIdTypeArray>(grid_->GetPointData(), "node_id", 1, tuples);
  std::copy(now.model->node_id.begin(), now.model->node_id.end(), node_id->GetPointer(0));
  for (const NodeField& field : fields_.nodes) {
    const auto components = static_cast<std::size_t>(field.components);
    float* out = add_array<vtkFloatArray>(grid_->GetPointData(), field.name, field.components, tuples)->GetPointer(0);
    for (std::size_t n = 0; n < count; ++n) {
      field.write(now, n, value.data());
      for (std::size_t c = 0; c < components; ++c) *out++ = to_float(value[c]);
    }
  }
}

void Animation::Grid::fill_cells(const cycle::Snapshot& now) {
  const model::Model& model = *now.model;
  const std::span<const Vec3> x = model.node_x;
  const ElementLookup lookup(model, now.groups);
  const std::size_t all = model.shells.id.size() + model.sh3ns.id.size() + model.bricks.id.size() + model.tetras.id.size();
  const auto count = static_cast<vtkIdType>(all);
  auto* element_id = add_array<vtkIdTypeArray>(grid_->GetCellData(), "element_id", 1, count);
  auto* part_id = add_array<vtkIdTypeArray>(grid_->GetCellData(), "part_id", 1, count);
  std::vector<vtkFloatArray*> arrays;
  for (const CellField& field : fields_.cells) {
    arrays.push_back(add_array<vtkFloatArray>(grid_->GetCellData(), field.name, field.components, count));
  }
  vtkNew<vtkUnsignedCharArray> types;
  types->Allocate(count);
  vtkNew<vtkCellArray> cells;
  cells->Use32BitStorage();  // nodes have 32-bit indices
  cells->AllocateExact(count, 4 * (count + static_cast<vtkIdType>(model.bricks.id.size())));

  vtkIdType shown = 0;
  std::array<double, 9> value{};
  const auto add_table = [&](const auto& table, model::ElementKind kind, const auto& shape_of) {
    for (std::size_t e = 0; e < table.id.size(); ++e) {
      ElementSample sample;
      if (const ElementPlace place = lookup.find(kind, static_cast<Index>(e)); place.exists()) {
        const elements::Group& group = *now.groups[static_cast<std::size_t>(place.group)];
        sample.output = group.output(place.element);
        sample.mass = group.element_mass(place.element);
        sample.group = &group;
        sample.element = place.element;
        sample.state = now.state;
      }
      if (sample.output.off == 0.0) continue;
      const CellShape shape = shape_of(table.nodes[e]);
      std::array<vtkIdType, 8> corners{};
      std::copy(shape.nodes.begin(), shape.nodes.end(), corners.begin());
      cells->InsertNextCell(shape.count, corners.data());
      types->InsertNextValue(static_cast<unsigned char>(vtk_type(shape.kind)));
      element_id->SetValue(shown, table.id[e]);
      part_id->SetValue(shown, model.parts[static_cast<std::size_t>(table.part[e])].id);
      for (std::size_t f = 0; f < fields_.cells.size(); ++f) {
        const int components = fields_.cells[f].components;
        fields_.cells[f].write(sample, value.data());
        float* out = arrays[f]->GetPointer(shown * components);
        for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) out[c] = to_float(value[c]);
      }
      ++shown;
    }
  };
  add_table(model.shells, model::ElementKind::shell4, [](const std::array<Index, 4>& n) {
    if (n[2] == n[3]) return CellShape{CellKind::triangle, {n[0], n[1], n[2]}, 3};
    return CellShape{CellKind::quadrilateral, {n[0], n[1], n[2], n[3]}, 4};
  });
  add_table(model.sh3ns, model::ElementKind::shell3, [](const std::array<Index, 3>& n) {
    return CellShape{CellKind::triangle, {n[0], n[1], n[2]}, 3};
  });
  add_table(model.bricks, model::ElementKind::brick, [x](const std::array<Index, 8>& n) { return brick_shape(n, x); });
  add_table(model.tetras, model::ElementKind::tetra, [x](const std::array<Index, 4>& n) { return tetra_shape(n, x); });

  for (vtkIdTypeArray* ids : {element_id, part_id}) ids->SetNumberOfTuples(shown);
  for (vtkFloatArray* array : arrays) array->SetNumberOfTuples(shown);
  grid_->SetCells(types, cells);
}

void Animation::Grid::take(const cycle::Snapshot& now) {
  time_->SetValue(0, now.state->times.t);
  cycle_->SetValue(0, now.state->times.cycle);
  fill_points(now);
  fill_cells(now);
}

std::string Animation::Grid::encoded() const {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid_);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw RunError(fmt::format("cannot encode the animation state at time {}", time_->GetValue(0)));
  return writer->GetOutputString();
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
  auto grid = std::make_unique<Grid>(now);
  grid->take(now);
  times_.push_back(now.state->times.t);
  writer_ = std::async(std::launch::async, [this, with_surfaces, taken = std::move(grid), times = times_]() mutable {
              std::unique_ptr<Grid> grid = std::move(taken);
              write_atomically(folder_.animation_state(static_cast<int>(times.size()) - 1), grid->encoded());
              grid.reset();  // as large as the contact surfaces: never both at a time
              write_index(times);
              if (with_surfaces != nullptr) write_atomically(folder_.contact_surfaces(), contact_surfaces_vtu(*with_surfaces));
            }).share();
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
  if (a.loading()) return;
  for (; on_disk_ < times_.size(); ++on_disk_) sync_file(folder_.animation_state(static_cast<int>(on_disk_)));
}

void Animation::end(const cycle::Outcome&) { wait_for_writer(); }

}  // namespace abut::output
