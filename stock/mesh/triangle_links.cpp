#include "stock/mesh/triangle_links.hpp"

#include <utility>

namespace frustum::stock {

bool TriangleLinks::may_collapse(std::uint32_t half) const {
  const std::uint32_t goes = from(half);
  const std::uint32_t stays = to(half);
  const std::uint32_t left = from(before(half));
  const std::uint32_t right = from(before(across[half]));
  if (left == right) return false;
  // What is next to both is next to the edge.
  bool alone = true;
  for_each_leaving(goes, [&](std::uint32_t mine) {
    const std::uint32_t neighbour = to(mine);
    if (neighbour == stays || neighbour == left || neighbour == right || !alone) return;
    for_each_leaving(stays, [&](std::uint32_t other) { alone = alone && to(other) != neighbour; });
  });
  return alone && valence(left) > 3 && valence(right) > 3;
}

void TriangleLinks::collapse(std::uint32_t half) {
  const std::uint32_t goes = from(half);
  const std::uint32_t stays = to(half);
  for_each_leaving(goes, [&](std::uint32_t mine) { triangles[mine / 3][mine % 3] = stays; });
  for (const std::uint32_t side : {half, across[half]}) {
    const std::uint32_t apex = from(before(side));
    const std::uint32_t one = across[next(side)];
    const std::uint32_t other = across[before(side)];
    across[one] = other;
    across[other] = one;
    leaving[apex] = one;
    leaving[stays] = other;
  }
  const std::uint32_t second = across[half] / 3;
  triangles[half / 3].fill(kGone);
  triangles[second].fill(kGone);
  leaving[goes] = kGone;
}

bool TriangleLinks::may_flip(std::uint32_t half) const {
  const std::uint32_t left = from(before(half));
  const std::uint32_t right = from(before(across[half]));
  bool apart = left != right;
  for_each_leaving(left, [&](std::uint32_t mine) { apart = apart && to(mine) != right; });
  return apart && valence(from(half)) > 3 && valence(to(half)) > 3;
}

void TriangleLinks::flip(std::uint32_t half) {
  const std::uint32_t back = across[half];
  const std::uint32_t a = from(half), b = to(half);
  const std::uint32_t left = from(before(half)), right = from(before(back));
  const std::array outer{across[next(back)], across[before(half)], across[before(back)],
                         across[next(half)]};
  const std::uint32_t one = half / 3, two = back / 3;
  triangles[one] = {a, right, left};
  triangles[two] = {right, b, left};
  const auto join = [&](std::uint32_t mine, std::uint32_t other) {
    across[mine] = other;
    across[other] = mine;
  };
  join(3 * one, outer[0]);
  join(3 * one + 2, outer[1]);
  join(3 * two, outer[2]);
  join(3 * two + 1, outer[3]);
  join(3 * one + 1, 3 * two + 2);
  leaving[a] = 3 * one;
  leaving[right] = 3 * one + 1;
  leaving[left] = 3 * one + 2;
  leaving[b] = 3 * two + 1;
}

std::optional<TriangleLinks> linked(std::vector<std::array<std::uint32_t, 3>> triangles,
                                    std::size_t vertex_count) {
  TriangleLinks links;
  links.triangles = std::move(triangles);
  const std::size_t halves = 3 * links.triangles.size();
  links.across.assign(halves, TriangleLinks::kGone);
  links.leaving.assign(vertex_count, TriangleLinks::kGone);
  // Half-edges by the lower of their ends, each with its higher one.
  std::vector<std::uint32_t> first(vertex_count + 1, 0);
  const auto ends = [&](std::uint32_t half) {
    const std::uint32_t a = links.from(half);
    const std::uint32_t b = links.to(half);
    return a < b ? std::pair(a, b) : std::pair(b, a);
  };
  const auto count = static_cast<std::uint32_t>(halves);
  for (std::uint32_t half = 0; half < count; ++half) {
    const auto [low, high] = ends(half);
    if (low == high) return std::nullopt;
    ++first[low + 1];
    links.leaving[links.from(half)] = half;
  }
  for (std::size_t v = 0; v < vertex_count; ++v) first[v + 1] += first[v];
  std::vector<std::uint32_t> open(halves);  // by lower end: those that wait for their other one
  std::vector<std::uint32_t> filled(first.begin(), first.end() - 1);
  for (std::uint32_t half = 0; half < count; ++half) {
    const auto [low, high] = ends(half);
    const bool upwards = links.from(half) == low;
    bool met = false;
    for (std::uint32_t at = first[low]; at < filled[low] && !met; ++at) {
      const std::uint32_t other = open[at];
      if (ends(other).second != high || (links.from(other) == low) == upwards ||
          links.across[other] != TriangleLinks::kGone) {
        continue;
      }
      links.across[half] = other;
      links.across[other] = half;
      open[at] = open[--filled[low]];
      met = true;
    }
    if (!met) open[filled[low]++] = half;
  }
  // An edge of four triangles shows as two fans at its ends, unless it is paired crosswise: then
  // some vertex sees an edge twice.
  std::vector<std::uint32_t> seen(vertex_count, 0);
  for (std::uint32_t half = 0; half < count; ++half) {
    if (links.across[half] == TriangleLinks::kGone) return std::nullopt;
    ++seen[links.from(half)];
  }
  std::vector<std::uint32_t> marked(vertex_count, TriangleLinks::kGone);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    std::uint32_t fan = 0;
    bool twice = false;
    links.for_each_leaving(v, [&](std::uint32_t half) {
      ++fan;
      const std::uint32_t end = links.to(half);
      twice = twice || marked[end] == v;
      marked[end] = v;
    });
    if (fan != seen[v] || twice) return std::nullopt;
  }
  return links;
}

}  // namespace frustum::stock
