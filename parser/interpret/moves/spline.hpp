// Splines of the plane as straight lines and arcs that join without a corner.
//
// Model    : a rational B-spline of control points with weights, order k (degree k - 1), knots
//            clamped at both ends, uniform where none are given; k points of weight 1 are a Bezier
//            curve. Each part of it is replaced by two arcs with its ends and its tangents there
//            (a biarc), in halves until they are near enough
// Units    : mm
// Shape    : at least `order` points, order >= 2, weights above zero; as many knots as points and
//            the order together, none below the one before it, or none at all
// Errors   : none; points that coincide give no pieces
// Accuracy : `tolerance` between the curve and the pieces, looked at in 16 places of each
// Source   : Piegl and Tiller, The NURBS Book, A3.1 and A4.1; Bolton 1975, Biarc curves, CAD 7(2)
#pragma once

#include <span>
#include <vector>

#include "parser/interpret/moves/plane_path.hpp"
#include "parser/interpret/state/spline_in_progress.hpp"

namespace frustum::parser {

[[nodiscard]] std::vector<PathPiece> arcs_of_spline(std::span<const ControlPoint> points, int order,
                                                    double tolerance,
                                                    std::span<const double> knots = {});

}  // namespace frustum::parser
