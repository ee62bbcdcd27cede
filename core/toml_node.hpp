// What a TOML file holds once it is parsed: for toml_table.cpp and toml_document.cpp alone.
//
// Units : as written
// Errors: none
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/diagnostic.hpp"

namespace frustum {
namespace toml_detail {

struct Entry;

struct Node {
  using Array = std::vector<Node>;
  struct Table {
    std::vector<Entry> entries;
    mutable std::vector<std::string> asked;  // what readers asked for, known or not
    mutable bool opened = false;             // a reader looked inside
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

struct State {
  std::filesystem::path file;
  Node root;
  Diagnostics diagnostics;
};

// "tool.1" and "diameter": "tool.1.diameter".
inline std::string joined(const std::string& path, std::string_view key) {
  if (path.empty()) return std::string(key);
  if (key.empty()) return path;
  return path + "." + std::string(key);
}

}  // namespace toml_detail

}  // namespace frustum
