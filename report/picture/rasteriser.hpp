// Which triangle is seen at each pixel of an orthographic view: the visibility buffer.
//
// Frames: camera, x right, y up, z towards the viewer, in mm; pixels, x right, y down, (0, 0) at the
// upper left corner of the picture, pixel centres at halves.
// Errors: none for a valid picture.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "report/run_report.hpp"

namespace frustum::report {

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

// An orthographic view of the workpiece.
struct View {
  Eigen::Matrix3f camera_from_workpiece = Eigen::Matrix3f::Identity();  // rotation
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();  // camera mm, shown at `centre_pixel`
  Eigen::Vector2f centre_pixel = Eigen::Vector2f::Zero();
  float pixels_per_mm = 1.0F;

  // x, y in pixels; z in mm towards the viewer.
  [[nodiscard]] Eigen::Vector3f pixel_of(const Eigen::Vector3f& in_workpiece) const;
};

// The view from `azimuth` (rad about +z, from +x) and `elevation` (rad above the xy plane).
[[nodiscard]] Eigen::Matrix3f camera_from_workpiece(double azimuth, double elevation);

struct VisibilityBuffer {
  int width = 0;
  int height = 0;
  std::vector<float> depth{};             // mm towards the viewer; lowest() where nothing is seen
  std::vector<std::uint32_t> triangle{};  // kNoTriangle where nothing is seen

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

// `pixels` are the vertices as View::pixel_of gives them.
[[nodiscard]] VisibilityBuffer rasterise(const std::vector<Eigen::Vector3f>& pixels,
                                         const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                         int width, int height);

// Barycentric weights of a pixel position in a triangle of `pixels`; {1, 0, 0} for one without area.
[[nodiscard]] std::array<float, 3> weights_at(const std::array<Eigen::Vector3f, 3>& corners,
                                              float x, float y);

}  // namespace frustum::report
