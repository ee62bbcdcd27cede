// JSON documents as files: read with the place of what is damaged, and their keys with the path of
// what is missing or of another type.
//
// Units : none
// Errors: a file that cannot be read or is no JSON, with line and column; of keys, with their paths
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"

namespace frustum::app {

[[nodiscard]] Result<nlohmann::json> read_json_file(const std::filesystem::path& file);

// Gathers a fault for each key that is not what it is asked for as. `at`: the path of the object,
// "characteristics[2]"; empty: the document.
class JsonKeys {
 public:
  using json = nlohmann::json;

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

}  // namespace frustum::app
