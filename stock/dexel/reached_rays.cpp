#include "stock/dexel/reached_rays.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::stock {

ReachedRays::ReachedRays(const DexelGrid& grid, std::span<const Box> boxes) : grid_(grid) {
  std::vector<Cells> reached;
  for (const Box& box : boxes) {
    const Cells cells = cells_of(box);
    if (!is_none(cells)) reached.push_back(cells);
  }
  for (int axis = 0; axis < 3; ++axis) cast(axis, reached);
}

// The ray through node (u, v) is on the border of cell (u, v), which counts as reached with it.
ReachedRays::Cells ReachedRays::cells_of(const Box& box) const {
  Cells cells;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto k = static_cast<Eigen::Index>(d);
    const double most = grid_.nodes[d];
    const auto cell = [&](double x) {
      return static_cast<int>(
          std::clamp(std::floor((x - grid_.origin[k]) / grid_.pitch), -1.0, most));
    };
    cells.first[d] = std::max(cell(box.min[k]), 0);
    cells.last[d] = std::min(cell(box.max[k]), grid_.nodes[d] - 1);
  }
  return cells;
}

bool ReachedRays::is_none(const Cells& cells) {
  for (std::size_t d = 0; d < 3; ++d) {
    if (cells.first[d] > cells.last[d]) return true;
  }
  return false;
}

void ReachedRays::cast(int axis, std::span<const Cells> boxes) {
  const auto [nu, nv] = nodes_across(axis);
  const auto row = static_cast<std::size_t>(nu) + 1;
  Shadow& shadow = shadows_[static_cast<std::size_t>(axis)];
  shadow.assign(row * (static_cast<std::size_t>(nv) + 1), 0);
  if (boxes.empty()) return;
  // Where shadows begin and end; their sums are how many shadows a cell is in (modulo 2^32).
  const auto at = [&](int u, int v) -> std::uint32_t& {
    return shadow[(static_cast<std::size_t>(v) + 1) * row + static_cast<std::size_t>(u) + 1];
  };
  const auto u = static_cast<std::size_t>((axis + 1) % 3);
  const auto v = static_cast<std::size_t>((axis + 2) % 3);
  for (const Cells& box : boxes) {
    const bool ends_u = box.last[u] + 1 < nu, ends_v = box.last[v] + 1 < nv;
    ++at(box.first[u], box.first[v]);
    if (ends_u) --at(box.last[u] + 1, box.first[v]);
    if (ends_v) --at(box.first[u], box.last[v] + 1);
    if (ends_u && ends_v) ++at(box.last[u] + 1, box.last[v] + 1);
  }
  const auto sum_up = [&] {
    for (std::size_t k = row; k < shadow.size(); ++k) {
      if (k % row != 0) shadow[k] += shadow[k - 1] + shadow[k - row] - shadow[k - row - 1];
    }
  };
  sum_up();
  std::ranges::for_each(shadow, [](std::uint32_t& count) { count = count > 0 ? 1 : 0; });
  sum_up();
}

bool ReachedRays::any(int axis, const Rays& rays) const {
  const Shadow& shadow = shadows_[static_cast<std::size_t>(axis)];
  const auto row = static_cast<std::size_t>(nodes_across(axis)[0]) + 1;
  const auto until = [&](int u, int v) {
    return shadow[static_cast<std::size_t>(v) * row + static_cast<std::size_t>(u)];
  };
  const auto& [first, last] = rays;
  return until(last[0] + 1, last[1] + 1) - until(first[0], last[1] + 1) -
             until(last[0] + 1, first[1]) + until(first[0], first[1]) !=
         0;
}

bool ReachedRays::reaches(const Box& place) const {
  const Cells cells = cells_of(place);
  if (is_none(cells)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto u = static_cast<std::size_t>((axis + 1) % 3);
    const auto v = static_cast<std::size_t>((axis + 2) % 3);
    if (!any(axis, {{cells.first[u], cells.first[v]}, {cells.last[u], cells.last[v]}}))
      return false;
  }
  return true;
}

}  // namespace frustum::stock
