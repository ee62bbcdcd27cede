// Checks programs by their settings: what `frustum check` does with each file.
//
// Settings are looked for once a folder; machines and jobs are read for all files that go by the
// same settings, and not for each.
// Units : none
// Errors: files, settings, machines and jobs that cannot be read, each reported once
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/job/check_settings.hpp"
#include "app/job/job.hpp"
#include "app/job/nc_file.hpp"
#include "lint/baseline.hpp"
#include "lint/checked_file.hpp"

namespace frustum::app {

struct ProgramToCheck {
  std::string file{};
  bool of_folder = false;  // else it was named
};

class ProgramChecker {
 public:
  using Notes = std::function<void(const std::string&)>;

  // `without_files`: no .frustum.toml is looked for.
  ProgramChecker(CheckSettings command_line, bool without_files, Notes note);

  // The settings of the files in this folder; null where they cannot be read.
  [[nodiscard]] const CheckSettings* settings_in(const std::filesystem::path& folder);
  // The programs of files and folders, after what settings exclude, each once however it is named;
  // without any that of the command line's job.
  [[nodiscard]] std::vector<ProgramToCheck> programs_of(const std::vector<std::string>& paths);
  // All of them; subprograms of folders by what holds without their callers.
  [[nodiscard]] std::vector<lint::CheckedFile> check(const std::vector<ProgramToCheck>& programs);
  // Suppresses what baselines have.
  void apply_baselines(std::vector<lint::CheckedFile>& checked);
  // Writes those that the settings name instead; the names of the files.
  [[nodiscard]] std::vector<std::string> write_baselines(
      const std::vector<lint::CheckedFile>& checked);
  // Whether its findings are below the level of its settings.
  [[nodiscard]] bool passes(const lint::CheckedFile& checked);
  // Whether a file that is to be written is one that is read for these programs.
  [[nodiscard]] bool reads(const std::string& file, const std::vector<ProgramToCheck>& programs);
  // The baselines that they go by.
  [[nodiscard]] std::set<std::string> baselines_of(const std::vector<ProgramToCheck>& programs);

  [[nodiscard]] const Diagnostics& troubles() const { return troubles_; }

 private:
  // What files with the same settings share.
  struct Shared {
    CheckSettings settings{};
    KnownSetup known{};
    std::set<lint::Check> disabled{};
    std::optional<parser::ToolTable> tools{};
    std::optional<Job> job{};
    std::optional<lint::Baseline> baseline{};
  };

  [[nodiscard]] std::vector<ProgramToCheck> programs_of_path(const std::string& path);
  [[nodiscard]] std::optional<std::string> program_of_job();
  // `alone`: the only one, of which the notes say how it is read.
  [[nodiscard]] std::optional<lint::CheckedFile> check(const ProgramToCheck& program, bool alone,
                                                       bool subprogram);
  [[nodiscard]] Shared* shared_in(const std::filesystem::path& folder);
  [[nodiscard]] std::unique_ptr<Shared> read_shared(const CheckSettings& settings);
  [[nodiscard]] lint::CheckOptions options_of(const Shared& shared, const std::string& file) const;
  void look_into_stock(const Shared& shared, const NcFile& nc, lint::CheckOptions& options);
  [[nodiscard]] static Job job_of(const Shared& shared, const NcFile& nc);
  void trouble(const Diagnostics& diagnostics);

  CheckSettings command_line_;
  bool without_files_;
  Notes note_;
  std::map<std::filesystem::path, Shared*> of_folders_{};
  std::map<std::filesystem::path, std::unique_ptr<Shared>> of_files_{};
  Diagnostics troubles_{};
};

}  // namespace frustum::app
