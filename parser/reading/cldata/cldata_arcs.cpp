#include "parser/reading/cldata/cldata_arcs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/counted.hpp"
#include "core/units.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/block_draft.hpp"

namespace frustum::parser {
namespace {

// CAM systems write four to six decimals.
constexpr double kSamePlace = 0.01;    // mm
constexpr double kRounding = 2e-4;     // of places with four decimals, in the file's unit
constexpr double kAlongAnAxis = 1e-5;  // of a unit vector
constexpr double kUnitLength = 1e-3;   // of an axis, written with few decimals
constexpr double kSameTurns = 0.02;    // of TIMES, PITCH or ANGLE and of the end
constexpr double kNoTurn = 1e-6;       // full turns: rounding of the points
constexpr const char* kCircleRemedy = "give the centre x,y,z, the axis i,j,k and the radius";

// A unit vector along X, Y or Z.
std::optional<Eigen::Index> axis_along(const Vec3& axis) {
  Eigen::Index along = 0;
  if (axis.cwiseAbs().maxCoeff(&along) != 1.0) return std::nullopt;
  return along;
}

}  // namespace

std::optional<Plane> CldataArc::plane() const {
  const auto along = axis_along(axis);
  if (!along) return std::nullopt;
  return *along == 2 ? Plane::xy : *along == 1 ? Plane::zx : Plane::yz;
}

const char* CldataArc::code() const {
  if (!plane()) return "CIRCLE/";
  return axis.sum() > 0.0 ? "CIRCLE+" : "CIRCLE-";
}

Vec3 CldataArcs::Circle::arm(const Vec3& point) const {
  const Vec3 from_centre = point - centre;
  return from_centre - axis * from_centre.dot(axis);
}

double CldataArcs::Circle::shorter_turn(const Vec3& from, const Vec3& to) const {
  const Vec3 a = arm(from);
  const Vec3 b = arm(to);
  return std::atan2(axis.dot(a.cross(b)), a.dot(b)) / (2.0 * std::numbers::pi);
}

double CldataArcs::Circle::turn(const Vec3& from, const Vec3& to) const {
  const double turns = shorter_turn(from, to);
  return turns > kNoTurn ? turns : turns + 1.0;
}

bool CldataArcs::set_axis(LineScanner& in, Circle& circle, const Vec3& axis, std::uint32_t column) {
  if (!(std::abs(axis.norm() - 1.0) <= kUnitLength)) {
    in.fail("arc-plane"_id, column, "the axis of the circle is no direction",
            "give an axis i,j,k of length 1");
    return false;
  }
  Eigen::Index along = 0;
  axis.cwiseAbs().maxCoeff(&along);
  const bool in_plane = std::abs(std::abs(axis[along]) - 1.0) <= kAlongAnAxis;
  circle.axis = in_plane ? Vec3(Vec3::Unit(along) * (axis[along] > 0.0 ? 1.0 : -1.0))
                         : Vec3(axis.normalized());
  return true;
}

void CldataArcs::begin(LineScanner& in, const CldataRecord& record, std::uint32_t line) {
  constexpr std::size_t kCircleNumbers = 7;
  constexpr std::size_t kWithoutRadius = 6;
  constexpr std::size_t kMostNumbers =
      11;  // tolerance, fraction, diameter and corner of the cutter
  constexpr std::array kCounts{"TIMES", "PITCH", "ANGLE"};
  const auto& given = record.arguments;
  const auto word = std::find_if(given.begin(), given.end(),
                                 [](const CldataArgument& a) { return !a.is_number(); });
  const auto numbers = static_cast<std::size_t>(word - given.begin());
  Circle circle;
  circle.line = line;
  const bool clockwise = word != given.end() && (word->word == "CLOCKWISE" || word->word == "CLW");
  const bool sense = clockwise || (word != given.end() &&
                                   (word->word == "COUNTERCLOCKWISE" || word->word == "CCLW"));
  if (word != given.end() && !(sense && word + 1 == given.end())) {
    const auto* known = std::find(kCounts.begin(), kCounts.end(), word->word);
    if (known == kCounts.end()) {
      return in.fail("unknown-word"_id, word->column,
                     fmt::format("{} has no meaning in {}", word->word, record.word),
                     kCircleRemedy);
    }
    if (given.end() - word != 2 || !given.back().is_number() || given.back().number <= 0.0) {
      return in.fail("out-of-range"_id, word->column,
                     fmt::format("{} has no number above zero", word->word),
                     fmt::format("end the record with {},n", word->word));
    }
    circle.word = *known;
    circle.value = given.back().number;
    circle.column = word->column;
  }
  if (numbers < kWithoutRadius || numbers > kMostNumbers) {
    return in.fail("argument-count"_id, record.column,
                   fmt::format("{} with {}", record.word, counted(numbers, "number")),
                   kCircleRemedy);
  }
  circle.centre = record.point();
  if (!set_axis(in, circle, record.point(3), given[3].column)) return;
  const bool of_nx = numbers > kCircleNumbers + 1;
  if (clockwise || of_nx) circle.axis = -circle.axis;
  const bool helix = circle.value > 0.0;
  circle.one_move = helix || of_nx || sense || numbers == kWithoutRadius || record.word == "MOVARC";
  circle.closes = helix || !of_nx;
  circle_ = circle;
}

void CldataArcs::point_along(LineScanner& in, const CldataRecord& record) {
  if (!are_cldata_numbers(in, record, {3}, "give three numbers")) return;
  direction_ = Direction{record.point(), record.word == "INDIRP"};
}

std::optional<std::uint32_t> CldataArcs::waits_since() const {
  if (!circle_ || circle_->begun) return std::nullopt;
  return circle_->line;
}

// The started turns, when what the record says and where the move ends agree.
std::optional<int> CldataArcs::turns_of(LineScanner& in, const Circle& circle, std::uint32_t column,
                                        double turn, double height) {
  constexpr double kMostTurns = 10'000.0;
  constexpr double kDegreesOfATurn = 360.0;
  if (circle.value == 0.0) return 1;
  const std::string_view word = circle.word;
  // NX counts the turns that are started.
  if (word == "TIMES" && circle.value == std::floor(circle.value) && circle.value <= kMostTurns) {
    return static_cast<int>(circle.value);
  }
  const double said = word == "TIMES"   ? circle.value
                      : word == "PITCH" ? std::abs(height) / circle.value
                                        : circle.value / kDegreesOfATurn;
  const double full = std::round(said - turn);
  if (!(full >= 0.0 && full <= kMostTurns && std::abs(said - turn - full) <= kSameTurns)) {
    in.fail("arc-turns"_id, column,
            fmt::format("the arc makes {:.4g} turns by {}, but its end is {:.4g} of a turn away",
                        said, word, turn),
            fmt::format("correct {} on line {}, or the end", word, circle.line));
    return std::nullopt;
  }
  return static_cast<int>(full) + 1;
}

std::optional<CldataArc> CldataArcs::to(LineScanner& in, const Vec3& end, std::uint32_t column,
                                        const std::optional<Vec3>& at, bool inches) {
  if (!circle_) return std::nullopt;
  CldataArc arc{circle_->centre, end, circle_->axis, 1};
  if (!at) {  // the interpreter says so
    circle_.reset();
    return arc;
  }
  const double tolerance = kSamePlace / (inches ? kMmPerInch : 1.0);
  const double turn = circle_->turn(*at, end);
  const double height = (end - *at).dot(circle_->axis);
  const bool flat = std::abs(height) <= tolerance;
  const Vec3 from = circle_->arm(*at);
  const Vec3 to = circle_->arm(end);
  if (circle_->begun) {
    const bool on = std::abs(to.norm() - from.norm()) <= tolerance;
    if (!on || to == from || flat != circle_->flat || circle_->turned + turn > 1.0 + kNoTurn) {
      circle_.reset();
      return std::nullopt;
    }
  } else if (!circle_->closes && (to - from).norm() <= kRounding) {
    if (flat && to != from && circle_->shorter_turn(*at, end) > 0.0) {
      arc.step = true;
      circle_.reset();
      return arc;
    }
    in.fail("arc-turns"_id, column, "the arc ends where it starts: a full turn, or none?",
            fmt::format("add TIMES,1 to the CIRCLE on line {}, or leave it out", circle_->line));
    return std::nullopt;
  }
  const auto turns = turns_of(in, *circle_, column, turn, height);
  if (!turns) return std::nullopt;
  arc.turns = *turns;
  arc.times_started = std::string_view(circle_->word) == "TIMES" && turn < 1.0 - kNoTurn &&
                      circle_->value == std::floor(circle_->value);
  circle_->begun = true;
  circle_->flat = flat;
  circle_->turned += turn;
  if (circle_->one_move) circle_.reset();
  return arc;
}

// (CIRCLE/x,y,z,r), (CIRCLE/CANON,x,y,z,i,j,k,r), (CYLNDR/...)
std::optional<CldataArcs::Circle> CldataArcs::read_circle(LineScanner& in) {
  const bool bracket = in.take('(');
  const std::uint32_t shape_column = in.column();
  CldataRecord shape{in.name(), shape_column, {}};
  if (shape.word != "CIRCLE" && shape.word != "CYLNDR") {
    in.fail("arc-incomplete"_id, shape.column, "TLON without a circle",
            "write TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z), or GOTO records");
    return std::nullopt;
  }
  in.take('/');
  if (in.take_name("CANON")) in.take(',');
  // Behind the numbers the outer record goes on with ,ON.
  do {
    if (in.next_name() != "") break;
    const std::uint32_t column = in.column();
    shape.arguments.push_back({column, {}, in.signed_number(shape.word, column)});
  } while (!in.failed() && in.take(','));
  if (bracket && !in.take(')')) {
    in.fail_unexpected("close the bracket of " + shape.word);
    return std::nullopt;
  }
  const bool flat = shape.arguments.size() == 4;
  if (!flat && shape.arguments.size() != 7) {
    in.fail("argument-count"_id, shape.column,
            fmt::format("{} with {}", shape.word, counted(shape.arguments.size(), "number")),
            "give x,y,z,r or x,y,z,i,j,k,r");
    return std::nullopt;
  }
  Circle circle;
  circle.centre = shape.point();
  circle.radius = shape.arguments.back().number;
  if (flat) return circle;
  const std::uint32_t column = shape.arguments[3].column;
  if (!set_axis(in, circle, shape.point(3), column)) return std::nullopt;
  if (!axis_along(circle.axis)) {
    in.fail("arc-plane"_id, column, "the circle is not in a plane of X, Y, Z",
            "give an axis i,j,k along X, Y or Z, or write the arc as GOTO records");
    return std::nullopt;
  }
  return circle;
}

// ON,(LINE/x,y,z,x,y,z), ON,2,INTOF,(LINE/...), ON,(PLANE/i,j,k,d)
std::optional<Vec3> CldataArcs::read_end(LineScanner& in, const Circle& circle, const Vec3& at) {
  constexpr const char* kRemedy = "write ON,(LINE/x,y,z,x,y,z) after the circle";
  in.take(',');
  if (!in.take_name("ON") || !in.take(',')) {
    in.fail_unexpected(kRemedy);
    return std::nullopt;
  }
  std::size_t which = 1;
  const std::uint32_t which_column = in.column();
  if (const auto count = in.number()) {
    if ((count->value != 1.0 && count->value != 2.0) || !in.take(',') || !in.take_name("INTOF") ||
        !in.take(',')) {
      in.fail("arc-end"_id, which_column, "the arc ends at no intersection",
              "write ON,2,INTOF,(LINE/...)");
      return std::nullopt;
    }
    which = static_cast<std::size_t>(count->value);
  }
  const bool bracket = in.take('(');
  const std::uint32_t shape_column = in.column();
  CldataRecord shape{in.name(), shape_column, {}};
  const bool line = shape.word == "LINE";
  if ((!line && shape.word != "PLANE") || !in.take('/')) {
    in.fail_unexpected(kRemedy);
    return std::nullopt;
  }
  shape.arguments = read_cldata_arguments(in);
  if (!are_cldata_numbers(in, shape, {line ? 6U : 4U}, kRemedy)) return std::nullopt;
  if (bracket && !in.take(')')) {
    in.fail_unexpected("close the bracket of " + shape.word);
    return std::nullopt;
  }

  const Eigen::Index w = axis_along(circle.axis).value_or(2);
  Vec3 foot = shape.point();  // a point of the line, then the one nearest to the centre
  Vec3 way = line ? Vec3(shape.point(3) - foot) : Vec3(Vec3::Unit(w).cross(foot));
  if (line && circle.arm(foot).norm() < kSamePlace &&
      std::abs(circle.arm(shape.point(3)).norm() - circle.radius) < kSamePlace) {
    return shape.point(3);
  }
  way[w] = 0.0;
  if (way.norm() == 0.0) {
    in.fail("arc-end"_id, shape.column, fmt::format("{} does not cross the circle", shape.word),
            kRemedy);
    return std::nullopt;
  }
  way.normalize();
  if (!line) {
    const Vec3 normal = foot;
    const double slope = normal.squaredNorm() - normal[w] * normal[w];
    const double level = shape.arguments[3].number - normal[w] * at[w];
    foot = normal * (level / slope);
  }
  Vec3 arm = foot - circle.centre;
  arm[w] = 0.0;
  arm -= way * arm.dot(way);
  const double half = circle.radius * circle.radius - arm.squaredNorm();
  if (!(half >= 0.0)) {
    in.fail("arc-end"_id, shape.column, fmt::format("{} does not cross the circle", shape.word),
            kRemedy);
    return std::nullopt;
  }
  std::array<Vec3, 2> ends{circle.centre + arm + way * std::sqrt(half),
                           circle.centre + arm - way * std::sqrt(half)};
  if (circle.turn(at, ends[0]) > circle.turn(at, ends[1])) std::swap(ends[0], ends[1]);
  Vec3 end = ends.at(which - 1);
  end[w] = at[w];
  if (!end.allFinite()) {
    in.fail("arc-end"_id, shape.column, "the end of the arc is too far away", kRemedy);
    return std::nullopt;
  }
  return end;
}

std::optional<CldataArc> CldataArcs::along_line(LineScanner& in, std::uint32_t column,
                                                const std::optional<Vec3>& at) {
  in.take(',');
  if (!in.take_name("GOFWD") || !in.take('/')) {
    in.fail_unexpected("write TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z)");
    return std::nullopt;
  }
  auto circle = read_circle(in);
  if (!circle) return std::nullopt;
  if (!at) {
    in.fail("arc-incomplete"_id, column, "the start of the arc is not known",
            "write a GOTO before it");
    return std::nullopt;
  }
  if (!direction_) {
    in.fail("arc-incomplete"_id, column, "the arc has no direction",
            "write INDIRV/i,j,k before it");
    return std::nullopt;
  }
  const Vec3 along = direction_->is_point ? Vec3(direction_->vector - *at) : direction_->vector;
  direction_.reset();
  const double sense = circle->axis.dot(circle->arm(*at).cross(along));
  if (sense == 0.0) {
    in.fail("arc-incomplete"_id, column, "the direction does not lead along the circle",
            "give INDIRV/i,j,k along the circle at its start");
    return std::nullopt;
  }
  if (sense < 0.0) circle->axis = -circle->axis;
  const auto end = read_end(in, *circle, *at);
  if (!end) return std::nullopt;
  return CldataArc{circle->centre, *end, circle->axis, 1};
}

void add_arc(Block& block, const CldataArc& arc, std::uint32_t column) {
  constexpr std::array kPlanes{"plane XY", "plane ZX", "plane YZ"};
  const auto plane = arc.plane();
  if (plane) {
    add_code(block, *find_code(Dialect::cldata, kPlanes.at(static_cast<std::size_t>(*plane))),
             column);
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (arc.axis[axis] != 0.0 && plane) continue;
    add_number(block, "IJK"[axis], arc.centre[axis], column);
    block.words.back().measure = Measure::absolute;
  }
  if (!plane) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      add_number(block, "uvw"[axis], arc.axis[axis], column);
    }
  }
  if (arc.turns > 1) add_number(block, 'P', arc.turns, column);
}

}  // namespace frustum::parser
