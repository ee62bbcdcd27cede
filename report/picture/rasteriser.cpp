#include "report/picture/rasteriser.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::report {
namespace {

// Twice the signed area of (a, b, p) in pixels.
double edge(const Eigen::Vector3f& a, const Eigen::Vector3f& b, double x, double y) {
  return (static_cast<double>(b.x()) - static_cast<double>(a.x())) *
             (y - static_cast<double>(a.y())) -
         (static_cast<double>(b.y()) - static_cast<double>(a.y())) *
             (x - static_cast<double>(a.x()));
}

// The pixels from low to high whose centres may lie between `from` and `to`.
std::array<int, 2> pixel_span(float from, float to, int count) {
  const auto last = static_cast<float>(count - 1);
  return {static_cast<int>(std::clamp(std::floor(from - 0.5F), 0.0F, last)),
          static_cast<int>(std::clamp(std::ceil(to - 0.5F), 0.0F, last))};
}

// Where the row at height y crosses the triangle, from left to right; empty (from > to) when it does not.
struct RowCrossing {
  float from = std::numeric_limits<float>::max();
  float to = std::numeric_limits<float>::lowest();
};
RowCrossing crossing(const std::array<const Eigen::Vector3f*, 3>& corners, float y) {
  RowCrossing row;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3f& p = *corners[k];
    const Eigen::Vector3f& q = *corners[(k + 1) % 3];
    if ((p.y() < y && q.y() < y) || (p.y() > y && q.y() > y) || p.y() == q.y()) continue;
    const float x = p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
    row.from = std::min(row.from, x);
    row.to = std::max(row.to, x);
  }
  return row;
}

}  // namespace

Eigen::Vector3f View::pixel_of(const Eigen::Vector3f& in_workpiece) const {
  const Eigen::Vector3f in_camera = camera_from_workpiece * in_workpiece;
  return {centre_pixel.x() + (in_camera.x() - centre.x()) * pixels_per_mm,
          centre_pixel.y() - (in_camera.y() - centre.y()) * pixels_per_mm, in_camera.z()};
}

Eigen::Matrix3f camera_from_workpiece(double azimuth, double elevation) {
  const Eigen::Vector3d towards(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Eigen::Vector3d right(-std::sin(azimuth), std::cos(azimuth), 0.0);
  Eigen::Matrix3d rotation;
  rotation.row(0) = right;
  rotation.row(1) = towards.cross(right);
  rotation.row(2) = towards;
  return rotation.cast<float>();
}

VisibilityBuffer rasterise(const std::vector<Eigen::Vector3f>& pixels,
                           const std::vector<std::array<std::uint32_t, 3>>& triangles, int width,
                           int height) {
  VisibilityBuffer buffer;
  buffer.width = width;
  buffer.height = height;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  buffer.depth.assign(count, std::numeric_limits<float>::lowest());
  buffer.triangle.assign(count, kNoTriangle);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Eigen::Vector3f& a = pixels[triangles[t][0]];
    const Eigen::Vector3f& b = pixels[triangles[t][1]];
    const Eigen::Vector3f& c = pixels[triangles[t][2]];
    const double area = edge(a, b, static_cast<double>(c.x()), static_cast<double>(c.y()));
    if (area == 0.0) continue;
    const auto [y_low, y_high] =
        pixel_span(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}), height);
    for (int y = y_low; y <= y_high; ++y) {
      const RowCrossing row = crossing({&a, &b, &c}, static_cast<float>(y) + 0.5F);
      if (row.from > row.to) continue;
      // A pixel more on either side: the weights decide, not the rounding of the crossing.
      const auto [x_low, x_high] = pixel_span(row.from - 1.0F, row.to + 1.0F, width);
      for (int x = x_low; x <= x_high; ++x) {
        const double at_x = x + 0.5;
        const double at_y = y + 0.5;
        const double wa = edge(b, c, at_x, at_y) / area;
        const double wb = edge(c, a, at_x, at_y) / area;
        const double wc = 1.0 - wa - wb;
        if (wa < 0.0 || wb < 0.0 || wc < 0.0) continue;
        const auto depth =
            static_cast<float>(wa * static_cast<double>(a.z()) + wb * static_cast<double>(b.z()) +
                               wc * static_cast<double>(c.z()));
        const std::size_t k = buffer.index(x, y);
        if (depth <= buffer.depth[k]) continue;
        buffer.depth[k] = depth;
        buffer.triangle[k] = static_cast<std::uint32_t>(t);
      }
    }
  }
  return buffer;
}

std::array<float, 3> weights_at(const std::array<Eigen::Vector3f, 3>& corners, float x, float y) {
  const auto& [a, b, c] = corners;
  const double area = edge(a, b, static_cast<double>(c.x()), static_cast<double>(c.y()));
  if (area == 0.0) return {1.0F, 0.0F, 0.0F};
  const double wa = edge(b, c, static_cast<double>(x), static_cast<double>(y)) / area;
  const double wb = edge(c, a, static_cast<double>(x), static_cast<double>(y)) / area;
  return {static_cast<float>(wa), static_cast<float>(wb), static_cast<float>(1.0 - wa - wb)};
}

}  // namespace frustum::report
