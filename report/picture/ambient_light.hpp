// How much of the sky lights each pixel of a picture: ambient occlusion by rays.
//
// Model   : rays over the hemisphere around the normal, denser where the surface faces, each up to
//           a length drawn from 0 to the reach, so that what hides fades with its distance. The
//           ground below the part hides too. 16 neighbouring pixels share 256 directions, and each
//           takes the mean of its neighbours on the same face
// Units   : pixels
// Shape   : 16 rays a pixel
// Errors  : none
// Accuracy: for the eye; fixed directions, the same bits for any number of threads
// Source  : Landis 2002, SIGGRAPH course 16 (ambient occlusion); Roberts 2018 (the R sequence)
#pragma once

#include <vector>

#include "report/picture/scene.hpp"

namespace frustum::report {

class AmbientLight {
 public:
  explicit AmbientLight(const Scene& scene);
  // From 0 (all hidden) to 1 (all open).
  [[nodiscard]] float at(int x, int y) const;

 private:
  struct Pixel {
    float open = 1.0F;
    float depth = 0.0F;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // zero: sees no part
  };
  [[nodiscard]] const Pixel& pixel(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }

  int width_, height_;
  float depth_tolerance_;  // mm
  std::vector<Pixel> pixels_;
};

}  // namespace frustum::report
