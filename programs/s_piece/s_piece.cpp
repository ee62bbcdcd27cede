#include "programs/s_piece/s_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "programs/piece_ranges.hpp"
#include "programs/piece_tool.hpp"
#include "programs/s_piece/s_blank.hpp"

namespace frustum::programs {
namespace {

constexpr double kLead = 15.0;         // mm, straight, at either end of a flank
constexpr double kClear = 30.0;        // mm above the top, along the tool
constexpr double kSemiFinish = 0.1;    // mm left by the first pass
constexpr std::size_t kSemiShare = 4;  // one block of the first pass for so many of the last

constexpr std::array<std::array<double, 2>, 13> kLower{{{-101.86, 1.15},
                                                        {-96.90, 8.31},
                                                        {-86.97, 23.44},
                                                        {-64.25, 40.16},
                                                        {-35.67, 41.33},
                                                        {-11.74, 25.96},
                                                        {3.77, 3.58},
                                                        {17.86, -17.12},
                                                        {36.17, -30.02},
                                                        {57.38, -31.16},
                                                        {76.87, -19.69},
                                                        {86.71, -6.00},
                                                        {91.61, 1.14}}};
constexpr std::array<std::array<double, 2>, 13> kUpper{{{-100.31, 3.86},
                                                        {-96.43, 11.74},
                                                        {-88.58, 28.03},
                                                        {-63.76, 47.84},
                                                        {-29.75, 46.67},
                                                        {-6.22, 25.46},
                                                        {5.14, 0.77},
                                                        {16.30, -21.73},
                                                        {36.64, -37.69},
                                                        {63.29, -36.53},
                                                        {82.44, -19.16},
                                                        {89.40, -4.00},
                                                        {93.21, 3.90}}};

std::vector<Vec3> at_height(const std::array<std::array<double, 2>, 13>& curve, double z) {
  std::vector<Vec3> points;
  for (const auto& [x, y] : curve) points.emplace_back(x, y, z);
  return points;
}

// Every number of the piece within what a machine could do: checked before anything is generated.
std::optional<Diagnostic> check_s(const SPiece& piece) {
  const PieceRange ranges[] = {
      {"cutter", piece.cutter.value, 1.0, 500.0, "mm"},
      {"height", piece.height.value, 1.0, 500.0, "mm"},
      {"overhang", piece.overhang.value, 0.0, 100.0, "mm"},
      {"tool-length", piece.tool_length.value, 1.0, 5000.0, "mm"},
      {"orientation", piece.orientation.value * kDegPerRad, -360.0, 360.0, "deg"},
      {"feed", piece.feed, 1e-3, 1e5, "mm/min"},
      {"speed", piece.spindle_speed, 1.0, 1e6, "1/min"},
      {"blocks", static_cast<double>(piece.blocks), 10.0, 1e6, "blocks"}};
  return out_of_range(ranges, piece.center);
}

// By 180 deg about Z.
FlankCurves turned(const FlankCurves& a) {
  FlankCurves b = a;
  for (auto* curve : {&b.lower, &b.upper}) {
    for (Vec3& p : *curve) p = Vec3(-p.x(), -p.y(), p.z());
  }
  return b;
}

SplineSurface surface_of(const FlankCurves& curves) {
  return SplineSurface::ruled(curves.lower, curves.upper);
}
FlankCurves reversed(FlankCurves curves) {
  std::ranges::reverse(curves.lower);
  std::ranges::reverse(curves.upper);
  return curves;
}

class SPath {
 public:
  SPath(const SPiece& piece, const SGeometry& shape)
      : piece_(piece),
        shape_(shape),
        program_from_workpiece_(rotation_z(piece.orientation.value)) {}

  [[nodiscard]] std::vector<PathOperation> operations() const {
    std::vector<PathOperation> all;
    for (const bool finish : {false, true}) {
      for (std::size_t k = 0; k < 2; ++k) all.push_back(along(k, finish));
    }
    return all;
  }

 private:
  [[nodiscard]] PathOperation along(std::size_t flank, bool finish) const {
    const std::string letter = flank == 0 ? "A" : "B";
    PathOperation op{
        .name = fmt::format("flank {} {}", letter, finish ? "finishing" : "semi-finishing")};
    if (finish) op.makes = {"s." + letter};
    const FlankCutter cutter{0.5 * piece_.cutter.value + (finish ? 0.0 : kSemiFinish),
                             piece_.overhang.value, piece_.method};
    const std::vector<FlankPose> path =
        flank_path(shape_.flanks[flank], cutter, kLead,
                   finish ? piece_.blocks : std::max<std::size_t>(10, piece_.blocks / kSemiShare));
    const auto above = [&](const FlankPose& at) {
      return moved(at, (shape_.top - at.pose.tip.z() + kClear) / at.pose.axis.z(), true);
    };
    op.lead_in = {above(path.front()), moved(path.front(), 0.0, false)};
    for (std::size_t i = 1; i < path.size(); ++i) op.cut.push_back(moved(path[i], 0.0, false));
    op.lead_out = {above(path.back())};
    return op;
  }
  // Along the tool by so much.
  [[nodiscard]] PathMove moved(const FlankPose& at, double by, bool rapid) const {
    return {{program_from_workpiece_ * (at.pose.tip + by * at.pose.axis),
             program_from_workpiece_ * at.pose.axis},
            rapid};
  }

  const SPiece& piece_;
  const SGeometry& shape_;
  Mat3 program_from_workpiece_;
};

// How far below curve C0 the cutter gets.
double reach_of(const std::vector<PathOperation>& operations, const SPiece& piece,
                const SGeometry& shape) {
  double lowest = shape.base;
  for (const PathOperation& op : operations) {
    for (const PathMove& move : op.cut) {
      const double across = std::hypot(move.pose.axis.x(), move.pose.axis.y());
      lowest = std::min(lowest, move.pose.tip.z() - 0.5 * piece.cutter.value * across);
    }
  }
  return shape.base - lowest;
}

PosedProgramSettings settings_of(const SPiece& piece) {
  PosedProgramSettings settings;
  settings.number = "0108";
  settings.title = "S-SHAPED PIECE";
  settings.remarks = {
      piece.points ? "CONTROL POINTS AS GIVEN" : "OWN CONTROL POINTS, AFTER ISO 10791-7",
      fmt::format("{} FLANK MILLING, {} BLOCKS A FLANK",
                  kFlankMethodNames.at(static_cast<std::size_t>(piece.method)), piece.blocks),
      fmt::format("T{} = END MILL D{:g}, LENGTH {:g} MM", kPieceTool, piece.cutter.value,
                  piece.tool_length.value)};
  settings.piece = "the S-shaped piece";
  settings.remedy = "change --center, --orientation or --tool-length, or choose a larger machine";
  settings.origin = piece.center;
  settings.tool_length = piece.tool_length;
  settings.feed = piece.feed;
  settings.spindle_speed = piece.spindle_speed;
  settings.form = piece.form;
  settings.rotary_start = true;
  return settings;
}

}  // namespace

Result<SGeometry> geometry(const SPiece& piece) {
  if (const auto problem = check_s(piece)) return *problem;
  ControlPoints points;
  if (piece.points) {
    points = *piece.points;
  } else {
    points.a = {at_height(kLower, 0.0), at_height(kUpper, piece.height.value)};
  }
  const FlankCurves b = points.b ? *points.b : turned(points.a);
  SGeometry shape{{surface_of(points.a), surface_of(b)},
                  points.a.lower.front().z(),
                  points.a.upper.front().z()};
  for (SplineSurface& flank : shape.flanks) {
    if (flank.has_normals()) continue;
    return refused_number("flank-folds"_id, "points",
                          "a flank between its two curves folds, or has no area",
                          "both curves must run the same way, one above the other");
  }
  // Normals out of the wall: away from the other flank, whichever way its points run.
  const auto outward = [](const SplineSurface& one, const SplineSurface& other) {
    const SplinePoint middle = one.at(0.5, 0.5);
    return middle.normal().dot(middle.r - other.point(0.5, 0.5)) > 0.0;
  };
  if (!outward(shape.flanks[0], shape.flanks[1])) {
    shape.flanks[0] = surface_of(reversed(points.a));
  }
  if (!outward(shape.flanks[1], shape.flanks[0])) shape.flanks[1] = surface_of(reversed(b));
  for (const SplineSurface& flank : shape.flanks) {
    if (auto problem = does_not_fit(flank, {0.5 * piece.cutter.value})) return *problem;
  }
  return shape;
}

Result<TestPiece> s_piece(const SPiece& piece, const kinematics::Machine& machine,
                          parser::Dialect dialect) {
  const auto shape = geometry(piece);
  if (!shape) return shape.error();
  TestPiece made;
  made.title = fmt::format("S-shaped piece on {}, after ISO 10791-7, {}", machine.name(),
                           piece.points ? "control points as given" : "own control points");
  made.placement = {piece.center, Vec3(0.0, 0.0, piece.orientation.value)};
  made.work_offsets = {{1, piece.center}, {kMachineOffset, Vec3::Zero()}};
  const double flutes = 1.1 * (shape->top - shape->base) + piece.overhang.value + 10.0;
  made.tools[kPieceTool] = piece_tool(piece.cutter, piece.tool_length, {std::ceil(flutes)});
  const std::vector<PathOperation> operations = SPath(piece, *shape).operations();
  auto blank = s_blank(*shape, reach_of(operations, piece, *shape));
  if (!blank) return blank.error();
  made.blank = *std::move(blank);
  made.plan = s_plan(piece, *shape);
  made.program_file = "s-piece.nc";
  return write_posed_program(settings_of(piece), operations, machine, std::move(made), dialect);
}

}  // namespace frustum::programs
