#include "stock/dexel/tri_dexel.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "stock/dexel/reached_rays.hpp"

namespace frustum::stock {
namespace {

// Irrational, and neither equal nor summing to one in pairs, so that planes at 45 degrees are safe
// too: sqrt(7) - 2, sqrt(2) - 1, 2 - sqrt(3).
constexpr std::array<double, 3> kShift{0.64575131106459059, 0.41421356237309505,
                                       0.26794919243112270};

// Rays of a tile, in each direction.
constexpr int kTile = 16;

// Nodes that the box needs along one axis, as a double because nobody has checked its size yet.
double nodes_needed(double from, double to, double pitch, double shift) {
  return std::ceil((to - from) / pitch + 1.0 + shift) + 2.0;
}

std::array<double, 3> nodes_needed(const BoundingBox& box, double pitch) {
  std::array<double, 3> nodes{};
  for (int d = 0; d < 3; ++d) {
    const auto at = static_cast<std::size_t>(d);
    nodes[at] = nodes_needed(box.min[d], box.max[d], pitch, kShift[at]);
  }
  return nodes;
}

double rays_needed(const BoundingBox& box, double pitch) {
  const auto n = nodes_needed(box, pitch);
  return n[0] * n[1] + n[1] * n[2] + n[2] * n[0];
}

Diagnostic too_fine(const BoundingBox& box, double pitch) {
  // The count falls at most with the square of the pitch; a few rounds of a tenth each end the
  // search.
  double enough = pitch;
  while (rays_needed(box, enough) > static_cast<double>(TriDexel::kMaxRays)) enough *= 1.1;
  return error(
      "mesh-pitch"_id,
      fmt::format("a pitch of {} mm needs {:.3g} rays for {:.6g} x {:.6g} x {:.6g} mm; {} "
                  "is the limit",
                  pitch, rays_needed(box, pitch), box.max.x() - box.min.x(),
                  box.max.y() - box.min.y(), box.max.z() - box.min.z(), TriDexel::kMaxRays),
      fmt::format("use a pitch of {:.2g} mm or more", enough));
}

// Rays [u0, u1) of rows [v0, v1).
struct Rectangle {
  int u0 = 0, u1 = 0, v0 = 0, v1 = 0;

  [[nodiscard]] std::size_t row() const { return static_cast<std::size_t>(u1 - u0); }
  [[nodiscard]] bool holds(int u, int v) const { return u0 <= u && u < u1 && v0 <= v && v < v1; }
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v - v0) * row() + static_cast<std::size_t>(u - u0);
  }
};

// What holds all rays of a rectangle that were reached; empty where none was.
Rectangle reached_of(const Rectangle& all, int axis, const ReachedRays& reached) {
  if (!reached.any(axis, {{all.u0, all.v0}, {all.u1 - 1, all.v1 - 1}})) return {};
  Rectangle around{all.u1, all.u0, all.v1, all.v0};
  for (int v = all.v0; v < all.v1; ++v) {
    for (int u = all.u0; u < all.u1; ++u) {
      if (!reached.reaches(axis, u, v)) continue;
      around = {std::min(around.u0, u), std::max(around.u1, u + 1), std::min(around.v0, v),
                std::max(around.v1, v + 1)};
    }
  }
  return around;
}

}  // namespace

DexelGrid DexelGrid::over(const BoundingBox& box, double pitch) {
  DexelGrid grid;
  grid.pitch = pitch;
  const auto nodes = nodes_needed(box, pitch);
  for (int d = 0; d < 3; ++d) {
    const auto at = static_cast<std::size_t>(d);
    grid.origin[d] = box.min[d] - pitch * (1.0 + kShift[at]);
    grid.nodes[at] = static_cast<int>(nodes[at]);
  }
  return grid;
}

Ray DexelGrid::ray(int axis, int u, int v) const {
  Vec3 at = origin;
  at[(axis + 1) % 3] += pitch * u;
  at[(axis + 2) % 3] += pitch * v;
  return {at, Vec3::Unit(axis)};
}

std::int64_t DexelGrid::rays() const {
  const std::int64_t x = nodes[0];
  const std::int64_t y = nodes[1];
  const std::int64_t z = nodes[2];
  return x * y + y * z + z * x;
}

void TriDexel::sample_family(SolidView solid, int axis, const Known& known) {
  const int nu = grid_.nodes[static_cast<std::size_t>((axis + 1) % 3)];
  const int nv = grid_.nodes[static_cast<std::size_t>((axis + 2) % 3)];
  const int nodes = grid_.nodes[static_cast<std::size_t>(axis)];
  const RaySpan span{0.5 * grid_.pitch, (nodes - 1.5) * grid_.pitch};

  Family& family = families_[static_cast<std::size_t>(axis)];
  family.first.assign(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv) + 1, 0);
  const auto index = [nu](int u, int v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(nu) + static_cast<std::size_t>(u);
  };
  // Tiles of rays share their search; of each the rectangle around what is not known is asked.
  struct Tile {
    Rectangle all{}, asked{};
    std::vector<IntervalSet> found{};
  };
  const int tiles_u = (nu - 2 + kTile - 1) / kTile, tiles_v = (nv - 2 + kTile - 1) / kTile;
  std::vector<Tile> tiles(static_cast<std::size_t>(tiles_u * tiles_v));
  const auto for_each_ray = [&](Tile& tile, const auto& visit) {
    for (int v = tile.all.v0; v < tile.all.v1; ++v) {
      for (int u = tile.all.u0; u < tile.all.u1; ++u) {
        visit(index(u, v), tile.asked.holds(u, v) ? tile.found[tile.asked.index(u, v)].intervals()
                                                  : known.dexels->material(axis, u, v));
      }
    }
  };
  tbb::parallel_for(0, tiles_u * tiles_v, [&](int number) {
    Tile& tile = tiles[static_cast<std::size_t>(number)];
    const int u0 = 1 + kTile * (number % tiles_u), v0 = 1 + kTile * (number / tiles_u);
    tile.all = {u0, std::min(u0 + kTile, nu - 1), v0, std::min(v0 + kTile, nv - 1)};
    tile.asked = known.dexels == nullptr ? tile.all : reached_of(tile.all, axis, *known.reached);
    std::vector<Ray> rays;
    rays.reserve(static_cast<std::size_t>(kTile) * kTile);
    for (int v = tile.asked.v0; v < tile.asked.v1; ++v) {
      for (int u = tile.asked.u0; u < tile.asked.u1; ++u) rays.push_back(grid_.ray(axis, u, v));
    }
    if (!rays.empty()) tile.found = solid.material_along_all(rays, tile.asked.row(), span);
    for_each_ray(tile, [&](std::size_t ray, std::span<const Interval> material) {
      family.first[ray + 1] = material.size();
    });
  });
  std::partial_sum(family.first.begin(), family.first.end(), family.first.begin());
  family.intervals.resize(family.first.back());
  tbb::parallel_for(0, tiles_u * tiles_v, [&](int number) {
    for_each_ray(tiles[static_cast<std::size_t>(number)],
                 [&](std::size_t ray, std::span<const Interval> material) {
                   std::ranges::copy(material, family.intervals.begin() +
                                                   static_cast<std::ptrdiff_t>(family.first[ray]));
                 });
  });
}

Result<TriDexel> TriDexel::sample(SolidView solid, const BoundingBox& box, Mm pitch) {
  if (!std::isfinite(pitch.value) || pitch.value <= 0.0) {
    return error("mesh-pitch"_id, fmt::format("the mesh pitch is {} mm", pitch.value),
                 "it must be a finite number above 0");
  }
  if (!box.min.allFinite() || !box.max.allFinite() || (box.max - box.min).minCoeff() <= 0.0) {
    return error("mesh-box"_id, "the box to be meshed is empty or not finite");
  }
  if (rays_needed(box, pitch.value) > static_cast<double>(kMaxRays)) {
    return too_fine(box, pitch.value);
  }
  TriDexel dexels(DexelGrid::over(box, pitch.value));
  for (int axis = 0; axis < 3; ++axis) dexels.sample_family(solid, axis, {});
  return dexels;
}

TriDexel TriDexel::sampled_again(SolidView solid, const ReachedRays& reached) const {
  TriDexel dexels(grid_);
  for (int axis = 0; axis < 3; ++axis) dexels.sample_family(solid, axis, {this, &reached});
  return dexels;
}

std::span<const Interval> TriDexel::material(int axis, int u, int v) const {
  const Family& family = families_[static_cast<std::size_t>(axis)];
  const auto nu = static_cast<std::size_t>(grid_.nodes[static_cast<std::size_t>((axis + 1) % 3)]);
  const std::size_t ray = static_cast<std::size_t>(v) * nu + static_cast<std::size_t>(u);
  return std::span(family.intervals)
      .subspan(family.first[ray], family.first[ray + 1] - family.first[ray]);
}

std::size_t TriDexel::interval_count() const {
  return families_[0].intervals.size() + families_[1].intervals.size() +
         families_[2].intervals.size();
}

std::array<double, 3> TriDexel::volumes() const {
  std::array<double, 3> volumes{};
  for (std::size_t d = 0; d < 3; ++d) {
    double length = 0.0;
    for (const Interval& material : families_[d].intervals) length += material.length();
    volumes[d] = length * grid_.pitch * grid_.pitch;
  }
  return volumes;
}

double TriDexel::volume() const {
  const auto each = volumes();
  return (each[0] + each[1] + each[2]) / 3.0;
}

}  // namespace frustum::stock
