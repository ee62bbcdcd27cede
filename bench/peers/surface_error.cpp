#include "bench/peers/surface_error.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"

namespace frustum::bench {
namespace {

using stock::FacetSolid;

constexpr std::uint64_t kSeedOfLines = 77;
constexpr std::uint64_t kSeedOfVertices = 78;
constexpr std::uint64_t kSeedOfEdges = 79;
// Ends farther apart along a line are of different surfaces: the line passes an edge.
constexpr double kSameEnd = 0.05;  // mm
// Lines in the faces of the blank run this far below them: the edge is met within it.
constexpr double kBelowFace = 1e-7;  // mm
// Points of inner edges that are off the truth by more are left out: the path turns a corner there.
constexpr double kOnEdge = 1e-4;  // mm

template <typename Function>
void for_each_index(std::size_t count, const Function& function) {
  tbb::parallel_for(std::size_t{0}, count, function);
}

}  // namespace

void ErrorSum::add(double error) {
  worst = std::max(worst, std::abs(error));
  squares += error * error;
  sum += error;
  ++points;
}
double ErrorSum::rms() const {
  return points > 0 ? std::sqrt(squares / static_cast<double>(points)) : 0.0;
}
double ErrorSum::mean() const { return points > 0 ? sum / static_cast<double>(points) : 0.0; }

double SurfaceError::worst_on_faces() const { return std::max(from_mesh.worst, from_truth.worst); }
double SurfaceError::rms_on_faces() const {
  return std::sqrt((from_mesh.squares + from_truth.squares) /
                   static_cast<double>(std::max(1L, from_mesh.points + from_truth.points)));
}

ErrorMeasure::ErrorMeasure(const PeerScene& scene, const ErrorOptions& options)
    : truth_(scene), options_(options), box_(scene.blank.bounds()) {
  const stock::Workpiece part = scene.cut();
  find_ends(part);
  find_edges(scene, part);
}

// Uniform among the lines that meet the ball around the blank; s = 0 is before it.
Ray ErrorMeasure::line(std::uint64_t k) const {
  const RandomKey key{.seed = kSeedOfLines};
  const double z = 2.0 * uniform(key, 4 * k) - 1.0;
  const double phi = 2.0 * std::numbers::pi * uniform(key, 4 * k + 1);
  const double across = std::sqrt(1.0 - z * z);
  const Vec3 d(across * std::cos(phi), across * std::sin(phi), z);
  const Vec3 u = d.unitOrthogonal();
  const double radius = 0.5 * (box_.max - box_.min).norm();
  const double r = radius * std::sqrt(uniform(key, 4 * k + 2));
  const double psi = 2.0 * std::numbers::pi * uniform(key, 4 * k + 3);
  const Vec3 centre = 0.5 * (box_.min + box_.max);
  return {centre + r * (std::cos(psi) * u + std::sin(psi) * d.cross(u)) - radius * d, d};
}

void ErrorMeasure::find_ends(const stock::Workpiece& part) {
  const RaySpan span{0.0, (box_.max - box_.min).norm()};
  ends_.resize(static_cast<std::size_t>(options_.lines));
  for_each_index(ends_.size(), [&](std::size_t k) {
    const Ray ray = line(k);
    const IntervalSet material = part.material_along(ray, span);
    for (const Interval& piece : material.intervals()) {
      for (const auto& [s, tag] : {std::pair{piece.lo, piece.lo_tag}, {piece.hi, piece.hi_tag}}) {
        const stock::SurfacePoint met = part.surface_at(ray, s, tag);
        TrueEnd& end = ends_[k].emplace_back(
            TrueEnd{s, ray.at(s), std::abs(met.normal.dot(ray.direction)), {}});
        if (met.segment) end.off = truth_.of(end.point);
        end.off.is_machined = met.segment.has_value();
      }
    }
  });
  for (const auto& of_line : ends_) {
    for (const TrueEnd& end : of_line) {
      if (end.off.is_machined) exact_ends_.add(end.off.distance);
    }
  }
}

// Where cut faces meet those of the blank: ends on lines in its faces. Where cut faces meet: as the
// scene knows them.
void ErrorMeasure::find_edges(const PeerScene& scene, const stock::Workpiece& part) {
  const RandomKey key{.seed = kSeedOfEdges};
  const Vec3 size = box_.max - box_.min;
  for (int k = 0; k < options_.edges; ++k) {
    const auto i = static_cast<std::uint64_t>(k);
    // All faces but the bottom; a side and the top in turn, so that every other line is in the top.
    const int axis = k % 2 == 0 ? 2 : (k / 2) % 2;
    const bool low = axis < 2 && (k / 4) % 2 == 0;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 a = box_.min, d = Vec3::Zero();
    a[axis] = low ? box_.min[axis] + kBelowFace : box_.max[axis] - kBelowFace;
    a[u] += size[u] * uniform(key, 3 * i);
    a[v] += size[v] * uniform(key, 3 * i + 1);
    const double angle = 2.0 * std::numbers::pi * uniform(key, 3 * i + 2);
    d[u] = std::cos(angle);
    d[v] = std::sin(angle);
    const Ray ray{a - size.norm() * d, d};
    const IntervalSet material = part.material_along(ray, {0.0, 2.0 * size.norm()});
    for (const Interval& piece : material.intervals()) {
      for (const auto& [s, tag] : {std::pair{piece.lo, piece.lo_tag}, {piece.hi, piece.hi_tag}}) {
        if (part.surface_at(ray, s, tag).segment) edges_.push_back(ray.at(s));
      }
    }
  }
  const std::size_t step =
      std::max<std::size_t>(1, scene.inner_edges.size() / static_cast<std::size_t>(options_.edges));
  for (std::size_t k = 0; k < scene.inner_edges.size(); k += step) {
    const Vec3& p = scene.inner_edges[k];
    const bool within =
        (p.array() > box_.min.array()).all() && (p.array() < box_.max.array()).all();
    if (within && std::abs(truth_.of(p).distance) < kOnEdge) edges_.push_back(p);
  }
}

SurfaceError ErrorMeasure::of(const stock::SurfaceMesh& mesh) const {
  const FacetSolid solid(mesh.vertices, mesh.triangles);
  const RaySpan span{0.0, (box_.max - box_.min).norm()};
  struct OfLine {
    std::vector<PathTruth::Offset> crossings;
    std::vector<double> faces, edges, along;  // of true ends
    bool parted = false;
  };
  std::vector<OfLine> lines(ends_.size());
  for_each_index(ends_.size(), [&](std::size_t k) {
    const Ray ray = line(k);
    OfLine& mine = lines[k];
    for (const FacetSolid::Crossing& at : solid.crossings(ray)) {
      mine.crossings.push_back(truth_.of(ray.at(at.s)));
    }
    for (const TrueEnd& end : ends_[k]) {
      if (!end.off.is_machined) continue;
      (end.off.is_near_edge ? mine.edges : mine.faces).push_back(solid.nearest(end.point).distance);
    }
    const IntervalSet material = solid.along(ray, span);
    mine.parted = 2 * material.intervals().size() != ends_[k].size();
    for (std::size_t i = 0; !mine.parted && i < ends_[k].size(); ++i) {
      const Interval& piece = material.intervals()[i / 2];
      const TrueEnd& end = ends_[k][i];
      const double off = (i % 2 == 0 ? piece.lo : piece.hi) - end.s;
      if (std::abs(off) > kSameEnd) {
        mine.parted = true;
      } else if (end.off.is_machined && !end.off.is_near_edge) {
        mine.along.push_back(off * end.cosine);
      }
    }
  });

  SurfaceError error;
  error.lines = static_cast<long>(lines.size());
  const auto count_from_mesh = [&error](const PathTruth::Offset& off) {
    if (off.is_machined) (off.is_near_edge ? error.at_edges : error.from_mesh).add(off.distance);
  };
  for (const OfLine& each : lines) {
    for (const PathTruth::Offset& off : each.crossings) count_from_mesh(off);
    for (const double e : each.faces) error.from_truth.add(e);
    for (const double e : each.edges) error.at_edges.add(e);
    error.parted_lines += each.parted ? 1 : 0;
    if (each.parted) continue;
    for (const double e : each.along) error.along_lines.add(e);
  }

  std::vector<PathTruth::Offset> at_vertices(static_cast<std::size_t>(options_.vertices));
  const auto count = static_cast<double>(mesh.vertices.size());
  for_each_index(at_vertices.size(), [&](std::size_t k) {
    const auto v = static_cast<std::size_t>(count * uniform({.seed = kSeedOfVertices}, k));
    at_vertices[k] = truth_.of(mesh.vertices[std::min(v, mesh.vertices.size() - 1)]);
  });
  for (const PathTruth::Offset& off : at_vertices) count_from_mesh(off);

  std::vector<double> at_edges(edges_.size());
  for_each_index(edges_.size(),
                 [&](std::size_t k) { at_edges[k] = solid.nearest(edges_[k]).distance; });
  for (const double e : at_edges) error.at_edges.add(e);
  return error;
}

}  // namespace frustum::bench
