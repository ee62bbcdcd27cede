#include "app/study/place_in_file.hpp"

#include <algorithm>

#include "core/toml_document.hpp"

namespace frustum::app {
namespace {

// What finish() tells of a document that nobody has asked for its keys.
std::optional<Diagnostic> noted(const TomlDocument& document, const Diagnostic& problem) {
  for (Diagnostic& one : document.finish()) {
    if (one.id == problem.id) return std::move(one);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Diagnostic> at_key(const std::filesystem::path& file, std::string_view table,
                                 std::string_view key, const Diagnostic& problem) {
  const auto document = TomlDocument::load(file);
  if (!document) return std::nullopt;
  const auto holder =
      table.empty() ? std::optional(document->root()) : document->root().table_if(table);
  if (!holder || !holder->has(key)) return std::nullopt;
  holder->fail(key, problem);
  return noted(*document, problem);
}

std::optional<Diagnostic> at_key_of(const std::filesystem::path& file, std::string_view list,
                                    const std::string& name, std::string_view key,
                                    const Diagnostic& problem) {
  const auto document = TomlDocument::load(file);
  if (!document) return std::nullopt;
  for (const TomlTable& one : document->root().tables(list)) {
    if (one.text_or("name", "") == name) one.fail(key, problem);
  }
  return noted(*document, problem);
}

}  // namespace frustum::app
