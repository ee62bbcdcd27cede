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

// Radial deviations in the least-squares plane of the points from their least-squares circle.
// Characteristics take the points at_one_height first: ISO 12181-1 asks for the section across the
// feature's axis.
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

// The points of one section of a cylinder or cone shifted along the generatrix into the plane
// perpendicular to `along` through their centroid; a circle's as they are. The heights at which a
// surface was touched say nothing of its roundness: a few points whose heights scatter would lay
// the least-squares plane askew, and the points of a displaced or lobed cone, which are probed
// along the normal, would see but cos^2 of the half angle of a displacement. Refused is what is
// higher than a tenth of its radius, such as a helix: there is no section to speak of.
[[nodiscard]] Result<std::vector<Vec3>> at_one_height(const FittedFeature& feature,
                                                      std::size_t section, const Vec3& along);

// Least-squares circle of a section's points at_one_height. Errors name the section.
[[nodiscard]] Result<Fit<Circle>> section_circle(const FittedFeature& feature, std::size_t section,
                                                 const Vec3& along);

// Of its centre within its plane, in those of a point.
[[nodiscard]] double centre_variance(const Fit<Circle>& circle);

// Angle of `w` about the axis of the frame, 0 to one turn.
[[nodiscard]] double angle_of(const Vec3& w, const AngleFrame& frame);
// About the planned axis of the feature, from its zero direction.
[[nodiscard]] AngleFrame angle_frame(const FittedFeature& feature);

}  // namespace frustum::metrology
