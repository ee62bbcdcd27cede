#include "tests/calibration/frechet_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustum::calibration {
namespace {

// Of a stretch, 0 to 1; empty when lo is above hi.
struct Interval {
  double lo = 1.0, hi = 0.0;
  [[nodiscard]] bool empty() const { return lo > hi; }
  [[nodiscard]] Interval from(double start) const { return {std::max(lo, start), hi}; }
};

// Where a stretch is within the leash of a place.
Interval free_of(const Vec3& place, const Vec3& from, const Vec3& to, double leash) {
  const Vec3 way = to - from, off = from - place;
  const double a = way.squaredNorm(), half_b = off.dot(way);
  const double c = off.squaredNorm() - leash * leash;
  if (a == 0.0) return c <= 0.0 ? Interval{0.0, 1.0} : Interval{};
  const double root2 = half_b * half_b - a * c;
  if (root2 < 0.0) return {};
  const double root = std::sqrt(root2);
  return {std::max(0.0, (-half_b - root) / a), std::min(1.0, (-half_b + root) / a)};
}

// What can be reached on the stretches of b with a at one of its points, by stretch.
using Reached = std::vector<std::pair<std::size_t, Interval>>;  // in order

class FreeSpace {
 public:
  FreeSpace(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double leash)
      : a_(a), b_(b), leash_(leash) {}

  [[nodiscard]] bool is_passed() const {
    const auto apart = [&](const Vec3& p, const Vec3& q) { return (p - q).norm() > leash_; };
    if (apart(a_.front(), b_.front()) || apart(a_.back(), b_.back())) return false;
    Reached reached;
    for (std::size_t j = 0; j + 1 < b_.size(); ++j) {
      const Interval free = free_of(a_.front(), b_[j], b_[j + 1], leash_);
      if (free.empty() || free.lo > 0.0) break;
      reached.emplace_back(j, free);
      if (free.hi < 1.0) break;
    }
    bool at_start = true;  // b has not gone yet
    for (std::size_t i = 0; i + 1 < a_.size(); ++i) {
      Interval below;
      if (at_start) {
        below = free_of(b_.front(), a_[i], a_[i + 1], leash_);
        if (below.lo > 0.0) below = {};
        at_start = below.hi >= 1.0;
      }
      reached = next(i, reached, below);
      if (reached.empty()) return false;
    }
    const auto& [stretch, end] = reached.back();
    return stretch + 2 == b_.size() && end.hi >= 1.0;
  }

 private:
  // While a goes along its stretch i; `below`: what of it can be reached with b at its start.
  [[nodiscard]] Reached next(std::size_t i, const Reached& reached, Interval below) const {
    Reached result;
    auto left = reached.begin();
    std::size_t j = !below.empty() || left == reached.end() ? 0 : left->first;
    while (j + 1 < b_.size() && (!below.empty() || left != reached.end())) {
      if (below.empty()) j = left->first;
      const bool from_left = left != reached.end() && left->first == j;
      const Interval beside = from_left ? (left++)->second : Interval{};
      const Interval right = free_of(a_[i + 1], b_[j], b_[j + 1], leash_);
      const Interval above = free_of(b_[j + 1], a_[i], a_[i + 1], leash_);
      const Interval reached_right = !below.empty() ? right : right.from(beside.lo);
      if (!reached_right.empty()) result.emplace_back(j, reached_right);
      below = from_left ? above : above.from(below.lo);
      ++j;
    }
    return result;
  }

  const std::vector<Vec3>& a_;
  const std::vector<Vec3>& b_;
  double leash_;
};

}  // namespace

double frechet_distance(std::vector<Vec3> a, std::vector<Vec3> b) {
  if (a.size() == 1) a.push_back(a.front());
  if (b.size() == 1) b.push_back(b.front());
  double lo = 0.0, hi = 1e-5;
  while (!FreeSpace(a, b, hi).is_passed()) lo = std::exchange(hi, 2.0 * hi);
  while (hi - lo > 1e-9) {
    const double leash = 0.5 * (lo + hi);
    (FreeSpace(a, b, leash).is_passed() ? hi : lo) = leash;
  }
  return hi;
}

}  // namespace frustum::calibration
