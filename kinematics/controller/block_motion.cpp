#include "kinematics/controller/block_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinematics/model/inverse.hpp"

namespace frustum::kinematics {
namespace {

// Rotary motion is cut at least this fine before any bound decides, so that symmetric error shapes
// cannot hide between the check points.
constexpr double kRotaryPart = 5.0 * kRadPerDeg;
constexpr double kLinearPart = 25.0;  // mm, for the same reason
// A tip that moves less than this stands: below any written coordinate.
constexpr double kStanding = 1e-9;  // mm

double rotary_degrees(const AxisPositions& from, const AxisPositions& to) {
  double sum = 0.0;
  for (const AxisLetter letter : kRotaryAxes) {
    const double turn = (to[letter] - from[letter]) * kDegPerRad;
    sum += turn * turn;
  }
  return std::sqrt(sum);
}

std::array<double, 3> rotary_positions(const AxisPositions& q) {
  return {q[AxisLetter::A], q[AxisLetter::B], q[AxisLetter::C]};
}

}  // namespace

Vec3 linear_positions(const AxisPositions& q) {
  return {q[AxisLetter::X], q[AxisLetter::Y], q[AxisLetter::Z]};
}

AxisPositions with_linear_positions(AxisPositions q, const Vec3& xyz) {
  for (const AxisLetter letter : kLinearAxes) q[letter] = xyz[static_cast<Eigen::Index>(letter)];
  return q;
}

AxisPositions part_way(const AxisPositions& from, const AxisPositions& to, double u) {
  AxisPositions q;
  for (const AxisLetter letter : kAxisLetters) {
    q[letter] = from[letter] + u * (to[letter] - from[letter]);
  }
  return q;
}

int least_parts(const AxisPositions& from, const AxisPositions& to, double arc_turn) {
  double rotary_travel = std::abs(arc_turn);
  for (const AxisLetter letter : kRotaryAxes) {
    rotary_travel = std::max(rotary_travel, std::abs(to[letter] - from[letter]));
  }
  const double linear_travel = (linear_positions(to) - linear_positions(from)).norm();
  // No machine goes that far, but programs say so.
  constexpr double kMostParts = 1e9;
  const double parts = rotary_travel / kRotaryPart + linear_travel / kLinearPart;
  return 1 + static_cast<int>(parts < kMostParts ? parts : kMostParts);
}

BlockMotion::BlockMotion(const AxisPositions& from, Law law, double linear)
    : start_(from), law_(std::move(law)), end_(at(1.0)) {
  feed_length_ = linear > kStanding ? linear : rotary_degrees(from, end_);
}

AxisPositions BlockMotion::at(double u) const {
  return std::visit([&](const auto& law) { return position(law, u); }, law_);
}

AxisPositions BlockMotion::with_rotary(const RotaryPositions& to, double u) const {
  AxisPositions q = start_;
  for (const AxisLetter letter : kRotaryAxes) {
    const double end = to[static_cast<std::size_t>(letter) - kLinearAxes.size()];
    q[letter] = start_[letter] + u * (end - start_[letter]);
  }
  return q;
}

AxisPositions BlockMotion::position(const AxesLaw& law, double u) const {
  return part_way(start_, law.to, u);
}

AxisPositions BlockMotion::position(const WordsLaw& law, double u) const {
  return with_linear_positions(with_rotary(law.rotary_to, u), law.words.at(u) + law.shift);
}

AxisPositions BlockMotion::position(const TipLaw& law, double u) const {
  return place_tip(*law.machine, law.frame->table_from_words.point(law.tip.at(u)),
                   law.frame->tool_length, with_rotary(law.rotary_to, u));
}

AxisPositions BlockMotion::position(const VectorLaw& law, double u) const {
  return place_tip(*law.machine, law.frame->table_from_words.point(law.tip.at(u)),
                   law.frame->tool_length, law.orientation->at(u));
}

bool BlockMotion::straight() const {
  if (const auto* words = std::get_if<WordsLaw>(&law_)) return words->words.turn == 0.0;
  return std::holds_alternative<AxesLaw>(law_);
}

std::span<const double> BlockMotion::breaks() const {
  const auto* vector = std::get_if<VectorLaw>(&law_);
  return vector == nullptr ? std::span<const double>() : vector->orientation->breaks();
}

double BlockMotion::arc_turn() const {
  if (const auto* words = std::get_if<WordsLaw>(&law_)) return words->words.turn;
  if (const auto* tip = std::get_if<TipLaw>(&law_)) return tip->tip.turn;
  if (const auto* vector = std::get_if<VectorLaw>(&law_)) return vector->tip.turn;
  return 0.0;
}

int BlockMotion::least_parts() const { return kinematics::least_parts(start_, end_, arc_turn()); }

BlockMotion axes_motion(const AxisPositions& from, const AxisPositions& to) {
  return {from, BlockMotion::AxesLaw{to}, (linear_positions(to) - linear_positions(from)).norm()};
}

BlockMotion words_motion(const AxisPositions& from, const AxisPositions& rotary_to,
                         const TipCurve& words, const Vec3& shift) {
  return {from, BlockMotion::WordsLaw{rotary_positions(rotary_to), words, shift}, words.length()};
}

BlockMotion tip_motion(const Machine& machine, const AxisPositions& from,
                       const AxisPositions& rotary_to, const TipCurve& tip,
                       std::shared_ptr<const TipFrame> frame) {
  return {from, BlockMotion::TipLaw{&machine, rotary_positions(rotary_to), tip, std::move(frame)},
          tip.length()};
}

Result<BlockMotion> vector_motion(const Machine& machine, const AxisPositions& from,
                                  const Vec3& to_tool_axis, const TipCurve& tip,
                                  std::shared_ptr<const TipFrame> frame) {
  auto path = orientation_path(machine, from, to_tool_axis);
  if (!path) return path.error();
  auto orientation = std::make_shared<const OrientationPath>(*std::move(path));
  return BlockMotion(
      from, BlockMotion::VectorLaw{&machine, std::move(orientation), tip, std::move(frame)},
      tip.length());
}

}  // namespace frustum::kinematics
