// What makes a strategy impossible: fills in plan_check.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <type_traits>

#include "core/counted.hpp"
#include "metrology/fit/element.hpp"
#include "metrology/plan/plan_check.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

class StrategyCheck {
 public:
  StrategyCheck(const InspectionPlan& plan, std::size_t index, const PlanFault& fault)
      : feature_(plan.features[index]), index_(index), fault_(fault) {}

  void run() const {
    if (feature_.kind == FeatureKind::point) {
      if (feature_.strategy != single_touch()) wrong("a point is touched once");
      return;
    }
    if (!has_suitable_strategy()) {
      wrong(fmt::format("this strategy does not suit a {}", name_of(feature_.kind)),
            "plane: rings or grid; line: from, to, points; sphere: points of each circle, or "
            "sections; circle: sections; ruled: heights, from, to, points; others: sections, "
            "generatrices or turns");
      return;
    }
    std::visit([this](const auto& s) { counts(s); }, feature_.strategy);
  }

 private:
  void wrong(std::string message, std::string hint = {}) const {
    fault_(PlanPart::feature, index_, "strategy", std::move(message), std::move(hint));
  }

  [[nodiscard]] bool has_suitable_strategy() const {
    const auto is_one_of = [this]<typename... S>(std::type_identity<S>...) {
      return (std::holds_alternative<S>(feature_.strategy) || ...);
    };
    switch (feature_.kind) {
      case FeatureKind::plane:
        return is_one_of(std::type_identity<RingStrategy>{}, std::type_identity<GridStrategy>{});
      case FeatureKind::line:
        return is_one_of(std::type_identity<LineStrategy>{});
      case FeatureKind::sphere:
        return is_one_of(std::type_identity<SphereStrategy>{},
                         std::type_identity<SectionStrategy>{});
      case FeatureKind::ruled:
        return is_one_of(std::type_identity<SurfaceLineStrategy>{});
      case FeatureKind::point:
      case FeatureKind::circle:
        return is_one_of(std::type_identity<SectionStrategy>{});
      case FeatureKind::cylinder:
      case FeatureKind::cone:
        break;
    }
    return is_one_of(std::type_identity<SectionStrategy>{},
                     std::type_identity<GeneratrixStrategy>{},
                     std::type_identity<SpiralStrategy>{});
  }

  // A number of points or a pitch. `length`: of the longest run of points.
  template <typename S>
  void spacing(std::string_view points, int number, const S& s, double length) const {
    if (!std::isfinite(s.pitch) || s.pitch < 0.0) {
      wrong(fmt::format("pitch must be greater than 0, is {}", s.pitch));
    } else if (s.pitch > 0.0 && number != 0) {
      wrong(fmt::format("{} and pitch exclude each other", points));
    } else if (s.pitch > 0.0 && length > 1e6 * s.pitch) {
      wrong(fmt::format("a pitch of {} mm makes more than 1000000 points of {:.6g} mm", s.pitch,
                        length));
    }
  }

  // Both ends of generatrices and spirals.
  void ends(double from, double to) const {
    if (!std::isfinite(from) || !std::isfinite(to) || from == to) {
      wrong(fmt::format("from = {} and to = {} must be different heights", from, to));
    }
    on_surface(from);
    on_surface(to);
  }

  // A cone ends at its apex, a sphere at its poles.
  void on_surface(double along) const {
    if (feature_.kind == FeatureKind::sphere && !(std::abs(along) < feature_.radius)) {
      wrong(fmt::format("the section at {} mm is beyond the pole", along),
            "sections count from the centre toward the pole");
    }
    if (feature_.kind == FeatureKind::cone && !(section_radius(feature_, along) > 0.0)) {
      wrong(fmt::format("the section at {} mm is beyond the apex", along),
            "sections count from point toward growing radius");
    }
  }

  void sweep(double angle, int count, std::string_view what = "points on a circle") const {
    // A hair over a full turn is rounding in the file.
    if (!(std::abs(angle) > 0.0) || std::abs(angle) > 2.0 * std::numbers::pi + 1e-9) {
      wrong(fmt::format("sweep must be within one turn, is {:.6g} deg", angle * kDegPerRad));
    }
    if (count < 3) wrong(fmt::format("at least 3 {}, planned are {}", what, count));
  }

  void counts(const SectionStrategy& s) const {
    sweep(s.sweep, s.pitch > 0.0 ? 3 : s.points_per_section);
    const std::size_t least = feature_.kind == FeatureKind::circle ? 1 : 2;
    const bool distinct =
        std::set<double>(s.sections.begin(), s.sections.end()).size() == s.sections.size();
    if (s.sections.size() < least || !distinct) {
      wrong(fmt::format("a {} needs {} or more different sections, planned are {}",
                        name_of(feature_.kind), least, s.sections.size()));
    }
    double longest = 0.0;
    for (const double along : s.sections) {
      on_surface(along);
      longest = std::max(longest, std::abs(s.sweep) * section_radius(feature_, along));
    }
    spacing("points_per_section", s.points_per_section, s, longest);
  }
  void counts(const RingStrategy& s) const {
    sweep(s.sweep, s.pitch > 0.0 ? 3 : s.points_per_ring);
    if (s.rings.empty() ||
        std::any_of(s.rings.begin(), s.rings.end(), [](double r) { return !(r > 0.0); })) {
      wrong("rings must be one or more radii greater than 0");
      return;
    }
    spacing("points_per_ring", s.points_per_ring, s,
            std::abs(s.sweep) * *std::max_element(s.rings.begin(), s.rings.end()));
  }
  void counts(const GridStrategy& s) const {
    if ((s.pitch == 0.0 && s.columns < 2) || s.rows < 2) {
      wrong(fmt::format("a grid needs 2 columns and 2 rows or more, planned are {} and {}",
                        s.columns, s.rows));
    }
    if (const auto fault = fault_of_sides(feature_, s.u, s.v)) {
      wrong(fault->first, fault->second);
    }
    spacing("columns", s.columns, s, s.u.norm());
  }
  void counts(const LineStrategy& s) const {
    if ((s.pitch == 0.0 && s.points < 2) || s.from == s.to) {
      wrong("a line needs 2 or more points at different places");
    }
    spacing("points", s.points, s, std::abs(s.to - s.from));
  }
  void counts(const GeneratrixStrategy& s) const {
    sweep(s.sweep, s.generatrices, "generatrices");
    ends(s.from, s.to);
    if (s.pitch == 0.0 && s.points < 2) {
      wrong(fmt::format("at least 2 points on a line, planned are {}", s.points));
    }
    spacing("points", s.points, s, std::abs(s.to - s.from));
  }
  void counts(const SpiralStrategy& s) const {
    ends(s.from, s.to);
    if (!(std::abs(s.turns) >= 1.0 && std::abs(s.turns) <= 1e6)) {
      wrong(fmt::format("a spiral takes one turn or more, planned are {}", s.turns));
    } else if (s.pitch == 0.0 && s.points < 8) {
      wrong(fmt::format("at least 8 points on a spiral, planned are {}", s.points));
    }
    spacing("points", s.points, s, spiral_length(feature_, s));
  }
  void counts(const SphereStrategy& s) const {
    std::int64_t all = 0;
    bool positive = true;
    for (const int points : s.points) {
      positive = positive && points > 0;
      all += std::max(points, 0);
    }
    if (!positive || s.points.size() < 2 || s.points.size() > 1000 || all < 5) {
      wrong(fmt::format(
          "a sphere needs 2 or more circles with 5 or more points in all, "
          "planned are {} with {}",
          counted(s.points.size(), "circle"), counted(static_cast<std::size_t>(all), "point")));
    }
    const auto lies_on_sphere = [](double polar) {
      return polar >= 0.0 && polar <= std::numbers::pi;
    };
    if (!lies_on_sphere(s.polar_from) || !lies_on_sphere(s.polar_to) ||
        s.polar_from == s.polar_to) {
      wrong(
          fmt::format("polar_from = {:.6g} deg and polar_to = {:.6g} deg must be different "
                      "angles from 0 to 180 deg",
                      s.polar_from * kDegPerRad, s.polar_to * kDegPerRad));
    }
    if (!std::isfinite(s.start_angle) || !std::isfinite(s.twist)) {
      wrong("start_angle and twist must be finite");
    }
  }

  void counts(const SurfaceLineStrategy& s) const {
    const auto is_share = [](double share) { return share >= 0.0 && share <= 1.0; };
    if (s.heights.empty() || !std::ranges::all_of(s.heights, is_share)) {
      wrong("heights must be one or more shares of the height, from 0 to 1");
    }
    if (!is_share(s.from) || !is_share(s.to) || !(s.from < s.to)) {
      wrong(fmt::format("from = {} must be less than to = {}, both from 0 to 1", s.from, s.to));
    }
    if (s.points < 2) wrong(fmt::format("at least 2 points on a line, planned are {}", s.points));
    const std::size_t all = s.heights.size() * static_cast<std::size_t>(std::max(s.points, 0));
    if (!s.geometric.empty() && s.geometric.size() != all) {
      wrong(fmt::format("geometric_um has {} for {}", counted(s.geometric.size(), "value"),
                        counted(all, "point")));
    }
  }

  const PlannedFeature& feature_;
  std::size_t index_;
  const PlanFault& fault_;
};

}  // namespace

std::optional<std::pair<std::string, std::string>> fault_of_sides(const PlannedFeature& feature,
                                                                  const Vec3& u, const Vec3& v) {
  if (!UnitVec3::of(u.cross(v))) return std::pair{"u and v must span an area", ""};
  const UnitVec3 axis = unit(feature.axis);
  for (const Vec3& side : {u, v}) {
    // 1e-6 of the sides, the last um over a metre: what points are planned off the plane would be a
    // systematic error.
    if (std::abs(side.dot(axis.vec())) > 1e-6 * side.norm()) {
      return std::pair{"u and v must be in the plane", "make both perpendicular to axis"};
    }
  }
  return std::nullopt;
}

void check_strategy(const InspectionPlan& plan, std::size_t index, const PlanFault& fault) {
  StrategyCheck(plan, index, fault).run();
}

}  // namespace frustum::metrology
