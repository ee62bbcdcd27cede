#include "report/picture/png_file.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace frustum::report {

Result<std::string> png_bytes(const Image& image) {
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
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&png, nullptr, &size, 0, bytes.data(), 0, nullptr) == 0) {
    return error("picture-png"_id, std::string("the picture cannot be coded: ") + png.message);
  }
  std::string file(size, '\0');
  if (png_image_write_to_memory(&png, file.data(), &size, 0, bytes.data(), 0, nullptr) == 0) {
    return error("picture-png"_id, std::string("the picture cannot be coded: ") + png.message);
  }
  file.resize(size);
  return file;
}

}  // namespace frustum::report
