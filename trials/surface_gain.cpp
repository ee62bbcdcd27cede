#include "trials/surface_gain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "cutter/search/contact_range.hpp"
#include "kinematics/errors/error_gain.hpp"

namespace frustum::trials {
namespace {

using cutter::PathState;
using cutter::SweptCutter;
using programs::TestPiece;

// Step of the support function's derivative, which is linear in the radius but for rounding.
constexpr double kRadiusStep = 1e-3;  // mm
// A surface that leans more than this against what was measured is another face, met at an edge.
constexpr double kSameFace = 0.9;

// The cutter with a radius larger and smaller by kRadiusStep.
struct RadiusPair {
  cutter::Cutter larger, smaller;

  [[nodiscard]] double support_gain(double u) const {
    return (larger.body().support(u) - smaller.body().support(u)) / (2.0 * kRadiusStep);
  }
};

Result<std::map<int, RadiusPair>> radius_pairs(const TestPiece& piece) {
  std::map<int, RadiusPair> pairs;
  for (const auto& [number, spec] : piece.tools) {
    cutter::CutterSpec larger = spec, smaller = spec;
    larger.radius_error.value += kRadiusStep;
    smaller.radius_error.value -= kRadiusStep;
    auto plus = cutter::Cutter::make(larger), minus = cutter::Cutter::make(smaller);
    if (!plus) return std::move(plus).error();
    if (!minus) return std::move(minus).error();
    pairs.emplace(number, RadiusPair{*std::move(plus), *std::move(minus)});
  }
  return pairs;
}

kinematics::AxisState axes_at(const kinematics::ToolPath& path, const PathState& state) {
  const std::uint32_t first = path.segments[state.segment].first_pose;
  kinematics::AxisState at = path.axes[first];
  const kinematics::AxisState& next = path.axes[first + 1];
  for (const auto letter : kinematics::kAxisLetters) {
    at.q[letter] += state.t * (next.q[letter] - at.q[letter]);
    at.heading[letter] += state.t * (next.heading[letter] - at.heading[letter]);
  }
  return at;
}

class GainAtPoint {
 public:
  GainAtPoint(const kinematics::Machine& machine, const TestPiece& piece, const SweptCutter& swept,
              const std::map<int, RadiusPair>& radii)
      : machine_(machine),
        piece_(piece),
        swept_(swept),
        radii_(radii),
        workpiece_from_table_(piece.placement.table_from_workpiece().inverse().rotation) {}

  // Motion of the surface point p that was cut at this state, along its outward normal n.
  [[nodiscard]] double operator()(const Parameter& parameter, const PathState& state, const Vec3& p,
                                  const Vec3& n) const {
    const kinematics::ToolPath& path = swept_.path();
    const kinematics::PathSegment& segment = path.segments[state.segment];
    const int tool = path.blocks[segment.block].tool;
    const auto pose = kinematics::between(path.from(segment), path.to(segment), state.t);
    if (!parameter.unit)
      return -radii_.at(tool).support_gain(std::clamp(-n.dot(pose.axis), -1.0, 1.0));
    const cutter::CutterSpec& spec = piece_.tools.at(tool);
    const auto moved =
        kinematics::first_order_displacement(machine_, *parameter.unit, axes_at(path, state),
                                             spec.length.value + spec.length_error.value);
    const kinematics::PoseDisplacement in_workpiece{workpiece_from_table_ * moved.tip,
                                                    workpiece_from_table_ * moved.turn};
    return n.dot(in_workpiece.at(p - pose.tip));
  }

 private:
  const kinematics::Machine& machine_;
  const TestPiece& piece_;
  const SweptCutter& swept_;
  const std::map<int, RadiusPair>& radii_;
  Mat3 workpiece_from_table_;
};

bool has_provenance(const metrology::MeasuredFeature& feature) {
  return feature.touches.size() == feature.points.size() &&
         std::all_of(feature.touches.begin(), feature.touches.end(),
                     [](const metrology::Touch& touch) { return touch.provenance.has_value(); });
}

Diagnostic unknown_origin(const std::string& feature) {
  return error("no-provenance"_id,
               fmt::format("feature '{}': nobody knows what cut its points", feature),
               "the gains need the points of the same trial, as its own probe touched them");
}

}  // namespace

Result<SurfaceGains> surface_gains(const kinematics::Machine& machine, const TestPiece& piece,
                                   const Trial& trial, std::span<const Parameter> parameters) {
  for (const auto& feature : trial.measurement.features) {
    if (!has_provenance(feature)) return unknown_origin(feature.name);
  }
  const auto radii = radius_pairs(piece);
  if (!radii) return radii.error();
  const SweptCutter& swept = trial.workpiece->removed();
  const GainAtPoint gain(machine, piece, swept, *radii);
  const Pose& workpiece_from_datum = trial.measurement.workpiece_from_datum;

  Eigen::Index rows = 0;
  for (const auto& feature : trial.measurement.features) {
    rows += static_cast<Eigen::Index>(feature.points.size());
  }
  const auto columns = static_cast<Eigen::Index>(parameters.size());
  SurfaceGains gains{Eigen::MatrixXd::Zero(rows, columns), Eigen::MatrixXd::Zero(rows, columns)};
  Eigen::Index row = -1;
  for (const auto& feature : trial.measurement.features) {
    for (std::size_t i = 0; i < feature.points.size(); ++i) {
      ++row;
      const metrology::Touch& touch = feature.touches[i];
      if (!touch.provenance->segment) continue;  // the blank's own surface stays
      const auto states = cutter::contact_range(
          swept, {*touch.provenance->segment, touch.provenance->t}, touch.point);
      // What moves is the surface, along its own normal; what counts is the way along the measured
      // one. The facets of a program differ from the fitted element by half the angle between them.
      const Vec3 n = workpiece_from_datum.direction(feature.points[i].normal);
      const double cosine = touch.normal.dot(n);
      const bool is_same = cosine > kSameFace;
      const Vec3& own = is_same ? touch.normal : n;
      const double lengthened = is_same ? 1.0 / cosine : 1.0;
      for (Eigen::Index k = 0; k < columns; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const PathState& state : states) {
          const double g =
              lengthened * gain(parameters[static_cast<std::size_t>(k)], state, touch.point, own);
          low = std::min(low, g);
          high = std::max(high, g);
        }
        gains.odd(row, k) = 0.5 * (low + high);
        gains.even(row, k) = -0.5 * (high - low);
      }
    }
  }
  return gains;
}

}  // namespace frustum::trials
