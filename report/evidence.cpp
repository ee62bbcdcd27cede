#include "report/evidence.hpp"

#include <filesystem>
#include <utility>

#include "core/sha256.hpp"

namespace frustum::report {

HashedFile hashed_file(std::string role, const std::string& path, std::string_view bytes) {
  return {std::move(role), std::filesystem::path(path).filename().string(), sha256(bytes)};
}

std::vector<Fact> stated(const metrology::ReportHeader& header) {
  std::vector<Fact> facts;
  for (const metrology::HeaderKey& row : metrology::kHeaderKeys) {
    const std::string& value = header.*row.value;
    if (!value.empty()) facts.push_back({std::string(row.key), std::string(row.label), value});
  }
  return facts;
}

std::vector<Fact> all_facts(const Evidence& evidence, const std::string& version) {
  std::vector<Fact> facts = stated(evidence.header);
  facts.insert(facts.end(), evidence.measuring.begin(), evidence.measuring.end());
  if (!version.empty()) facts.push_back({"version", "Made by", "Frustum " + version});
  for (const HashedFile& file : evidence.files) {
    facts.push_back(
        {"sha256_" + file.role, "SHA-256 of the " + file.role + " " + file.name, file.sha256});
  }
  return facts;
}

}  // namespace frustum::report
