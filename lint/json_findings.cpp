#include "lint/json_findings.hpp"

#include <nlohmann/json.hpp>

namespace frustum::lint {

std::string json_of(const CheckReport& report, const CheckedFile& checked) {
  using Json = nlohmann::ordered_json;
  Json json{{"file", checked.file},
            {"dialect", checked.dialect},
            {"machine", checked.machine.empty() ? Json() : Json(checked.machine)},
            {"status", checked.passed ? "pass" : "fail"},
            {"blocks", report.blocks},
            {"motions", report.motions},
            {"counts",
             {{"error", report.count(Severity::error)},
              {"warning", report.count(Severity::warning)},
              {"note", report.count(Severity::note)}}},
            {"findings", Json::array()},
            {"left_out", Json::object()}};
  for (const Finding& finding : report.findings) {
    json["findings"].push_back(
        {{"id", info_of(finding.check).id},
         {"severity", to_string(finding.severity)},
         {"file", finding.file},
         {"line", finding.line},
         {"column", finding.column},
         {"message", finding.message},
         {"hint", finding.hint},
         {"count", finding.count},
         {"diagnostic", finding.diagnostic ? Json(finding.diagnostic->text()) : Json()}});
  }
  for (const auto& [check, count] : report.left_out) {
    json["left_out"][std::string(info_of(check).id)] = count;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace frustum::lint
