// A colour image in linear light, so that averaging and blending are right.
//
// Units: linear RGB in [0, 1]; pixels, x right, y down. Errors: none; drawing outside is ignored.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace frustum::report {

using LinearColour = std::array<float, 3>;

[[nodiscard]] inline float linear_from_srgb(double value) {
  return static_cast<float>(value <= 0.04045 ? value / 12.92
                                             : std::pow((value + 0.055) / 1.055, 2.4));
}
[[nodiscard]] inline double srgb_from_linear(double value) {
  return value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}
[[nodiscard]] inline LinearColour linear_from_srgb(const std::array<double, 3>& colour) {
  return {linear_from_srgb(colour[0]), linear_from_srgb(colour[1]), linear_from_srgb(colour[2])};
}

struct Image {
  int width = 0;
  int height = 0;
  std::vector<LinearColour> pixels{};

  Image(int columns, int rows, LinearColour background)
      : width(columns),
        height(rows),
        pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), background) {}

  [[nodiscard]] LinearColour& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  // Covers the pixel by `share` with `colour`.
  void blend(int x, int y, const LinearColour& colour, float share) {
    if (x < 0 || y < 0 || x >= width || y >= height || !(share > 0.0F)) return;
    LinearColour& pixel = at(x, y);
    for (std::size_t k = 0; k < 3; ++k) pixel[k] += share * (colour[k] - pixel[k]);
  }
};

}  // namespace frustum::report
