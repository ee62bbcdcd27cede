// An image as the bytes of a PNG file, 8 bits a channel, sRGB.
//
// Units: pixels. Errors: a diagnostic with libpng's reason when it cannot be coded.
#pragma once

#include <string>

#include "core/result.hpp"
#include "report/picture/image.hpp"

namespace frustum::report {

[[nodiscard]] Result<std::string> png_bytes(const Image& image);

}  // namespace frustum::report
