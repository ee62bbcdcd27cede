#include "app/benchmark/benchmark_verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/benchmark/benchmark_make.hpp"
#include "core/whole_file.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

Diagnostic in_file(const fs::path& file, DiagnosticId id, std::string what, std::string hint = {}) {
  Diagnostic failure = error(id, std::move(what), std::move(hint));
  failure.file = file.string();
  return failure;
}

Result<std::string> key_in(const fs::path& file, const std::string& answers) {
  const auto json = nlohmann::json::parse(answers, nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains("key") ||
      !json["key"].is_string()) {
    return in_file(file, "benchmark-answers"_id, "the answers have no key",
                   "frustum benchmark make writes such files");
  }
  return json["key"].get<std::string>();
}

// What is in a machine's folder and not among the files that its key makes.
std::vector<std::string> unexpected_of(const fs::path& benchmark, const std::string& id,
                                       const BenchmarkFiles& made) {
  std::vector<std::string> found;
  std::error_code failure;
  for (fs::recursive_directory_iterator at(benchmark / "machines" / id, failure), end;
       !failure && at != end; at.increment(failure)) {
    if (at->is_directory(failure) && !at->is_symlink(failure)) continue;
    std::string name = at->path().lexically_relative(benchmark).generic_string();
    if (!made.contains(name)) found.push_back(std::move(name));
  }
  std::ranges::sort(found);
  return found;
}

// What is named like no machine.
std::vector<std::string> of_no_machine(const fs::path& benchmark) {
  std::vector<std::string> found;
  for (const auto& [folder, ending] : {std::pair<const char*, const char*>{"machines", ""},
                                       {"prior", ".csv"},
                                       {"answers", ".json"}}) {
    std::error_code failure;
    for (fs::directory_iterator at(benchmark / folder, failure), end; !failure && at != end;
         at.increment(failure)) {
      const std::string name = at->path().filename().string();
      const bool is_known = std::ranges::any_of(
          benchmark_entries(), [&, end_of_name = std::string(ending)](const BenchmarkEntry& entry) {
            return name == entry.id + end_of_name;
          });
      if (!is_known) found.push_back(std::string(folder) + "/" + name);
    }
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

bool VerifiedBenchmark::holds() const {
  return unexpected.empty() && std::ranges::all_of(machines, &VerifiedMachine::holds);
}

Result<VerifiedBenchmark> verify_benchmark(const fs::path& benchmark,
                                           const std::vector<std::string>& only) {
  const fs::path commitments_file = benchmark / "commitments.json";
  const auto text = read_whole_file(commitments_file);
  if (!text) return text.error();
  const auto commitments = nlohmann::json::parse(*text, nullptr, false);
  if (commitments.is_discarded() || !commitments.is_object()) {
    return in_file(commitments_file, "benchmark-commitments"_id, "this is no JSON object");
  }
  VerifiedBenchmark found;
  for (const BenchmarkEntry& entry : benchmark_entries()) {
    if (!only.empty() && std::ranges::find(only, entry.id) == only.end()) continue;
    const fs::path file = benchmark / "answers" / (entry.id + ".json");
    std::error_code failure;
    if (!fs::exists(file, failure)) continue;
    const auto answers = read_whole_file(file);
    if (!answers) return answers.error();
    const auto key = key_in(file, *answers);
    if (!key) return key.error();
    VerifiedMachine machine{.id = entry.id};
    const auto committed = commitments.find(entry.id);
    machine.commitment_holds = committed != commitments.end() && committed->is_string() &&
                               committed->get<std::string>() == commitment_of(*answers, *key);
    const auto files = benchmark_files(entry, *key);
    if (!files) return files.error();
    for (const auto& [name, bytes] : *files) {
      const auto given = read_whole_file(benchmark / name);
      if (!given || *given != bytes) machine.differing.push_back(name);
    }
    machine.unexpected = unexpected_of(benchmark, entry.id, *files);
    found.machines.push_back(std::move(machine));
  }
  if (found.machines.empty()) {
    return error("benchmark-answers"_id,
                 fmt::format("{} has no answers to verify", (benchmark / "answers").string()),
                 "answers are there once a machine is revealed");
  }
  if (only.empty()) found.unexpected = of_no_machine(benchmark);
  return found;
}

}  // namespace frustum::app
