#include <array>

#include "metrology/fit/least_squares.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

constexpr Wording kWording{"cylinder",
                           "probe at two or more heights and around more of the circumference"};

// A given radius leaves the centre on the side to which the points bend, or on the other when they
// hardly bend.
std::vector<Element> starts_on(const std::vector<AxisCandidate>& candidates,
                               const Constraints& keep) {
  std::vector<Element> starts;
  for (const AxisCandidate& c : candidates) {
    const double ratio = keep.radius && c.radius > 0.0 ? *keep.radius / c.radius : 1.0;
    const auto start = [&](double factor) {
      const Element free = Cylinder{factor * c.point, unit(c.axis), c.radius};
      starts.push_back(constrained(free, keep));
    };
    start(ratio);
    if (keep.radius) start(-ratio);
  }
  return starts;
}

}  // namespace

Result<Fit<Cylinder>> fit_cylinder(std::span<const Vec3> points, const FitOptions& options) {
  auto local = normalise(points, {ElementKind::cylinder, kWording.what, 5}, options);
  if (!local) return std::move(local).error();
  const PrincipalDirections principal = principal_directions(*local);
  if (auto flat = coplanar(*local, principal, kWording.what)) return *flat;
  const PointBlocks all = PointBlocks::of(*local);
  const AxisSearch search(thinned(*local, kSearched), principal);
  const auto likeliest = starts_on(search.likeliest(RoundKind::cylinder), local->constraints);
  auto direct = at_once(likeliest, *local, all, principal.spread[2]);
  auto found = direct
                   ? settled(std::move(*direct), all, local->constraints, kWording)
                   : best_minimum(starts_on(search.candidates(RoundKind::cylinder, kAxisCandidates),
                                            local->constraints),
                                  *local, all, kWording);
  if (!found) return std::move(found).error();
  const auto& best = std::get<Cylinder>(found->element);
  constexpr std::array kIsAngle{false, false, true, true, false};
  return completed(*local, Cylinder{local->back(best.point), best.axis, best.radius * local->scale},
                   {found->residuals, found->cofactor, kIsAngle, redundancy(*local, *found),
                    found->iterations, found->condition});
}

}  // namespace frustum::metrology
