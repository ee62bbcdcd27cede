#include "app/study/study_file.hpp"

#include <fmt/format.h>

#include <limits>

#include "app/job/axis_words.hpp"
#include "app/job/machine_files.hpp"
#include "app/study/study_tables.hpp"
#include "core/spelling.hpp"
#include "core/toml_document.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using studies::EngineKind;

constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 32U;

void append_all(Diagnostics& all, const Diagnostics& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// What the file is, when it is no study of a population.
std::optional<Diagnostic> other_kind_of_file(const TomlTable& root, const fs::path& file) {
  std::optional<Diagnostic> other;
  if (root.has("part")) {
    other = error("not-a-study"_id, "this is a study of measured parts, not of a population",
                  "frustum identify reads it; a study of a population names a job: job = "
                  "\"job.toml\"");
  } else if (!root.has("job") && !root.has("target") && !root.has("motion")) {
    const bool is_test = root.has("test");
    other = error(
        "not-a-study"_id,
        is_test ? "this is a motion test, not a study"
                : "this is no study: it names neither a job nor a motion test nor a target",
        is_test ? "a study names it: motion = \"" + file.filename().string() + "\""
                : "write job = \"job.toml\", motion = \"test.toml\" or target = \"volumetric\"; a "
                  "job alone is a study too");
  }
  if (other) other->file = file.string();
  return other;
}

bool is_job(const TomlTable& root) { return root.has("program") && root.has("machine"); }

std::optional<VolumetricTarget> read_volumetric(const TomlTable& root) {
  const std::string name = root.text("machine");
  const std::string axes = root.text_or("axes", "");
  const double tool_length = root.length_or("tool_length", {}, Bound::non_negative).value;
  if (name.empty()) return std::nullopt;  // which text() has reported
  const auto file = find_machine(name, root.folder());
  if (!file) {
    root.fail("machine", file.error().front());
    return std::nullopt;
  }
  auto machine = kinematics::Machine::load(*file);
  if (!machine) {
    root.fail("machine", machine.error().front());
    return std::nullopt;
  }
  const auto words = read_axis_words(*machine, axes);
  if (!words) {
    root.fail("axes", words.error().front());
    return std::nullopt;
  }
  VolumetricTarget target{*std::move(machine), *file, axes, {}, tool_length};
  target.at = target.machine.home();
  for (const auto& [letter, value] : *words) target.at[letter] = value;
  return target;
}

// The machine of the test, without the errors of the file: those of the study are drawn.
Result<MotionTarget> load_motion(const fs::path& file) {
  auto read = read_test_file(file);
  if (!read) return read.error();
  MotionWords& common = common_words(read->words);
  MotionTarget target{.file = file, .machine_file = common.machine, .errors = common.of_file};
  common.of_file = {};
  auto setup = motion_setup(common);
  if (!setup) return in_test_file(*read, setup.error());
  target.setup = std::make_shared<const MotionSetup>(*std::move(setup));
  auto test = drawn_test(read->words, *target.setup);
  if (!test) return in_test_file(*read, test.error());
  target.test = *std::move(test);
  return target;
}

std::vector<StudyCharacteristic> characteristics_of_test(const DrawnTest& test) {
  std::vector<StudyCharacteristic> all;
  for (const TestValue& value : test.values) {
    all.push_back({value.name, value.angular, value.both_sides, std::nullopt});
  }
  return all;
}

// Noted, unless it is said already that there is no text.
bool is_empty(const TomlTable& root, const char* key) {
  const bool was_sound = root.is_sound();
  if (!root.text(key).empty()) return false;
  if (root.is_sound() == was_sound) {
    root.fail(key, "no-file"_id, "names no file", "for example motion = \"circle.toml\"");
  }
  return true;
}

// The job, test or target of the file; what they cannot be made of is noted.
void read_target(const TomlTable& root, StudyFile& study, Diagnostics& problems) {
  if (root.has("job") + root.has("target") + root.has("motion") > 1) {
    root.fail(root.has("target") ? "target" : "motion", "given-twice"_id,
              "a study has a job, a motion test or a target", "leave the others out");
  }
  if (root.has("target")) {
    (void)root.choice("target", {std::string("volumetric")});
    study.volumetric = read_volumetric(root);
    if (study.volumetric) {
      study.characteristics = {{.name = std::string(kVolumetricError), .limit = std::nullopt}};
    }
    return;
  }
  if (root.has("motion")) {
    if (is_empty(root, "motion")) return;
    auto motion = load_motion(root.file_path("motion"));
    if (!motion) return append_all(problems, motion.error());
    study.characteristics = characteristics_of_test(motion->test);
    study.motion = *std::move(motion);
    return;
  }
  if (is_empty(root, "job")) return;
  auto job = load_job(root.file_path("job"), {.undrawn = true}, true);
  if (!job) return append_all(problems, job.error());
  study.characteristics = characteristics_of(job->piece.plan);
  study.job = *std::move(job);
}

std::uint64_t read_samples(const TomlTable& root, std::uint64_t otherwise) {
  const std::int64_t samples =
      root.integer_or("samples", static_cast<std::int64_t>(otherwise), Bound::positive);
  if (samples > static_cast<std::int64_t>(kMostSamples)) {
    root.fail("samples", "out-of-range"_id,
              fmt::format("must be at most {}, is {}", kMostSamples, samples));
  }
  return samples > 0 ? static_cast<std::uint64_t>(samples) : 1;
}

void read_head(const TomlTable& root, StudyFile& study) {
  study.title = root.text_or("title", "");
  study.samples = read_samples(root, study.samples);
  study.seed = static_cast<std::uint64_t>(root.integer_or("seed", 1, Bound::non_negative));
  study.scheme =
      static_cast<studies::SchemeKind>(root.choice_or("scheme", {"random", "latin", "sobol"}, 0));
  study.engine = static_cast<EngineKind>(root.choice_or("engine", {"auto", "linear", "full"}, 0));
  const std::vector<std::string> kinds{"characteristics", "amounts", "points"};
  for (const std::string& kept : root.texts_or("keep", {"characteristics"})) {
    study.keep_amounts = study.keep_amounts || kept == kinds[1];
    study.keep_points = study.keep_points || kept == kinds[2];
    if (std::ranges::find(kinds, kept) == kinds.end()) {
      root.fail("keep", "unknown-word"_id, fmt::format("'{}' cannot be kept", kept),
                suggestion(kept, kinds));
    }
  }
}

Diagnostic unknown_option_word(const std::string& option, const std::string& word,
                               const std::vector<std::string>& known) {
  return error("unknown-word"_id, fmt::format("{} '{}' is not known", option, word),
               suggestion(word, known));
}

// A word of the command line that must be one of several.
template <typename Kind>
void choose(const std::string& option, const std::string& word,
            const std::vector<std::string>& known, Kind& choice, Diagnostics& problems) {
  if (word.empty()) return;
  const auto found = std::ranges::find(known, word);
  if (found != known.end()) {
    choice = static_cast<Kind>(found - known.begin());
    return;
  }
  problems.push_back(unknown_option_word(option, word, known));
}

void take_words(const StudyWords& words, StudyFile& study, Diagnostics& problems) {
  if (words.samples) {
    if (*words.samples == 0 || *words.samples > kMostSamples) {
      problems.push_back(error("out-of-range"_id, fmt::format("--samples {}: expected 1 .. {}",
                                                              *words.samples, kMostSamples)));
    }
    study.samples = std::max<std::uint64_t>(*words.samples, 1);
  }
  if (words.seed) study.seed = *words.seed;
  choose("--scheme", words.scheme, {"random", "latin", "sobol"}, study.scheme, problems);
  choose("--engine", words.engine, {"auto", "linear", "full"}, study.engine, problems);
  for (const std::string& text : words.stop) {
    const std::size_t equal = text.rfind('=');
    if (equal == std::string::npos) {
      problems.push_back(error("stop-rule"_id, fmt::format("--stop \"{}\" has no width", text),
                               "write --stop \"cone.form q50=0.05um\""));
      continue;
    }
    const auto rule =
        parse_stop_rule(text.substr(0, equal), text.substr(equal + 1), study.characteristics);
    if (!rule) {
      append_all(problems, rule.error());
      continue;
    }
    std::erase_if(study.questions.stop,
                  [&](const StopRule& other) { return other.written == rule->written; });
    study.questions.stop.push_back(*rule);
  }
}

// The study's own errors replace those of the job; the command line adds to them.
void read_study_errors(const std::optional<TomlTable>& table, const StudyWords& words,
                       StudyFile& study, Diagnostics& problems) {
  study.error_files = error_files_of(words.errors);
  kinematics::ErrorList list;
  if (table) {
    list = kinematics::read_errors(*table, find_error_file);
    for (const kinematics::ErrorEntry& e : list.entries) {
      if (!table->has(e.name)) continue;
      const Diagnostics unfit = kinematics::unfit_shapes(study.machine(), e);
      const auto unknown = kinematics::unknown_error(study.machine(), e.name);
      if (unknown) table->fail(e.name, *unknown);
      for (const Diagnostic& problem : unfit) table->fail(e.name, problem);
    }
  } else if (study.job) {
    list.entries = study.job->errors;
  } else if (study.motion) {
    list = study.motion->errors;
  }
  study.errors = list.entries;  // what else is wrong is told beside a bad word of the command line
  auto gathered = gather_errors(std::move(list), words.errors, std::nullopt, study.machine());
  if (gathered) {
    study.errors = *std::move(gathered);
    for (const kinematics::ErrorEntry& e : study.errors) {  // of files and of the command line
      if (!table || !table->has(e.name)) {
        append_all(problems, kinematics::unfit_shapes(study.machine(), e));
      }
    }
  } else {
    append_all(problems, gathered.error());
  }
}

// Keys that cannot be judged without a job are known all the same.
void pass_over(const TomlTable& root) {
  for (const char* key : {"title", "samples", "seed", "scheme", "engine", "keep", "errors",
                          "tolerances", "correlated", "limits", "measurement", "stop", "risk",
                          "shares", "allocate", "map", "machine", "axes", "tool_length"}) {
    (void)root.has(key);
  }
}

}  // namespace

Result<StudyFile> load_study_file(const fs::path& file, const StudyWords& words) {
  auto document = TomlDocument::load(file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  StudyFile study;
  study.file = file;
  Diagnostics problems;
  if (is_job(root) && !root.has("job")) {
    auto job = load_job(file, {.undrawn = true}, true);
    if (!job) return job.error();
    study.title = job->piece.title;
    study.characteristics = characteristics_of(job->piece.plan);
    study.job = *std::move(job);
    take_words(words, study, problems);
    read_study_errors(std::nullopt, words, study, problems);
    if (has_error(problems)) return problems;
    return study;
  }
  if (auto other = other_kind_of_file(root, file)) return *other;
  read_target(root, study, problems);
  if (!study.job && !study.volumetric && !study.motion) {
    pass_over(root);
    Diagnostics all = document->finish();
    append_all(all, problems);
    return all;
  }
  read_head(root, study);
  read_study_errors(root.table_if("errors"), words, study, problems);
  read_study_tables(root, study);
  take_words(words, study, problems);
  Diagnostics all = document->finish();
  append_all(all, problems);
  if (has_error(all)) return all;
  if (study.title.empty()) {
    study.title = study.job      ? study.job->piece.title
                  : study.motion ? study.motion->file.stem().string()
                                 : study.machine().title();
  }
  return study;
}

}  // namespace frustum::app
