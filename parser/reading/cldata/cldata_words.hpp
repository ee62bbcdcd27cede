// Records of APT CLDATA that say nothing of the path: known ones, and those of a post-processor or
// machine that are nowhere defined.
//
// Units : none
// Errors: none
// Source: ISO 4343 and ANSI X3.37 (the vocabulary), the lists of supported CL records of CGTech
//         Vericut and PTC Creo NC
#pragma once

#include <span>
#include <string_view>

namespace frustum::parser {

// Records whose arguments change nothing that is simulated.
[[nodiscard]] std::span<const char* const> cldata_note_words();
// Of records that are refused, the name of one whose form changes nothing: TRACUT/NOMORE.
// `argument` is its only one; null for others.
[[nodiscard]] const char* harmless_cldata(std::string_view record, std::string_view argument);
// Whether a record that is nowhere defined could move the tool or the part: by its name (GO..,
// ROT..), or by having a place for its arguments.
[[nodiscard]] bool could_move(std::string_view record, std::string_view arguments);
// Whether the record says that the program is one for turning or wire erosion, by its word alone or
// by one of its arguments.
[[nodiscard]] bool names_the_process(std::string_view record);
[[nodiscard]] bool is_not_milling(std::string_view record, std::string_view arguments);

}  // namespace frustum::parser
