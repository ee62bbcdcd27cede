// An element in the frame in which a minimax solver moves it, and back.
//
// Model    : the frame's z axis is the element's, its origin the element's point; a line in a plane
//            has the plane's normal as y and its own normal as z. A constraint removes the steps
//            that would break it: the frame is turned so that a fixed direction is z, or a
//            direction to stay perpendicular to is y
// Units    : local frame of normalised_points.hpp, rad
// Shape    : the kinds of element.hpp, "circle2d" and "line2d"
// Errors   : none; an element of a name of another kind is a broken invariant
// Accuracy : rounding of doubles
// Source   : ours
#pragma once

#include <string_view>
#include <vector>

#include "metrology/fit/association.hpp"
#include "metrology/fit/minimax/minimax.hpp"
#include "metrology/fit/normalised_points.hpp"

namespace frustum::metrology {

struct ExtremeKind {
  std::string_view name;
  Surface surface = Surface::straight;
  std::vector<int> free;  // parameters of minimax_surface.hpp
  bool has_size = false;  // can be inscribed and circumscribed
  bool has_sides = true;  // distances have a sign
};
// Nothing for a name that is none.
[[nodiscard]] const ExtremeKind* extreme_kind(std::string_view name);

struct PlacedElement {
  Pose local_from_frame;
  SurfaceParameters at = SurfaceParameters::Zero();
};

// `across` is the direction that becomes y as nearly as the element's axis allows.
[[nodiscard]] PlacedElement placed(const ExtremeKind& kind, const Element& local,
                                   const Vec3& across);
[[nodiscard]] Element element_at(const ExtremeKind& kind, const PlacedElement& placed);

[[nodiscard]] Element to_local(const NormalisedPoints& local, const Element& element);

}  // namespace frustum::metrology
