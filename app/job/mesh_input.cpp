#include "app/job/mesh_input.hpp"

#include <fmt/format.h>

#include "stock/mesh/io/mesh_reader.hpp"
#ifdef FRUSTUM_WITH_CGAL
#include "stock/polyhedral/mesh_faults.hpp"
#endif

namespace frustum::app {
namespace {

Diagnostics faults_of(const stock::SurfaceMesh& mesh) {
#ifdef FRUSTUM_WITH_CGAL
  return stock::mesh_faults(mesh);
#else
  (void)mesh;
  return {error("not-built-in"_id,
                "this Frustum was built without CGAL, which checks that a mesh bounds one body",
                "build with -DFRUSTUM_WITH_CGAL=ON")};
#endif
}

}  // namespace

std::shared_ptr<const stock::FacetSolid> read_closed_mesh(const TomlTable& table,
                                                          std::string_view key,
                                                          const Vec3& origin) {
  if (table.text(key).empty()) return nullptr;
  const auto file = table.file_path(key);
  auto mesh = stock::read_mesh(file);
  if (!mesh) {
    const Diagnostic& fault = mesh.error().front();
    const std::string line = fault.line > 0 ? fmt::format(", line {}", fault.line) : std::string();
    table.fail(key, fault.id, fmt::format("{}{}: {}", file.string(), line, fault.message),
               fault.hint);
    return nullptr;
  }
  const Diagnostics faults = faults_of(*mesh);
  for (const Diagnostic& fault : faults) {
    table.fail(key, fault.id, fmt::format("{}: {}", file.string(), fault.message), fault.hint);
  }
  if (!faults.empty()) return nullptr;
  for (Vec3& v : mesh->vertices) v += origin;
  return std::make_shared<const stock::FacetSolid>(std::move(mesh->vertices),
                                                   std::move(mesh->triangles));
}

}  // namespace frustum::app
