// The tolerance zones of ISO 1101 as this room evaluates them: what goes in, what comes out.
//
// Model    : each function below is one family of zones, defined in docs/characteristics.md
// Units    : mm, rad; all features in one frame, in which the plan holds
// Shape    : one characteristic a call
// Errors   : sections with too few points, fits and filters that fail
// Accuracy : 1e-9 mm (tests/metrology/zone_test.cpp, form_characteristic_test.cpp)
// Source   : ISO 1101:2017, ISO 12180, ISO 12181, ISO 12780, ISO 12781, ISO 1660
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "metrology/uncertainty/uncertainty.hpp"

namespace frustum::metrology {

struct Zone {
  double value = 0.0;        // mm
  double uncertainty = 0.0;  // mm, standard
  RoundProfile profile{};
  std::vector<Harmonic> harmonics{};
  NonNegative magnitude{};  // what the value is the size of; kind none where that is not told
};

struct Toleranced {
  const PlannedCharacteristic& planned;
  std::vector<const FittedFeature*> features{};  // in the order in which it names them
  PointUncertainty u{};
};

// Roundness, cylindricity, cone form, flatness and straightness by any criterion, parameter and filter;
// straightness of the generatrices of a cylinder or cone (the worst), of an axis.
[[nodiscard]] Result<Zone> form_zone(const Toleranced& what);
// Parallelism, perpendicularity and angularity.
[[nodiscard]] Result<Zone> orientation_zone(const Toleranced& what);
// Position, coaxiality, concentricity and symmetry.
[[nodiscard]] Result<Zone> location_zone(const Toleranced& what);
// Circular and total run-out.
[[nodiscard]] Result<Zone> run_out_zone(const Toleranced& what);
// Profile of a line or of surfaces.
[[nodiscard]] Result<Zone> profile_zone(const Toleranced& what);

// The axis that one datum feature or several have in common: of several the least-squares line
// through the centres of their sections.
[[nodiscard]] Result<Line> common_axis(std::span<const FittedFeature* const> datums,
                                       Criterion criterion);
// Of twice the distance of a point of the feature's element, `away` mm from its middle.
[[nodiscard]] double place_uncertainty(const PointUncertainty& u, const FittedFeature& feature,
                                       double away);

// Peak to valley, highest peak, deepest valley or root mean square; deviations count out of the
// material.
[[nodiscard]] double form_parameter(FormParameter parameter, const std::vector<double>& deviations);

// Angle of `w` about the axis of the frame, 0 to one turn.
[[nodiscard]] double angle_of(const Vec3& w, const AngleFrame& frame);
// About the planned axis of the feature, from its zero direction.
[[nodiscard]] AngleFrame angle_frame(const FittedFeature& feature);

}  // namespace frustum::metrology
