// Tool paths that the removal benchmarks cut: flank milling of a cone, a freeform surface in rows.
//
// Units: mm, rad; frame: workpiece. Errors: none.
#pragma once

#include <cmath>
#include <map>
#include <numbers>

#include "core/random.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::bench {

using kinematics::ToolPath;
using kinematics::ToolPose;

inline void add_pose(ToolPath& path, const ToolPose& pose) {
  path.poses.push_back(pose);
  if (path.poses.size() < 2) return;
  const auto block = static_cast<std::uint32_t>(path.blocks.size());
  path.blocks.push_back({.source_line = block + 1, .tool = 1});
  path.segments.push_back({static_cast<std::uint32_t>(path.poses.size() - 2), block});
}

inline cutter::Cutter end_mill(cutter::CutterType type, double diameter, double flutes) {
  return *cutter::Cutter::make(
      {.type = type, .diameter = {diameter}, .length = {100.0}, .flute_length = {flutes}});
}

// A cone of 15 degrees half angle, 100 mm wide at the ground, in a block of 120 x 120 x 40 mm.
struct ConeScene {
  static constexpr double kGround = 50.0;
  static constexpr double kHalfAngle = 15.0 * kRadPerDeg;
  static constexpr double kRadius = 6.0;
  static constexpr double kHeight = 40.0;

  [[nodiscard]] static stock::Blank blank() {
    return *stock::Blank::make(stock::BoxShape{120, 120, kHeight}, Vec3::Zero());
  }
  [[nodiscard]] static ToolPath path(int blocks) {
    ToolPath path;
    for (int i = 0; i <= blocks; ++i) {
      const double phi = 2.0 * std::numbers::pi * (i % blocks) / blocks;
      const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
      const Vec3 normal = std::cos(kHalfAngle) * out + std::sin(kHalfAngle) * Vec3::UnitZ();
      const Vec3 up = std::cos(kHalfAngle) * Vec3::UnitZ() - std::sin(kHalfAngle) * out;
      add_pose(path, {kGround * out + kRadius * normal + 1.0 * up, up});
    }
    return path;
  }
  [[nodiscard]] static stock::Workpiece cut(int blocks) {
    auto swept = cutter::SweptCutter::sweep(
        path(blocks), {{1, end_mill(cutter::CutterType::flat, 2 * kRadius, 50.0)}});
    return {blank(), *std::move(swept)};
  }
  // From 5 mm before the flank, perpendicular to it.
  [[nodiscard]] static Ray probe(std::uint64_t k) {
    const double z = 6.0 + 30.0 * uniform({.seed = 1}, 2 * k);
    const double phi = 2.0 * std::numbers::pi * uniform({.seed = 1}, 2 * k + 1);
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    const Vec3 normal = std::cos(kHalfAngle) * out + std::sin(kHalfAngle) * Vec3::UnitZ();
    const Vec3 on_cone = (kGround - z * std::tan(kHalfAngle)) * out + z * Vec3::UnitZ();
    return {on_cone + 5.0 * normal, -normal};
  }
};

// Rows of a wavy surface, the tool leaning as it goes: a long five-axis program.
struct FiveAxisScene {
  static constexpr double kSize = 100.0;

  [[nodiscard]] static ToolPath path(int blocks) {
    const int rows = static_cast<int>(std::lround(std::sqrt(static_cast<double>(blocks))));
    ToolPath path;
    for (int row = 0; row < rows; ++row) {
      for (int i = 0; i <= rows; ++i) {
        const double x = kSize * ((row % 2 == 0 ? i : rows - i) / static_cast<double>(rows) - 0.5);
        const double y = kSize * ((row + 0.5) / rows - 0.5);
        const Vec3 axis(0.3 * std::sin(x / 11.0), 0.2 * std::cos(y / 13.0), 1.0);
        add_pose(path,
                 {{x, y, 10.0 + 2.0 * std::sin(x / 8.0) * std::cos(y / 9.0)}, axis.normalized()});
      }
    }
    return path;
  }
};

// A wavy surface of 100 x 100 mm, ball milled in rows; as many points in a row as rows.
struct FreeformScene {
  static constexpr double kSize = 100.0;
  static constexpr double kRadius = 5.0;

  [[nodiscard]] static stock::Blank blank() {
    return *stock::Blank::make(stock::BoxShape{kSize, kSize, 20.0}, Vec3::Zero());
  }
  [[nodiscard]] static ToolPath path(int blocks) {
    const int rows = static_cast<int>(std::lround(std::sqrt(static_cast<double>(blocks))));
    ToolPath path;
    for (int row = 0; row < rows; ++row) {
      for (int i = 0; i <= rows; ++i) {
        const double x = kSize * ((row % 2 == 0 ? i : rows - i) / static_cast<double>(rows) - 0.5);
        const double y = kSize * ((row + 0.5) / rows - 0.5);
        const Vec3 contact(x, y, 10.0 + 2.0 * std::sin(x / 8.0) * std::cos(y / 9.0));
        const Vec3 normal = Vec3(-0.25 * std::cos(x / 8.0) * std::cos(y / 9.0),
                                 2.0 / 9.0 * std::sin(x / 8.0) * std::sin(y / 9.0), 1.0)
                                .normalized();
        add_pose(path, {contact + kRadius * normal - kRadius * Vec3::UnitZ(), Vec3::UnitZ()});
      }
    }
    return path;
  }
  [[nodiscard]] static stock::Workpiece cut(int blocks) {
    auto swept = cutter::SweptCutter::sweep(
        path(blocks), {{1, end_mill(cutter::CutterType::ball, 2 * kRadius, 40.0)}});
    return {blank(), *std::move(swept)};
  }
  [[nodiscard]] static Ray probe(std::uint64_t k) {
    const double x = 0.9 * kSize * (uniform({.seed = 2}, 2 * k) - 0.5);
    const double y = 0.9 * kSize * (uniform({.seed = 2}, 2 * k + 1) - 0.5);
    return {Vec3(x, y, 30.0), -Vec3::UnitZ()};
  }
};

}  // namespace frustum::bench
