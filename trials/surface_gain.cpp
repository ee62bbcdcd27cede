#include "trials/surface_gain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "cutter/search/contact_range.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "trials/cut_check.hpp"

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

kinematics::AxisState axes_at(const kinematics::ToolPath& path, const PathState& program_state) {
  const std::uint32_t first = path.segments[program_state.segment].first_pose;
  kinematics::AxisState at = path.axes[first];
  const kinematics::AxisState& next = path.axes[first + 1];
  for (const auto letter : kinematics::kAxisLetters) {
    at.q[letter] += program_state.t * (next.q[letter] - at.q[letter]);
    at.heading[letter] += program_state.t * (next.heading[letter] - at.heading[letter]);
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

  // Motion of the surface point p that was cut at this program_state, along its outward normal n.
  [[nodiscard]] double operator()(const Parameter& parameter, const PathState& program_state,
                                  const Vec3& p, const Vec3& n) const {
    const kinematics::ToolPath& path = swept_.path();
    const kinematics::PathSegment& segment = path.segments[program_state.segment];
    const int tool = path.blocks[segment.block].tool;
    const auto pose = kinematics::between(path.from(segment), path.to(segment), program_state.t);
    if (!parameter.unit)
      return -radii_.at(tool).support_gain(std::clamp(-n.dot(pose.axis), -1.0, 1.0));
    const cutter::CutterSpec& spec = piece_.tools.at(tool);
    const auto moved = kinematics::first_order_displacement(
        machine_, *parameter.unit, axes_at(path, program_state),
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

Diagnostic lost(const std::string& feature, std::size_t index) {
  return error(fmt::format("feature '{}', point {}: there is no surface within {} mm of it",
                           feature, index + 1, kSurfaceSearch),
               "the gains need the points of the same trial, measured without noise");
}

}  // namespace

Result<SurfaceGains> surface_gains(const kinematics::Machine& machine, const TestPiece& piece,
                                   const Trial& trial, std::span<const Parameter> parameters) {
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
      const Vec3 measured = workpiece_from_datum.point(feature.points[i].point);
      const Vec3 n = workpiece_from_datum.direction(feature.points[i].normal);
      const auto surface = surface_at_point(*trial.workpiece, measured, n);
      if (!surface) return lost(feature.name, i);
      if (!surface->segment) continue;  // the blank's own surface stays
      const auto contact =
          swept.contact({surface->point + surface->s * n, -n}, surface->s, *surface->segment);
      const auto program_states = cutter::contact_range(swept, contact, surface->point);
      // The point is asked along the measured normal; what moves is the surface, along its own. The facets of
      // a program differ from the fitted element by half the angle between them.
      const double cosine = surface->normal.dot(n);
      const bool is_same = cosine > kSameFace;
      const Vec3& own = is_same ? surface->normal : n;
      const double lengthened = is_same ? 1.0 / cosine : 1.0;
      for (Eigen::Index k = 0; k < columns; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const PathState& program_state : program_states) {
          const double g = lengthened * gain(parameters[static_cast<std::size_t>(k)], program_state,
                                             surface->point, own);
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
