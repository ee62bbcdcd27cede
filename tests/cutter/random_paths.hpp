// Random tool paths, degenerate ones among them, from a seed.
//
// Units: mm, rad; frame: workpiece. Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/random.hpp"
#include "kinematics/path/tool_path.hpp"

namespace frustum::proof {

class Draw {
 public:
  explicit Draw(std::uint64_t seed, std::uint32_t draw = 0)
      : key_{seed, draw, RandomPurpose::test_data} {}
  double between(double lo, double hi) { return lo + (hi - lo) * uniform(key_, index_++); }
  // Equally often in every decade.
  double decades(double lo, double hi);
  int below(int n) { return static_cast<int>(between(0.0, n)); }
  bool chance(double probability) { return between(0.0, 1.0) < probability; }
  Vec3 point(const Vec3& lo, const Vec3& hi);
  Vec3 direction();
  // Within `tilt` of +Z.
  Vec3 axis(double tilt);

 private:
  RandomKey key_;
  std::uint64_t index_ = 0;
};

enum class MotionFamily : std::uint8_t {
  straight,       // axis along Z, level feed
  tilted,         // straight, the axis anywhere, the feed anywhere
  plunge,         // along the axis, down or up
  dwell,          // no motion
  about_the_tip,  // pure rotation
  five_axis,      // up to 30 mm and 30 degrees
  wild,           // up to 20 mm and 150 degrees
  tiny,           // down to rounding
  block_of_many,  // half a millimetre and a milliradian, as long programs have
  crossing,       // six segments over each other, some of no length
};
inline constexpr std::array kMotionFamilies = {
    MotionFamily::straight,      MotionFamily::tilted,    MotionFamily::plunge, MotionFamily::dwell,
    MotionFamily::about_the_tip, MotionFamily::five_axis, MotionFamily::wild,   MotionFamily::tiny,
    MotionFamily::block_of_many, MotionFamily::crossing};
[[nodiscard]] std::string to_string(MotionFamily family);

// Tool 1 through these poses; each segment a block of its own, from line 1.
[[nodiscard]] kinematics::ToolPath path_through(const std::vector<kinematics::ToolPose>& poses);
[[nodiscard]] kinematics::ToolPath random_path(MotionFamily family, Draw& draw);

}  // namespace frustum::proof
