#include "calibration/compensate/leash.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::calibration {
namespace {

constexpr double kAccuracy = 1e-6;  // of the leash
constexpr double kNoLeash = 1e-12;  // mm or rad

// A place seen from a stretch of the line.
struct Sight {
  double foot = 0.0;    // how far along the stretch, from its start; may lie beside it
  double off = 0.0;     // how far beside the foot
  double length = 0.0;  // of the stretch
};

struct Places {
  static double apart(const Vec3& a, const Vec3& b) { return (b - a).norm(); }
  static Sight seen(const Vec3& from, const Vec3& to, const Vec3& place) {
    const double length = (to - from).norm();
    if (length == 0.0) return {.off = apart(from, place)};
    const Vec3 along = (to - from) / length;
    const double foot = along.dot(place - from);
    return {foot, (place - from - foot * along).norm(), length};
  }
  // How far to both sides of the foot a leash that is longer than `off` reaches.
  static double reach(double off, double leash) {
    return std::sqrt(std::max(0.0, (leash - off) * (leash + off)));
  }
};

struct Directions {
  static double apart(const Vec3& a, const Vec3& b) { return angle_between(a, b); }
  static Sight seen(const Vec3& from, const Vec3& to, const Vec3& direction) {
    const Vec3 normal = from.cross(to);
    const double sine = normal.norm();
    if (sine == 0.0) return {.off = apart(from, direction)};
    const Vec3 pole = normal / sine;
    return {std::atan2(direction.dot(pole.cross(from)), direction.dot(from)),
            std::abs(std::atan2(direction.dot(pole), direction.cross(pole).norm())),
            std::atan2(sine, from.dot(to))};
  }
  // The third side of a right-angled spherical triangle, by half angles.
  static double reach(double off, double leash) {
    const double sines = std::sin(0.5 * (leash - off)) * std::sin(0.5 * (leash + off));
    return 2.0 * std::asin(std::sqrt(std::clamp(sines / std::cos(off), 0.0, 1.0)));
  }
};

template <typename Kind>
class Walk {
 public:
  Walk(std::span<const Vec3> walker, std::span<const Vec3> line) : walker_(walker), line_(line) {}

  [[nodiscard]] double shortest_leash() const {
    const double at_ends = std::max(Kind::apart(walker_.front(), line_.front()),
                                    Kind::apart(walker_.back(), line_.back()));
    double lo = at_ends, hi = at_ends;
    // With that much the partner may stay at the start until the end.
    for (const Vec3& place : walker_) hi = std::max(hi, Kind::apart(line_.front(), place));
    if (arrives(lo)) return lo;
    while (hi - lo > kAccuracy * hi + kNoLeash) {
      const double leash = 0.5 * (lo + hi);
      (arrives(leash) ? hi : lo) = leash;
    }
    return hi;
  }

 private:
  // Asks for a leash that is long enough at both ends.
  [[nodiscard]] bool arrives(double leash) const {
    std::size_t stretch = 0;
    double along = 0.0;
    for (const Vec3& place : walker_) {
      while (!comes_near(place, leash, stretch, along)) {
        if (++stretch + 1 >= line_.size()) return false;
        along = 0.0;
      }
    }
    return true;
  }
  // On along one stretch, no further than the leash asks.
  [[nodiscard]] bool comes_near(const Vec3& place, double leash, std::size_t stretch,
                                double& along) const {
    const Vec3& from = line_[stretch];
    const Vec3& to = line_[std::min(stretch + 1, line_.size() - 1)];
    const Sight sight = Kind::seen(from, to, place);
    if (sight.off > leash) return false;
    const double reach = sight.length > 0.0 ? Kind::reach(sight.off, leash) : 0.0;
    const double first = std::max(along, sight.foot - reach);
    if (first > std::min(sight.length, sight.foot + reach)) return false;
    along = first;
    return true;
  }

  std::span<const Vec3> walker_;
  std::span<const Vec3> line_;
};

}  // namespace

double leash_of_places(std::span<const Vec3> walker, std::span<const Vec3> line) {
  return Walk<Places>(walker, line).shortest_leash();
}

double leash_of_directions(std::span<const Vec3> walker, std::span<const Vec3> line) {
  return Walk<Directions>(walker, line).shortest_leash();
}

}  // namespace frustum::calibration
