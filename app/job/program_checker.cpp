#include "app/job/program_checker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "app/job/collision_findings.hpp"
#include "app/job/program_files.hpp"
#include "core/whole_file.hpp"
#include "lint/program_check.hpp"
#include "lint/subprogram_text.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInput = "-";

fs::path program_folder(const std::string& file) {
  const fs::path folder = file == kInput ? fs::path() : fs::path(file).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

Severity level_of(const std::string& name) {
  if (name == "note") return Severity::note;
  return name == "warning" ? Severity::warning : Severity::error;
}

// Findings of subprograms, by their places.
using Told = std::set<std::tuple<std::string, lint::Check, std::uint32_t, std::uint32_t>>;

Told told_of(const lint::CheckReport& report) {
  Told told;
  for (const lint::Finding& finding : report.findings) {
    if (!report.opened.contains(finding.file)) continue;
    told.emplace(whole_name(finding.file), finding.check, finding.line, finding.column);
  }
  return told;
}

// What the run of a caller has told already.
void leave_out_told(lint::CheckedFile& subprogram, const Told& told) {
  const std::string file = whole_name(subprogram.file);
  std::erase_if(subprogram.report.findings, [&](const lint::Finding& finding) {
    return told.contains({file, finding.check, finding.line, finding.column});
  });
}

}  // namespace

ProgramChecker::ProgramChecker(CheckSettings command_line, bool without_files, Notes note)
    : command_line_(std::move(command_line)),
      without_files_(without_files),
      note_(std::move(note)) {}

void ProgramChecker::trouble(const Diagnostics& diagnostics) {
  troubles_.insert(troubles_.end(), diagnostics.begin(), diagnostics.end());
}

ProgramChecker::Shared* ProgramChecker::shared_in(const fs::path& folder) {
  std::error_code ignored;
  const fs::path whole = fs::absolute(folder, ignored).lexically_normal();
  const auto [at, fresh] = of_folders_.try_emplace(whole, nullptr);
  if (!fresh) return at->second;
  const fs::path file =
      without_files_ ? fs::path() : find_check_settings(whole).value_or(fs::path());
  const auto [same, unread] = of_files_.try_emplace(file);
  if (unread) {
    if (file.empty()) {
      same->second = read_shared(command_line_);
    } else if (const auto settings = read_check_settings(file)) {
      note_("settings of " + file.string());
      same->second = read_shared(joined(command_line_, *settings));
    } else {
      trouble(settings.error());
    }
  }
  at->second = same->second.get();
  return at->second;
}

std::unique_ptr<ProgramChecker::Shared> ProgramChecker::read_shared(const CheckSettings& settings) {
  auto shared = std::make_unique<Shared>();
  shared->settings = settings;
  const std::size_t before = troubles_.size();
  if (auto disabled = checks_named(settings.disabled, "--disable")) {
    shared->disabled = *std::move(disabled);
  } else {
    trouble(disabled.error());
  }
  if (auto known = known_setup_of(settings.setup_words)) {
    shared->known = *std::move(known);
  } else {
    trouble(known.error());
  }
  if (!settings.tools.empty()) {
    auto tools = parser::read_tool_table(settings.tools, settings.inch_machine
                                                             ? parser::LengthUnit::inch
                                                             : parser::LengthUnit::millimetre);
    if (tools) {
      shared->tools = *std::move(tools);
    } else {
      trouble(tools.error());
    }
  }
  if (!settings.setup_words.job.empty() && troubles_.size() == before) {
    auto job = load_job(settings.setup_words.job, {}, false);
    if (job) shared->job = *std::move(job);
  }
  if (troubles_.size() > before) return nullptr;
  return shared;
}

const CheckSettings* ProgramChecker::settings_in(const fs::path& folder) {
  const Shared* shared = shared_in(folder);
  return shared == nullptr ? nullptr : &shared->settings;
}

std::vector<ProgramToCheck> ProgramChecker::programs_of_path(const std::string& path) {
  std::error_code ignored;
  if (path == kInput || !fs::is_directory(path, ignored)) return {{path, false}};
  const CheckSettings* settings = settings_in(path);
  if (settings == nullptr) return {};
  const auto found = programs_in(
      path, {.endings = settings->endings, .excluded = [this](const fs::path& file) {
               const CheckSettings* own = settings_in(program_folder(file.string()));
               return own != nullptr && (is_excluded(file, own->exclude, own->file.parent_path()) ||
                                         is_same_file(file.string(), own->tools));
             }});
  trouble(found.troubles);
  if (found.files.empty() && found.excluded > 0) {
    note_(fmt::format("there is no program in {} but what the settings exclude", path));
  } else if (found.files.empty() && found.troubles.empty()) {
    Diagnostic none = error("no-program"_id, "there is no program in this folder",
                            "endings in .frustum.toml names further endings of programs");
    none.file = path;
    trouble({none});
  }
  std::vector<ProgramToCheck> programs;
  for (const std::string& file : found.files) programs.push_back({file, true});
  return programs;
}

std::vector<ProgramToCheck> ProgramChecker::programs_of(const std::vector<std::string>& paths) {
  std::vector<ProgramToCheck> programs;
  std::map<std::string, std::size_t> known;
  for (const std::string& path : paths) {
    for (ProgramToCheck& program : programs_of_path(path)) {
      const auto [at, fresh] = known.try_emplace(whole_name(program.file), programs.size());
      if (fresh) {
        programs.push_back(std::move(program));
      } else if (!program.of_folder) {
        programs[at->second].of_folder = false;
      }
    }
  }
  if (!paths.empty()) return programs;
  if (auto program = program_of_job()) programs.push_back({*std::move(program), false});
  return programs;
}

std::vector<lint::CheckedFile> ProgramChecker::check(const std::vector<ProgramToCheck>& programs) {
  const bool alone = programs.size() == 1;
  std::vector<std::optional<lint::CheckedFile>> found;
  std::map<std::string, std::set<std::size_t>> callers;  // of each file that was opened
  for (const ProgramToCheck& program : programs) {
    found.push_back(check(program, alone, false));
    if (!found.back()) continue;
    for (const std::string& opened : found.back()->report.opened) {
      callers[whole_name(opened)].insert(found.size() - 1);
    }
  }
  // Files are moved from one list to the other as they are finished.
  std::vector<Told> reports;
  for (const auto& each : found) reports.push_back(each ? told_of(each->report) : Told());
  std::vector<lint::CheckedFile> checked;
  std::size_t subprograms = 0;
  for (std::size_t i = 0; i < programs.size(); ++i) {
    if (!found[i]) continue;
    const auto of = callers.find(whole_name(programs[i].file));
    const bool called = of != callers.end() && (of->second.size() > 1 || !of->second.contains(i));
    if (called && programs[i].of_folder && !found[i]->subprogram) {
      found[i] = check(programs[i], alone, true);
    }
    if (!found[i]) continue;
    if (called && found[i]->subprogram) {
      for (const std::size_t caller : of->second) {
        if (caller != i) leave_out_told(*found[i], reports[caller]);
      }
    }
    subprograms += found[i]->subprogram ? 1 : 0;
    checked.push_back(*std::move(found[i]));
  }
  if (subprograms > 0) {
    note_(fmt::format("{} {} checked by what holds without a caller", subprograms,
                      subprograms == 1 ? "subprogram is" : "subprograms are"));
  }
  return checked;
}

lint::CheckOptions ProgramChecker::options_of(const Shared& shared, const std::string& file) const {
  const CheckSettings& settings = shared.settings;
  lint::CheckOptions options;
  options.disabled = shared.disabled;
  options.run = options_for(file);
  options.run.search_path.insert(options.run.search_path.end(), settings.search.begin(),
                                 settings.search.end());
  options.run.block_delete = settings.block_delete;
  options.run.start = shared.known.start;
  options.run.control = shared.known.control;
  options.run.tools = shared.tools ? *shared.tools : shared.known.tools;
  if (settings.inch_machine) options.run.machine_unit = parser::LengthUnit::inch;
  if (shared.known.machine) options.machine = &*shared.known.machine;
  options.setup = shared.known.setup;
  options.home = shared.known.home;
  options.decimal_point_is_known = shared.known.decimal_point_is_known;
  if (settings.most_repeats) options.most_repeats = *settings.most_repeats;
  if (!settings.baseline.empty()) {
    options.most_places = std::numeric_limits<std::size_t>::max();
  }
  return options;
}

// The job with this program, read and set up as the checks read it.
Job ProgramChecker::job_of(const Shared& shared, const NcFile& nc) {
  Job job = *shared.job;
  job.machine = *shared.known.machine;
  programs::TestPiece& piece = job.piece;
  piece.program = text_of_program(nc.program.text);
  piece.program_file = nc.program.file;
  piece.dialect = nc.program.dialect;
  const auto& search = shared.settings.search;
  piece.reading = {
      {search.begin(), search.end()}, shared.settings.block_delete, shared.known.control};
  piece.work_offsets = shared.known.setup.work_offsets;
  for (auto& [number, tool] : piece.tools) {
    const auto own = shared.known.setup.tools.find(number);
    if (own != shared.known.setup.tools.end()) tool.length.value = own->second.length;
  }
  return job;
}

// A job is of one program: its own, or the only one that is checked by it.
void ProgramChecker::look_into_stock(const Shared& shared, const NcFile& nc,
                                     lint::CheckOptions& options) {
  if (!shared.job || (options.disabled.contains(lint::Check::rapid_in_material) &&
                      options.disabled.contains(lint::Check::body_in_material) &&
                      options.disabled.contains(lint::Check::machine_collision))) {
    return;
  }
  options.look_further = [this, &shared, &nc] {
    auto found = collisions_of(job_of(shared, nc));
    if (found) return *std::move(found);
    trouble(found.error());
    return std::vector<lint::Finding>();
  };
}

std::optional<lint::CheckedFile> ProgramChecker::check(const ProgramToCheck& program, bool alone,
                                                       bool subprogram) {
  const std::string& file = program.file;
  const Shared* shared = shared_in(program_folder(file));
  if (shared == nullptr) return std::nullopt;
  std::error_code unlike;
  const bool of_job = shared->job && fs::equivalent(file, shared->job->piece.program_file, unlike);
  std::string dialect = shared->settings.dialect;
  if (dialect.empty() && of_job) dialect = name_of(shared->job->piece.dialect);
  const auto nc = open_nc(file, dialect);
  if (!nc) {
    trouble(nc.error());
    return std::nullopt;
  }
  if (alone && !nc->reason.empty()) {
    note_(fmt::format("read as {} ({})", name_of(nc->program.dialect), nc->reason));
  }
  if (alone && !shared->known.machine) note_("no --machine: travels and axes are not checked");
  lint::CheckOptions options = options_of(*shared, file);
  options.subprogram = subprogram || (program.of_folder && lint::is_subprogram(nc->program));
  if (shared->job && (alone || of_job)) look_into_stock(*shared, *nc, options);
  lint::CheckedFile checked;
  checked.file = nc->program.file;
  checked.dialect = name_of(nc->program.dialect);
  if (shared->known.machine) checked.machine = shared->known.machine->name();
  checked.report = lint::check_program(nc->program, options);
  checked.lines = lint::source_lines(nc->program, checked.report.findings);
  checked.subprogram = options.subprogram;
  return checked;
}

void ProgramChecker::apply_baselines(std::vector<lint::CheckedFile>& checked) {
  std::map<std::string, std::optional<lint::Baseline>> baselines;
  for (lint::CheckedFile& each : checked) {
    const Shared* shared = shared_in(program_folder(each.file));
    if (shared == nullptr || shared->settings.baseline.empty()) continue;
    const std::string& file = shared->settings.baseline;
    const auto [at, fresh] = baselines.try_emplace(file);
    if (fresh) {
      auto read = lint::Baseline::read(file);
      if (read) {
        at->second = *std::move(read);
      } else {
        trouble(read.error());
      }
    }
    if (at->second) at->second->apply(each);
  }
  for (const auto& [file, baseline] : baselines) {
    const std::size_t gone = baseline ? baseline->gone() : 0;
    if (gone == 0) continue;
    note_(fmt::format("{} {} of {} {} gone: write it anew by --write-baseline", gone,
                      gone == 1 ? "finding" : "findings", file, gone == 1 ? "is" : "are"));
  }
}

std::vector<std::string> ProgramChecker::write_baselines(
    const std::vector<lint::CheckedFile>& checked) {
  std::map<std::string, std::vector<const lint::CheckedFile*>> of_baselines;
  for (const lint::CheckedFile& each : checked) {
    const Shared* shared = shared_in(program_folder(each.file));
    if (shared != nullptr && !shared->settings.baseline.empty()) {
      of_baselines[shared->settings.baseline].push_back(&each);
    }
  }
  if (of_baselines.empty() && !command_line_.baseline.empty()) {
    of_baselines[command_line_.baseline] = {};
  }
  std::vector<std::string> written;
  for (const auto& [file, files] : of_baselines) {
    const auto done = write_whole_file(file, lint::Baseline::text_of(files, file));
    if (done) {
      written.push_back(file);
    } else {
      trouble(done.error());
    }
  }
  if (of_baselines.empty()) {
    trouble({error("missing-option"_id, "there is no file to write the baseline to",
                   "name it by --baseline FILE, or baseline in .frustum.toml")});
  }
  return written;
}

bool ProgramChecker::passes(const lint::CheckedFile& checked) {
  const CheckSettings* settings = settings_in(program_folder(checked.file));
  const Severity level = level_of(settings == nullptr ? "" : settings->fail_on);
  return std::ranges::none_of(checked.report.findings, [level](const lint::Finding& finding) {
    return finding.suppressed == lint::Suppressed::no && finding.severity >= level;
  });
}

std::set<std::string> ProgramChecker::baselines_of(const std::vector<ProgramToCheck>& programs) {
  std::set<std::string> files;
  if (!command_line_.baseline.empty()) files.insert(command_line_.baseline);
  for (const ProgramToCheck& program : programs) {
    const CheckSettings* settings = settings_in(program_folder(program.file));
    if (settings != nullptr && !settings->baseline.empty()) files.insert(settings->baseline);
  }
  return files;
}

bool ProgramChecker::reads(const std::string& file, const std::vector<ProgramToCheck>& programs) {
  const auto is_it = [&file](const std::string& read) { return is_same_file(file, read); };
  return std::ranges::any_of(programs, [&](const ProgramToCheck& program) {
    if (is_it(program.file)) return true;
    const CheckSettings* own = settings_in(program_folder(program.file));
    return own != nullptr && (is_it(own->file.string()) || is_it(own->tools) ||
                              is_it(own->setup_words.job) || is_it(own->setup_words.machine));
  });
}

std::optional<std::string> ProgramChecker::program_of_job() {
  if (command_line_.setup_words.job.empty()) return std::nullopt;
  const Shared* shared = shared_in(".");
  if (shared == nullptr || !shared->job) return std::nullopt;
  return shared->job->piece.program_file;
}

}  // namespace frustum::app
