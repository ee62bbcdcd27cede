#include "lint/sarif_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "lint/check_help.hpp"
#include "lint/fingerprints.hpp"

namespace frustum::lint {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kSchema =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";

// RFC 3986: unreserved characters and the separators of a path stay.
std::string uri_text(const std::string& path) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri;
  for (const char byte : path) {
    if (kPlain.find(byte) != std::string_view::npos) {
      uri += byte;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(byte));
    }
  }
  return uri;
}

constexpr const char* kWorkingFolder = "WORKING_FOLDER";
constexpr const char* kStandardInput = "<stdin>";  // as findings name it

// Below the folder its name there, else the whole path.
Json location_of(const std::string& file, const fs::path& folder) {
  if (file == kStandardInput) return {{"uri", "stdin:"}};
  const fs::path whole = (folder / file).lexically_normal();
  const fs::path relative = whole.lexically_relative(folder.lexically_normal());
  const bool below = !relative.empty() && *relative.begin() != "..";
  if (!below) return {{"uri", file_uri(whole)}};
  return {{"uri", uri_text(relative.generic_string())}, {"uriBaseId", kWorkingFolder}};
}

Json rules(const SarifOptions& options) {
  Json list = Json::array();
  for (const CheckInfo& info : all_checks()) {
    const CheckHelp help = help_of(info.check);
    Json rule{{"id", info.id},
              {"shortDescription", {{"text", info.title}}},
              {"fullDescription", {{"text", std::string(help.meaning)}}},
              {"help", {{"text", std::string(help.remedy)}}},
              {"defaultConfiguration", {{"level", to_string(info.severity)}}}};
    if (!options.documents.empty()) rule["helpUri"] = options.documents + "check.md#the-checks";
    list.push_back(std::move(rule));
  }
  return list;
}

Json driver(const SarifOptions& options) {
  Json json{
      {"name", "Frustum"}, {"version", options.version}, {"semanticVersion", options.version}};
  if (!options.documents.empty()) json["informationUri"] = options.documents + "README.md";
  json["rules"] = rules(options);
  return json;
}

// The column in the units that SARIF counts in, from one in bytes.
std::uint32_t utf16_column(std::string_view line, std::uint32_t column) {
  std::uint32_t units = 1;
  for (std::size_t i = 0; i + 1 < column; ++i) {
    const unsigned byte = i < line.size() ? static_cast<unsigned char>(line[i]) : 0U;
    const bool continues = (byte & 0xC0U) == 0x80U;
    units += continues ? 0 : byte >= 0xF0U ? 2 : 1;
  }
  return units;
}

std::string message_of(const Finding& finding) {
  std::string text = finding.message;
  if (finding.count > 1) text += fmt::format(" ({} times)", finding.count);
  if (!finding.hint.empty()) text += "\n" + finding.hint;
  return text;
}

// The files that were checked, then those with a finding besides.
class Artifacts {
 public:
  Artifacts(std::span<const CheckedFile> checked, const fs::path& folder) : folder_(folder) {
    for (const CheckedFile& each : checked) add(each.file, true);
    for (const CheckedFile& each : checked) {
      for (const Finding& finding : each.report.findings) add(finding.file, false);
    }
  }
  [[nodiscard]] Json location(const std::string& file) const {
    Json location = location_of(file, folder_);
    location["index"] = index_.at(file);
    return location;
  }
  [[nodiscard]] const Json& list() const { return list_; }

 private:
  void add(const std::string& file, bool target) {
    if (!index_.try_emplace(file, list_.size()).second) return;
    list_.push_back({{"location", location_of(file, folder_)}});
    if (target) list_.back()["roles"] = Json::array({"analysisTarget"});
  }

  fs::path folder_;
  Json list_ = Json::array();
  std::map<std::string, std::size_t> index_{};
};

// Empty: the finding counts.
Json suppressions_json(const Finding& finding) {
  if (finding.suppressed == Suppressed::no) return Json::array();
  const bool comment = finding.suppressed == Suppressed::by_comment;
  Json suppression{{"kind", comment ? "inSource" : "external"}, {"status", "accepted"}};
  const std::string reason = comment ? finding.reason : std::string("in the baseline");
  if (!reason.empty()) suppression["justification"] = reason;
  return Json::array({suppression});
}

Json result_of(const Finding& finding, const std::string& fingerprint, const CheckedFile& checked,
               const Artifacts& artifacts) {
  const auto found = checked.lines.find({finding.file, finding.line});
  const std::string_view line = found == checked.lines.end() ? std::string_view() : found->second;
  Json place{{"artifactLocation", artifacts.location(finding.file)}};
  if (finding.line > 0) {
    place["region"] = {{"startLine", finding.line},
                       {"startColumn", utf16_column(line, std::max(finding.column, 1U))}};
  }
  Json result{{"ruleId", info_of(finding.check).id},
              {"ruleIndex", static_cast<std::size_t>(finding.check)},
              {"level", to_string(finding.severity)},
              {"message", {{"text", message_of(finding)}}},
              {"locations", Json::array({{{"physicalLocation", place}}})},
              {"partialFingerprints", {{"checkAndLine/v3", fingerprint}}},
              {"occurrenceCount", finding.count}};
  result["suppressions"] = suppressions_json(finding);
  if (finding.diagnostic) result["properties"] = {{"diagnostic", finding.diagnostic->text()}};
  return result;
}

// How the run of the program itself went.
Json invocation_of(const SarifOptions& options) {
  Json notifications = Json::array();
  for (const Diagnostic& trouble : options.troubles) {
    notifications.push_back(
        {{"level", to_string(trouble.severity)}, {"message", {{"text", to_string(trouble)}}}});
  }
  return {{"executionSuccessful", options.troubles.empty()},
          {"workingDirectory", {{"uri", file_uri(options.folder / "")}}},
          {"toolExecutionNotifications", notifications}};
}

}  // namespace

std::string file_uri(const fs::path& path) { return "file://" + uri_text(path.generic_string()); }

std::string sarif_of(std::span<const CheckedFile> checked, const SarifOptions& options) {
  const Artifacts artifacts(checked, options.folder);
  Json results = Json::array();
  for (const CheckedFile& each : checked) {
    const auto marks = fingerprints_of(each.report.findings, each.lines);
    for (std::size_t i = 0; i < marks.size(); ++i) {
      results.push_back(result_of(each.report.findings[i], marks[i], each, artifacts));
    }
  }
  const Json run{
      {"tool", {{"driver", driver(options)}}},
      {"invocations", Json::array({invocation_of(options)})},
      {"originalUriBaseIds", {{kWorkingFolder, {{"uri", file_uri(options.folder / "")}}}}},
      {"artifacts", artifacts.list()},
      {"columnKind", "utf16CodeUnits"},
      {"results", results}};
  const Json sarif{{"$schema", kSchema}, {"version", "2.1.0"}, {"runs", Json::array({run})}};
  return sarif.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace frustum::lint
