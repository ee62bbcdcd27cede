#include "report/picture/picture_shading.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "report/colour_scale.hpp"

namespace frustum::report {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kDirections = 12;  // of ambient occlusion
constexpr int kRings = 5;

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

// Normal and surface colour at a buffer pixel; the normal in camera axes.
struct Surfel {
  Vector3f normal = Vector3f::UnitZ();
  LinearColour colour{};
  float gloss = kMetal;
};

std::array<float, 3> weights_of(const Scene& scene, std::uint32_t t, int x, int y) {
  const auto& corners = scene.picture->triangles[t];
  return weights_at({scene.pixels[corners[0]], scene.pixels[corners[1]], scene.pixels[corners[2]]},
                    static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
}

Vector3f normal_in_camera(const Scene& scene, std::uint32_t t,
                          const std::array<float, 3>& weights) {
  const CornerNormals& normals = (*scene.normals)[t];
  Vector3f normal = weights[0] * normals[0] + weights[1] * normals[1] + weights[2] * normals[2];
  const float length = normal.norm();
  if (length > 0.0F) normal /= length;
  return scene.view.camera_from_workpiece * normal;
}

Surfel surfel_at(const Scene& scene, const ColourTable& table, int x, int y) {
  const std::uint32_t t = scene.buffer.triangle[scene.buffer.index(x, y)];
  const std::array<float, 3> weights = weights_of(scene, t, x, y);
  const Vector3f normal = normal_in_camera(scene, t, weights);
  const auto& corners = scene.picture->triangles[t];
  const auto& deviations = scene.picture->deviation;
  if (deviations.empty()) return {normal, table.none()};
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

// Rows are independent: the picture does not depend on the number of threads.
template <typename Row>
void for_each_row(int rows, const Row& row) {
  tbb::parallel_for(0, rows, row);
}

// Unit steps for ambient occlusion: 16 sets of kDirections, each turned a little further.
std::array<std::array<float, 2>, 16 * kDirections> occlusion_directions() {
  std::array<std::array<float, 2>, 16 * kDirections> directions{};
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(directions.size());
    directions[k] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  }
  return directions;
}

// The share of the sky that is open at each image pixel, from the depths around it.
std::vector<float> openness_of(const Scene& scene, int width, int height) {
  const auto directions = occlusion_directions();
  const int samples = scene.samples;
  const VisibilityBuffer& buffer = scene.buffer;
  const auto reach = 0.045F * static_cast<float>(std::max(width, height) * samples);  // buffer px
  const float mm_per_pixel = 1.0F / scene.view.pixels_per_mm;
  std::vector<float> open(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1.0F);
  for_each_row(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const int bx = x * samples + samples / 2;
      const int by = y * samples + samples / 2;
      const std::size_t centre = buffer.index(bx, by);
      if (buffer.triangle[centre] == kNoTriangle) continue;
      const std::uint32_t seen = buffer.triangle[centre];
      const Vector3f normal = normal_in_camera(scene, seen, weights_of(scene, seen, bx, by));
      // Neighbouring pixels look in other directions; the 4 x 4 mean afterwards joins them.
      const std::size_t turn =
          static_cast<std::size_t>(x) % 4 + 4 * (static_cast<std::size_t>(y) % 4);
      float hidden = 0.0F;
      for (std::size_t d = 0; d < kDirections; ++d) {
        const auto& [ux, uy] = directions[16 * d + turn];
        float worst = 0.0F;
        for (int r = 1; r <= kRings; ++r) {
          const float share = static_cast<float>(r) / kRings;
          const float step = std::max(1.0F, reach * share * share);
          const int sx = bx + static_cast<int>(std::lround(ux * step));
          const int sy = by - static_cast<int>(std::lround(uy * step));
          if (sx < 0 || sy < 0 || sx >= buffer.width || sy >= buffer.height) break;
          const std::size_t k = buffer.index(sx, sy);
          if (buffer.triangle[k] == kNoTriangle) continue;
          const Vector3f towards(static_cast<float>(sx - bx) * mm_per_pixel,
                                 static_cast<float>(by - sy) * mm_per_pixel,
                                 buffer.depth[k] - buffer.depth[centre]);
          const float distance = towards.norm() * scene.view.pixels_per_mm;
          const float rise = normal.dot(towards) * scene.view.pixels_per_mm / distance - 0.08F;
          const float fade = std::max(0.0F, 1.0F - distance / (1.6F * reach));
          worst = std::max(worst, rise * fade);
        }
        hidden += worst;
      }
      open[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x)] =
          std::max(0.0F, 1.0F - 1.15F * hidden / static_cast<float>(kDirections));
    }
  });
  return open;
}

// The mean over 4 x 4 pixels at about the same depth, which removes the pattern of directions.
float smooth_openness(const Scene& scene, const std::vector<float>& open, int width, int height,
                      int x, int y) {
  const int samples = scene.samples;
  const auto depth_at = [&](int px, int py) {
    return scene.buffer
        .depth[scene.buffer.index(px * samples + samples / 2, py * samples + samples / 2)];
  };
  const float depth = depth_at(x, y);
  const float tolerance = 8.0F * static_cast<float>(samples) / scene.view.pixels_per_mm;
  float sum = 0.0F;
  int count = 0;
  for (int dy = -2; dy <= 1; ++dy) {
    for (int dx = -2; dx <= 1; ++dx) {
      const int px = std::clamp(x + dx, 0, width - 1);
      const int py = std::clamp(y + dy, 0, height - 1);
      if (std::abs(depth_at(px, py) - depth) > tolerance) continue;
      sum += open[static_cast<std::size_t>(py) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(px)];
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : 1.0F;
}

// Running mean over 2 * radius + 1 values, in place, through `line` values spaced `stride` apart.
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

// True when no sample of the image pixel sees the workpiece.
bool is_empty(const Scene& scene, int x, int y) {
  for (int s = 0; s < scene.samples * scene.samples; ++s) {
    const int bx = x * scene.samples + s % scene.samples;
    const int by = y * scene.samples + s / scene.samples;
    if (scene.buffer.triangle[scene.buffer.index(bx, by)] != kNoTriangle) return false;
  }
  return true;
}

// Where the surface bends or breaks off between neighbouring samples: a line, as in a drawing.
class EdgeLines {
 public:
  explicit EdgeLines(const Scene& scene) : scene_(scene), reach_(std::max(1, scene.samples / 2)) {}

  [[nodiscard]] bool at(int bx, int by) const {
    const Place here = place(bx, by);
    return parted(here, place(bx + reach_, by)) || parted(here, place(bx, by + reach_));
  }

 private:
  struct Place {
    int x, y;
    std::uint32_t triangle;
    float depth;
  };
  [[nodiscard]] Place place(int x, int y) const {
    if (x >= scene_.buffer.width || y >= scene_.buffer.height) return {x, y, kNoTriangle, 0.0F};
    const std::size_t k = scene_.buffer.index(x, y);
    return {x, y, scene_.buffer.triangle[k], scene_.buffer.depth[k]};
  }
  [[nodiscard]] bool parted(const Place& a, const Place& b) const {
    if (a.triangle == b.triangle) return false;
    if (a.triangle == kNoTriangle || b.triangle == kNoTriangle) return true;
    const Vector3f na = normal_of(a), nb = normal_of(b);
    constexpr float kBend = 0.87F;  // cosine of 30 deg
    if (na.dot(nb) < kBend) return true;
    // A jump in depth that neither of the faces makes by leaning.
    const auto lean = [](const Vector3f& n) {
      return n.head<2>().norm() / std::max(0.05F, std::abs(n.z()));
    };
    const float step = static_cast<float>(reach_) / scene_.view.pixels_per_mm;
    return std::abs(a.depth - b.depth) > step * (4.0F + 2.0F * std::max(lean(na), lean(nb)));
  }
  [[nodiscard]] Vector3f normal_of(const Place& p) const {
    return normal_in_camera(scene_, p.triangle, weights_of(scene_, p.triangle, p.x, p.y));
  }

  const Scene& scene_;
  int reach_;  // buffer pixels: half an image pixel to either side
};

}  // namespace

void shade(const Scene& scene, Image& image) {
  const std::vector<float> open = openness_of(scene, image.width, image.height);
  const ColourTable table(scene.deviation_span);
  const EdgeLines edges(scene);
  constexpr float kLineShare = 0.45F;
  const int samples = scene.samples;
  const float share = 1.0F / static_cast<float>(samples * samples);
  for_each_row(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      if (is_empty(scene, x, y)) continue;
      LinearColour sum{};
      int seen = 0;
      const float openness = smooth_openness(scene, open, image.width, image.height, x, y);
      for (int s = 0; s < samples * samples; ++s) {
        const int bx = x * samples + s % samples;
        const int by = y * samples + s / samples;
        if (scene.buffer.triangle[scene.buffer.index(bx, by)] == kNoTriangle) continue;
        const Surfel surfel = surfel_at(scene, table, bx, by);
        const float shade = edges.at(bx, by) ? 1.0F - kLineShare : 1.0F;
        const float light = shade * light_on(surfel.normal, openness);
        const float highlight = shade * surfel.gloss * highlight_on(surfel.normal);
        for (std::size_t k = 0; k < 3; ++k) {
          sum[k] += std::min(1.0F, surfel.colour[k] * light + highlight);
        }
        ++seen;
      }
      if (seen == 0) continue;
      const auto count = static_cast<float>(seen);
      image.blend(x, y, {sum[0] / count, sum[1] / count, sum[2] / count}, count * share);
    }
  });
}

void cast_ground_shadow(const Scene& scene, Image& image) {
  const auto& vertices = scene.picture->vertices;
  float ground = std::numeric_limits<float>::max();
  for (const auto& vertex : vertices) ground = std::min(ground, vertex[2]);
  // The light stands high behind the viewer's left shoulder: shadows fall back and to the right.
  const Vector3f slant = scene.view.camera_from_workpiece.transpose() * Vector3f(0.30F, 0, -0.18F);
  std::vector<Vector3f> pixels;
  pixels.reserve(vertices.size());
  for (const auto& vertex : vertices) {
    const float rise = vertex[2] - ground;
    const Vector3f foot(vertex[0] + rise * slant.x(), vertex[1] + rise * slant.y(), ground);
    Vector3f pixel = scene.view.pixel_of(foot);
    pixel.head<2>() /= static_cast<float>(scene.samples);
    pixels.push_back(pixel);
  }
  const VisibilityBuffer shadow =
      rasterise(pixels, scene.picture->triangles, image.width, image.height);
  std::vector<float> dark(shadow.triangle.size(), 0.0F);
  for (std::size_t k = 0; k < dark.size(); ++k) {
    if (shadow.triangle[k] != kNoTriangle) dark[k] = 1.0F;
  }
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
      image.blend(x, y, shade_colour, 0.42F * dark[shadow.index(x, y)]);
    }
  }
}

}  // namespace frustum::report
