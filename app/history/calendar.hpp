// Days of the calendar, as reports and file names have them.
//
// Units : days since 1970-01-01. Errors: none; nothing where the text is no date
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frustum::app {

struct Moment {
  std::string text{};  // as written: "2026-11-23", "2026-11-23T14:05:00Z"
  double day = 0.0;    // with its time as a fraction; the time of its zone, UTC where none is said
  bool has_time = false;

  // "2026-11-23"
  [[nodiscard]] std::string date() const { return text.substr(0, 10); }
};

// All of the text: 2026-11-23, 2026-11-23T14:05:00, with Z or +01:00.
[[nodiscard]] std::optional<Moment> moment_of(std::string_view text);

struct MomentInName {
  std::optional<Moment> moment{};
  // What looks like a day and is none of the calendar ("2026-02-30"), where the name has no other;
  // what looks like a time after the day, and is none of a day ("2026-11-23T2430").
  std::string no_day{}, no_time{};
};
// The first day in a name, with a time after T or _: "cone_2026-11-23.json", "2026-11-23T1405",
// "2026-11-23_14-05-30".
[[nodiscard]] MomentInName moment_in(std::string_view name);
// "2026-11-23", of whole days.
[[nodiscard]] std::string date_text(double day);

}  // namespace frustum::app
