#include "app/history/json_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/spelling.hpp"
#include "core/whole_file.hpp"

namespace frustum::app {
namespace {

using nlohmann::json;

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

std::string path_of(const std::string& at, const char* key) {
  return at.empty() ? key : at + "." + key;
}

}  // namespace

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

}  // namespace frustum::app
