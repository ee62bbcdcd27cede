// The dated results of a folder, in the order of their dates.
//
// Where the folder holds history.toml, the files that it lists; else every *.json in it and below.
// A date is that of the index, else that which the document states, else that of the file's name,
// else of the nearest folder's name; never that of the file system. A state (as-found, as-left)
// likewise, but documents state none.
// Units : none
// Errors: no results, one without a date, two dates of one result that differ, results of several
//         machines without a choice, index keys that are misspelt; with file and key
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/history/dated_result.hpp"
#include "core/result.hpp"

namespace frustum::app {

struct ResultFolder {
  std::string title{};    // of the index, else the folder's name
  std::string machine{};  // of all results; empty where none names one
  std::vector<DatedResult> results{};
  Diagnostics remarks{};  // warnings: what was left out, what was taken from where a reader may err
};

// `machine`: only results that name it; empty: all, which must then be of one.
[[nodiscard]] Result<ResultFolder> read_results(const std::filesystem::path& folder,
                                                const std::string& machine);

}  // namespace frustum::app
