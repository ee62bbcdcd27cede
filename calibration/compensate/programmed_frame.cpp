#include "calibration/compensate/programmed_frame.hpp"

#include <cmath>

#include "core/units.hpp"
#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"

namespace frustum::calibration {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::kRotaryAxes;

constexpr double kLengthUnits = 1e6;  // of the last decimal in a mm (parser/writing/nc_lines.hpp)
constexpr double kAngleUnits = 1e7;   // in a degree
// One unit of the last decimal, and what rounding adds to it.
constexpr double kLengthHeld = 1.5 / kLengthUnits;
constexpr double kAngleHeld = 1.5 / kAngleUnits * kRadPerDeg;

double written(double value, double units) { return std::round(value * units) / units; }

}  // namespace

Words between(const Words& from, const Words& to, double t) {
  Words words{from.linear + t * (to.linear - from.linear), from.rotary};
  for (const AxisLetter letter : kRotaryAxes) {
    words.rotary[letter] += t * (to.rotary[letter] - from.rotary[letter]);
  }
  return words;
}

Words as_written(const Words& words) {
  Words result;
  for (Eigen::Index i = 0; i < 3; ++i) result.linear[i] = written(words.linear[i], kLengthUnits);
  for (const AxisLetter letter : kRotaryAxes) {
    result.rotary[letter] = written(words.rotary[letter] * kDegPerRad, kAngleUnits) * kRadPerDeg;
  }
  return result;
}

Words held(const Words& from, Words to) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (std::abs(to.linear[i] - from.linear[i]) < kLengthHeld) to.linear[i] = from.linear[i];
  }
  for (const AxisLetter letter : kRotaryAxes) {
    if (std::abs(to.rotary[letter] - from.rotary[letter]) < kAngleHeld) {
      to.rotary[letter] = from.rotary[letter];
    }
  }
  return to;
}

bool same(const Words& a, const Words& b) {
  bool rotary = true;
  for (const AxisLetter letter : kRotaryAxes) {
    rotary = rotary && a.rotary[letter] == b.rotary[letter];
  }
  return rotary && a.linear == b.linear;
}

ProgrammedFrame::ProgrammedFrame(const kinematics::Machine& machine,
                                 const kinematics::ControllerState& state)
    : machine_(&machine),
      tip_words_(state.modes().tip_control()),
      length_(state.tool_length()),
      zero_(tip_words_ ? state.origin() : state.axis_shift()) {}

Words ProgrammedFrame::words_of(const AxisPositions& q) const {
  const Vec3 linear = tip_words_ ? kinematics::nominal_pose(*machine_, q, length_).translation
                                 : kinematics::linear_positions(q);
  return {linear - zero_, q};
}

AxisPositions ProgrammedFrame::axes_of(const Words& words) const {
  const Vec3 linear = words.linear + zero_;
  if (tip_words_) return kinematics::place_tip(*machine_, linear, length_, words.rotary);
  return kinematics::with_linear_positions(words.rotary, linear);
}

}  // namespace frustum::calibration
