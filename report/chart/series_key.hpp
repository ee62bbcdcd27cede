// The colours of several series in one chart, and the key that names them.
//
// Five colours that remain apart for the colour-blind (after Okabe and Ito); a sixth series begins
// again. Units: none. Errors: none.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace frustum::report {

inline constexpr std::size_t kSeriesColours = 5;

// "trace s3": the classes of the line of series 2.
[[nodiscard]] std::string series_class(std::string_view kind, std::size_t series);

// A list of names with their lines; empty for none. `marks[k]` is the class of the k-th line:
// "dashed", "dot", "ring"; missing ones are drawn through.
[[nodiscard]] std::string series_key(const std::vector<std::string>& names,
                                     const std::vector<std::string>& marks = {});

}  // namespace frustum::report
