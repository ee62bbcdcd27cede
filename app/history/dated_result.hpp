// One result of a machine's history: the values of a document that Frustum wrote, its date, and
// from where that is known.
//
// Documents: results of `run` and `measure` (characteristics), of `identify` (machine errors), of
// `motion` (what a circle or a positioning test evaluates).
// Units  : each value in its own
// Errors : a file that cannot be read, that is damaged (with line and column), that is no such
//          document (kNoDocument), or one in another form than this program writes; keys that are
//          missing or hold something else than they may, with their paths
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/history/calendar.hpp"
#include "core/result.hpp"

namespace frustum::app {

// How a machine was found, and how it was left after an adjustment.
enum class MachineState { not_stated, as_found, as_left };
inline constexpr std::array<std::string_view, 3> kStateNames{"", "as-found", "as-left"};
[[nodiscard]] std::string_view name_of(MachineState state);

// Where a date or a state is taken from.
enum class TakenFrom { nowhere, index, document, file_name, folder_name };
[[nodiscard]] std::string_view name_of(TakenFrom from);

struct ReadValue {
  std::string name{};   // "cone.form", "EB0C", "circle XY G_bi_ls"
  std::string group{};  // "characteristic", "error", "reading"
  std::string kind{};   // of a characteristic
  std::string unit{};
  double value = 0.0;
  std::optional<double> half_width{};  // of the 95 % interval about it; nothing: not stated
  std::optional<double> nominal{}, tolerance{};
  std::string verdict{};  // as the document states it: "pass", "fail", "uncertain"
};

struct DatedResult {
  std::filesystem::path file{};
  std::string document{};  // "result", "identification", "motion"
  std::string title{}, machine{};
  Moment moment{};
  TakenFrom date_from = TakenFrom::nowhere;
  MachineState state = MachineState::not_stated;
  TakenFrom state_from = TakenFrom::nowhere;
  std::vector<ReadValue> values{};
  std::vector<std::string> without_value{};  // named, but not measured or not identified
};

// What a history itself is written as; it has no values.
inline constexpr std::string_view kHistoryDocument = "history";
// What is wrong with a sound file that has no values which a history follows.
inline constexpr DiagnosticId kNoDocument = "unknown-document"_id;
// Its date is what the document itself states; date_from is nowhere where it states none.
[[nodiscard]] Result<DatedResult> read_result(const std::filesystem::path& file);
// "as-found" or "as-left" in a name, with a hyphen, a blank or an underscore, in any case; nothing
// where it has both.
[[nodiscard]] std::optional<MachineState> state_in(std::string_view name);

}  // namespace frustum::app
