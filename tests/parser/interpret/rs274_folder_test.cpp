// Programs that others wrote, in a folder that FRUSTUM_RS274_PROGRAMS names: rs274 and our reader
// command the same, or both refuse. Prints how many do, and where each of the others differs first.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "parser/interpreter.hpp"
#include "parser/language/letter_case.hpp"
#include "parser/program.hpp"
#include "tests/parser/interpret/rs274_runs.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

constexpr double kAgreeing = 0.97;

// Each text once.
std::vector<fs::path> distinct_programs(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string ending = lower_case(entry.path().extension().string());
    const bool program = ending == ".ngc" || ending == ".nc" || ending == ".tap";
    if (entry.is_regular_file() && program) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::set<std::string> texts;
  std::erase_if(files, [&texts](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return !texts.insert(std::string(std::istreambuf_iterator<char>(in), {})).second;
  });
  return files;
}

// A table in which whatever tool a program asks for is there: T1 to T99.
fs::path usual_tools() {
  const fs::path file = fs::path(testing::TempDir()) / "rs274_folder_tools.tbl";
  std::ofstream out(file);
  for (int tool = 1; tool <= 99; ++tool) {
    out << fmt::format("T{0} P{0} D0.1234 Z{1:.3f} ;\n", tool, 0.5 + 0.001 * tool);
  }
  return file;
}

// What the program says to the operator is no part of the comparison, nor is the coolant that the
// end of the program switches off.
std::vector<CanonicalMove> commands(std::vector<CanonicalMove> moves) {
  if (!moves.empty() && moves.back().kind == "coolant off") moves.pop_back();
  std::erase_if(moves, [](const CanonicalMove& move) {
    return move.kind.starts_with("message") || move.kind.starts_with("log");
  });
  return without_standing_still(std::move(moves));
}

// It has run a program that has no end.
bool ran_to_the_end(const Rs274Run& run) {
  return (run.ended() && run.exit_code == 0) ||
         run.output.find("File ended with no percent sign") != std::string::npos;
}

// What rs274 says beside its calls, "   12 N..... STRAIGHT_FEED(..)".
std::string complaint_of(const std::string& output) {
  std::string told;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    const bool call = first != std::string::npos && line[first] >= '0' && line[first] <= '9' &&
                      line.find(" N") != std::string::npos;
    if (call || line.empty() || line.find("executing") != std::string::npos) continue;
    told += told.empty() ? line : " | " + line;
  }
  return told;
}

// What says that a program is for another release, or for a configuration that rs274 has not been
// given: such a program decides nothing.
struct Undecided {
  std::string_view complaint;
  std::string_view line;
};
constexpr std::array kUndecided{
    Undecided{"Unknown g code used", "G6.2"},
    Undecided{"both X and Y coordinates for Control Points", "G5.2"},
    Undecided{"both X and Y coordinates for Control Points", "P1"},
    Undecided{"Unknown m code used: M1", ""},  // programs of the user's own
    Undecided{"M-code greater than 199: M42", ""},
    Undecided{"M-code greater than 199: M43", ""},
    Undecided{"R word with no g code that uses it", "G64"},
    Undecided{"_hal[", ""},
    Undecided{"_ini[", ""},
};
bool decides_nothing(const std::string& complaint) {
  return std::any_of(kUndecided.begin(), kUndecided.end(), [&](const Undecided& entry) {
    return complaint.find(entry.complaint) != std::string::npos &&
           complaint.find(entry.line) != std::string::npos;
  });
}

struct Comparison {
  bool decided = true;
  bool agrees = false;
  std::string found{};
};

Comparison compare(const fs::path& file, const fs::path& tools) {
  const Rs274Start start{tools, file.parent_path()};
  const Rs274Run run = run_rs274(file, start);
  if (run.timed_out) return {false, false, "rs274 does not end"};
  InterpreterOptions options = options_like_rs274(start);
  options.max_blocks = 3'000'000;
  const auto program = open_program(file, Dialect::linuxcnc);
  const bool theirs = ran_to_the_end(run);
  // A program without an end is refused too, after it has run.
  const bool refused = run.exit_code != 0;
  if (!program) return {true, refused, to_string(program.error().front())};
  const auto motions = motions_of(*program, options);
  if (!motions) {
    const Diagnostic& ours = motions.error().front();
    // R beside G64 and M19: later releases refuse it as well.
    const bool later = ours.id == "word-ambiguous"_id;
    return {refused || !later, refused, to_string(ours)};
  }
  if (!theirs) {
    const std::string complaint = complaint_of(run.output);
    return {!decides_nothing(complaint), false, "rs274 alone refuses: " + complaint};
  }
  const std::string found =
      difference(commands(moves_of(*motions)), commands(moves_of_rs274(run.output)));
  return {true, found.empty(), found};
}

TEST(Rs274Folder, CommandsTheSameInProgramsOfOthers) {
  const char* folder = std::getenv("FRUSTUM_RS274_PROGRAMS");
  if (folder == nullptr) GTEST_SKIP() << "FRUSTUM_RS274_PROGRAMS names no folder";
  if (!has_rs274()) GTEST_SKIP() << "rs274 is not installed: scripts/setup --with-oracle";
  const fs::path tools = usual_tools();
  std::size_t agreeing = 0;
  std::size_t decided = 0;
  for (const fs::path& file : distinct_programs(folder)) {
    const Comparison comparison = compare(file, tools);
    decided += comparison.decided ? 1 : 0;
    agreeing += comparison.decided && comparison.agrees ? 1 : 0;
    if (comparison.decided && comparison.agrees) continue;
    fmt::print("{}{}: {}\n", comparison.decided ? "" : "(left out) ",
               fs::relative(file, folder).string(), comparison.found);
  }
  ASSERT_GT(decided, 0U);
  const double share = static_cast<double>(agreeing) / static_cast<double>(decided);
  fmt::print("{} of {} distinct programs agree: {:.1f} %\n", agreeing, decided, 100.0 * share);
  EXPECT_GE(share, kAgreeing);
}

}  // namespace
}  // namespace frustum::parser
