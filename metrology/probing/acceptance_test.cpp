#include "metrology/probing/acceptance_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.hpp"
#include "metrology/fit/least_squares.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/probing/ball_contact.hpp"
#include "metrology/probing/cmm_errors.hpp"

namespace frustum::metrology {
namespace {

constexpr int kLengths = 5;
constexpr int kRepetitions = 3;
constexpr double kLongest = 0.9;  // of the volume along a direction; the standard asks for 0.66
constexpr double kBallDiameter = 3.0;       // mm
constexpr double kSphereRadius = 12.5;      // mm
constexpr std::size_t kSphereGroup = 1000;  // indices of its points apart from those of the lengths

// Material between two parallel planes.
struct GaugeBlock {
  Vec3 end;
  UnitVec3 along;  // from `end` into the block
  double length;

  [[nodiscard]] std::optional<Touch> touch(const Vec3& start, const UnitVec3& direction,
                                           double length_mm) const {
    const double place = (start - end).dot(along.vec());
    const double speed = direction.vec().dot(along.vec());
    const bool from_below = place < 0.0 && speed > 0.0;
    const bool from_above = place > length && speed < 0.0;
    if (!from_below && !from_above) return std::nullopt;
    const double way = ((from_below ? 0.0 : length) - place) / speed;
    if (way > length_mm) return std::nullopt;
    return Touch{start + way * direction.vec(), from_below ? -along.vec() : along.vec()};
  }
};

struct Ball {
  Vec3 centre;
  double radius;

  [[nodiscard]] std::optional<Touch> touch(const Vec3& start, const UnitVec3& direction,
                                           double length_mm) const {
    const Vec3 from = start - centre;
    const double closest = -from.dot(direction.vec());
    const double half_chord = radius * radius - (from + closest * direction.vec()).squaredNorm();
    if (from.norm() <= radius || half_chord < 0.0) return std::nullopt;
    const double way = closest - std::sqrt(half_chord);
    if (way < 0.0 || way > length_mm) return std::nullopt;
    const Vec3 point = start + way * direction.vec();
    return Touch{point, (point - centre).normalized()};
  }
};

// The surface point that the machine makes of one touch.
Vec3 touched(const CmmErrors& errors, const SurfaceProbeRef& part, const Vec3& target,
             const UnitVec3& outward, std::uint64_t index) {
  const double radius = 0.5 * kBallDiameter;
  const BallContact contact =
      touch_with_ball(part, {.target = target, .outward = outward, .ball_radius = radius});
  const Vec3 centre =
      errors.measured({.centre = contact.centre, .outward = outward, .index = index});
  return centre - errors.ball_radius(radius) * outward.vec();
}

// Of the volume: its four space diagonals and its axes, from end to end.
std::array<Vec3, 7> measuring_lines(const Vec3& travel) {
  constexpr std::array<std::array<double, 3>, 7> kWays{
      {{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<Vec3, 7> lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i] = travel.cwiseProduct(Vec3(kWays[i][0], kWays[i][1], kWays[i][2]));
  }
  return lines;
}

std::vector<TestedLength> tested_lengths(const CmmModel& cmm, const CmmErrors& errors) {
  std::vector<TestedLength> tested;
  const Vec3 centre = -cmm.position;
  for (const Vec3& line : measuring_lines(cmm.travel)) {
    const UnitVec3 along = unit(line);
    const double longest = kLongest * line.norm();
    const Vec3 start = centre - 0.5 * longest * along.vec();
    for (int i = 1; i <= kLengths; ++i) {
      const double length = longest * i / kLengths;
      const GaugeBlock gauge{start, along, length};
      const Vec3 end = start + length * along.vec();
      for (int repetition = 0; repetition < kRepetitions; ++repetition) {
        const std::size_t group = tested.size();
        const Vec3 first = touched(errors, gauge, start, -along, point_index(group, 0));
        const Vec3 second = touched(errors, gauge, end, along, point_index(group, 1));
        const double error = (second - first).dot(along.vec()) - length;
        tested.push_back({along, length, repetition, error, length_limit(cmm, length)});
      }
    }
  }
  return tested;
}

void test_sphere(const CmmModel& cmm, const CmmErrors& errors, AcceptanceReport& report) {
  PlannedFeature sphere;
  sphere.kind = FeatureKind::sphere;
  sphere.point = -cmm.position;
  sphere.axis = cmm.stylus.value_or(Stylus{}).direction;
  sphere.radius = kSphereRadius;
  sphere.strategy = SphereStrategy{};
  const Ball ball{sphere.point, sphere.radius};
  std::vector<Vec3> points;
  for (const PlannedPoint& p : planned_points(sphere)) {
    points.push_back(
        touched(errors, ball, p.point, unit(p.normal), point_index(kSphereGroup, points.size())));
  }
  report.probing_limit = probing_limit(cmm);
  const auto fit = fit_sphere(points);
  report.probing_form = fit ? fit->form : HUGE_VAL;
  report.probing_size = fit ? 2.0 * (fit->element.radius - sphere.radius) : HUGE_VAL;
}

// Rounding of coordinates of a metre: what an ideal machine may be off by.
constexpr double kRounding = 1e-11;  // mm

bool within(double error, double limit) { return std::abs(error) <= limit + kRounding; }

}  // namespace

bool AcceptanceReport::lengths_pass() const {
  return std::all_of(lengths.begin(), lengths.end(),
                     [](const TestedLength& l) { return within(l.error, l.limit); });
}

bool AcceptanceReport::probing_passes() const {
  return within(probing_form, probing_limit) && within(probing_size, probing_limit);
}

double AcceptanceReport::worst_length_share() const {
  double worst = 0.0;
  for (const TestedLength& l : lengths) {
    const double least = l.limit > 0.0 ? 0.0 : kRounding;  // no machine keeps a limit of 0 exactly
    if (std::abs(l.error) > least) worst = std::max(worst, std::abs(l.error) / l.limit);
  }
  return worst;
}

AcceptanceReport acceptance_test(const CmmModel& cmm) {
  const CmmErrors errors(cmm);
  AcceptanceReport report;
  report.lengths = tested_lengths(cmm, errors);
  test_sphere(cmm, errors, report);
  return report;
}

std::string to_text(const AcceptanceReport& report) {
  std::string out = "direction                  length/mm  error/um  limit/um\n";
  for (std::size_t i = 0; i + kRepetitions <= report.lengths.size(); i += kRepetitions) {
    const auto worst =
        std::max_element(report.lengths.begin() + static_cast<std::ptrdiff_t>(i),
                         report.lengths.begin() + static_cast<std::ptrdiff_t>(i + kRepetitions),
                         [](const TestedLength& a, const TestedLength& b) {
                           return std::abs(a.error) < std::abs(b.error);
                         });
    out += fmt::format("[{:6.3f}, {:6.3f}, {:6.3f}] {:11.3f} {:9.3f} {:9.3f}{}\n",
                       worst->direction.x(), worst->direction.y(), worst->direction.z(),
                       worst->length, worst->error * kUmPerMm, worst->limit * kUmPerMm,
                       within(worst->error, worst->limit) ? "" : "  exceeded");
  }
  const double share = report.worst_length_share();
  out += fmt::format("{} lengths (ISO 10360-2): {}, {}\n", report.lengths.size(),
                     report.lengths_pass() ? "passed" : "failed",
                     share == 0.0 ? "without errors"
                     : std::isfinite(share)
                         ? fmt::format("the worst uses {:.0f} % of its limit", 100.0 * share)
                         : "with errors where the limit is 0: state e0, or l_per_um");
  out += fmt::format(
      "sphere of 25 points (ISO 10360-5): {}, form {:.3f} um, size {:.3f} um, limit {:.3f} um\n",
      report.probing_passes() ? "passed" : "failed", report.probing_form * kUmPerMm,
      report.probing_size * kUmPerMm, report.probing_limit * kUmPerMm);
  return out;
}

}  // namespace frustum::metrology
