#include "report/evidence.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <utility>

#include "core/sha256.hpp"

namespace frustum::report {

HashedFile hashed_file(std::string role, const std::string& path, std::string_view bytes) {
  return {std::move(role), std::filesystem::path(path).filename().string(), sha256(bytes)};
}

std::string fingerprint_text(const HashedFile& file) {
  return file.sha256.empty() ? "not known: it was read from a pipe" : file.sha256;
}

std::vector<Fact> stated(const metrology::ReportHeader& header) {
  std::vector<Fact> facts;
  for (const metrology::HeaderKey& row : metrology::kHeaderKeys) {
    const std::string& value = header.*row.value;
    if (!value.empty()) facts.push_back({std::string(row.key), std::string(row.label), value});
  }
  return facts;
}

std::vector<Fact> made_and_measured(const Evidence& evidence) {
  std::vector<Fact> facts = evidence.measuring;
  if (const auto& draw = evidence.error_draw) {
    facts.push_back({"error_draw", "Draw of the errors",
                     fmt::format("seed {}, number {}", draw->seed, draw->index)});
  }
  return facts;
}

std::vector<Fact> all_facts(const Evidence& evidence, const std::string& version) {
  std::vector<Fact> facts = stated(evidence.header);
  for (Fact& fact : made_and_measured(evidence)) facts.push_back(std::move(fact));
  if (!version.empty()) facts.push_back({"version", "Made by", "Frustum " + version});
  std::map<std::string, int> of_role;
  for (const HashedFile& file : evidence.files) {
    const int number = ++of_role[file.role];
    const std::string which = number == 1 ? std::string() : fmt::format("_{}", number);
    facts.push_back({"sha256_" + file.role + which, "SHA-256 of the " + file.role + " " + file.name,
                     fingerprint_text(file)});
  }
  return facts;
}

}  // namespace frustum::report
