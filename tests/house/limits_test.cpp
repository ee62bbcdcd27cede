// Limits that keep a file, a folder and a class small enough to be read at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/house/rooms.hpp"
#include "tests/house/source_tree.hpp"

namespace frustum::house {
namespace {

constexpr std::size_t kMaxLines = 500;
constexpr std::size_t kMaxColumns = 100;
constexpr std::size_t kMaxSourcesOfAFolder = 30;
constexpr std::size_t kMaxPrivateMembers = 25;

std::vector<std::string> all_sources() {
  std::vector<std::string> files = sources_of_all_rooms();
  for (const char* folder : {"tests", "bench", "examples"}) {
    for (std::string& file : files_of(folder, {".cpp", ".hpp"})) files.push_back(std::move(file));
  }
  return files;
}

// What is above a limit, with the reason.
using Exceptions = std::map<std::string, std::string>;

const Exceptions& long_sources() {
  static const Exceptions kFiles{};
  return kFiles;
}

const Exceptions& crowded_folders() {
  static const Exceptions kFolders{};
  return kFolders;
}

const Exceptions& large_classes() {
  static const Exceptions kClasses{};
  return kClasses;
}

// Holds one limit; an exception that is no longer needed fails, too.
void expect_within(std::size_t value, std::size_t limit, const std::string& place,
                   const Exceptions& exceptions) {
  if (exceptions.contains(place)) {
    EXPECT_GT(value, limit) << place << " is within the limit: remove the exception";
  } else {
    EXPECT_LE(value, limit) << place;
  }
}

// Characters of a line in UTF-8: bytes that do not continue one.
std::size_t columns_of(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string without_strings(const std::string& line) {
  static const std::regex kText(R"("(\\.|[^"\\])*"|'(\\.|[^'\\])*')");
  return std::regex_replace(line, kText, "");
}

// The line without its strings, characters and comment, so that braces and names are code.
std::string code_of(const std::string& line) {
  const std::string code = without_strings(line);
  return code.substr(0, code.find("//"));
}

struct ClassSize {
  std::string name;
  int depth = 0;  // of braces, inside it
  std::size_t members = 0;
  bool is_private = true;
};

// Data members after `private:` of each class of a file: declarations that end in `name_;`,
// `name_ = ..;` or `name_{..};` on one line.
std::vector<ClassSize> classes_of(const std::string& file) {
  static const std::regex kClass(R"(^\s*(?:template\s*<.*>\s*)?class\s+(\w+)[^;]*\{)");
  static const std::regex kAccess(R"(^\s*(public|protected|private):)");
  static const std::regex kMember(R"(\b\w+_\s*(=[^;]*|\{.*\})?;\s*$)");
  static const std::regex kStatement(R"(^\s*(return|using|friend)\b)");
  std::vector<ClassSize> found;
  std::vector<ClassSize> open;
  int depth = 0;
  for (const std::string& line : lines_of(file)) {
    const std::string code = code_of(line);
    std::smatch match;
    if (std::regex_search(code, match, kClass)) open.push_back({match[1].str(), depth + 1});
    if (!open.empty() && depth == open.back().depth) {
      if (std::regex_search(code, match, kAccess)) {
        open.back().is_private = match[1] == "private";
      } else if (open.back().is_private && std::regex_search(code, kMember) &&
                 !std::regex_search(code, kStatement)) {
        ++open.back().members;
      }
    }
    depth += static_cast<int>(std::count(code.begin(), code.end(), '{'));
    depth -= static_cast<int>(std::count(code.begin(), code.end(), '}'));
    while (!open.empty() && depth < open.back().depth) {
      found.push_back(open.back());
      open.pop_back();
    }
  }
  return found;
}

TEST(Limits, NoSourceIsLongerThan500Lines) {
  for (const std::string& file : all_sources()) {
    expect_within(lines_of(file).size(), kMaxLines, file, long_sources());
  }
}

// clang-format wraps code, not comments.
TEST(Limits, NoCommentIsWiderThan100Columns) {
  for (const std::string& file : all_sources()) {
    int number = 0;
    for (const std::string& line : lines_of(file)) {
      ++number;
      if (without_strings(line).find("//") == std::string::npos) continue;
      EXPECT_LE(columns_of(line), kMaxColumns) << file << ":" << number;
    }
  }
}

TEST(Limits, NoFolderHasMoreThan30Sources) {
  std::map<std::string, std::size_t> sources;
  for (const std::string& file : all_sources()) {
    if (file.ends_with(".cpp")) ++sources[file.substr(0, file.rfind('/'))];
  }
  for (const auto& [folder, count] : sources) {
    expect_within(count, kMaxSourcesOfAFolder, folder, crowded_folders());
  }
}

TEST(Limits, NoClassHasMoreThan25PrivateDataMembers) {
  std::size_t members = 0;
  for (const std::string& file : sources_of_all_rooms()) {
    for (const ClassSize& size : classes_of(file)) {
      members += size.members;
      expect_within(size.members, kMaxPrivateMembers, file + ": " + size.name, large_classes());
    }
  }
  EXPECT_GT(members, 500U) << "the scanner no longer finds the members of our classes";
}

}  // namespace
}  // namespace frustum::house
