#include "app/job/machine_files.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>

#include "core/spelling.hpp"
#include "lint/sarif_findings.hpp"

namespace frustum::app {
namespace fs = std::filesystem;

namespace {

// Of the module that this code is part of, where another program has loaded it; else empty.
fs::path loaded_module() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&loaded_module), &info) == 0) return {};
  const fs::path file = info.dli_fname;
  return file.extension() == ".so" ? fs::absolute(file) : fs::path();
}

}  // namespace

// Within the Python package, or of the prefix in which it is (PREFIX/lib/python3/dist-packages/
// frustum); beside the installed program; else beside the source, while developing.
std::vector<fs::path> machine_folders() {
  std::error_code ignored;
  std::vector<fs::path> folders;
  if (const fs::path module = loaded_module(); !module.empty()) {
    fs::path prefix = module.parent_path();
    folders.push_back(prefix / "machines");
    for (int up = 0; up < 4; ++up) prefix = prefix.parent_path();
    folders.push_back(prefix / FRUSTUM_INSTALLED_MACHINES);
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  if (!program.empty()) {
    folders.push_back(program.parent_path().parent_path() / FRUSTUM_INSTALLED_MACHINES);
  }
  folders.emplace_back(FRUSTUM_SOURCE_MACHINES);
  return folders;
}

std::string documents_uri() {
  std::error_code ignored;
  if (std::string_view(FRUSTUM_DOCUMENTS_URI) != "") return FRUSTUM_DOCUMENTS_URI;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  for (const fs::path& folder : {program.parent_path().parent_path() / FRUSTUM_INSTALLED_DOCUMENTS,
                                 fs::path(FRUSTUM_SOURCE_MACHINES).parent_path() / "docs"}) {
    if (fs::is_regular_file(folder / "check.md", ignored)) return lint::file_uri(folder / "");
  }
  return {};
}

Result<fs::path> find_machine(const std::string& name, const fs::path& folder) {
  std::error_code ignored;
  const fs::path written = name;
  const fs::path named = folder / written;
  if (fs::is_regular_file(named, ignored)) return named;
  for (const fs::path& shipped : machine_folders()) {
    const fs::path candidate = shipped / (name + ".toml");
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  std::vector<std::string> names;
  for (const fs::path& each : shipped_machines()) names.push_back(each.stem().string());
  return error("unknown-machine"_id,
               fmt::format("'{}' is neither a machine file ('{}' is no file) nor a machine that is "
                           "shipped",
                           name, named.lexically_normal().string()),
               suggestion(written.stem().string(), names));
}

Result<kinematics::Machine> load_machine(const std::string& name, const fs::path& folder) {
  const auto file = find_machine(name, folder);
  if (!file) return file.error();
  return kinematics::Machine::load(*file);
}

std::string name_for_job(const fs::path& machine_file, const fs::path& folder) {
  std::error_code problem;
  for (const fs::path& shipped : machine_folders()) {
    const fs::path same = shipped / machine_file.filename();
    if (fs::equivalent(same, machine_file, problem)) return machine_file.stem().string();
  }
  return path_from(machine_file, folder);
}

std::string path_from(const fs::path& file, const fs::path& folder) {
  std::error_code problem;
  const fs::path from_there = fs::relative(fs::absolute(file), fs::absolute(folder), problem);
  return (problem || from_there.empty() ? fs::absolute(file) : from_there).generic_string();
}

std::vector<fs::path> shipped_machines() {
  std::error_code problem;
  for (const fs::path& folder : machine_folders()) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, problem)) {
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
    if (files.empty()) continue;
    std::sort(files.begin(), files.end());
    return files;
  }
  return {};
}

}  // namespace frustum::app
