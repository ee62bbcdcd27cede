// A history as people and scripts read it: a page of text, a JSON document, an HTML page.
//
// Units : each series in its own, in inches where the wording says so; slopes per day in JSON, per
//         30 days for people. Errors: none
#pragma once

#include <string>

#include "app/history/history.hpp"
#include "report/wording.hpp"

namespace frustum::app {

[[nodiscard]] std::string history_text(const History& history,
                                       const report::Wording& words = report::Wording());
[[nodiscard]] std::string history_json(const History& history);
[[nodiscard]] std::string history_page(const History& history,
                                       const report::Wording& words = report::Wording());

// Units as files have them (um, deg), or as people read them (µm, °).
enum class UnitStyle { word, symbol };
// "cone.form, 2026-03-02: 12.400 um, above the upper control limit 11.900": of each point that
// fails; with as many digits as tell a value from what it is beyond.
[[nodiscard]] std::vector<std::string> failures_of(
    const History& history, UnitStyle style, const report::Wording& words = report::Wording());
// Why a series has no limits, or what is to be said of them; empty where nothing is.
[[nodiscard]] std::string limits_remark(const HistorySeries& series,
                                        const report::Wording& words = report::Wording());
// "11.0 .. 12.0", of a tolerance about a nominal or below a limit; empty without one.
[[nodiscard]] std::string tolerance_text(const ReadValue& value, const report::Wording& words);
// "+0.120 ± 0.080", per 30 days; "-" where there is none.
[[nodiscard]] std::string trend_text(const HistorySeries& series, const report::Wording& words);

}  // namespace frustum::app
