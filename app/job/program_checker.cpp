#include "app/job/program_checker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/job/collision_findings.hpp"
#include "app/job/program_files.hpp"
#include "core/whole_file.hpp"
#include "lint/program_check.hpp"

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

std::string text_of_program(const parser::ProgramText& text) {
  std::string all;
  parser::LineReader lines(text);
  while (!lines.at_end()) {
    all += lines.next();
    all += '\n';
  }
  return all;
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

std::vector<std::string> ProgramChecker::programs_of(const std::string& path) {
  std::error_code ignored;
  if (path == kInput || !fs::is_directory(path, ignored)) return {path};
  const CheckSettings* settings = settings_in(path);
  if (settings == nullptr) return {};
  auto programs = programs_in(path, settings->endings);
  if (!programs) {
    trouble(programs.error());
    return {};
  }
  std::erase_if(*programs, [&](const std::string& file) {
    const CheckSettings* own = settings_in(program_folder(file));
    return own != nullptr && is_excluded(file, own->exclude, own->file.parent_path());
  });
  if (programs->empty()) note_("there is no program in " + path);
  return *std::move(programs);
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
  if (!settings.most_repeats.empty()) options.most_repeats = std::stoull(settings.most_repeats);
  return options;
}

// A job is of one program: its own, or the only one that is checked by it.
void ProgramChecker::look_into_stock(const Shared& shared, const NcFile& nc,
                                     const std::string& file, lint::CheckOptions& options) {
  if (!shared.job || (options.disabled.contains(lint::Check::rapid_in_material) &&
                      options.disabled.contains(lint::Check::body_in_material))) {
    return;
  }
  options.look_further = [this, &shared, &nc, file] {
    auto found = collisions_of(*shared.job, text_of_program(nc.program.text), nc.program.file,
                               nc.program.dialect);
    if (found) return *std::move(found);
    note_(fmt::format("{}: collisions are not looked for: {}", file,
                      to_string(found.error().front())));
    return std::vector<lint::Finding>();
  };
}

std::optional<lint::CheckedFile> ProgramChecker::check(const std::string& file, bool alone) {
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
  if (shared->job && (alone || of_job)) look_into_stock(*shared, *nc, file, options);
  lint::CheckedFile checked;
  checked.file = nc->program.file;
  checked.dialect = name_of(nc->program.dialect);
  if (shared->known.machine) checked.machine = shared->known.machine->name();
  checked.report = lint::check_program(nc->program, options);
  checked.lines = lint::source_lines(nc->program, checked.report.findings);
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
  std::map<std::string, std::vector<lint::CheckedFile>> of_baselines;
  for (const lint::CheckedFile& each : checked) {
    const Shared* shared = shared_in(program_folder(each.file));
    if (shared != nullptr && !shared->settings.baseline.empty()) {
      of_baselines[shared->settings.baseline].push_back(each);
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

std::optional<std::string> ProgramChecker::program_of_job() {
  if (command_line_.setup_words.job.empty()) return std::nullopt;
  const Shared* shared = shared_in(".");
  if (shared == nullptr || !shared->job) return std::nullopt;
  return shared->job->piece.program_file;
}

}  // namespace frustum::app
