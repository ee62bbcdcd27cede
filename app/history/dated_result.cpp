#include "app/history/dated_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "core/program_version.hpp"
#include "core/spelling.hpp"
#include "core/whole_file.hpp"
#include "parser/language/letter_case.hpp"

namespace frustum::app {
namespace {

using nlohmann::json;

// The documents whose values a history follows, and itself; each in the one form that there is.
constexpr std::array<std::string_view, 4> kForms{"frustum/result/1", "frustum/identification/1",
                                                 "frustum/motion/1", "frustum/history/1"};

// "result" of "frustum/result/1".
std::string kind_of(std::string_view schema) {
  constexpr std::string_view kBegin = "frustum/";
  if (!schema.starts_with(kBegin)) return {};
  const std::string_view rest = schema.substr(kBegin.size());
  return std::string(rest.substr(0, rest.find('/')));
}

// Where a text stops being JSON.
class FirstFault : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&, const json::exception&) override {
    bytes = position;
    return false;
  }
  std::size_t bytes = 0;  // read up to there, the wrong one among them
};

Diagnostic damaged(const std::filesystem::path& file, const std::string& text) {
  FirstFault fault;
  json::sax_parse(text, &fault);
  const bool ends = fault.bytes > text.size();
  const std::string_view before =
      std::string_view(text).substr(0, std::min(fault.bytes, text.size()));
  const std::string_view sound =
      ends || before.empty() ? before : before.substr(0, before.size() - 1);
  const std::size_t line_begin = sound.rfind('\n') == sound.npos ? 0 : sound.rfind('\n') + 1;
  Diagnostic problem =
      error("not-json"_id,
            ends ? "ends before the document does: it is damaged" : "is no JSON from here on",
            "restore the file, or keep what is no result out of the folder");
  problem.file = file.string();
  problem.line = 1 + static_cast<int>(std::ranges::count(sound, '\n'));
  problem.column = 1 + static_cast<int>(sound.size() - line_begin);
  return problem;
}

// Gathers a fault for each key that is not what it is asked for as. `at`: the path of the object,
// "characteristics[2]"; empty: the document.
class JsonKeys {
 public:
  explicit JsonKeys(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] const Diagnostics& faults() const { return faults_; }

  void fail(const std::string& key, DiagnosticId id, std::string message, std::string hint = {});
  // Empty without the key, or where it is null.
  std::string text_or_none(const json& object, const std::string& at, const char* key);
  std::string text(const json& object, const std::string& at, const char* key);
  std::string choice(const json& object, const std::string& at, const char* key,
                     const std::vector<std::string>& words);
  // Null is how a document writes that there is none.
  std::optional<double> number(const json& object, const std::string& at, const char* key);
  // Of a list, with their paths.
  std::vector<std::pair<std::string, json>> objects(const json& document, const char* key);

 private:
  void wrong_type(const json& object, const std::string& path, const char* key,
                  const char* expected);

  std::filesystem::path file_;
  Diagnostics faults_{};
};

std::string path_of(const std::string& at, const char* key) {
  return at.empty() ? key : at + "." + key;
}

Result<json> read_json_file(const std::filesystem::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  json document = json::parse(*text, nullptr, false);
  if (document.is_discarded()) return damaged(file, *text);
  return document;
}

void JsonKeys::fail(const std::string& key, DiagnosticId id, std::string message,
                    std::string hint) {
  Diagnostic problem = error(id, std::move(message), std::move(hint));
  problem.file = file_.string();
  problem.key = key;
  faults_.push_back(std::move(problem));
}

void JsonKeys::wrong_type(const json& object, const std::string& at, const char* key,
                          const char* expected) {
  fail(path_of(at, key), "wrong-type"_id,
       fmt::format("{}expected {}", object.contains(key) ? "" : "is missing: ", expected));
}

std::string JsonKeys::text_or_none(const json& object, const std::string& at, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return {};
  if (found->is_string()) return found->get<std::string>();
  wrong_type(object, at, key, "a text");
  return {};
}

std::string JsonKeys::text(const json& object, const std::string& at, const char* key) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_string() &&
      !found->get_ref<const std::string&>().empty()) {
    return found->get<std::string>();
  }
  wrong_type(object, at, key, "a text");
  return {};
}

std::string JsonKeys::choice(const json& object, const std::string& at, const char* key,
                             const std::vector<std::string>& words) {
  std::string word = text(object, at, key);
  if (!word.empty() && std::ranges::find(words, word) == words.end()) {
    fail(path_of(at, key), "unknown-word"_id, fmt::format("'{}' is not known here", word),
         suggestion(word, words));
  }
  return word;
}

std::optional<double> JsonKeys::number(const json& object, const std::string& at, const char* key) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_null()) return std::nullopt;
  if (found != object.end() && found->is_number()) return found->get<double>();
  wrong_type(object, at, key, "a number, or null");
  return std::nullopt;
}

std::vector<std::pair<std::string, json>> JsonKeys::objects(const json& document, const char* key) {
  std::vector<std::pair<std::string, json>> all;
  const auto found = document.find(key);
  if (found == document.end() || !found->is_array()) {
    wrong_type(document, "", key, "a list");
    return all;
  }
  for (std::size_t k = 0; k < found->size(); ++k) {
    const std::string at = fmt::format("{}[{}]", key, k);
    if ((*found)[k].is_object()) {
      all.emplace_back(at, (*found)[k]);
    } else {
      fail(at, "wrong-type"_id, "expected an object");
    }
  }
  return all;
}

void add(DatedResult& result, ReadValue value, const std::optional<double>& number) {
  if (!number) {
    result.without_value.push_back(value.name);
    return;
  }
  value.value = *number;
  result.values.push_back(std::move(value));
}

void read_date(DatedResult& result, const json& document, JsonKeys& keys) {
  const auto evidence = document.find("evidence");
  if (evidence == document.end() || evidence->is_null()) return;
  if (!evidence->is_object()) {
    keys.fail("evidence", "wrong-type"_id, "expected an object");
    return;
  }
  const std::string date = keys.text_or_none(*evidence, "evidence", "date");
  if (date.empty()) return;
  if (const auto moment = moment_of(date)) {
    result.moment = *moment;
    result.date_from = TakenFrom::document;
  } else {
    keys.fail("evidence.date", "wrong-date"_id, fmt::format("'{}' is no date", date),
              "year, month, day: \"2026-11-23\" or \"2026-11-23T14:05:00\"");
  }
}

void read_characteristics(DatedResult& result, const json& document, JsonKeys& keys) {
  static const std::vector<std::string> kUnits{"um", "urad", "mm", "deg"};
  static const std::vector<std::string> kVerdicts{"pass", "fail", "uncertain"};
  read_date(result, document, keys);
  for (const auto& [at, each] : keys.objects(document, "characteristics")) {
    ReadValue value{.name = keys.text(each, at, "name"),
                    .group = "characteristic",
                    .kind = keys.text(each, at, "kind"),
                    .unit = keys.choice(each, at, "unit", kUnits),
                    .nominal = keys.number(each, at, "nominal"),
                    .tolerance = keys.number(each, at, "tolerance"),
                    .verdict = keys.choice(each, at, "verdict", kVerdicts)};
    // U of 0 is that of a machine without errors, or of which nothing is stated.
    const auto u = keys.number(each, at, "expanded_uncertainty");
    if (u && *u > 0.0) value.half_width = u;
    add(result, std::move(value), keys.number(each, at, "value"));
  }
}

void read_estimates(DatedResult& result, const json& document, JsonKeys& keys) {
  for (const auto& [at, each] : keys.objects(document, "estimates")) {
    ReadValue value{
        .name = keys.text(each, at, "name"), .group = "error", .unit = keys.text(each, at, "unit")};
    const auto number = keys.number(each, at, "value");
    if (number) {
      const auto lower = keys.number(each, at, "lower"), upper = keys.number(each, at, "upper");
      if (lower && upper) value.half_width = 0.5 * (*upper - *lower);
    }
    add(result, std::move(value), number);
  }
}

// The values of ISO 230-4 and ISO 230-2, which the documents have in um.
constexpr std::array<std::string_view, 24> kReadings{
    "G_ccw_ls",  "G_cw_ls",   "G_bi_ls",  "G_ccw_mz", "G_cw_mz", "G_bi_mz",
    "F_ccw_max", "F_ccw_min", "F_cw_max", "F_cw_min", "B",       "B_mean",
    "R_up",      "R_down",    "R",        "E_up",     "E_down",  "E",
    "M",         "A_up",      "A_down",   "A",        "rms_um",  "D_mean_radial"};

void read_readings(DatedResult& result, const json& document, JsonKeys& keys) {
  std::string test = keys.text(document, "", "test");
  for (const char* which : {"plane", "axis"}) {
    const std::string word = keys.text_or_none(document, "", which);
    if (!word.empty()) test += " " + word;
  }
  const auto evaluation = document.find("evaluation");
  if (evaluation == document.end() || evaluation->is_null()) return;  // of a test that has none
  if (!evaluation->is_object()) {
    keys.fail("evaluation", "wrong-type"_id, "expected an object");
    return;
  }
  for (const auto& [key, value] : evaluation->items()) {
    if (std::ranges::find(kReadings, key) == kReadings.end()) continue;
    if (value.is_structured()) continue;  // of each direction or target: none of the machine's
    add(result, {.name = test + " " + key, .group = "reading", .unit = "um"},
        keys.number(*evaluation, "evaluation", key.c_str()));
  }
}

Diagnostic no_document(const std::filesystem::path& file, std::string message) {
  Diagnostic problem =
      error(kNoDocument, std::move(message),
            "a history follows the JSON documents of run, measure, identify and motion");
  problem.file = file.string();
  return problem;
}

// "as-found", "As_Found", "as left" as a word of its own.
bool has_words(std::string_view name, std::string_view first, std::string_view second) {
  const std::string small = parser::lower_case(name);
  const auto is_letter_at = [&](std::size_t k) {
    return k < small.size() && small[k] >= 'a' && small[k] <= 'z';
  };
  for (std::size_t at = small.find(first); at != small.npos; at = small.find(first, at + 1)) {
    std::size_t next = at + first.size();
    if (next < small.size() &&
        std::string_view("-_ ").find(small[next]) != std::string_view::npos) {
      ++next;
    }
    const bool begins = at == 0 || !is_letter_at(at - 1);
    if (begins && small.compare(next, second.size(), second) == 0 &&
        !is_letter_at(next + second.size())) {
      return true;
    }
  }
  return false;
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

std::optional<MachineState> state_in(std::string_view name) {
  const bool found = has_words(name, "as", "found"), left = has_words(name, "as", "left");
  if (found && left) return std::nullopt;
  return found ? MachineState::as_found : left ? MachineState::as_left : MachineState::not_stated;
}

Result<DatedResult> read_result(const std::filesystem::path& file) {
  const auto read = read_json_file(file);
  if (!read) return read.error();
  const json& document = *read;
  if (!document.is_object()) return no_document(file, "is no JSON object");
  JsonKeys keys(file);
  const std::string schema = keys.text_or_none(document, "", "schema");
  const std::string kind = kind_of(schema);
  const auto form = std::ranges::find(kForms, kind, kind_of);
  if (form == kForms.end()) {
    return no_document(
        file, schema.empty() ? std::string("has no schema: it is no document of Frustum")
                             : fmt::format("'{}' has no values that a history follows", schema));
  }
  if (schema != *form) {
    keys.fail("schema", "unknown-form"_id, fmt::format("'{}' is another form of it", schema),
              fmt::format("this Frustum, {}, reads {}", program_version(), *form));
    return keys.faults();
  }
  DatedResult result{.file = file,
                     .document = kind,
                     .title = keys.text_or_none(document, "", "title"),
                     .machine = keys.text_or_none(document, "", "machine")};
  // "iwf-bc, C on B, tilting table": documents differ in how much they say after the name.
  result.machine = result.machine.substr(0, result.machine.find(','));
  if (kind == "result") read_characteristics(result, document, keys);
  if (kind == "identification") read_estimates(result, document, keys);
  if (kind == "motion") read_readings(result, document, keys);
  if (!keys.faults().empty()) return keys.faults();
  return result;
}

}  // namespace frustum::app
