#include "parser/interpret/moves/spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace frustum::parser {
namespace {

using Homogeneous = Eigen::Vector3d;  // weight times place, weight

// Shorter than any control's increment: a point.
constexpr double kNoLength = 1e-9;  // mm
// An arc that bends less than this hundredth of the tolerance is a line.
constexpr double kFlat = 0.01;
// Halving as often leaves parts of 1e-9 of a span: there the curve has a corner.
constexpr int kMaxHalvings = 30;
constexpr int kChecks = 16;

struct CurvePoint {
  Vec2 place = Vec2::Zero();
  Vec2 derivative = Vec2::Zero();
};

class Spline {
 public:
  Spline(std::span<const ControlPoint> points, int order, std::span<const double> knots)
      : points_(points), knots_(knots), degree_(order - 1) {}

  [[nodiscard]] int spans() const { return static_cast<int>(points_.size()) - degree_; }

  // The parameters at the ends of a span.
  [[nodiscard]] std::array<double, 2> ends(int span) const {
    return {knot(span + degree_), knot(span + degree_ + 1)};
  }

  // De Boor's scheme within one span, whose ends are its own.
  [[nodiscard]] CurvePoint at(int span, double parameter) const {
    std::vector<Homogeneous> row;
    for (int i = 0; i <= degree_; ++i) {
      const ControlPoint& point = points_[static_cast<std::size_t>(span + i)];
      row.emplace_back(point.weight * point.place.x(), point.weight * point.place.y(),
                       point.weight);
    }
    Homogeneous slope = Homogeneous::Zero();
    for (int level = 1; level <= degree_; ++level) {
      for (int i = degree_; i >= level; --i) {
        const double low = knot(span + i);
        const double high = knot(span + degree_ + 1 + i - level);
        const double share = (parameter - low) / (high - low);
        const auto slot = static_cast<std::size_t>(i);
        if (level == degree_) slope = degree_ * (row[slot] - row[slot - 1]) / (high - low);
        row[slot] = (1.0 - share) * row[slot - 1] + share * row[slot];
      }
    }
    const Homogeneous& end = row.back();
    const Vec2 place = end.head<2>() / end.z();
    return {place, (slope.head<2>() - slope.z() * place) / end.z()};
  }

 private:
  // Uniform: 0, .. 0, 1, 2, .. n, .. n
  [[nodiscard]] double knot(int index) const {
    if (!knots_.empty()) return knots_[static_cast<std::size_t>(index)];
    return std::clamp(index - degree_, 0, spans());
  }

  std::span<const ControlPoint> points_;
  std::span<const double> knots_;
  int degree_;
};

// The arc from `from`, where it has the direction `along`, to `to`.
PathPiece arc_along(const Vec2& from, const Vec2& along, const Vec2& to, double flat) {
  PathPiece piece{from, to};
  const Vec2 chord = to - from;
  const Vec2 left = left_of(along);
  const double aside = left.dot(chord);
  // The height of the arc over its chord is about a quarter of that.
  if (std::abs(aside) < 4.0 * flat) return piece;
  piece.centre = from + left * (chord.squaredNorm() / (2.0 * aside));
  piece.turns = aside > 0.0 ? 1 : -1;
  return piece;
}

PathPiece reversed(const PathPiece& piece) {
  return {piece.end, piece.start, piece.centre, -piece.turns};
}

double distance_from(const PathPiece& piece, const Vec2& point) {
  if (piece.is_arc()) return std::abs((point - piece.centre).norm() - radius_of(piece));
  return std::abs(left_of(direction_at_start(piece)).dot(point - piece.start));
}

class ArcFit {
 public:
  ArcFit(const Spline& spline, double tolerance) : spline_(spline), tolerance_(tolerance) {}

  void add(int span, double from, double to, int halvings) {
    const Vec2 start = spline_.at(span, from).place;
    const Vec2 end = spline_.at(span, to).place;
    const auto pair = biarc(span, from, to);
    if (pair && near_enough(span, from, to, *pair)) {
      for (const PathPiece& piece : *pair) {
        if ((piece.end - piece.start).norm() > kNoLength) pieces_.push_back(piece);
      }
      return;
    }
    if (halvings == kMaxHalvings || is_point(span, from, to)) {
      if ((end - start).norm() > kNoLength) pieces_.push_back({start, end});
      return;
    }
    const double middle = (from + to) / 2.0;
    add(span, from, middle, halvings + 1);
    add(span, middle, to, halvings + 1);
  }
  [[nodiscard]] std::vector<PathPiece> take() { return std::move(pieces_); }

 private:
  [[nodiscard]] bool is_point(int span, double from, double to) const {
    const Vec2 start = spline_.at(span, from).place;
    for (int i = 1; i <= kChecks; ++i) {
      const Vec2 place = spline_.at(span, from + (to - from) * i / kChecks).place;
      if ((place - start).norm() > kNoLength) return false;
    }
    return true;
  }

  // At an end whose derivative vanishes, that of a place just beside it.
  [[nodiscard]] std::optional<Vec2> direction(int span, double parameter, double towards) const {
    Vec2 derivative = spline_.at(span, parameter).derivative;
    if (derivative.norm() < kNoLength) {
      constexpr double kBeside = 1e-6;
      derivative = spline_.at(span, parameter + kBeside * (towards - parameter)).derivative;
    }
    if (derivative.norm() == 0.0) return std::nullopt;
    return derivative.normalized();
  }

  [[nodiscard]] std::optional<std::array<PathPiece, 2>> biarc(int span, double from,
                                                              double to) const {
    const Vec2 start = spline_.at(span, from).place;
    const Vec2 end = spline_.at(span, to).place;
    const auto along = direction(span, from, to);
    const auto along_end = direction(span, to, from);
    const Vec2 chord = end - start;
    if (!along || !along_end) return std::nullopt;
    // Both arms of the biarc are as long: |chord - arm (along + along_end)| = 2 arm.
    const double a = 2.0 * (1.0 - along->dot(*along_end));
    const double b = chord.dot(*along + *along_end);
    if (b <= 0.0) return std::nullopt;
    const double arm = chord.squaredNorm() / (b + std::sqrt(b * b + a * chord.squaredNorm()));
    const Vec2 joint = (start + arm * *along + end - arm * *along_end) / 2.0;
    const double flat = kFlat * tolerance_;
    return std::array{arc_along(start, *along, joint, flat),
                      reversed(arc_along(end, -*along_end, joint, flat))};
  }

  [[nodiscard]] bool near_enough(int span, double from, double to,
                                 const std::array<PathPiece, 2>& pair) const {
    const Vec2 joint = pair[0].end;
    const Vec2 along = pair[1].end - pair[0].start;
    for (int i = 1; i < kChecks; ++i) {
      const Vec2 point = spline_.at(span, from + (to - from) * i / kChecks).place;
      const PathPiece& piece = along.dot(point - joint) < 0.0 ? pair[0] : pair[1];
      if ((piece.end - piece.start).norm() <= kNoLength) continue;
      if (distance_from(piece, point) > tolerance_) return false;
    }
    return true;
  }

  const Spline& spline_;
  double tolerance_;
  std::vector<PathPiece> pieces_{};
};

}  // namespace

std::vector<PathPiece> arcs_of_spline(std::span<const ControlPoint> points, int order,
                                      double tolerance, std::span<const double> knots) {
  const Spline spline(points, order, knots);
  // No nearer than the numbers of coordinates are to each other.
  constexpr double kNumbers = 1e-12;
  for (const ControlPoint& point : points) {
    tolerance = std::max(tolerance, kNumbers * point.place.norm());
  }
  ArcFit fit(spline, tolerance);
  for (int span = 0; span < spline.spans(); ++span) {
    const auto [from, to] = spline.ends(span);
    if (from < to) fit.add(span, from, to, 0);
  }
  return fit.take();
}

}  // namespace frustum::parser
