// Rays against the triangles of a picture: what is seen, and what hides the light.
//
// Model   : Embree, with its watertight test, so that no ray slips between neighbouring triangles
// Units   : mm; frame: camera (report/picture/view.hpp)
// Shape   : a hierarchy of boxes over the triangles, built once
// Errors  : none for a valid picture; std::bad_alloc when memory ends
// Accuracy: single precision, for the eye. The same bits for any number of threads: each ray is for
//           itself
// Source  : Wald, Woop, Benthin, Johnson, Ernst 2014, ACM TOG 33(4)
// Threads : const member functions may be called from any number of threads
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace frustum::report {

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

// What a ray towards the part has met.
struct Seen {
  float depth = std::numeric_limits<float>::lowest();  // camera z (mm)
  std::uint32_t triangle = kNoTriangle;
  float weight_b = 0.0F, weight_c = 0.0F;  // of its second and third corner; the first has the rest
};

class SurfaceRays {
 public:
  SurfaceRays(std::span<const Eigen::Vector3f> vertices,
              std::span<const std::array<std::uint32_t, 3>> triangles);
  ~SurfaceRays();

  // The first triangle on the way from the viewer along -z at (from_x + k step, y), for each k.
  void see_row(float from_x, float step, float y, std::span<Seen> row) const;
  // Whether a triangle is within `reach` of `origin` in the (unit) direction.
  [[nodiscard]] bool is_hidden(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                               float reach) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
  float nearest_ = 0.0F;  // camera z of the part's nearest point (mm)
};

}  // namespace frustum::report
