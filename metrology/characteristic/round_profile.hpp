// Closed profiles: the points of one section as a roundness tester plots them.
//
// Model    : deviations from a least-squares circle against the angle about the axis
// Units    : mm, rad
// Shape    : one section a call
// Errors   : a section with too few or degenerate points
// Accuracy : 1e-9 mm (tests/metrology/characteristic_test.cpp)
// Source   : ISO 12181-1; Bossoni 2010, section 3.9 (equivalent cone form)
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"

namespace frustum::metrology {

// A closed profile as a roundness tester plots it.
struct RoundProfile {
  double peak_to_valley = 0.0;      // mm
  std::vector<double> angle{};      // rad, about the axis from the zero direction
  std::vector<double> deviation{};  // mm, from the least-squares circle
};

// `axis` gives the sense of the angles, `zero` where they start (perpendicular to it).
struct AngleFrame {
  UnitVec3 axis = UnitVec3::z();
  Vec3 zero = Vec3::UnitX();
};

// Radial deviations in the least-squares plane of the points from their least-squares circle. The
// characteristic of a cone takes the points at_one_height first.
[[nodiscard]] Result<RoundProfile> roundness(std::span<const Vec3> points,
                                             const AngleFrame& angles);

// What a roundness tester would see on a cone of the nominal half angle: with the least-squares
// circle (r, centre) in the least-squares plane and its normal turned toward the apex,
// K = centre - r tan(half_angle) normal is where the surface normals of the nominal cone meet the
// axis; d_i = |p_i - K|; the result is the peak to valley of the polar plot (d_i, angle) about its
// own least-squares circle.
[[nodiscard]] Result<RoundProfile> equivalent_cone_form(std::span<const Vec3> points,
                                                        double half_angle,
                                                        const UnitVec3& toward_apex,
                                                        const AngleFrame& angles);

// The points of one section of a cone shifted along the generatrix into the plane perpendicular to
// `along` through their centroid; other features' points as they are. Probed along the normal, the
// points of a displaced or lobed cone are not at one height, and a circle through them would see
// but cos^2 of the half angle of a displacement.
[[nodiscard]] std::vector<Vec3> at_one_height(const FittedFeature& feature, std::size_t section,
                                              const Vec3& along);

// Least-squares circle of a section's points, those of a cone at_one_height. Errors name the
// section.
[[nodiscard]] Result<Fit<Circle>> section_circle(const FittedFeature& feature, std::size_t section,
                                                 const Vec3& along);

// Angle of `w` about the axis of the frame, 0 to one turn.
[[nodiscard]] double angle_of(const Vec3& w, const AngleFrame& frame);
// About the planned axis of the feature, from its zero direction.
[[nodiscard]] AngleFrame angle_frame(const FittedFeature& feature);

}  // namespace frustum::metrology
