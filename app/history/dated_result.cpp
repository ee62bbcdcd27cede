#include "app/history/dated_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/whole_file.hpp"

namespace frustum::app {
namespace {

using nlohmann::json;

std::string text_at(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// Null is how a document writes that there is none.
std::optional<double> number_at(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  const double number = found->get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

// "result" of "frustum/result/1".
std::string kind_of(const std::string& schema) {
  constexpr std::string_view kBegin = "frustum/";
  if (!schema.starts_with(kBegin)) return {};
  const std::string rest = schema.substr(kBegin.size());
  return rest.substr(0, rest.find('/'));
}

const json& list_at(const json& object, const char* key) {
  static const json kNone = json::array();
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : kNone;
}

void add(DatedResult& result, ReadValue value, const std::optional<double>& number) {
  if (value.name.empty()) return;
  if (!number) {
    result.without_value.push_back(value.name);
    return;
  }
  value.value = *number;
  result.values.push_back(std::move(value));
}

void read_characteristics(DatedResult& result, const json& document) {
  if (const auto evidence = document.find("evidence");
      evidence != document.end() && evidence->is_object()) {
    if (const auto moment = moment_of(text_at(*evidence, "date"))) {
      result.moment = *moment;
      result.date_from = TakenFrom::document;
    }
  }
  for (const json& each : list_at(document, "characteristics")) {
    if (!each.is_object()) continue;
    ReadValue value{.name = text_at(each, "name"),
                    .group = "characteristic",
                    .kind = text_at(each, "kind"),
                    .unit = text_at(each, "unit"),
                    .nominal = number_at(each, "nominal"),
                    .tolerance = number_at(each, "tolerance"),
                    .verdict = text_at(each, "verdict")};
    // U of 0 is that of a machine without errors, or of which nothing is stated.
    const auto u = number_at(each, "expanded_uncertainty");
    if (u && *u > 0.0) value.half_width = u;
    add(result, std::move(value), number_at(each, "value"));
  }
}

void read_estimates(DatedResult& result, const json& document) {
  for (const json& each : list_at(document, "estimates")) {
    if (!each.is_object()) continue;
    ReadValue value{.name = text_at(each, "name"), .group = "error", .unit = text_at(each, "unit")};
    const auto lower = number_at(each, "lower"), upper = number_at(each, "upper");
    if (lower && upper) value.half_width = 0.5 * (*upper - *lower);
    add(result, std::move(value), number_at(each, "value"));
  }
}

// The values of ISO 230-4 and ISO 230-2, which the documents have in um.
constexpr std::array<std::string_view, 24> kReadings{
    "G_ccw_ls",  "G_cw_ls",   "G_bi_ls",  "G_ccw_mz", "G_cw_mz", "G_bi_mz",
    "F_ccw_max", "F_ccw_min", "F_cw_max", "F_cw_min", "B",       "B_mean",
    "R_up",      "R_down",    "R",        "E_up",     "E_down",  "E",
    "M",         "A_up",      "A_down",   "A",        "rms_um",  "D_mean_radial"};

void read_readings(DatedResult& result, const json& document) {
  std::string test = text_at(document, "test");
  for (const char* which : {"plane", "axis"}) {
    if (const std::string word = text_at(document, which); !word.empty()) test += " " + word;
  }
  const auto evaluation = document.find("evaluation");
  if (evaluation == document.end() || !evaluation->is_object()) return;
  for (const auto& [key, value] : evaluation->items()) {
    if (std::ranges::find(kReadings, key) == kReadings.end()) continue;
    add(result, {.name = test + " " + key, .group = "reading", .unit = "um"},
        number_at(*evaluation, key.c_str()));
  }
}

Diagnostic about_file(const std::filesystem::path& file, Diagnostic problem) {
  problem.file = file.string();
  return problem;
}

}  // namespace

std::string_view name_of(MachineState state) {
  return kStateNames.at(static_cast<std::size_t>(state));
}

std::string_view name_of(TakenFrom from) {
  constexpr std::array<std::string_view, 5> kNames{"nowhere", "index", "document", "file name",
                                                   "folder name"};
  return kNames.at(static_cast<std::size_t>(from));
}

MachineState state_in(std::string_view name) {
  const auto holds = [&](std::string_view one, std::string_view other) {
    return name.find(one) != name.npos || name.find(other) != name.npos;
  };
  if (holds("as-found", "as_found")) return MachineState::as_found;
  if (holds("as-left", "as_left")) return MachineState::as_left;
  return MachineState::not_stated;
}

Result<DatedResult> read_result(const std::filesystem::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  const json document = json::parse(*text, nullptr, false);
  if (!document.is_object()) {
    return about_file(file, error("not-json"_id, "is no JSON object",
                                  "results are what --json prints and result.json holds"));
  }
  const std::string schema = text_at(document, "schema");
  DatedResult result{.file = file,
                     .document = kind_of(schema),
                     .title = text_at(document, "title"),
                     .machine = text_at(document, "machine")};
  // "iwf-bc, C on B, tilting table": documents differ in how much they say after the name.
  result.machine = result.machine.substr(0, result.machine.find(','));
  if (result.document == "result") {
    read_characteristics(result, document);
  } else if (result.document == "identification") {
    read_estimates(result, document);
  } else if (result.document == "motion") {
    read_readings(result, document);
  } else if (result.document != kHistoryDocument) {
    return about_file(
        file,
        error("unknown-document"_id,
              schema.empty() ? std::string("has no schema: it is no document of Frustum")
                             : fmt::format("'{}' has no values that a history follows", schema),
              "a history follows the JSON documents of run, measure, identify and motion"));
  }
  return result;
}

}  // namespace frustum::app
