#include "cutter/search/pose_tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustum::cutter {
namespace {

using kinematics::PathSegment;
using kinematics::ToolPath;

constexpr std::uint32_t kLeaf = 4;

// Mean and spread of some vectors.
class Scatter {
 public:
  void add(const Vec3& v) {
    sum_ += v;
    products_ += v * v.transpose();
    ++count_;
  }
  [[nodiscard]] Mat3 covariance() const {
    const Vec3 mean = sum_ / count_;
    return products_ / count_ - mean * mean.transpose();
  }

 private:
  Vec3 sum_ = Vec3::Zero();
  Mat3 products_ = Mat3::Zero();
  int count_ = 0;
};

class Builder {
 public:
  Builder(const ToolPath& path, std::span<const Box> boxes, std::vector<std::uint32_t>& order,
          double reach, std::vector<PoseGroup>& groups)
      : path_(path), boxes_(boxes), order_(order), reach_(reach), groups_(groups) {}

  void build(std::uint32_t index, std::uint32_t first, std::uint32_t count) {
    Scatter tips, axes;
    const Vec3 centre = from(first).tip;  // keeps the products small
    for (std::uint32_t i = first; i < first + count; ++i) {
      tips.add(from(i).tip - centre);
      tips.add(to(i).tip - centre);
      axes.add(reach_ * from(i).axis);
      axes.add(reach_ * to(i).axis);
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> spread(tips.covariance());
    groups_[index] = group_of(first, count, spread.eigenvectors());
    if (count <= kLeaf) return;
    groups_[index].count = 0;

    const Eigen::SelfAdjointEigenSolver<Mat3> turning(axes.covariance());
    const bool by_place = spread.eigenvalues()[2] >= turning.eigenvalues()[2];
    const Vec3 direction = by_place ? spread.eigenvectors().col(2) : turning.eigenvectors().col(2);
    const auto key = [&](std::uint32_t segment) -> double {
      const PathSegment& s = path_.segments[segment];
      return by_place ? direction.dot(path_.from(s).tip + path_.to(s).tip)
                      : direction.dot(path_.from(s).axis + path_.to(s).axis);
    };
    const auto begin = order_.begin() + first;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(key(a), a) < std::pair(key(b), b);
    });
    const auto children = static_cast<std::uint32_t>(groups_.size());
    groups_.resize(groups_.size() + 2);
    groups_[index].children = children;
    build(children, first, half);
    build(children + 1, first + half, count - half);
  }

 private:
  [[nodiscard]] const ToolPose& from(std::uint32_t i) const {
    return path_.from(path_.segments[order_[i]]);
  }
  [[nodiscard]] const ToolPose& to(std::uint32_t i) const {
    return path_.to(path_.segments[order_[i]]);
  }

  [[nodiscard]] PoseGroup group_of(std::uint32_t first, std::uint32_t count,
                                   const Mat3& frame) const {
    PoseGroup group{.first = first, .count = count, .frame = frame};
    group.representative_segment = order_[first + count / 2];
    group.representative = path_.from(path_.segments[group.representative_segment]);
    group.earliest = std::numeric_limits<std::uint32_t>::max();
    group.box = boxes_[order_[first]];
    double tip_shift2 = 0.0, axis_shift2 = 0.0, sagitta = 0.0;
    for (std::uint32_t i = first; i < first + count; ++i) {
      group.earliest = std::min(group.earliest, order_[i]);
      group.box.min = group.box.min.cwiseMin(boxes_[order_[i]].min);
      group.box.max = group.box.max.cwiseMax(boxes_[order_[i]].max);
      for (const ToolPose& pose : {from(i), to(i)}) {
        const Vec3 tip = pose.tip - group.representative.tip,
                   axis = pose.axis - group.representative.axis;
        tip_shift2 = std::max(tip_shift2, tip.squaredNorm());
        axis_shift2 = std::max(axis_shift2, axis.squaredNorm());
        const Vec3 along = frame.transpose() * tip, turned = frame.transpose() * axis;
        group.tip_lo = group.tip_lo.cwiseMin(along);
        group.tip_hi = group.tip_hi.cwiseMax(along);
        group.axis_lo = group.axis_lo.cwiseMin(turned);
        group.axis_hi = group.axis_hi.cwiseMax(turned);
      }
      // Between its ends the axis runs on an arc: at most 1 - cos(turn / 2) beside the chord.
      const double chord2 = (to(i).axis - from(i).axis).squaredNorm();
      sagitta = std::max(sagitta, 1.0 - std::sqrt(std::max(0.0, 1.0 - chord2 / 4.0)));
    }
    group.axis_lo.array() -= sagitta;
    group.axis_hi.array() += sagitta;
    group.tip_shift = std::sqrt(tip_shift2);
    group.axis_shift = std::sqrt(axis_shift2) + sagitta;
    group.shift = group.tip_shift + reach_ * group.axis_shift;
    return group;
  }

  const ToolPath& path_;
  std::span<const Box> boxes_;
  std::vector<std::uint32_t>& order_;
  double reach_;
  std::vector<PoseGroup>& groups_;
};

}  // namespace

double farthest_tip(const PoseGroup& group, const Vec3& v) {
  const Vec3 n = group.frame.transpose() * v;
  return n.cwiseProduct(group.tip_lo).cwiseMax(n.cwiseProduct(group.tip_hi)).sum();
}

double farthest_axis(const PoseGroup& group, const Vec3& v) {
  const Vec3 n = group.frame.transpose() * v;
  return n.cwiseProduct(group.axis_lo).cwiseMax(n.cwiseProduct(group.axis_hi)).sum();
}

double support(const PoseGroup& group, const Profile& body, const Vec3& normal) {
  const Vec3 n = group.frame.transpose() * normal;
  const double tip = (n.cwiseProduct(group.tip_lo)).cwiseMax(n.cwiseProduct(group.tip_hi)).sum();
  const Vec3 a = n.cwiseProduct(group.axis_lo), b = n.cwiseProduct(group.axis_hi);
  const double u = normal.dot(group.representative.axis);
  const double u_lo = std::max(-1.0, u + a.cwiseMin(b).sum());
  const double u_hi = std::min(1.0, u + a.cwiseMax(b).sum());
  // Heights count with the largest n.axis, radii with the one nearest to zero.
  const double nearest = std::clamp(0.0, std::min(u_lo, u_hi), u_hi);
  return tip + body.support(std::sqrt(std::max(0.0, 1.0 - nearest * nearest)), u_hi);
}

PoseTree::PoseTree(const ToolPath& path, std::span<const Box> boxes,
                   std::vector<std::uint32_t> segments, double reach)
    : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  groups_.reserve(segments_.size() + 1);
  groups_.resize(1);
  Builder(path, boxes, segments_, reach, groups_)
      .build(0, 0, static_cast<std::uint32_t>(segments_.size()));
  groups_.shrink_to_fit();
}

}  // namespace frustum::cutter
