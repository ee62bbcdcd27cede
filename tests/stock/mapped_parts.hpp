// Workpieces of many segments for tests that compare maps of rays and meshes bit for bit.
//
// Units: mm; frame: workpiece. Errors: none.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include "core/units.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::stock::testing {

using cutter::Cutter;
using cutter::CutterType;
using kinematics::ToolPath;
using kinematics::ToolPose;

inline void add_block(ToolPath& path, const std::vector<ToolPose>& poses, int tool) {
  const auto block = static_cast<std::uint32_t>(path.blocks.size());
  path.blocks.push_back({.source_line = block + 1, .tool = tool});
  for (const ToolPose& pose : poses) {
    path.poses.push_back(pose);
    if (&pose == &poses.front()) continue;
    path.segments.push_back({static_cast<std::uint32_t>(path.poses.size() - 2), block});
  }
}

inline Cutter tool(const cutter::CutterSpec& spec) { return *Cutter::make(spec); }

// A cone of 15 degrees half angle, milled by the flank, in one round of many segments.
inline ToolPath cone_path(int segments) {
  constexpr double kHalfAngle = 15.0 * kRadPerDeg, kGround = 15.0, kRadius = 3.0;
  std::vector<ToolPose> poses;
  for (int i = 0; i <= segments; ++i) {
    const double phi = 2.0 * std::numbers::pi * (i % segments) / segments;
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    const Vec3 normal = std::cos(kHalfAngle) * out + std::sin(kHalfAngle) * Vec3::UnitZ();
    const Vec3 up = std::cos(kHalfAngle) * Vec3::UnitZ() - std::sin(kHalfAngle) * out;
    poses.push_back({kGround * out + kRadius * normal + up, up});
  }
  ToolPath path;
  add_block(path, poses, 1);
  return path;
}
inline Workpiece cone(const cutter::CutterSpec& spec) {
  return {*Blank::make(BoxShape{40, 40, 12}, Vec3::Zero()),
          *cutter::SweptCutter::sweep(cone_path(720), {{1, tool(spec)}})};
}

// A hub with channels in five axes, the tool on the normal of the hub, and a bore along its axis.
inline Workpiece hub() {
  ToolPath path;
  add_block(path, {{{0, 0, 50}, Vec3::UnitZ()}, {{0, 0, -6}, Vec3::UnitZ()}}, 2);
  for (int channel = 0; channel < 4; ++channel) {
    for (int row = -2; row <= 2; ++row) {
      std::vector<ToolPose> poses;
      for (int i = 0; i <= 120; ++i) {
        const double s = 0.5 * std::numbers::pi * i / 120.0;
        const double phi = 0.5 * std::numbers::pi * channel + 0.12 * row + 0.3 * s;
        const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
        const Vec3 normal = std::cos(s) * out + std::sin(s) * Vec3::UnitZ();
        poses.push_back({(16.0 + 30.0 * (1.0 - std::cos(s))) * out +
                             (40.0 - 36.0 * std::sin(s)) * Vec3::UnitZ(),
                         normal});
      }
      add_block(path, poses, 1);
    }
  }
  return {*Blank::make(FrustumShape{52, 27, 44}, Vec3::Zero()),
          *cutter::SweptCutter::sweep(path, {{1, tool({.type = CutterType::taper_ball,
                                                       .diameter = {6},
                                                       .length = {140},
                                                       .flute_length = {40},
                                                       .taper_angle = 2.0_deg})},
                                             {2, tool({.type = CutterType::drill,
                                                       .diameter = {14},
                                                       .length = {140},
                                                       .flute_length = {70},
                                                       .tip_angle = 140.0_deg})}})};
}

inline const cutter::CutterSpec kFlat{
    .type = CutterType::flat, .diameter = {6}, .length = {100}, .flute_length = {15}};
inline const cutter::CutterSpec kHollow{.type = CutterType::bull,
                                        .diameter = {6},
                                        .length = {100},
                                        .flute_length = {15},
                                        .corner_radius = {1},
                                        .end_angle = 3.0_deg};

}  // namespace frustum::stock::testing
