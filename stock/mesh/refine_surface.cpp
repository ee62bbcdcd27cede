#include "stock/mesh/refine_surface.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "stock/mesh/surface_mesh_vertex.hpp"
#include "stock/mesh/unfold_surface.hpp"

namespace frustum::stock {
namespace {

using RefinedTriangle = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// An edge that bends evenly and is within this share of the tolerance keeps its triangles within
// 4/3 * 0.7 = 0.93 of it; the rest is for surfaces that do not bend evenly.
constexpr double kEdgeShare = 0.7;
constexpr double kCentreShare = 0.9;
// How far beside its middle, in lengths, the surface of an edge is looked for. An arc of 106
// degrees rises by a quarter of its chord.
constexpr double kEdgeReach = 0.25;
// A sharp edge is looked for again with this share of the length.
constexpr double kSecondLook = 0.05;
// Normals farther apart than this (chord of unit vectors, about 30 degrees) have a sharp edge
// between them, or bend so much that looking for one does no harm.
constexpr double kMaybeSharp = 0.5;
// No surface leaves an edge shorter than this many tolerances by more than the tolerance, unless
// the edge is not on it.
constexpr double kShortest = 2.0;
// How far the middle of an edge may be moved along it, of its length.
constexpr double kMostSlide = 0.4;
// Each round halves what is too long: 2^40 is from a metre to a picometre.
constexpr int kMostRounds = 40;

struct Edge {
  std::uint32_t from = 0, to = 0;  // from < to
  std::array<std::uint32_t, 2> triangles{kNone, kNone};
};

struct Edges {
  std::vector<Edge> all{};
  std::vector<std::array<std::uint32_t, 3>> of_triangle{};  // edge k: from corner k to the next
};

// Nothing if some edge has not exactly two triangles.
std::optional<Edges> edges_of(const SurfaceMesh& mesh) {
  struct Side {
    std::uint64_t ends;
    std::uint64_t place;  // 3 * triangle + corner
    bool operator<(const Side& other) const {
      return ends != other.ends ? ends < other.ends : place < other.place;
    }
  };
  std::vector<Side> sides(3 * mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      sides[3 * t + k] = {std::uint64_t{low} << 32U | high, 3 * t + k};
    }
  });
  tbb::parallel_sort(sides.begin(), sides.end());
  Edges edges;
  edges.all.resize(sides.size() / 2);
  edges.of_triangle.resize(mesh.triangles.size());
  for (std::size_t s = 0; s < sides.size(); s += 2) {
    const bool pair = s + 1 < sides.size() && sides[s].ends == sides[s + 1].ends &&
                      (s + 2 == sides.size() || sides[s + 2].ends != sides[s].ends);
    if (!pair) return std::nullopt;
    const auto number = static_cast<std::uint32_t>(s / 2);
    Edge& edge = edges.all[number];
    edge.from = static_cast<std::uint32_t>(sides[s].ends >> 32U);
    edge.to = static_cast<std::uint32_t>(sides[s].ends & 0xFFFFFFFFU);
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint64_t place = sides[s + side].place;
      edge.triangles[side] = static_cast<std::uint32_t>(place / 3);
      edges.of_triangle[place / 3][place % 3] = number;
    }
  }
  return edges;
}

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

// What is beside the middle of an edge.
struct Middle {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  VertexKind kind = VertexKind::averaged;
  double chord = 0.0;  // mm from the middle to the surface
};

// One round on one mesh: what is too far from the surface, and the finer mesh.
class Round {
 public:
  Round(SolidView solid, const SurfaceMesh& mesh, Edges edges, std::uint32_t first_fresh,
        double chord)
      : solid_(solid),
        mesh_(mesh),
        edges_(std::move(edges)),
        first_fresh_(first_fresh),
        chord_(chord),
        split_(edges_.all.size(), 0),
        middles_(edges_.all.size()),
        asked_(edges_.all.size(), 0) {}

  // Marks edges to split; false when there are none.
  bool mark();
  [[nodiscard]] SurfaceMesh finer();
  [[nodiscard]] double worst_kept() const { return worst_kept_; }
  [[nodiscard]] std::size_t unresolved() const { return unresolved_; }
  [[nodiscard]] std::size_t triangles_after() const;

 private:
  [[nodiscard]] Vec3 vertex(std::uint32_t v) const { return mesh_.vertices[v]; }
  [[nodiscard]] Vec3 area_of(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return area_vector(vertex(a), vertex(b), vertex(c));
  }
  [[nodiscard]] double squared_length(std::uint32_t e) const {
    return (vertex(edges_.all[e].to) - vertex(edges_.all[e].from)).squaredNorm();
  }
  [[nodiscard]] std::uint32_t longest_edge(std::uint32_t t) const;
  [[nodiscard]] std::uint32_t opposite(const Edge& edge, std::size_t side) const;
  [[nodiscard]] bool is_fresh(const RefinedTriangle& corners) const {
    return std::any_of(corners.begin(), corners.end(),
                       [&](std::uint32_t v) { return v >= first_fresh_; });
  }
  [[nodiscard]] bool ends_on_surface(const Edge& edge) const {
    return mesh_.kinds[edge.from] != VertexKind::averaged &&
           mesh_.kinds[edge.to] != VertexKind::averaged;
  }
  [[nodiscard]] Vec3 outward_of(const Edge& edge) const;
  [[nodiscard]] Middle middle_of(const Edge& edge) const;
  [[nodiscard]] std::optional<std::array<HermiteSample, 2>> both_faces(const Edge& edge,
                                                                       const Vec3& at,
                                                                       double aside) const;
  [[nodiscard]] std::optional<Middle> sharp_middle(const Edge& edge, const Vec3& middle,
                                                   double length) const;
  [[nodiscard]] double centre_chord(std::uint32_t t) const;
  void spread_to_longest();
  template <typename Visit>
  void for_each_child(std::uint32_t t, const Visit& visit) const;

  SolidView solid_;
  const SurfaceMesh& mesh_;
  Edges edges_;
  std::uint32_t first_fresh_;
  double chord_;
  std::vector<std::uint8_t> split_;
  std::vector<Middle> middles_;
  std::vector<std::uint8_t> asked_;
  std::vector<std::uint32_t> number_{};  // of the new vertex on each edge
  double worst_kept_ = 0.0;
  std::size_t unresolved_ = 0;
};

std::uint32_t Round::longest_edge(std::uint32_t t) const {
  const auto& three = edges_.of_triangle[t];
  std::uint32_t longest = three[0];
  for (const std::uint32_t e : {three[1], three[2]}) {
    const double here = squared_length(e);
    const double best = squared_length(longest);
    // The number decides between equal ones, so that both triangles at an edge see the same order.
    if (here > best || (here == best && e < longest)) longest = e;
  }
  return longest;
}

std::uint32_t Round::opposite(const Edge& edge, std::size_t side) const {
  const RefinedTriangle& corners = mesh_.triangles[edge.triangles[side]];
  return *std::find_if(corners.begin(), corners.end(),
                       [&](std::uint32_t v) { return v != edge.from && v != edge.to; });
}

// The surface of the two faces at an edge, each `aside` mm from `at` into its triangle.
std::optional<std::array<HermiteSample, 2>> Round::both_faces(const Edge& edge, const Vec3& at,
                                                              double aside) const {
  const Vec3 along = (vertex(edge.to) - vertex(edge.from)).normalized();
  std::array<HermiteSample, 2> samples;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 area = area_of(edge.triangles[side]);
    if (!(area.norm() > 0.0)) return std::nullopt;
    const Vec3 normal = area.normalized();
    // Out of the opposite corner's way along the edge: the vertex is to be in its middle.
    const Vec3 to_corner = vertex(opposite(edge, side)) - vertex(edge.from);
    const Vec3 across = (to_corner - along.dot(to_corner) * along).normalized();
    const auto found = nearest_surface(solid_, at + aside * across, normal, 2.0 * aside);
    if (!found) return std::nullopt;
    samples[side] = *found;
  }
  return samples;
}

// The vertex where the faces on both sides of the edge meet; nothing if they are one smooth face.
// The second search starts next to the first answer, where bent faces are closer to their planes.
std::optional<Middle> Round::sharp_middle(const Edge& edge, const Vec3& middle,
                                          double length) const {
  Vec3 at = middle;
  std::optional<PlacedVertex> placed;
  for (const double size : {length, kSecondLook * length}) {
    const auto samples = both_faces(edge, at, 0.5 * kEdgeReach * size);
    if (!samples) return std::nullopt;
    const Vec3 half = Vec3::Constant(0.5 * size);
    placed = place_vertex(solid_, *samples, {at - half, at + half}, 0.0);
    if (placed->kind != VertexKind::feature) return std::nullopt;
    at = placed->point;
  }
  // Along the edge it may slide, but not to its ends.
  if ((at - middle).norm() > kMostSlide * length) return std::nullopt;
  const Vec3 along = (vertex(edge.to) - vertex(edge.from)) / length;
  return Middle{at, placed->normal, placed->kind, (at - middle).cross(along).norm()};
}

// Exact normals say more than triangles, which may be askew; at a sharp edge there are several.
Vec3 Round::outward_of(const Edge& edge) const {
  Vec3 exact = Vec3::Zero();
  for (const std::uint32_t v : {edge.from, edge.to}) {
    if (mesh_.kinds[v] != VertexKind::feature) exact += mesh_.normals[v];
  }
  if (!exact.isZero()) return exact;
  return area_of(edge.triangles[0]) + area_of(edge.triangles[1]);
}

Middle Round::middle_of(const Edge& edge) const {
  const Vec3 at = 0.5 * (vertex(edge.from) + vertex(edge.to));
  const double length = (vertex(edge.to) - vertex(edge.from)).norm();
  const bool both_feature =
      mesh_.kinds[edge.from] == VertexKind::feature && mesh_.kinds[edge.to] == VertexKind::feature;
  const bool between_faces =
      mesh_.kinds[edge.from] != VertexKind::feature &&
      mesh_.kinds[edge.to] != VertexKind::feature &&
      (mesh_.normals[edge.from] - mesh_.normals[edge.to]).norm() > kMaybeSharp;
  if (both_feature || between_faces) {
    if (const auto sharp = sharp_middle(edge, at, length)) return *sharp;
  }
  const Vec3 along = (vertex(edge.to) - vertex(edge.from)) / length;
  const double reach = kEdgeReach * length + chord_;
  // Along the mean of its ends' normals; where nothing is found, along one of both.
  const std::array<Vec3, 3> ways{outward_of(edge), mesh_.normals[edge.from],
                                 mesh_.normals[edge.to]};
  for (const Vec3& towards : ways) {
    if (!(towards.norm() > 0.0)) continue;
    const Vec3 normal = towards.normalized();
    const auto found = nearest_surface(solid_, at, normal, reach);
    if (!found || found->normal.dot(normal) < 0.5) continue;
    const Vec3 way = found->point - at;
    // At an end of the edge it would make the same edge again.
    if (std::abs(way.dot(along)) > kMostSlide * length) continue;
    return {found->point, found->normal, VertexKind::surface,
            way.norm() * found->normal.dot(normal)};
  }
  const Vec3& outward = ways[0].norm() > 0.0 ? ways[0] : ways[1];
  return {at, outward.normalized(), VertexKind::averaged, 0.0};
}

double Round::centre_chord(std::uint32_t t) const {
  const auto& [a, b, c] = mesh_.triangles[t];
  const Vec3 area = area_of(t);
  const double size = std::sqrt(area.norm());
  if (!(size > 0.0)) return 0.0;
  const Vec3 centre = (vertex(a) + vertex(b) + vertex(c)) / 3.0;
  const Vec3 normal = area.normalized();
  const auto found = nearest_surface(solid_, centre, normal, kEdgeReach * size);
  if (!found || found->normal.dot(normal) < 0.5) return 0.0;
  return (found->point - centre).norm() * found->normal.dot(normal);
}

// Any triangle that is split is split across its longest edge.
void Round::spread_to_longest() {
  std::vector<std::uint32_t> open;
  for (std::uint32_t e = 0; e < edges_.all.size(); ++e) {
    if (split_[e] != 0) open.push_back(e);
  }
  while (!open.empty()) {
    const Edge& edge = edges_.all[open.back()];
    open.pop_back();
    for (const std::uint32_t t : edge.triangles) {
      const std::uint32_t longest = longest_edge(t);
      if (split_[longest] != 0) continue;
      split_[longest] = 1;
      open.push_back(longest);
    }
  }
}

bool Round::mark() {
  const auto edge_count = static_cast<std::uint32_t>(edges_.all.size());
  tbb::parallel_for(std::uint32_t{0}, edge_count, [&](std::uint32_t e) {
    const Edge& edge = edges_.all[e];
    if (edge.to < first_fresh_) return;  // asked in an earlier round
    middles_[e] = middle_of(edge);
    asked_[e] = 1;
    const bool is_long = squared_length(e) > kShortest * kShortest * chord_ * chord_;
    // Of what ends off the surface one part would be no nearer to it than the whole.
    split_[e] = ends_on_surface(edge) && is_long && middles_[e].chord > kEdgeShare * chord_ ? 1 : 0;
  });
  const auto triangle_count = static_cast<std::uint32_t>(mesh_.triangles.size());
  std::vector<double> centres(triangle_count, 0.0);
  tbb::parallel_for(std::uint32_t{0}, triangle_count, [&](std::uint32_t t) {
    const auto& three = edges_.of_triangle[t];
    const bool splits =
        std::any_of(three.begin(), three.end(), [&](std::uint32_t e) { return split_[e] != 0; });
    if (!splits && is_fresh(mesh_.triangles[t])) centres[t] = centre_chord(t);
  });
  for (std::uint32_t t = 0; t < triangle_count; ++t) {
    if (centres[t] > kCentreShare * chord_ &&
        squared_length(longest_edge(t)) > kShortest * kShortest * chord_ * chord_) {
      split_[longest_edge(t)] = 1;
    } else {
      worst_kept_ = std::max(worst_kept_, centres[t]);
    }
  }
  for (std::uint32_t e = 0; e < edge_count; ++e) {
    if (asked_[e] == 0 || split_[e] != 0) continue;
    worst_kept_ = std::max(worst_kept_, middles_[e].chord);
    const bool is_on = ends_on_surface(edges_.all[e]);
    if (!is_on || middles_[e].kind == VertexKind::averaged) ++unresolved_;
  }
  spread_to_longest();
  return std::find(split_.begin(), split_.end(), 1) != split_.end();
}

std::size_t Round::triangles_after() const {
  // Every split edge divides the two triangles at it.
  return mesh_.triangles.size() +
         2 * static_cast<std::size_t>(std::count(split_.begin(), split_.end(), 1));
}

// The triangles that replace triangle t: it is bisected across its longest edge, then each half
// across its own split edge. Corners are given as new vertex numbers.
template <typename Visit>
void Round::for_each_child(std::uint32_t t, const Visit& visit) const {
  const RefinedTriangle& corners = mesh_.triangles[t];
  const auto& three = edges_.of_triangle[t];
  const std::uint32_t longest = longest_edge(t);
  if (split_[longest] == 0) return visit(corners);
  const auto k =
      static_cast<std::size_t>(std::find(three.begin(), three.end(), longest) - three.begin());
  const std::uint32_t a = corners[k];
  const std::uint32_t b = corners[(k + 1) % 3];
  const std::uint32_t c = corners[(k + 2) % 3];
  const std::uint32_t m = number_[longest];
  const auto halve = [&](std::uint32_t edge, const RefinedTriangle& half) {
    // half: m, then the ends of the edge
    if (split_[edge] == 0) return visit(half);
    visit(RefinedTriangle{half[0], half[1], number_[edge]});
    visit(RefinedTriangle{half[0], number_[edge], half[2]});
  };
  halve(three[(k + 1) % 3], {m, b, c});
  halve(three[(k + 2) % 3], {m, c, a});
}

SurfaceMesh Round::finer() {
  tbb::parallel_for(std::size_t{0}, edges_.all.size(), [&](std::size_t e) {
    if (split_[e] != 0 && asked_[e] == 0) middles_[e] = middle_of(edges_.all[e]);
  });
  number_.assign(edges_.all.size(), kNone);
  auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (std::size_t e = 0; e < number_.size(); ++e) {
    if (split_[e] != 0) number_[e] = next++;
  }
  SurfaceMesh finer;
  finer.vertices = mesh_.vertices;
  finer.normals = mesh_.normals;
  finer.kinds = mesh_.kinds;
  for (std::size_t e = 0; e < number_.size(); ++e) {
    if (split_[e] == 0) continue;
    finer.vertices.push_back(middles_[e].point);
    finer.normals.push_back(middles_[e].normal);
    finer.kinds.push_back(middles_[e].kind);
  }
  finer.triangles.reserve(triangles_after());
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    for_each_child(t, [&](const RefinedTriangle& child) { finer.triangles.push_back(child); });
  }
  return finer;
}

// Vertices that were left off the surface, because the coarse grid saw too little of it, are looked
// for again: along their normals, as far as half of their shortest edge.
void settle_averaged(SolidView solid, SurfaceMesh& mesh) {
  std::vector<double> reach(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  for (const RefinedTriangle& corners : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[k];
      const std::uint32_t b = corners[(k + 1) % 3];
      if (mesh.kinds[a] != VertexKind::averaged && mesh.kinds[b] != VertexKind::averaged) continue;
      const double half = 0.5 * (mesh.vertices[b] - mesh.vertices[a]).norm();
      reach[a] = std::min(reach[a], half);
      reach[b] = std::min(reach[b], half);
    }
  }
  tbb::parallel_for(std::size_t{0}, mesh.vertices.size(), [&](std::size_t v) {
    if (mesh.kinds[v] != VertexKind::averaged || !std::isfinite(reach[v])) return;
    const auto found = nearest_surface(solid, mesh.vertices[v], mesh.normals[v], reach[v]);
    if (!found || found->normal.dot(mesh.normals[v]) < 0.5) return;
    mesh.vertices[v] = found->point;
    mesh.normals[v] = found->normal;
    mesh.kinds[v] = VertexKind::surface;
  });
}

}  // namespace

Result<RefinedSurface> refine_surface(SolidView solid, SurfaceMesh coarse,
                                      const RefineOptions& options) {
  const double chord = options.chord.value;
  if (!std::isfinite(chord) || chord <= 0.0) {
    return error("mesh-tolerance"_id, fmt::format("the chord tolerance is {} mm", chord),
                 "it must be a finite number above 0");
  }
  if (coarse.normals.size() != coarse.vertices.size() ||
      coarse.kinds.size() != coarse.vertices.size()) {
    return error("mesh-normals"_id, "the mesh to be refined has no normals",
                 "use one of extract_surface()");
  }
  RefinedSurface refined;
  refined.mesh = std::move(coarse);
  refined.mesh.deviation.clear();
  settle_averaged(solid, refined.mesh);
  std::uint32_t first_fresh = 0;
  for (; refined.rounds < kMostRounds; ++refined.rounds) {
    auto edges = edges_of(refined.mesh);
    if (!edges) {
      return error("mesh-open"_id, "the mesh to be refined is not closed",
                   "every edge needs two triangles");
    }
    Round round(solid, refined.mesh, std::move(*edges), first_fresh, chord);
    const bool any = round.mark();
    refined.worst_chord = std::max(refined.worst_chord, round.worst_kept());
    refined.unresolved_edges += round.unresolved();
    if (!any) break;
    if (round.triangles_after() > options.max_triangles) {
      return error("mesh-size"_id,
                   fmt::format("a chord tolerance of {} mm needs more than {} triangles", chord,
                               options.max_triangles),
                   "use a larger one");
    }
    first_fresh = static_cast<std::uint32_t>(refined.mesh.vertices.size());
    refined.mesh = round.finer();
  }
  // Where edges were divided that no surface was found beside.
  settle_averaged(solid, refined.mesh);
  unfold_surface(refined.mesh);
  refined.unresolved_vertices =
      static_cast<std::size_t>(std::ranges::count(refined.mesh.kinds, VertexKind::averaged));
  return refined;
}

}  // namespace frustum::stock
