#include "programs/motion/motion_blocks.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "programs/piece_tool.hpp"

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using Motion = std::function<AxisPositions(double)>;

constexpr int kSpindleBall = 1;  // tool
constexpr double kChord = 1e-5;  // mm: half of what samples may be off the program's readings
constexpr double kRotaryChord =
    1e-4;                       // rad: what an axis may be early or late at a tip that is right
constexpr double kBall = 10.0;  // mm: diameter, which moves nothing

}  // namespace

TestPiece motion_frame(const Vec3& origin, double tool_length) {
  TestPiece piece;
  piece.work_offsets = {{1, origin}};
  piece.tools[kSpindleBall] = piece_tool({kBall}, {tool_length}, {kBall});
  return piece;
}

MotionBlocks::MotionBlocks(const kinematics::Machine& machine, const std::string& number,
                           const std::string& title, const Vec3& origin, double tool_length,
                           const MotionProgramOptions& options)
    : machine_(machine),
      options_(options),
      origin_(origin),
      tool_length_(tool_length),
      zero_(kinematics::place_tip(machine, origin, tool_length, {})),
      nc_(number, title) {}

Vec3 MotionBlocks::tip_of(const AxisPositions& q) const {
  return nominal_pose(machine_, q, tool_length_).translation;
}

parser::AxisTarget MotionBlocks::words_of(const AxisPositions& q) const {
  parser::AxisTarget target;
  if (options_.form == MotionForm::tcp) {
    target = tip_target(tip_of(q) - origin_);
  } else {
    target = tip_target(kinematics::linear_positions(q) - kinematics::linear_positions(zero_));
  }
  for (const AxisLetter letter : parser::kRotaryAxes) {
    if (machine_.joint(letter) != nullptr) target[letter] = q[letter];
  }
  return target;
}

void MotionBlocks::retract() {
  nc_.block({parser::CompensationChange{}});
  if (const auto* z = machine_.joint(AxisLetter::Z)) {
    parser::AxisTarget up;
    up[AxisLetter::Z] = z->home;
    nc_.block({machine_traverse(up)});
  }
}

void MotionBlocks::begin(const AxisPositions& first) {
  nc_.without_compensation();
  nc_.block({parser::ToolChange{kSpindleBall}});
  retract();
  parser::AxisTarget rotary;
  for (const AxisLetter letter : parser::kRotaryAxes) {
    if (machine_.joint(letter) != nullptr) rotary[letter] = first[letter];
  }
  if (rotary != parser::AxisTarget{}) nc_.block({machine_traverse(rotary)});
  using enum parser::LengthCompensation;
  nc_.block({parser::CompensationChange{
                 .mode = options_.form == MotionForm::tcp ? tool_centre_point : length,
                 .offset_number = kSpindleBall},
             parser::WorkOffsetChange{1}});
}

void MotionBlocks::approach(const AxisPositions& to) {
  parser::AxisTarget across = words_of(to);
  const parser::AxisTarget all = across;
  across[AxisLetter::Z] = std::nullopt;
  // Under tool centre point control Z of the table may be any axis of the machine.
  if (options_.form == MotionForm::axes) nc_.block({parser::Traverse{.end = across}});
  nc_.block({parser::Traverse{.end = all}});
}

void MotionBlocks::rapid(const AxisPositions& to) {
  nc_.block({parser::Traverse{.end = words_of(to)}});
}

void MotionBlocks::feed(const AxisPositions& to) {
  nc_.block({parser::LinearFeed{.end = words_of(to), .feed = {options_.feed}}});
}

double MotionBlocks::unevenness(const Motion& motion, double from, double to) const {
  const AxisPositions a = motion(from), b = motion(to);
  const Vec3 tip_a = tip_of(a), tip_b = tip_of(b);
  double most = 0.0;
  // Odd shares, so that no symmetric curve passes through them all.
  for (const double share : {0.21, 0.5, 0.77}) {
    const AxisPositions q = motion(from + share * (to - from));
    const AxisPositions straight = kinematics::part_way(a, b, share);
    if (options_.form == MotionForm::axes) {
      most = std::max(most, (tip_of(straight) - tip_of(q)).norm() / kChord);
      continue;
    }
    most = std::max(most, (tip_a + share * (tip_b - tip_a) - tip_of(q)).norm() / kChord);
    for (const AxisLetter letter : kinematics::kRotaryAxes) {
      most = std::max(most, std::abs(straight[letter] - q[letter]) / kRotaryChord);
    }
  }
  return most;
}

void MotionBlocks::split(const Motion& motion, double from, double to, int depth) {
  constexpr int kDeepest = 16;
  const double off = unevenness(motion, from, to);
  if (depth >= kDeepest || off <= 1.0) {
    feed(motion(to));
    return;
  }
  // Parts of a chord are off by its square; a whole turn is none.
  constexpr double kMostParts = 64.0;
  const int parts = static_cast<int>(std::ceil(std::min(std::sqrt(off) * 1.001, kMostParts)));
  double begin = from;
  for (int i = 1; i <= parts; ++i) {
    const double end = from + (to - from) * i / parts;
    split(motion, begin, end, depth + 1);
    begin = end;
  }
}

void MotionBlocks::along(const Motion& motion, double from, double to) {
  split(motion, from, to, 0);
}

void MotionBlocks::arc(const AxisPositions& to, const AxisPositions& centre,
                       instruments::Plane plane, double turn) {
  constexpr std::array kPlaneWords{parser::Plane::xy, parser::Plane::yz, parser::Plane::zx};
  constexpr double kRounding = 1e-9;  // turns
  const int turns = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kTurn - kRounding)));
  nc_.block({parser::ArcFeed{
      .end = words_of(to),
      .center = kinematics::linear_positions(centre) - kinematics::linear_positions(zero_),
      .plane = kPlaneWords.at(static_cast<std::size_t>(plane)),
      .turns = turn > 0.0 ? turns : -turns,
      .feed = {options_.feed}}});
}

void MotionBlocks::dwell(double seconds) { nc_.block({parser::Dwell{seconds}}); }

void MotionBlocks::stop(const std::string& message) {
  nc_.comment(message);
  nc_.block({parser::Stop{parser::StopKind::program_stop}});
}

Result<TestPiece> MotionBlocks::end(const std::string& name, const std::string& title) {
  retract();
  nc_.block({parser::Stop{}});
  TestPiece piece = motion_frame(origin_, tool_length_);
  piece.title = title;
  piece.program_file = name + ".nc";
  if (const auto written = nc_.write(piece, options_.dialect); !written) return written.error();
  return piece;
}

}  // namespace frustum::programs
