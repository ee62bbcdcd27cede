// The program as users and scripts run it: in a folder of its own, with exit code and both outputs.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace frustum {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code = -1;
  std::string out{};
  std::string err{};
};

inline std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        ("frustum_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  Outcome run(const std::string& arguments) const { return shell("frustum " + arguments); }
  // A line of the shell, in which frustum is the program.
  Outcome shell(const std::string& line) const {
    const fs::path out = folder_ / "stdout", err = folder_ / "stderr";
    const std::string command = "cd '" + folder_.string() +
                                "' && frustum() { '" FRUSTUM_PROGRAM "' \"$@\"; } && { " + line +
                                "\n} >'" + out.string() + "' 2>'" + err.string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(err)};
  }

  // The input is wrong, and the message has all of these words.
  void expect_refusal(const std::string& arguments, const std::vector<std::string>& words) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.out;
    for (const std::string& word : words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos)
          << "'" << word << "' in: " << outcome.err;
    }
  }

  void replace_in(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = read(folder_ / file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }

  fs::path folder_;
};

}  // namespace frustum
