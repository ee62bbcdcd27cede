#include "cutter/candidate_tree.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustum::cutter {
namespace {

// A float near 10 m has a spacing of 1e-3 mm; ray origin, direction and box each round once.
constexpr double kFloatMargin = 4e-3;  // mm

struct CollectingContext {
  RTCIntersectContext context;  // first member: Embree hands this pointer back
  std::vector<std::uint32_t>* found;
};

void box_bounds(const RTCBoundsFunctionArguments* args) {
  const Box& box = static_cast<const Box*>(args->geometryUserPtr)[args->primID];
  const auto down = [](double v) { return static_cast<float>(v - kFloatMargin); };
  const auto up = [](double v) { return static_cast<float>(v + kFloatMargin); };
  *args->bounds_o = {down(box.min.x()), down(box.min.y()), down(box.min.z()), 0.0F,
                     up(box.max.x()),   up(box.max.y()),   up(box.max.z()),   0.0F};
}

// Notes the primitive and never reports a hit, so that traversal visits every box on the way.
void collect(const RTCOccludedFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  reinterpret_cast<CollectingContext*>(args->context)->found->push_back(args->primID);
}

}  // namespace

struct CandidateTree::Scene {
  std::vector<Box> boxes;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  explicit Scene(std::vector<Box> all) : boxes(std::move(all)) {
    device = rtcNewDevice(nullptr);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
    rtcSetGeometryUserData(geometry, boxes.data());
    rtcSetGeometryBoundsFunction(
        geometry, [](const RTCBoundsFunctionArguments* args) { box_bounds(args); }, nullptr);
    rtcSetGeometryOccludedFunction(
        geometry, [](const RTCOccludedFunctionNArguments* args) { collect(args); });
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
};

CandidateTree::CandidateTree(std::vector<Box> boxes)
    : scene_(std::make_unique<Scene>(std::move(boxes))) {}
CandidateTree::~CandidateTree() = default;
CandidateTree::CandidateTree(CandidateTree&&) noexcept = default;
CandidateTree& CandidateTree::operator=(CandidateTree&&) noexcept = default;

std::vector<std::uint32_t> CandidateTree::candidates(const Ray& ray, RaySpan span) const {
  std::vector<std::uint32_t> found;
  if (scene_->boxes.empty()) return found;
  CollectingContext collecting{};
  rtcInitIntersectContext(&collecting.context);
  collecting.found = &found;
  // The ray starts at the span's beginning, which keeps the coordinates small.
  const Vec3 start = ray.at(span.lo);
  RTCRay probe{};
  probe.org_x = static_cast<float>(start.x());
  probe.org_y = static_cast<float>(start.y());
  probe.org_z = static_cast<float>(start.z());
  probe.dir_x = static_cast<float>(ray.direction.x());
  probe.dir_y = static_cast<float>(ray.direction.y());
  probe.dir_z = static_cast<float>(ray.direction.z());
  probe.tnear = 0.0F;
  probe.tfar = static_cast<float>(span.hi - span.lo + kFloatMargin);
  probe.mask = std::numeric_limits<unsigned>::max();
  rtcOccluded1(scene_->scene, &collecting.context, &probe);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace frustum::cutter
