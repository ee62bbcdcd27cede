#include "kinematics/model/structure_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace frustum::kinematics {
namespace {

std::vector<std::string> parts_of(std::string_view code) {
  std::vector<std::string> parts(1);
  for (const char c : code) {
    if (c == '-') {
      parts.emplace_back();
    } else if (c != ' ') {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<AxisLetter> axis_of(const std::string& part) {
  for (const AxisLetter letter : kAxisLetters) {
    if (part.size() == 1 && part[0] == to_char(letter)) return letter;
  }
  return std::nullopt;
}

}  // namespace

Result<StructureCode> parse_structure(std::string_view code) {
  const auto refuse = [&](const std::string& what) {
    return error("structure-code"_id, fmt::format("structure code '{}': {}", code, what),
                 "tool first, b the bed, workpiece last, for example t-(C)-Z-Y-b-X-B-C-w");
  };
  const std::vector<std::string> parts = parts_of(code);
  if (parts.front() != "t") return refuse("it must begin with t, the tool");
  if (parts.back() != "w") return refuse("it must end with w, the workpiece");
  StructureCode structure;
  bool past_bed = false;
  int rotary = 0;
  std::vector<AxisLetter> seen;
  for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
    const std::string& part = parts[i];
    if (part == "b") {
      if (past_bed) return refuse("there are two beds");
      past_bed = true;
      continue;
    }
    if (part.size() == 3 && part.front() == '(' && part.back() == ')') {
      if (i != 1) return refuse("the spindle " + part + " must follow the tool");
      continue;
    }
    const auto letter = axis_of(part);
    if (!letter) return refuse("'" + part + "' is not an axis (X Y Z A B C)");
    if (std::find(seen.begin(), seen.end(), *letter) != seen.end()) {
      return refuse("axis " + part + " is there twice");
    }
    seen.push_back(*letter);
    rotary += is_rotary(*letter) ? 1 : 0;
    (past_bed ? structure.work : structure.tool).push_back(*letter);
  }
  if (!past_bed) return refuse("there is no bed b between tool and workpiece");
  if (rotary > 2) return refuse(fmt::format("{} rotary axes, at most two are supported", rotary));
  for (const AxisLetter linear : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
    if (std::find(seen.begin(), seen.end(), linear) == seen.end()) {
      return refuse(fmt::format("axis {} is missing", to_char(linear)));
    }
  }
  std::reverse(structure.tool.begin(), structure.tool.end());
  return structure;
}

}  // namespace frustum::kinematics
