#include "post/comparing/fault.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "core/units.hpp"

namespace frustum::post {
namespace {

using parser::AxisLetter;
using parser::kLinearAxes;
using parser::kRotaryAxes;
using parser::LengthCompensation;
using parser::Motion;
using Motions = std::vector<Motion>;

constexpr double kMmPerInch = 25.4;

template <typename Command>
concept Move = requires(Command c) {
  c.tool_axis;
};

constexpr bool in_program_coordinates(const auto& move) {
  if constexpr (requires { move.coordinates; }) {
    return move.coordinates == parser::Coordinates::program;
  }
  return true;
}

// `change(move)` for every traverse, feed and arc in program coordinates.
template <typename Change>
Motions with_moves(const Motions& motions, Change change) {
  Motions changed = motions;
  for (Motion& motion : changed) {
    std::visit(
        [&](auto& command) {
          if constexpr (Move<std::decay_t<decltype(command)>>) {
            if (in_program_coordinates(command)) change(command);
          }
        },
        motion.command);
  }
  return changed;
}

template <typename Command, typename Change>
Motions with(const Motions& motions, Change change) {
  Motions changed = motions;
  for (Motion& motion : changed) {
    if (auto* command = std::get_if<Command>(&motion.command)) change(*command);
  }
  return changed;
}

template <typename Command>
concept Arc = std::is_same_v<std::decay_t<Command>, parser::ArcFeed>;

Motions scaled_words(const Motions& motions, std::span<const AxisLetter> letters, double factor) {
  const bool linear = !parser::is_rotary(letters.front());
  return with_moves(motions, [&](auto& move) {
    for (const AxisLetter letter : letters) {
      if (move.end[letter]) *move.end[letter] *= factor;
    }
    if constexpr (Arc<decltype(move)>) {
      if (linear) {
        for (const AxisLetter letter : letters) move.center[static_cast<int>(letter)] *= factor;
      }
    }
  });
}

Motions swapped_words(const Motions& motions, AxisLetter one, AxisLetter two) {
  return with_moves(motions, [&](auto& move) {
    std::swap(move.end[one], move.end[two]);
    if constexpr (Arc<decltype(move)>) {
      std::swap(move.center[static_cast<int>(one)], move.center[static_cast<int>(two)]);
    }
  });
}

Motions with_mode(const Motions& motions, LengthCompensation from, LengthCompensation to) {
  return with<parser::CompensationChange>(motions, [&](parser::CompensationChange& change) {
    if (change.mode == from) change.mode = to;
  });
}

// The tool vector with some of its components negated or swapped.
Motions with_vectors(const Motions& motions, const std::function<Vec3(const Vec3&)>& change) {
  return with_moves(motions, [&](auto& move) {
    if (move.tool_axis) move.tool_axis = UnitVec3::of(change(move.tool_axis->vec()));
  });
}

Motions with_own_tool_offset(const Motions& motions) {
  int tool = 0;
  Motions changed = motions;
  for (Motion& motion : changed) {
    if (const auto* change = std::get_if<parser::ToolChange>(&motion.command)) tool = change->tool;
    auto* compensation = std::get_if<parser::CompensationChange>(&motion.command);
    if (compensation != nullptr && compensation->mode != LengthCompensation::off) {
      compensation->offset_number = tool;
    }
  }
  return changed;
}

void add_rotary_faults(const kinematics::Machine& machine, std::vector<Fault>& faults) {
  for (const AxisLetter letter : kRotaryAxes) {
    if (machine.joint(letter) == nullptr) continue;
    faults.push_back({fmt::format("rotary axis {} has the opposite sign", to_char(letter)),
                      [letter](const Motions& m) {
                        return scaled_words(m, {&letter, 1}, -1.0);
                      }});
  }
  faults.push_back(
      {"tool-centre-point control is missing: the words are tip positions", [](const Motions& m) {
         return with_mode(m, LengthCompensation::length, LengthCompensation::tool_centre_point);
       }});
  faults.push_back(
      {"tool-centre-point control is on, but the words are axis positions", [](const Motions& m) {
         return with_mode(m, LengthCompensation::tool_centre_point, LengthCompensation::length);
       }});
  faults.push_back({"the rotary words are in radians",
                    [](const Motions& m) { return scaled_words(m, kRotaryAxes, kDegPerRad); }});
  faults.push_back({"the tool vectors point from the spindle to the tip", [](const Motions& m) {
                      return with_vectors(m, [](const Vec3& v) { return Vec3(-v); });
                    }});
  faults.push_back({"the sign of the tool vectors' component I is reversed", [](const Motions& m) {
                      return with_vectors(m,
                                          [](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); });
                    }});
  faults.push_back({"the sign of the tool vectors' component J is reversed", [](const Motions& m) {
                      return with_vectors(m,
                                          [](const Vec3& v) { return Vec3(v.x(), -v.y(), v.z()); });
                    }});
  faults.push_back({"the tool vectors' components I and J are exchanged", [](const Motions& m) {
                      return with_vectors(m,
                                          [](const Vec3& v) { return Vec3(v.y(), v.x(), v.z()); });
                    }});
}

}  // namespace

std::vector<Fault> known_faults(const kinematics::Machine& machine) {
  std::vector<Fault> faults;
  add_rotary_faults(machine, faults);
  faults.push_back({"lengths are read as millimetres but are inches",
                    [](const Motions& m) { return scaled_words(m, kLinearAxes, kMmPerInch); }});
  faults.push_back({"lengths are read as inches but are millimetres", [](const Motions& m) {
                      return scaled_words(m, kLinearAxes, 1.0 / kMmPerInch);
                    }});
  faults.push_back({"the length compensation is that of another tool",
                    [](const Motions& m) { return with_own_tool_offset(m); }});
  for (const AxisLetter letter : kLinearAxes) {
    faults.push_back(
        {fmt::format("{} has the opposite sign", to_char(letter)), [letter](const Motions& m) {
           return scaled_words(m, {&letter, 1}, -1.0);
         }});
  }
  faults.push_back({"X and Y are exchanged", [](const Motions& m) {
                      return swapped_words(m, AxisLetter::X, AxisLetter::Y);
                    }});
  faults.push_back({"the arcs turn the other way (G2 and G3 exchanged)", [](const Motions& m) {
                      return with<parser::ArcFeed>(
                          m, [](parser::ArcFeed& arc) { arc.turns = -arc.turns; });
                    }});
  return faults;
}

Fault shifted_rotary_axis(AxisLetter axis, double offset) {
  return {fmt::format("rotary axis {} is off by {:.4f} deg throughout", to_char(axis),
                      offset * kDegPerRad),
          [axis, offset](const Motions& m) {
            return with_moves(m, [&](auto& move) {
              if (move.end[axis]) *move.end[axis] -= offset;
            });
          }};
}

}  // namespace frustum::post
