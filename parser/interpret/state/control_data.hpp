// What a control keeps from one program to the next: work offsets, reference points, tools, the
// shift of G92. A program reads and writes it by G10, G28.1, G92 and numbered parameters.
//
//   LinuxCNC #5161 #5181 reference points; #5210, #5211 G92; #5220 the work offset; #5221 to #5389
//              work offsets, 20 apart, #5230, #5250, ... their turns; #5400 to #5413 the tool in
//              the spindle; #5420 the position
//   Fanuc #5201 external offset; #5221 to #5326 G54 to G59; #7001 and on G54.1; #2001 (or #10001)
//              and on tool lengths, #11001 their wear, #12001 and #13001 radii; #5001 the position
//
// Units : mm, rad; parameters of lengths in the machine's unit (LinuxCNC) or in the program's
//         (Fanuc), of angles in degrees
// Errors: none; write_parameter() says why a value is not taken
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "parser/dialect.hpp"
#include "parser/language/modes.hpp"
#include "parser/motion.hpp"
#include "parser/tool_table.hpp"

namespace frustum::parser {

// Positions of the axes without tool at which the words are zero. An absent X, Y or Z is the
// setup's, which the program does not know; an absent rotary axis counts as zero. The turn is about
// Z.
struct WorkOffset {
  AxisTarget origin{};
  double rotation = 0.0;
  bool operator==(const WorkOffset&) const = default;
};
using WorkOffsets =
    std::map<int, WorkOffset>;  // numbers of WorkOffsetChange; 0: added to all (Fanuc)

struct ControlData {
  WorkOffsets work_offsets{};
  std::array<AxisTarget, 2> reference_points{};  // of G28 and G30; absent: the machine's
  ToolTable tools{};
  bool tools_are_listed = false;  // there was a tool table: other tools do not exist
  std::array<double, kAxisLetters.size()> shift{};  // of G92, also while it does not count
  bool shift_counts = false;
  int selected_offset = 1;
  int tool = 0;
  std::map<std::string, int, std::less<>> tool_names{};  // of called tools, in capitals
  LengthUnit unit = LengthUnit::millimetre;              // of the lengths in parameters
  // Where the diameter of a contour's tool is not known, its centre goes along the contour.
  bool contours_without_diameter = false;

  // What is there, or an empty entry.
  [[nodiscard]] WorkOffset work_offset(int number) const;
};

// A parameter that the data has. NaN: the program does not know its value.
[[nodiscard]] std::optional<double> read_parameter(const ControlData& data, Dialect dialect,
                                                   int index);
enum class ParameterUse : std::uint8_t { other, length, radius };
[[nodiscard]] ParameterUse use_of(Dialect dialect, int index);
enum class ParameterWrite : std::uint8_t { not_kept, done, read_only };
[[nodiscard]] ParameterWrite write_parameter(ControlData& data, Dialect dialect, int index,
                                             double value);

}  // namespace frustum::parser
