#include "stock/solid/box_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>
#include <vector>

namespace frustum::stock {
namespace {

// How much larger every box is for Embree, in scaled units; the header says why.
constexpr double kEnlargement = 0x1p-17;
// Of a ball's radius and of a point's place: relative rounding of squared distances in single
// precision, and the rounding of the place itself.
constexpr double kBallShare = 0x1p-20;
// The ball around [-1, 1]^3, and a little.
constexpr double kBall = 1.75;
// Rounding of a point of a ray in double precision: relative to its distance from the origin.
constexpr double kDoubleShare = 0x1p-48;
constexpr double kFarthest = kEnlargement / 8.0 / kDoubleShare;  // scaled: 2^28

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using OwnedDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using OwnedScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

float upward(double value) {
  constexpr double kBeyondAll = 1e30;  // of scaled boxes
  return std::nextafter(static_cast<float>(std::clamp(value, -kBeyondAll, kBeyondAll)),
                        std::numeric_limits<float>::infinity());
}

}  // namespace

class BoxScene::Scene {
 public:
  explicit Scene(std::span<const Box> boxes) : count_(static_cast<std::uint32_t>(boxes.size())) {
    Box all = boxes.front();
    for (const Box& box : boxes) all = united(all, box);
    centre_ = 0.5 * (all.min + all.max);
    const double half = (all.max - centre_).cwiseMax(centre_ - all.min).maxCoeff();
    int exponent = 0;
    if (half > 0.0 && std::isfinite(half)) (void)std::frexp(half, &exponent);
    scale_ = std::ldexp(1.0, -exponent);
    // Far from the frame's origin, centres and corners themselves are rounded.
    is_coarse_ = !(centre_.cwiseAbs().maxCoeff() * scale_ < kFarthest);
    if (is_coarse_) return;
    device_.reset(rtcNewDevice(nullptr));
    if (!device_) throw std::bad_alloc();
    scene_.reset(rtcNewScene(device_.get()));
    if (!scene_) throw std::bad_alloc();
    boxes_ = boxes;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, count_);
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, &bounds_of, nullptr);
    rtcSetGeometryIntersectFunction(geometry, &meet);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
    boxes_ = {};
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void walk_ray(const Ray& ray, const RaySpan& span, Visitor visitor, void* visit) const {
    const double nearest = (centre_ - ray.origin).dot(ray.direction);
    const double far_away = (centre_ - ray.origin).cwiseAbs().maxCoeff() * scale_;
    if (is_coarse_ || !(far_away < kFarthest)) return visit_all(visitor, visit);
    // About the centre, in scaled units: cut down to the ball, a little longer than asked for.
    const Vec3 foot = scale_ * (ray.at(nearest) - centre_);
    if (foot.squaredNorm() > kBall * kBall) return;
    const double from = std::max((span.lo - nearest) * scale_ - kEnlargement, -kBall);
    const double to = std::min((span.hi - nearest) * scale_ + kEnlargement, kBall);
    if (!(from <= to)) return;
    const Vec3 start = foot + from * ray.direction;
    RayWalk walk{{}, visitor, visit, nearest + from / scale_, scale_};
    rtcInitIntersectContext(&walk.context);
    RTCRayHit rayhit{};
    rayhit.ray.org_x = static_cast<float>(start.x());
    rayhit.ray.org_y = static_cast<float>(start.y());
    rayhit.ray.org_z = static_cast<float>(start.z());
    rayhit.ray.dir_x = static_cast<float>(ray.direction.x());
    rayhit.ray.dir_y = static_cast<float>(ray.direction.y());
    rayhit.ray.dir_z = static_cast<float>(ray.direction.z());
    rayhit.ray.tnear = 0.0F;
    rayhit.ray.tfar = upward(to - from + kEnlargement);
    rayhit.ray.mask = ~0U;
    rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &walk.context, &rayhit);
  }

  void walk_ball(const Vec3& point, double distance, Visitor visitor, void* visit) const {
    const Vec3 place = scale_ * (point - centre_);
    const double far_away = place.cwiseAbs().maxCoeff();
    if (is_coarse_ || !(far_away < kFarthest)) return visit_all(visitor, visit);
    BallWalk walk{visitor, visit, scale_, kEnlargement + kBallShare * far_away};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query;
    query.x = static_cast<float>(place.x());
    query.y = static_cast<float>(place.y());
    query.z = static_cast<float>(place.z());
    query.time = 0.0F;
    query.radius = walk.radius_of(distance);
    rtcPointQuery(scene_.get(), &query, &context, &come_near, &walk);
  }

 private:
  // What Embree hands back to the functions below: its context first.
  struct RayWalk {
    RTCIntersectContext context;
    Visitor visitor;
    void* visit;
    double start;  // where along the ray Embree's ray begins (mm)
    double scale;

    [[nodiscard]] float parameter_of(double along) const {
      return upward((along - start) * scale + kEnlargement);
    }
  };
  struct BallWalk {
    Visitor visitor;
    void* visit;
    double scale;
    double spare;

    [[nodiscard]] float radius_of(double distance) const {
      return upward(distance * scale * (1.0 + kBallShare) + spare);
    }
  };

  static void bounds_of(const RTCBoundsFunctionArguments* args) {
    const auto& scene = *static_cast<const Scene*>(args->geometryUserPtr);
    const Box& box = scene.boxes_[args->primID];
    const Vec3 min = scene.scale_ * (box.min - scene.centre_) - Vec3::Constant(kEnlargement);
    const Vec3 max = scene.scale_ * (box.max - scene.centre_) + Vec3::Constant(kEnlargement);
    RTCBounds& bounds = *args->bounds_o;
    bounds.lower_x = static_cast<float>(min.x());
    bounds.lower_y = static_cast<float>(min.y());
    bounds.lower_z = static_cast<float>(min.z());
    bounds.upper_x = static_cast<float>(max.x());
    bounds.upper_y = static_cast<float>(max.y());
    bounds.upper_z = static_cast<float>(max.z());
  }

  static void meet(const RTCIntersectFunctionNArguments* args) {
    assert(args->N == 1);
    if (args->valid[0] == 0) return;
    auto& walk = *reinterpret_cast<RayWalk*>(args->context);
    float& far_end = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar;
    far_end = std::min(far_end, walk.parameter_of(walk.visitor(walk.visit, args->primID)));
  }

  static bool come_near(RTCPointQueryFunctionArguments* args) {
    auto& walk = *static_cast<BallWalk*>(args->userPtr);
    const float radius = walk.radius_of(walk.visitor(walk.visit, args->primID));
    if (!(radius < args->query->radius)) return false;
    args->query->radius = radius;
    return true;
  }

  void visit_all(Visitor visitor, void* visit) const {
    for (std::uint32_t k = 0; k < count_; ++k) (void)visitor(visit, k);
  }

  std::uint32_t count_;
  Vec3 centre_ = Vec3::Zero();
  double scale_ = 1.0;  // scaled units a mm
  bool is_coarse_ = false;
  std::span<const Box> boxes_{};  // while the hierarchy is built
  OwnedDevice device_{};
  OwnedScene scene_{};
};

BoxScene::BoxScene(std::span<const Box> boxes) {
  if (!boxes.empty()) scene_ = std::make_shared<const Scene>(boxes);
}

void BoxScene::walk_ray(const Ray& ray, const RaySpan& span, Visitor visitor, void* visit) const {
  if (scene_) scene_->walk_ray(ray, span, visitor, visit);
}

void BoxScene::walk_ball(const Vec3& point, double distance, Visitor visitor, void* visit) const {
  if (scene_) scene_->walk_ball(point, distance, visitor, visit);
}

}  // namespace frustum::stock
