// --language and --units: how the page of a result and its text on the terminal are written.
//
// Units: none. Errors: a word that is no language or no unit, on the command line
#pragma once

#include <string>

#include "report/wording.hpp"

namespace frustum::app {

class Command;

struct StyleWords {
  std::string language = "en";
  std::string units = "mm";
};
void add_style_options(Command& command, StyleWords& words);
[[nodiscard]] report::ReportStyle style_of(const StyleWords& words);

}  // namespace frustum::app
