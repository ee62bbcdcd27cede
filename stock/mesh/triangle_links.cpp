#include "stock/mesh/triangle_links.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>
#include <boost/container/small_vector.hpp>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

namespace frustum::stock {

bool TriangleLinks::may_collapse(std::uint32_t half) const {
  const std::uint32_t goes = from(half);
  const std::uint32_t stays = to(half);
  const std::uint32_t left = from(before(half));
  const std::uint32_t right = from(before(across[half]));
  if (left == right) return false;
  // What is next to both is next to the edge.
  boost::container::small_vector<std::uint32_t, 16> ring;
  for_each_leaving(goes, [&](std::uint32_t mine) { ring.push_back(to(mine)); });
  bool alone = true;
  for_each_leaving(stays, [&](std::uint32_t other) {
    const std::uint32_t neighbour = to(other);
    if (neighbour == left || neighbour == right) return;
    for (const std::uint32_t near : ring) alone = alone && near != neighbour;
  });
  return alone && !has_three(left) && !has_three(right);
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
  const auto count = static_cast<std::uint32_t>(links.triangles.size());
  links.across.resize(3 * links.triangles.size());
  links.leaving.assign(vertex_count, TriangleLinks::kGone);
  // Half-edges by the vertex that they leave, those of one in any order.
  struct Leaving {
    std::uint32_t half, end;
  };
  const auto by_vertex = std::make_unique_for_overwrite<Leaving[]>(links.across.size());
  std::vector<std::uint32_t> first(vertex_count + 1, 0);
  const auto counted = [](std::uint32_t& number) {
    return std::atomic_ref(number).fetch_add(1, std::memory_order_relaxed);
  };
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t t) {
    for (const std::uint32_t v : links.triangles[t]) counted(first[v + 1]);
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> filled(first.begin(), first.end() - 1);
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t t) {
    const auto& [a, b, c] = links.triangles[t];
    by_vertex[counted(filled[a])] = {3 * t, b};
    by_vertex[counted(filled[b])] = {3 * t + 1, c};
    by_vertex[counted(filled[c])] = {3 * t + 2, a};
  });
  const auto leaving = [&](std::uint32_t v) {
    return std::span<const Leaving>(by_vertex.get() + first[v], first[v + 1] - first[v]);
  };
  // Every edge once there and once back; around every vertex one fan.
  const auto pair_at = [&](std::uint32_t v) {
    for (const auto& [half, end] : leaving(v)) {
      std::uint32_t back = TriangleLinks::kGone;
      for (const Leaving& other : leaving(end)) {
        if (other.end != v) continue;
        if (back != TriangleLinks::kGone) return false;
        back = other.half;
      }
      if (end == v || back == TriangleLinks::kGone) return false;
      links.across[half] = back;
      std::uint32_t& last = links.leaving[v];
      last = last == TriangleLinks::kGone ? half : std::max(last, half);
    }
    return true;
  };
  const auto is_one_fan_at = [&](std::uint32_t v) { return links.valence(v) == leaving(v).size(); };
  const auto holds_at_all = [&](const auto& holds_at) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, vertex_count), true,
        [&](const tbb::blocked_range<std::size_t>& some, bool all) {
          for (std::size_t v = some.begin(); v < some.end() && all; ++v) {
            all = holds_at(static_cast<std::uint32_t>(v));
          }
          return all;
        },
        std::logical_and<>());
  };
  if (!holds_at_all(pair_at) || !holds_at_all(is_one_fan_at)) return std::nullopt;
  return links;
}

}  // namespace frustum::stock
