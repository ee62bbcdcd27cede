#include "tests/parser/canonical_moves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/units.hpp"

namespace frustum::parser {
namespace {

constexpr double kAgree = 1.0001e-4;  // rs274 prints four decimals
constexpr std::array<std::string_view, 3> kArcKinds{"arc xy", "arc zx", "arc yz"};

std::vector<std::optional<double>> values_of(const AxisTarget& end) {
  std::vector<std::optional<double>> values;
  for (const AxisLetter axis : kAxisLetters) {
    auto value = end[axis];
    if (value && is_rotary(axis)) *value *= kDegPerRad;
    values.push_back(value);
  }
  return values;
}

struct ToMove {
  std::optional<CanonicalMove> operator()(const Traverse& move) const {
    if (move.coordinates == Coordinates::machine) return std::nullopt;
    return CanonicalMove{"traverse", values_of(move.end)};
  }
  std::optional<CanonicalMove> operator()(const LinearFeed& move) const {
    return CanonicalMove{"feed", values_of(move.end)};
  }
  std::optional<CanonicalMove> operator()(const ArcFeed& arc) const {
    CanonicalMove move{std::string(kArcKinds.at(static_cast<std::size_t>(arc.plane))),
                       values_of(arc.end)};
    const std::size_t normal = arc.plane == Plane::xy ? 2 : arc.plane == Plane::zx ? 1 : 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i != normal) move.values.emplace_back(arc.center[static_cast<Eigen::Index>(i)]);
    }
    move.values.emplace_back(arc.turns);
    return move;
  }
  std::optional<CanonicalMove> operator()(const Dwell& dwell) const {
    return CanonicalMove{"dwell", {dwell.seconds}};
  }
  std::optional<CanonicalMove> operator()(const ToolChange& change) const {
    return CanonicalMove{"tool", {static_cast<double>(change.tool)}};
  }
  std::optional<CanonicalMove> operator()(const CoolantChange& change) const {
    return CanonicalMove{change.flood ? "flood on" : "coolant off", {}};
  }
  template <typename Other>
  std::optional<CanonicalMove> operator()(const Other& /*other*/) const {
    return std::nullopt;
  }
};

// What the printed calls are relative to.
struct Printed {
  double unit = 1.0;
  Plane plane = Plane::xy;
  std::vector<double> numbers{};
  std::vector<double> shift = std::vector<double>(6, 0.0);  // of G92
  double turn = 0.0;                                        // about Z

  // Coordinates of the work offset.
  [[nodiscard]] Vec3 point(const Vec3& printed) const {
    return rotation_z(turn * kRadPerDeg) * (printed * unit + Vec3(shift[0], shift[1], shift[2]));
  }
  [[nodiscard]] std::vector<std::optional<double>> axes() const {
    const Vec3 place = point({numbers.at(0), numbers.at(1), numbers.at(2)});
    return {place[0],
            place[1],
            place[2],
            numbers.at(3) + shift[3],
            numbers.at(4) + shift[4],
            numbers.at(5) + shift[5]};
  }
  [[nodiscard]] CanonicalMove arc() const {
    // Coordinates in the plane: of the end, of the centre; turns; the third axis.
    constexpr std::array<std::array<int, 3>, 3> kSlots{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
    const auto& slot = kSlots.at(static_cast<std::size_t>(plane));
    Vec3 end;
    Vec3 centre = Vec3::Zero();
    end[slot[0]] = numbers.at(0);
    end[slot[1]] = numbers.at(1);
    end[slot[2]] = numbers.at(5);
    centre[slot[0]] = numbers.at(2);
    centre[slot[1]] = numbers.at(3);
    end = point(end);
    centre = point(centre);
    CanonicalMove move{std::string(kArcKinds.at(static_cast<std::size_t>(plane))),
                       {end[0], end[1], end[2], numbers.at(6) + shift[3], numbers.at(7) + shift[4],
                        numbers.at(8) + shift[5]}};
    for (int i = 0; i < 3; ++i) {
      if (i != slot[2]) move.values.emplace_back(centre[i]);
    }
    move.values.emplace_back(numbers.at(4));
    move.unit = unit;
    return move;
  }
};

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < text.size();) {
    double value = 0.0;
    const auto read = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (read.ec != std::errc{}) {
      ++at;
      continue;
    }
    numbers.push_back(value);
    at = static_cast<std::size_t>(read.ptr - text.data());
  }
  return numbers;
}

}  // namespace

std::vector<CanonicalMove> moves_of(const std::vector<Motion>& motions) {
  std::vector<CanonicalMove> moves;
  for (const Motion& motion : motions) {
    if (auto move = std::visit(ToMove{}, motion.command)) moves.push_back(*std::move(move));
  }
  return moves;
}

std::vector<CanonicalMove> moves_of_rs274(std::string_view output) {
  std::vector<CanonicalMove> moves;
  Printed printed;
  std::istringstream lines{std::string(output)};
  for (std::string line; std::getline(lines, line);) {
    const std::size_t mark = line.find("N..... ");
    const std::size_t bracket = line.find('(');
    if (mark == std::string::npos || bracket == std::string::npos) continue;
    const std::string call = line.substr(mark + 7, bracket - mark - 7);
    const std::string arguments = line.substr(bracket + 1);
    printed.numbers = numbers_in(arguments);
    if (call == "USE_LENGTH_UNITS") {
      printed.unit = arguments.find("INCHES") != std::string::npos ? kMmPerInch : 1.0;
    } else if (call == "SELECT_PLANE") {
      printed.plane = arguments.find("XZ") != std::string::npos   ? Plane::zx
                      : arguments.find("YZ") != std::string::npos ? Plane::yz
                                                                  : Plane::xy;
    } else if (call == "SET_G92_OFFSET") {
      printed.shift = printed.numbers;
      for (std::size_t i = 0; i < 3; ++i) printed.shift.at(i) *= printed.unit;
    } else if (call == "SET_XY_ROTATION") {
      printed.turn = printed.numbers.at(0);
    } else if (call == "STRAIGHT_TRAVERSE") {
      moves.push_back({"traverse", printed.axes(), printed.unit});
    } else if (call == "STRAIGHT_FEED") {
      moves.push_back({"feed", printed.axes(), printed.unit});
    } else if (call == "STRAIGHT_PROBE") {
      moves.push_back({"probe", printed.axes(), printed.unit});
    } else if (call == "ARC_FEED") {
      moves.push_back(printed.arc());
    } else if (call == "DWELL") {
      moves.push_back({"dwell", {printed.numbers.at(0)}});
    } else if (call == "CHANGE_TOOL") {
      moves.push_back({"tool", {printed.numbers.at(0)}});
    } else if (call == "FLOOD_ON") {
      moves.push_back({"flood on", {}});
    }
  }
  return moves;
}

std::vector<CanonicalMove> without_standing_still(std::vector<CanonicalMove> moves) {
  constexpr std::size_t kAxes = 6;
  std::vector<CanonicalMove> kept;
  std::vector<std::optional<double>> place;
  for (CanonicalMove& move : moves) {
    if (move.values.size() < kAxes) {
      kept.push_back(std::move(move));
      continue;
    }
    std::vector<std::optional<double>> end(move.values.begin(), move.values.begin() + kAxes);
    const bool stands = move.kind == "traverse" && end == place;
    place = std::move(end);
    if (!stands) kept.push_back(std::move(move));
  }
  return kept;
}

std::string to_text(const CanonicalMove& move) {
  std::string text = move.kind;
  for (const auto& value : move.values) text += value ? fmt::format(" {:.4f}", *value) : " -";
  return text;
}

bool agree(const CanonicalMove& a, const CanonicalMove& b) {
  const double tolerance = kAgree * std::max(a.unit, b.unit);
  const auto near = [tolerance](const std::optional<double>& left,
                                const std::optional<double>& right) {
    return !left || !right || std::abs(*left - *right) <= tolerance;
  };
  return a.kind == b.kind &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(), near);
}

}  // namespace frustum::parser
