#include "report/tool_text.hpp"

#include "core/units.hpp"

namespace frustum::report {

std::string tool_text(const cutter::CutterSpec& tool, const Wording& words) {
  const std::string english = cutter::description(tool);
  if (words.style() == ReportStyle{}) return english;
  std::string text = words.word(english.substr(0, english.find(", ")));
  const auto add = [&](Phrase name, double value, std::string_view unit) {
    if (value != 0.0) text += ", " + words(name) + " " + words.amount(value, unit);
  };
  add("diameter", tool.diameter.value, "mm");
  add("length", tool.length.value, "mm");
  add("radius error", tool.radius_error.value * kUmPerMm, "um");
  add("length error", tool.length_error.value * kUmPerMm, "um");
  add("run-out", tool.run_out.value * kUmPerMm, "um");
  add("run-out tilt", tool.run_out_tilt.value * kUradPerRad, "urad");
  return text;
}

}  // namespace frustum::report
