// Where the programs are that a program calls: in its own file, or in files of the search path.
#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "parser/interpret/program_run.hpp"
#include "parser/interpret/state/word_values.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/program_files.hpp"

namespace frustum::parser {
namespace {

// A name that is too long for the file system is none of a file.
bool is_file(const std::filesystem::path& path) {
  std::error_code unreadable;
  return std::filesystem::is_regular_file(path, unreadable);
}

}  // namespace

std::shared_ptr<LoadedProgram> ProgramRun::file_of(const std::string& name) {
  const auto [place, fresh] = files_.try_emplace(name);
  if (!fresh) return place->second;
  for (const auto& folder : options_.search_path) {
    for (const std::string_view pattern : rules_.file_names) {
      auto file = folder / fmt::format(fmt::runtime(pattern), name);
      // Names that a control writes in capitals are often small in the names of files.
      if (!is_file(file)) file = folder / fmt::format(fmt::runtime(pattern), lower_case(name));
      if (!is_file(file)) continue;
      auto program = open_program(file, rules_.dialect);
      if (!program) continue;
      place->second = std::make_shared<LoadedProgram>(*std::move(program),
                                                      LoadedProgram::Role::file_of_subprogram);
      return place->second;
    }
  }
  return nullptr;
}

// The one file of the first folder that has any which begin with the number; null for none.
Result<std::shared_ptr<LoadedProgram>> ProgramRun::file_of_number(const Block& block,
                                                                  std::uint32_t column,
                                                                  std::uint32_t number) {
  const std::string name = fmt::format("O{}", number);
  if (rules_.dialect != Dialect::fanuc) return std::shared_ptr<LoadedProgram>{};
  for (const auto& folder : options_.search_path) {
    const auto files = files_of_program(folder, number);
    if (files.empty()) continue;
    if (files.size() > 1) {
      return at(block, column, "missing-subprogram"_id,
                fmt::format("{} and {} both begin with {}", files[0].filename().string(),
                            files[1].filename().string(), name),
                fmt::format("name the one that is meant {}.nc", name));
    }
    auto program = open_program(files.front(), rules_.dialect);
    if (!program) continue;
    executor_.state().at_work.block = &block;
    assume(
        executor_.state(), column, name,
        fmt::format("it is {}, which begins with that number", files.front().filename().string()));
    auto& place = files_[name];
    place = std::make_shared<LoadedProgram>(*std::move(program),
                                            LoadedProgram::Role::file_of_subprogram);
    return place;
  }
  return std::shared_ptr<LoadedProgram>{};
}

std::shared_ptr<LoadedProgram> ProgramRun::program_with(const std::string& name) {
  for (const auto& candidate : {frame().program, main_}) {
    if (candidate->map().target(name) != nullptr) return candidate;
  }
  return file_of(name);
}

}  // namespace frustum::parser
