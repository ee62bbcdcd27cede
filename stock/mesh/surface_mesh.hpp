// The surface of a solid as a closed triangle mesh with sharp edges.
//
// Model    : dual contouring of a tri-dexel sample. A cell whose corners are not all on one side
//            gets one vertex for each piece of surface in it; every grid edge that crosses the
//            surface becomes a quad of the four cells around it, split in two triangles. Watertight
//            and 2-manifold by construction, whatever the solid. What is folded over at the edges
//            of thin walls is mended (stock/mesh/unfold_surface.hpp)
// Units    : mm; frame: that of the solid
// Shape    : triangles run counter-clockwise seen from outside; all per-vertex arrays are as long
//            as `vertices` (`deviation` may be empty)
// Errors   : those of TriDexel::sample
// Accuracy : a VertexKind::surface vertex is on the exact surface as the solid's rays do (1 nm).
//            A ::feature vertex is where the planes of the adjoining faces meet: exact for flat
//            faces; for curved ones the planes are taken within a thousandth of the pitch of the
//            edge. Between vertices the triangles leave a surface of radius R by about
//            pitch^2 / (4 R). Walls and slits thinner than the pitch may be missing
//            (tests/stock/surface_mesh_test.cpp)
// Threads  : runs on oneTBB; the same bits for any number of threads
// Source   : Ju et al. 2002, SIGGRAPH (dual contouring, QEF); one vertex per surface piece as in
//            Schaefer, Ju, Warren 2007, IEEE TVCG 13(3); the choice at ambiguous faces is our own
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "core/units.hpp"
#include "stock/dexel/tri_dexel.hpp"
#include "stock/dexel/tri_dexel_solid.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::stock {

enum class VertexKind : std::uint8_t {
  surface,   // on a smooth part of the exact surface
  feature,   // on a sharp edge or corner: where its faces meet
  averaged,  // a mean: detail below the pitch, the exact surface was not found near by
};

struct SurfaceMesh {
  std::vector<Vec3> vertices{};
  std::vector<std::array<std::uint32_t, 3>> triangles{};
  std::vector<Vec3> normals{};  // unit, out of the material; at a feature the mean of its faces
  std::vector<VertexKind> kinds{};
  // mm from the nominal surface, outside positive; nothing: this vertex has no nominal; empty: none
  // has.
  std::vector<std::optional<double>> deviation{};
};

// The surface of what `dexels` sampled from `solid`.
[[nodiscard]] SurfaceMesh extract_surface(SolidView solid, const TriDexel& dexels);
// Samples `box` (of the blank) at `pitch` first.
[[nodiscard]] Result<SurfaceMesh> extract_surface(SolidView solid, const BoundingBox& box,
                                                  Mm pitch);

// mm^3, by the divergence theorem; means the enclosed one if the mesh is closed.
[[nodiscard]] double enclosed_volume(const SurfaceMesh& mesh);

struct MeshMeasure {
  double volume = 0.0;     // mm^3, as enclosed_volume() has it
  double area = 0.0;       // mm^2
  bool is_closed = false;  // no boundary edges
  bool is_manifold =
      false;  // every edge in at most two triangles, every vertex one fan, orientable
  std::size_t components = 0;
  std::size_t degenerate_triangles = 0;  // height below a millionth of the longest side
};

// Any indexed triangle mesh will do; only `vertices` and `triangles` are read. Precondition:
// indices are within range. (OpenMesh complains on stderr of a mesh that is not manifold.)
[[nodiscard]] MeshMeasure measure(const SurfaceMesh& mesh);

}  // namespace frustum::stock
