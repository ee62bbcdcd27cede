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

// The lower quads have four groups each, only the upper ones fewer. So many quads of leaves for so
// many segments; a leaf needs none.
std::uint32_t leaf_quads_of(std::uint32_t segments) {
  constexpr std::uint32_t kMost = kSiblings * kLeaf;  // of a quad of leaves
  return segments <= kLeaf ? 0 : (segments + kMost - 1) / kMost;
}

// Into how many groups one is divided that has so many quads of leaves.
std::uint32_t children_of(std::uint32_t leaf_quads) {
  if (leaf_quads == 1) return kSiblings;
  std::uint32_t most = 1;  // of a child
  while (kSiblings * most < leaf_quads) most *= kSiblings;
  return (leaf_quads + most - 1) / most;
}

// All quads under a group that has so many quads of leaves.
std::uint32_t quads_under(std::uint32_t leaf_quads) {
  if (leaf_quads <= 1) return leaf_quads;
  const std::uint32_t children = children_of(leaf_quads), more = leaf_quads % children;
  const std::uint32_t of_less = quads_under(leaf_quads / children);
  const std::uint32_t of_more = more == 0 ? 0 : quads_under(leaf_quads / children + 1);
  return 1 + (children - more) * of_less + more * of_more;
}

// The segments of a group, and how many quads of leaves they fill.
struct Portion {
  std::uint32_t first = 0, count = 0, leaf_quads = 0;

  // Of the children from number i on what is before number j.
  [[nodiscard]] Portion of_children(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t children = children_of(leaf_quads);
    const auto share = [](std::uint32_t whole, std::uint32_t part, std::uint32_t of) {
      return static_cast<std::uint32_t>(std::uint64_t{whole} * part / of);
    };
    if (leaf_quads == 1) {
      const std::uint32_t from = share(count, i, children);
      return {first + from, share(count, j, children) - from, 0};
    }
    const std::uint32_t from = share(leaf_quads, i, children), to = share(leaf_quads, j, children);
    const std::uint32_t begin = share(count, from, leaf_quads);
    return {first + begin, share(count, to, leaf_quads) - begin, to - from};
  }
};

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

// Out of line: of numbers that it has side by side GCC 12 leaves out that they are rounded.
[[gnu::noinline]] float single(double x) { return static_cast<float>(x); }

float above(double x) {
  const float rounded = single(x);
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

Vec3 single(const Vec3& v) { return {single(v.x()), single(v.y()), single(v.z())}; }

// Where a group is in the tree.
struct Place {
  std::uint32_t quad;
  std::size_t lane;
};

class Builder {
 public:
  Builder(const ToolPath& path, std::vector<std::uint32_t>& order, const Body& body,
          std::vector<GroupQuad>& quads)
      : path_(path),
        order_(order),
        extent_{0.0, body.height(), body.max_radius()},
        reach_(body.reach()),
        quads_(quads),
        keyed_(order.size()) {}

  // What is under the group goes to the quads from `free` on.
  void build(Place place, const Portion& all, std::uint32_t free) {
    const Spread spread = spread_of(all);
    describe(place, all.first, all.count, spread.directions);
    GroupQuad& quad = quads_[place.quad];
    if (all.leaf_quads == 0) {
      quad.next[place.lane] = all.first;
      quad.count[place.lane] = static_cast<std::uint16_t>(all.count);
      finish_leaf(place, all.first, all.count);
      return;
    }
    build_children(free, all, {0, children_of(all.leaf_quads)}, &spread, free + 1);
    const GroupQuad& children = quads_[free];
    for (std::size_t k = 0; k < 3; ++k) {
      quad.box_min[k][place.lane] = *std::ranges::min_element(children.box_min[k]);
      quad.box_max[k][place.lane] = *std::ranges::max_element(children.box_max[k]);
    }
    quad.earliest[place.lane] = *std::ranges::min_element(children.earliest);
    quad.next[place.lane] = free;
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

  // Which way some segments extend, the least first, and which way they are halved.
  struct Spread {
    Mat3 directions = Mat3::Identity();
    Vec3 along = Vec3::Zero();
    bool by_place = true;
  };

  // Some of a group's children.
  struct Siblings {
    std::uint32_t from = 0, to = 0;
  };
  // They go side by side into one quad; `known`: which way they extend, if that is known.
  void build_children(std::uint32_t quad, const Portion& all, const Siblings& some,
                      const Spread* known, std::uint32_t free) {
    const Portion whole = all.of_children(some.from, some.to);
    if (some.to - some.from == 1) {
      build({quad, some.from}, whole, free);
      return;
    }
    const std::uint32_t half = (some.from + some.to) / 2;
    part(whole.first, whole.count, all.of_children(some.from, half).count,
         known != nullptr ? *known : spread_of(whole));
    std::uint32_t free_right = free;
    for (std::uint32_t i = some.from; i < half; ++i)
      free_right += quads_under(all.of_children(i, i + 1).leaf_quads);
    const auto build_left = [&] { build_children(quad, all, {some.from, half}, nullptr, free); };
    const auto build_right = [&] {
      build_children(quad, all, {half, some.to}, nullptr, free_right);
    };
    if (whole.count > kTask) {
      tbb::parallel_invoke(build_left, build_right);
    } else {
      build_left();
      build_right();
    }
  }

  [[nodiscard]] Spread spread_of(const Portion& all) const {
    const std::uint32_t first = all.first, count = all.count;
    Scatter tips, axes;
    const ToolPose& start = from(first);
    bool turns = false;
    // From the first pose, which keeps the products small. Ends of one are mostly another's start.
    const auto add = [&](const ToolPose& pose) {
      tips.add(pose.tip - start.tip);
      axes.add(reach_ * (pose.axis - start.axis));
      turns = turns || pose.axis != start.axis;
    };
    for (std::uint32_t i = first; i < first + count; i += 1 + count / kSampled) add(from(i));
    add(to(first + count - 1));
    Eigen::SelfAdjointEigenSolver<Mat3> places, turning;
    places.computeDirect(tips.covariance());
    Spread spread{places.eigenvectors(), places.eigenvectors().col(2)};
    if (turns) {
      turning.computeDirect(axes.covariance());
      spread.by_place = places.eigenvalues()[2] >= turning.eigenvalues()[2];
      if (!spread.by_place) spread.along = turning.eigenvectors().col(2);
    }
    return spread;
  }

  // Those that are farther back come first.
  void part(std::uint32_t first, std::uint32_t count, std::uint32_t half, const Spread& spread) {
    const Vec3& direction = spread.along;
    for (std::uint32_t i = first; i < first + count; ++i) {
      keyed_[i] = {spread.by_place ? direction.dot(from(i).tip + to(i).tip)
                                   : direction.dot(from(i).axis + to(i).axis),
                   order_[i]};
    }
    const auto begin = keyed_.begin() + first;
    std::nth_element(begin, begin + half, begin + count);
    for (std::uint32_t i = first; i < first + count; ++i) order_[i] = keyed_[i].segment;
  }

  void finish_leaf(Place place, std::uint32_t first, std::uint32_t count) {
    GroupQuad& quad = quads_[place.quad];
    std::uint32_t earliest = order_[first];
    Box box = box_of(first);
    for (std::uint32_t i = first + 1; i < first + count; ++i) {
      earliest = std::min(earliest, order_[i]);
      box = united(box, box_of(i));
    }
    quad.earliest[place.lane] = earliest;
    for (int k = 0; k < 3; ++k) {
      quad.box_min[static_cast<std::size_t>(k)][place.lane] = below(box.min[k]);
      quad.box_max[static_cast<std::size_t>(k)][place.lane] = above(box.max[k]);
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
    GroupQuad& quad = quads_[place.quad];
    const std::size_t lane = place.lane;
    for (int k = 0; k < 3; ++k) {
      const auto d = static_cast<std::size_t>(k);
      quad.tip[d][lane] = single(middle.tip[k]);
      quad.axis[d][lane] = single(middle.axis[k]);
      quad.first_column[d][lane] = single(frame(k, 0));
      quad.second_column[d][lane] = single(frame(k, 1));
      quad.tip_half[d][lane] = above(tip_half[k] + tip_rounding);
      quad.axis_half[d][lane] =
          one_axis ? 0.0F : above(axis_half[k] + 1.001 * sagitta + kAxisRounding);
    }
    quad.axis_shift[lane] = above(axis_shift);
    quad.tip_turn[lane] = one_axis ? 0.0F
                                   : above(std::sqrt(tip_turn2) + tip_rounding * axis_shift +
                                           tip_shift * (1.001 * sagitta + kAxisRounding));
    quad.shift[lane] = above(tip_shift + (at.tip - middle.tip).norm() +
                             reach_ * (axis_shift + (at.axis - middle.axis).norm()));
    quad.representative_segment[lane] = order_[representative];
    quad.representative_pose[lane] = path_.segments[order_[representative]].first_pose;
  }

  const ToolPath& path_;
  std::vector<std::uint32_t>& order_;
  AxialExtent extent_;
  double reach_;
  std::vector<GroupQuad>& quads_;
  std::vector<Keyed> keyed_;
};

}  // namespace

PoseTree::PoseTree(const ToolPath& path, std::vector<std::uint32_t> segments, const Body& body)
    : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  const auto count = static_cast<std::uint32_t>(segments_.size());
  const Portion all{0, count, leaf_quads_of(count)};
  quads_.resize(1 + quads_under(all.leaf_quads));
  Builder(path, segments_, body, quads_).build({0, 0}, all, 1);
}

}  // namespace frustum::cutter
