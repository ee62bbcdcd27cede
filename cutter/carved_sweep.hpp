// A ray against a cutter that is hollowed out, moving over one stretch of tool path.
//
// Model    : with d(x, t) the signed distance of a point to the body at time t, phi(x) = min over t of d is
//            below zero exactly where the stretch covers. Along a ray phi changes by at most the way, so
//            that steps as long as phi never pass an end; where the sign changes the end is closed in on.
//            At an end the minimum over t is the envelope condition
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : ends within 0.1 nm normal to the surface. The minimum over t is sought between moments that are
//            0.02 mm of motion apart: a body that meets the ray for less than that may be missed by what
//            its outline bends over that way (10 nm at a radius of 5 mm)
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

}  // namespace frustum::cutter
