#include "cutter/search/quad_crossing.hpp"

#include "core/box.hpp"

namespace frustum::cutter {
namespace {

template <class Lanes>
FRUSTUM_OF_LANES void cross(const GroupQuad& groups, std::size_t from, const Vec3& origin,
                            const Vec3& inverse, const RaySpan& span, QuadSpan& in) {
  Lanes lo = lanes_of<Lanes>(span.lo), hi = lanes_of<Lanes>(span.hi);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto d = static_cast<Eigen::Index>(k);
    const Lanes a =
        (lanes_of<Lanes>(groups.box_min[k], from) - (origin[d] + BoxCrossing::kMargin)) *
        inverse[d];
    const Lanes b =
        (lanes_of<Lanes>(groups.box_max[k], from) - (origin[d] - BoxCrossing::kMargin)) *
        inverse[d];
    lo = larger(lo, smaller(a, b));
    hi = smaller(hi, larger(a, b));
  }
  store(lo, from, in.lo);
  store(hi, from, in.hi);
}

#ifdef FRUSTUM_HAS_FOUR_LANES
FRUSTUM_FOUR_LANES void cross_four(const GroupQuad& groups, const Vec3& origin, const Vec3& inverse,
                                   const RaySpan& span, QuadSpan& in) {
  cross<Four>(groups, 0, origin, inverse, span, in);
}
#endif

}  // namespace

QuadCrossing::QuadCrossing(const Ray& ray) : origin_(ray.origin) {
  for (int k = 0; k < 3; ++k) inverse_[k] = BoxCrossing::inverse_of(ray.direction[k]);
}

QuadSpan QuadCrossing::within(const GroupQuad& groups, const RaySpan& span,
                              [[maybe_unused]] LaneChoice lanes) const {
  QuadSpan in;
#ifdef FRUSTUM_HAS_FOUR_LANES
  if (has_four_lanes(lanes)) {
    cross_four(groups, origin_, inverse_, span, in);
    return in;
  }
#endif
  cross<Both>(groups, 0, origin_, inverse_, span, in);
  cross<Both>(groups, 2, origin_, inverse_, span, in);
  return in;
}

}  // namespace frustum::cutter
