#include "studies/samples/sample_block.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <iterator>

namespace frustum::studies {
namespace {

template <class T>
void add(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

template <class Column>
void add_columns(std::vector<Column>& all, const std::vector<Column>& more) {
  assert(all.size() == more.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    assert(all[i].name == more[i].name);
    add(all[i].values, more[i].values);
  }
}

// The values of the rows from `first` to before `last`.
template <class T>
std::vector<T> cut(const std::vector<T>& values, std::size_t first, std::size_t last) {
  return {values.begin() + static_cast<std::ptrdiff_t>(first),
          values.begin() + static_cast<std::ptrdiff_t>(last)};
}

SampleBlock between(const SampleBlock& block, std::uint64_t begin, std::uint64_t end) {
  const auto row = [&](std::uint64_t draw) {
    return static_cast<std::size_t>(
        std::ranges::lower_bound(block.draws, static_cast<std::int64_t>(draw)) -
        block.draws.begin());
  };
  const std::size_t first = row(begin), last = row(end);
  SampleBlock some{.first_draw = begin, .count = end - begin, .points = block.points};
  some.draws = cut(block.draws, first, last);
  for (const SampleColumn& c : block.columns) {
    some.columns.push_back({c.name, c.unit, cut(c.values, first, last)});
  }
  for (const PassColumn& c : block.passes) {
    some.passes.push_back({c.name, cut(c.values, first, last)});
  }
  some.deviations = cut(block.deviations, first * block.points, last * block.points);
  std::ranges::copy_if(block.failed, std::back_inserter(some.failed),
                       [&](const FailedSample& f) { return f.draw >= begin && f.draw < end; });
  return some;
}

}  // namespace

SampleBlock until(const SampleBlock& block, std::uint64_t end) {
  const std::uint64_t own = block.first_draw + block.count;
  return between(block, block.first_draw, std::clamp(end, block.first_draw, own));
}
SampleBlock from(const SampleBlock& block, std::uint64_t begin) {
  const std::uint64_t own = block.first_draw + block.count;
  return between(block, std::clamp(begin, block.first_draw, own), own);
}

void append(SampleBlock& block, const SampleBlock& next) {
  if (block.count == 0) {
    block = next;
    return;
  }
  assert(next.first_draw == block.first_draw + block.count);
  block.count += next.count;
  add(block.draws, next.draws);
  add_columns(block.columns, next.columns);
  add_columns(block.passes, next.passes);
  add(block.deviations, next.deviations);
  add(block.failed, next.failed);
}

}  // namespace frustum::studies
