// The programmable frame of Sinumerik: what TRANS, ROT, SCALE and MIRROR make, and their additive
// forms.
//
// Model : outer coordinates = origin + scale linear words, linear orthogonal, with det -1 when it
//         mirrors
// Units : mm, rad
// Errors: none
#pragma once

#include <array>

#include "core/pose.hpp"
#include "parser/interpret/state/programmed_frame.hpp"

namespace frustum::parser {

struct ProgramFrame {
  Mat3 linear = Mat3::Identity();
  double scale = 1.0;
  Vec3 origin = Vec3::Zero();
  std::array<double, 3> rotary_shift{};

  [[nodiscard]] static ProgramFrame shift(const Vec3& origin,
                                          const std::array<double, 3>& rotary_shift);
  // About Z, then the new Y, then the new X (RPY angles): linear = Rz Ry Rx.
  [[nodiscard]] static ProgramFrame turn(const Vec3& angles);
  [[nodiscard]] static ProgramFrame scaling(double factor);
  [[nodiscard]] static ProgramFrame mirror(const std::array<bool, 3>& axes);

  [[nodiscard]] Vec3 point(const Vec3& words) const { return origin + scale * (linear * words); }
  // The frame whose words are those of `inner`, within this one.
  [[nodiscard]] ProgramFrame with(const ProgramFrame& inner) const;
  // The same as shift, turn, scale and mirrors of a word frame.
  [[nodiscard]] ProgrammedFrame programmed_frame() const;
};

}  // namespace frustum::parser
