#include "cutter/search/pose_tree.hpp"

#include <oneapi/tbb/parallel_invoke.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cutter/sweep/swept_box.hpp"

namespace frustum::cutter {
namespace {

using kinematics::PathSegment;
using kinematics::ToolPath;

constexpr std::uint32_t kLeaf = kMostInLeaf;
// Groups of fewer segments are not worth a task of their own.
constexpr std::uint32_t kTask = 4096;
// So many segments say which way a group extends.
constexpr std::uint32_t kSampled = 512;

// Pairs under a group of so many segments. Halved again and again they come in two sizes, n and
// n + 1.
std::uint32_t pairs_under(std::uint32_t count) {
  std::uint32_t pairs = 0, n = count, of_n = 1, of_more = 0;
  while (n + (of_more > 0 ? 1 : 0) > kLeaf) {
    const std::uint32_t split_n = n > kLeaf ? of_n : 0;
    pairs += split_n + of_more;
    // Halves of n: n / 2 and n - n / 2; of n + 1 likewise.
    const bool even = n % 2 == 0;
    of_n = 2 * split_n - (even ? 0 : split_n) + (even ? of_more : 0);
    of_more = even ? of_more : split_n + 2 * of_more;
    n /= 2;
  }
  return pairs;
}

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

float above(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded >= x ? rounded : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}
float below(double x) { return -above(-x); }

struct Range {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = -lo;

  void add(const Vec3& v) {
    lo = lo.cwiseMin(v);
    hi = hi.cwiseMax(v);
  }
  [[nodiscard]] Vec3 middle() const { return 0.5 * (lo + hi); }
  [[nodiscard]] Vec3 half_about(const Vec3& centre) const {
    return (hi - centre).cwiseMax(centre - lo);
  }
};

Vec3 single(const Vec3& v) { return v.cast<float>().cast<double>(); }

// Where a group is in the tree.
struct Place {
  std::uint32_t pair;
  std::size_t half;
};

class Builder {
 public:
  Builder(const ToolPath& path, std::vector<std::uint32_t>& order, const Body& body,
          std::vector<GroupPair>& pairs)
      : path_(path),
        order_(order),
        extent_{0.0, body.height(), body.max_radius()},
        reach_(body.reach()),
        pairs_(pairs),
        keyed_(order.size()) {}

  // Of the segments from `first` on; what is under it goes to the pairs from `free` on.
  void build(Place place, std::uint32_t first, std::uint32_t count, std::uint32_t free) {
    Scatter tips, axes;
    const Vec3 centre = from(first).tip;  // keeps the products small
    bool turns = false;
    for (std::uint32_t i = first; i < first + count; i += 1 + count / kSampled) {
      tips.add(from(i).tip - centre);
      tips.add(to(i).tip - centre);
      axes.add(reach_ * from(i).axis);
      axes.add(reach_ * to(i).axis);
      turns = turns || from(i).axis != from(first).axis || to(i).axis != from(first).axis;
    }
    Eigen::SelfAdjointEigenSolver<Mat3> spread, turning;
    spread.computeDirect(tips.covariance());
    describe(place, first, count, spread.eigenvectors());
    GroupPair& pair = pairs_[place.pair];
    if (count <= kLeaf) {
      pair.next[place.half] = first;
      pair.count[place.half] = static_cast<std::uint16_t>(count);
      finish_leaf(place, first, count);
      return;
    }
    Vec3 direction = spread.eigenvectors().col(2);
    bool by_place = true;
    if (turns) {
      turning.computeDirect(axes.covariance());
      by_place = spread.eigenvalues()[2] >= turning.eigenvalues()[2];
      if (!by_place) direction = turning.eigenvectors().col(2);
    }
    const std::uint32_t half = count / 2;
    part(first, count, half, direction, by_place);
    const std::uint32_t left = free + 1, right = left + pairs_under(half);
    const auto build_left = [&] { build({free, 0}, first, half, left); };
    const auto build_right = [&] { build({free, 1}, first + half, count - half, right); };
    if (count > kTask) {
      tbb::parallel_invoke(build_left, build_right);
    } else {
      build_left();
      build_right();
    }
    const GroupPair& children = pairs_[free];
    for (std::size_t k = 0; k < 3; ++k) {
      pair.box_min[k][place.half] = std::min(children.box_min[k][0], children.box_min[k][1]);
      pair.box_max[k][place.half] = std::max(children.box_max[k][0], children.box_max[k][1]);
    }
    pair.earliest[place.half] = std::min(children.earliest[0], children.earliest[1]);
    pair.next[place.half] = free;
  }

 private:
  struct Keyed {
    double key;
    std::uint32_t segment;
    bool operator<(const Keyed& b) const {
      return key < b.key || (key == b.key && segment < b.segment);
    }
  };

  [[nodiscard]] const ToolPose& from(std::uint32_t i) const {
    return path_.from(path_.segments[order_[i]]);
  }
  [[nodiscard]] const ToolPose& to(std::uint32_t i) const {
    return path_.to(path_.segments[order_[i]]);
  }

  // Those that are farther back along the direction come first.
  void part(std::uint32_t first, std::uint32_t count, std::uint32_t half, const Vec3& direction,
            bool by_place) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      keyed_[i] = {by_place ? direction.dot(from(i).tip + to(i).tip)
                            : direction.dot(from(i).axis + to(i).axis),
                   order_[i]};
    }
    const auto begin = keyed_.begin() + first;
    std::nth_element(begin, begin + half, begin + count);
    for (std::uint32_t i = first; i < first + count; ++i) order_[i] = keyed_[i].segment;
  }

  void finish_leaf(Place place, std::uint32_t first, std::uint32_t count) {
    GroupPair& pair = pairs_[place.pair];
    std::uint32_t earliest = order_[first];
    Box box = box_of(first);
    for (std::uint32_t i = first + 1; i < first + count; ++i) {
      earliest = std::min(earliest, order_[i]);
      box = united(box, box_of(i));
    }
    pair.earliest[place.half] = earliest;
    for (int k = 0; k < 3; ++k) {
      pair.box_min[static_cast<std::size_t>(k)][place.half] = below(box.min[k]);
      pair.box_max[static_cast<std::size_t>(k)][place.half] = above(box.max[k]);
    }
  }
  [[nodiscard]] Box box_of(std::uint32_t i) const {
    return swept_box(extent_, SegmentMotion(from(i), to(i), reach_));
  }

  // All but the box and where it leads.
  void describe(Place place, std::uint32_t first, std::uint32_t count, const Mat3& directions) {
    Mat3 frame = Mat3::Identity();
    if (directions.allFinite() &&
        std::abs(directions.determinant() * directions.determinant() - 1.0) < 1e-3) {
      const Vec3 one = single(directions.col(0)), two = single(directions.col(1));
      frame << one, two, one.cross(two);
    }
    const Mat3 to_frame = frame.inverse();
    const ToolPose start = from(first);
    Range tips, axes;
    double sagitta = 0.0;
    for (std::uint32_t i = first; i < first + count; ++i) {
      for (const ToolPose* pose : {&from(i), &to(i)}) {
        tips.add(to_frame * (pose->tip - start.tip));
        axes.add(to_frame * (pose->axis - start.axis));
      }
      // Between its ends the axis runs on an arc: at most 1 - cos(turn / 2) beside the chord.
      const double chord2 = (to(i).axis - from(i).axis).squaredNorm();
      if (chord2 > 0.0) {
        sagitta = std::max(sagitta, 1.0 - std::sqrt(std::max(0.0, 1.0 - chord2 / 4.0)));
      }
    }
    const ToolPose middle{single(start.tip + frame * tips.middle()),
                          single(start.axis + frame * axes.middle())};
    // Above the rounding of what they are made of.
    const double tip_rounding = 1e-15 * (start.tip.lpNorm<1>() + middle.tip.lpNorm<1>());
    constexpr double kAxisRounding = 4e-15;
    const bool one_axis = sagitta == 0.0 && axes.lo == axes.hi && middle.axis == start.axis;
    const Vec3 tip_half = tips.half_about(to_frame * (middle.tip - start.tip));
    const Vec3 axis_half = axes.half_about(to_frame * (middle.axis - start.axis));

    // The representative is the one nearest to the middle.
    std::uint32_t representative = first;
    double nearest2 = std::numeric_limits<double>::infinity();
    double tip_shift2 = 0.0, axis_shift2 = 0.0, tip_turn2 = 0.0;
    for (std::uint32_t i = first; i < first + count; ++i) {
      double tip2 = 0.0, axis2 = 0.0;
      for (const ToolPose* pose : {&to(i), &from(i)}) {
        const double tip_of2 = (pose->tip - middle.tip).squaredNorm();
        const double axis_of2 = (pose->axis - middle.axis).squaredNorm();
        tip2 = std::max(tip2, tip_of2);
        axis2 = std::max(axis2, axis_of2);
        const double away2 = tip_of2 + reach_ * reach_ * axis_of2;
        if (pose == &from(i) && away2 < nearest2) {
          nearest2 = away2;
          representative = i;
        }
      }
      tip_shift2 = std::max(tip_shift2, tip2);
      axis_shift2 = std::max(axis_shift2, axis2);
      tip_turn2 = std::max(tip_turn2, tip2 * axis2);
    }
    const double tip_shift = std::sqrt(tip_shift2) + tip_rounding;
    const double axis_shift = one_axis ? 0.0 : std::sqrt(axis_shift2) + sagitta + kAxisRounding;
    const ToolPose& at = from(representative);
    GroupPair& pair = pairs_[place.pair];
    const std::size_t half = place.half;
    for (int k = 0; k < 3; ++k) {
      const auto d = static_cast<std::size_t>(k);
      pair.tip[d][half] = static_cast<float>(middle.tip[k]);
      pair.axis[d][half] = static_cast<float>(middle.axis[k]);
      pair.first_column[d][half] = static_cast<float>(frame(k, 0));
      pair.second_column[d][half] = static_cast<float>(frame(k, 1));
      pair.tip_half[d][half] = above(tip_half[k] + tip_rounding);
      pair.axis_half[d][half] =
          one_axis ? 0.0F : above(axis_half[k] + 1.001 * sagitta + kAxisRounding);
    }
    pair.axis_shift[half] = above(axis_shift);
    pair.tip_turn[half] = one_axis ? 0.0F
                                   : above(std::sqrt(tip_turn2) + tip_rounding * axis_shift +
                                           tip_shift * (1.001 * sagitta + kAxisRounding));
    pair.shift[half] = above(tip_shift + (at.tip - middle.tip).norm() +
                             reach_ * (axis_shift + (at.axis - middle.axis).norm()));
    pair.representative_segment[half] = order_[representative];
  }

  const ToolPath& path_;
  std::vector<std::uint32_t>& order_;
  AxialExtent extent_;
  double reach_;
  std::vector<GroupPair>& pairs_;
  std::vector<Keyed> keyed_;
};

}  // namespace

PoseTree::PoseTree(const ToolPath& path, std::vector<std::uint32_t> segments, const Body& body)
    : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  const auto count = static_cast<std::uint32_t>(segments_.size());
  pairs_.resize(1 + pairs_under(count));
  pairs_.front().earliest[1] = std::numeric_limits<std::uint32_t>::max();
  Builder(path, segments_, body, pairs_).build({0, 0}, 0, count, 1);
}

}  // namespace frustum::cutter
