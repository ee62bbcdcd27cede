// Which test of this module a name of ISO 10791-6 means.
//
// Model    : one table. The text of the standard was not at hand: names are attributed by what a
//            maker's paper says of them (BK1 and BK2 find location errors of tilting tables, BK4
//            moves five axes), the rest is ours and not verified
// Units    : none
// Errors   : none
// Source   : ISO 10791-6, by its name
#pragma once

#include <span>
#include <string_view>

namespace frustum::instruments {

struct StandardTest {
  std::string_view name;      // "BK1"
  std::string_view machines;  // that it is of
  std::string_view test;      // as `frustum motion` has it
  std::string_view shows;
  bool attributed = false;  // by a source; else our guess
};

[[nodiscard]] std::span<const StandardTest> standard_tests();

}  // namespace frustum::instruments
