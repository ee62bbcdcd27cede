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

std::string fingerprint_text(const HashedFile& file, const Wording& words) {
  return file.sha256.empty() ? words("not known: it was read from a pipe") : file.sha256;
}

std::vector<Fact> stated(const metrology::ReportHeader& header) {
  std::vector<Fact> facts;
  for (const metrology::HeaderKey& row : metrology::kHeaderKeys) {
    const std::string& value = header.*row.value;
    if (!value.empty()) facts.push_back({std::string(row.key), std::string(row.label), value});
  }
  return facts;
}

const std::vector<Fact>& shown_measuring(const Evidence& evidence) {
  return evidence.measuring_shown.empty() ? evidence.measuring : evidence.measuring_shown;
}

namespace {

std::vector<Fact> with_draw(std::vector<Fact> facts, const Evidence& evidence,
                            const Wording& words) {
  if (const auto& draw = evidence.error_draw) {
    facts.push_back({"error_draw", words("Draw of the errors"),
                     words("seed {0}, number {1}", draw->seed, draw->index)});
  }
  return facts;
}

}  // namespace

std::vector<Fact> made_and_measured(const Evidence& evidence) {
  return with_draw(evidence.measuring, evidence, Wording());
}

std::vector<Fact> shown_made_and_measured(const Evidence& evidence, const Wording& words) {
  return with_draw(shown_measuring(evidence), evidence, words);
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
