#include "report/picture/ground_shadow.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace frustum::report {
namespace {

// Running mean over 2 * radius + 1 values, in place, through `length` values spaced `stride` apart.
void blur_line(std::vector<float>& values, std::size_t start, std::size_t stride, int length,
               int radius, std::vector<float>& scratch) {
  scratch.resize(static_cast<std::size_t>(length));
  for (int k = 0; k < length; ++k) {
    scratch[static_cast<std::size_t>(k)] = values[start + static_cast<std::size_t>(k) * stride];
  }
  const auto value = [&](int k) {
    return k < 0 || k >= length ? 0.0F : scratch[static_cast<std::size_t>(k)];
  };
  float sum = 0.0F;
  for (int k = -radius; k <= radius; ++k) sum += value(k);
  for (int k = 0; k < length; ++k) {
    values[start + static_cast<std::size_t>(k) * stride] =
        std::max(0.0F, sum) / static_cast<float>(2 * radius + 1);
    sum += value(k + radius + 1) - value(k - radius);
  }
}

// 1 where the part is between the ground and the light.
std::vector<float> darkness(const Scene& scene, int width, int height) {
  const Eigen::Vector3f& up = scene.up();
  std::vector<float> dark(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  constexpr float kAlongTheGround = 0.02F;
  if (std::abs(up.z()) < kAlongTheGround) return dark;
  const Eigen::Matrix3f& camera = scene.view().camera_from_workpiece;
  const Eigen::Vector3f slant = camera.transpose() * Eigen::Vector3f(0.30F, 0, -0.18F);
  const Eigen::Vector3f light =
      (camera * Eigen::Vector3f(-slant.x(), -slant.y(), 1.0F)).normalized();
  const float samples = static_cast<float>(scene.samples());
  // From a little below, so that the bottom face counts.
  const float below = samples / scene.view().pixels_per_mm;
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float at_x = scene.view().x_at((static_cast<float>(x) + 0.5F) * samples);
      const float at_y = scene.view().y_at((static_cast<float>(y) + 0.5F) * samples);
      const float depth = (scene.ground() - up.x() * at_x - up.y() * at_y) / up.z();
      const Eigen::Vector3f foot(at_x, at_y, depth);
      const bool hidden =
          scene.rays().is_hidden(foot - below * up, light, std::numeric_limits<float>::infinity());
      dark[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x)] = hidden ? 1.0F : 0.0F;
    }
  });
  return dark;
}

}  // namespace

void cast_ground_shadow(const Scene& scene, Image& image) {
  std::vector<float> dark = darkness(scene, image.width, image.height);
  const int radius = std::max(1, std::max(image.width, image.height) / 90);
  const auto columns = static_cast<std::size_t>(image.width);
  std::vector<float> scratch;
  for (int pass = 0; pass < 3; ++pass) {
    for (int y = 0; y < image.height; ++y) {
      blur_line(dark, static_cast<std::size_t>(y) * columns, 1, image.width, radius, scratch);
    }
    for (std::size_t x = 0; x < columns; ++x) {
      blur_line(dark, x, columns, image.height, radius, scratch);
    }
  }
  const LinearColour shade_colour = linear_from_srgb({0.30, 0.33, 0.38});
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.blend(
          x, y, shade_colour,
          0.42F * dark[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)]);
    }
  }
}

}  // namespace frustum::report
