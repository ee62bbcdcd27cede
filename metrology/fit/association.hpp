// Association: the ideal element that represents measured points, by any criterion and under
//              constraints.
//
// Model    : of all elements of a kind that keep the constraints, the one that
//              least_squares          makes sum w_i d_i^2 least
//              minimum_zone makes max d - min d least (plane, circle, sphere, cylinder, cone,
//                                     torus), or max |d| of a line in space (its zone is a
//                                     cylinder)
//              maximum_inscribed is the largest that no point is within (circle, sphere, cylinder)
//              minimum_circumscribed  is the smallest that no point is outside of (the same kinds)
//              outside_material touches the points from outside the material and makes the farthest
//                                     distance least (plane, line in a plane); of round kinds the
//                                     circumscribed boss or the inscribed hole
//            d as residual() of element.hpp
// Units    : mm, rad; all points in one frame
// Shape    : n points; weights one a point or none
// Errors   : a criterion that the kind does not have, constraints that it cannot keep, too few
//            points, not finite, degenerate, not converged
// Accuracy : 1e-9 mm; what is minimal is certified by its contacts (Certificate)
// Source   : ISO 1101:2017 (C, G, X, N, T), ISO 5459; optimality as in Anthony et al. 1996
//            (reference software for minimum zones)
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/fit/least_squares.hpp"

namespace frustum::metrology {

enum class Criterion {
  least_squares,
  minimum_zone,
  maximum_inscribed,
  minimum_circumscribed,
  outside_material
};
// "ls", "mz", "mi", "mc", "om": what users type.
inline constexpr std::array<std::string_view, 5> kCriterionNames{"ls", "mz", "mi", "mc", "om"};
[[nodiscard]] std::string_view name_of(Criterion criterion);
[[nodiscard]] std::optional<Criterion> criterion_named(std::string_view name);

struct AssociationOptions {
  Criterion criterion = Criterion::least_squares;
  Constraints constraints{};
  std::vector<double> weights{};  // of the squares; least squares only; empty: all 1
  // outside_material: the direction out of the material of a plane or of a line in a plane.
  std::optional<Vec3> outward{};
  bool is_hole = false;  // outside_material of round kinds: material around, not within
};

// Proof that no element near this one is better: at the best one the gradients of the contacts
// balance.
struct Contact {
  std::size_t point = 0;
  double multiplier = 0.0;  // positive; those of one side of the zone add up to 1
  bool is_high = false;     // on the side of positive residuals
};
struct Certificate {
  std::vector<Contact> contacts{};
  // Length of what is left of the balance, of gradients of order one in a frame of the size of the
  // part.
  double imbalance = 0.0;
  // mm: how much better any element near this one could be at most, by the balance and by what the
  // contacts differ in their distances.
  double gap = 0.0;
};

struct Association {
  Fit<Element> fit{};
  Criterion criterion = Criterion::least_squares;
  std::optional<Certificate> certificate{};  // all criteria but least squares
};

[[nodiscard]] Result<Association> associate(ElementKind kind, std::span<const Vec3> points,
                                            const AssociationOptions& options = {});
// By the name a user types: those of kElementNames, "circle2d" and "line2d", which are in a
// coordinate plane.
[[nodiscard]] Result<Association> associate(std::string_view name, std::span<const Vec3> points,
                                            const AssociationOptions& options = {});

}  // namespace frustum::metrology
