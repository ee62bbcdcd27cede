#include "parser/doubts.hpp"

#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>

namespace frustum::parser {

Diagnostics doubts_of(const std::vector<Motion>& motions) {
  Diagnostics doubts;
  std::set<std::string> told;
  for (const Motion& motion : motions) {
    const auto* event = std::get_if<Event>(&motion.command);
    if (event == nullptr || event->grade == EventGrade::known) continue;
    if (!told.insert(event->name).second) continue;
    Diagnostic doubt =
        event->grade == EventGrade::builder
            ? warning(
                  "builder-word"_id,
                  fmt::format("{} is a word of the machine's builder, passed over", event->name),
                  "name it under [controller] words of the machine, if it moves nothing")
            : warning("assumed"_id, fmt::format("{}: taken that {}", event->name, event->text));
    doubt.file = motion.place.file == nullptr ? std::string() : *motion.place.file;
    doubt.line = static_cast<int>(motion.place.line);
    doubt.column = static_cast<int>(motion.place.column);
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

}  // namespace frustum::parser
