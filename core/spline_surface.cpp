#include "core/spline_surface.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace frustum {
namespace {

constexpr std::size_t kMostDegree = SplineSurface::kMostDegree;

// The functions that are not zero in a span, with two derivatives, at a parameter in it.
struct Basis {
  std::array<std::array<double, kMostDegree + 1>, 3> value{};
};

// Of clamped uniform knots: 0 and 1 as often as the degree and one more, steps between.
double knot(std::size_t i, std::size_t degree, std::size_t spans) {
  if (i <= degree) return 0.0;
  if (i >= degree + spans) return 1.0;
  return static_cast<double>(i - degree) / static_cast<double>(spans);
}

Basis basis_in(std::size_t span, double t, std::size_t p, std::size_t spans) {
  const std::size_t k = span + p;  // knot(k) <= t <= knot(k + 1)
  // table[r][j]: functions above the diagonal, differences of knots below it.
  std::array<std::array<double, kMostDegree + 1>, kMostDegree + 1> table{};
  std::array<double, kMostDegree + 1> left{}, right{};
  table[0][0] = 1.0;
  for (std::size_t j = 1; j <= p; ++j) {
    left[j] = t - knot(k + 1 - j, p, spans);
    right[j] = knot(k + j, p, spans) - t;
    double saved = 0.0;
    for (std::size_t r = 0; r < j; ++r) {
      table[j][r] = right[r + 1] + left[j - r];
      const double term = table[r][j - 1] / table[j][r];
      table[r][j] = saved + right[r + 1] * term;
      saved = left[j - r] * term;
    }
    table[j][j] = saved;
  }
  Basis basis;
  for (std::size_t r = 0; r <= p; ++r) {
    basis.value[0][r] = table[r][p];
    // A derivative is a difference of functions of one degree less, over the knots between.
    std::array<std::array<double, kMostDegree + 1>, 2> a{};
    a[0][0] = 1.0;
    std::size_t now = 0;
    double factor = static_cast<double>(p);
    for (std::size_t order = 1; order <= std::min<std::size_t>(2, p); ++order) {
      const std::size_t next = 1 - now;
      const std::size_t degree = p - order;
      double sum = 0.0;
      for (std::size_t j = 0; j <= order; ++j) {
        a[next][j] = 0.0;
        // Functions r - order + j of that degree, where there are such.
        if (r + j < order || r + j - order > degree) continue;
        const std::size_t index = r + j - order;
        const double gap = table[degree + 1][index];
        const double high = j < order ? a[now][j] : 0.0;
        const double low = j > 0 ? a[now][j - 1] : 0.0;
        a[next][j] = (high - low) / gap;
        sum += a[next][j] * table[index][degree];
      }
      basis.value[order][r] = factor * sum;
      factor *= static_cast<double>(degree);
      now = next;
    }
  }
  return basis;
}

// Powers 0 to 3 of the way into the span, of each function in it: [function][power].
using Powers = std::array<std::array<double, kMostDegree + 1>, kMostDegree + 1>;
std::vector<Powers> powers_of(std::size_t points) {
  const std::size_t p = std::min(points - 1, kMostDegree), spans = points - p;
  const double width = 1.0 / static_cast<double>(spans);
  std::vector<Powers> all(spans);
  for (std::size_t span = 0; span < spans; ++span) {
    const double from = static_cast<double>(span) * width;
    const Basis low = basis_in(span, from, p, spans);
    const Basis high = basis_in(span, static_cast<double>(span + 1) * width, p, spans);
    for (std::size_t r = 0; r <= p; ++r) {
      all[span][r] = {low.value[0][r], low.value[1][r], 0.5 * low.value[2][r],
                      p < 3 ? 0.0 : (high.value[2][r] - low.value[2][r]) / (6.0 * width)};
    }
  }
  return all;
}

// The span of a parameter, the way into it, and how far it is beyond the ends.
struct Place {
  std::size_t span = 0;
  double in = 0.0, beyond = 0.0;
};
Place place_of(double t, std::size_t spans) {
  const double within = std::clamp(t, 0.0, 1.0);
  const auto count = static_cast<double>(spans);
  const auto span = std::min(static_cast<std::size_t>(within * count), spans - 1);
  return {span, within - static_cast<double>(span) / count, t - within};
}

// A polynomial with two derivatives; beyond the ends straight on.
struct Derived {
  Vec3 value, first, second;
};
Derived derived(const std::array<Vec3, kMostDegree + 1>& c, const Place& at) {
  const double t = at.in;
  Derived d{c[0] + t * (c[1] + t * (c[2] + t * c[3])), c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]),
            2.0 * c[2] + 6.0 * t * c[3]};
  if (at.beyond != 0.0) {
    d.value += at.beyond * d.first;
    d.second.setZero();
  }
  return d;
}

}  // namespace

double SplinePoint::curvature_along_u() const {
  const Vec3 m = v.cross(u);
  const Vec3 change = uv.cross(u) + v.cross(uu);
  return change.dot(u) / (m.norm() * u.squaredNorm());
}

SplineSurface::SplineSurface(std::vector<Vec3> net, std::size_t columns)
    : net_(std::move(net)), columns_(columns) {
  assert(columns >= 2 && net_.size() >= 2 * columns && net_.size() % columns == 0);
  const auto in_u = powers_of(columns_), in_v = powers_of(rows());
  spans_u_ = in_u.size();
  spans_v_ = in_v.size();
  degree_v_ = std::min(rows() - 1, kMostDegree);
  const std::size_t degree_u = std::min(columns_ - 1, kMostDegree);
  patches_.assign(spans_u_ * spans_v_, {});
  for (std::size_t a = 0; a < spans_v_; ++a) {
    for (std::size_t b = 0; b < spans_u_; ++b) {
      Patch& patch = patches_[a * spans_u_ + b];
      for (auto& row : patch) row.fill(Vec3::Zero());
      for (std::size_t i = 0; i <= degree_v_; ++i) {
        for (std::size_t j = 0; j <= degree_u; ++j) {
          const Vec3& point = net_[(a + i) * columns_ + b + j];
          for (std::size_t k = 0; k <= degree_v_; ++k) {
            for (std::size_t l = 0; l <= degree_u; ++l) {
              patch[k][l] += in_v[a][i][k] * in_u[b][j][l] * point;
            }
          }
        }
      }
    }
  }
  along_ = std::max<std::size_t>(41, 4 * columns_ + 1);
  // A ruling is found from its middle.
  across_ = rows() == 2 ? 1 : std::max<std::size_t>(9, 4 * rows() + 1);
  for (std::size_t i = 0; i < across_; ++i) {
    const double v = across_ == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(across_ - 1);
    for (std::size_t j = 0; j < along_; ++j) {
      const Vec3 p = point(static_cast<double>(j) / static_cast<double>(along_ - 1), v);
      x_.push_back(p.x());
      y_.push_back(p.y());
      z_.push_back(p.z());
    }
  }
}

SplineSurface SplineSurface::ruled(std::span<const Vec3> lower, std::span<const Vec3> upper) {
  assert(lower.size() == upper.size());
  std::vector<Vec3> net(lower.begin(), lower.end());
  net.insert(net.end(), upper.begin(), upper.end());
  return {std::move(net), lower.size()};
}

SplinePoint SplineSurface::at(double u, double v) const {
  const Place in_u = place_of(u, spans_u_), in_v = place_of(v, spans_v_);
  const Patch& patch = patches_[in_v.span * spans_u_ + in_u.span];
  std::array<Vec3, kMostDegree + 1> value, first, second;
  for (std::size_t i = 0; i <= kMostDegree; ++i) {
    if (i > degree_v_) {
      value[i] = first[i] = second[i] = Vec3::Zero();
      continue;
    }
    const Derived d = derived(patch[i], in_u);
    value[i] = d.value;
    first[i] = d.first;
    second[i] = d.second;
  }
  const Derived r = derived(value, in_v), along = derived(first, in_v);
  return {r.value, along.value, r.first, derived(second, in_v).value, along.first, r.second};
}

SplineFoot SplineSurface::nearest(const Vec3& point) const {
  std::size_t best = 0;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const double dx = x_[i] - point.x(), dy = y_[i] - point.y(), dz = z_[i] - point.z();
    const double square = dx * dx + dy * dy + dz * dz;
    if (square < least) {
      least = square;
      best = i;
    }
  }
  double u = static_cast<double>(best % along_) / static_cast<double>(along_ - 1);
  double v =
      across_ == 1 ? 0.5 : static_cast<double>(best / along_) / static_cast<double>(across_ - 1);
  SplinePoint p = at(u, v);
  constexpr int kMost = 50;
  constexpr double kStill = 1e-14;
  for (int i = 0; i < kMost; ++i) {
    const Vec3 off = point - p.r;
    const double fu = off.dot(p.u), fv = off.dot(p.v);
    // Of half the square of the distance; without curvature where it is not convex.
    double uu = p.u.squaredNorm() - off.dot(p.uu), uv = p.u.dot(p.v) - off.dot(p.uv);
    double vv = p.v.squaredNorm() - off.dot(p.vv);
    if (!(uu > 0.0 && uu * vv - uv * uv > 0.0)) {
      uu = p.u.squaredNorm();
      uv = p.u.dot(p.v);
      vv = p.v.squaredNorm();
    }
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 0.0)) break;
    double du = (vv * fu - uv * fv) / determinant, dv = (uu * fv - uv * fu) / determinant;
    // A step farther than that from a sample would leave for another branch.
    constexpr double kFarthest = 0.25;
    const double length = std::max(std::abs(du), std::abs(dv));
    const double share = length > kFarthest && i < kMost / 2 ? kFarthest / length : 1.0;
    u += share * du;
    v += share * dv;
    p = at(u, v);
    if (length < kStill * (1.0 + std::abs(u) + std::abs(v))) break;
    // Rounding: Newton's steps shrink by squares.
    if (i > 8 && length < 1e-12) break;
  }
  SplineFoot foot{u, v, 0.0, p.normal()};
  foot.distance = (point - p.r).dot(foot.normal);
  return foot;
}

bool SplineSurface::has_normals() const {
  for (std::size_t i = 0; i < 9; ++i) {
    const double v = static_cast<double>(i) / 8.0;
    Vec3 before = Vec3::Zero();
    for (std::size_t j = 0; j < along_; ++j) {
      const SplinePoint p = at(static_cast<double>(j) / static_cast<double>(along_ - 1), v);
      const Vec3 across = p.v.cross(p.u);
      // An area of less than 1e-12 of its sides is a line.
      if (!(across.norm() > 1e-12 * p.u.norm() * p.v.norm()) || !(across.norm() > 0.0)) {
        return false;
      }
      const Vec3 normal = across.normalized();
      if (j > 0 && before.dot(normal) < 0.0) return false;
      before = normal;
    }
  }
  return true;
}

SplineSurface SplineSurface::moved(const Pose& to_from) const {
  std::vector<Vec3> net;
  net.reserve(net_.size());
  for (const Vec3& p : net_) net.push_back(to_from.point(p));
  return {std::move(net), columns_};
}

}  // namespace frustum
