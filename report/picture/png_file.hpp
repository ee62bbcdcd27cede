// An image as a PNG file, 8 bits a channel, sRGB.
//
// Units: pixels. Errors: a diagnostic that names the file and the reason when it cannot be written.
#pragma once

#include <filesystem>

#include "core/result.hpp"
#include "report/picture/image.hpp"

namespace frustum::report {

[[nodiscard]] Result<std::filesystem::path> write_png(const std::filesystem::path& path,
                                                      const Image& image);

}  // namespace frustum::report
