// What a study keeps of its draws: a column for each quantity, a row for each draw that succeeded.
//
// Units  : those of each column; deviations of points in um
// Shape  : every column, `draws` and each `passes` have one value for each draw that succeeded;
//          `deviations` has `points` values for each of them, draw by draw
// Errors : none
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace frustum::studies {

// A file of samples holds so many draws; the last one of a study may hold fewer.
inline constexpr std::uint64_t kDrawsPerPart = 65'536;

struct SampleColumn {
  std::string name{};  // as the dataset is called: "characteristics/cone.form", "amounts/EXX/0"
  std::string unit{};
  std::vector<double> values{};
};

struct PassColumn {
  std::string name{};                  // "pass/cone.form"
  std::vector<std::uint8_t> values{};  // 1: within the limit
};

struct FailedSample {
  std::uint64_t draw = 0;
  std::string message{};
};

// The draws from `first_draw` on, `count` of them, failed ones among them.
struct SampleBlock {
  std::uint64_t first_draw = 0;
  std::uint64_t count = 0;
  std::vector<std::int64_t> draws{};  // those that succeeded, ascending
  std::vector<SampleColumn> columns{};
  std::vector<PassColumn> passes{};
  std::size_t points = 0;
  std::vector<double> deviations{};
  std::vector<FailedSample> failed{};
};

// Adds the draws after those of `block`. Precondition: the same columns, or none in `block`.
void append(SampleBlock& block, const SampleBlock& next);
// What is of the draws before `end`, and what is of the others.
[[nodiscard]] SampleBlock until(const SampleBlock& block, std::uint64_t end);
[[nodiscard]] SampleBlock from(const SampleBlock& block, std::uint64_t begin);

}  // namespace frustum::studies
