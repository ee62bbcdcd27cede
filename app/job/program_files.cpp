#include "app/job/program_files.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <fstream>

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

std::string head_of(const fs::path& file) {
  std::string head(kLook, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  // The last line may be a part of one.
  if (head.size() == kLook) head.resize(std::min(head.rfind('\n') + 1, head.size()));
  return head;
}

bool is_program(const fs::path& file, const std::vector<std::string>& endings) {
  const std::string ending = ending_of(file);
  const auto same = [&ending](const std::string& other) {
    return ending == parser::lower_case(other.starts_with('.') ? other.substr(1) : other);
  };
  const std::string head = head_of(file);
  if (head.find('\0') != std::string::npos) return false;
  return std::ranges::find(kEndings, ending) != kEndings.end() ||
         std::ranges::any_of(endings, same) || reads_as_program(head, file.string());
}

}  // namespace

bool reads_as_program(std::string_view text, const std::string& file) {
  if (text.empty() || text.find('\0') != std::string_view::npos) return false;
  const parser::Program program{file, parser::recognise_dialect(text, file).dialect,
                                parser::ProgramText(std::string(text)), nullptr};
  parser::BlockCursor cursor(program);
  int blocks = 0, acting = 0, wrong = 0;
  while (blocks < kBlocks) {
    const auto block = cursor.next();
    if (block && *block == nullptr) break;
    ++blocks;
    wrong += block ? 0 : 1;
    acting += block && !(*block)->words.empty() ? 1 : 0;
  }
  constexpr int kAmong = 10;  // one wrong line among so many
  return acting > 0 && 2 * acting >= blocks - wrong && wrong * kAmong <= blocks;
}

Result<std::vector<std::string>> programs_in(const fs::path& folder,
                                             const std::vector<std::string>& endings) {
  std::error_code failure;
  std::vector<std::string> files;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied,
                                      failure);
  for (; !failure && at != fs::recursive_directory_iterator(); at.increment(failure)) {
    std::error_code unknown;
    if (at->path().filename().string().starts_with('.')) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file(unknown) && is_program(at->path(), endings)) {
      files.push_back(at->path().string());
    }
  }
  if (failure) {
    Diagnostic diagnostic =
        error("file-unreadable"_id, "the folder cannot be read", failure.message());
    diagnostic.file = folder.string();
    return diagnostic;
  }
  std::ranges::sort(files);
  return files;
}

bool is_excluded(const std::string& file, const std::vector<std::string>& patterns,
                 const fs::path& folder) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  const std::string relative = whole.lexically_relative(folder).generic_string();
  const std::string name = whole.filename().string();
  return std::ranges::any_of(patterns, [&](const std::string& pattern) {
    return fnmatch(pattern.c_str(), relative.c_str(), 0) == 0 ||
           fnmatch(pattern.c_str(), name.c_str(), 0) == 0 || relative.starts_with(pattern + "/");
  });
}

}  // namespace frustum::app
