#include "lint/json_findings.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/program_version.hpp"

namespace frustum::lint {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of_json(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json status_of(bool passed) { return passed ? "pass" : "fail"; }

Json counts_json(const FindingCounts& counts) {
  Json json{{"error", counts.errors}, {"warning", counts.warnings}, {"note", counts.notes}};
  if (counts.suppressed > 0) json["suppressed"] = counts.suppressed;
  return json;
}

Json finding_json(const Finding& finding) {
  Json json{{"id", info_of(finding.check).id},
            {"severity", to_string(finding.severity)},
            {"file", finding.file},
            {"line", finding.line},
            {"column", finding.column},
            {"message", finding.message},
            {"hint", finding.hint},
            {"count", finding.count},
            {"places", finding.places},
            {"diagnostic", finding.diagnostic ? Json(finding.diagnostic->text()) : Json()}};
  if (finding.suppressed != Suppressed::no) {
    json["suppressed"] = finding.suppressed == Suppressed::by_comment ? "comment" : "baseline";
    json["reason"] = finding.reason;
  }
  return json;
}

Json file_json(const CheckedFile& checked) {
  const CheckReport& report = checked.report;
  Json json{{"file", checked.file},
            {"dialect", checked.dialect},
            {"machine", checked.machine.empty() ? Json() : Json(checked.machine)},
            {"status", status_of(checked.passed)},
            {"blocks", report.blocks},
            {"motions", report.motions},
            {"counts", counts_json(counts_of({&checked, 1}))},
            {"findings", Json::array()},
            {"suppressed", Json::array()},
            {"left_out", Json::object()}};
  if (checked.subprogram) json["subprogram"] = true;
  for (const Finding& finding : report.findings) {
    json[finding.suppressed == Suppressed::no ? "findings" : "suppressed"].push_back(
        finding_json(finding));
  }
  for (const auto& [check, count] : report.left_out) {
    json["left_out"][std::string(info_of(check).id)] = count;
  }
  return json;
}

void add_troubles(Json& json, const Diagnostics& troubles) {
  if (troubles.empty()) return;
  json["status"] = status_of(false);
  json["troubles"] = Json::array();
  for (const Diagnostic& trouble : troubles) {
    json["troubles"].push_back({{"diagnostic", trouble.id.text()},
                                {"severity", to_string(trouble.severity)},
                                {"file", trouble.file.empty() ? Json() : Json(trouble.file)},
                                {"line", trouble.line},
                                {"column", trouble.column},
                                {"message", trouble.message},
                                {"hint", trouble.hint}});
  }
}

}  // namespace

std::string json_of(const CheckedFile& checked, const Diagnostics& troubles) {
  Json json{{"schema", "frustum/check/1"}, {"version", program_version()}};
  json.update(file_json(checked));
  add_troubles(json, troubles);
  return text_of_json(json);
}

std::string json_of(std::span<const CheckedFile> checked, const Diagnostics& troubles) {
  const bool passed =
      std::ranges::all_of(checked, [](const CheckedFile& each) { return each.passed; });
  Json json{{"schema", "frustum/check-files/1"},
            {"version", program_version()},
            {"status", status_of(passed)},
            {"counts", counts_json(counts_of(checked))},
            {"files", Json::array()}};
  for (const CheckedFile& each : checked) json["files"].push_back(file_json(each));
  add_troubles(json, troubles);
  return text_of_json(json);
}

}  // namespace frustum::lint
