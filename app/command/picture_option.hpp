// --view and --size: how a picture is seen.
//
// Units  : degrees, pixels
// Errors : another count of numbers, an angle out of range, a size that is no whole number
#pragma once

#include <optional>
#include <string>

#include "core/diagnostic.hpp"
#include "report/picture/picture.hpp"

namespace frustum::app {

// --view AZIMUTH,ELEVATION in degrees. Says what is wrong.
[[nodiscard]] std::optional<Diagnostics> look_from(const std::string& view,
                                                   report::PictureOptions& options);

// --size WIDTH,HEIGHT in pixels; the picture itself refuses sizes that it cannot draw.
[[nodiscard]] std::optional<Diagnostics> draw_at(const std::string& size,
                                                 report::PictureOptions& options);

}  // namespace frustum::app
