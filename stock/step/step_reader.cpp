#include "stock/step/step_reader.hpp"

#include <fmt/format.h>

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <cmath>

namespace frustum::stock {
namespace {

Diagnostic in_file(const std::filesystem::path& file, DiagnosticId id, std::string what,
                   std::string hint) {
  Diagnostic failure = error(id, std::move(what), std::move(hint));
  failure.file = file.string();
  return failure;
}

void add_face(const TopoDS_Face& face, SurfaceMesh& mesh) {
  TopLoc_Location place;
  const Handle(Poly_Triangulation) found = BRep_Tool::Triangulation(face, place);
  if (found.IsNull()) return;
  const gp_Trsf moved = place.Transformation();
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 1; i <= found->NbNodes(); ++i) {
    const gp_Pnt p = found->Node(i).Transformed(moved);
    mesh.vertices.emplace_back(p.X(), p.Y(), p.Z());
  }
  const bool is_turned =
      (face.Orientation() == TopAbs_REVERSED) != (moved.VectorialPart().Determinant() < 0.0);
  for (int i = 1; i <= found->NbTriangles(); ++i) {
    int a = 0, b = 0, c = 0;
    found->Triangle(i).Get(a, b, c);
    if (is_turned) std::swap(b, c);
    const auto corner = [first](int node) { return first + static_cast<std::uint32_t>(node) - 1; };
    mesh.triangles.push_back({corner(a), corner(b), corner(c)});
  }
}

Result<SurfaceMesh> mesh_of(const std::filesystem::path& file, double deflection) {
  STEPControl_Reader reader;
  if (reader.ReadFile(file.string().c_str()) != IFSelect_RetDone) {
    return in_file(file, "step-unreadable"_id, "this is no STEP file that can be read",
                   "export the model as STEP AP203, AP214 or AP242");
  }
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull()) {
    return in_file(file, "step-empty"_id, "the file holds no shape", "export solids, not drawings");
  }
  // Turns too, for the deflection of small radii.
  constexpr double kMostTurn = 0.2;  // rad
  const BRepMesh_IncrementalMesh meshing(shape, deflection, false, kMostTurn, true);
  SurfaceMesh mesh;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
    add_face(TopoDS::Face(at.Current()), mesh);
  }
  if (!meshing.IsDone() || mesh.triangles.empty()) {
    return in_file(file, "step-empty"_id, "the file holds no faces that can be meshed",
                   "export solids, not curves or points");
  }
  return mesh;
}

}  // namespace

Result<SurfaceMesh> read_step(const std::filesystem::path& file, Mm deflection) {
  if (!std::isfinite(deflection.value) || !(deflection.value > 0.0)) {
    return in_file(file, "out-of-range"_id,
                   fmt::format("a deflection of {:g} mm: it must be above 0", deflection.value),
                   "for example 1um");
  }
  if (std::error_code failure; !std::filesystem::is_regular_file(file, failure)) {
    return in_file(file, "file-unreadable"_id, "there is no such file", "check its name");
  }
  // It would write to standard output, which is for documents.
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {  // the library's way of saying that a file is damaged
    return mesh_of(file, deflection.value);
  } catch (const Standard_Failure& failure) {
    return in_file(file, "step-unreadable"_id,
                   fmt::format("the file cannot be read: {}", failure.GetMessageString()),
                   "export the model again");
  }
}

}  // namespace frustum::stock
