// A motion test as a file, so that it can be run again: which test, with its options as keys.
//
// Text   : TOML: test = "circle" | "rotary" | "cone" | "chase" | "line" | "diagonal" | "touch",
//          the options of `frustum motion` as keys, tables [setup], [instrument] and [errors]
//          (docs/motion-tests.md)
// Units  : lengths mm, angles degrees unless a text says otherwise; set-up errors um, feed mm/min
// Errors : every unknown, missing or mistyped key, with its line; what is found out later of a
//          key's value is placed by in_test_file()
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "app/motion/chase_motion.hpp"
#include "app/motion/circle_motion.hpp"
#include "app/motion/cone_motion.hpp"
#include "app/motion/line_motion.hpp"
#include "app/motion/rotary_motion.hpp"
#include "app/motion/touch_motion.hpp"
#include "core/result.hpp"
#include "core/toml_document.hpp"

namespace frustum::app {

using TestWords = std::variant<CircleWords, RotaryWords, ConeMotionWords, ChaseWords, LineWords,
                               DiagonalWords, TouchWords>;

struct TestFile {
  TestWords words{};
  TomlDocument document;  // that they are of
};
[[nodiscard]] Result<TestFile> read_test_file(const std::filesystem::path& file);
// What is wrong with these words, with file, line and key.
[[nodiscard]] Diagnostics in_test_file(const TestFile& file, Diagnostics problems);
[[nodiscard]] Result<MotionAnswer> answer_of(const TestWords& words);
[[nodiscard]] MotionWords& common_words(TestWords& words);

// The file that says the same, for a folder: machine and error files are named from there.
[[nodiscard]] std::string test_toml(const TestWords& words, const std::filesystem::path& folder);

}  // namespace frustum::app
