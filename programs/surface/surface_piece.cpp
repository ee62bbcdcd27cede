#include "programs/surface/surface_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "programs/milling/point_milling.hpp"
#include "programs/piece_ranges.hpp"
#include "programs/piece_tool.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::programs {
namespace {

using metrology::CharacteristicKind;
using metrology::FeatureKind;

constexpr double kClearance = 30.0;  // mm along the tool, before and after a pass
constexpr double kSheetLeft = 0.3;   // mm on the blank
constexpr std::size_t kSheetFacets = 80;

double diameter_of(const SurfacePiece& piece) {
  constexpr double kFlank = 20.0, kBall = 10.0;  // mm
  return piece.cutter ? piece.cutter->value : piece.surface.rows() == 2 ? kFlank : kBall;
}
std::size_t blocks_of(const SurfacePiece& piece) {
  return piece.blocks.value_or(piece.surface.rows() == 2 ? 4000 : 400);
}
FlankCutter flank_cutter(const SurfacePiece& piece) {
  return {0.5 * diameter_of(piece), 2.0, piece.method};
}
BallCutter ball_cutter(const SurfacePiece& piece) {
  return {0.5 * diameter_of(piece), piece.lead.value};
}

std::optional<Diagnostic> check_surface(const SurfacePiece& piece) {
  const PieceRange ranges[] = {
      {"cutter", diameter_of(piece), 0.5, 500.0, "mm"},
      {"cusp", piece.cusp.value * kUmPerMm, 0.01, 1000.0, "um"},
      {"lead", piece.lead.value * kDegPerRad, 0.0, 80.0, "deg"},
      {"thickness", piece.thickness.value, 1.0, 500.0, "mm"},
      {"tool-length", piece.tool_length.value, 1.0, 5000.0, "mm"},
      {"orientation", piece.orientation.value * kDegPerRad, -360.0, 360.0, "deg"},
      {"feed", piece.feed, 1e-3, 1e5, "mm/min"},
      {"speed", piece.spindle_speed, 1.0, 1e6, "1/min"},
      {"blocks", static_cast<double>(blocks_of(piece)), 2.0, 1e6, "blocks"}};
  if (auto problem = out_of_range(ranges, piece.center)) return problem;
  if (!piece.surface.has_normals()) {
    return refused_number("flank-folds"_id, "net", "the surface folds, or has no area",
                          "rows must follow each other, and run the same way");
  }
  return piece.surface.rows() == 2 ? does_not_fit(piece.surface, flank_cutter(piece))
                                   : does_not_fit(piece.surface, ball_cutter(piece));
}

// Both faces and the rim around them.
stock::MeshShape sheet(const SurfacePiece& piece) {
  using Facet = stock::FacetSolid::Facet;
  const std::size_t along = kSheetFacets;
  const std::size_t across = piece.surface.rows() == 2 ? 8 : kSheetFacets;
  std::vector<Vec3> vertices;
  for (const double off : {kSheetLeft, -piece.thickness.value}) {
    for (std::size_t i = 0; i <= across; ++i) {
      for (std::size_t j = 0; j <= along; ++j) {
        const SplinePoint p =
            piece.surface.at(static_cast<double>(j) / static_cast<double>(along),
                             static_cast<double>(i) / static_cast<double>(across));
        vertices.push_back(p.r + off * p.normal());
      }
    }
  }
  const auto corner = [&](bool top, std::size_t i, std::size_t j) {
    const std::size_t first = top ? 0 : (across + 1) * (along + 1);
    return static_cast<std::uint32_t>(first + i * (along + 1) + j);
  };
  std::vector<Facet> facets;
  const auto quad = [&facets](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    facets.push_back({a, b, c});
    facets.push_back({a, c, d});
  };
  // The normal is r_v x r_u: seen from there v turns to u counter-clockwise.
  for (std::size_t i = 0; i < across; ++i) {
    for (std::size_t j = 0; j < along; ++j) {
      quad(corner(true, i, j), corner(true, i + 1, j), corner(true, i + 1, j + 1),
           corner(true, i, j + 1));
      quad(corner(false, i, j), corner(false, i, j + 1), corner(false, i + 1, j + 1),
           corner(false, i + 1, j));
    }
  }
  const auto rim = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    quad(corner(true, i, j), corner(true, k, l), corner(false, k, l), corner(false, i, j));
  };
  for (std::size_t j = 0; j < along; ++j) {
    rim(0, j, 0, j + 1);
    rim(across, j + 1, across, j);
  }
  for (std::size_t i = 0; i < across; ++i) {
    rim(i + 1, 0, i, 0);
    rim(i, along, i + 1, along);
  }
  return {std::make_shared<const stock::FacetSolid>(std::move(vertices), std::move(facets)),
          "blank.ply"};
}

class SurfacePath {
 public:
  explicit SurfacePath(const SurfacePiece& piece)
      : piece_(piece), program_from_workpiece_(rotation_z(piece.orientation.value)) {}

  [[nodiscard]] PathOperation operation(const std::vector<double>& passes) const {
    PathOperation op{.name = "surface"};
    std::vector<kinematics::ToolPose> all;
    if (piece_.surface.rows() == 2) {
      constexpr double kFlankLead = 15.0;
      for (const FlankPose& at :
           flank_path(piece_.surface, flank_cutter(piece_), kFlankLead, blocks_of(piece_))) {
        all.push_back(at.pose);
      }
    } else {
      const BallCutter cutter = ball_cutter(piece_);
      for (std::size_t i = 0; i < passes.size(); ++i) {
        auto pass =
            ball_pass(piece_.surface, cutter, passes[i], cutter.radius + 2.0, blocks_of(piece_));
        if (i % 2 == 1) std::ranges::reverse(pass);
        all.insert(all.end(), pass.begin(), pass.end());
      }
    }
    op.lead_in = {moved(all.front(), kClearance, true), moved(all.front(), 0.0, false)};
    for (std::size_t i = 1; i < all.size(); ++i) op.cut.push_back(moved(all[i], 0.0, false));
    op.lead_out = {moved(all.back(), kClearance, true)};
    return op;
  }

 private:
  [[nodiscard]] PathMove moved(const kinematics::ToolPose& at, double by, bool rapid) const {
    // A flank is left along the tool only beyond the surface.
    const double far = piece_.surface.rows() == 2 && by > 0.0
                           ? by + (piece_.surface.point(0, 1) - piece_.surface.point(0, 0)).norm()
                           : by;
    return {{program_from_workpiece_ * (at.tip + far * at.axis), program_from_workpiece_ * at.axis},
            rapid};
  }
  const SurfacePiece& piece_;
  Mat3 program_from_workpiece_;
};

// A freeform surface by touches on passes, where no cusp is; a ruled one by lines.
metrology::InspectionPlan plan_of(const SurfacePiece& piece, const std::vector<double>& passes) {
  metrology::InspectionPlan plan;
  plan.title = "Surface of a net of control points";
  plan.alignment = metrology::Alignment::plan;
  std::vector<std::string> names;
  if (piece.surface.rows() == 2) {
    metrology::SurfaceLineStrategy lines;
    for (const double v : lines.heights) {
      for (int i = 0; i < lines.points; ++i) {
        const double u = lines.from + (lines.to - lines.from) * i / (lines.points - 1);
        lines.geometric.push_back(flank_deviation(piece.surface, flank_cutter(piece), u, v));
      }
    }
    names = {"surface"};
    plan.features.push_back({.name = "surface",
                             .kind = FeatureKind::ruled,
                             .net = {std::make_shared<const SplineSurface>(piece.surface)},
                             .strategy = std::move(lines)});
  } else {
    plan.probe.ball_diameter = 1.0;
    constexpr int kLines = 7, kPoints = 15;
    for (int i = 0; i < kLines; ++i) {
      const double share = 0.05 + 0.9 * i / (kLines - 1);
      const auto pass =
          static_cast<std::size_t>(std::lround(share * static_cast<double>(passes.size() - 1)));
      for (int j = 0; j < kPoints; ++j) {
        const SplinePoint p = piece.surface.at(0.05 + 0.9 * j / (kPoints - 1), passes[pass]);
        names.push_back(fmt::format("p{}.{}", i + 1, j + 1));
        plan.features.push_back({.name = names.back(),
                                 .kind = FeatureKind::point,
                                 .point = p.r,
                                 .axis = p.normal(),
                                 .strategy = metrology::single_touch()});
      }
    }
  }
  plan.characteristics.push_back({.name = "surface.profile",
                                  .kind = CharacteristicKind::surface_profile,
                                  .features = names,
                                  .tolerance = piece.tolerance.value});
  return plan;
}

Result<TestPiece> piece_as_it_faces(const SurfacePiece& piece, const kinematics::Machine& machine,
                                    parser::Dialect dialect) {
  if (const auto problem = check_surface(piece)) return *problem;
  const bool ruled = piece.surface.rows() == 2;
  const std::vector<double> passes =
      ruled ? std::vector<double>{}
            : ball_passes(piece.surface, ball_cutter(piece), piece.cusp.value);
  constexpr double kMostBlocks = 2e6;
  if (static_cast<double>(passes.size()) * static_cast<double>(blocks_of(piece)) > kMostBlocks) {
    return refused_number("out-of-range"_id, "cusp",
                          fmt::format("{} passes of {} blocks", passes.size(), blocks_of(piece)),
                          fmt::format("at most {:g} blocks: choose a larger cusp or cutter, or "
                                      "fewer blocks",
                                      kMostBlocks));
  }
  TestPiece made;
  made.title = fmt::format("{} surface on {}", ruled ? "Ruled" : "Freeform", machine.name());
  made.placement = {piece.center, Vec3(0.0, 0.0, piece.orientation.value)};
  made.work_offsets = {{1, piece.center}, {kMachineOffset, Vec3::Zero()}};
  const double ruling = (piece.surface.point(0, 1) - piece.surface.point(0, 0)).norm();
  const Mm flutes{ruled ? std::ceil(1.1 * ruling + 10.0) : 2.0 * diameter_of(piece)};
  cutter::CutterSpec tool = piece_tool({diameter_of(piece)}, piece.tool_length, flutes);
  if (!ruled) tool.type = cutter::CutterType::ball;
  made.tools[kPieceTool] = tool;
  made.blank = sheet(piece);
  made.plan = plan_of(piece, passes);
  made.program_file = "surface.nc";
  PosedProgramSettings settings;
  settings.number = "0109";
  settings.title = "SURFACE";
  settings.remarks = {
      ruled ? fmt::format("{} FLANK MILLING",
                          kFlankMethodNames.at(static_cast<std::size_t>(piece.method)))
            : fmt::format("BALL MILLING, {} PASSES", passes.size()),
      fmt::format("T{} = {} D{:g}, LENGTH {:g} MM", kPieceTool,
                  ruled ? "END MILL" : "BALL END MILL", diameter_of(piece),
                  piece.tool_length.value)};
  settings.piece = "the surface";
  settings.remedy = "change --center, --orientation or --tool-length, or choose a larger machine";
  settings.origin = piece.center;
  settings.tool_length = piece.tool_length;
  settings.feed = piece.feed;
  settings.spindle_speed = piece.spindle_speed;
  settings.form = piece.form;
  settings.rotary_start = true;
  return write_posed_program(settings, {SurfacePath(piece).operation(passes)}, machine,
                             std::move(made), dialect);
}

// Why no tool gets there: it would have to come from below. Nothing: it comes from above somewhere.
std::optional<Diagnostic> turned_over(const SurfacePiece& piece) {
  const bool is_ruled = piece.surface.rows() == 2;
  double highest = -1.0, u_there = 0.0, v_there = 0.0;
  constexpr int kPlaces = 8;
  for (int i = 0; i <= kPlaces; ++i) {
    for (int j = 0; j <= kPlaces; ++j) {
      const double u = static_cast<double>(i) / kPlaces, v = static_cast<double>(j) / kPlaces;
      const SplinePoint p = piece.surface.at(u, v);
      // A flank is milled along its rulings, a freeform surface from the side that is outside.
      const double rises = is_ruled ? p.v.normalized().z() : p.normal().z();
      if (rises <= highest) continue;
      highest = rises;
      u_there = u;
      v_there = v;
    }
  }
  if (!(highest < 0.0)) return std::nullopt;
  if (is_ruled) {
    return refused_number("surface-turned-over"_id, "net",
                          fmt::format("row 1 is below row 0 everywhere (least at u = {:.3g}), and "
                                      "the cutter's axis goes from row 0 to row 1",
                                      u_there),
                          "exchange the rows, and write the points of each the other way round, so "
                          "that r_v x r_u still points out of the material");
  }
  return refused_number(
      "surface-turned-over"_id, "net",
      fmt::format("the surface is turned over: r_v x r_u, which points out of the material, points "
                  "down everywhere (least at u = {:.3g}, v = {:.3g})",
                  u_there, v_there),
      "write the points of every row in the opposite order");
}

}  // namespace

Result<TestPiece> surface_piece(const SurfacePiece& piece, const kinematics::Machine& machine,
                                parser::Dialect dialect) {
  auto made = piece_as_it_faces(piece, machine, dialect);
  if (made || !piece.surface.has_normals()) return made;
  if (const auto reason = turned_over(piece)) return *reason;
  return made;
}

}  // namespace frustum::programs
