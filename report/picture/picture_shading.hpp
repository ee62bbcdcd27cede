// Light on the surface of a picture: from the visibility buffer to colours.
//
// Model : two diffuse lights and a sky fixed to the camera, a faint highlight, ambient occlusion from
//         the depths around a pixel, a soft shadow on the ground
// Units : mm in depths, pixels in radii; colours in linear light
// Shape : `samples` x `samples` buffer pixels make one image pixel
// Errors: none
// Accuracy: for the eye
// Source: common practice
#pragma once

#include <vector>

#include "report/picture/crease_normals.hpp"
#include "report/picture/image.hpp"
#include "report/picture/rasteriser.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

// What shading looks at, all for the same picture and view.
struct Scene {
  const SurfacePicture* picture = nullptr;
  const std::vector<CornerNormals>* normals = nullptr;  // in the workpiece frame
  View view{};                                          // in buffer pixels
  std::vector<Eigen::Vector3f> pixels{};                // vertices in buffer pixels
  VisibilityBuffer buffer{};
  int samples = 3;
  double deviation_span = 1e-3;  // mm
};

// Draws the workpiece over `image`, whose size times `samples` is the size of the buffer.
void shade(const Scene& scene, Image& image);

// Darkens the ground below the workpiece; call before shade().
void cast_ground_shadow(const Scene& scene, Image& image);

}  // namespace frustum::report
