#include "stock/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "cutter/carved_sweep.hpp"
#include "stock/blank_side.hpp"
#include "stock/keep_off.hpp"

namespace frustum::stock {
namespace {

using kinematics::ToolPath;
using kinematics::ToolPose;

// Above the rounding of a distance in double precision.
constexpr double kRounding = 1e-9;  // mm
constexpr std::uint32_t kFewStretches = 8;
// A corner of the material has few faces; each failure adds the one that was missed.
constexpr int kDirections = 12;

PoseSpan span_of(const ToolPath& path, std::uint32_t stretch) {
  const kinematics::Stretch& s = path.stretches[stretch];
  return PoseSpan::of(path.from(s), path.to(s));
}

ToolPose pose_at(const ToolPath& path, std::uint32_t stretch, double t) {
  const kinematics::Stretch& s = path.stretches[stretch];
  return kinematics::between(path.from(s), path.to(s), t);
}

// Stretches that follow each other, and how far the cutter gets from its place at one pose among them.
struct Group {
  ToolPose witness{};
  double shift = 0.0;  // of any point of the cutter, mm
  std::uint32_t first = 0, last = 0;
  std::uint32_t second_child = 0;  // 0: a leaf
};

}  // namespace

struct Certifier::Tool {
  BodyOutline body;
  std::vector<std::uint32_t> stretches{};
  std::vector<Group> groups{};

  explicit Tool(const cutter::Body& of) : body(of) {}

  void build(const ToolPath& path, std::uint32_t first, std::uint32_t last) {
    const std::size_t index = groups.size();
    Group group{.witness = path.from(path.stretches[stretches[(first + last) / 2]]),
                .first = first,
                .last = last};
    const double reach = body.outline->reach();
    const auto include = [&](const ToolPose& pose) {
      const double moved = (pose.tip - group.witness.tip).norm() +
                           reach * (pose.axis - group.witness.axis).norm();
      group.shift = std::max(group.shift, moved);
    };
    // Between two poses the tip is between the tips; axes in a cap of less than a right angle stay in it.
    for (std::uint32_t i = first; i < last; ++i) {
      include(path.from(path.stretches[stretches[i]]));
      include(path.to(path.stretches[stretches[i]]));
    }
    if (group.shift > reach) group.shift += 2.0 * reach;
    groups.push_back(group);
    if (last - first <= kFewStretches) return;
    build(path, first, (first + last) / 2);
    groups[index].second_child = static_cast<std::uint32_t>(groups.size());
    build(path, (first + last) / 2, last);
  }
};

// Whether the cutters keep off a point, and which one does not.
struct Certifier::Search {
  Vec3 point;
  double margin = 0.0;
  std::size_t most_spans = 0;
  Keeping keeping = Keeping::apart;
  std::uint32_t stretch = 0;
  double t = 0.0;
  std::size_t spans = 0;
  std::size_t stretches = 0;
};

Certifier::Certifier(const Workpiece& workpiece, const CertifierOptions& options)
    : workpiece_(&workpiece), options_(options) {
  const ToolPath& path = workpiece.removed().path();
  std::map<int, std::shared_ptr<Tool>> by_number;
  const std::size_t end = std::min<std::size_t>(path.stretches.size(), options.first_excluded);
  for (std::uint32_t i = 0; i < end; ++i) {
    const int number = path.blocks[path.stretches[i].block].tool;
    auto& tool = by_number[number];
    if (!tool) tool = std::make_shared<Tool>(workpiece.removed().tool(number).body());
    tool->stretches.push_back(i);
  }
  for (auto& [number, tool] : by_number) {
    tool->groups.reserve(tool->stretches.size() / 2 + 1);
    tool->build(path, 0, static_cast<std::uint32_t>(tool->stretches.size()));
    tools_.push_back(std::move(tool));
  }
}

void Certifier::keep_off(const Tool& tool, Search& search) const {
  const ToolPath& path = workpiece_->removed().path();
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    open.pop_back();
    const Group& group = tool.groups[index];
    const double enough = group.shift + search.margin + kRounding;
    const double from_tip = (search.point - group.witness.tip).norm();
    if (from_tip - tool.body.outline->reach() > enough) continue;
    if (distance_from(tool.body, group.witness.tip, group.witness.axis, search.point) > enough) {
      continue;
    }
    if (group.second_child != 0) {
      open.push_back(group.second_child);
      open.push_back(index + 1);
      continue;
    }
    for (std::uint32_t i = group.first; i < group.last; ++i) {
      const std::uint32_t stretch = tool.stretches[i];
      const KeepOff found = keeps_off(tool.body, span_of(path, stretch), search.point,
                                      search.margin, search.most_spans - search.spans);
      search.spans = std::min(search.most_spans, search.spans + found.spans);
      ++search.stretches;
      if (found.keeping == Keeping::apart) continue;
      search.keeping = found.keeping;
      search.stretch = stretch;
      search.t = found.t;
      return;
    }
  }
}

namespace {

// The deepest moment near t, by a walk downhill and a golden section.
double deepest_near(const BodyOutline& body, const ToolPath& path, std::uint32_t stretch, double t,
                    const Vec3& point) {
  const auto depth = [&](double at) {
    const ToolPose pose = pose_at(path, stretch, at);
    return distance_from(body, pose.tip, pose.axis, point);
  };
  double lo = t, hi = t;
  for (const double way : {-1.0, 1.0}) {
    double step = 1e-6, here = t, value = depth(t);
    for (int i = 0; i < 40; ++i) {
      const double next = std::clamp(here + way * step, 0.0, 1.0);
      const double there = depth(next);
      (way < 0.0 ? lo : hi) = next;
      if (there > value || next == here) break;
      here = next;
      value = there;
      step *= 2.0;
    }
  }
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo);
    (depth(a) < depth(b) ? hi : lo) = depth(a) < depth(b) ? b : a;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

Certificate Certifier::certify(const SurfacePoint& point) const {
  if (!point.point.allFinite() || !point.normal.allFinite() || !(point.sweep_bound > 0.0)) {
    return {.reason = "it is no surface point with a bound"};
  }
  return certified(point);
}

Certificate Certifier::certified(const SurfacePoint& point) const {
  const ToolPath& path = workpiece_->removed().path();
  const Blank& blank = workpiece_->blank();
  const double bound = point.sweep_bound;
  Certificate answer;

  const auto tool_of = [&](std::uint32_t stretch) -> const Tool* {
    for (const auto& tool : tools_) {
      if (std::binary_search(tool->stretches.begin(), tool->stretches.end(), stretch)) {
        return tool.get();
      }
    }
    return nullptr;
  };
  const auto search = [&](const Vec3& at, double margin) {
    Search s{.point = at, .margin = margin, .most_spans = options_.most_spans};
    s.most_spans -= std::min(s.most_spans, answer.spans);
    for (const auto& tool : tools_) {
      if (s.keeping == Keeping::apart) keep_off(*tool, s);
    }
    answer.spans += s.spans;
    answer.stretches += s.stretches;
    return s;
  };

  // (a) The void.
  const Tool* maker = point.stretch ? tool_of(*point.stretch) : nullptr;
  if (point.stretch && maker == nullptr) {
    answer.reason = "the stretch that is said to have made it has not cut";
    return answer;
  }
  const auto is_void = [&](const Vec3& direction) {
    const Vec3 at = point.point + bound * direction;
    if (maker == nullptr) return side_of(blank, at, 0.0).outside;
    return surely_inside(maker->body, span_of(path, *point.stretch), point.t, at);
  };
  answer.regular = is_void(point.normal);
  bool has_void = answer.regular;
  if (!has_void && maker != nullptr) {
    // On a rim the normal may point along a face; some way into the cutter there is.
    const ToolPose pose = pose_at(path, *point.stretch, point.t);
    const Vec3 m = point.point - pose.tip;
    const Vec3 across = m - m.dot(pose.axis) * pose.axis;
    const Vec3 side = across.norm() > 0.0 ? across.normalized() : perpendicular_to(pose.axis);
    for (int k = 0; k < 8 && !has_void; ++k) {
      const double turn = k * 0.25 * 3.14159265358979;
      has_void = is_void(std::cos(turn) * side + std::sin(turn) * pose.axis);
    }
  }
  if (!has_void) {
    const BlankSide side = side_of(blank, point.point, bound);
    const Search s = search(point.point, bound);
    if (side.inside && s.keeping == Keeping::apart) {
      answer.verdict = Verdict::refuted;
      answer.reason = "all of the material within the bound is still there";
    } else if (side.outside && maker == nullptr) {
      answer.verdict = Verdict::refuted;
      answer.reason = "it is outside the blank by more than the bound";
    } else {
      answer.reason = maker == nullptr
                          ? "no point within the bound was shown to be outside the blank"
                          : "no point within the bound was shown to be inside the cutter that made it";
    }
    return answer;
  }

  // (b) The material.
  Vec3 into = -point.normal;
  for (int k = 0; k < kDirections; ++k) {
    const Vec3 at = point.point + bound * into;
    const BlankSide side = side_of(blank, at, 0.0);
    if (!side.inside) {
      answer.regular = false;
      if (side_of(blank, point.point, bound).outside) {
        answer.verdict = Verdict::refuted;
        answer.reason = "it is outside the blank by more than the bound";
        return answer;
      }
      answer.reason = "no material of the blank was found within the bound";
      into = (into - side.outward).normalized();
      continue;
    }
    const Search s = search(at, 0.0);
    if (s.keeping == Keeping::apart) {
      answer.verdict = Verdict::proven;
      answer.reason.clear();
      return answer;
    }
    answer.regular = false;
    if (s.keeping == Keeping::open) {
      answer.reason = fmt::format("not shown within {} spans of time", options_.most_spans);
      return answer;
    }
    const Tool& tool = *tool_of(s.stretch);
    const double t = deepest_near(tool.body, path, s.stretch, s.t, point.point);
    if (surely_inside(tool.body, span_of(path, s.stretch), t, point.point, bound)) {
      answer.verdict = Verdict::refuted;
      answer.reason = fmt::format(
          "the cutter takes everything within the bound, in line {}",
          path.blocks[path.stretches[s.stretch].block].source_line);
      return answer;
    }
    answer.reason = fmt::format("no material was found within the bound; line {} cuts there",
                                path.blocks[path.stretches[s.stretch].block].source_line);
    const ToolPose pose = pose_at(path, s.stretch, s.t);
    into = (into + cutter::outline_normal(*tool.body.outline, pose, at)).normalized();
  }
  return answer;
}

}  // namespace frustum::stock
