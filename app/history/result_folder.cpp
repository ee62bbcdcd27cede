#include "app/history/result_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

#include "core/counted.hpp"
#include "core/toml_document.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIndex = "history.toml";
constexpr const char* kDateHint =
    "state date = \"2026-11-23\" in [report] of the job, put the day into the name of the file or "
    "of its folder, or list the file in history.toml";

Diagnostic at_file(const fs::path& file, Diagnostic problem) {
  problem.file = file.string();
  return problem;
}

// Names from the file up to, and without, the folder that was asked for.
std::vector<std::string> names_of(const fs::path& file, const fs::path& folder) {
  std::vector<std::string> names;
  fs::path below = file.lexically_relative(folder);
  while (!below.empty()) {
    names.push_back(below.filename().string());
    below = below.parent_path();
  }
  return names;
}

void take_state(DatedResult& result, const std::string& name, TakenFrom from,
                Diagnostics& problems) {
  if (result.state != MachineState::not_stated) return;
  const auto state = state_in(name);
  if (!state) {
    problems.push_back(at_file(
        result.file, error("two-states"_id, fmt::format("'{}' says as-found and as-left", name),
                           "keep one of them, or list the file with its state in history.toml")));
    result.state_from = from;
  } else if (*state != MachineState::not_stated) {
    result.state = *state;
    result.state_from = from;
  }
}

// Of a date that a name gives: what looks like one and is none.
void remark_on_date(const DatedResult& result, const MomentInName& found, Diagnostics& problems) {
  const auto add = [&](Diagnostic problem) {
    problems.push_back(at_file(result.file, std::move(problem)));
  };
  if (!found.no_day.empty()) {
    add(warning("wrong-date"_id,
                fmt::format("'{}' is no day of the calendar: passed over", found.no_day),
                kDateHint));
  } else if (!found.no_time.empty() &&
             found.no_time[std::string_view("2026-01-01").size()] == 'T') {
    add(error("wrong-date"_id, fmt::format("'{}' has no time of day", found.no_time),
              "00:00 to 23:59, as in 2026-11-23T1405"));
  } else if (!found.no_time.empty()) {
    add(warning("wrong-date"_id,
                fmt::format("'{}' has no time of day: the day alone counts", found.no_time),
                "00:00 to 23:59, as in 2026-11-23_1405"));
  }
}

// The document's own date stays.
void take_from_names(DatedResult& result, const fs::path& folder, Diagnostics& remarks) {
  const std::vector<std::string> names = names_of(result.file, folder);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const TakenFrom from = k == 0 ? TakenFrom::file_name : TakenFrom::folder_name;
    take_state(result, names[k], from, remarks);
    const auto [moment, no_day, no_time] = moment_in(names[k]);
    if (result.date_from == TakenFrom::nowhere) {
      remark_on_date(result, {moment, no_day, no_time}, remarks);
    }
    if (!moment) continue;
    if (result.date_from == TakenFrom::nowhere) {
      result.moment = *moment;
      result.date_from = from;
    } else if (result.date_from == TakenFrom::document && moment->date() != result.moment.date()) {
      remarks.push_back(
          at_file(result.file,
                  warning("date-differs"_id,
                          fmt::format("the document states {}, '{}' says {}: the document's counts",
                                      result.moment.text, names[k], moment->text),
                          "rename it, or list the file with its date in history.toml")));
    }
  }
}

std::vector<fs::path> documents_in(const fs::path& folder, std::error_code& problem) {
  std::vector<fs::path> files;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied,
                                      problem);
  for (; !problem && at != fs::recursive_directory_iterator(); at.increment(problem)) {
    std::error_code ignored;
    if (at->path().filename().string().starts_with('.')) {
      if (at->is_directory(ignored)) at.disable_recursion_pending();
    } else if (at->path().extension() == ".json" && at->is_regular_file(ignored)) {
      files.push_back(at->path());
    }
  }
  std::ranges::sort(files);
  return files;
}

// What is no result is passed over, and said so: folders hold other documents beside. A damaged
// file may be one.
Result<ResultFolder> scanned(const fs::path& folder) {
  ResultFolder found{.title = fs::weakly_canonical(folder).filename().string()};
  std::error_code problem;
  for (const fs::path& file : documents_in(folder, problem)) {
    auto result = read_result(file);
    if (!result) {
      for (Diagnostic d : result.error()) {
        if (d.id == kNoDocument) {
          d.severity = Severity::warning;
          d.message = "left out: " + d.message;
        }
        found.remarks.push_back(std::move(d));
      }
      continue;
    }
    if (result->document == kHistoryDocument) continue;
    take_from_names(*result, folder, found.remarks);
    if (result->date_from == TakenFrom::nowhere) {
      found.remarks.push_back(
          at_file(file, error("no-date"_id, "no date is known of it", kDateHint)));
    }
    found.results.push_back(*std::move(result));
  }
  if (problem) {
    return at_file(folder, error("no-folder"_id, "cannot be read: " + problem.message()));
  }
  if (has_error(found.remarks)) return found.remarks;
  return found;
}

// "r.json:12:7", "r.json: characteristics[2].value"
std::string place_of(const Diagnostic& d) {
  std::string place = d.file;
  if (d.line > 0) place += fmt::format(":{}:{}", d.line, d.column);
  return d.key.empty() ? place : place + ": " + d.key;
}

// One table [[result]].
std::optional<DatedResult> listed_result(const TomlTable& table, Diagnostics& faults) {
  const std::string date = table.has("date") ? table.text("date") : std::string();
  const fs::path file = table.file_path("file");
  const auto state = static_cast<MachineState>(
      table.has("state") ? 1 + table.choice("state", {"as-found", "as-left"}) : 0);
  const auto moment = date.empty() ? std::nullopt : moment_of(date);
  if (!date.empty() && !moment) {
    table.fail("date", "wrong-date"_id, fmt::format("'{}' is no date", date),
               "year, month, day: \"2026-11-23\" or \"2026-11-23T14:05:00\"");
  }
  if (!table.is_sound()) return std::nullopt;
  auto result = read_result(file);
  if (!result) {
    for (const Diagnostic& d : result.error()) {
      table.fail("file", d.id, fmt::format("{}: {}", place_of(d), d.message), d.hint);
    }
    return std::nullopt;
  }
  if (result->document == kHistoryDocument) {
    table.fail("file", "unknown-document"_id, file.string() + " is a history itself");
    return std::nullopt;
  }
  if (state != MachineState::not_stated) {
    result->state = state;
    result->state_from = TakenFrom::index;
  }
  if (moment) {
    if (result->date_from == TakenFrom::document && result->moment.date() != moment->date()) {
      table.fail("date", "date-differs"_id,
                 fmt::format("{} here, but {} states {}", date, file.string(), result->moment.text),
                 "correct the one that is wrong, or leave the date out here");
      return std::nullopt;
    }
    result->moment = *moment;
    result->date_from = TakenFrom::index;
  }
  take_from_names(*result, table.folder(), faults);
  if (result->date_from == TakenFrom::nowhere) {
    table.fail("", "no-date"_id, fmt::format("no date is known of {}", file.string()),
               "add date = \"2026-11-23\"");
  }
  return *std::move(result);
}

Result<ResultFolder> listed(const fs::path& index) {
  const auto document = TomlDocument::load(index);
  if (!document) return document.error();
  ResultFolder found{.title = document->root().text_or(
                         "title", fs::weakly_canonical(index).parent_path().filename().string())};
  const std::string machine = document->root().text_or("machine", "");
  std::set<fs::path> files;
  for (const TomlTable& table : document->root().tables("result")) {
    if (auto result = listed_result(table, found.remarks)) {
      if (!files.insert(fs::weakly_canonical(result->file)).second) {
        table.fail("file", "listed-twice"_id,
                   fmt::format("{} is listed above already", result->file.string()),
                   "a result has one date: correct the file or take the table out");
        continue;
      }
      if (result->machine.empty()) result->machine = machine;
      found.results.push_back(*std::move(result));
    }
  }
  Diagnostics faults = document->finish();
  faults.insert(faults.end(), found.remarks.begin(), found.remarks.end());
  if (has_error(faults)) return faults;
  return found;
}

// Those of one machine; results that name none are of it where there is no other.
std::optional<Diagnostic> choose_machine(ResultFolder& found, const fs::path& folder,
                                         const std::string& wanted) {
  std::map<std::string, std::size_t> count;
  for (const DatedResult& each : found.results) ++count[each.machine];
  const std::size_t unnamed = count.contains("") ? count[""] : 0;
  count.erase("");
  std::string list;
  for (const auto& [name, number] : count) {
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", name, number);
  }
  if (wanted.empty() && count.size() > 1) {
    return at_file(folder,
                   error("several-machines"_id,
                         fmt::format("holds results of {} machines: {}", count.size(), list),
                         "choose one: --machine " + count.begin()->first));
  }
  if (!wanted.empty() && !count.contains(wanted)) {
    return at_file(folder,
                   error("unknown-machine"_id, fmt::format("no result of '{}' here", wanted),
                         list.empty() ? "no result here names a machine: leave --machine out"
                                      : "there are: " + list));
  }
  found.machine = !wanted.empty() ? wanted : count.empty() ? "" : count.begin()->first;
  if (unnamed > 0 && count.size() > 1) {
    return at_file(folder, error("unnamed-machine"_id,
                                 fmt::format("{} name no machine, and there are several: {}",
                                             counted(unnamed, "result"), list),
                                 "give each machine a folder of its own"));
  }
  if (unnamed > 0 && count.size() == 1) {
    found.remarks.push_back(at_file(
        folder, warning("unnamed-machine"_id,
                        fmt::format("{} without a machine's name: taken as of {}",
                                    counted(unnamed, "result"), found.machine),
                        "say machine = \"...\" in history.toml, or keep them in another folder")));
  }
  std::erase_if(found.results, [&](const DatedResult& each) {
    return !each.machine.empty() && each.machine != found.machine;
  });
  return std::nullopt;
}

}  // namespace

Result<ResultFolder> read_results(const fs::path& folder, const std::string& machine) {
  std::error_code ignored;
  const fs::path index = folder / kIndex;
  auto found = fs::exists(index, ignored) ? listed(index) : scanned(folder);
  if (!found) return found.error();
  if (auto fault = choose_machine(*found, folder, machine)) return *std::move(fault);
  if (found->results.empty()) {
    Diagnostics faults{at_file(
        folder, error("no-results"_id, "holds no result of run, measure, identify or motion",
                      "put result.json, or what --json printed, into it; each in a folder or a "
                      "file whose name has its date"))};
    faults.insert(faults.end(), found->remarks.begin(), found->remarks.end());
    return faults;
  }
  for (const DatedResult& each : found->results) {
    if (!each.values.empty() || !each.without_value.empty()) continue;
    found->remarks.push_back(
        at_file(each.file, warning("no-values"_id, "has no values that a history follows",
                                   "take it out of the folder if it is not meant to have some")));
  }
  std::ranges::stable_sort(found->results, [](const DatedResult& a, const DatedResult& b) {
    return std::tie(a.moment.day, a.state, a.file) < std::tie(b.moment.day, b.state, b.file);
  });
  return found;
}

}  // namespace frustum::app
