#include "stock/mesh/unfold_surface.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "stock/mesh/triangle_links.hpp"

namespace frustum::stock {
namespace {

using Corners = std::array<std::uint32_t, 3>;

// A cure that takes an edge of the solid away must be better by this than one that does not, as a
// cosine.
constexpr double kEdgeWorth = 0.5;
// A cure that leaves as many wrong triangles must better them by this, as a cosine.
constexpr double kGain = 0.01;
// What does not, but takes a vertex of the fold away, is tried when nothing else is left.
constexpr double kLastResort = 100.0;
// What one cure leaves behind is the next one's; folds of folds end after a few.
constexpr int kMostPasses = 8;
constexpr double kUnknown = -1.0;  // of a triangle without area
// Corners whose normals are farther apart (cosine of 120 degrees) are on both faces of a blade: a
// triangle across its edge has no side that their mean would tell.
constexpr double kOpposed = -0.5;

// The cosine between a triangle's normal and the exact ones: the least of those at smooth corners,
// no more than that of the mean.
double facing(const SurfaceMesh& mesh, const Corners& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 ab = mesh.vertices[b] - mesh.vertices[a];
  const Vec3 ac = mesh.vertices[c] - mesh.vertices[a];
  const Vec3 area = ab.cross(ac);
  const double length = area.norm();
  if (!(length > 1e-6 * std::max(ab.squaredNorm(), ac.squaredNorm()))) return kUnknown;
  const Vec3 normal = area / length;
  Vec3 sum = Vec3::Zero();
  double least = 1.0;
  for (const std::uint32_t v : corners) {
    sum += mesh.normals[v];
    if (mesh.kinds[v] == VertexKind::surface) {
      least = std::min(least, normal.dot(mesh.normals[v]));
    }
  }
  const double mean = sum.norm();
  return mean > 0.0 ? std::min(least, normal.dot(sum) / mean) : least;
}

bool is_inward(const SurfaceMesh& mesh, const Corners& corners) {
  const Vec3& a = mesh.vertices[corners[0]];
  const Vec3 area = (mesh.vertices[corners[1]] - a).cross(mesh.vertices[corners[2]] - a);
  std::array<Vec3, 3> normals;
  for (std::size_t k = 0; k < 3; ++k) normals[k] = mesh.normals[corners[k]];
  bool opposed = false, against_all = true;
  for (std::size_t k = 0; k < 3; ++k) {
    opposed = opposed || normals[k].dot(normals[(k + 1) % 3]) < kOpposed;
    against_all = against_all && area.dot(normals[k]) < 0.0;
  }
  return opposed ? against_all : area.dot(normals[0] + normals[1] + normals[2]) < 0.0;
}

std::vector<std::uint32_t> inward(const SurfaceMesh& mesh) {
  std::vector<std::uint8_t> is(mesh.triangles.size(), 0);
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(),
                    [&](std::size_t t) { is[t] = is_inward(mesh, mesh.triangles[t]) ? 1 : 0; });
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < is.size(); ++t) {
    if (is[t] != 0) found.push_back(t);
  }
  return found;
}

// What is there before a cure, or after it.
struct State {
  int wrong = 0;       // triangles that face inwards or have no area
  double least = 1.0;  // facing()

  void add(const SurfaceMesh& mesh, const Corners& corners) {
    const double faces = facing(mesh, corners);
    least = std::min(least, faces);
    if (faces == kUnknown || is_inward(mesh, corners)) ++wrong;
  }
};

class Unfolding {
 public:
  Unfolding(const SurfaceMesh& mesh, TriangleLinks links) : mesh_(mesh), links_(std::move(links)) {}

  // True if something was done about the triangle.
  bool mend(std::uint32_t triangle) {
    if (drop_flake(triangle)) return true;
    std::optional<Cure> best;
    const auto offer = [&](const std::optional<Cure>& cure) {
      if (cure && (!best || cure->worth > best->worth)) best = cure;
    };
    const Corners corners = links_.triangles[triangle];
    for (std::uint32_t k = 0; k < 3; ++k) {
      offer(flipped(3 * triangle + k));
      links_.for_each_leaving(corners[k], [&](std::uint32_t half) { offer(collapsed(half)); });
    }
    if (!best) return false;
    if (best->flips) {
      links_.flip(best->half);
    } else {
      links_.collapse(best->half);
    }
    return true;
  }
  [[nodiscard]] const TriangleLinks& links() const { return links_; }

 private:
  struct Cure {
    std::uint32_t half;
    bool flips;
    double worth;
  };

  // Four triangles for themselves with one of them inside out: no solid.
  bool drop_flake(std::uint32_t triangle) {
    const Corners corners = links_.triangles[triangle];
    const bool is_flake =
        std::ranges::all_of(corners, [&](std::uint32_t v) { return links_.valence(v) == 3; });
    if (!is_flake) return false;
    const std::uint32_t apex =
        links_.from(TriangleLinks::before(links_.across[3 * std::size_t{triangle}]));
    if (links_.valence(apex) != 3) return false;
    std::array<std::uint32_t, 4> all{triangle};
    for (std::uint32_t k = 0; k < 3; ++k) all[k + 1] = links_.across[3 * triangle + k] / 3;
    for (const std::uint32_t t : all) {
      for (const std::uint32_t v : links_.triangles[t]) links_.leaving[v] = TriangleLinks::kGone;
    }
    for (const std::uint32_t t : all) links_.triangles[t].fill(TriangleLinks::kGone);
    return true;
  }

  // Nothing if it leaves as many wrong triangles as before, unless they are less so or fewer.
  [[nodiscard]] static std::optional<Cure> cure(std::uint32_t half, bool flips, const State& before,
                                                const State& after, double price) {
    if (after.wrong > before.wrong) return std::nullopt;
    const bool helps = after.wrong < before.wrong || after.least > before.least + kGain;
    if (!helps && flips) return std::nullopt;
    if (!helps) price += kLastResort;
    return Cure{half, flips, after.least - price - 2.0 * (after.wrong - before.wrong)};
  }
  [[nodiscard]] std::optional<Cure> flipped(std::uint32_t half) const {
    if (!links_.may_flip(half)) return std::nullopt;
    const std::uint32_t back = links_.across[half];
    const std::uint32_t a = links_.from(half), b = links_.to(half);
    const std::uint32_t left = links_.from(TriangleLinks::before(half));
    const std::uint32_t right = links_.from(TriangleLinks::before(back));
    State before, after;
    before.add(mesh_, {a, b, left});
    before.add(mesh_, {b, a, right});
    after.add(mesh_, {a, right, left});
    after.add(mesh_, {right, b, left});
    return cure(half, true, before, after, 0.0);
  }
  [[nodiscard]] std::optional<Cure> collapsed(std::uint32_t half) const {
    if (!links_.may_collapse(half)) return std::nullopt;
    const std::uint32_t goes = links_.from(half), stays = links_.to(half);
    State before, after;
    links_.for_each_leaving(goes, [&](std::uint32_t mine) {
      Corners corners = links_.triangles[mine / 3];
      before.add(mesh_, corners);
      if (std::ranges::find(corners, stays) != corners.end()) return;
      std::ranges::replace(corners, goes, stays);
      after.add(mesh_, corners);
    });
    const bool costs_edge =
        mesh_.kinds[goes] == VertexKind::feature && mesh_.kinds[stays] != VertexKind::feature;
    return cure(half, false, before, after, costs_edge ? kEdgeWorth : 0.0);
  }

  const SurfaceMesh& mesh_;
  TriangleLinks links_;
};

// Vertices that nothing names any more go.
void keep_linked(SurfaceMesh& mesh, const TriangleLinks& links) {
  std::vector<std::uint32_t> number(mesh.vertices.size(), TriangleLinks::kGone);
  std::uint32_t count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (links.leaving[v] == TriangleLinks::kGone) continue;
    mesh.vertices[count] = mesh.vertices[v];
    mesh.normals[count] = mesh.normals[v];
    mesh.kinds[count] = mesh.kinds[v];
    number[v] = count++;
  }
  mesh.vertices.resize(count);
  mesh.normals.resize(count);
  mesh.kinds.resize(count);
  mesh.triangles.clear();
  for (const auto& [a, b, c] : links.triangles) {
    if (a != TriangleLinks::kGone) mesh.triangles.push_back({number[a], number[b], number[c]});
  }
}

}  // namespace

std::size_t inward_triangles(const SurfaceMesh& mesh) { return inward(mesh).size(); }

void unfold_surface(SurfaceMesh& mesh) {
  std::vector<std::uint32_t> open = inward(mesh);
  if (open.empty()) return;
  auto links = linked(mesh.triangles, mesh.vertices.size());
  if (!links) return;
  Unfolding unfolding(mesh, *std::move(links));
  for (int pass = 0; pass < kMostPasses && !open.empty(); ++pass) {
    bool any = false;
    for (const std::uint32_t t : open) {
      if (unfolding.links().is_gone(t) || !is_inward(mesh, unfolding.links().triangles[t]))
        continue;
      any = unfolding.mend(t) || any;
    }
    open.clear();
    for (std::uint32_t t = 0; t < unfolding.links().triangles.size(); ++t) {
      const TriangleLinks& now = unfolding.links();
      if (!now.is_gone(t) && is_inward(mesh, now.triangles[t])) open.push_back(t);
    }
    if (!any) break;
  }
  keep_linked(mesh, unfolding.links());
}

}  // namespace frustum::stock
