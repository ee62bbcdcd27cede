// A peer on the same cut: Manifold's batch boolean of hulled cutters, time and worst surface error
// beside ours. Built where Manifold is installed.
#include <manifold/manifold.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "bench/cut_scenes.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace {

using namespace frustum;
using bench::ConeScene;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The hull of the polygonal cutter at both ends of every block.
std::vector<manifold::Manifold> hulls(const kinematics::ToolPath& path, int facets) {
  const auto add_ring = [&](std::vector<manifold::vec3>& points, const kinematics::ToolPose& pose,
                            double z) {
    const Vec3 e1 = Vec3::UnitZ().cross(pose.tip).normalized();
    const Vec3 e2 = pose.axis.cross(e1);
    for (int j = 0; j < facets; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / facets;
      const Vec3 p = pose.tip + z * pose.axis +
                     ConeScene::kRadius * (std::cos(angle) * e1 + std::sin(angle) * e2);
      points.emplace_back(p.x(), p.y(), p.z());
    }
  };
  std::vector<manifold::Manifold> all;
  for (const kinematics::PathSegment& segment : path.segments) {
    std::vector<manifold::vec3> points;
    for (const kinematics::ToolPose& pose : {path.from(segment), path.to(segment)}) {
      add_ring(points, pose, 0.0);
      add_ring(points, pose, 50.0);
    }
    all.push_back(manifold::Manifold::Hull(points));
  }
  return all;
}

// Of the mesh's vertices on the flank, the farthest from the cone.
double worst_on_flank(const std::vector<Vec3>& vertices) {
  double worst = 0.0;
  for (const Vec3& v : vertices) {
    const double off =
        (std::hypot(v.x(), v.y()) - ConeScene::kGround + v.z() * std::tan(ConeScene::kHalfAngle)) *
        std::cos(ConeScene::kHalfAngle);
    if (v.z() > 5.0 && v.z() < 35.0 && std::abs(off) < 0.5) worst = std::max(worst, std::abs(off));
  }
  return worst;
}

void theirs(int blocks, int facets) {
  const kinematics::ToolPath path = ConeScene::path(blocks);
  const auto start = Clock::now();
  std::vector<manifold::Manifold> operands = {
      manifold::Manifold::Cube({120, 120, ConeScene::kHeight}, true)
          .Translate({0, 0, ConeScene::kHeight / 2})};
  for (manifold::Manifold& hull : hulls(path, facets)) operands.push_back(std::move(hull));
  const manifold::MeshGL64 mesh =
      manifold::Manifold::BatchBoolean(operands, manifold::OpType::Subtract).GetMeshGL64();
  const double time = seconds_since(start);
  std::vector<Vec3> vertices;
  for (std::size_t i = 0; i + 2 < mesh.vertProperties.size(); i += mesh.numProp) {
    vertices.emplace_back(mesh.vertProperties[i], mesh.vertProperties[i + 1],
                          mesh.vertProperties[i + 2]);
  }
  std::printf("manifold, %5d blocks, %3d facets: %8.3f s, worst on the flank %9.3f um\n", blocks,
              facets, time, worst_on_flank(vertices) * 1e3);
}

void ours(int blocks) {
  const auto start = Clock::now();
  const stock::Workpiece part = ConeScene::cut(blocks);
  const double ready = seconds_since(start);
  const auto mesh = stock::extract_surface(part, part.blank().bounds(), Mm{0.5});
  std::printf("frustum,  %5d blocks, ready %6.3f s: %8.3f s, worst on the flank %9.3f um\n", blocks,
              ready, seconds_since(start), worst_on_flank(mesh->vertices) * 1e3);
}

}  // namespace

int main(int count, char** words) {
  const int most = count > 1 ? std::atoi(words[1]) : 7200;
  for (int blocks = 72; blocks <= most; blocks *= 10) {
    for (const int facets : {32, 128}) theirs(blocks, facets);
    ours(blocks);
  }
  return 0;
}
