// Fits of generated points whose least-squares element is known exactly: residuals that are
// orthogonal to every column of the Jacobian leave the element they were added to stationary. Then
// random points, which may be anything: an answer is stationary, or there is a reason for none.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cstdlib>
#include <limits>

#include "metrology/fit/constraint_steps.hpp"
#include "metrology/fit/element_model.hpp"
#include "metrology/fit/least_squares.hpp"
#include "tests/law_count.hpp"
#include "tests/metrology/synthetic.hpp"

namespace frustum::metrology {
namespace {

using synthetic::Draws;
using synthetic::line_angle;
using synthetic::off_axis;

constexpr int kSetsPerElement = 48;

struct KnownSet {
  Element element{};
  std::vector<Vec3> points{};
};

// Part of `r` that is orthogonal to the columns.
Eigen::VectorXd in_null_space(const Eigen::MatrixXd& columns, Eigen::VectorXd r) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  const Eigen::MatrixXd q =
      qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
  for (int i = 0; i < 3; ++i) r -= q * (q.transpose() * r);  // again, for what rounding left
  return r;
}

Eigen::VectorXd noise(std::size_t n, double size, Draws& draws) {
  Eigen::VectorXd r(static_cast<Eigen::Index>(n));
  for (double& x : r) x = size * draws.gauss();
  return r;
}

// Moves points on the element along its normals.
KnownSet stationary(const Element& element, std::vector<Vec3> points, double size, Draws& draws) {
  const auto n = static_cast<Eigen::Index>(points.size());
  const auto width = static_cast<Eigen::Index>(parameters_of(kind_of(element)).size());
  Eigen::MatrixXd jacobian(n, width);
  for (Eigen::Index i = 0; i < n; ++i) {
    jacobian.row(i) = linearised(element, points[static_cast<std::size_t>(i)]).gradient.transpose();
  }
  const Eigen::VectorXd r = in_null_space(jacobian, noise(points.size(), size, draws));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] += r[static_cast<Eigen::Index>(i)] * outward_normal(element, points[i]);
  }
  return {element, points};
}

// A circle is the plane of its points first.
KnownSet lifted(KnownSet set, double size, Draws& draws) {
  const Circle& circle = std::get<Circle>(set.element);
  const Plane plane{circle.point, circle.axis};
  Eigen::MatrixXd jacobian(set.points.size(), 3);
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    jacobian.row(static_cast<Eigen::Index>(i)) =
        linearised(plane, set.points[i]).gradient.transpose();
  }
  const Eigen::VectorXd h = in_null_space(jacobian, noise(set.points.size(), size, draws));
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    set.points[i] += h[static_cast<Eigen::Index>(i)] * circle.axis.vec();
  }
  return set;
}

// A line deviates in two directions; each is orthogonal to shift and tilt.
KnownSet line_set(const Line& line, const Vec3& across, const Vec3& other, Draws& draws) {
  constexpr int kCount = 25;
  Eigen::MatrixXd jacobian(kCount, 2);
  for (int i = 0; i < kCount; ++i) jacobian.row(i) << 1.0, draws.between(-40.0, 40.0);
  const Eigen::VectorXd a = in_null_space(jacobian, noise(kCount, 0.01, draws));
  const Eigen::VectorXd b = in_null_space(jacobian, noise(kCount, 0.01, draws));
  KnownSet set{line, {}};
  for (int i = 0; i < kCount; ++i) {
    set.points.emplace_back(line.point + jacobian(i, 1) * line.axis.vec() + a[i] * across +
                            b[i] * other);
  }
  return set;
}

// Every fourth set is ordinary, short or narrow, slender or extreme, far away.
KnownSet known_set(std::string_view name, int number, Draws& draws) {
  const int sort = number % 4;
  const double away = sort == 3 ? 1000.0 : 50.0;
  const Vec3 p = draws.place(away);
  const UnitVec3 a = draws.direction();
  const auto [u, v] = tangents(a);
  const double r = draws.between(5.0, 50.0);
  const double arc = sort == 1 ? std::numbers::pi / 6.0 : draws.between(2.0, 6.28);
  const double length = sort == 2 ? 0.1 * r : draws.between(0.5, 3.0) * r;
  const double size = sort == 1 ? 1e-4 : 5e-3;
  const auto round = [&](int rings, double long_, auto radius) {
    return synthetic::revolution(p, a, -0.5 * long_, long_, rings, 60 / rings, arc, 0.4, radius);
  };
  if (name == "line") return line_set({p, a}, u, v, draws);
  if (name == "line2d") {
    const UnitVec3 in_plane = unit({a.vec().x(), a.vec().y(), 0.0});
    return line_set({p, in_plane}, Vec3::UnitZ().cross(in_plane.vec()), Vec3::Zero(), draws);
  }
  if (name == "plane") {
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i) {
      points.emplace_back(p + draws.between(-r, r) * u + draws.between(-length, length) * v);
    }
    return stationary(Plane{p, a}, points, size, draws);
  }
  if (name == "circle") {
    const Circle e{p, a, r};
    return lifted(stationary(e, round(1, 0.0, [&](double) { return r; }), size, draws), size,
                  draws);
  }
  if (name == "circle2d") {
    const Circle e{p, UnitVec3::z(), r};
    const auto points =
        synthetic::revolution(p, e.axis, 0, 0, 1, 40, arc, 0.4, [&](double) { return r; });
    return stationary(e, points, size, draws);
  }
  if (name == "sphere") {
    std::vector<Vec3> points;
    while (points.size() < 40) {
      const UnitVec3 n = draws.direction();
      if (angle_between(n, a) < arc / 2.0) points.emplace_back(p + r * n.vec());
    }
    return stationary(Sphere{p, r}, points, size, draws);
  }
  if (name == "cylinder") {
    return stationary(Cylinder{p, a, r}, round(5, length, [&](double) { return r; }), size, draws);
  }
  if (name == "cone") {
    // Nearly cylindrical and nearly flat ones among the extreme.
    const double half = sort == 2 ? (number % 8 == 2 ? 0.02 : 1.5) : draws.between(0.2, 1.2);
    const double high = sort == 2 ? 0.5 * r * std::cos(half) : 0.6 * r * std::cos(half);
    const Cone e{p, a, r * std::cos(half), half};
    return stationary(e, round(5, high, [&](double s) { return e.section_radius(s); }), size,
                      draws);
  }
  const Torus e{p, a, r, draws.between(0.2, 0.7) * r};
  std::vector<Vec3> points;
  for (int i = 0; i < 80; ++i) {
    const double turn = arc * (i % 10) / 10.0;
    const double roll = (sort == 2 ? 2.0 : 6.28) * (i / 10) / 8.0;
    const Vec3 out = std::cos(turn) * u + std::sin(turn) * v;
    points.emplace_back(p + (e.radius + e.tube_radius * std::cos(roll)) * out +
                        e.tube_radius * std::sin(roll) * a.vec());
  }
  return stationary(e, points, size, draws);
}

// Largest differences of two elements of a kind, where the points lie: mm and rad.
struct Difference {
  double mm = 0.0;
  double rad = 0.0;
};
Difference difference(const Element& a, const Element& b) {
  Difference d;
  const UnitVec3* axis = axis_of(a);
  if (axis != nullptr) d.rad = line_angle(*axis, *axis_of(b));
  const Element there = shifted(b, point_of(a));
  const bool slides = std::holds_alternative<Line>(a) || std::holds_alternative<Cylinder>(a) ||
                      std::holds_alternative<Cone>(a);
  d.mm = slides ? off_axis(point_of(there), *axis, point_of(a))
                : (point_of(there) - point_of(a)).norm();
  std::visit(
      [&](const auto& e) {
        const auto& other = std::get<std::decay_t<decltype(e)>>(there);
        if constexpr (requires { e.radius; })
          d.mm = std::max(d.mm, std::abs(e.radius - other.radius));
        if constexpr (requires { e.tube_radius; }) {
          d.mm = std::max(d.mm, std::abs(e.tube_radius - other.tube_radius));
        }
        if constexpr (requires { e.half_angle; }) {
          d.rad = std::max(d.rad, std::abs(e.half_angle - other.half_angle));
        }
      },
      a);
  return d;
}

constexpr std::string_view kNames[] = {"line",   "line2d",   "plane", "circle", "circle2d",
                                       "sphere", "cylinder", "cone",  "torus"};

// Coordinates of 1000 mm are rounded to 1e-13 mm, and the condition multiplies that: 1e-9 mm and
// 1e-11 rad hold for all sets here, whose conditions reach some 1e4.
TEST(ExactFitReference, GeneratedSetsGiveTheElementThatTheyWereMadeFor) {
  for (const std::string_view name : kNames) {
    Draws draws(40 + name.size());
    Difference worst;
    double condition = 0.0;
    for (int number = 0; number < kSetsPerElement; ++number) {
      const KnownSet set = known_set(name, number, draws);
      const auto fit = fit_element(name, set.points);
      ASSERT_TRUE(fit) << name << ' ' << number << ": " << fit.error().front().message;
      const Difference d = difference(set.element, fit->element);
      EXPECT_LT(d.mm, 1e-9) << name << ' ' << number << " condition " << fit->condition;
      EXPECT_LT(d.rad, 1e-11) << name << ' ' << number << " condition " << fit->condition;
      worst = {std::max(worst.mm, d.mm), std::max(worst.rad, d.rad)};
      condition = std::max(condition, fit->condition);
    }
    RecordProperty(std::string(name) + "_fm", std::to_string(worst.mm * 1e12));
    RecordProperty(std::string(name) + "_frad", std::to_string(worst.rad * 1e15));
    RecordProperty(std::string(name) + "_condition", std::to_string(condition));
  }
}

// Anything: blobs, flat and slender ones, repeated points, rows, minimal sets, all sizes, no
//           numbers.
std::vector<Vec3> anything(Draws& draws, std::size_t least) {
  const auto n = least + static_cast<std::size_t>(draws.between(0.0, draws.between(0.0, 26.0)));
  const double scale = std::pow(10.0, draws.between(-6.0, 6.0));
  const auto flatness = [&] {
    return draws.between(0, 1) < 0.1 ? 0.0 : std::exp2(draws.between(-30, 4));
  };
  const Vec3 uneven(draws.between(0, 1) < 0.5 ? flatness() : 1.0,
                    draws.between(0, 1) < 0.3 ? flatness() : 1.0, 1.0);
  const Vec3 centre = draws.between(0, 1) < 0.2 ? draws.place(1e3 * scale) : Vec3(0, 0, 0);
  const Pose pose = draws.pose(1.0);
  const bool shell = draws.between(0, 1) < 0.4;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 p = shell ? draws.direction().vec() : draws.place(1.0);
    p = pose.direction(uneven.cwiseProduct(p));
    points.emplace_back(centre + scale * p);
    if (i > 0 && draws.between(0, 1) < 0.05) points.back() = points[i / 2];
  }
  const double odd = draws.between(0, 1);
  if (odd < 0.01) points.back().x() = std::numeric_limits<double>::quiet_NaN();
  if (odd > 0.99) points.front().z() = std::numeric_limits<double>::infinity();
  return points;
}

// Largest cosine between the residuals and a column of the Jacobian, of steps that the constraints
// allow, beyond the 1e-10 of the part that the fits promise: a millionth of `spared`. Of parameters
// that change residuals by less than `weakest` of what they move, only the second derivatives tell.
double slope(const Fit<Element>& fit, const std::vector<Vec3>& points, const Constraints& keep = {},
             double weakest = 0.0) {
  Vec3 centre = Vec3::Zero();
  double farthest = 0.0;
  for (const Vec3& p : points) centre += p / static_cast<double>(points.size());
  for (const Vec3& p : points) farthest = std::max(farthest, (p - centre).norm() + p.norm());
  const auto n = static_cast<Eigen::Index>(points.size());
  const StepBasis basis = allowed_steps(fit.element, keep);
  const Eigen::Index width = basis.cols();
  Eigen::MatrixXd jacobian(n, width);
  Eigen::VectorXd r(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const LinearisedPoint at = linearised(fit.element, points[static_cast<std::size_t>(i)]);
    jacobian.row(i) = at.gradient.transpose() * basis;
    r[i] = at.residual;
  }
  farthest += (point_of(fit.element) - centre).norm();  // centres of huge radii
  const double spared = 1e-4 * farthest * std::sqrt(static_cast<double>(n));
  double most = 0.0;
  for (Eigen::Index k = 0; k < width; ++k) {
    const double length = jacobian.col(k).norm();
    Eigen::Index parameter = 0;
    basis.col(k).cwiseAbs().maxCoeff(&parameter);
    const bool turns =
        is_angle(parameters_of(kind_of(fit.element))[static_cast<std::size_t>(parameter)]);
    const double moves = (turns ? farthest : 1.0) * std::sqrt(static_cast<double>(n));
    if (length > weakest * moves) {
      most = std::max(most, std::abs(jacobian.col(k).dot(r)) / length / (r.norm() + spared));
    }
  }
  return most;
}

int random_sets() {
  const char* wanted = std::getenv("FRUSTUM_RANDOM_SETS");  // NOLINT(concurrency-mt-unsafe)
  return wanted != nullptr ? std::atoi(wanted) : proof::law_count(500, 60);
}

class RandomPointsLaws : public testing::TestWithParam<std::string_view> {};

// 100,000 sets of each with FRUSTUM_RANDOM_SETS=100000.
TEST_P(RandomPointsLaws, GetAStationaryElementOrAReason) {
  Draws draws(77 + GetParam().size());
  int fitted = 0;
  double steepest = 0.0;
  const int sets = random_sets();
  for (int set = 0; set < sets; ++set) {
    const std::vector<Vec3> points = anything(draws, 2);
    const auto fit = fit_element(GetParam(), points);
    if (!fit) {
      EXPECT_FALSE(fit.error().front().message.empty());
      continue;
    }
    ++fitted;
    ASSERT_TRUE(std::isfinite(fit->form) && std::isfinite(fit->rms)) << set;
    ASSERT_TRUE(fit->covariance.allFinite() && fit->cofactor.allFinite()) << set;
    ASSERT_TRUE(point_of(fit->element).allFinite()) << set;
    ASSERT_TRUE(std::isfinite(fit->condition)) << set;
    if (GetParam() == "line2d") continue;  // its residuals are in its plane
    const double steep = slope(*fit, points);
    steepest = std::max(steepest, steep);
    EXPECT_LT(steep, 1e-6) << set << " condition " << fit->condition << " of " << points.size();
  }
  EXPECT_GT(fitted, sets / 50);
  RecordProperty("fitted", fitted);
  RecordProperty("steepest_in_1e-9", std::to_string(steepest * 1e9));
}

// Sizes near and far from those of the points, directions that are any.
Constraints any_constraints(ElementKind kind, const std::vector<Vec3>& points, Draws& draws) {
  double size = 0.0;
  for (const Vec3& p : points) size = std::max(size, (p - points[0]).norm());
  const auto length = [&] { return size * std::exp2(draws.between(-4.0, 4.0)); };
  const bool round = kind != ElementKind::line && kind != ElementKind::plane;
  const bool has_radius = round && kind != ElementKind::cone;
  Constraints keep;
  const double sort = draws.between(0.0, 1.0);
  if (kind != ElementKind::sphere) {
    if (sort < 0.25) keep.parallel_to = draws.direction();
    if (sort > 0.75) keep.perpendicular_to = draws.direction();
    const bool has_axis = round && sort > 0.4 && sort < 0.5;
    if (has_axis) keep.axis = Line{points[0], draws.direction()};
  }
  const bool sized = sort > 0.2 && sort < 0.9;
  if (has_radius && (sized || kind == ElementKind::sphere)) keep.radius = length();
  if (kind == ElementKind::torus && sized && sort < 0.7) {
    keep.tube_radius = draws.between(0.01, 0.99) * *keep.radius;
  }
  if (kind == ElementKind::cone && sized) keep.half_angle = draws.between(0.01, 1.56);
  return keep;
}

class RandomConstraintsLaws : public testing::TestWithParam<ElementKind> {};

TEST_P(RandomConstraintsLaws, GetAStationaryElementThatKeepsThemOrAReason) {
  const ElementKind kind = GetParam();
  Draws draws(177 + name_of(kind).size());
  int fitted = 0;
  const int sets = random_sets();
  for (int set = 0; set < sets; ++set) {
    const std::vector<Vec3> points = anything(draws, 4);
    const Constraints keep = any_constraints(kind, points, draws);
    const auto fit = fit_element(kind, points, {.constraints = keep});
    if (!fit) {
      EXPECT_FALSE(fit.error().front().message.empty());
      continue;
    }
    ++fitted;
    ASSERT_TRUE(std::isfinite(fit->form) && std::isfinite(fit->rms)) << set;
    ASSERT_TRUE(fit->covariance.allFinite() && fit->cofactor.allFinite()) << set;
    ASSERT_TRUE(point_of(fit->element).allFinite()) << set;
    ASSERT_TRUE(std::isfinite(fit->condition)) << set;
    const Element kept = constrained(fit->element, keep);
    EXPECT_LT(difference(kept, fit->element).rad, 1e-12) << set;
    if (kind == ElementKind::line) continue;  // points deviate in two directions from it
    EXPECT_LT(slope(*fit, points, keep, 1e-6), 1e-6) << set << " condition " << fit->condition;
  }
  EXPECT_GT(fitted, sets / 50);
  RecordProperty("fitted", fitted);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, RandomConstraintsLaws,
                         testing::Values(ElementKind::line, ElementKind::plane, ElementKind::circle,
                                         ElementKind::sphere, ElementKind::cylinder,
                                         ElementKind::cone, ElementKind::torus),
                         [](const auto& named) { return std::string(name_of(named.param)); });

INSTANTIATE_TEST_SUITE_P(AllKinds, RandomPointsLaws, testing::ValuesIn(kNames),
                         [](const auto& named) { return std::string(named.param); });

}  // namespace
}  // namespace frustum::metrology
