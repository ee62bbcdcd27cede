#include "app/mesh_probe.hpp"

#include "metrology/points/point_scale.hpp"
#include "stock/mesh_reader.hpp"

namespace frustum::app {

std::optional<metrology::Touch> MeshProbe::touch(const Vec3& start, const UnitVec3& direction,
                                                 double length_mm) const {
  const auto entry = solid_.first_entry({start, direction.vec()}, {0.0, length_mm});
  if (!entry) return std::nullopt;
  return metrology::Touch{start + entry->s * direction.vec(), solid_.normal(entry->facet)};
}

Result<MeshProbe> read_mesh_probe(const std::filesystem::path& file,
                                  const std::optional<metrology::LengthUnit>& unit,
                                  const metrology::InspectionPlan& plan) {
  auto mesh = stock::read_mesh(file);
  if (!mesh) return std::move(mesh).error();
  for (Vec3& vertex : mesh->vertices) vertex *= unit ? unit->mm : 1.0;
  if (auto fault = metrology::scale_fault(plan, mesh->vertices)) {
    fault->file = file.string();
    return *std::move(fault);
  }
  return MeshProbe(stock::FacetSolid(std::move(mesh->vertices), std::move(mesh->triangles)));
}

}  // namespace frustum::app
