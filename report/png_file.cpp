#include "report/png_file.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "report/text_file.hpp"

namespace frustum::report {

Result<std::filesystem::path> write_png(const std::filesystem::path& path, const Image& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const LinearColour& pixel : image.pixels) {
    for (const float channel : pixel) {
      const double value = srgb_from_linear(std::clamp(static_cast<double>(channel), 0.0, 1.0));
      bytes.push_back(static_cast<std::uint8_t>(std::lround(value * 255.0)));
    }
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&png, path.c_str(), 0, bytes.data(), 0, nullptr) == 0) {
    return cannot_write(path, png.message);
  }
  return path;
}

}  // namespace frustum::report
