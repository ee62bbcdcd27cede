// A mesh that is probed like a part: a scan, or another program's model.
//
// Model    : the first facet that the probe meets from outside, with the facet's own normal;
//            borders may be open, as scans have them
// Units    : mm
// Shape    : facets counter-clockwise seen from outside; corners that differ by rounding are made
//            one (stock/mesh/weld_mesh.hpp)
// Errors   : a file that cannot be read, a mesh whose size does not suit the plan, facets that are
//            met from behind
// Accuracy : that of the mesh: between corners its facets leave a surface of radius R by length^2 /
//            (8 R)
// Source   : ours
#pragma once

#include <filesystem>
#include <optional>

#include "core/result.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/points/length_unit.hpp"
#include "metrology/probing/surface_probe.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::trials {

class MeshProbe {
 public:
  explicit MeshProbe(stock::FacetSolid solid, std::optional<Diagnostic> note = std::nullopt)
      : solid_(std::move(solid)), note_(std::move(note)) {}

  // What was done to the mesh before it could be probed.
  [[nodiscard]] const std::optional<Diagnostic>& note() const { return note_; }

  [[nodiscard]] std::optional<metrology::Touch> touch(const Vec3& start, const UnitVec3& direction,
                                                      double length_mm) const;
  // Why the points of the plan miss the mesh, when they meet facets that face away from them.
  [[nodiscard]] std::optional<Diagnostic> facing_fault(const metrology::InspectionPlan& plan) const;

 private:
  stock::FacetSolid solid_;
  std::optional<Diagnostic> note_;
};

// STL, PLY or OBJ in mm, or in `unit`.
[[nodiscard]] Result<MeshProbe> read_mesh_probe(const std::filesystem::path& file,
                                                const std::optional<metrology::LengthUnit>& unit,
                                                const metrology::InspectionPlan& plan);

}  // namespace frustum::trials
