// Every command of the README does what it says when it is pasted, one after the other.
#include <regex>
#include <sstream>

#include "tests/app/command_line.hpp"
#include "tests/law_count.hpp"

namespace frustum {
namespace {

const fs::path kSource = FRUSTUM_SOURCE_DIR;

// Lines of code blocks that call the program; a backslash goes on with the next line.
std::vector<std::string> commands_of(const fs::path& document) {
  const std::string text =
      std::regex_replace(read(document), std::regex("\\\\\n *"), std::string());
  std::vector<std::string> commands;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("    build/frustum ")) commands.push_back(line.substr(4));
  }
  const std::regex inline_code("`(build/frustum [^`]*)`");
  for (auto at = std::sregex_iterator(text.begin(), text.end(), inline_code);
       at != std::sregex_iterator(); ++at) {
    commands.push_back(std::regex_replace((*at)[1].str(), std::regex("\n"), std::string(" ")));
  }
  return commands;
}

// Seconds each: for make laws.
bool is_long(const std::string& command) {
  const auto begins = [&](const char* words) {
    return command.starts_with(std::string("build/frustum ") + words);
  };
  return begins("run") || begins("identify") || begins("design") || begins("cut") ||
         begins("sensitivity") || begins("compensate") || begins("view");
}

class ReadmeSystem : public CommandLine {};

TEST_F(ReadmeSystem, Fault2_37_EveryCommandWorksWhenItIsPasted) {
  fs::create_directories(folder_ / "build");
  fs::create_symlink(FRUSTUM_PROGRAM, folder_ / "build/frustum");
  fs::create_symlink(kSource / "examples", folder_ / "examples");
  const auto commands = commands_of(kSource / "README.md");
  ASSERT_GT(commands.size(), 15U);
  for (const std::string& command : commands) {
    std::string line = command;
    if (proof::laws_are_reduced() && line.starts_with("build/frustum program cone")) {
      line += " --chord-tolerance 50";
    }
    if (proof::laws_are_reduced() && is_long(line)) {
      if (!line.starts_with("build/frustum run")) continue;
      // Its points are read by what follows.
      replace_in("piece/job.toml", "report = true", "report = false");
    }
    const Outcome outcome = shell(line);
    EXPECT_EQ(outcome.exit_code, 0) << line << '\n' << outcome.err;
  }
}

}  // namespace
}  // namespace frustum
