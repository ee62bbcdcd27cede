// What is measured of an S-shaped piece.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "programs/s_piece/s_piece.hpp"

namespace frustum::programs {
namespace {

using metrology::CharacteristicKind;
using metrology::PlannedCharacteristic;
using metrology::SurfaceLineStrategy;

constexpr std::array<std::string_view, 2> kFlanks{"s.A", "s.B"};
constexpr std::array<std::string_view, 3> kLines{"line_low", "line_mid", "line_high"};

FlankCutter cutter_of(const SPiece& piece, FlankMethod method) {
  return {0.5 * piece.cutter.value, piece.overhang.value, method};
}

// In the order of the points.
std::vector<double> left_by(const SplineSurface& flank, const FlankCutter& cutter) {
  const SurfaceLineStrategy lines;
  std::vector<double> left;
  for (const double v : lines.heights) {
    for (int i = 0; i < lines.points; ++i) {
      const double u = lines.from + (lines.to - lines.from) * i / (lines.points - 1);
      left.push_back(flank_deviation(flank, cutter, u, v));
    }
  }
  return left;
}

}  // namespace

metrology::InspectionPlan s_plan(const SPiece& piece, const SGeometry& shape) {
  metrology::InspectionPlan plan;
  plan.title = "S-shaped piece, after ISO 10791-7, own control points";
  if (piece.points) plan.title = "S-shaped piece, control points as given";
  plan.alignment = metrology::Alignment::plan;
  const auto add = [&](PlannedCharacteristic c) {
    c.tolerance = piece.tolerance.value;
    plan.characteristics.push_back(std::move(c));
  };
  const std::vector<std::string> both(kFlanks.begin(), kFlanks.end());
  for (std::size_t k = 0; k < kFlanks.size(); ++k) {
    const std::string name(kFlanks[k]);
    SurfaceLineStrategy lines;
    lines.geometric = left_by(shape.flanks[k], cutter_of(piece, piece.method));
    plan.features.push_back({.name = name,
                             .kind = metrology::FeatureKind::ruled,
                             .net = {std::make_shared<const SplineSurface>(shape.flanks[k])},
                             .strategy = std::move(lines)});
    for (std::size_t line = 0; line < kLines.size(); ++line) {
      add({.name = fmt::format("{}.{}", name, kLines[line]),
           .kind = CharacteristicKind::line_profile,
           .features = {name},
           .sections = {line}});
    }
    add({.name = name + ".profile",
         .kind = CharacteristicKind::surface_profile,
         .features = {name}});
  }
  add({.name = "s.profile", .kind = CharacteristicKind::surface_profile, .features = both});
  add({.name = "s.profile_floating",
       .kind = CharacteristicKind::surface_profile,
       .features = both,
       .floating = true});
  add({.name = "s.thickness_mid",
       .kind = CharacteristicKind::thickness,
       .features = both,
       .sections = {1}});
  return plan;
}

std::vector<MethodDeviation> method_deviations(const SPiece& piece, const SGeometry& shape) {
  std::vector<MethodDeviation> all;
  for (const FlankMethod method :
       {FlankMethod::two_point, FlankMethod::balanced, FlankMethod::three_point}) {
    std::vector<double> left;
    for (const SplineSurface& flank : shape.flanks) {
      const std::vector<double> of_flank = left_by(flank, cutter_of(piece, method));
      left.insert(left.end(), of_flank.begin(), of_flank.end());
    }
    MethodDeviation found{method};
    const auto [low, high] = std::ranges::minmax_element(left);
    found.lowest = *low;
    found.highest = *high;
    for (const double d : left) found.rms += d * d / static_cast<double>(left.size());
    found.rms = std::sqrt(found.rms);
    all.push_back(found);
  }
  return all;
}

}  // namespace frustum::programs
