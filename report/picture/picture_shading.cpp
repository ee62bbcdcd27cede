#include "report/picture/picture_shading.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/colour_scale.hpp"
#include "report/picture/ambient_light.hpp"

namespace frustum::report {
namespace {

using Eigen::Vector3f;

// The deviation scale in linear light, in steps too fine to see.
class ColourTable {
 public:
  explicit ColourTable(double span) : span_(span), none_(linear_from_srgb(kNoNominalColour)) {
    for (std::size_t k = 0; k < colours_.size(); ++k) {
      const double share = 2.0 * static_cast<double>(k) / kLast - 1.0;
      colours_[k] = linear_from_srgb(deviation_colour(share * span, span));
    }
  }
  [[nodiscard]] const LinearColour& of(float deviation) const {
    const double share = std::clamp(static_cast<double>(deviation) / span_, -1.0, 1.0);
    return colours_[static_cast<std::size_t>(std::lround((share + 1.0) / 2.0 * kLast))];
  }
  [[nodiscard]] const LinearColour& none() const { return none_; }

 private:
  static constexpr double kLast = 2047.0;
  double span_;
  LinearColour none_;
  std::array<LinearColour, 2048> colours_{};
};

// Highlights show how a bare part bends; colours that are read off a scale need them faint.
constexpr float kMetal = 0.30F;
constexpr float kPaint = 0.08F;

// Normal and surface colour of a sample; the normal in the camera frame.
struct Surfel {
  Vector3f normal = Vector3f::UnitZ();
  LinearColour colour{};
  float gloss = kMetal;
};

Surfel surfel_of(const Scene& scene, const ColourTable& table, const Seen& seen) {
  const Vector3f normal = scene.normal(seen);
  const auto& deviations = scene.picture().deviation;
  if (deviations.empty()) return {normal, table.none()};
  const auto& corners = scene.picture().triangles[seen.triangle];
  const std::array<float, 3> weights = weights_of(seen);
  float deviation = 0.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    // One corner without nominal makes the whole triangle grey: nothing is guessed.
    if (!deviations[corners[k]] || !std::isfinite(*deviations[corners[k]])) {
      return {normal, table.none()};
    }
    deviation += weights[k] * *deviations[corners[k]];
  }
  return {normal, table.of(deviation), kPaint};
}

// Light arriving at a surface with `normal`, 1 for a face turned to the key light.
float light_on(const Vector3f& normal, float openness) {
  static const Vector3f key = Vector3f(-0.42F, 0.62F, 0.66F).normalized();
  static const Vector3f fill = Vector3f(0.80F, 0.15F, 0.58F).normalized();
  const float direct = std::max(0.0F, normal.dot(key));
  const float second = std::max(0.0F, 0.25F + 0.75F * normal.dot(fill));
  const float sky = 0.5F + 0.5F * normal.y();
  return 0.50F * direct * (0.55F + 0.45F * openness) +
         openness * (0.24F * second + 0.14F * sky + 0.24F);
}

float highlight_on(const Vector3f& normal) {
  static const Vector3f halfway =
      (Vector3f(-0.42F, 0.62F, 0.66F).normalized() + Vector3f::UnitZ()).normalized();
  return std::pow(std::max(0.0F, normal.dot(halfway)), 22.0F);
}

// Where the surface bends or breaks off between neighbouring samples: a line, as in a drawing.
class EdgeLines {
 public:
  explicit EdgeLines(const Scene& scene)
      : scene_(scene), reach_(std::max(1, scene.samples() / 2)) {}

  [[nodiscard]] bool at(int x, int y) const {
    const Seen& here = seen(x, y);
    return parted(here, seen(x + reach_, y)) || parted(here, seen(x, y + reach_));
  }

 private:
  [[nodiscard]] const Seen& seen(int x, int y) const {
    static constexpr Seen kNothing{};
    return x < scene_.columns() && y < scene_.rows() ? scene_.seen(x, y) : kNothing;
  }
  [[nodiscard]] bool parted(const Seen& a, const Seen& b) const {
    if (a.triangle == b.triangle) return false;
    if (a.triangle == kNoTriangle || b.triangle == kNoTriangle) return true;
    const Vector3f na = scene_.normal(a), nb = scene_.normal(b);
    constexpr float kBend = 0.87F;  // cosine of 30 deg
    if (na.dot(nb) < kBend) return true;
    // A jump in depth that neither of the faces makes by leaning.
    const auto lean = [](const Vector3f& n) {
      return n.head<2>().norm() / std::max(0.05F, std::abs(n.z()));
    };
    const float step = static_cast<float>(reach_) / scene_.view().pixels_per_mm;
    return std::abs(a.depth - b.depth) > step * (4.0F + 2.0F * std::max(lean(na), lean(nb)));
  }

  const Scene& scene_;
  int reach_;  // samples: half a pixel to either side
};

}  // namespace

void shade(const Scene& scene, double deviation_span, Image& image) {
  const AmbientLight ambient(scene);
  const ColourTable table(deviation_span);
  const EdgeLines edges(scene);
  constexpr float kLineShare = 0.45F;
  const int samples = scene.samples();
  const float share = 1.0F / static_cast<float>(samples * samples);
  // Rows are independent: the picture does not depend on the number of threads.
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      LinearColour sum{};
      int seen_samples = 0;
      const float openness = ambient.at(x, y);
      for (int s = 0; s < samples * samples; ++s) {
        const int at_x = x * samples + s % samples;
        const int at_y = y * samples + s / samples;
        const Seen& seen = scene.seen(at_x, at_y);
        if (seen.triangle == kNoTriangle) continue;
        const Surfel surfel = surfel_of(scene, table, seen);
        const float shade = edges.at(at_x, at_y) ? 1.0F - kLineShare : 1.0F;
        const float light = shade * light_on(surfel.normal, openness);
        const float highlight = shade * surfel.gloss * highlight_on(surfel.normal);
        for (std::size_t k = 0; k < 3; ++k) {
          sum[k] += std::min(1.0F, surfel.colour[k] * light + highlight);
        }
        ++seen_samples;
      }
      if (seen_samples == 0) continue;
      const auto count = static_cast<float>(seen_samples);
      image.blend(x, y, {sum[0] / count, sum[1] / count, sum[2] / count}, count * share);
    }
  });
}

}  // namespace frustum::report
