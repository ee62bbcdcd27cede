#include "lint/sarif_findings.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

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

std::string uri_of(const std::string& file, const fs::path& folder) {
  const fs::path whole = (folder / file).lexically_normal();
  const fs::path relative = whole.lexically_relative(folder.lexically_normal());
  const bool below = !relative.empty() && *relative.begin() != "..";
  return below ? uri_text(relative.generic_string()) : "file://" + uri_text(whole.generic_string());
}

// FNV-1a: the same on every machine.
std::uint64_t fingerprint(std::string_view id, std::string_view line) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::string_view part : {id, line}) {
    for (const char byte : part) {
      hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
    }
  }
  return hash;
}

Json rules() {
  Json list = Json::array();
  for (const CheckInfo& info : all_checks()) {
    list.push_back({{"id", info.id},
                    {"shortDescription", {{"text", info.title}}},
                    {"defaultConfiguration", {{"level", to_string(info.severity)}}}});
  }
  return list;
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

}  // namespace

std::string sarif_of(const CheckReport& report, const SourceLines& lines,
                     const SarifOptions& options) {
  Json results = Json::array();
  std::map<std::uint64_t, int> seen;
  for (const Finding& finding : report.findings) {
    const CheckInfo& info = info_of(finding.check);
    Json place{{"artifactLocation", {{"uri", uri_of(finding.file, options.folder)}}}};
    const auto found = lines.find({finding.file, finding.line});
    const std::string_view line = found == lines.end() ? std::string_view() : found->second;
    if (finding.line > 0) {
      place["region"] = {{"startLine", finding.line},
                         {"startColumn", utf16_column(line, finding.column)}};
    }
    const std::uint64_t mark = fingerprint(info.id, line);
    results.push_back({{"ruleId", info.id},
                       {"ruleIndex", static_cast<std::size_t>(finding.check)},
                       {"level", to_string(finding.severity)},
                       {"message", {{"text", message_of(finding)}}},
                       {"locations", Json::array({{{"physicalLocation", place}}})},
                       {"partialFingerprints",
                        {{"checkAndLine/v1", fmt::format("{:016x}:{}", mark, ++seen[mark])}}},
                       {"occurrenceCount", finding.count}});
    if (finding.diagnostic) {
      results.back()["properties"] = {{"diagnostic", finding.diagnostic->text()}};
    }
  }
  const Json sarif{
      {"$schema", kSchema},
      {"version", "2.1.0"},
      {"runs",
       Json::array(
           {{{"tool",
              {{"driver",
                {{"name", "Frustum"}, {"semanticVersion", options.version}, {"rules", rules()}}}}},
             {"columnKind", "utf16CodeUnits"},
             {"results", results}}})}};
  return sarif.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace frustum::lint
