#include "core/toml_document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <functional>
#include <tuple>

#include "core/spelling.hpp"
#include "core/toml_key_length.hpp"
#include "core/toml_node.hpp"
#include "core/whole_file.hpp"

namespace frustum {
namespace {

using toml_detail::joined;
using toml_detail::Node;
using toml_detail::State;

Node convert(const toml::node& from) {
  Node node;
  node.line = static_cast<int>(from.source().begin.line);
  node.column = static_cast<int>(from.source().begin.column);
  if (const auto* table = from.as_table()) {
    Node::Table entries;
    for (const auto& [key, child] : *table) {
      entries.entries.push_back({std::string(key.str()), convert(child)});
      // A key's own place is what an editor should jump to.
      entries.entries.back().node.line = static_cast<int>(key.source().begin.line);
      entries.entries.back().node.column = static_cast<int>(key.source().begin.column);
    }
    std::stable_sort(
        entries.entries.begin(), entries.entries.end(), [](const auto& a, const auto& b) {
          return std::tie(a.node.line, a.node.column) < std::tie(b.node.line, b.node.column);
        });
    for (const auto& entry : entries.entries)
      entries.places.emplace(entry.name, entries.places.size());
    node.value = std::move(entries);
  } else if (const auto* array = from.as_array()) {
    Node::Array items;
    for (const auto& child : *array) items.push_back(convert(child));
    node.value = std::move(items);
  } else if (const auto* text = from.as_string()) {
    node.value = text->get();
  } else if (const auto* whole = from.as_integer()) {
    node.value = whole->get();
  } else if (const auto* real = from.as_floating_point()) {
    node.value = real->get();
  } else if (const auto* flag = from.as_boolean()) {
    node.value = flag->get();
  }
  return node;
}

}  // namespace

Result<TomlDocument> TomlDocument::load(const std::filesystem::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  return parse(*text, file);
}

Result<TomlDocument> TomlDocument::parse(std::string_view text, const std::filesystem::path& file) {
  if (const auto place = overlong_key(text)) {
    Diagnostic failure = frustum::error("toml-syntax"_id,
                                        fmt::format("a key of more than {} names", kMostNamesInKey),
                                        "no table here is so deep in others");
    failure.file = file.string();
    failure.line = place->line;
    failure.column = place->column;
    return failure;
  }
  auto state = std::make_shared<State>();
  state->file = file;
  try {  // toml++ reports by exception; it ends here
    state->root = convert(toml::parse(text, file.string()));
  } catch (const toml::parse_error& problem) {
    Diagnostic failure = frustum::error("toml-syntax"_id, std::string(problem.description()),
                                        "the file is not valid TOML");
    failure.file = file.string();
    failure.line = static_cast<int>(problem.source().begin.line);
    failure.column = static_cast<int>(problem.source().begin.column);
    return failure;
  }
  const Node* root = &state->root;
  return TomlDocument(TomlTable(std::move(state), root, ""));
}

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::filesystem::path TomlDocument::folder() const { return file().parent_path(); }
const std::filesystem::path& TomlDocument::file() const { return root_.state_->file; }

Diagnostics TomlDocument::finish() const {
  using Visit = std::function<void(const Node& node, const std::string& path)>;
  // The verdict is a copy, so that asking twice does not report a key twice.
  Diagnostics verdict = root_.state_->diagnostics;
  const Visit visit = [this, &visit, &verdict](const Node& node, const std::string& path) {
    if (const Node::Array* items = node.array()) {
      for (std::size_t i = 0; i < items->size(); ++i) {
        visit((*items)[i], fmt::format("{}[{}]", path, i + 1));
      }
      return;
    }
    const Node::Table* table = node.table();
    if (table == nullptr || !table->opened) return;
    const std::vector<std::string> known(table->asked.begin(), table->asked.end());
    for (const auto& [name, child] : table->entries) {
      if (table->asked.contains(name)) {
        visit(child, joined(path, name));
      } else {
        verdict.push_back(
            placed(*root_.state_, node, path, name,
                   frustum::error("unknown-key"_id, "unknown key", suggestion(name, known))));
      }
    }
  };
  visit(root_.state_->root, "");
  return verdict;
}

}  // namespace frustum
