#include "app/benchmark/benchmark_score.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/counted.hpp"
#include "core/csv.hpp"
#include "core/printable_text.hpp"
#include "core/program_version.hpp"
#include "core/text_words.hpp"
#include "core/whole_file.hpp"
#include "studies/statistics/forecast_score.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using studies::Forecast;
using Values = std::map<std::string, double>;

constexpr double kMissingCounts = 10.0;

struct Answers {
  Values points{}, poses{}, errors{};
};

Result<Answers> read_answers(const fs::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  const auto wrong = [&](std::string what) {
    Diagnostic failure =
        error("benchmark-answers"_id, std::move(what), "frustum benchmark make writes such files");
    failure.file = file.string();
    return failure;
  };
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (json.is_discarded() || !json.is_object()) return wrong("this is no JSON object");
  Answers answers;
  for (const auto& [key, values] : {std::pair<const char*, Values*>{"points", &answers.points},
                                    {"poses", &answers.poses},
                                    {"errors", &answers.errors}}) {
    if (!json.contains(key)) continue;
    if (!json[key].is_object()) return wrong(fmt::format("\"{}\" is no object", key));
    for (const auto& [id, value] : json[key].items()) {
      if (!value.is_number()) return wrong(fmt::format("{}.{} is no number", key, id));
      values->emplace(id, value.get<double>());
    }
  }
  return answers;
}

Result<Values> read_prior(const fs::path& file) {
  const auto table = CsvTable::load(file, {"id", "sd"});
  if (!table) return table.error();
  Values prior;
  for (const CsvRow& row : table->rows()) {
    const auto sd = table->number(row, 1);
    if (!sd) return sd.error();
    if (!(*sd > 0.0)) {
      return table->about(row, 1, "out-of-range"_id,
                          fmt::format("a standard deviation of {:g}: it must be above 0", *sd));
    }
    prior[row.fields[0].text] = *sd;
  }
  return prior;
}

// A number of a submission: nothing where it is none or not finite.
std::optional<double> number_of(const CsvRow& row, std::size_t column) {
  return finite_number_in_word(row.fields.at(column).text);
}

bool is_not_finite(const std::string& text) {
  const auto value = number_in_word<double>(text);
  return text.empty() || (value && !std::isfinite(*value));
}

class SubmissionRows {
 public:
  SubmissionRows(const CsvTable& table, MachineScore& score) : table_(table), score_(score) {}

  // One row: its id must be asked for.
  std::optional<Diagnostic> add(const CsvRow& row, bool is_asked, const char* what) {
    const std::string& id = row.fields[0].text;
    if (!is_asked) {
      return table_.about(row, 0, "unknown-id"_id,
                          fmt::format("nobody asked for {} '{}'", what, printable(id)),
                          "questions.csv and prior.csv have all of them");
    }
    if (seen_.contains(id)) {
      return table_.about(row, 0, "given-twice"_id,
                          fmt::format("{} '{}' is there twice", what, printable(id)));
    }
    seen_.emplace(id, std::nullopt);
    if (const auto sd = number_of(row, 2); sd && !(*sd > 0.0)) {
      return table_.about(row, 2, "out-of-range"_id,
                          fmt::format("a standard deviation of {:g}: it must be above 0", *sd),
                          "say how sure the prediction is; nothing is exact");
    }
    for (const std::size_t column : {std::size_t{1}, std::size_t{2}}) {
      if (const auto number = number_of(row, column)) {
        // Beyond it sums of squares would be no numbers any more.
        constexpr double kMost = 1e9, kLeastSd = 1e-9;
        if (std::abs(*number) <= kMost && (column == 1 || *number >= kLeastSd)) continue;
        return table_.about(row, column, "out-of-range"_id,
                            fmt::format("{:g} is no prediction", *number),
                            fmt::format("means within {:g}, standard deviations from {:g} to {:g}",
                                        kMost, kLeastSd, kMost));
      }
      if (!is_not_finite(row.fields[column].text)) {
        return table_.about(row, column, "csv"_id,
                            fmt::format("'{}' is no number", printable(row.fields[column].text)));
      }
      Diagnostic note = table_.about(
          row, column, "not-finite"_id,
          fmt::format("'{}' is not finite: the row counts ten times the prior's score", id));
      note.severity = Severity::warning;
      score_.notes.push_back(std::move(note));
      return std::nullopt;
    }
    seen_[id] = Forecast{*number_of(row, 1), *number_of(row, 2)};
    return std::nullopt;
  }

  // Names what has no row at all.
  void note_missing(const fs::path& file, const char* what, const std::vector<const Values*>& all) {
    std::vector<std::string> missing;
    for (const Values* values : all) {
      for (const auto& [id, value] : *values) {
        if (!seen_.contains(id)) missing.push_back(id);
      }
    }
    if (missing.empty()) return;
    constexpr std::size_t kNamed = 5;
    const std::size_t count = missing.size();
    missing.resize(std::min(count, kNamed));
    Diagnostic note = warning("row-missing"_id,
                              fmt::format("{} without a row: {}{}", counted(count, what),
                                          fmt::join(missing, ", "), count > kNamed ? ", .." : ""),
                              "each counts ten times the prior's score");
    note.file = file.string();
    score_.notes.push_back(std::move(note));
  }

  [[nodiscard]] const std::map<std::string, std::optional<Forecast>>& forecasts() const {
    return seen_;
  }

 private:
  const CsvTable& table_;
  MachineScore& score_;
  std::map<std::string, std::optional<Forecast>> seen_{};
};

// `unit`: the prior's sd counts as 1.
Result<KindScore> scored(const Values& truths, const Values& prior,
                         const std::map<std::string, std::optional<Forecast>>& forecasts,
                         bool in_prior_units, const fs::path& prior_file) {
  KindScore score;
  score.n = truths.size();
  double all = 0.0, expected = 0.0;
  double crps = 0.0, squares = 0.0, covered = 0.0, interval = 0.0, log = 0.0, within = 0.0;
  std::size_t predicted = 0;
  for (const auto& [id, value] : truths) {
    const auto law = prior.find(id);
    if (law == prior.end()) {
      Diagnostic failure =
          error("benchmark-prior"_id, fmt::format("there is no prior of '{}'", id));
      failure.file = prior_file.string();
      return failure;
    }
    const double unit = in_prior_units ? law->second : 1.0;
    const double sd = law->second / unit, truth = value / unit;
    expected += studies::expected_crps(sd);
    const auto found = forecasts.find(id);
    if (found == forecasts.end() || !found->second) {
      ++score.missing;
      all += kMissingCounts * studies::expected_crps(sd);
      continue;
    }
    const Forecast forecast{found->second->mean / unit, found->second->sd / unit};
    const double own = studies::crps(forecast, truth);
    const double off = std::abs(truth - forecast.mean);
    all += own;
    crps += own;
    squares += off * off;
    covered += off <= studies::kTwoSided95 * forecast.sd ? 1.0 : 0.0;
    within += off <= 2.0 * forecast.sd ? 1.0 : 0.0;
    interval += studies::interval_score_95(forecast, truth);
    log += studies::log_score(forecast, truth);
    ++predicted;
  }
  if (score.n > 0) score.skill = 1.0 - all / expected;
  if (predicted == 0) return score;
  const auto count = static_cast<double>(predicted);
  score.crps = crps / count;
  score.rmse = std::sqrt(squares / count);
  score.coverage_95 = covered / count;
  score.interval_score_95 = interval / count;
  score.log_score = log / count;
  score.within_2sd = within / count;
  return score;
}

Result<MachineScore> score_machine(const std::string& id, const fs::path& benchmark,
                                   const fs::path& submission) {
  const auto answers = read_answers(benchmark / "answers" / (id + ".json"));
  if (!answers) return answers.error();
  const fs::path prior_file = benchmark / "prior" / (id + ".csv");
  const auto prior = read_prior(prior_file);
  if (!prior) return prior.error();
  MachineScore score{.id = id};
  const auto predictions =
      CsvTable::load(submission / id / "predictions.csv", {"id", "mean_um", "sd_um"});
  if (!predictions) return predictions.error();
  SubmissionRows asked(*predictions, score);
  for (const CsvRow& row : predictions->rows()) {
    const std::string& name = row.fields[0].text;
    const bool is_asked = answers->points.contains(name) || answers->poses.contains(name);
    if (auto fault = asked.add(row, is_asked, "question")) return *fault;
  }
  asked.note_missing(submission / id / "predictions.csv", "question",
                     {&answers->points, &answers->poses});
  const auto errors =
      CsvTable::load(submission / id / "errors.csv", {"name", "mean", "sd", "unit"});
  if (!errors) return errors.error();
  // Answers may be scored where the machines are not.
  std::map<std::string, std::string> units;
  const fs::path laws_file = benchmark / "machines" / id / "laws.csv";
  if (std::error_code failure; fs::exists(laws_file, failure)) {
    const auto laws = CsvTable::load(laws_file, {"name", "unit", "mean", "sd"});
    if (!laws) return laws.error();
    for (const CsvRow& row : laws->rows()) units[row.fields[0].text] = row.fields[1].text;
  }
  SubmissionRows named(*errors, score);
  for (const CsvRow& row : errors->rows()) {
    constexpr std::array<std::string_view, 3> kUnits{"um", "urad", "1/s"};
    const std::string& unit = row.fields[3].text;
    if (std::ranges::find(kUnits, std::string_view(unit)) == kUnits.end()) {
      return errors->about(row, 3, "wrong-unit"_id,
                           fmt::format("'{}' is no unit of an error", printable(unit)),
                           "um, urad or 1/s, as in errors of the machine's laws");
    }
    const auto law = units.find(row.fields[0].text);
    if (law != units.end() && law->second != unit) {
      return errors->about(row, 3, "wrong-unit"_id,
                           fmt::format("'{}' is not the unit of {}", printable(unit), law->first),
                           fmt::format("{}, as in the machine's laws.csv", law->second));
    }
    const bool is_asked = answers->errors.contains(row.fields[0].text);
    if (auto fault = named.add(row, is_asked, "error")) return *fault;
  }
  named.note_missing(submission / id / "errors.csv", "error", {&answers->errors});
  auto points = scored(answers->points, *prior, asked.forecasts(), false, prior_file);
  if (!points) return points.error();
  auto poses = scored(answers->poses, *prior, asked.forecasts(), false, prior_file);
  if (!poses) return poses.error();
  auto of_errors = scored(answers->errors, *prior, named.forecasts(), true, prior_file);
  if (!of_errors) return of_errors.error();
  score.points = *points;
  score.poses = *poses;
  score.errors = *of_errors;
  return score;
}

ordered_json kind_json(const KindScore& score) {
  const auto value = [](const std::optional<double>& v) -> ordered_json {
    return v && std::isfinite(*v) ? ordered_json(*v) : ordered_json(nullptr);
  };
  return {{"n", score.n},
          {"missing", score.missing},
          {"skill", value(score.skill)},
          {"crps", value(score.crps)},
          {"rmse", value(score.rmse)},
          {"coverage_95", value(score.coverage_95)},
          {"interval_score_95", value(score.interval_score_95)},
          {"log_score", value(score.log_score)},
          {"within_2sd", value(score.within_2sd)}};
}

std::string kind_text(const char* name, const KindScore& s) {
  if (s.n == 0) return "";
  const auto value = [](const std::optional<double>& v) {
    return v ? fmt::format("{:>9.4f}", *v) : std::string("        -");
  };
  return fmt::format("  {:<7} {:>5} {:>7} {} {} {} {} {} {} {}\n", name, s.n, s.missing,
                     value(s.skill), value(s.crps), value(s.rmse), value(s.coverage_95),
                     value(s.interval_score_95), value(s.log_score), value(s.within_2sd));
}

// What everybody who ranks has to read: what was used, and how.
std::optional<Diagnostic> method_missing(const fs::path& benchmark, const fs::path& submission) {
  const fs::path file = submission / "method.md";
  const auto text = read_whole_file(file);
  if (text && text->find_first_not_of(" \t\r\n") != std::string::npos) return std::nullopt;
  Diagnostic problem =
      error("benchmark-method"_id, text ? "the method is not described" : "there is no method.md",
            "write there which data were used (cone, steps, s-piece, motion or all) and how, as "
            "rules.md asks");
  problem.file = file.string();
  // What is tried out elsewhere is scored all the same.
  std::error_code failure;
  const fs::path folder = fs::absolute(submission / "..", failure);
  if (!fs::equivalent(folder, benchmark / "submissions", failure)) {
    problem.severity = Severity::warning;
  }
  return problem;
}

// What is not scored: machines without a folder, and what is in the submission beside them.
Diagnostics passed_over(const fs::path& submission, const std::vector<std::string>& ids) {
  Diagnostics remarks;
  const auto remark = [&](const std::string& name, std::string what) {
    remarks.push_back(warning("not-scored"_id, std::move(what)));
    remarks.back().file = (submission / name).string();
  };
  std::error_code failure;
  std::vector<std::string> missing, other;
  for (const std::string& id : ids) {
    if (!fs::is_directory(submission / id, failure)) missing.push_back(id);
  }
  for (fs::directory_iterator at(submission, failure), end; !failure && at != end;
       at.increment(failure)) {
    const std::string name = at->path().filename().string();
    if (name != "method.md" && std::ranges::find(ids, name) == ids.end()) other.push_back(name);
  }
  std::ranges::sort(other);
  for (const std::string& name : other) {
    remark(name, "no machine whose answers are known: it is not scored");
  }
  if (!missing.empty()) {
    remark("", fmt::format("{} whose answers are known is not in it: {}",
                           counted(missing.size(), "machine"), fmt::join(missing, ", ")));
  }
  return remarks;
}

}  // namespace

Result<std::vector<MachineScore>> score_submission(const fs::path& benchmark,
                                                   const fs::path& submission) {
  std::vector<std::string> ids;
  std::error_code failure;
  for (fs::directory_iterator at(benchmark / "answers", failure), end; !failure && at != end;
       at.increment(failure)) {
    if (at->path().extension() == ".json") ids.push_back(at->path().stem().string());
  }
  if (failure || ids.empty()) {
    return error("benchmark-answers"_id,
                 fmt::format("{} has no answers", (benchmark / "answers").string()),
                 "a benchmark's folder has answers/mNN.json of the machines that are revealed");
  }
  std::ranges::sort(ids);
  const auto unsaid = method_missing(benchmark, submission);
  if (unsaid && unsaid->severity == Severity::error) return *unsaid;
  std::vector<MachineScore> scores;
  for (const std::string& id : ids) {
    if (!fs::is_directory(submission / id, failure)) continue;
    auto score = score_machine(id, benchmark, submission);
    if (!score) return std::move(score).error();
    scores.push_back(*std::move(score));
  }
  if (scores.empty()) {
    return error(
        "benchmark-submission"_id,
        fmt::format("{} has no folder of a machine whose answers are known", submission.string()),
        fmt::format("for example {}/predictions.csv and errors.csv",
                    (submission / ids.front()).string()));
  }
  auto& remarks = scores.front().notes;
  for (const Diagnostic& each : passed_over(submission, ids)) {
    remarks.insert(remarks.begin(), each);
  }
  if (unsaid) scores.front().notes.insert(scores.front().notes.begin(), *unsaid);
  return scores;
}

std::string score_json(const std::vector<MachineScore>& scores) {
  ordered_json json{{"schema", "frustum/benchmark/1"},
                    {"version", program_version()},
                    {"machines", ordered_json::array()}};
  for (const MachineScore& score : scores) {
    json["machines"].push_back({{"id", score.id},
                                {"points", kind_json(score.points)},
                                {"poses", kind_json(score.poses)},
                                {"errors", kind_json(score.errors)}});
  }
  return json.dump(2) + "\n";
}

std::string score_text(const std::vector<MachineScore>& scores) {
  std::string text =
      "              n missing     skill      CRPS      RMSE  covered  interval       log   "
      "in 2 sd\n";
  for (const MachineScore& score : scores) {
    text += score.id + "\n" + kind_text("points", score.points) + kind_text("poses", score.poses) +
            kind_text("errors", score.errors);
  }
  return text;
}

}  // namespace frustum::app
