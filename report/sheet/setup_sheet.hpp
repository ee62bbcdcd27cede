// The setup sheet of a test piece as one HTML page that opens without a network and prints on
// paper: machine, tool, blank and how it is placed on the table, and every step with its positions
// and a drawing.
//
// Units: mm in the struct and on the page; table positions come as text
// Errors: writing: a diagnostic that names the file
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"

namespace frustum::report {

using SheetFace = std::vector<Vec3>;  // a flat polygon, counter-clockwise from outside

// A straight pass of an upright cylindrical tool over the workpiece in one table position.
struct SheetStep {
  std::string name{};   // "1-a c"
  std::string cuts{};   // which edge leaves what
  std::string table{};  // "A0 C-180"
  std::string size{};   // "H 175.4, L 61"
  Mat3 machine_from_workpiece = Mat3::Identity();
  // Tip at both ends of the pass, from the program's origin in machine directions: what the program
  // says.
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  // The line that is cut, and the middle of the one opposite; workpiece frame.
  Vec3 line_from = Vec3::Zero(), line_to = Vec3::Zero(), opposite = Vec3::Zero();
  double height = 0.0, width = 0.0;  // as dimensioned: of the line, and between both lines
  std::uint32_t first_line = 0, last_line = 0;  // NC
};

struct SetupSheet {
  std::string title{};
  std::vector<std::pair<std::string, std::string>> facts{};  // heading and text, in order
  std::vector<SheetFace> workpiece{};                        // finished, workpiece frame
  Mat3 table_from_workpiece = Mat3::Identity();              // directions
  std::string tilt_axis{}, turn_axis{};                      // "A", "C"
  bool tilts_about_x = true;                                 // else about Y
  double tool_radius = 0.0, tool_length = 0.0;               // as drawn
  std::vector<SheetStep> steps{};
};

[[nodiscard]] std::string setup_sheet(const SetupSheet& sheet);

// Writes the page; the folder must exist. Returns the path.
[[nodiscard]] Result<std::filesystem::path> write_setup_sheet(const std::filesystem::path& path,
                                                              const SetupSheet& sheet);

}  // namespace frustum::report
