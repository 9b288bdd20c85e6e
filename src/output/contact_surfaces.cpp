#include "output/contact_surfaces.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>

#include "core/diagnostic.hpp"

namespace abut::output {
namespace {

/// Surfaces on the two sides of an interface; no_index: a set of nodes.
std::array<Index, 2> surfaces_of(const model::Interface& card) {
  if (const auto* t3 = std::get_if<model::InterfaceType3>(&card.type)) return {t3->surface_1, t3->surface_2};
  if (const auto* t5 = std::get_if<model::InterfaceType5>(&card.type)) return {no_index, t5->surface};
  return {no_index, std::get<model::InterfaceType7>(card.type).surface};
}

}  // namespace

std::string contact_surfaces_vtu(const model::Model& model) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> node_id;
  node_id->SetName("node_id");
  points->SetNumberOfPoints(model.node_count());
  node_id->SetNumberOfValues(model.node_count());
  for (std::size_t n = 0; n < model.node_x.size(); ++n) {
    const auto i = static_cast<vtkIdType>(n);
    points->SetPoint(i, model.node_x[n].x, model.node_x[n].y, model.node_x[n].z);
    node_id->SetValue(i, model.node_id[n]);
  }
  std::array<vtkNew<vtkIdTypeArray>, 3> about;
  constexpr std::array<const char*, 3> names{"interface_id", "surface_id", "side"};
  for (std::size_t k = 0; k < names.size(); ++k) about[k]->SetName(names[k]);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(node_id);
  grid->Allocate(1);
  for (const model::Interface& card : model.interfaces) {
    const std::array<Index, 2> surfaces = surfaces_of(card);
    for (std::size_t side = 0; side < 2; ++side) {
      if (surfaces[side] == no_index) continue;
      const model::Surface& surface = model.surfaces[static_cast<std::size_t>(surfaces[side])];
      for (const model::Segment& segment : surface.segments) {
        const bool triangle = segment.nodes[3] == segment.nodes[2];
        const std::array<vtkIdType, 4> corners{segment.nodes[0], segment.nodes[1], segment.nodes[2], segment.nodes[3]};
        grid->InsertNextCell(triangle ? VTK_TRIANGLE : VTK_QUAD, triangle ? 3 : 4, corners.data());
        about[0]->InsertNextValue(card.id);
        about[1]->InsertNextValue(surface.id);
        about[2]->InsertNextValue(static_cast<vtkIdType>(side) + 1);
      }
    }
  }
  for (auto& array : about) grid->GetCellData()->AddArray(array);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw RunError("cannot encode the contact surfaces");
  return writer->GetOutputString();
}

}  // namespace abut::output
