// What a TOML file holds once it is parsed: for toml_table.cpp and toml_document.cpp alone.
//
// Units : as written
// Errors: none
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/diagnostic.hpp"

namespace frustum {
namespace toml_detail {

struct Entry;

struct Node {
  using Array = std::vector<Node>;
  struct Table {
    std::vector<Entry> entries;                              // in file order
    std::map<std::string, std::size_t, std::less<>> places;  // of them, by name
    mutable std::set<std::string, std::less<>> asked;        // by readers, known or not
    mutable bool opened = false;                             // a reader looked inside

    [[nodiscard]] const Node* find(std::string_view name) const;
  };
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table> value;
  int line = 0;
  int column = 0;

  [[nodiscard]] const Table* table() const { return std::get_if<Table>(&value); }
  [[nodiscard]] const Array* array() const { return std::get_if<Array>(&value); }
};

struct Entry {
  std::string name;
  Node node;
};

inline const Node* Node::Table::find(std::string_view name) const {
  const auto place = places.find(name);
  return place == places.end() ? nullptr : &entries[place->second].node;
}

struct State {
  std::filesystem::path file;
  Node root;
  Diagnostics diagnostics;
  std::set<std::pair<std::string, std::string>> noted;  // key and message of each
};

// "tool.1" and "diameter": "tool.1.diameter".
inline std::string joined(const std::string& path, std::string_view key) {
  if (path.empty()) return std::string(key);
  if (key.empty()) return path;
  return path + "." + std::string(key);
}

// With the file, and line, column and path of a key of a table.
Diagnostic placed(const State& state, const Node& table, const std::string& path,
                  std::string_view key, Diagnostic diagnostic);

}  // namespace toml_detail

}  // namespace frustum
