#include "app/job/named_files.hpp"

#include <fmt/format.h>

#include <utility>

#include "app/job/error_sources.hpp"
#include "core/toml_document.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

// "*" is any table, "[]" each of an array.
struct FileKey {
  std::string_view pattern{};
  std::string_view role{};
};
constexpr FileKey kFileKeys[] = {
    {"tools", "tools"},          {"tool.*.file", "tool"},        {"blank.file", "blank"},
    {"nominal.file", "nominal"}, {"fixtures[].file", "fixture"}, {"bodies[].file", "body"},
    {"errors.file", "errors"},   {"errors.etalon", "errors"},    {"errors.csv[]", "errors"},
    {"errors.*.csv", "errors"},  {"errors.grid", "errors"},
};

class FileSearch {
 public:
  FileSearch(std::string_view role, std::vector<NamedFile>& found) : role_(role), found_(found) {}

  void look(const TomlTable& table, std::string_view pattern, const std::string& above) {
    const auto dot = pattern.find('.');
    std::string_view name = pattern.substr(0, dot);
    const bool each = name.ends_with("[]");
    if (each) name.remove_suffix(2);
    if (dot == std::string_view::npos) {
      each ? take_each(table, name, above) : take(table, name, above);
      return;
    }
    const std::string_view rest = pattern.substr(dot + 1);
    if (each) {
      const std::vector<TomlTable> tables = table.tables(name);
      for (std::size_t i = 0; i < tables.size(); ++i) {
        look(tables[i], rest, fmt::format("{}{}[{}].", above, name, i));
      }
      return;
    }
    for (const std::string& key : table.keys()) {
      if (name != "*" && name != key) continue;
      if (table.is_table(key)) look(table.table(key), rest, above + key + ".");
    }
  }

 private:
  void take(const TomlTable& table, std::string_view name, const std::string& above) {
    if (table.is_table(name) || table.is_array(name)) return;
    add(table, above + std::string(name), table.text_or(name, ""));
  }
  void take_each(const TomlTable& table, std::string_view name, const std::string& above) {
    if (!table.is_array(name)) return;
    const std::vector<std::string> texts = table.texts_or(name, {});
    for (std::size_t i = 0; i < texts.size(); ++i) {
      add(table, fmt::format("{}{}[{}]", above, name, i), texts[i]);
    }
  }
  void add(const TomlTable& table, std::string key, const std::string& written) {
    if (written.empty()) return;
    fs::path file = fs::path(written).is_absolute() ? fs::path(written) : table.folder() / written;
    if (key == "errors.file") file = find_error_file(written, table.folder());
    found_.push_back({std::move(key), std::string(role_), written, std::move(file)});
  }

  std::string_view role_;
  std::vector<NamedFile>& found_;
};

}  // namespace

Result<std::vector<NamedFile>> files_named_in(std::string_view text, const fs::path& document) {
  const auto parsed = TomlDocument::parse(text, document);
  if (!parsed) return parsed.error();
  std::vector<NamedFile> found;
  for (const FileKey& key : kFileKeys) {
    FileSearch(key.role, found).look(parsed->root(), key.pattern, "");
  }
  return found;
}

}  // namespace frustum::app
