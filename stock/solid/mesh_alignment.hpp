// A scanned part laid into its nominal shape: rigid best fit of points to facets.
//
// Model    : the pose P that makes the sum of squares of the distances of P x_i from their nearest
//            facets least; directions that the points do not tell stay as they are
// Units    : mm
// Shape    : any number of points, of which at most 20,000 at equal steps count; the nominal shape
//            has facets
// Errors   : no points; points that are so far away that the fit does not settle
// Accuracy : the last step moves no point by more than 1e-9 of the size of the part
//            (tests/stock/mesh_alignment_test.cpp); near the nominal shape: within some degrees,
//            and within half the distance to other faces
// Source   : Chen, Medioni 1992, Image and Vision Computing 10(3) (point to plane)
// Threads  : runs on oneTBB; the same bits for any number of threads
#pragma once

#include <span>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::stock {

struct MeshAlignment {
  Pose nominal_from_part{};
  int rounds = 0;
  double rms = 0.0;  // mm, of the points that count
};

[[nodiscard]] Result<MeshAlignment> laid_into(const FacetSolid& nominal,
                                              std::span<const Vec3> points);

}  // namespace frustum::stock
