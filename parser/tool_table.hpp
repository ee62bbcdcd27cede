// The tools that a control knows: numbers, offsets, diameters, as far as a program depends on them.
//
// A tool table file is LinuxCNC's: one tool a line, a remark after ; of which there may be lines
//   alone. T1 P1 D10.0 Z50.0 ;end mill
//   T number, P pocket, D diameter, X Y Z A B C offsets, I J front and back angle of a turning tool
//   in degrees, Q its orientation 0 to 9. U, V and W have to be zero: these axes are not simulated.
// A D that a line leaves out is not given, and zero in LinuxCNC itself; other words are zero.
// The file does not name its unit. It is that of the machine, and in LinuxCNC's stand-alone rs274
// always the inch.
//
// Units : mm, rad; I and J as written, degrees
// Errors: read_tool_table: all mistakes of the file, with line and column
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "parser/language/modes.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

struct Tool {
  int pocket = 0;
  std::array<double, kAxisLetters.size()>
      offset{};  // of its tip from the gauge point, along the machine axes
  double diameter = 0.0;
  std::string remark{};
  // Whether the length (Z) and the diameter are given; what is not, only the setup knows. A wear
  // gives neither.
  bool has_length = true;
  bool has_diameter = true;
  double length_wear = 0.0;    // added to the length
  double diameter_wear = 0.0;  // added to the diameter
  double front_angle = 0.0;
  double back_angle = 0.0;
  int orientation = 0;
};

using ToolTable = std::map<int, Tool>;  // by tool number

// The entry of a number; of a new one neither length nor diameter is given.
[[nodiscard]] Tool& entry_of(ToolTable& tools, int number);

[[nodiscard]] Result<ToolTable> tool_table_of(std::string_view text, const std::string& file,
                                              LengthUnit unit = LengthUnit::millimetre);
[[nodiscard]] Result<ToolTable> read_tool_table(const std::filesystem::path& file,
                                                LengthUnit unit = LengthUnit::millimetre);

}  // namespace frustum::parser
