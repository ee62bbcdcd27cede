#include "trials/surface_gain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>

#include "core/golden_section.hpp"
#include "cutter/search/contact_range.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "trials/population/column_motion.hpp"

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
  return state_between(path.axes[first], path.axes[first + 1], state.t);
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

// A surface that a segment left: when it touches a point, and the normal out of the material.
struct Side {
  PathState state{};
  double distance = 0.0;  // mm, of the point from the cutter
  Vec3 normal = Vec3::UnitZ();
};

class SideOfSegment {
 public:
  SideOfSegment(const SweptCutter& swept, std::uint32_t segment, const Vec3& point)
      : path_(swept.path()),
        segment_(segment),
        point_(point),
        generatrix_(
            swept.tool(path_.blocks[path_.segments[segment].block].tool).body().generatrix()) {}

  [[nodiscard]] Side at(double t) const {
    constexpr double kAside = 1e-4;  // mm: the normal is that of the distance's differences
    Side side{{segment_, t}, distance(t, point_)};
    for (int k = 0; k < 3; ++k) {
      const Vec3 aside = kAside * Vec3::Unit(k);
      side.normal[k] = distance(t, point_ - aside) - distance(t, point_ + aside);
    }
    side.normal.normalize();
    return side;
  }
  [[nodiscard]] Side nearest() const {
    constexpr double kNarrow = 1e-9;
    return at(golden_section([&](double t) { return distance(t, point_); }, 0.0, 1.0, kNarrow).at);
  }

 private:
  [[nodiscard]] double distance(double t, const Vec3& p) const {
    const kinematics::PathSegment& segment = path_.segments[segment_];
    const auto pose = kinematics::between(path_.from(segment), path_.to(segment), t);
    const Vec3 m = p - pose.tip;
    const double z = m.dot(pose.axis);
    return generatrix_.distance((m - z * pose.axis).norm(), z);
  }
  const kinematics::ToolPath& path_;
  std::uint32_t segment_;
  Vec3 point_;
  const cutter::Generatrix& generatrix_;
};

// Two surfaces meet in an edge, which the ball touches: along n = a n1 + b n2 it moves by what they
// do along their own normals, a d1 + b d2.
struct Edge {
  Side own{}, other{};
  double a = 1.0, b = 0.0;
};

// With the neighbouring segment of the same tool that touches the point too, if one does.
std::optional<Edge> edge_at(const SweptCutter& swept, const PathState& own,
                            const metrology::Touch& touch) {
  constexpr double kOnBoth = 1e-8;  // mm: contacts are on their own surface within 1e-9
  constexpr double kSmooth = 1e-6;  // rad: surfaces that go on smoothly have no edge
  const kinematics::ToolPath& path = swept.path();
  const auto tool_of = [&](std::uint32_t segment) {
    return path.blocks[path.segments[segment].block].tool;
  };
  for (const int step : {-1, 1}) {
    const std::int64_t next = static_cast<std::int64_t>(own.segment) + step;
    if (next < 0 || next >= static_cast<std::int64_t>(path.segments.size())) continue;
    const auto segment = static_cast<std::uint32_t>(next);
    if (tool_of(segment) != tool_of(own.segment)) continue;
    Edge edge{SideOfSegment(swept, own.segment, touch.point).at(own.t),
              SideOfSegment(swept, segment, touch.point).nearest()};
    if (std::abs(edge.other.distance) > kOnBoth) continue;
    const double c = edge.own.normal.dot(edge.other.normal);
    const double sine2 = edge.own.normal.cross(edge.other.normal).squaredNorm();
    if (!(sine2 > kSmooth * kSmooth) || c < kSameFace) continue;
    const double along_own = touch.normal.dot(edge.own.normal);
    const double along_other = touch.normal.dot(edge.other.normal);
    edge.a = (along_own - c * along_other) / sine2;
    edge.b = (along_other - c * along_own) / sine2;
    if (edge.a >= 0.0 && edge.b >= 0.0) return edge;
  }
  return std::nullopt;
}

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
      const PathState cut_at{*touch.provenance->segment, touch.provenance->t};
      const auto states = cutter::contact_range(swept, cut_at, touch.point);
      const auto edge = states.size() == 1 ? edge_at(swept, cut_at, touch) : std::nullopt;
      // What moves is the surface, along its own normal; what counts is the way along the measured
      // one. The facets of a program differ from the fitted element by half the angle between them.
      const Vec3 n = workpiece_from_datum.direction(feature.points[i].normal);
      const double cosine = touch.normal.dot(n);
      const bool is_same = cosine > kSameFace;
      const Vec3& own = is_same ? touch.normal : n;
      const double lengthened = is_same ? 1.0 / cosine : 1.0;
      for (Eigen::Index k = 0; k < columns; ++k) {
        const Parameter& parameter = parameters[static_cast<std::size_t>(k)];
        if (edge && is_same) {
          const auto along = [&](const Side& side) {
            return gain(parameter, side.state, touch.point, side.normal);
          };
          gains.odd(row, k) =
              lengthened * (edge->a * along(edge->own) + edge->b * along(edge->other));
          continue;
        }
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const PathState& state : states) {
          const double g = lengthened * gain(parameter, state, touch.point, own);
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
