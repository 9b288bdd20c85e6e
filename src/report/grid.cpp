#include "report/grid.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <optional>

#include "core/diagnostic.hpp"

namespace abut::report {
namespace {

std::optional<Shape> shape_of(int vtk_type) {
  switch (vtk_type) {
    case VTK_TRIANGLE:
      return Shape::triangle;
    case VTK_QUAD:
      return Shape::quadrilateral;
    case VTK_TETRA:
      return Shape::tetrahedron;
    case VTK_PYRAMID:
      return Shape::pyramid;
    case VTK_WEDGE:
      return Shape::wedge;
    case VTK_HEXAHEDRON:
      return Shape::hexahedron;
    default:
      return std::nullopt;
  }
}

vtkIdType corners_of(Shape shape) {
  static constexpr vtkIdType count[] = {3, 4, 4, 5, 6, 8};
  return count[static_cast<std::size_t>(shape)];
}

[[noreturn]] void refuse(const std::filesystem::path& file, const char* why) { throw RunError(file.string() + ": " + why); }

void read(vtkXMLUnstructuredGridReader* reader, const std::filesystem::path& file, bool with_fields) {
  // What VTK says of a damaged file comes here instead of onto the console.
  bool faulty = false;
  vtkNew<vtkCallbackCommand> fault;
  fault->SetClientData(&faulty);
  fault->SetCallback([](vtkObject*, unsigned long, void* data, void*) { *static_cast<bool*>(data) = true; });
  reader->SetReaderErrorObserver(fault);
  reader->SetParserErrorObserver(fault);
  for (const unsigned long said : {vtkCommand::ErrorEvent, vtkCommand::WarningEvent}) {
    reader->AddObserver(said, fault);
    reader->GetExecutive()->AddObserver(said, fault);
  }
  if (reader->CanReadFile(file.c_str()) == 0) refuse(file, "not a readable animation state");
  reader->SetFileName(file.c_str());
  reader->UpdateInformation();
  if (!with_fields) {
    for (const char* const name : {"node_id"}) reader->SetPointArrayStatus(name, 1);
    for (int i = 0; i < reader->GetNumberOfPointArrays(); ++i) {
      const std::string name = reader->GetPointArrayName(i);
      if (name != "node_id") reader->SetPointArrayStatus(name.c_str(), 0);
    }
    for (int i = 0; i < reader->GetNumberOfCellArrays(); ++i) {
      const std::string name = reader->GetCellArrayName(i);
      if (!name.ends_with("_id") && name != "side") reader->SetCellArrayStatus(name.c_str(), 0);
    }
  }
  reader->Update();
  reader->RemoveObserver(fault);
  reader->GetExecutive()->RemoveObserver(fault);
  if (faulty || reader->GetErrorCode() != 0 || reader->GetOutput() == nullptr) refuse(file, "damaged animation state");
  vtkCellArray* cells = reader->GetOutput()->GetCells();
  if (cells != nullptr && !cells->IsValid()) refuse(file, "damaged animation state");
}

/// Shape and nodes of each cell. VTK hands on what the file says: numbers of corners and nodes are checked here.
class CellReader {
 public:
  CellReader(vtkUnstructuredGrid* from, const std::filesystem::path& file) : from_(from), file_(file) {}
  Shape next() {
    const std::optional<Shape> shape = shape_of(from_->GetCellType(cell_));
    if (!shape) refuse(file_, "a cell of a kind that abut does not write");
    from_->GetCellPoints(cell_++, corners_);
    if (corners_->GetNumberOfIds() != corners_of(*shape)) refuse(file_, "a cell with a wrong number of corners");
    for (const vtkIdType node : *corners_) {
      if (node < 0 || node >= from_->GetNumberOfPoints()) refuse(file_, "a cell with a corner that is no point of the file");
    }
    return *shape;
  }
  /// A number beyond the last corner gives the last.
  [[nodiscard]] Index corner(int k) const {
    return static_cast<Index>(corners_->GetId(std::min<vtkIdType>(k, corners_->GetNumberOfIds() - 1)));
  }

 private:
  vtkUnstructuredGrid* from_;
  const std::filesystem::path& file_;
  vtkNew<vtkIdList> corners_;
  vtkIdType cell_ = 0;
};

std::vector<Id> ids(vtkDataSetAttributes* attributes, const char* name) {
  std::vector<Id> out;
  vtkDataArray* array = attributes->GetArray(name);
  if (array == nullptr) return out;
  out.reserve(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) out.push_back(static_cast<Id>(array->GetComponent(i, 0)));
  return out;
}

std::vector<Field> fields(vtkDataSetAttributes* attributes) {
  std::vector<Field> out;
  for (int a = 0; a < attributes->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = attributes->GetArray(a);
    if (array == nullptr || array->GetName() == nullptr || std::string(array->GetName()).ends_with("_id")) continue;
    Field field{array->GetName(), array->GetNumberOfComponents(), {}};
    field.values.resize(static_cast<std::size_t>(array->GetNumberOfValues()));
    if (array->GetDataType() == VTK_FLOAT) {
      const auto* from = static_cast<const float*>(array->GetVoidPointer(0));
      std::copy(from, from + field.values.size(), field.values.begin());
    } else {
      for (std::size_t i = 0; i < field.values.size(); ++i) {
        const auto tuple = static_cast<vtkIdType>(i) / field.components;
        field.values[i] = static_cast<float>(array->GetComponent(tuple, static_cast<int>(i) % field.components));
      }
    }
    out.push_back(std::move(field));
  }
  return out;
}

}  // namespace

const Field* Grid::find(const std::vector<Field>& fields, const std::string& name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&name](const Field& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

Grid read_grid(const std::filesystem::path& file, bool with_fields) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read(reader, file, with_fields);
  vtkUnstructuredGrid* from = reader->GetOutput();
  Grid grid;
  if (vtkDataArray* time = from->GetFieldData()->GetArray("TimeValue")) grid.time = time->GetComponent(0, 0);
  if (vtkDataArray* cycle = from->GetFieldData()->GetArray("cycle")) grid.cycle = static_cast<std::int64_t>(cycle->GetComponent(0, 0));
  grid.points.resize(3 * static_cast<std::size_t>(from->GetNumberOfPoints()));
  for (vtkIdType n = 0; n < from->GetNumberOfPoints(); ++n) from->GetPoint(n, &grid.points[3 * static_cast<std::size_t>(n)]);
  grid.node_id = ids(from->GetPointData(), "node_id");

  const std::vector<Id> element = ids(from->GetCellData(), "element_id");
  const std::vector<Id> part = ids(from->GetCellData(), "part_id");
  const auto count = static_cast<std::size_t>(from->GetNumberOfCells());
  if (element.size() != count || part.size() != count) refuse(file, "no element_id or part_id");
  grid.cells.reserve(count);
  CellReader cells(from, file);
  for (std::size_t c = 0; c < count; ++c) {
    Cell cell{cells.next(), {}, element[c], part[c]};
    for (int k = 0; k < corners_of(cell.shape); ++k) cell.nodes[static_cast<std::size_t>(k)] = cells.corner(k);
    grid.cells.push_back(cell);
  }
  if (with_fields) {
    grid.node_fields = fields(from->GetPointData());
    grid.cell_fields = fields(from->GetCellData());
  }
  return grid;
}

std::vector<ContactSurface> read_contact_surfaces(const std::filesystem::path& file, const std::vector<Id>& node_id) {
  std::vector<ContactSurface> out;
  if (!std::filesystem::exists(file)) return out;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read(reader, file, false);
  vtkUnstructuredGrid* from = reader->GetOutput();
  if (ids(from->GetPointData(), "node_id") != node_id) refuse(file, "its nodes are not those of the animation");
  const std::vector<Id> interface = ids(from->GetCellData(), "interface_id");
  const std::vector<Id> surface = ids(from->GetCellData(), "surface_id");
  const std::vector<Id> side = ids(from->GetCellData(), "side");
  const auto count = static_cast<std::size_t>(from->GetNumberOfCells());
  if (interface.size() != count || surface.size() != count || side.size() != count) refuse(file, "arrays are missing");
  CellReader cells(from, file);
  for (std::size_t c = 0; c < count; ++c) {
    if (out.empty() || out.back().interface != interface[c] || out.back().side != side[c]) {
      out.push_back({interface[c], surface[c], static_cast<int>(side[c]), {}});
    }
    if (cells.next() > Shape::quadrilateral) refuse(file, "a cell of a kind that abut does not write");
    out.back().segments.push_back({cells.corner(0), cells.corner(1), cells.corner(2), cells.corner(3)});
  }
  return out;
}

}  // namespace abut::report
