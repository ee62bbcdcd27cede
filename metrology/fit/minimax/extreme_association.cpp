#include "metrology/fit/minimax/extreme_association.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "metrology/fit/axis_search.hpp"
#include "metrology/fit/minimax/extreme_search.hpp"
#include "metrology/fit/round_fit.hpp"

namespace frustum::metrology {
namespace {

using namespace surface_parameter;

// What is really sought: outside material of round kinds is one of the other criteria.
enum class Sought { zone, inscribed, circumscribed };

Result<Sought> sought(const ExtremeKind& kind, const AssociationOptions& options) {
  const bool is_flat = kind.surface == Surface::plane;
  switch (options.criterion) {
    case Criterion::minimum_zone:
      return Sought::zone;
    case Criterion::maximum_inscribed:
      if (kind.has_size) return Sought::inscribed;
      break;
    case Criterion::minimum_circumscribed:
      if (kind.has_size) return Sought::circumscribed;
      break;
    case Criterion::outside_material:
      if (is_flat) return Sought::zone;
      if (kind.has_size) return options.is_hole ? Sought::inscribed : Sought::circumscribed;
      break;
    case Criterion::least_squares:
      break;
  }
  return error("criterion-not-applicable"_id,
               fmt::format("a {} has no association '{}'", kind.name, name_of(options.criterion)),
               kind.has_size ? "it has ls, mz, mi, mc and om"
               : is_flat     ? "it has ls, mz and om"
                             : "it has ls and mz");
}

std::optional<Diagnostic> contradiction(const ExtremeKind& kind, Sought what,
                                        const AssociationOptions& options) {
  if (!options.weights.empty()) {
    return error("point-weights"_id, "weights go with least squares only",
                 "leave them out, or use 'ls'");
  }
  if (what != Sought::zone && options.constraints.radius) {
    return error("constraints-contradict"_id,
                 fmt::format("the radius of a {} cannot be kept and sought by '{}' at once",
                             kind.name, name_of(options.criterion)),
                 "leave out radius, or use 'ls' or 'mz'");
  }
  const bool one_sided = options.criterion == Criterion::outside_material && !kind.has_size;
  if (one_sided && !(options.outward && UnitVec3::of(*options.outward))) {
    return error("outward-direction"_id,
                 fmt::format("the side of the {} that is free of material is not given", kind.name),
                 "give the direction out of the material (fit: --outward)");
  }
  return std::nullopt;
}

// The direction out of the material must tell the sides of the element apart.
std::optional<Diagnostic> sideways(const ExtremeKind& kind, const Element& element,
                                   const Vec3& across, const AssociationOptions& options) {
  if (options.criterion != Criterion::outside_material || kind.has_size) return std::nullopt;
  const Vec3 axis = *axis_of(element);
  const Vec3 normal = std::holds_alternative<Plane>(element) ? axis : across.cross(axis);
  // Nearer than 6 deg to the element it is a slip, and form would choose the side.
  constexpr double kLeast = 0.1;
  if (std::abs(normal.dot(options.outward->normalized())) >= kLeast) return std::nullopt;
  return error("outward-direction"_id,
               fmt::format("the direction out of the material is along the {}", kind.name),
               fmt::format("give one nearer to its normal, which is +-({:.4g}, {:.4g}, {:.4g})",
                           normal.x(), normal.y(), normal.z()));
}

// Normal of the coordinate plane of circle2d and line2d, as fit_circle_2d() chooses it.
Vec3 coordinate_normal(std::span<const Vec3> points) {
  for (const Eigen::Index i : {2, 1, 0}) {
    const bool constant = std::all_of(points.begin(), points.end(),
                                      [&](const Vec3& p) { return p[i] == points.front()[i]; });
    if (constant) return Vec3::Unit(i);
  }
  return Vec3::UnitZ();
}

// Of a proof, on the local part: 1e-9 mm, but no less than that on a part of 100 mm and no more
// than on one of 1 mm.
double tolerance(const NormalisedPoints& local) {
  return std::clamp(1e-9 / local.scale, 1e-11, 1e-9);
}

bool is_fixed(int parameter, const ExtremeKind& kind, Sought what, const Constraints& c) {
  const bool is_torus = kind.surface == Surface::ring;
  switch (parameter) {
    case kX:
    case kY:
      return c.axis.has_value();
    case kTiltX:
      return c.axis || c.parallel_to;
    case kTiltY:
      return c.axis || c.parallel_to || c.perpendicular_to;
    case kRadius:
      return what != Sought::zone || (is_torus ? c.tube_radius : c.radius);
    case kShape:
      return is_torus ? c.radius.has_value() : c.half_angle.has_value();
    default:
      return false;
  }
}

MinimaxProblem problem_of(const ExtremeKind& kind, Sought what, const Constraints& constraints) {
  MinimaxProblem problem;
  problem.surface = kind.surface;
  problem.sides = {what != Sought::inscribed,
                   what == Sought::inscribed || (what == Sought::zone && kind.has_sides)};
  problem.allowed.resize(kSurfaceParameters, 0);
  for (const int parameter : kind.free) {
    if (is_fixed(parameter, kind, what, constraints)) continue;
    problem.allowed.conservativeResize(Eigen::NoChange, problem.allowed.cols() + 1);
    problem.allowed.rightCols(1) = SurfaceParameters::Unit(parameter);
  }
  return problem;
}

std::vector<PlacedElement> elsewhere(const ExtremeKind& kind, const NormalisedPoints& local,
                                     const Constraints& constraints) {
  const bool is_cone = kind.name == "cone";
  if (constraints.any() || (!is_cone && kind.name != "cylinder")) return {};
  std::vector<PlacedElement> starts;
  constexpr std::size_t kMost = 6;
  const AxisSearch search(local, principal_directions(local));
  for (const AxisCandidate& c :
       search.candidates(is_cone ? RoundKind::cone : RoundKind::cylinder, kMost)) {
    const auto axis = UnitVec3::of(c.axis);
    if (!axis) continue;
    starts.push_back(placed(kind, Cylinder{c.point, *axis, c.radius}, Vec3::UnitY()));
  }
  return starts;
}

struct Task {
  const ExtremeKind& kind;
  Sought what;
  const AssociationOptions& options;
  const NormalisedPoints& local;
  Vec3 across;
};

ExtremeFound searched(const Task& task, const Element& start) {
  ExtremeSearch search;
  search.kind = &task.kind;
  search.problem = problem_of(task.kind, task.what, task.options.constraints);
  search.problem.tie = 0.5 * tolerance(task.local);
  search.start = placed(task.kind, start, task.across);
  if (task.what == Sought::zone) {
    search.elsewhere = elsewhere(task.kind, task.local, task.options.constraints);
  } else {
    search.most_tilt = 0.5;
  }
  return best_extreme(search, task.local.points);
}

// The element as it is: all there is to say where nothing can move, or where points are on it to
// rounding.
ExtremeFound as_it_stands(const Task& task, const Element& start) {
  const MinimaxProblem problem = problem_of(task.kind, task.what, task.options.constraints);
  ExtremeFound found;
  found.placed = placed(task.kind, start, task.across);
  const Pose frame_from_local = found.placed.local_from_frame.inverse();
  std::vector<Vec3> framed;
  for (const Vec3& p : task.local.points) framed.push_back(frame_from_local.point(p));
  const Eigen::VectorXd values = distances(problem.surface, found.placed.at, framed);
  Eigen::Index high = 0;
  Eigen::Index low = 0;
  const double top = values.maxCoeff(&high);
  const double bottom = -values.minCoeff(&low);
  MinimaxSolution& solution = found.solution;
  solution.at = found.placed.at;
  solution.level = level_of(values, problem.sides);
  solution.proven = true;
  if (problem.allowed.cols() > 0) {
    // No zone is narrower by more than its width.
    solution.gap = solution.level;
    solution.contacts = {{high, 1.0, 0.5}, {low, -1.0, 0.5}};
    if (!problem.sides.low) solution.contacts = {{high, 1.0, 1.0}};
  } else if (problem.sides.high && (top >= bottom || !problem.sides.low)) {
    solution.contacts = {{high, 1.0, 1.0}};
  } else {
    solution.contacts = {{low, -1.0, 1.0}};
  }
  return found;
}

Certificate certificate_of(const Task& task, const ExtremeFound& found) {
  Certificate certificate;
  double high = 0.0;
  double low = 0.0;
  for (const ActiveRow& contact : found.solution.contacts) {
    (contact.sign > 0.0 ? high : low) += contact.multiplier;
  }
  // The balance of a free size gives both sides one half; each side is to add up to one.
  const bool is_balanced = task.what == Sought::zone && std::abs(high - low) < 1e-6;
  for (const ActiveRow& contact : found.solution.contacts) {
    certificate.contacts.push_back({static_cast<std::size_t>(contact.row),
                                    contact.multiplier * (is_balanced ? 2.0 : 1.0),
                                    contact.sign > 0.0});
  }
  std::sort(certificate.contacts.begin(), certificate.contacts.end(),
            [](const Contact& a, const Contact& b) { return a.point < b.point; });
  const double widths = task.what == Sought::zone ? 2.0 : 1.0;
  certificate.imbalance = found.solution.imbalance * (is_balanced ? 2.0 : 1.0);
  certificate.gap = widths * found.solution.gap * task.local.scale;
  return certificate;
}

// Moves the size to the contacts: what was sought so far is where the element lies.
void take_size(const Task& task, PlacedElement& placed, double level) {
  if (task.what == Sought::circumscribed) placed.at[kRadius] += level;
  if (task.what == Sought::inscribed) placed.at[kRadius] -= level;
}

// A plane or line in a plane at the outer bound of its zone.
Element outside(const Element& middle, const Vec3& outward, const Vec3& across, double half_width) {
  if (const auto* plane = std::get_if<Plane>(&middle)) {
    const UnitVec3 axis = plane->axis.vec().dot(outward) < 0.0 ? -plane->axis : plane->axis;
    return Plane{plane->point + half_width * axis.vec(), axis};
  }
  const Line& line = std::get<Line>(middle);
  const Vec3 normal = across.cross(line.axis.vec());
  return Line{line.point + (normal.dot(outward) < 0.0 ? -half_width : half_width) * normal,
              line.axis};
}

// As residual(); of a line in a plane with the sign of its left side, seen from the tip of the
// normal.
double signed_residual(const Task& task, const Element& element, const Vec3& point) {
  if (task.kind.name != "line2d") return residual(element, point);
  const Line& line = std::get<Line>(element);
  return (point - line.point).dot(task.across.cross(line.axis.vec()));
}

Association finished(const Task& task, const ExtremeFound& found) {
  PlacedElement at = found.placed;
  take_size(task, at, found.solution.level);
  Element element = element_at(task.kind, at);
  if (task.options.criterion == Criterion::outside_material && !task.kind.has_size) {
    element = outside(element, *task.options.outward, task.across, found.solution.level);
  }
  Association result;
  result.criterion = task.options.criterion;
  result.certificate = certificate_of(task, found);
  double squares = 0.0;
  double highest = -std::numeric_limits<double>::infinity();
  double lowest = -highest;
  for (const Vec3& p : task.local.points) {
    const double d = signed_residual(task, element, p) * task.local.scale;
    result.fit.residuals.push_back(d);
    squares += d * d;
    highest = std::max(highest, d);
    lowest = std::min(lowest, d);
  }
  result.fit.rms = std::sqrt(squares / static_cast<double>(task.local.points.size()));
  result.fit.form =
      task.what == Sought::zone ? 2.0 * found.solution.level * task.local.scale : highest - lowest;
  result.fit.element = in_mm(element, task.local);
  // A circle in space has those of its plane too.
  const bool has_plane = std::holds_alternative<Circle>(element);
  const auto parameters = has_plane ? 6 : static_cast<Eigen::Index>(task.kind.free.size());
  result.fit.cofactor = Eigen::MatrixXd::Zero(parameters, parameters);
  result.fit.covariance = result.fit.cofactor;
  result.fit.iterations = found.iterations;
  return result;
}

double radius_of(const Element& element) {
  return std::visit(
      [](const auto& e) {
        if constexpr (requires { e.radius; }) {
          return e.radius;
        } else {
          return 0.0;
        }
      },
      element);
}

// The smallest circle around an arc of less than half a turn is that over its chord, on which the
// points are not. Of points that surround the least-squares centre none is smaller than the nearest
// of them is far, and none that is inscribed larger than the farthest: arcs at different heights
// leave room between them for a larger cylinder.
std::optional<Diagnostic> not_of_the_part(const Task& task, const Association& found,
                                          const Fit<Element>& squares) {
  constexpr double kProof = 1e-9;  // mm, as good as the association is
  const double radius = radius_of(found.fit.element), middle = radius_of(squares.element);
  if (task.what == Sought::circumscribed && radius < middle - squares.form - kProof) {
    return error("association-open"_id,
                 fmt::format("the smallest {} around these points is that over their chord: they "
                             "go around less than half of it",
                             task.kind.name),
                 "probe around more than half of the circumference, or use 'ls' or 'mz'");
  }
  if (task.what == Sought::inscribed && middle > 0.0 && radius > middle + squares.form + kProof) {
    return error("association-open"_id,
                 fmt::format("the largest {} within these points is {:.3g} um larger than the one "
                             "that they are on: they leave room between them",
                             task.kind.name, 1e3 * (radius - middle)),
                 "probe around more than half of the circumference at each height, or use 'ls' or "
                 "'mz'");
  }
  return std::nullopt;
}

Diagnostic unproven(const Task& task) {
  if (task.what == Sought::inscribed) {
    return error("association-open"_id,
                 fmt::format("no largest {} is within these points: they leave it open on one side",
                             task.kind.name),
                 "probe around more than half of the circumference, or use 'ls' or 'mz'");
  }
  return error("association-unproven"_id,
               fmt::format("no {} by '{}' could be proven: the points hardly determine it",
                           task.kind.name, name_of(task.options.criterion)),
               "probe more of the surface, or use 'ls'");
}

}  // namespace

Result<Association> extreme_association(std::string_view name, std::span<const Vec3> points,
                                        const AssociationOptions& options) {
  const ExtremeKind* kind = extreme_kind(name);
  if (kind == nullptr)
    return error("unknown-element"_id, fmt::format("'{}' is not an element", name));
  const auto what = sought(*kind, options);
  if (!what) return what.error();
  if (auto problem = contradiction(*kind, *what, options)) return *problem;
  const bool in_plane = kind->name == "line2d" || kind->name == "circle2d";
  const Vec3 across = in_plane ? coordinate_normal(points)
                               : options.constraints.perpendicular_to.value_or(UnitVec3::y()).vec();
  // Least squares under the same constraints is where the search begins.
  auto start = fit_element(name, points, {options.constraints, {}});
  if (!start) return std::move(start).error();
  if (auto problem = sideways(*kind, start->element, across, options)) return *problem;
  auto local = normalise(points, {kind_of(start->element), name, 1}, {});
  if (!local) return std::move(local).error();
  if (in_plane) {
    for (Vec3& p : local->points) p -= p.dot(across) * across;
  }
  const Task task{*kind, *what, options, *local, across};
  const Element local_start = to_local(*local, start->element);
  ExtremeFound found = as_it_stands(task, local_start);
  const bool is_zone = *what == Sought::zone;
  const double start_width = 2.0 * found.solution.level;
  // Coordinates of the size of the part are rounded to 1e-16 of it.
  const bool is_exact = is_zone && start_width < 8e-15;
  if (found.solution.gap > 0.0 && !is_exact) {
    ExtremeFound best = searched(task, local_start);
    if (best.solution.proven || !is_zone || start_width > tolerance(*local))
      found = std::move(best);
  }
  if (!found.solution.proven || 2.0 * found.solution.gap > tolerance(*local)) return unproven(task);
  Association result = finished(task, found);
  if (auto open = not_of_the_part(task, result, *start)) return *std::move(open);
  return result;
}

}  // namespace frustum::metrology
