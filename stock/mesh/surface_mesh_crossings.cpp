#include "stock/mesh/surface_mesh_crossings.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace frustum::stock {
namespace {

using Node = std::array<int, 3>;

// Where a ray passes from material to void or back.
struct End {
  double s = 0.0;
  EndTag tag = -1;
  bool leaves = false;  // the material is before s
  bool operator==(const End&) const = default;
};

bool are_same_bits(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), sizeof(Vec3)) == 0;
}
bool are_same_bits(const HermiteSample& a, const HermiteSample& b) {
  return a.tag == b.tag && are_same_bits(a.point, b.point) && are_same_bits(a.normal, b.normal);
}

// Edges of a Z column: between the last node before a run of inside nodes and its first, and at its
// other end. Intervals without a node in between run on.
std::vector<CrossingEdge> edges_along(std::span<const Interval> material, double pitch) {
  std::vector<CrossingEdge> edges;
  for (const Interval& piece : material) {
    const auto first = static_cast<std::int32_t>(std::ceil(piece.lo / pitch));
    const auto last = static_cast<std::int32_t>(std::floor(piece.hi / pitch));
    if (last < first) continue;
    if (!edges.empty() && edges.back().level + 1 >= first) {
      edges.back().level = std::max(edges.back().level, last);
    } else {
      edges.push_back({first - 1, false});
      edges.push_back({last, true});
    }
  }
  return edges;
}

// Edges from one Z column to the next: the levels at which exactly one of the two is inside.
std::vector<CrossingEdge> edges_between(std::span<const CrossingEdge> here,
                                        std::span<const CrossingEdge> there) {
  std::vector<CrossingEdge> edges;
  bool inside_here = false;
  bool inside_there = false;
  std::size_t a = 0;
  std::size_t b = 0;
  while (a < here.size() || b < there.size()) {
    const bool step_here =
        b == there.size() || (a < here.size() && here[a].level <= there[b].level);
    const std::int32_t from = (step_here ? here[a] : there[b]).level + 1;
    if (step_here) {
      inside_here = !inside_here;
      ++a;
    } else {
      inside_there = !inside_there;
      ++b;
    }
    if (inside_here == inside_there || (a == here.size() && b == there.size())) continue;
    const std::int32_t next_here =
        a < here.size() ? here[a].level : std::numeric_limits<std::int32_t>::max();
    const std::int32_t next_there =
        b < there.size() ? there[b].level : std::numeric_limits<std::int32_t>::max();
    for (std::int32_t k = from; k <= std::min(next_here, next_there); ++k) {
      edges.push_back({k, inside_here});
    }
  }
  return edges;
}

std::span<const Interval> material_through(const TriDexel& dexels, int axis, const Node& node) {
  return dexels.material(axis, node[static_cast<std::size_t>((axis + 1) % 3)],
                         node[static_cast<std::size_t>((axis + 2) % 3)]);
}

Ray ray_through(const DexelGrid& grid, int axis, const Node& node) {
  return grid.ray(axis, node[static_cast<std::size_t>((axis + 1) % 3)],
                  node[static_cast<std::size_t>((axis + 2) % 3)]);
}

HermiteSample surface_at(SolidView solid, const Ray& ray, const End& end) {
  if (end.tag == -1) {  // cut off at the border of the grid
    return {ray.at(end.s), end.leaves ? ray.direction : Vec3(-ray.direction)};
  }
  const SurfacePoint found = solid.surface_at(ray, end.s, end.tag);
  return {ray.at(end.s), found.normal, end.tag};
}

// The end of the wanted kind between s = lo and hi that is next to the inside node.
std::optional<End> end_between(std::span<const Interval> material, double lo, double hi,
                               bool leaves) {
  const auto begin = std::partition_point(material.begin(), material.end(),
                                          [&](const Interval& piece) { return piece.hi < lo; });
  std::optional<End> best;
  for (auto piece = begin; piece != material.end() && piece->lo <= hi; ++piece) {
    if (leaves && piece->hi <= hi) return End{piece->hi, piece->hi_tag, true};
    if (!leaves && piece->lo >= lo) best = End{piece->lo, piece->lo_tag, false};
  }
  return best;
}

// The end nearest to a node on any of the three rays through it.
HermiteSample nearest_end(SolidView solid, const TriDexel& dexels, const Node& node, int axis,
                          bool leaves) {
  const DexelGrid& grid = dexels.grid();
  double distance = std::numeric_limits<double>::infinity();
  End best;
  int best_axis = axis;
  for (int d = 0; d < 3; ++d) {
    const double at = grid.pitch * node[static_cast<std::size_t>(d)];
    for (const Interval& piece : material_through(dexels, d, node)) {
      for (const End& end :
           {End{piece.lo, piece.lo_tag, false}, End{piece.hi, piece.hi_tag, true}}) {
        if (std::abs(end.s - at) >= distance) continue;
        distance = std::abs(end.s - at);
        best = end;
        best_axis = d;
      }
    }
  }
  const Vec3 point = grid.node(node[0], node[1], node[2]);
  const double sign = leaves ? 1.0 : -1.0;
  if (distance > grid.pitch) return {point, sign * Vec3::Unit(axis)};
  return {point, surface_at(solid, ray_through(grid, best_axis, node), best).normal};
}

bool inside_along(std::span<const Interval> material, double s) {
  const auto piece = std::partition_point(material.begin(), material.end(),
                                          [s](const Interval& m) { return m.hi < s; });
  return piece != material.end() && piece->lo <= s;
}

// The end on an edge from the node, on the ray that the edge is of.
std::optional<End> end_on(const TriDexel& dexels, int axis, const Node& node, bool leaves) {
  // Rays of two directions through a node see it on different sides only within their accuracy of
  // 1 nm; a grazing ray segments that. Ends this little beyond the edge are taken as on it.
  constexpr double kRounding = 1e-6;  // mm
  const double pitch = dexels.grid().pitch;
  const double lo = pitch * node[static_cast<std::size_t>(axis)];
  return end_between(material_through(dexels, axis, node), lo - kRounding, lo + pitch + kRounding,
                     leaves);
}

HermiteSample sample_of(SolidView solid, const TriDexel& dexels, int axis, const Node& node,
                        const std::optional<End>& end, bool leaves) {
  const double pitch = dexels.grid().pitch;
  const double lo = pitch * node[static_cast<std::size_t>(axis)];
  const double hi = lo + pitch;
  if (end) {
    const Ray ray = ray_through(dexels.grid(), axis, node);
    HermiteSample found = surface_at(solid, ray, *end);
    found.point = ray.at(std::clamp(end->s, lo, hi));
    return found;
  }
  // The disputed node is the one that this ray puts on the other side.
  Node disputed = node;
  if (inside_along(material_through(dexels, axis, node), lo) == leaves)
    ++disputed[static_cast<std::size_t>(axis)];
  return nearest_end(solid, dexels, disputed, axis, leaves);
}

}  // namespace

Crossings::Crossings(SolidView solid, const TriDexel& dexels, const Known& known)
    : grid_(dexels.grid()) {
  for (const int axis : {2, 0, 1}) {  // Z first: it decides what is inside
    find_edges(dexels, axis);
    sample_edges(solid, dexels, axis, known);
  }
}

void Crossings::find_edges(const TriDexel& dexels, int axis) {
  Family& family = families_[static_cast<std::size_t>(axis)];
  const int nx = grid_.nodes[0];
  const int ny = grid_.nodes[1];
  family.first.assign(column(0, ny) + 1, 0);
  std::vector<std::vector<CrossingEdge>> rows(static_cast<std::size_t>(ny));
  tbb::parallel_for(0, axis == 1 ? ny - 1 : ny, [&](int j) {
    std::vector<CrossingEdge>& row = rows[static_cast<std::size_t>(j)];
    for (int i = 0; i < (axis == 0 ? nx - 1 : nx); ++i) {
      const auto found = axis == 2 ? edges_along(dexels.material(2, i, j), grid_.pitch)
                                   : edges_between(edges(2, i, j), axis == 0 ? edges(2, i + 1, j)
                                                                             : edges(2, i, j + 1));
      row.insert(row.end(), found.begin(), found.end());
      family.first[column(i, j) + 1] = found.size();
    }
  });
  std::partial_sum(family.first.begin(), family.first.end(), family.first.begin());
  family.edges.reserve(family.first.back());
  for (const auto& row : rows) family.edges.insert(family.edges.end(), row.begin(), row.end());
}

void Crossings::sample_edges(SolidView solid, const TriDexel& dexels, int axis,
                             const Known& known) {
  Family& family = families_[static_cast<std::size_t>(axis)];
  family.samples.resize(family.edges.size());
  family.known.assign(family.edges.size(), 0);
  const auto sample_edge = [&](std::size_t e, const Node& node, bool leaves) {
    const auto end = end_on(dexels, axis, node, leaves);
    const auto before = known.crossings != nullptr
                            ? known.crossings->find(axis, node[0], node[1], node[2])
                            : std::nullopt;
    if (before && known.crossings->lower_inside(*before, axis) == leaves) {
      const HermiteSample& sample = known.crossings->sample(*before, axis);
      const bool ends_so = end && end == end_on(*known.dexels, axis, node, leaves);
      family.samples[e] = ends_so ? sample : sample_of(solid, dexels, axis, node, end, leaves);
      family.known[e] = ends_so || are_same_bits(family.samples[e], sample) ? 1 : 0;
    } else {
      family.samples[e] = sample_of(solid, dexels, axis, node, end, leaves);
    }
  };
  tbb::parallel_for(0, grid_.nodes[1], [&](int j) {
    for (int i = 0; i < grid_.nodes[0]; ++i) {
      for (std::size_t e = first(axis, i, j); e < family.first[column(i, j) + 1]; ++e) {
        sample_edge(e, {i, j, family.edges[e].level}, family.edges[e].lower_inside);
      }
    }
  });
}

std::span<const CrossingEdge> Crossings::edges(int axis, int i, int j) const {
  const Family& family = families_[static_cast<std::size_t>(axis)];
  const std::size_t from = family.first[column(i, j)];
  return std::span(family.edges).subspan(from, family.first[column(i, j) + 1] - from);
}

std::size_t Crossings::first(int axis, int i, int j) const {
  return families_[static_cast<std::size_t>(axis)].first[column(i, j)];
}

std::optional<std::size_t> Crossings::find(int axis, int i, int j, int level) const {
  const auto column_edges = edges(axis, i, j);
  const auto found =
      std::partition_point(column_edges.begin(), column_edges.end(),
                           [level](const CrossingEdge& edge) { return edge.level < level; });
  if (found == column_edges.end() || found->level != level) return std::nullopt;
  return first(axis, i, j) + static_cast<std::size_t>(found - column_edges.begin());
}

bool Crossings::inside(int i, int j, int k) const {
  const auto column_edges = edges(2, i, j);
  const auto above = std::partition_point(column_edges.begin(), column_edges.end(),
                                          [k](const CrossingEdge& edge) { return edge.level < k; });
  return above != column_edges.begin() && !std::prev(above)->lower_inside;
}

}  // namespace frustum::stock
