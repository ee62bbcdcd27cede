#include "metrology/uncertainty/influence.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "metrology/characteristic/best_shifted_line.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "metrology/characteristic/datum_system.hpp"
#include "metrology/characteristic/evaluators.hpp"
#include "metrology/characteristic/workpiece_frame.hpp"
#include "metrology/uncertainty/fit_response.hpp"

namespace frustum::metrology {
namespace {

// Weights of a least-squares straight line over the places: offset at `origin` and slope.
struct LineWeights {
  Eigen::RowVectorXd offset{};
  Eigen::RowVectorXd slope{};
};
LineWeights line_weights(const Eigen::RowVectorXd& along, double origin) {
  const double mean = along.mean();
  const Eigen::RowVectorXd centred = along.array() - mean;
  LineWeights weights;
  weights.slope = centred / centred.squaredNorm();
  weights.offset =
      1.0 / static_cast<double>(along.size()) + ((origin - mean) * weights.slope).array();
  return weights;
}

// The small motion from one pose to the other: shift and rotation vector.
Eigen::Matrix<double, 6, 1> motion_between(const Pose& from, const Pose& to) {
  const Pose step = to * from.inverse();
  const Mat3& r = step.rotation;
  Eigen::Matrix<double, 6, 1> motion;
  motion << step.translation, 0.5 * Vec3(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  return motion;
}

// A pose that moves by `by` mm or rad in one of the six ways of a motion.
Pose moved_by(Eigen::Index way, double by) {
  if (way < 3) return Pose::translated(by * Vec3::Unit(way));
  return Pose::rotated(rotation_about(Vec3::Unit(way - 3), by));
}

}  // namespace

Influence::Influence(const InspectionPlan& plan, std::span<const FittedFeature> features)
    : plan_(plan), features_(features), first_point_{0} {
  for (const FittedFeature& feature : features_) {
    first_point_.push_back(first_point_.back() + static_cast<Eigen::Index>(feature.points.size()));
  }
  field_.resize(first_point_.back(), 6);
  Eigen::Index row = 0;
  for (const FittedFeature& feature : features_) {
    for (const MeasuredPoint& p : feature.points) {
      const Vec3& n = p.normal;
      const Vec3 c = p.point + 0.5 * plan_.probe.ball_diameter * n;
      field_.row(row++) << n.x() * c.x(), n.y() * c.y(), n.z() * c.z(), n.x() * c.y(),
          n.x() * c.z(), n.y() * c.z();
    }
  }
}

// The feature's index, -1 when it was not measured.
Eigen::Index Influence::find(const std::string& name) const {
  for (std::size_t i = 0; i < features_.size(); ++i) {
    if (features_[i].planned->name == name) return static_cast<Eigen::Index>(i);
  }
  return -1;
}

Result<std::optional<Eigen::RowVectorXd>> Influence::of(const PlannedCharacteristic& planned) {
  for (const std::string& name : planned.features) {
    if (find(name) < 0) {
      return error(
          "feature-without-points"_id,
          fmt::format("characteristic '{}': feature '{}' has no points", planned.name, name),
          "measure the feature, or take the characteristic out of the plan");
    }
  }
  const Gradient gradient = evaluator_of(planned.kind).gradient;
  if (gradient == Gradient::none) return std::optional<Eigen::RowVectorXd>{};
  auto row = gradient == Gradient::size ? size(planned) : lines(planned);
  if (!row) return std::move(row).error();
  return std::optional(std::move(*row));
}

Result<Eigen::RowVectorXd> Influence::lines(const PlannedCharacteristic& planned) {
  const Result<Place>& here = place(planned.frame);
  if (!here) return here.error();
  const PlannedFeature& first = *find_feature(plan_, planned.features.front());
  const auto axes = line_axes(planned.kind, first.axis, planned.direction);
  if (!axes)
    return error("line-direction"_id, "the direction is along the lines", "choose one across them");
  const Pose place_from_workpiece = here->workpiece_from_place.inverse();
  Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(first_point_.back());
  // How the value changes with a motion of the frame, which moves every point against it.
  Eigen::Matrix<double, 1, 6> by_motion = Eigen::Matrix<double, 1, 6>::Zero();
  double sign = -1.0;
  for (const std::string& name : planned.features) {
    const auto index = static_cast<std::size_t>(find(name));
    const FittedFeature& feature = features_[index];
    const Vec3& written = feature.planned->normal;
    const Vec3 normal = (written - written.dot(axes->along) * axes->along).normalized();
    std::vector<Vec3> points;
    Eigen::RowVectorXd along(feature.points.size());
    for (std::size_t i = 0; i < feature.points.size(); ++i) {
      points.push_back(place_from_workpiece.point(feature.points[i].point));
      along[static_cast<Eigen::Index>(i)] = points.back().dot(axes->along);
    }
    const LineWeights weights = line_weights(along, first.point.dot(axes->along));
    const Eigen::RowVectorXd weight =
        sign / normal.dot(axes->across) *
        (planned.kind == CharacteristicKind::line_angle ? weights.slope : weights.offset);
    gradient.segment(first_point_[index], weight.size()) += weight;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double w = weight[static_cast<Eigen::Index>(i)];
      by_motion.head<3>() -= w * normal.transpose();
      by_motion.tail<3>() -= w * points[i].cross(normal).transpose();
    }
    sign = 1.0;
  }
  if (here->motion.size() > 0) gradient += by_motion * here->motion;
  return gradient;
}

Result<Eigen::RowVectorXd> Influence::size(const PlannedCharacteristic& planned) {
  const Result<Pose> workpiece_from_datum = alignment_of(plan_, features_);
  if (!workpiece_from_datum) return workpiece_from_datum.error();
  const auto index = static_cast<std::size_t>(find(planned.features.front()));
  const FittedFeature feature = transformed(workpiece_from_datum->inverse(), features_[index]);
  const auto value_of = [&](const FittedFeature& changed) -> Result<double> {
    const auto result = evaluate(planned, std::span(&changed, 1), {});
    if (!result) return result.error();
    return internal_value(*result);
  };
  const auto slope = [&](const FittedFeature& less, const FittedFeature& more,
                         double step) -> Result<double> {
    auto low = value_of(less);
    if (!low) return low;
    auto high = value_of(more);
    if (!high) return high;
    return (*high - *low) / (2.0 * step);
  };
  Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(first_point_.back());
  const FitResponse response = fit_response(feature);
  for (std::size_t k = 0; k < response.changes.size(); ++k) {
    const ElementChange change = response.changes[k];
    const double step = step_of(change);
    FittedFeature less = feature;
    FittedFeature more = feature;
    less.element = varied(feature.element, change, -step);
    more.element = varied(feature.element, change, step);
    const auto by_change = slope(less, more, step);
    if (!by_change) return by_change.error();
    gradient.segment(first_point_[index], response.weights.cols()) +=
        *by_change * response.weights.row(static_cast<Eigen::Index>(k));
  }
  if (!uses_datum(plan_)) return gradient;
  // The section of a cone has its place in the datum system, which its own points do not move.
  Eigen::Matrix<double, 1, 6> by_motion;
  for (Eigen::Index way = 0; way < 6; ++way) {
    const double step = way < 3 ? 1e-3 : 1e-5;  // as step_of()
    const auto moved = slope(transformed(moved_by(way, step), feature),
                             transformed(moved_by(way, -step), feature), step);
    if (!moved) return moved.error();
    by_motion[way] = *moved;
  }
  const Result<Place>& here = place("");
  if (!here) return here.error();
  gradient += by_motion * here->motion;
  return gradient;
}

Result<Influence::Motion> Influence::motion_of_frame(const PlannedFrame& frame) const {
  const auto workpiece_from_here = workpiece_from_frame(plan_, frame, features_);
  if (!workpiece_from_here) return workpiece_from_here.error();
  // Everything in the axes of the planned frame, about its origin on the line.
  const Pose nominal = nominal_frame(plan_, frame);
  const Pose local_from_workpiece = (*workpiece_from_here * nominal).inverse();
  Motion local = Motion::Zero(6, first_point_.back());

  std::vector<Eigen::Index> columns;
  std::vector<Vec3> floor;
  for (const std::string& name : frame.planes) {
    const auto index = static_cast<std::size_t>(find(name));
    Eigen::Index column = first_point_[index];
    for (const MeasuredPoint& p : features_[index].points) {
      floor.push_back(local_from_workpiece.point(p.point));
      columns.push_back(column++);
    }
  }
  // Height over the floor: c + a x + b y, so the frame rises by c and turns by b about x, -a about
  // y.
  Mat3 information = Mat3::Zero();
  for (const Vec3& p : floor) {
    const Vec3 row(1.0, p.x(), p.y());
    information += row * row.transpose();
  }
  const Mat3 cofactor = information.inverse();
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const Vec3 plane = cofactor * Vec3(1.0, floor[i].x(), floor[i].y());
    local(2, columns[i]) += plane[0];
    local(3, columns[i]) += plane[2];
    local(4, columns[i]) -= plane[1];
  }
  // Where the frame rises, a leaning wall is read farther to the side.
  const auto wall = static_cast<std::size_t>(find(frame.line));
  const Vec3 normal = nominal.rotation.transpose() * features_[wall].planned->normal;
  const double lean = -normal.z() / normal.y();
  const double facing = normal.y() / std::hypot(normal.y(), normal.z());
  local.row(1) = lean * local.row(2);
  local.row(5) = -lean * local.row(4);
  Eigen::RowVectorXd along(features_[wall].points.size());
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    const MeasuredPoint& p = features_[wall].points[static_cast<std::size_t>(i)];
    along[i] = local_from_workpiece.point(p.point).x();
  }
  const LineWeights weights = line_weights(along, 0.0);
  local.row(1).segment(first_point_[wall], along.size()) += weights.offset / facing;
  local.row(5).segment(first_point_[wall], along.size()) += weights.slope / facing;

  Motion motion(6, local.cols());
  motion.bottomRows<3>() = nominal.rotation * local.bottomRows<3>();
  motion.topRows<3>() = nominal.rotation * local.topRows<3>();
  for (Eigen::Index i = 0; i < motion.cols(); ++i) {  // from the frame's origin to the workpiece's
    const Vec3 turn = motion.col(i).tail<3>();
    motion.col(i).head<3>() -= turn.cross(nominal.translation);
  }
  return motion;
}

Result<Influence::Motion> Influence::motion_of_datum() const {
  Motion motion = Motion::Zero(6, first_point_.back());
  std::vector<FittedFeature> features(features_.begin(), features_.end());
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (!is_datum_feature(plan_, *features_[f].planned)) continue;
    const FitResponse response = fit_response(features_[f]);
    for (std::size_t k = 0; k < response.changes.size(); ++k) {
      const double step = step_of(response.changes[k]);
      const auto changed = [&](double by) {
        features[f] = varied(features_[f], response.changes[k], by);
        return alignment_of(plan_, features);
      };
      const auto less = changed(-step);
      if (!less) return less.error();
      const auto more = changed(step);
      if (!more) return more.error();
      motion.middleCols(first_point_[f], response.weights.cols()) +=
          motion_between(*less, *more) / (2.0 * step) *
          response.weights.row(static_cast<Eigen::Index>(k));
    }
    features[f] = features_[f];
  }
  return motion;
}

const Result<Influence::Place>& Influence::place(const std::string& frame) {
  const auto known = places_.find(frame);
  if (known != places_.end()) return known->second;
  return places_.emplace(frame, found_place(frame)).first->second;
}

Result<Influence::Place> Influence::found_place(const std::string& frame) const {
  Place out;
  const auto pose = frame.empty()
                        ? alignment_of(plan_, features_)
                        : workpiece_from_frame(plan_, *find_frame(plan_, frame), features_);
  if (!pose) return pose.error();
  out.workpiece_from_place = *pose;
  if (frame.empty() && !uses_datum(plan_)) return out;  // nothing moves the workpiece frame
  auto motion = frame.empty() ? motion_of_datum() : motion_of_frame(*find_frame(plan_, frame));
  if (!motion) return std::move(motion).error();
  out.motion = std::move(*motion);
  return out;
}

double variance(const Eigen::RowVectorXd& gradient, const Eigen::MatrixXd& field,
                const PointUncertainty& u) {
  return u.probing * u.probing * gradient.squaredNorm() +
         u.scale * u.scale * (gradient * field).squaredNorm();
}

}  // namespace frustum::metrology
