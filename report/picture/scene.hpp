// What a picture is drawn from: the surface, the view, and what each sample of it sees.
//
// Units: camera mm (report/picture/view.hpp); samples, of which `samples` x `samples` make one
//        pixel.
// Errors: none for a valid picture.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "report/picture/crease_normals.hpp"
#include "report/picture/surface_rays.hpp"
#include "report/picture/view.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

class Scene {
 public:
  // Of width x height pixels; the view is in samples. Casts the rays of all samples, on oneTBB.
  Scene(const SurfacePicture& picture, const View& view, int width, int height, int samples);

  [[nodiscard]] const SurfacePicture& picture() const { return picture_; }
  [[nodiscard]] const View& view() const { return view_; }
  [[nodiscard]] const SurfaceRays& rays() const { return rays_; }
  [[nodiscard]] int samples() const { return samples_; }
  // In samples.
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] const Seen& seen(int x, int y) const {
    return seen_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(x)];
  }
  // z of the workpiece in the camera frame, and the lowest z of the part.
  [[nodiscard]] const Eigen::Vector3f& up() const { return up_; }
  [[nodiscard]] float ground() const { return ground_; }

  // In the camera frame, unit: as shaded, and as the triangle faces (towards the viewer).
  [[nodiscard]] Eigen::Vector3f normal(const Seen& seen) const;
  [[nodiscard]] Eigen::Vector3f facing(const Seen& seen) const;
  [[nodiscard]] Eigen::Vector3f place(int x, int y, const Seen& seen) const;

 private:
  const SurfacePicture& picture_;
  View view_;
  int samples_, columns_, rows_;
  std::vector<Eigen::Vector3f> vertices_;  // in the camera frame
  std::vector<CornerNormals> normals_;     // in the workpiece frame
  SurfaceRays rays_;
  Eigen::Vector3f up_;
  float ground_ = 0.0F;
  std::vector<Seen> seen_{};
};

// Of the corners of the triangle.
[[nodiscard]] inline std::array<float, 3> weights_of(const Seen& seen) {
  return {1.0F - seen.weight_b - seen.weight_c, seen.weight_b, seen.weight_c};
}

}  // namespace frustum::report
