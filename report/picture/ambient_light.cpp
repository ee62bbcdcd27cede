#include "report/picture/ambient_light.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustum::report {
namespace {

constexpr std::size_t kRays = 16;      // a pixel
constexpr std::size_t kPatterns = 16;  // of rays: one for each of 4 x 4 neighbouring pixels
// The longest ray, as a share of the picture's shorter side.
constexpr float kReach = 0.22F;
// What the ground takes: it is bright, and gives most of it back.
constexpr float kGroundShare = 0.45F;
// All hidden still gets some light.
constexpr float kDarkest = 0.10F;

struct SkyRay {
  Eigen::Vector3f direction;  // z along the normal
  float length;               // of the reach
};

// Points of the R3 sequence, every sixteenth of them in one pattern.
std::array<SkyRay, kRays * kPatterns> sky_rays() {
  std::array<SkyRay, kRays * kPatterns> rays;
  constexpr double kRoot = 1.2207440846057594754;  // g^4 = g + 1
  const auto share = [](std::size_t k, double step) {
    const double place = 0.5 + static_cast<double>(k) * step;
    return place - std::floor(place);
  };
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const double round = 2.0 * std::numbers::pi * share(k, 1.0 / kRoot);
    const double sine_squared = share(k, 1.0 / (kRoot * kRoot));  // as many as the cosine
    const double sine = std::sqrt(sine_squared);
    rays[k].direction = Eigen::Vector3d(sine * std::cos(round), sine * std::sin(round),
                                        std::sqrt(1.0 - sine_squared))
                            .cast<float>();
    rays[k].length = static_cast<float>(share(k, 1.0 / (kRoot * kRoot * kRoot)));
  }
  return rays;
}

// Columns: two directions along the surface, and the normal (Duff et al. 2017, JCGT 6(1)).
Eigen::Matrix3f frame_around(const Eigen::Vector3f& normal) {
  const float sign = std::copysign(1.0F, normal.z());
  const float a = -1.0F / (sign + normal.z());
  const float b = normal.x() * normal.y() * a;
  Eigen::Matrix3f frame;
  frame.col(0) << 1.0F + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x();
  frame.col(1) << b, sign + normal.y() * normal.y() * a, -normal.y();
  frame.col(2) = normal;
  return frame;
}

// The seen sample nearest to the middle of a pixel.
struct Sample {
  int x = 0, y = 0;
  const Seen* seen = nullptr;
};
Sample middle_sample(const Scene& scene, int x, int y) {
  const int n = scene.samples();
  Sample best;
  int nearest = 0;
  for (int k = 0; k < n * n; ++k) {
    const int dx = k % n, dy = k / n;
    const int away = (2 * dx - n + 1) * (2 * dx - n + 1) + (2 * dy - n + 1) * (2 * dy - n + 1);
    const Seen& seen = scene.seen(x * n + dx, y * n + dy);
    if (seen.triangle == kNoTriangle || (best.seen != nullptr && away >= nearest)) continue;
    best = {x * n + dx, y * n + dy, &seen};
    nearest = away;
  }
  return best;
}

}  // namespace

AmbientLight::AmbientLight(const Scene& scene)
    : width_(scene.columns() / scene.samples()),
      height_(scene.rows() / scene.samples()),
      depth_tolerance_(8.0F * static_cast<float>(scene.samples()) / scene.view().pixels_per_mm),
      pixels_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
  const auto rays = sky_rays();
  const float mm_per_pixel = static_cast<float>(scene.samples()) / scene.view().pixels_per_mm;
  const float reach = kReach * static_cast<float>(std::min(width_, height_)) * mm_per_pixel;
  // Off the surface by less than can be seen and more than single precision takes away.
  const float off = 0.1F * mm_per_pixel;
  tbb::parallel_for(0, height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const Sample sample = middle_sample(scene, x, y);
      if (sample.seen == nullptr) continue;
      const Eigen::Vector3f normal = scene.normal(*sample.seen);
      const Eigen::Vector3f facing = scene.facing(*sample.seen);
      const Eigen::Vector3f from = scene.place(sample.x, sample.y, *sample.seen) + off * facing;
      const float height = std::max(0.0F, scene.up().dot(from) - scene.ground());
      const Eigen::Matrix3f frame = frame_around(normal);
      const auto pattern = static_cast<std::size_t>(x % 4 + 4 * (y % 4));
      float hidden = 0.0F;
      int cast = 0;
      for (std::size_t k = 0; k < kRays; ++k) {
        const SkyRay& ray = rays[kPatterns * k + pattern];
        const Eigen::Vector3f direction = frame * ray.direction;
        if (direction.dot(facing) < 0.02F)
          continue;  // into the triangle: shaded rounder than it is
        ++cast;
        const float length = ray.length * reach;
        const float sinks = -scene.up().dot(direction);
        if (scene.rays().is_hidden(from, direction, length)) {
          hidden += 1.0F;
        } else if (sinks * length > height) {
          hidden += kGroundShare;
        }
      }
      const float share = cast > 0 ? hidden / static_cast<float>(cast) : 0.0F;
      pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x)] = {1.0F - (1.0F - kDarkest) * share, sample.seen->depth,
                                              normal};
    }
  });
}

float AmbientLight::at(int x, int y) const {
  constexpr float kSameFace = 0.94F;  // cosine of 20 deg
  const Pixel& here = pixel(x, y);
  if (here.normal.isZero()) return 1.0F;
  float sum = 0.0F;
  int count = 0;
  for (int dy = -2; dy <= 1; ++dy) {
    for (int dx = -2; dx <= 1; ++dx) {
      const Pixel& near =
          pixel(std::clamp(x + dx, 0, width_ - 1), std::clamp(y + dy, 0, height_ - 1));
      if (near.normal.dot(here.normal) < kSameFace ||
          std::abs(near.depth - here.depth) > depth_tolerance_) {
        continue;
      }
      sum += near.open;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : here.open;
}

}  // namespace frustum::report
