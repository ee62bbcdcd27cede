#include "app/job/program_files.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <utility>

#include "parser/dialect.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/reading/block_cursor.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

// Endings of programs, whose mistakes are to be found too; those of .h or .txt have to read as one.
constexpr std::array<std::string_view, 19> kEndings{
    "nc",  "ngc", "tap", "cnc", "gcode", "gc",  "mpf", "spf",       "eia",   "din",
    "fnc", "dnc", "ncf", "nc1", "hnc",   "ptp", "apt", "aptsource", "cldata"};

constexpr std::size_t kLook = std::size_t{1} << 16U;
constexpr int kBlocks = 60;

std::string ending_of(const fs::path& file) {
  const std::string ending = parser::lower_case(file.extension().string());
  return ending.empty() ? ending : ending.substr(1);
}

std::optional<std::string> head_of(const fs::path& file) {
  std::string head(kLook, '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  // The last line may be a part of one.
  if (head.size() == kLook) head.resize(std::min(head.rfind('\n') + 1, head.size()));
  return head;
}

// Of LinuxCNC's tool tables and parameters, whose lines read as words.
constexpr std::array<std::string_view, 2> kTables{"tbl", "var"};

bool has_program_ending(const fs::path& file, const std::vector<std::string>& endings) {
  const std::string ending = ending_of(file);
  const auto same = [&ending](const std::string& other) {
    return ending == parser::lower_case(other.starts_with('.') ? other.substr(1) : other);
  };
  return std::ranges::find(kEndings, ending) != kEndings.end() ||
         std::ranges::any_of(endings, same);
}

// Words that a table has too do not make a program.
bool commands_something(const parser::Block& block) {
  return std::ranges::any_of(block.words, [](const parser::Word& word) {
    return word.letter == 'G' || word.letter == 'M' || word.letter == parser::kNamedWord;
  });
}

Diagnostic unreadable(const fs::path& file, const std::string& what, const std::string& why) {
  Diagnostic diagnostic = error("file-unreadable"_id, what, why);
  diagnostic.file = file.string();
  return diagnostic;
}

// Walks through a folder and those within.
class FolderWalk {
 public:
  explicit FolderWalk(const FolderOptions& options) : options_(options) {}

  void walk(const fs::path& folder) {
    std::error_code failure;
    fs::directory_iterator at(folder, failure);
    std::vector<fs::path> paths;
    for (; !failure && at != fs::directory_iterator(); at.increment(failure)) {
      paths.push_back(at->path());
    }
    if (failure) {
      found_.troubles.push_back(unreadable(folder, "the folder cannot be read", failure.message()));
    }
    for (const fs::path& path : paths) look_at(path);
  }
  FolderPrograms found() && {
    std::ranges::sort(found_.files);
    return std::move(found_);
  }

 private:
  void look_at(const fs::path& path) {
    if (path.filename().string().starts_with('.')) return;
    std::error_code failure;
    const fs::file_status itself = fs::symlink_status(path, failure);
    const fs::file_status status = fs::status(path, failure);
    const bool folder = fs::is_directory(status);
    if (folder && fs::is_symlink(itself)) return;
    if (!folder && fs::exists(status) && !fs::is_regular_file(status)) return;
    if (options_.excluded && options_.excluded(path)) {
      ++found_.excluded;
      return;
    }
    if (folder) return walk(path);
    if (!fs::is_regular_file(status)) {
      found_.troubles.push_back(unreadable(path, "the file cannot be read", failure.message()));
    } else if (has_program_ending(path, options_.endings)) {
      found_.files.push_back(path.string());
    } else {
      guess(path);
    }
  }

  void guess(const fs::path& path) {
    if (std::ranges::find(kTables, ending_of(path)) != kTables.end()) return;
    const auto head = head_of(path);
    if (!head) {
      found_.troubles.push_back(
          unreadable(path, "the file cannot be read", "exclude it, if it is no program"));
    } else if (reads_as_program(*head, path.string())) {
      found_.files.push_back(path.string());
    }
  }

  const FolderOptions& options_;
  FolderPrograms found_{};
};

// Without what is the same as nothing at the ends: ./old, old/, **/old.
std::string bare_pattern(std::string pattern, bool& from_folder) {
  while (pattern.ends_with('/')) pattern.pop_back();
  while (pattern.starts_with("./")) pattern.erase(0, 2);
  const bool anywhere = pattern.starts_with("**/");
  while (pattern.starts_with("**/")) pattern.erase(0, 3);
  from_folder = !anywhere && pattern.find('/') != std::string::npos;
  if (pattern.starts_with('/')) pattern.erase(0, 1);
  return pattern;
}

}  // namespace

bool reads_as_program(std::string_view text, const std::string& file) {
  if (text.empty() || text.find('\0') != std::string_view::npos) return false;
  const parser::Program program{file, parser::recognise_dialect(text, file).dialect,
                                parser::ProgramText(std::string(text)), nullptr};
  parser::BlockCursor cursor(program);
  int blocks = 0, acting = 0, wrong = 0;
  bool commands = false;
  while (blocks < kBlocks) {
    const auto block = cursor.next();
    if (block && *block == nullptr) break;
    ++blocks;
    wrong += block ? 0 : 1;
    acting += block && !(*block)->words.empty() ? 1 : 0;
    commands = commands || (block && commands_something(**block));
  }
  constexpr int kAmong = 10;  // one wrong line among so many
  return commands && 2 * acting >= blocks - wrong && wrong * kAmong <= blocks;
}

FolderPrograms programs_in(const fs::path& folder, const FolderOptions& options) {
  FolderWalk walk(options);
  walk.walk(folder);
  return std::move(walk).found();
}

std::string whole_name(const std::string& file) {
  std::error_code failure;
  // Of a file that is not there yet the way is relative else.
  const fs::path whole =
      file == "-" ? fs::path() : fs::weakly_canonical(fs::absolute(file, failure), failure);
  return whole.empty() || failure ? file : whole.string();
}

bool is_same_file(const std::string& one, const std::string& other) {
  if (one.empty() || other.empty() || one == "-" || other == "-") return false;
  std::error_code unlike;
  return whole_name(one) == whole_name(other) || fs::equivalent(one, other, unlike);
}

bool is_excluded(const fs::path& file, const std::vector<std::string>& patterns,
                 const fs::path& folder) {
  if (patterns.empty()) return false;
  const fs::path relative =
      fs::absolute(file).lexically_normal().lexically_relative(fs::absolute(folder));
  return std::ranges::any_of(patterns, [&](const std::string& written) {
    bool from_folder = false;
    const std::string pattern = bare_pattern(written, from_folder);
    fs::path so_far;
    return std::ranges::any_of(relative, [&](const fs::path& name) {
      so_far /= name;
      const std::string text = from_folder ? so_far.generic_string() : name.string();
      return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
    });
  });
}

}  // namespace frustum::app
