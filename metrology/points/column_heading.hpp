// Headings of the columns of a table of points, in English and German.
//
// Model    : words that signs and blanks separate: one is the coordinate, others say that it is
//            measured (act, ist) or nominal (nom, soll), the last may be its unit. What may mean
//            two things (Merkmal, dX) is not known
// Units    : none; the unit is as the file writes it
// Shape    : one heading
// Errors   : none; the name of an unknown one is its own text in lower case
// Accuracy : exact
// Source   : ours
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace frustum::metrology {

struct ColumnHeading {
  std::string name{};  // of known_columns() where it is known
  std::string unit{};  // "mm" of "X-Istwert [mm]", "x_act_mm", "Y in mm"; may be empty
};
[[nodiscard]] ColumnHeading column_heading(std::string_view text);

// feature, section, x, y, z and so on: the names as `frustum run` writes them, and those of what
// other programs write beside them.
[[nodiscard]] std::span<const std::string_view> known_columns();

// Whether its fields are names, not numbers.
[[nodiscard]] bool is_text_column(std::string_view name);

}  // namespace frustum::metrology
