#include "parser/program_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "parser/language/letter_case.hpp"

namespace frustum::parser {
namespace {

constexpr std::size_t kMostFiles = 2000;  // of a folder
// Comments may precede the number.
constexpr std::size_t kBytesOfHead = 2048;
constexpr std::array<std::string_view, 8> kProgramEndings{"",     ".nc",  ".cnc", ".tap",
                                                          ".txt", ".eia", ".ncc", ".min"};

bool may_be_program(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return std::find(kProgramEndings.begin(), kProgramEndings.end(), ending) != kProgramEndings.end();
}

// O1002 or :1002 before anything else but %, comments and empty lines.
std::optional<std::uint32_t> first_number_of(std::string_view head) {
  while (!head.empty()) {
    const std::size_t end = std::min(head.find('\n'), head.size());
    std::string_view line = head.substr(0, end);
    head.remove_prefix(std::min(end + 1, head.size()));
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos || line[begin] == '%' || line[begin] == '(') continue;
    line.remove_prefix(begin);
    std::uint32_t number = 0;
    const bool names = line.front() == 'O' || line.front() == 'o' || line.front() == ':';
    const auto read = std::from_chars(line.data() + 1, line.data() + line.size(), number);
    if (!names || read.ec != std::errc{}) return std::nullopt;
    return number;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::filesystem::path> files_of_program(const std::filesystem::path& folder,
                                                    std::uint32_t number) {
  std::vector<std::filesystem::path> found;
  std::error_code unreadable;
  std::filesystem::directory_iterator entry(folder, unreadable);
  for (std::size_t files = 0; !unreadable && entry != std::filesystem::directory_iterator{};
       entry.increment(unreadable)) {
    std::error_code unknown;
    if (!entry->is_regular_file(unknown) || !may_be_program(entry->path())) continue;
    if (++files > kMostFiles) break;
    std::string head(kBytesOfHead, '\0');
    std::ifstream text(entry->path(), std::ios::binary);
    text.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(std::max<std::streamsize>(text.gcount(), 0)));
    if (first_number_of(head) == number) found.push_back(entry->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace frustum::parser
