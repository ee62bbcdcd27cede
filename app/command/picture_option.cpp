#include "app/command/picture_option.hpp"

#include <cmath>

#include "app/job/number_list.hpp"

namespace frustum::app {

std::optional<Diagnostics> look_from(const std::string& view, report::PictureOptions& options) {
  const auto angles = numbers_of(view, 2, "--view");
  if (!angles) return angles.error();
  options.azimuth = (*angles)[0];
  options.elevation = (*angles)[1];
  if (std::abs(options.azimuth) <= 360.0 && std::abs(options.elevation) <= 90.0) return {};
  return Diagnostics{error("out-of-range"_id, "--view " + view + " is no direction to look from",
                           "azimuth about Z from +X within 360 deg, elevation from -90 to 90 deg")};
}

std::optional<Diagnostics> draw_at(const std::string& size, report::PictureOptions& options) {
  const auto sides = numbers_of(size, 2, "--size");
  if (!sides) return sides.error();
  for (const double side : *sides) {
    if (side != std::floor(side) || std::abs(side) > 1e6) {
      return Diagnostics{error("out-of-range"_id, "--size " + size + " is no size in pixels",
                               "two whole numbers: 1600,1100")};
    }
  }
  options.width = static_cast<int>((*sides)[0]);
  options.height = static_cast<int>((*sides)[1]);
  return {};
}

}  // namespace frustum::app
