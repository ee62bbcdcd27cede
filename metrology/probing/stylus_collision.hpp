// Whether a stylus reaches a point without running into the part.
//
// Model    : the shank is a cylinder from the ball's centre to the head. At the contact and at the
//            start of the approach no surface may cross it; and the ball must come down to the
//            start of the approach along the stylus. Each cylinder is sampled by 12 lines on its
//            surface, looked along from both ends
// Units    : mm; the frame of the part
// Shape    : 72 rays a point
// Errors   : none; obstacles thinner than the spacing of the lines, half the diameter, may slip
//            through
// Accuracy : sampled, not bounded
// Source   : ours
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/diagnostic.hpp"
#include "metrology/probing/ball_contact.hpp"
#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

enum class StylusFault { none, shank_at_contact, shank_before, ball_on_the_way };

// `contact`: the ball's centre where it came to rest.
[[nodiscard]] StylusFault stylus_fault(const SurfaceProbeRef& part, const Stylus& stylus,
                                       const BallApproach& approach, const Vec3& contact);

// The faults of one feature's points, gathered into one warning.
class StylusFaults {
 public:
  void note(StylusFault fault, std::size_t point);
  // `points`: how many the feature has.
  [[nodiscard]] std::optional<Diagnostic> warning_for(std::string_view feature,
                                                      std::size_t points) const;

 private:
  std::size_t count_ = 0;
  std::size_t first_ = 0;
  StylusFault kind_ = StylusFault::none;  // of the first
};

}  // namespace frustum::metrology
