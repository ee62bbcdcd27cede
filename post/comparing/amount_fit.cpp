#include "post/comparing/amount_fit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/linear_algebra.hpp"

namespace frustum::post {
namespace {

using kinematics::AxisLetter;
using kinematics::GeometricErrors;
using kinematics::Joint;
using kinematics::Machine;
using kinematics::PathKind;
using kinematics::Setup;
using kinematics::ToolPath;
using kinematics::ToolPose;

void move_offsets(Setup& setup, const Vec3& by) {
  for (auto& [number, offset] : setup.work_offsets) offset += by;
}

void displace(kinematics::AxisErrors& axis, const Vec3& by) {
  for (std::size_t k = 0; k < 3; ++k) axis.location[k] += by[static_cast<Eigen::Index>(k)];
}

// The rotary axis that this one carries.
std::optional<AxisLetter> next_rotary(const Machine& machine, AxisLetter letter) {
  for (const auto* chain : {&machine.tool_chain(), &machine.work_chain()}) {
    bool found = false;
    for (const Joint& joint : *chain) {
      if (found && joint.rotary()) return joint.letter;
      found = found || joint.letter == letter;
    }
  }
  return std::nullopt;
}

// The last pose of every feed block: as many for every setup.
std::vector<ToolPose> block_ends(const ToolPath& path) {
  std::vector<ToolPose> ends;
  for (std::size_t k = 0; k < path.segments.size(); ++k) {
    const auto block = path.segments[k].block;
    const bool last = k + 1 == path.segments.size() || path.segments[k + 1].block != block;
    if (last && path.blocks[block].kind == PathKind::feed)
      ends.push_back(path.to(path.segments[k]));
  }
  return ends;
}

// Tips of `path` at the given shares of its whole length.
class ProgressOf {
 public:
  explicit ProgressOf(const std::vector<ToolPose>& poses) : poses_(poses), way_(poses.size(), 0.0) {
    for (std::size_t i = 1; i < poses.size(); ++i) {
      way_[i] = way_[i - 1] + (poses[i].tip - poses[i - 1].tip).norm() +
                20.0 * (poses[i].axis - poses[i - 1].axis).norm();
    }
  }
  [[nodiscard]] double share(std::size_t i) const { return way_[i] / way_.back(); }
  [[nodiscard]] Vec3 tip_at(double share) const {
    const auto after = std::lower_bound(way_.begin(), way_.end(), share * way_.back());
    const auto i = static_cast<std::size_t>(std::min(after, way_.end() - 1) - way_.begin());
    if (i == 0) return poses_.front().tip;
    const double step = way_[i] - way_[i - 1];
    const double t = step > 0.0 ? (share * way_.back() - way_[i - 1]) / step : 1.0;
    return poses_[i - 1].tip + t * (poses_[i].tip - poses_[i - 1].tip);
  }

 private:
  const std::vector<ToolPose>& poses_;
  std::vector<double> way_;
};

Eigen::VectorXd least_squares_step(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& off) {
  return shortest_solution(slopes, off, 1e-9);  // amounts that change nothing stay zero
}

}  // namespace

std::vector<Amounts> adjustable(const Machine& machine) {
  std::vector<Amounts> all;
  all.push_back({1, true,
                 [](const Eigen::VectorXd& p, Setup& setup, GeometricErrors&) {
                   for (auto& [number, tool] : setup.tools) tool.length_error += p[0];
                 },
                 [](const Eigen::VectorXd& p) {
                   return fmt::format("the tool length compensated differs by {:.4f} mm", p[0]);
                 }});
  all.push_back({1, false,
                 [](const Eigen::VectorXd& p, Setup& setup, GeometricErrors&) {
                   for (auto& [number, tool] : setup.tools) tool.length += p[0];
                 },
                 [](const Eigen::VectorXd& p) {
                   return fmt::format(
                       "posted for another pivot or tool length, different by {:.4f} mm", p[0]);
                 }});
  all.push_back(
      {3, false,
       [](const Eigen::VectorXd& p, Setup& setup, GeometricErrors&) {
         move_offsets(setup, p.head<3>());
       },
       [](const Eigen::VectorXd& p) {
         return fmt::format(
             "the program origin (work offset) is displaced by ({:.4f}, {:.4f}, {:.4f}) mm", -p[0],
             -p[1], -p[2]);
       }});
  for (const Joint& axis : machine.joints()) {
    const Joint* joint = machine.joint(axis.letter);
    const auto carried = next_rotary(machine, axis.letter);
    if (!axis.rotary() || (axis.side > 0 && !carried)) continue;
    all.push_back({3, true,
                   [letter = axis.letter, carried](const Eigen::VectorXd& p, Setup& setup,
                                                   GeometricErrors& errors) {
                     displace(errors[letter], p);
                     // What the axis carries stays where it is.
                     if (carried) {
                       displace(errors[*carried], -p);
                     } else {
                       setup.table_from_workpiece.translation -= p;
                     }
                   },
                   [joint](const Eigen::VectorXd& p) {
                     const Vec3 off = p;
                     const Vec3 across = off - joint->direction * joint->direction.dot(off);
                     return fmt::format(
                         "posted for a rotary axis {} that is located elsewhere (pivot), by "
                         "({:.4f}, {:.4f}, {:.4f}) mm",
                         to_char(joint->letter), across.x(), across.y(), across.z());
                   }});
  }
  return all;
}

std::optional<Eigen::VectorXd> AmountFit::operator()(const Amounts& amounts) const {
  Eigen::VectorXd p = Eigen::VectorXd::Zero(amounts.count);
  const auto start = run(amounts, p);
  if (!start) return std::nullopt;
  const std::vector<ToolPose> poses = block_ends(*start);
  if (poses.size() < 2) return std::nullopt;
  const auto slopes = slopes_of(amounts, poses);
  if (!slopes || slopes->norm() < 1e-6) return std::nullopt;

  p = least_squares_step(*slopes, by_progress(poses));
  // The displacement is linear in the amounts; what changes from step to step is which places of
  // the two paths belong together.
  constexpr int kMostSteps = 8;
  for (int k = 0; k < kMostSteps; ++k) {
    const auto path = run(amounts, p);
    if (!path) return std::nullopt;
    if (lies_on(*path, first_, limits_)) return same_way_with(amounts, p);
    const Eigen::VectorXd further = step_across(*slopes, *path);
    if (further.norm() < 0.01 * limits_.tip) return std::nullopt;  // as good as it gets
    p += further;
  }
  return std::nullopt;
}

std::optional<ToolPath> AmountFit::run(const Amounts& amounts, const Eigen::VectorXd& p,
                                       PathSampling sampling) const {
  Setup setup = program_.setup;
  GeometricErrors errors;
  amounts.apply(p, setup, errors);
  if (amounts.leaves_commands) {
    return path_of(machine_, setup, commanded_, errors, sampling, limits_);
  }
  const auto commanded = commanded_or_nothing(machine_, setup, program_.motions);
  if (!commanded) return std::nullopt;
  return path_of(machine_, setup, *commanded, errors, sampling, limits_);
}

std::optional<Eigen::VectorXd> AmountFit::same_way_with(const Amounts& amounts,
                                                        const Eigen::VectorXd& p) const {
  const auto path = run(amounts, p, PathSampling::fine);
  if (path && same_way(first_, *path, limits_)) return p;
  return std::nullopt;
}

// Motion of each block end by a unit of each amount: three rows a block.
std::optional<Eigen::MatrixXd> AmountFit::slopes_of(const Amounts& amounts,
                                                    const std::vector<ToolPose>& poses) const {
  Eigen::MatrixXd slopes(3 * static_cast<Eigen::Index>(poses.size()), amounts.count);
  for (int k = 0; k < amounts.count; ++k) {
    const auto moved = run(amounts, Eigen::VectorXd::Unit(amounts.count, k));
    if (!moved) return std::nullopt;
    const std::vector<ToolPose> ends = block_ends(*moved);
    if (ends.size() != poses.size()) return std::nullopt;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      slopes.block<3, 1>(3 * static_cast<Eigen::Index>(i), k) = ends[i].tip - poses[i].tip;
    }
  }
  return slopes;
}

// How far each block end is from where the first path is after the same share of its way.
Eigen::VectorXd AmountFit::by_progress(const std::vector<ToolPose>& poses) const {
  const std::vector<ToolPose> reference = block_ends(first_);
  const ProgressOf wanted(reference), own(poses);
  Eigen::VectorXd off(3 * static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    off.segment<3>(3 * static_cast<Eigen::Index>(i)) = wanted.tip_at(own.share(i)) - poses[i].tip;
  }
  return off;
}

// Only displacements across the direction of the first path count.
Eigen::VectorXd AmountFit::step_across(const Eigen::MatrixXd& slopes, const ToolPath& path) const {
  const std::vector<ToolPose> poses = block_ends(path);
  // After the first step a true cause leaves the paths close together.
  const auto matches = kinematics::match_paths(path, first_, {.most_apart = 0.2}).matches;
  Eigen::MatrixXd across_slopes = slopes;
  Eigen::VectorXd off = Eigen::VectorXd::Zero(slopes.rows());
  std::size_t m = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    while (m + 1 < matches.size() && (matches[m].reference.pose.tip != poses[i].tip)) ++m;
    const Vec3 along = i > 0 ? Vec3(poses[i].tip - poses[i - 1].tip) : Vec3::Zero();
    Mat3 across = Mat3::Identity();
    if (along.norm() > 0.0) across -= along * along.transpose() / along.squaredNorm();
    const auto row = 3 * static_cast<Eigen::Index>(i);
    off.segment<3>(row) = across * (matches[m].other.pose.tip - poses[i].tip);
    across_slopes.middleRows<3>(row) = (across * slopes.middleRows<3>(row)).eval();
  }
  return least_squares_step(across_slopes, off);
}

}  // namespace frustum::post
