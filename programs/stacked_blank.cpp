#include "programs/stacked_blank.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace frustum::programs {
namespace {

using Facet = stock::FacetSolid::Facet;

double angle_of(const Vec3& p) { return std::atan2(p.y(), p.x()); }

// Of all corners, in order.
std::vector<double> directions(const std::vector<const Outline*>& outlines) {
  std::vector<double> all;
  for (const Outline* outline : outlines) {
    for (const Vec3& corner : *outline) all.push_back(angle_of(corner));
  }
  std::ranges::sort(all);
  constexpr double kSame = 1e-9;  // rad
  const auto are_same = [](double a, double b) { return b - a < kSame; };
  all.erase(std::unique(all.begin(), all.end(), are_same), all.end());
  return all;
}

// Where a ray from the axis meets the outline.
Vec3 met(const Outline& outline, double angle) {
  const Vec3 ray(std::cos(angle), std::sin(angle), 0.0);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double beside_a = ray.x() * a.y() - ray.y() * a.x();
    const double beside_b = ray.x() * b.y() - ray.y() * b.x();
    constexpr double kCorner = 1e-9;  // mm
    if (!(beside_a <= kCorner && beside_b >= -kCorner && beside_b > beside_a)) continue;
    const double share = std::clamp(beside_a / (beside_a - beside_b), 0.0, 1.0);
    const Vec3 place = a + share * (b - a);
    if (place.dot(ray) > 0.0) return {place.x(), place.y(), 0.0};
  }
  return Vec3::Zero();
}

class Stack {
 public:
  explicit Stack(std::vector<double> angles) : angles_(std::move(angles)) {}

  // The outline at a height; a wall or a ledge leads there from the one before.
  void go_to(const Outline& outline, double z) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    for (const double angle : angles_) vertices_.push_back(met(outline, angle) + z * Vec3::UnitZ());
    if (last_ != kNone) join(last_, first);
    if (first_ == kNone) first_ = first;
    last_ = first;
  }
  // Down the bore: the last row meets the first.
  void close() { join(last_, first_); }
  void cap_top(double z) { fan(first_, z, true); }
  void cap_bottom(double z) { fan(last_, z, false); }

  [[nodiscard]] stock::FacetSolid solid() && { return {std::move(vertices_), std::move(facets_)}; }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  // Seen from outside the first row is above, or within on a ledge.
  void join(std::uint32_t upper, std::uint32_t lower) {
    const auto count = static_cast<std::uint32_t>(angles_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t j = (i + 1) % count;
      facets_.push_back({upper + i, lower + i, lower + j});
      facets_.push_back({upper + i, lower + j, upper + j});
    }
  }
  void fan(std::uint32_t row, double z, bool up) {
    const auto centre = static_cast<std::uint32_t>(vertices_.size());
    vertices_.emplace_back(0.0, 0.0, z);
    const auto count = static_cast<std::uint32_t>(angles_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t a = row + i, b = row + (i + 1) % count;
      facets_.push_back(up ? Facet{centre, a, b} : Facet{centre, b, a});
    }
  }

  std::vector<double> angles_;
  std::vector<Vec3> vertices_{};
  std::vector<Facet> facets_{};
  std::uint32_t first_ = kNone, last_ = kNone;
};

}  // namespace

stock::FacetSolid stacked_blank(const std::vector<StackLevel>& levels, double top,
                                const Outline& bore) {
  std::vector<const Outline*> outlines;
  for (const StackLevel& level : levels) outlines.push_back(&level.outline);
  if (!bore.empty()) outlines.push_back(&bore);
  Stack stack(directions(outlines));
  if (!bore.empty()) stack.go_to(bore, top);
  double z = top;
  for (const StackLevel& level : levels) {
    stack.go_to(level.outline, z);
    z = level.bottom;
    stack.go_to(level.outline, z);
  }
  if (bore.empty()) {
    stack.cap_top(top);
    stack.cap_bottom(z);
  } else {
    stack.go_to(bore, z);
    stack.close();
  }
  return std::move(stack).solid();
}

}  // namespace frustum::programs
