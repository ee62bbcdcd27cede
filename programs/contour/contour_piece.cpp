#include "programs/contour/contour_piece.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>

#include "kinematics/model/inverse.hpp"
#include "programs/contour/contour_path.hpp"
#include "programs/piece_program.hpp"
#include "programs/piece_tool.hpp"
#include "programs/stacked_blank.hpp"

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

constexpr int kTool = 1;
constexpr double kLeastSize = 60.0;  // mm: sides keep 49 points, and the probe's ball 1.5 mm
constexpr double kAllowance = 0.5;   // mm on the flanks of the blank
constexpr double kQuadAngle = 3.0 * kRadPerDeg;

Diagnostics refuse(DiagnosticId id, std::string_view key, std::string message, std::string hint) {
  Diagnostic problem = error(id, std::move(message), std::move(hint));
  problem.key = key;
  return {std::move(problem)};
}

// Corners (+,+), (+,-), (-,-), (-,+), turned counter-clockwise.
ContourPolygon square(std::string_view name, double half, double turned) {
  ContourPolygon polygon{name};
  const Mat3 turn = rotation_z(turned);
  polygon.corners = {turn * Vec3(half, half, 0), turn * Vec3(half, -half, 0),
                     turn * Vec3(-half, -half, 0), turn * Vec3(-half, half, 0)};
  return polygon;
}

// Of a polygon and all within `allowance` of its sides, counter-clockwise.
Outline outside(const ContourPolygon& polygon, double allowance) {
  Outline outline;
  for (std::size_t k = 4; k-- > 0;) {
    outline.push_back(polygon.corner(k) + allowance * (polygon.normal(k) + polygon.normal(k + 3)));
  }
  return outline;
}

// Sides outside of a circle, or inside of it.
Outline around(double radius, bool outside) {
  constexpr int kCorners = 180;
  const double half = std::numbers::pi / kCorners;
  Outline outline;
  for (int i = 0; i < kCorners; ++i) {
    outline.push_back(radius / (outside ? std::cos(half) : 1.0) *
                      Vec3(std::cos(2.0 * half * i), std::sin(2.0 * half * i), 0.0));
  }
  return outline;
}

stock::MeshShape blank_of(const ContourPiece& piece, const ContourGeometry& shape) {
  std::vector<StackLevel> levels;
  levels.push_back({around(shape.circle_radius + kAllowance, true), shape.floor(0)});
  for (std::size_t i = 0; i < shape.polygons.size(); ++i) {
    levels.push_back({outside(shape.polygons[i], kAllowance), shape.floor(i + 1)});
  }
  levels.back().bottom = shape.bottom;
  const Outline bore = piece.bore ? around(shape.bore_radius - kAllowance, false) : Outline{};
  return {std::make_shared<const stock::FacetSolid>(stacked_blank(levels, 0.0, bore)), "blank.ply"};
}

class ContourProgram {
 public:
  ContourProgram(const ContourPiece& piece, const Machine& machine)
      : piece_(piece), machine_(machine) {}

  Result<TestPiece> write(const std::vector<ContourOperation>& operations, TestPiece made,
                          parser::Dialect dialect) {
    header();
    for (const ContourOperation& operation : operations) {
      nc_.comment(operation.name);
      const std::uint32_t first = nc_.next_block();
      for (const ContourMove& move : operation.moves) {
        if (auto problem = unreachable(move.end)) return *problem;
        nc_.block({command_of(move)});
      }
      made.operations.push_back({.name = operation.name,
                                 .first_line = first,
                                 .last_line = nc_.next_block() - 1,
                                 .makes = operation.makes});
    }
    footer();
    const auto written = nc_.write(made, dialect);
    if (!written) return written.error();
    return made;
  }

 private:
  [[nodiscard]] parser::AxisTarget home_of_z() const {
    parser::AxisTarget up;
    up[AxisLetter::Z] = machine_.joint(AxisLetter::Z)->home;
    return up;
  }

  void header() {
    nc_.comment(fmt::format("SIZE {:g} MM, OWN DIMENSIONS, AFTER ISO 10791-7", piece_.size.value));
    nc_.comment(fmt::format("T{} = END MILL D{:g}, LENGTH {:g} MM", kTool, piece_.size.value / 8.0,
                            piece_.tool_length.value));
    nc_.without_compensation();
    nc_.block({machine_traverse(home_of_z())});
    nc_.block({parser::ToolChange{kTool}});
    nc_.block({parser::SpindleChange{parser::SpindleDirection::clockwise, piece_.spindle_speed}});
    parser::AxisTarget rotary;
    for (const AxisLetter letter : parser::kRotaryAxes) {
      if (machine_.joint(letter) != nullptr) rotary[letter] = 0.0;
    }
    if (rotary != parser::AxisTarget{}) nc_.block({machine_traverse(rotary)});
    nc_.block({parser::CompensationChange{.mode = parser::LengthCompensation::length,
                                          .offset_number = kTool},
               parser::WorkOffsetChange{1}});
  }

  void footer() {
    nc_.block({parser::CompensationChange{}});
    nc_.block({machine_traverse(home_of_z())});
    nc_.block({parser::SpindleChange{}});
    nc_.block({parser::Stop{}});
  }

  [[nodiscard]] std::optional<Diagnostics> unreachable(const Vec3& tip) const {
    const AxisPositions q = kinematics::place_tip(machine_, piece_.center + tip,
                                                  piece_.tool_length.value, AxisPositions{});
    const auto beyond = kinematics::travel_violations(machine_, q);
    if (beyond.empty()) return std::nullopt;
    return refuse("axis-over-travel"_id, "",
                  fmt::format("the contouring piece does not fit on machine {}: {}",
                              machine_.name(), fmt::join(beyond, "; ")),
                  "change --center or --size, or choose a larger machine");
  }

  [[nodiscard]] parser::Command command_of(const ContourMove& move) const {
    using Kind = ContourMove::Kind;
    const parser::AxisTarget end = tip_target(move.end);
    if (move.kind == Kind::rapid) return parser::Traverse{.end = end};
    if (move.kind == Kind::feed) return parser::LinearFeed{.end = end, .feed = {piece_.feed}};
    return parser::ArcFeed{.end = end,
                           .center = move.centre,
                           .turns = move.kind == Kind::clockwise ? -1 : 1,
                           .feed = {piece_.feed}};
  }

  const ContourPiece& piece_;
  const Machine& machine_;
  PieceProgram nc_{"0107", "CONTOURING PIECE"};
};

}  // namespace

Vec3 ContourPolygon::along(std::size_t side) const {
  return (corner(side + 1) - corner(side)).normalized();
}
Vec3 ContourPolygon::normal(std::size_t side) const { return Vec3::UnitZ().cross(along(side)); }
double ContourPolygon::length(std::size_t side) const {
  return (corner(side + 1) - corner(side)).norm();
}

double ContourGeometry::floor(std::size_t index) const {
  return -level * static_cast<double>(index + 1);
}
double ContourGeometry::middle(std::size_t index) const { return floor(index) + 0.5 * level; }

Result<ContourGeometry> geometry(const ContourPiece& piece) {
  const double size = piece.size.value;
  if (!(size >= kLeastSize && std::isfinite(size))) {
    return refuse("piece-size"_id, "size",
                  fmt::format("a contouring piece of {:g} mm is too small", size),
                  fmt::format("at least {:g} mm are needed", kLeastSize));
  }
  if (!(piece.feed >= 0.001 && piece.feed <= 1e5)) {
    return refuse(
        "piece-feed"_id, "feed",
        fmt::format("the feed must be between 0.001 and 100000 mm/min, is {:g}", piece.feed),
        "millimetres a minute, for example 600");
  }
  if (!(piece.spindle_speed >= 1.0 && piece.spindle_speed <= 1e6)) {
    return refuse("out-of-range"_id, "speed", fmt::format("{:g} 1/min", piece.spindle_speed),
                  "the spindle must turn: 1 to 1000000");
  }
  if (!(piece.tool_length.value >= 1.0 && piece.tool_length.value <= 5000.0)) {
    return refuse("out-of-range"_id, "tool-length", fmt::format("{:g} mm", piece.tool_length.value),
                  "it must be between 1 and 5000 mm");
  }
  ContourGeometry shape;
  shape.cutter_radius = size / 16.0;
  shape.circle_radius = 0.5 * 0.5625 * size;
  shape.bore_radius = 0.5 * 0.1875 * size;
  shape.level = size / 20.0;
  const double half_diagonal = 0.4375 * size;
  ContourPolygon diamond{"diamond"};
  diamond.corners = {Vec3(0, half_diagonal, 0), Vec3(half_diagonal, 0, 0),
                     Vec3(0, -half_diagonal, 0), Vec3(-half_diagonal, 0, 0)};
  shape.polygons = {diamond, square("quad", 0.5 * 0.9375 * size, kQuadAngle),
                    square("square", 0.5 * size, 0.0)};
  shape.bottom = -5.0 * shape.level;
  return shape;
}

Result<TestPiece> contour_piece(const ContourPiece& piece, const Machine& machine,
                                parser::Dialect dialect) {
  const auto shape = geometry(piece);
  if (!shape) return shape.error();
  for (const AxisLetter letter : parser::kLinearAxes) {
    if (machine.joint(letter) != nullptr) continue;
    return refuse(
        "machine-axis"_id, "machine",
        fmt::format("machine {} has no axis {}", machine.name(), kinematics::to_char(letter)),
        "choose one with axes X, Y and Z");
  }
  TestPiece made;
  made.title = fmt::format("Contouring piece of {:g} mm on {}, own dimensions", piece.size.value,
                           machine.name());
  made.placement = {piece.center, Vec3::Zero()};
  made.work_offsets = {{1, piece.center}};
  made.tools[kTool] =
      piece_tool({2.0 * shape->cutter_radius}, piece.tool_length, {std::ceil(6.0 * shape->level)});
  made.blank = blank_of(piece, *shape);
  made.plan = contour_plan(piece, *shape);
  made.program_file = "contour.nc";
  return ContourProgram(piece, machine)
      .write(contour_path(piece, *shape), std::move(made), dialect);
}

}  // namespace frustum::programs
