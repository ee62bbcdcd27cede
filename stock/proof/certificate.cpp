#include "stock/proof/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "core/golden_section.hpp"
#include "cutter/sweep/concave_sweep.hpp"
#include "stock/proof/blank_side.hpp"
#include "stock/proof/clearance_proof.hpp"

namespace frustum::stock {
namespace {

using kinematics::ToolPath;
using kinematics::ToolPose;

// Above the rounding of a distance in double precision.
constexpr double kCertificateRounding = 1e-9;  // mm
constexpr std::uint32_t kFewSegments = 8;
// A corner of the material has few faces; each failure adds the one that was missed.
constexpr int kDirections = 12;

PoseSpan span_of(const ToolPath& path, std::uint32_t segment) {
  const kinematics::PathSegment& s = path.segments[segment];
  return PoseSpan::of(path.from(s), path.to(s));
}

ToolPose pose_at(const ToolPath& path, std::uint32_t segment, double t) {
  const kinematics::PathSegment& s = path.segments[segment];
  return kinematics::between(path.from(s), path.to(s), t);
}

// Segments that follow each other, and how far the cutter gets from its place at one pose among
// them.
struct Group {
  ToolPose representative{};
  double shift = 0.0;  // of any point of the cutter, mm
  std::uint32_t first = 0, last = 0;
  std::uint32_t second_child = 0;  // 0: a leaf
};

}  // namespace

struct Certifier::Tool {
  BodyGeneratrix body;
  std::vector<std::uint32_t> segments{};
  std::vector<Group> groups{};

  explicit Tool(const cutter::Body& of) : body(of) {}

  void build(const ToolPath& path, std::uint32_t first, std::uint32_t last) {
    const std::size_t index = groups.size();
    Group group{.representative = path.from(path.segments[segments[(first + last) / 2]]),
                .first = first,
                .last = last};
    const double reach = body.generatrix->reach();
    const auto include = [&](const ToolPose& pose) {
      const double moved = (pose.tip - group.representative.tip).norm() +
                           reach * (pose.axis - group.representative.axis).norm();
      group.shift = std::max(group.shift, moved);
    };
    // Between two poses the tip is between the tips; axes in a cap of less than a right angle stay
    // in it.
    for (std::uint32_t i = first; i < last; ++i) {
      include(path.from(path.segments[segments[i]]));
      include(path.to(path.segments[segments[i]]));
    }
    if (group.shift > reach) group.shift += 2.0 * reach;
    groups.push_back(group);
    if (last - first <= kFewSegments) return;
    build(path, first, (first + last) / 2);
    groups[index].second_child = static_cast<std::uint32_t>(groups.size());
    build(path, (first + last) / 2, last);
  }
};

// Whether the cutters stay clear of a point, and which one does not.
struct Certifier::Search {
  Vec3 point;
  double margin = 0.0;
  std::size_t most_spans = 0;
  Clearance clearance = Clearance::apart;
  std::uint32_t segment = 0;
  double t = 0.0;
  std::size_t spans = 0;
  std::size_t segments = 0;
};

Certifier::Certifier(const Workpiece& workpiece, const CertifierOptions& options)
    : workpiece_(&workpiece), options_(options) {
  const ToolPath& path = workpiece.removed().path();
  std::map<int, std::shared_ptr<Tool>> by_number;
  const std::size_t end = std::min<std::size_t>(path.segments.size(), options.first_excluded);
  for (std::uint32_t i = 0; i < end; ++i) {
    const int number = path.blocks[path.segments[i].block].tool;
    auto& tool = by_number[number];
    if (!tool) tool = std::make_shared<Tool>(workpiece.removed().tool(number).body());
    tool->segments.push_back(i);
  }
  for (auto& [number, tool] : by_number) {
    tool->groups.reserve(tool->segments.size() / 2 + 1);
    tool->build(path, 0, static_cast<std::uint32_t>(tool->segments.size()));
    tools_.push_back(std::move(tool));
  }
}

void Certifier::prove_clear_of(const Tool& tool, Search& search) const {
  const ToolPath& path = workpiece_->removed().path();
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    open.pop_back();
    const Group& group = tool.groups[index];
    const double enough = group.shift + search.margin + kCertificateRounding;
    const double from_tip = (search.point - group.representative.tip).norm();
    if (from_tip - tool.body.generatrix->reach() > enough) continue;
    if (distance_from(tool.body, group.representative.tip, group.representative.axis,
                      search.point) > enough) {
      continue;
    }
    if (group.second_child != 0) {
      open.push_back(group.second_child);
      open.push_back(index + 1);
      continue;
    }
    for (std::uint32_t i = group.first; i < group.last; ++i) {
      const std::uint32_t segment = tool.segments[i];
      const ClearanceProof found = prove_clearance(tool.body, span_of(path, segment), search.point,
                                                   search.margin, search.most_spans - search.spans);
      search.spans = std::min(search.most_spans, search.spans + found.spans);
      ++search.segments;
      if (found.clearance == Clearance::apart) continue;
      search.clearance = found.clearance;
      search.segment = segment;
      search.t = found.t;
      return;
    }
  }
}

namespace {

// The deepest place near t: a walk downhill to either side, then a golden section.
double deepest_near(const BodyGeneratrix& body, const ToolPath& path, std::uint32_t segment,
                    double t, const Vec3& point) {
  const auto depth = [&](double at) {
    const ToolPose pose = pose_at(path, segment, at);
    return distance_from(body, pose.tip, pose.axis, point);
  };
  const auto walked = [&](double way) {
    double here = t;
    for (double step = 1e-6; step < 1.0; step *= 2.0) {
      const double next = std::clamp(here + way * step, 0.0, 1.0);
      if (next == here || depth(next) > depth(here)) return next;
      here = next;
    }
    return here;
  };
  return golden_section(depth, walked(-1.0), walked(1.0), 0.0, 60).middle();
}

}  // namespace

// The claim that a point is within its bound of the surface, and what was found out about it.
struct Certifier::Claim {
  const Certifier& certifier;
  const SurfacePoint& point;
  const Tool* originating_block = nullptr;
  Certificate answer{};

  [[nodiscard]] const ToolPath& path() const { return certifier.workpiece_->removed().path(); }
  [[nodiscard]] const Blank& blank() const { return certifier.workpiece_->blank(); }
  [[nodiscard]] double bound() const { return point.sweep_bound; }
  [[nodiscard]] std::uint32_t line_of(std::uint32_t segment) const {
    return path().blocks[path().segments[segment].block].source_line;
  }

  Search search(const Vec3& at, double margin) {
    Search s{.point = at, .margin = margin, .most_spans = certifier.options_.most_spans};
    s.most_spans -= std::min(s.most_spans, answer.spans);
    for (const auto& tool : certifier.tools_) {
      if (s.clearance == Clearance::apart) certifier.prove_clear_of(*tool, s);
    }
    answer.spans += s.spans;
    answer.segments += s.segments;
    return s;
  }

  void refute(std::string reason) {
    answer.verdict = Verdict::refuted;
    answer.reason = std::move(reason);
  }

  [[nodiscard]] bool is_void(const Vec3& direction) const {
    const Vec3 at = point.point + bound() * direction;
    if (originating_block == nullptr) return side_of(blank(), at, 0.0).outside;
    return surely_inside(originating_block->body, span_of(path(), *point.segment), point.t, at);
  }

  // (a): along the normal; on a rim, where the normal may be that of a face, anywhere in the
  // cutter.
  bool void_is_near() {
    answer.regular = is_void(point.normal);
    if (answer.regular || originating_block == nullptr) return answer.regular;
    const ToolPose pose = pose_at(path(), *point.segment, point.t);
    const Vec3 m = point.point - pose.tip;
    const Vec3 across = m - m.dot(pose.axis) * pose.axis;
    const Vec3 side = across.norm() > 0.0 ? across.normalized() : perpendicular_to(pose.axis);
    constexpr int kWays = 16;
    for (int k = 0; k < kWays; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / kWays;
      if (is_void(std::cos(turn) * side + std::sin(turn) * pose.axis)) return true;
    }
    return false;
  }

  // Without a void: is all within the bound material, or beside the blank?
  void look_for_refutation() {
    const BlankSide side = side_of(blank(), point.point, bound());
    if (side.outside) return refute("it is outside the blank by more than the bound");
    if (side.inside && search(point.point, bound()).clearance == Clearance::apart) {
      return refute("everything within the bound is material");
    }
    answer.reason = "no point within the bound was shown to be void";
  }

  // (b): a direction in which there is material. What is in the way turns the next try away from
  // it.
  void find_material() {
    Vec3 into = -point.normal;
    for (int k = 0; k < kDirections && answer.verdict == Verdict::open; ++k) {
      if (k > 0) answer.regular = false;
      const Vec3 at = point.point + bound() * into;
      const BlankSide side = side_of(blank(), at, 0.0);
      if (!side.inside) {
        answer.reason = "no material of the blank was found within the bound";
        if (side_of(blank(), point.point, bound()).outside) look_for_refutation();
        into = (into - side.outward).normalized();
        continue;
      }
      const Search s = search(at, 0.0);
      if (s.clearance == Clearance::apart) {
        answer.verdict = Verdict::proven;
        answer.reason.clear();
      } else if (s.clearance == Clearance::open && answer.spans >= certifier.options_.most_spans) {
        answer.reason = fmt::format("line {} was not shown to stay clear within {} spans of time",
                                    line_of(s.segment), certifier.options_.most_spans);
        return;
      } else {
        meet(s, at);
        const Tool& tool = *certifier.tool_of(s.segment);
        const ToolPose pose = pose_at(path(), s.segment, s.t);
        into = (into + cutter::generatrix_normal(*tool.body.generatrix, pose, at)).normalized();
      }
    }
  }

  // A cutter covers the point that should be material: perhaps all that is within the bound.
  void meet(const Search& s, const Vec3& at) {
    const BodyGeneratrix& body = certifier.tool_of(s.segment)->body;
    const PoseSpan span = span_of(path(), s.segment);
    answer.reason = fmt::format("no material was found within the bound: line {} cuts there",
                                line_of(s.segment));
    for (const double from : {s.t, s.segment == point.segment ? point.t : s.t}) {
      const double t = deepest_near(body, path(), s.segment, from, at);
      if (!surely_inside(body, span, t, point.point, bound())) continue;
      return refute(
          fmt::format("line {} cuts away everything within the bound", line_of(s.segment)));
    }
  }
};

const Certifier::Tool* Certifier::tool_of(std::uint32_t segment) const {
  for (const auto& tool : tools_) {
    if (std::binary_search(tool->segments.begin(), tool->segments.end(), segment)) {
      return tool.get();
    }
  }
  return nullptr;
}

Certificate Certifier::certify(const SurfacePoint& point) const {
  if (!point.point.allFinite() || !point.normal.allFinite() || !(point.sweep_bound > 0.0)) {
    return {.reason = "it is no surface point with a bound"};
  }
  Claim claim{*this, point, point.segment ? tool_of(*point.segment) : nullptr};
  if (point.segment && claim.originating_block == nullptr) {
    return {.reason = "the path segment that is said to have made it has not cut"};
  }
  if (claim.void_is_near()) {
    claim.find_material();
  } else {
    claim.look_for_refutation();
  }
  claim.answer.regular = claim.answer.regular && claim.answer.verdict == Verdict::proven;
  return std::move(claim.answer);
}

}  // namespace frustum::stock
