// A ray against a cutter that is hollowed out, moving over one stretch of tool path.
//
// Model    : with d(x, t) the signed distance of a point to the body at time t, phi(x) = min over t of d is
//            below zero exactly where the stretch covers. Along a ray phi changes by at most the way, so
//            that steps as long as phi never pass an end; where the sign changes the end is closed in on.
//            At an end the minimum over t is the envelope condition
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : ends within 0.1 nm normal to the surface. Valleys of d over t are told apart by moments that are
//            0.02 mm of motion apart; every valley that may be the deepest is gone down into
// Source   : sphere tracing (Hart 1996) of a minimum of distances
#pragma once

#include <span>
#include <vector>

#include "cutter/body.hpp"
#include "cutter/stretch_motion.hpp"
#include "cutter/stretch_sweep.hpp"

namespace frustum::cutter {

// What the Accuracy line says of this body: no end is farther from the sweep, normal to it (mm).
[[nodiscard]] double carved_accuracy(const Body& body);

// Outward unit normal of the body's surface nearest to a point.
[[nodiscard]] Vec3 outline_normal(const Outline& outline, const ToolPose& pose, const Vec3& point);

// Appends what the body covers around its carved parts; `known` is covered anyway and is passed over.
void append_carved_intervals(const Body& body, const StretchMotion& motion, const Ray& ray,
                             std::span<const Chord> known, std::vector<SweptInterval>& found);

// When the body's surface, or its inside, is nearest to the ray's point at s.
[[nodiscard]] double nearest_moment(const Body& body, const StretchMotion& motion, const Ray& ray,
                                    double s);

}  // namespace frustum::cutter
