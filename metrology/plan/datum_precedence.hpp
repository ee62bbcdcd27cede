// Which degrees of freedom each datum of a system takes, in order of precedence, and where that
// sets the system.
//
// Model    : as datum_system.hpp says. Planned directions alone decide what a datum takes
// Units    : mm, rad
// Shape    : datums are added in order; each as planned and as measured
// Errors   : none
// Accuracy : rounding of doubles (tests/metrology/datum_system_test.cpp)
// Source   : ISO 5459 (order of precedence, situation features)
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "metrology/fit/constraints.hpp"
#include "metrology/fit/element.hpp"
#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

struct FoundDatum {
  Pose workpiece_from_datum{};
  std::vector<DatumShare> datums{};
  std::vector<std::string> free_degrees{};
};

// One datum, planned and measured.
struct Datum {
  const PlannedFeature* planned = nullptr;
  Element measured{};
};

// Names each degree after the axis of the workpiece that is nearest, each axis once.
class DegreeNames {
 public:
  void take(DatumShare& share, bool rotation, const Vec3& axis);
  [[nodiscard]] std::vector<std::string> left() const;

 private:
  std::array<bool, 6> taken_{};
};

class DatumPrecedence {
 public:
  // Of features_of the system, none of which has taken anything.
  explicit DatumPrecedence(const DatumSystem& system);

  void add(const Datum& datum, std::size_t index);

  // The constraint that an element at this point in the order has to keep (ISO 5459); planned
  // directions that are neither along nor across the first leave it free.
  [[nodiscard]] Constraints constraints(const PlannedFeature& planned) const;

  [[nodiscard]] FoundDatum found();

 private:
  // A direction or a place, planned and measured.
  struct Pair {
    Vec3 planned = Vec3::Zero();
    Vec3 measured = Vec3::Zero();
  };
  struct Held {
    Vec3 direction = Vec3::Zero();  // measured, unit, across those before
    double value = 0.0;             // of the translation along it
  };

  void turn(std::size_t index, const Pair& direction);
  [[nodiscard]] Mat3 rotation() const;
  [[nodiscard]] Pair place_of(const Datum& datum) const;
  [[nodiscard]] std::array<Vec3, 2> across_first(const Vec3& axis, const Vec3& u,
                                                 const Vec3& v) const;
  void hold(const Datum& datum, std::size_t index, const Pose& pose);
  void hold(std::size_t index, const Vec3& direction, const Pair& place, const Pose& pose);

  std::vector<DatumShare> shares_;
  std::vector<std::pair<Datum, std::size_t>> datums_{};
  std::optional<Pair> first_{};   // directions, unit
  std::optional<Pair> second_{};  // across the first
  std::optional<Pair> first_place_{};
  std::vector<Held> held_{};
  DegreeNames names_{};
};

// Its features, in order.
[[nodiscard]] std::vector<std::string> features_of(const DatumSystem& system);

// What each datum takes of a perfect part: in the order of features_of.
[[nodiscard]] std::vector<DatumShare> planned_shares(const InspectionPlan& plan,
                                                     const DatumSystem& system);

}  // namespace frustum::metrology
