#include "parser/interpret/state/programmed_frame.hpp"

#include <variant>

#include "parser/arc.hpp"

namespace frustum::parser {
namespace {

constexpr double kSameDirection = 1e-12;

// What is not known counts as zero.
Vec3 point_of(const AxisTarget& target) {
  return {target[AxisLetter::X].value_or(0.0), target[AxisLetter::Y].value_or(0.0),
          target[AxisLetter::Z].value_or(0.0)};
}

// The coordinates of `point` that come of known ones of `from` alone, by `rotation`.
void set_known(AxisTarget& target, const Vec3& point, const AxisTarget& from,
               const Mat3& rotation) {
  for (const AxisLetter axis : kLinearAxes) {
    const auto row = static_cast<Eigen::Index>(axis);
    target[axis] = point[row];
    for (const AxisLetter other : kLinearAxes) {
      if (rotation(row, static_cast<Eigen::Index>(other)) != 0.0 && !from[other])
        target[axis].reset();
    }
  }
}

}  // namespace

bool ProgrammedFrame::turns() const { return turn.rotation != Mat3::Identity(); }

bool ProgrammedFrame::mixes(AxisLetter axis) const {
  const auto i = static_cast<Eigen::Index>(axis);
  for (Eigen::Index other = 0; other < 3; ++other) {
    if (other != i && (turn.rotation(i, other) != 0.0 || turn.rotation(other, i) != 0.0))
      return true;
  }
  return false;
}

bool ProgrammedFrame::blends(AxisLetter axis) const {
  const auto i = static_cast<Eigen::Index>(axis);
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index other = 0; other < 3; ++other) {
      const bool both = turn.rotation(row, i) != 0.0 && turn.rotation(row, other) != 0.0;
      if (other != i && both) return true;
    }
  }
  return false;
}

bool ProgrammedFrame::is_identity() const {
  return shift.isZero(0.0) && turn.translation.isZero(0.0) &&
         rotary_shift == std::array<double, 3>{} && !turns() && scale == 1.0 && !is_mirrored();
}

double ProgrammedFrame::stretched(AxisLetter axis, double value) const {
  const auto i = static_cast<std::size_t>(axis);
  const double centre = scale_centre[static_cast<Eigen::Index>(axis)];
  const double scaled = scale == 1.0 ? value : centre + scale * (value - centre);
  return mirrors.at(i) ? 2.0 * *mirrors.at(i) - scaled : scaled;
}

double ProgrammedFrame::unstretched(AxisLetter axis, double value) const {
  const auto i = static_cast<std::size_t>(axis);
  const double centre = scale_centre[static_cast<Eigen::Index>(axis)];
  const double scaled = mirrors.at(i) ? 2.0 * *mirrors.at(i) - value : value;
  return scale == 1.0 ? scaled : centre + (scaled - centre) / scale;
}

Vec3 ProgrammedFrame::point(const Vec3& words) const {
  const Vec3 turned = turn.point(words + shift);
  Vec3 placed;
  for (const AxisLetter axis : kLinearAxes) {
    const auto i = static_cast<Eigen::Index>(axis);
    placed[i] = stretched(axis, turned[i]);
  }
  return placed;
}

Vec3 ProgrammedFrame::direction(const Vec3& words) const {
  Vec3 turned = turn.direction(words);
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    if (mirrors.at(i)) turned[static_cast<Eigen::Index>(i)] *= -1.0;
  }
  return turned;
}

bool ProgrammedFrame::reverses(Plane plane) const {
  const PlaneAxes axes = axes_of(plane);
  return mirrors.at(static_cast<std::size_t>(axes.u)).has_value() !=
         mirrors.at(static_cast<std::size_t>(axes.v)).has_value();
}

AxisTarget ProgrammedFrame::from_words(const AxisTarget& words) const {
  AxisTarget place = words;
  for (std::size_t i = 0; i < rotary_shift.size(); ++i) {
    auto& angle = place[static_cast<AxisLetter>(3 + i)];
    if (angle) *angle += rotary_shift.at(i);
  }
  if (!turns()) {
    for (const AxisLetter axis : kLinearAxes) {
      if (!place[axis]) continue;
      const auto slot = static_cast<Eigen::Index>(axis);
      place[axis] = stretched(axis, *place[axis] + shift[slot] + turn.translation[slot]);
    }
  } else {
    set_known(place, point(point_of(words)), words, turn.rotation);
  }
  return place;
}

AxisTarget ProgrammedFrame::to_words(const AxisTarget& place) const {
  AxisTarget words = place;
  for (std::size_t i = 0; i < rotary_shift.size(); ++i) {
    auto& angle = words[static_cast<AxisLetter>(3 + i)];
    if (angle) *angle -= rotary_shift.at(i);
  }
  if (!turns()) {
    for (const AxisLetter axis : kLinearAxes) {
      if (!words[axis]) continue;
      const auto slot = static_cast<Eigen::Index>(axis);
      words[axis] = unstretched(axis, *words[axis]) - shift[slot] - turn.translation[slot];
    }
  } else {
    Vec3 turned;
    for (const AxisLetter axis : kLinearAxes) {
      turned[static_cast<Eigen::Index>(axis)] = unstretched(axis, place[axis].value_or(0.0));
    }
    set_known(words, turn.inverse().point(turned) - shift, place, turn.rotation.transpose());
  }
  return words;
}

void ProgrammedFrame::place(Command& command) const {
  const auto words_of = [&](auto& move) {
    move.end = from_words(move.end);
    if (move.tool_axis) move.tool_axis = UnitVec3::of(direction(*move.tool_axis));
  };
  const auto straight = [&](auto& move) {
    if (move.coordinates == Coordinates::program) words_of(move);
  };
  if (auto* traverse = std::get_if<Traverse>(&command)) {
    straight(*traverse);
  } else if (auto* feed = std::get_if<LinearFeed>(&command)) {
    straight(*feed);
  } else if (auto* arc = std::get_if<ArcFeed>(&command)) {
    words_of(*arc);
    arc->center = point(arc->center);
    if (reverses(arc->plane)) arc->turns = -arc->turns;
  } else if (auto* probe = std::get_if<Probe>(&command)) {
    words_of(*probe);
  }
}

bool ProgrammedFrame::keeps(Plane plane) const {
  const Vec3 normal = Vec3::Unit(axes_of(plane).w);
  return (turn.direction(normal) - normal).norm() < kSameDirection;
}

}  // namespace frustum::parser
