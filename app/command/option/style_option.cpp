#include "app/command/option/style_option.hpp"

#include "app/command/command_line.hpp"

namespace frustum::app {

void add_style_options(Command& command, StyleWords& words) {
  command
      .option("--language", words.language,
              "Of the page and the summary: en (default), de; files for programs stay English")
      .one_of({"en", "de"});
  command
      .option("--units", words.units,
              "Of lengths on the page and in the summary: mm (default), inch; files for programs "
              "stay in mm and um")
      .one_of({"mm", "inch"});
}

report::ReportStyle style_of(const StyleWords& words) {
  return {words.language == "de" ? report::Language::german : report::Language::english,
          words.units == "inch" ? report::LengthUnits::inch : report::LengthUnits::millimetre};
}

}  // namespace frustum::app
