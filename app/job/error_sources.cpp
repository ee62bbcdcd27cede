#include "app/job/error_sources.hpp"

#include "app/job/machine_files.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_draw.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using kinematics::ErrorEntry;
using kinematics::ErrorList;

void put(std::vector<ErrorEntry>& entries, ErrorEntry entry) {
  std::erase_if(entries, [&](const ErrorEntry& e) { return e.name == entry.name; });
  entries.push_back(std::move(entry));
}

void append(Diagnostics& to, const Diagnostics& more) {
  to.insert(to.end(), more.begin(), more.end());
}

// The machine that an error file names must be this one, or one that is known; where the file does
// not say its structure, it is that of this machine.
std::optional<Diagnostic> unknown_machine(kinematics::ErrorFileHead& file,
                                          const kinematics::Machine& machine) {
  if (file.machine == machine.name()) return std::nullopt;
  const auto known = load_machine(file.machine, file.file.parent_path());
  if (known) {
    if (file.structure.empty()) file.structure = known->structure();
    return std::nullopt;
  }
  Diagnostic problem = known.error().front();
  problem.file = file.file.string();
  problem.key = "machine";
  return problem;
}

}  // namespace

std::vector<fs::path> error_files_of(const ErrorWords& words) {
  std::vector<fs::path> files;
  for (const std::string& name : words.files) files.push_back(find_error_file(name, "."));
  return files;
}

std::optional<ErrorDraw> drawn_by(const ErrorWords& words, std::optional<ErrorDraw> of_job) {
  if (!words.draw) return of_job;
  return ErrorDraw{*words.draw, of_job ? of_job->index : 0};
}

Result<std::vector<ErrorEntry>> gather_errors(ErrorList of_job, const ErrorWords& words,
                                              std::optional<ErrorDraw> draw,
                                              const kinematics::Machine& machine) {
  ErrorList all = std::move(of_job);
  for (const fs::path& name : error_files_of(words)) {
    auto file = kinematics::load_error_file(name);
    if (!file) {
      append(all.problems, file.error());
      continue;
    }
    for (ErrorEntry& entry : file->entries) put(all.entries, std::move(entry));
    all.files.insert(all.files.end(), file->files.begin(), file->files.end());
  }
  for (const std::string& text : words.errors) {
    auto entry = kinematics::parse_error(text);
    if (entry) {
      put(all.entries, *std::move(entry));
    } else {
      append(all.problems, entry.error());
    }
  }
  for (kinematics::ErrorFileHead& file : all.files) {
    if (auto problem = unknown_machine(file, machine)) all.problems.push_back(*std::move(problem));
    if (auto problem = mismatch(file, machine)) all.problems.push_back(*std::move(problem));
  }
  if (has_error(all.problems)) return all.problems;
  if (!draw) return all.entries;
  return kinematics::draw(all.entries, draw->seed, draw->index);
}

fs::path find_error_file(const std::string& name, const fs::path& folder) {
  std::error_code ignored;
  const fs::path written = name;
  for (const fs::path& candidate : {folder / written, written}) {
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  for (const fs::path& shipped : machine_folders()) {
    const fs::path candidate = shipped / "errors" / (name + ".toml");
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  return folder / written;
}

}  // namespace frustum::app
