// All files of one machine of the benchmark, made by its key: what is given, the questions, the
// prior, the true values.
//
// A pure function: the same key makes the same bytes, on any machine and for any number of threads.
// Units : as the files state
// Errors: those of the trials
#pragma once

#include <map>
#include <string>

#include "app/benchmark/benchmark_laws.hpp"
#include "core/result.hpp"

namespace frustum::app {

// By their names below the benchmark's folder: machines/m01/.., prior/m01.csv, answers/m01.json.
using BenchmarkFiles = std::map<std::string, std::string>;
[[nodiscard]] Result<BenchmarkFiles> benchmark_files(const BenchmarkEntry& entry,
                                                     const std::string& key);

// SHA-256 of salt and answers, and the salt (32 bytes, a function of the key), in hexadecimal.
[[nodiscard]] std::string commitment_of(const std::string& answers, const std::string& key);
[[nodiscard]] std::string salt_of(const std::string& key);

}  // namespace frustum::app
