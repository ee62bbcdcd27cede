#include "report/picture/surface_rays.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace frustum::report {
namespace {

constexpr std::size_t kPacket = 8;

// A buffer of a geometry, filled from `values`.
template <typename T>
void fill_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                 std::span<const T> values) {
  void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
  if (buffer == nullptr) throw std::bad_alloc();
  std::memcpy(buffer, values.data(), values.size_bytes());
}

}  // namespace

struct SurfaceRays::Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

SurfaceRays::SurfaceRays(std::span<const Eigen::Vector3f> vertices,
                         std::span<const std::array<std::uint32_t, 3>> triangles)
    : scene_(std::make_unique<Scene>()) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  nearest_ = vertices.front().z();
  for (const Eigen::Vector3f& vertex : vertices) nearest_ = std::max(nearest_, vertex.z());
  scene_->device = rtcNewDevice(nullptr);
  if (scene_->device == nullptr) throw std::bad_alloc();
  scene_->scene = rtcNewScene(scene_->device);
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  fill_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
  fill_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_->scene);
  if (rtcGetDeviceError(scene_->device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

SurfaceRays::~SurfaceRays() = default;

void SurfaceRays::see_row(float from_x, float step, float y, std::span<Seen> row) const {
  const float front = nearest_ + 1.0F;
  for (std::size_t first = 0; first < row.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, row.size() - first);
    alignas(32) std::array<int, kPacket> valid{};
    RTCRayHit8 packet{};
    for (std::size_t k = 0; k < kPacket; ++k) {
      valid[k] = k < count ? -1 : 0;
      packet.ray.org_x[k] = from_x + static_cast<float>(first + k) * step;
      packet.ray.org_y[k] = y;
      packet.ray.org_z[k] = front;
      packet.ray.dir_z[k] = -1.0F;
      packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
      packet.ray.mask[k] = ~0U;
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid.data(), scene_->scene, &context, &packet);
    for (std::size_t k = 0; k < count; ++k) {
      if (packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) {
        row[first + k] = Seen{};
      } else {
        row[first + k] = {front - packet.ray.tfar[k], packet.hit.primID[k], packet.hit.u[k],
                          packet.hit.v[k]};
      }
    }
  }
}

bool SurfaceRays::is_hidden(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                            float reach) const {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = reach;
  ray.mask = ~0U;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

}  // namespace frustum::report
