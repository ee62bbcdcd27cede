// Where the vertex of one piece of surface goes.
//
// Model    : the point that is nearest, in least squares, to the tangent planes of the piece's
//            crossings (the quadratic error function), by SVD about their mean; directions that the
//            planes do not determine keep the mean. If the normals agree, the piece is smooth: the
//            mean is moved along its normal onto the exact surface. If not, there is an edge or a
//            corner: the planes are taken again where the surface is nearer to the solution, one
//            for each face, and so on, so that curved faces meet where they really do. A curved
//            smooth piece reveals itself then: its normals come to agree. A face that crosses no
//            edge of the cell is noticed because the others then do not meet on the surface, and
//            joins them. Where nothing of that ends on the surface, the vertex is the point of it
//            nearest to the mean along one of the samples' normals.
// Units    : mm
// Shape    : 1 to 12 samples of one piece, all on the edges of `cell`; the vertex stays within the
//            cell grown by `leave` times its size
// Errors   : none; where no surface is found, the mean, as VertexKind::averaged
// Accuracy : see surface_mesh.hpp
#pragma once

#include <optional>
#include <span>

#include "stock/dexel/tri_dexel_solid.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/mesh/surface_mesh_crossings.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::stock {

struct PlacedVertex {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  VertexKind kind = VertexKind::averaged;
};

// `near`: what may have cut around the cell, if that is known. Rays that leave its ball do without.
[[nodiscard]] PlacedVertex place_vertex(SolidView solid, std::span<const HermiteSample> samples,
                                        const BoundingBox& cell, double leave,
                                        cutter::SweptNear* near = nullptr);

// The surface that faces along `normal` (unit), at most `reach` away along it: the first that a
// probe meets which comes from outside, or, if that is another face, the one next to `point`.
[[nodiscard]] std::optional<HermiteSample> nearest_surface(
    SolidView solid, const Vec3& point, const Vec3& normal, double reach,
    const cutter::SweptCutter::Likely& likely = {});

}  // namespace frustum::stock
