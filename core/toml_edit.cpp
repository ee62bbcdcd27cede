#include "core/toml_edit.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>

namespace frustum {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

class TomlEditor {
 public:
  TomlEditor(std::string_view text, const toml::table& root) : text_(text), root_(root) {
    lines_.push_back(0);
    for (std::size_t i = 0; i < text_.size(); ++i) {
      if (text_[i] == '\n') lines_.push_back(i + 1);
    }
  }

  void replace(const std::string& key, const std::string& value) {
    const auto place = place_of(key);
    if (place) patches_.push_back({place->from, place->to, value});
  }

  void add(const TomlChanges::Added& added) {
    const auto place = place_of(added.after);
    if (!place) return;
    const auto dot = added.after.rfind('.');
    const bool nested = dot != std::string::npos;
    const toml::node* table = nested ? root_.at_path(added.after.substr(0, dot)).node() : nullptr;
    const bool is_inline = table != nullptr && table->is_table() && table->as_table()->is_inline();
    const std::string before = is_inline ? ", " : "\n" + key_before(place->from);
    patches_.push_back(
        {place->to, place->to, fmt::format("{}{} = {}", before, added.name, added.value)});
  }

  void empty(const std::string& key) {
    const toml::node* node = root_.at_path(key).node();
    if (node == nullptr || !node->is_table()) return;
    if (node->as_table()->is_inline()) {
      const Place place = place_of(*node);
      patches_.push_back({place.from, place.to, "{}"});
      return;
    }
    std::set<std::size_t> lines;
    for (const auto& [name, child] : *node->as_table()) mark_lines(child, lines);
    for (const std::size_t line : lines) {
      const std::size_t end = line + 1 < lines_.size() ? lines_[line + 1] : text_.size();
      patches_.push_back({lines_[line], end, ""});
    }
  }

  [[nodiscard]] Result<std::string> changed() {
    if (!problems_.empty()) return problems_;
    std::ranges::stable_sort(patches_, {}, &Patch::from);
    std::string out;
    std::size_t at = 0;
    for (const Patch& patch : patches_) {
      out += text_.substr(at, patch.from - at);
      out += patch.text;
      at = patch.to;
    }
    out += text_.substr(at);
    return out;
  }

 private:
  struct Place {
    std::size_t from = 0, to = 0;
  };
  struct Patch {
    std::size_t from = 0, to = 0;
    std::string text{};
  };

  // Columns count characters from 1.
  [[nodiscard]] std::size_t byte_of(const toml::source_position& position) const {
    std::size_t at = lines_[std::min<std::size_t>(position.line, lines_.size()) - 1];
    for (toml::source_index column = 1; column < position.column && at < text_.size(); ++column) {
      ++at;
      while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U) ++at;
    }
    return at;
  }
  [[nodiscard]] Place place_of(const toml::node& node) const {
    return {byte_of(node.source().begin), byte_of(node.source().end)};
  }
  [[nodiscard]] std::optional<Place> place_of(const std::string& key) {
    if (const toml::node* node = root_.at_path(key).node()) return place_of(*node);
    Diagnostic missing = error("missing-key"_id, "the key is missing");
    missing.key = key;
    problems_.push_back(std::move(missing));
    return std::nullopt;
  }

  // "program." of the line "program.file = ..": what goes before the last part of its key.
  [[nodiscard]] std::string key_before(std::size_t value) const {
    const std::size_t begin = text_.rfind('\n', value) + 1;  // npos + 1: the first line
    const std::string_view key = text_.substr(begin, value - begin);
    const auto dot = key.substr(0, key.find('=')).rfind('.');
    return dot == std::string_view::npos ? std::string() : std::string(key.substr(0, dot + 1));
  }

  // A key and its value, and a header, are on lines of their own.
  void mark_lines(const toml::node& node, std::set<std::size_t>& lines) const {
    const auto mark = [&](toml::source_index first, toml::source_index last) {
      for (auto line = first; line <= last; ++line) lines.insert(line - 1);
    };
    if (const auto* table = node.as_table(); table != nullptr && !table->is_inline()) {
      mark(node.source().begin.line, node.source().begin.line);
      for (const auto& [name, child] : *table) mark_lines(child, lines);
      return;
    }
    if (node.is_array_of_tables() && !node.as_array()->front().as_table()->is_inline()) {
      for (const toml::node& item : *node.as_array()) mark_lines(item, lines);
      return;
    }
    mark(node.source().begin.line, node.source().end.line);
  }

  std::string_view text_;
  const toml::table& root_;
  std::vector<std::size_t> lines_{};  // where they begin
  std::vector<Patch> patches_{};
  Diagnostics problems_{};
};

}  // namespace

Result<std::string> changed_toml(std::string_view text, const TomlChanges& changes) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  try {  // toml++ reports by exception; it ends here
    const toml::table root = toml::parse(text);
    TomlEditor editor(text, root);
    for (const auto& [key, value] : changes.replaced) editor.replace(key, value);
    for (const TomlChanges::Added& added : changes.added) editor.add(added);
    for (const std::string& key : changes.emptied) editor.empty(key);
    auto changed = editor.changed();
    if (changed) static_cast<void>(toml::parse(*changed));
    return changed;
  } catch (const toml::parse_error& problem) {
    Diagnostic failure = error("toml-syntax"_id, std::string(problem.description()));
    failure.line = static_cast<int>(problem.source().begin.line);
    return failure;
  }
}

}  // namespace frustum
