#include "tests/parser/interpret/canonical_moves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "core/units.hpp"

namespace frustum::parser {
namespace {

constexpr double kAgree = 1.0001e-4;  // rs274 prints four decimals
constexpr std::array<std::string_view, 3> kArcKinds{"arc xy", "arc zx", "arc yz"};

// A text and the numbers in it: "pos 1.5" is "pos #" and 1.5.
CanonicalMove said(const std::string& kind, std::string_view text) {
  CanonicalMove move{kind, {}};
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  move.kind += ' ';
  while (!text.empty()) {
    const bool sign = text.size() > 1 && text.front() == '-';
    const char first = text[sign ? 1 : 0];
    double value = 0.0;
    if (first >= '0' && first <= '9') {
      const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
      text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
      move.kind += '#';
      move.values.emplace_back(value);
      continue;
    }
    move.kind += text.front();
    text.remove_prefix(1);
  }
  return move;
}

using Place = std::vector<std::optional<double>>;

// Of X Y Z, else of A B C; absent where one of them is not known.
std::optional<double> straight_length(const Place& from, const Place& to) {
  for (const std::size_t first : {0U, 3U}) {
    double sum = 0.0;
    for (std::size_t i = first; i < first + 3; ++i) {
      if (!from[i] && !to[i]) continue;
      if (!from[i] || !to[i]) return std::nullopt;
      sum += (*to[i] - *from[i]) * (*to[i] - *from[i]);
    }
    if (sum > 0.0) return std::sqrt(sum);
  }
  return 0.0;
}

// Of an arc in the plane of the axes u, v about `centre`, with its helix along w.
std::optional<double> arc_length(const Place& from, const Place& to, const ArcFeed& arc,
                                 const std::array<double, 2>& centre,
                                 const std::array<std::size_t, 3>& axes) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (const std::size_t axis : axes) {
    if (!from[axis] || !to[axis]) return std::nullopt;
  }
  const auto angle = [&](const Place& place) {
    return std::atan2(*place[axes[1]] - centre[1], *place[axes[0]] - centre[0]);
  };
  const double radius = std::hypot(*from[axes[0]] - centre[0], *from[axes[1]] - centre[1]);
  double swept = std::fmod((angle(to) - angle(from)) * (arc.turns > 0 ? 1.0 : -1.0), kTurn);
  if (swept <= 1e-9) swept += kTurn;
  swept += kTurn * (std::abs(arc.turns) - 1);
  return std::hypot(radius * swept, *to[axes[2]] - *from[axes[2]]);
}

// In mm or degrees a minute; rs274 makes it of the length of the move where F is the inverse of its
// time.
std::optional<double> rate_of(const Feed& feed, std::optional<double> length) {
  if (feed.synchronised) return std::nullopt;
  if (feed.mode != FeedMode::inverse_time) return feed.value;
  return length ? std::optional(feed.value * *length) : std::nullopt;
}

double signed_speed(SpindleDirection direction, double speed) {
  return direction == SpindleDirection::off         ? 0.0
         : direction == SpindleDirection::clockwise ? speed
                                                    : -speed;
}

// Walks along the motions: their moves in machine coordinates. An axis that a move leaves out stays
// where it is.
class Walk {
 public:
  std::optional<CanonicalMove> operator()(const Traverse& move) {
    return CanonicalMove{"traverse", arrive(move.end, move.coordinates)};
  }
  std::optional<CanonicalMove> operator()(const LinearFeed& move) {
    const Place before{place_.begin(), place_.end()};
    CanonicalMove result{"feed", arrive(move.end, move.coordinates)};
    result.rate = rate_of(move.feed, straight_length(before, result.values));
    if (move.feed.synchronised) {
      result.kind = "thread";
      result.values.emplace_back(move.feed.value);
    }
    return result;
  }
  std::optional<CanonicalMove> operator()(const Probe& move) {
    const Place before{place_.begin(), place_.end()};
    CanonicalMove result{"probe", arrive(move.end, Coordinates::program)};
    result.rate = rate_of(move.feed, straight_length(before, result.values));
    return result;
  }
  std::optional<CanonicalMove> operator()(const ArcFeed& arc) {
    constexpr std::array<std::array<std::size_t, 3>, 3> kPlanes{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
    const Place before{place_.begin(), place_.end()};
    CanonicalMove move{std::string(kArcKinds.at(static_cast<std::size_t>(arc.plane))),
                       arrive(arc.end, Coordinates::program)};
    const std::size_t normal = arc.plane == Plane::xy ? 2 : arc.plane == Plane::zx ? 1 : 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == normal) continue;
      move.values.push_back(in_machine(i, arc.center[static_cast<Eigen::Index>(i)]));
    }
    move.values.emplace_back(arc.turns);
    const auto& axes = kPlanes.at(static_cast<std::size_t>(arc.plane));
    const auto centre_u = in_machine(axes[0], arc.center[static_cast<Eigen::Index>(axes[0])]);
    const auto centre_v = in_machine(axes[1], arc.center[static_cast<Eigen::Index>(axes[1])]);
    const bool known = centre_u && centre_v;
    move.rate =
        rate_of(arc.feed, known ? arc_length(before, move.values, arc, {*centre_u, *centre_v}, axes)
                                : std::nullopt);
    return move;
  }
  std::optional<CanonicalMove> operator()(const Stop& stop) {
    if (stop.kind == StopKind::program_end) return std::nullopt;
    return CanonicalMove{stop.kind == StopKind::program_stop ? "stop" : "optional stop", {}};
  }
  std::optional<CanonicalMove> operator()(const WorkOffsetChange& change) {
    offset_ = change.number;
    return std::nullopt;
  }
  std::optional<CanonicalMove> operator()(const WorkOffsetSetting& setting) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (setting.origin.at(i)) origins_[setting.number].at(i) = *setting.origin.at(i);
    }
    return std::nullopt;
  }
  std::optional<CanonicalMove> operator()(const CompensationChange& change) {
    length_ = change.mode == LengthCompensation::off ? 0.0 : change.length;
    return std::nullopt;
  }
  std::optional<CanonicalMove> operator()(const Dwell& dwell) {
    return CanonicalMove{"dwell", {dwell.seconds}};
  }
  std::optional<CanonicalMove> operator()(const ToolChange& change) {
    return CanonicalMove{"tool", {static_cast<double>(change.tool)}};
  }
  std::optional<CanonicalMove> operator()(const CoolantChange& change) {
    return CanonicalMove{change.flood ? "flood on" : "coolant off", {}};
  }
  std::optional<CanonicalMove> operator()(const Event& event) {
    if (event.name == "message" || event.name == "debug") return said("message", event.text);
    if (event.name == "log") return said("log", event.text);
    return std::nullopt;
  }
  template <typename Other>
  std::optional<CanonicalMove> operator()(const Other& /*other*/) const {
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<double> in_machine(std::size_t axis, double value) {
    if (axis < 3) value += origins_[offset_].at(axis);
    if (axis == 2 && !length_) return std::nullopt;
    return value + (axis == 2 ? *length_ : 0.0);
  }
  std::vector<std::optional<double>> arrive(const AxisTarget& end, Coordinates coordinates) {
    for (std::size_t i = 0; i < place_.size(); ++i) {
      const AxisLetter axis = kAxisLetters.at(i);
      if (!end[axis]) continue;
      const double value = *end[axis] * (is_rotary(axis) ? kDegPerRad : 1.0);
      place_.at(i) = coordinates == Coordinates::machine ? value : in_machine(i, value);
    }
    return {place_.begin(), place_.end()};
  }

  std::map<int, std::array<double, 3>> origins_{};
  int offset_ = 1;
  std::optional<double> length_ = 0.0;
  // All axes are at zero at the start.
  std::array<std::optional<double>, kAxisLetters.size()> place_{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
};

// What the printed calls are relative to.
struct Printed {
  double unit = 1.0;
  Plane plane = Plane::xy;
  std::vector<double> numbers{};
  std::vector<double> shift = std::vector<double>(6, 0.0);   // of G92
  std::vector<double> origin = std::vector<double>(6, 0.0);  // of the work offset
  std::vector<double> tool = std::vector<double>(6, 0.0);
  double turn = 0.0;             // about Z
  std::optional<double> lead{};  // synchronised with the spindle
  double rate = 0.0;
  double rate_in_degrees = 0.0;
  double speed = 0.0;
  SpindleDirection direction = SpindleDirection::off;
  bool surface_speed = false;

  // Six lengths and angles from the printed ones, after `first` numbers.
  [[nodiscard]] std::vector<double> six(std::size_t first) const {
    std::vector<double> values(6);
    for (std::size_t i = 0; i < 6; ++i) values[i] = numbers.at(first + i) * (i < 3 ? unit : 1.0);
    return values;
  }
  // In machine coordinates.
  [[nodiscard]] Vec3 point(const Vec3& printed) const {
    return rotation_z(turn * kRadPerDeg) * (printed * unit + Vec3(shift[0], shift[1], shift[2])) +
           Vec3(origin[0] + tool[0], origin[1] + tool[1], origin[2] + tool[2]);
  }
  [[nodiscard]] double angle(std::size_t axis, double printed) const {
    return printed + shift[axis] + origin[axis] + tool[axis];
  }
  [[nodiscard]] std::vector<std::optional<double>> axes() const {
    const Vec3 place = point({numbers.at(0), numbers.at(1), numbers.at(2)});
    return {place[0],
            place[1],
            place[2],
            angle(3, numbers.at(3)),
            angle(4, numbers.at(4)),
            angle(5, numbers.at(5))};
  }
  [[nodiscard]] CanonicalMove feed() const {
    CanonicalMove move{"feed", axes(), unit};
    if (lead) {
      move.kind = "thread";
      move.values.emplace_back(*lead * unit);
    }
    return move;
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
                       {end[0], end[1], end[2], angle(3, numbers.at(6)), angle(4, numbers.at(7)),
                        angle(5, numbers.at(8))}};
    move.unit = unit;
    if (turn != 0.0 && plane != Plane::xy) {
      move.kind = "turned arc";
      return move;
    }
    for (int i = 0; i < 3; ++i) {
      if (i != slot[2]) move.values.emplace_back(centre[i]);
    }
    move.values.emplace_back(numbers.at(4));
    return move;
  }
};

// Where the last move ends.
std::vector<std::optional<double>> place_of(const std::vector<CanonicalMove>& moves) {
  constexpr std::ptrdiff_t kAxes = 6;
  for (auto move = moves.rbegin(); move != moves.rend(); ++move) {
    if (move->values.size() >= kAxes) return {move->values.begin(), move->values.begin() + kAxes};
  }
  return std::vector<std::optional<double>>(kAxes, 0.0);
}

// Whether the move turns rotary axes alone.
bool turns_only(const std::vector<CanonicalMove>& moves, std::size_t at) {
  const auto before = place_of({moves.begin(), moves.begin() + static_cast<std::ptrdiff_t>(at)});
  const auto& after = moves[at].values;
  return !moves[at].kind.starts_with("arc") &&
         std::equal(before.begin(), before.begin() + 3, after.begin()) &&
         !std::equal(before.begin() + 3, before.begin() + 6, after.begin() + 3);
}

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
  Walk walk;
  double spindle = 0.0;
  bool surface_speed = false;
  std::uint32_t spline_line = 0;  // whose moves trace the spline that was reported
  for (const Motion& motion : motions) {
    const auto* event = std::get_if<Event>(&motion.command);
    // An arc in chords is one move to their end.
    if (event != nullptr && event->name == "chords") {
      spline_line = motion.place.line;
      moves.push_back({"turned arc", {}});
    }
    if (event != nullptr && event->name == "spline") {
      spline_line = motion.place.line;
      moves.push_back({"spline", {std::stod(event->text)}});
    }
    const bool traces = std::holds_alternative<LinearFeed>(motion.command) ||
                        std::holds_alternative<ArcFeed>(motion.command);
    if (event == nullptr && !traces) spline_line = 0;
    if (const auto* change = std::get_if<SpindleChange>(&motion.command)) {
      spindle = signed_speed(change->direction, change->speed);
    }
    surface_speed = surface_speed || (event != nullptr && event->name == "surface_speed");
    auto move = std::visit(walk, motion.command);
    if (move && traces && motion.place.line == spline_line && moves.back().kind == "turned arc") {
      moves.back().values = move->values;
    }
    if (!move || (traces && motion.place.line == spline_line)) continue;
    if (!surface_speed) move->spindle = spindle;
    moves.push_back(*std::move(move));
  }
  return moves;
}

std::vector<CanonicalMove> moves_of_rs274(std::string_view output) {
  std::vector<CanonicalMove> moves;
  Printed printed;
  std::size_t told = 0;
  std::istringstream lines{std::string(output)};
  for (std::string line; std::getline(lines, line);) {
    // "   12 N10    STRAIGHT_FEED("
    const std::size_t mark = line.find(" N");
    const std::size_t bracket = line.find('(');
    if (mark == std::string::npos || bracket == std::string::npos) continue;
    const std::size_t start = line.find_first_not_of("0123456789. ", mark + 2);
    if (start >= bracket) continue;
    const std::string call = line.substr(start, bracket - start);
    const std::string arguments = line.substr(bracket + 1);
    printed.numbers = numbers_in(arguments);
    if (call == "USE_LENGTH_UNITS") {
      printed.unit = arguments.find("INCHES") != std::string::npos ? kMmPerInch : 1.0;
    } else if (call == "SELECT_PLANE") {
      printed.plane = arguments.find("XZ") != std::string::npos   ? Plane::zx
                      : arguments.find("YZ") != std::string::npos ? Plane::yz
                                                                  : Plane::xy;
    } else if (call == "SET_G92_OFFSET") {
      printed.shift = printed.six(0);
    } else if (call == "SET_G5X_OFFSET") {
      printed.origin = printed.six(1);
    } else if (call == "USE_TOOL_LENGTH_OFFSET") {
      printed.tool = printed.six(0);
    } else if (call == "MESSAGE" || call == "LOG") {
      const std::string_view text = std::string_view(arguments).substr(1, arguments.size() - 3);
      moves.push_back(said(call == "LOG" ? "log" : "message", text));
    } else if (call == "SET_XY_ROTATION") {
      printed.turn = printed.numbers.at(0);
    } else if (call == "STRAIGHT_TRAVERSE") {
      moves.push_back({"traverse", printed.axes(), printed.unit});
    } else if (call == "STRAIGHT_FEED") {
      moves.push_back(printed.feed());
    } else if (call == "START_SPEED_FEED_SYNC") {
      printed.lead = printed.numbers.at(0);
    } else if (call == "STOP_SPEED_FEED_SYNCH") {
      printed.lead.reset();
    } else if (call == "RIGID_TAP") {
      // Three axes, there and back.
      printed.numbers.resize(6);
      CanonicalMove there = printed.feed();
      CanonicalMove back = there;
      for (std::size_t i = 0; i < 6; ++i) {
        back.values[i] = place_of(moves)[i];
        if (i >= 3) there.values[i] = back.values[i];
      }
      // On the way back the spindle turns the other way.
      back.spindle = -signed_speed(printed.direction, printed.speed);
      moves.push_back(std::move(there));
      moves.push_back(std::move(back));
    } else if (call == "STRAIGHT_PROBE") {
      moves.push_back({"probe", printed.axes(), printed.unit});
    } else if (call == "ARC_FEED") {
      moves.push_back(printed.arc());
    } else if (call == "NURBS_FEED") {
      moves.push_back({"spline", {printed.numbers.at(0)}});
    } else if (call == "DWELL") {
      moves.push_back({"dwell", {printed.numbers.at(0)}});
    } else if (call == "CHANGE_TOOL" || call == "CHANGE_TOOL_NUMBER") {
      moves.push_back({"tool", {printed.numbers.at(0)}});
    } else if (call == "FLOOD_ON") {
      moves.push_back({"flood on", {}});
    } else if (call == "FLOOD_OFF") {
      moves.push_back({"coolant off", {}});
    } else if (call == "PROGRAM_STOP") {
      moves.push_back({"stop", {}});
    } else if (call == "OPTIONAL_PROGRAM_STOP") {
      moves.push_back({"optional stop", {}});
    } else if (call == "SET_FEED_RATE") {
      printed.rate = printed.numbers.at(0) * printed.unit;
      printed.rate_in_degrees = printed.numbers.at(0);
    } else if (call == "SET_SPINDLE_SPEED") {
      printed.speed = printed.numbers.at(1);
    } else if (call == "SET_SPINDLE_MODE") {
      printed.surface_speed = printed.surface_speed || printed.numbers.at(1) > 0.0;
    } else if (call == "START_SPINDLE_CLOCKWISE") {
      printed.direction = SpindleDirection::clockwise;
    } else if (call == "START_SPINDLE_COUNTERCLOCKWISE") {
      printed.direction = SpindleDirection::counterclockwise;
    } else if (call == "STOP_SPINDLE_TURNING") {
      printed.direction = SpindleDirection::off;
    }
    for (; told < moves.size(); ++told) {
      CanonicalMove& move = moves[told];
      if (!printed.surface_speed && !move.spindle)
        move.spindle = signed_speed(printed.direction, printed.speed);
      // A purely rotary move has its feed in degrees, whatever the unit.
      const bool cuts = move.kind == "feed" || move.kind == "probe" || move.kind.starts_with("arc");
      if (cuts) move.rate = turns_only(moves, told) ? printed.rate_in_degrees : printed.rate;
    }
  }
  return moves;
}

std::vector<CanonicalMove> without_standing_still(std::vector<CanonicalMove> moves) {
  constexpr std::size_t kAxes = 6;
  std::vector<CanonicalMove> kept;
  std::vector<std::optional<double>> place(kAxes, 0.0);
  for (CanonicalMove& move : moves) {
    if (move.values.size() < kAxes) {
      kept.push_back(std::move(move));
      continue;
    }
    std::vector<std::optional<double>> end(move.values.begin(), move.values.begin() + kAxes);
    const auto near = [&move](const std::optional<double>& left,
                              const std::optional<double>& right) {
      return left == right || (left && right && std::abs(*left - *right) <= kAgree * move.unit);
    };
    const bool stands = (move.kind == "traverse" || move.kind == "feed") &&
                        std::equal(end.begin(), end.end(), place.begin(), place.end(), near);
    place = std::move(end);
    if (!stands) kept.push_back(std::move(move));
  }
  return kept;
}

std::string to_text(const CanonicalMove& move) {
  std::string text = move.kind;
  for (const auto& value : move.values) text += value ? fmt::format(" {:.4f}", *value) : " -";
  if (move.rate) text += fmt::format(" feed {:.4f}", *move.rate);
  if (move.spindle) text += fmt::format(" spindle {:.4f}", *move.spindle);
  return text;
}

bool agree(const CanonicalMove& a, const CanonicalMove& b) {
  const double tolerance = kAgree * std::max(a.unit, b.unit);
  const auto near = [tolerance](const std::optional<double>& left,
                                const std::optional<double>& right) {
    return !left || !right || std::abs(*left - *right) <= tolerance;
  };
  // Printed with four decimals, in the program's unit.
  return a.kind == b.kind && near(a.rate, b.rate) && near(a.spindle, b.spindle) &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(), near);
}

}  // namespace frustum::parser
