// An orthographic view of the workpiece.
//
// Frames: camera, x right, y up, z towards the viewer, in mm; pixels, x right, y down, (0, 0) at
//         the upper left corner of the picture, pixel centres at halves. Errors: none.
#pragma once

#include <Eigen/Core>

namespace frustum::report {

struct View {
  Eigen::Matrix3f camera_from_workpiece = Eigen::Matrix3f::Identity();  // rotation
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();  // camera mm, shown at `centre_pixel`
  Eigen::Vector2f centre_pixel = Eigen::Vector2f::Zero();
  float pixels_per_mm = 1.0F;

  // Camera mm at a place in the picture.
  [[nodiscard]] float x_at(float pixel_x) const {
    return centre.x() + (pixel_x - centre_pixel.x()) / pixels_per_mm;
  }
  [[nodiscard]] float y_at(float pixel_y) const {
    return centre.y() - (pixel_y - centre_pixel.y()) / pixels_per_mm;
  }
};

// The view from `azimuth` (rad about +z, from +x) and `elevation` (rad above the xy plane).
[[nodiscard]] Eigen::Matrix3f camera_from_workpiece(double azimuth, double elevation);

}  // namespace frustum::report
