#include "post/planning/block_output.hpp"

#include <Eigen/LU>
#include <cmath>

#include "kinematics/model/chain.hpp"
#include "post/planning/block_feed.hpp"
#include "post/planning/pose_run.hpp"

namespace frustum::post {
namespace {

// Some controls allow more between the radii at start and end than others; as chords all read it.
bool is_round(const parser::ArcFeed& arc, const Vec3& start, const Vec3& end) {
  constexpr double kRound = 0.01;  // mm: what the strictest allows
  const Vec3 normal = normal_of(arc.plane);
  const double growth =
      normal.cross(end - arc.center).norm() - normal.cross(start - arc.center).norm();
  return std::abs(growth) <= kRound;
}

}  // namespace

using kinematics::AxisPositions;
using kinematics::kRotaryAxes;
using kinematics::linear_positions;
using parser::AxisLetter;
using parser::AxisTarget;
using parser::CompensationChange;
using parser::Coordinates;
using parser::Feed;

void BlockOutput::write(const BlockPart& part, const AxisPositions& end,
                        const std::optional<ArcImage>& arc) {
  const AxisTarget words = words_at(end, given_letters(part.block, arc || part.whole()));
  std::optional<UnitVec3> vector;
  if (state_.applied.tool_vectors) {
    vector = UnitVec3::of(
        kinematics::nominal_pose(state_.machine, end, state_.length()).rotation.col(2));
  }
  if (part.block.feed == nullptr) {
    state_.emit(parser::Traverse{words, vector, Coordinates::program});
  } else {
    const Feed feed = feed_of(part, end, arc.has_value());
    if (arc) {
      state_.emit(parser::ArcFeed{words, arc->center, arc->plane, arc->turns, vector, feed});
    } else {
      state_.emit(parser::LinearFeed{words, vector, Coordinates::program, feed});
    }
  }
  state_.q = end;
  state_.retracted = false;
}

// The axis words that a block's last part repeats: where nothing is converted, only those given.
AxisTarget BlockOutput::given_letters(const PlannedBlock& block, bool whole) const {
  if (whole && state_.tip_words() == state_.tip_output() && !state_.modes().plane) return block.end;
  AxisTarget all;
  for (const auto& joint : state_.machine.joints()) all[joint.letter] = 0.0;
  return all;
}

// Words of the output that bring the axes to q.
AxisTarget BlockOutput::words_at(const AxisPositions& q, const AxisTarget& letters) const {
  const CompensationChange& by = state_.applied;
  const Vec3 linear = state_.tip_output() ? state_.tip_words_at(q, by)
                                          : Vec3(linear_positions(q) - state_.axis_shift(by));
  AxisTarget words;
  for (const AxisLetter letter : kinematics::kLinearAxes) {
    if (letters[letter]) words[letter] = linear[static_cast<Eigen::Index>(letter)];
  }
  if (state_.applied.tool_vectors) return words;
  for (const AxisLetter letter : kRotaryAxes) {
    if (state_.machine.joint(letter) != nullptr && (letters[letter] || rotary_.by_vector())) {
      words[letter] = q[letter];
    }
  }
  return words;
}

std::optional<ArcImage> BlockOutput::arc_image(const PlannedBlock& block,
                                               const CompensationChange& wanted,
                                               const Mat3& table_from_in, const Vec3& start) const {
  if (block.arc == nullptr || state_.options.arcs == ArcForm::none) return {};
  const AxisPositions& q = state_.q;
  if (rotary_travel(q, rotary_.end()) > kNoTravel) return {};
  if (!is_round(*block.arc, start, with_words(start, block.end))) return {};
  Mat3 out_from_in = table_from_in;
  Vec3 start_out = state_.tip_words_at(q, wanted);
  if (tip_control(wanted)) {
    const Vec3 axis = kinematics::nominal_pose(state_.machine, q, 0.0).rotation.col(2);
    // rad: the cosine of the tilt is one within rounding.
    constexpr double kUpright = 1e-9;
    const Vec3 normal = table_from_in * normal_of(block.arc->plane);
    if (axis.cross(normal).norm() > kUpright) return {};
  } else {
    out_from_in = kinematics::linear_axis_directions(state_.machine, q).inverse() * table_from_in;
    start_out = linear_positions(q) - state_.axis_shift(wanted);
  }
  auto image = image_of(*block.arc, out_from_in, start, start_out);
  if (image && state_.options.arcs == ArcForm::flat) {
    const Vec3 rise = with_words(start, block.end) - start;
    const bool flat = std::abs(rise.dot(normal_of(block.arc->plane))) <= kNoTravel;
    const bool in_xy = image->plane == parser::Plane::xy;
    if (!flat || !in_xy || std::abs(image->turns) > 1) return {};
  }
  return image;
}

Feed BlockOutput::feed_of(const BlockPart& part, const AxisPositions& end, bool arc) const {
  const kinematics::ControllerState& program = state_.controller;
  const bool tip_words = state_.tip_output();
  const Vec3 way = tip_words ? Vec3(program.tip_at(end) - program.tip_at(state_.q))
                             : Vec3(linear_positions(end) - linear_positions(state_.q));
  return feed_for(*part.block.feed, {.minutes = part.minutes * (part.to - part.from),
                                     .length = way.norm(),
                                     .turn = rotary_travel(state_.q, end),
                                     .tip_words = tip_words,
                                     .arc = arc});
}

}  // namespace frustum::post
