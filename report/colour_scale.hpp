// The diverging colour scale of deviations: blue where material is missing, near white at nominal,
// red where material is left; grey where no nominal is known.
//
// Units: deviations and the span in mm; colours sRGB in [0, 1].
// Errors: none; a deviation beyond the span takes the colour of the end.
#pragma once

#include <array>
#include <optional>

#include "report/run_report.hpp"

namespace frustum::report {

using Colour = std::array<double, 3>;

// Stops at equal steps from -span to +span.
inline constexpr std::array<Colour, 9> kDeviationStops = {{{0.110, 0.196, 0.427},
                                                           {0.157, 0.380, 0.647},
                                                           {0.376, 0.612, 0.800},
                                                           {0.690, 0.824, 0.910},
                                                           {0.955, 0.955, 0.945},
                                                           {0.965, 0.780, 0.680},
                                                           {0.890, 0.522, 0.408},
                                                           {0.745, 0.239, 0.212},
                                                           {0.478, 0.059, 0.125}}};
inline constexpr Colour kNoNominalColour = {0.735, 0.755, 0.775};

[[nodiscard]] Colour deviation_colour(double deviation, double span);
[[nodiscard]] Colour deviation_colour(const std::optional<float>& deviation, double span);

// A span for the picture: holds 99.5 % of the deviations, rounded up to 1, 2 or 5 times a power of
// ten; 1 um when there are none. Spikes at edges do not wash out the rest.
[[nodiscard]] double natural_span(const SurfacePicture& picture);

}  // namespace frustum::report
