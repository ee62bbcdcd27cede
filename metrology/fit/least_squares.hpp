// Orthogonal-distance fits (Gaussian association) of the elements, without starting values.
//
// Model    : minimise sum w_i d_i^2, d_i = residual(element, x_i) of element.hpp, over the elements
//            that keep the constraints: a minimum also where these contradict the points, and of
//            circles of a given radius the least of all. A 3D circle is fitted as plane first, then
//            as circle in the projection, as the NIST reference pairs define it
// Units    : mm, rad; all points in one frame
// Shape    : n >= 2 (line), 3 (plane, circle), 4 (sphere), 5 (cylinder), 6 (cone), 7 (torus)
//            points; constraints spare a point for each parameter that they fix
// Errors   : too few points, not finite, degenerate (points that do not tell the element), not
//            converged, constraints that the kind lacks or that contradict the points so that no
//            element is best, weights that are none; each a Diagnostic that says why
// Accuracy : 1e-9 mm, 1e-11 rad on the NIST pairs (tests/metrology/reference_fits_test.cpp); exact
//            data is recovered to 1e-10 mm (tests/metrology/least_squares_test.cpp)
// Source   : Shakarji 1998, J. Res. NIST 103(6), sections 3 and 4 (models and parameters)
#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/fit/constraints.hpp"
#include "metrology/fit/element.hpp"

namespace frustum::metrology {

// Order of the parameters in `covariance` and `cofactor`, with {u, v} = tangents(axis):
//   line     : shift along u, v; tilt of the axis toward u, v
//   plane    : shift along the axis; tilt of the axis toward u, v
//   circle   : shift along u, v; radius; shift along the axis; tilt toward u, v
//   sphere   : shift along x, y, z; radius
//   cylinder : shift along u, v; tilt toward u, v; radius
//   cone     : shift along u, v; tilt toward u, v; radius; half_angle
//   torus    : shift along u, v; shift along the axis; tilt toward u, v; radius; tube_radius
//   line2d   : shift toward the normal of the line in its plane; tilt toward it
// `point` is the centroid of the points or its projection on the axis, so shift and tilt hardly
// correlate (circle, sphere and torus: the centre). What constraints fix has rows of zeros.
template <typename T>
struct Fit {
  T element{};
  std::vector<double> residuals{};  // mm, in the order of the points
  double form = 0.0;                // mm, peak to valley of the residuals
  double rms = 0.0;                 // mm, every point counted alike
  // (J^T W J)^-1: variances of the parameters when a point has the variance 1/weight along its
  // normal.
  Eigen::MatrixXd cofactor{};
  // cofactor * sum w d^2 / (points that weigh - free parameters): what the scatter itself says;
  // zero without redundancy.
  Eigen::MatrixXd covariance{};
  int iterations = 0;
  // Largest to smallest singular value of the Jacobian of the free parameters, its columns of
  // length one, in a frame of the size of the part: how much worse than the best the points tell
  // the worst known combination of parameters.
  double condition = 1.0;
};

struct FitOptions {
  Constraints constraints{};
  std::vector<double> weights{};  // of the squares, one a point, none negative; empty: all 1
  // Cylinders, cones, tori: where one is meant to be. Few points fit several of them, narrow arcs
  // one across them as well, and then the one that is reached from here is meant.
  std::optional<Element> expected{};
};

[[nodiscard]] Result<Fit<Line>> fit_line(std::span<const Vec3> points,
                                         const FitOptions& options = {});
[[nodiscard]] Result<Fit<Plane>> fit_plane(std::span<const Vec3> points,
                                           const FitOptions& options = {});
[[nodiscard]] Result<Fit<Circle>> fit_circle(std::span<const Vec3> points,
                                             const FitOptions& options = {});
// In a coordinate plane: the one in which the points are constant, z otherwise; the third
// coordinate of the element's point is the mean. Residuals of the line are positive on its left,
// seen from the tip of the plane's normal.
[[nodiscard]] Result<Fit<Line>> fit_line_2d(std::span<const Vec3> points,
                                            const FitOptions& options = {});
[[nodiscard]] Result<Fit<Circle>> fit_circle_2d(std::span<const Vec3> points,
                                                const FitOptions& options = {});
[[nodiscard]] Result<Fit<Sphere>> fit_sphere(std::span<const Vec3> points,
                                             const FitOptions& options = {});
[[nodiscard]] Result<Fit<Cylinder>> fit_cylinder(std::span<const Vec3> points,
                                                 const FitOptions& options = {});
[[nodiscard]] Result<Fit<Cone>> fit_cone(std::span<const Vec3> points,
                                         const FitOptions& options = {});
// The same of points that are known to be near options.expected, as those of a feature are near the
// plan: the search is left out. Points that are not near are searched all the same.
[[nodiscard]] Result<Fit<Cylinder>> fit_cylinder_nearby(std::span<const Vec3> points,
                                                        const FitOptions& options);
[[nodiscard]] Result<Fit<Cone>> fit_cone_nearby(std::span<const Vec3> points,
                                                const FitOptions& options);
[[nodiscard]] Result<Fit<Torus>> fit_torus(std::span<const Vec3> points,
                                           const FitOptions& options = {});

[[nodiscard]] Result<Fit<Element>> fit_element(ElementKind kind, std::span<const Vec3> points,
                                               const FitOptions& options = {});
// By the nearby fits where there are such.
[[nodiscard]] Result<Fit<Element>> fit_nearby(ElementKind kind, std::span<const Vec3> points,
                                              const FitOptions& options);
// By the name a user types: those of kElementNames, "line2d" and "circle2d".
[[nodiscard]] Result<Fit<Element>> fit_element(std::string_view name, std::span<const Vec3> points,
                                               const FitOptions& options = {});

}  // namespace frustum::metrology
