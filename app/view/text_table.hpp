// A table for a terminal: first column to the left, the others to the right.
// Units: none. Errors: none.
#pragma once

#include <string>
#include <vector>

namespace frustum::app {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> headings);
  void row(std::vector<std::string> cells);
  // Columns as wide as their widest cell, two spaces apart.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace frustum::app
