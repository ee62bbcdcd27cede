#include "metrology/fit/unmet_constraints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace frustum::metrology {
namespace {

// Differences of noisy fits stay below a hundredth of the size, or of a radian.
constexpr double kApart = 0.01;

std::string text(const Vec3& v) {
  const Vec3 shown = (v.array().abs() < 1e-9).select(0.0, v);
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", shown.x(), shown.y(), shown.z());
}

double sine(const UnitVec3& a, const UnitVec3& b) { return a.vec().cross(b.vec()).norm(); }

struct Unmet {
  std::vector<std::string> asked{};
  std::vector<std::string_view> names{};

  void add(std::string_view name, std::string what) {
    names.push_back(name);
    asked.push_back(std::move(what));
  }
};

void add_directions(Unmet& all, const Constraints& keep, const UnitVec3& axis) {
  if (keep.parallel_to && sine(axis, *keep.parallel_to) > kApart) {
    all.add("parallel_to", fmt::format("an axis along {}, kept is one parallel to {}",
                                       text(axis.vec()), text(keep.parallel_to->vec())));
  }
  if (keep.perpendicular_to && std::abs(axis.vec().dot(keep.perpendicular_to->vec())) > kApart) {
    all.add("perpendicular_to", fmt::format("an axis along {}, kept is one perpendicular to {}",
                                            text(axis.vec()), text(keep.perpendicular_to->vec())));
  }
}

void add_axis(Unmet& all, const Line& kept, const Vec3& point, const UnitVec3& axis, double size) {
  const Vec3 away = (point - kept.point).cross(kept.axis.vec());
  if (sine(axis, kept.axis) < kApart && away.norm() < kApart * size) return;
  all.add("axis",
          fmt::format("an axis along {} through {}, kept is one along {} through {}",
                      text(axis.vec()), text(point), text(kept.axis.vec()), text(kept.point)));
}

void add_length(Unmet& all, std::string_view name, const std::optional<double>& kept, double free) {
  if (!kept || std::abs(*kept - free) < kApart * free) return;
  all.add(name, fmt::format("a {} of {:.6g} mm, kept is {:.6g} mm", name, free, *kept));
}

Unmet unmet_by(const Element& free, const Constraints& keep) {
  return std::visit(
      [&](const auto& e) {
        Unmet all;
        if constexpr (requires { e.axis; }) add_directions(all, keep, e.axis);
        if constexpr (requires {
                        e.axis;
                        e.radius;
                      }) {
          if (keep.axis) add_axis(all, *keep.axis, e.point, e.axis, e.radius);
        }
        if constexpr (requires { e.radius; }) add_length(all, "radius", keep.radius, e.radius);
        if constexpr (requires { e.tube_radius; }) {
          add_length(all, "tube_radius", keep.tube_radius, e.tube_radius);
        }
        if constexpr (requires { e.half_angle; }) {
          if (keep.half_angle && std::abs(*keep.half_angle - e.half_angle) > kApart) {
            all.add("half_angle",
                    fmt::format("a half_angle of {:.6g} deg, kept is {:.6g} deg",
                                e.half_angle * kDegPerRad, *keep.half_angle * kDegPerRad));
          }
        }
        return all;
      },
      free);
}

}  // namespace

std::optional<Diagnostic> unmet(const Constraints& keep, const Element& free,
                                std::string_view what) {
  const Unmet all = unmet_by(free, keep);
  if (all.names.empty()) return std::nullopt;
  return error("constraints-unmet"_id,
               fmt::format("the points contradict what the {} is to keep: they ask for {}", what,
                           fmt::join(all.asked, "; for ")),
               fmt::format("leave out {}, or check the points", fmt::join(all.names, " and ")));
}

}  // namespace frustum::metrology
