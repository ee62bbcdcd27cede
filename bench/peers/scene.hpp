// A cut as every program of the comparison is given it: blank, path, cutter.
//
// Units: mm, rad; frame: workpiece, the meridian in the tool's. Errors: none.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/cut_scenes.hpp"
#include "tests/cutter/standing_cutters.hpp"

namespace frustum::bench {

struct PeerScene {
  std::string name{};
  kinematics::ToolPath path{};
  stock::Blank blank;
  std::map<int, cutter::Cutter> tools{};
  // Of the cutter, written down a second time for the oracle.
  proof::Meridian meridian{};
  double radius = 0.0;
  double height = 0.0;
  bool is_ball = false;
  Ray (*probe)(std::uint64_t k) = nullptr;  // a touch of the cut surface, for speed
  // Points of sharp edges that the cutter alone makes; may be off the true edge by 0.1 um.
  std::vector<Vec3> inner_edges{};

  [[nodiscard]] stock::Workpiece cut() const {
    return {blank, *cutter::SweptCutter::sweep(path, tools)};
  }
};

inline PeerScene cone_scene(int blocks) {
  constexpr double kFlutes = 50.0;
  PeerScene scene{.name = "cone", .path = ConeScene::path(blocks), .blank = ConeScene::blank()};
  scene.tools.emplace(1, end_mill(cutter::CutterType::flat, 2 * ConeScene::kRadius, kFlutes));
  scene.meridian.line_to(ConeScene::kRadius, 0).line_to(ConeScene::kRadius, kFlutes);
  scene.radius = ConeScene::kRadius;
  scene.height = kFlutes;
  scene.probe = ConeScene::probe;
  // The foot of the flank, where the corner of the cutter goes.
  for (const kinematics::ToolPose& pose : scene.path.poses) {
    const Vec3 along = Vec3::UnitZ().cross(pose.tip).normalized();
    scene.inner_edges.push_back(pose.tip + ConeScene::kRadius * pose.axis.cross(along));
  }
  return scene;
}

inline PeerScene freeform_scene(int blocks) {
  constexpr double kFlutes = 40.0;
  constexpr double kRadius = FreeformScene::kRadius;
  PeerScene scene{
      .name = "freeform", .path = FreeformScene::path(blocks), .blank = FreeformScene::blank()};
  scene.tools.emplace(1, end_mill(cutter::CutterType::ball, 2 * kRadius, kFlutes));
  scene.meridian.arc_to(kRadius, kRadius, 0, kRadius).line_to(kRadius, kFlutes);
  scene.radius = kRadius;
  scene.height = kFlutes;
  scene.is_ball = true;
  scene.probe = FreeformScene::probe;
  return scene;
}

}  // namespace frustum::bench
