// The samples of a study read again, column by column, for statistics and tables.
//
// Units  : those of the columns
// Errors : parts that are missing or not whole
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "studies/samples/sample_folder.hpp"

namespace frustum::app {

struct SampleColumns {
  std::vector<std::int64_t> draws{};             // those that succeeded
  std::vector<studies::SampleColumn> columns{};  // those asked for, as far as there are
  std::vector<studies::FailedSample> failed{};

  [[nodiscard]] const std::vector<double>* find(const std::string& name) const;
};

using WantedColumn = std::function<bool(const std::string&)>;

// Of the first `samples` draws.
[[nodiscard]] Result<SampleColumns> read_columns(const studies::SampleFolder& folder,
                                                 std::uint64_t samples, const WantedColumn& wanted);
// A row for each draw that succeeded: draw, characteristics, amounts and phases. Part by part.
[[nodiscard]] Result<std::uint64_t> write_samples_csv(const studies::SampleFolder& folder,
                                                      std::uint64_t samples,
                                                      const std::filesystem::path& file);

}  // namespace frustum::app
