#include "tests/parser/interpret/rs274_runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "parser/tool_table.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

// What a program that does not end may print before it is left alone.
constexpr std::size_t kMostOutput = 64U << 20U;

// As one word of a shell.
std::string quoted(const fs::path& path) {
  std::string word = "'";
  for (const char c : path.string()) {
    if (c == '\'') {
      word += "'\\''";
    } else {
      word += c;
    }
  }
  return word + "'";
}

}  // namespace

bool has_rs274() { return std::system("command -v rs274 >/dev/null 2>&1") == 0; }

bool Rs274Run::ended() const {
  return output.find("PROGRAM_END") != std::string::npos ||
         output.find("FINISH") != std::string::npos;
}

Rs274Run run_rs274(const fs::path& program, const Rs274Start& start) {
  constexpr int kTimedOut = 124;
  static int runs = 0;
  const fs::path folder =
      fs::temp_directory_path() / fmt::format("frustum-rs274-{}-{}", getpid(), ++runs);
  fs::create_directories(folder);
  if (!start.subs.empty()) {
    for (const auto& sub : fs::directory_iterator(start.subs)) {
      if (sub.is_regular_file()) fs::create_symlink(sub.path(), folder / sub.path().filename());
    }
  }
  const std::string command =
      fmt::format("cd {0} && HOME={0} timeout 20 rs274 -g -t {1} {2} 2>&1 </dev/null",
                  quoted(folder), quoted(start.tools), quoted(program));
  Rs274Run run;
  std::array<char, 4096> part{};
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return run;
  while (run.output.size() < kMostOutput &&
         std::fgets(part.data(), static_cast<int>(part.size()), pipe) != nullptr) {
    run.output += part.data();
  }
  const int status = pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.timed_out =
      run.output.size() >= kMostOutput || (WIFEXITED(status) && WEXITSTATUS(status) == kTimedOut);
  fs::remove_all(folder);
  return run;
}

InterpreterOptions options_like_rs274(const Rs274Start& start) {
  InterpreterOptions options;
  if (!start.subs.empty()) options.search_path = {start.subs};
  AxisTarget zero;
  for (const AxisLetter axis : kAxisLetters) zero[axis] = 0.0;
  options.start = zero;
  for (int number = 1; number <= 9; ++number) options.work_offsets[number].origin = zero;
  options.reference_points.fill(zero);
  options.machine_unit = LengthUnit::inch;
  auto tools = read_tool_table(start.tools, LengthUnit::inch);
  EXPECT_TRUE(tools) << to_string(tools.error().front());
  if (tools) options.tools = *std::move(tools);
  return options;
}

std::string difference(const std::vector<CanonicalMove>& ours,
                       const std::vector<CanonicalMove>& theirs) {
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    if (agree(ours[i], theirs[i])) continue;
    return fmt::format("move {}\nours:  {}\nrs274: {}", i + 1, to_text(ours[i]),
                       to_text(theirs[i]));
  }
  if (ours.size() == theirs.size()) return {};
  return fmt::format("{} moves, of rs274 {}", ours.size(), theirs.size());
}

}  // namespace frustum::parser
