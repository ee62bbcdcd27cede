// The finished workpiece as a PNG picture, coloured by its deviation from nominal; drawn with rays.
//
// Units : pixels; azimuth and elevation in degrees; deviations in mm (the scale is labelled in um,
//         or nm)
// Errors: empty or inconsistent picture, a size outside 64..8192 px, a span that is not positive, a
//         path that cannot be written: a diagnostic each
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

struct PictureOptions {
  int width = 1600;
  int height = 1100;
  double azimuth = -60.0;   // deg: direction of the viewer, about +z from +x
  double elevation = 32.0;  // deg above the xy plane
  // mm at the ends of the colour scale; natural_span() when not given.
  std::optional<double> deviation_span{};
  int samples = 3;         // samples x samples rays a pixel, 1..4
  bool colour_bar = true;  // drawn only when some deviation is known
};

// What the file holds.
[[nodiscard]] Result<std::string> picture_png(const SurfacePicture& picture,
                                              const PictureOptions& options = {});
[[nodiscard]] Result<std::filesystem::path> write_picture(const std::filesystem::path& path,
                                                          const SurfacePicture& picture,
                                                          const PictureOptions& options = {});

}  // namespace frustum::report
