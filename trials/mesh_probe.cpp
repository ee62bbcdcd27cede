#include "trials/mesh_probe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/counted.hpp"
#include "core/decimal.hpp"
#include "core/units.hpp"
#include "metrology/plan/point_scale.hpp"
#include "metrology/plan/strategy.hpp"
#include "stock/mesh/io/mesh_reader.hpp"
#include "stock/mesh/weld_mesh.hpp"

namespace frustum::trials {
namespace {

MeshProbe turned_over(const stock::FacetSolid& solid) {
  std::vector<Vec3> vertices(solid.vertices().begin(), solid.vertices().end());
  std::vector<stock::FacetSolid::Facet> facets(solid.facets().begin(), solid.facets().end());
  for (auto& facet : facets) std::swap(facet[1], facet[2]);
  return MeshProbe(stock::FacetSolid(std::move(vertices), std::move(facets)));
}

// What was done to the corners, where it moved any.
std::optional<Diagnostic> note_of(const stock::WeldedMesh& joined, double mm,
                                  const std::filesystem::path& file) {
  if (joined.moved == 0) return std::nullopt;
  const double um = joined.farthest * mm * kUmPerMm;
  std::string message = fmt::format(
      "{} of the mesh joined with others {} um away or less", counted(joined.moved, "corner"),
      um < 1.0 ? fixed_decimal(std::max(um, 0.001), 3) : fixed_decimal(um, um < 10.0 ? 1 : 0));
  if (joined.lost_facets > 0) {
    message += fmt::format("; {} without an area left out", counted(joined.lost_facets, "facet"));
  }
  Diagnostic note = warning("mesh-welded"_id, std::move(message));
  note.severity = Severity::note;
  note.file = file.string();
  return note;
}

}  // namespace

std::optional<metrology::Touch> MeshProbe::touch(const Vec3& start, const UnitVec3& direction,
                                                 double length_mm) const {
  const auto entry = solid_.first_entry({start, direction.vec()}, {0.0, length_mm});
  if (!entry) return std::nullopt;
  return metrology::Touch{start + entry->s * direction.vec(), solid_.normal(entry->facet)};
}

std::optional<Diagnostic> MeshProbe::facing_fault(const metrology::InspectionPlan& plan) const {
  const MeshProbe back = turned_over(solid_);
  const double way = plan.probe.clearance + plan.probe.reach;
  std::size_t all = 0, behind = 0;
  std::string first;
  for (const metrology::PlannedFeature& feature : plan.features) {
    for (const metrology::PlannedPoint& p : metrology::planned_points(feature)) {
      ++all;
      const Vec3 start = p.point + plan.probe.clearance * p.normal;
      if (!back.touch(start, metrology::unit(-p.normal), way) || behind++ > 0) continue;
      first = fmt::format("feature '{}' at [{:.3f}, {:.3f}, {:.3f}]", feature.name, p.point.x(),
                          p.point.y(), p.point.z());
    }
  }
  if (behind == 0) return std::nullopt;
  return error(
      "mesh-facing"_id,
      fmt::format("{} of the plan's {} points meet facets of the mesh from behind, first of all {}",
                  behind, all, first),
      "the mesh is inside out there: turn its facets so that they run counter-clockwise seen from "
      "outside the material; if they do, check `side` and axes of the plan");
}

Result<MeshProbe> read_mesh_probe(const std::filesystem::path& file,
                                  const std::optional<metrology::LengthUnit>& unit,
                                  const metrology::InspectionPlan& plan) {
  auto mesh = stock::read_mesh(file);
  if (!mesh) return std::move(mesh).error();
  auto joined = stock::welded(*std::move(mesh));  // before the unit hides single precision
  const double mm = unit ? unit->mm : 1.0;
  for (Vec3& vertex : joined.mesh.vertices) vertex *= mm;
  if (auto fault = metrology::scale_fault(plan, joined.mesh.vertices)) {
    fault->file = file.string();
    return *std::move(fault);
  }
  const std::optional<Diagnostic> note = note_of(joined, mm, file);
  return MeshProbe(
      stock::FacetSolid(std::move(joined.mesh.vertices), std::move(joined.mesh.triangles)), note);
}

}  // namespace frustum::trials
