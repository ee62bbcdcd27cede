// The NC program of a motion test: written for a control, or run in place of analytic samples.
//
// Units  : mm, degrees, mm/min in the words
// Errors : a dialect or form that is none; those of the program, with its file and line
#pragma once

#include <span>
#include <vector>

#include "app/motion/motion_answer.hpp"
#include "core/result.hpp"
#include "instruments/program_run.hpp"
#include "programs/motion/motion_program.hpp"

namespace frustum::app {

[[nodiscard]] Result<programs::MotionProgramOptions> program_options(const ProgramWords& words);

// Puts the program into the answer, to be written. One that cannot be written is an error where it
// was asked for.
[[nodiscard]] std::optional<Diagnostics> add_program(MotionAnswer& answer,
                                                     const Result<programs::TestPiece>& program);

// What the program that the words name makes the axes do. `origin`: of G54 in the table frame.
[[nodiscard]] Result<kinematics::CommandedProgram> commanded_by(const ProgramWords& words,
                                                                const MotionSetup& setup,
                                                                const Vec3& origin);

// Where the axes rest in its run, in the order of `wanted`.
[[nodiscard]] Result<std::vector<instruments::TestPose>> rests_of_program(
    const ProgramWords& words, const MotionSetup& setup, const Vec3& origin,
    std::span<const instruments::TestPose> wanted);

// What the bar of a test shows while the program runs, a run for each sense.
struct ProgramReadings {
  std::vector<std::vector<double>> shown{};
  double largest_difference = 0.0;  // mm: from analytic samples, before noise
};
struct BarOfProgram {
  const instruments::MotionTest& test;
  instruments::TestParameter parameter{};
  std::string name{};  // of the parameter, "C"
  Vec3 origin = Vec3::Zero();
  double stroke = 1.0;
  bool servo_lag = false;
  // Analytic readings, as many as senses.
  std::vector<std::vector<double>> expected{};
};
[[nodiscard]] Result<ProgramReadings> readings_by_program(
    const ProgramWords& words, const MotionSetup& setup, const BarOfProgram& bar,
    std::span<const instruments::Sense> senses);

// A bar of one run.
struct BarOfRun {
  const instruments::MotionTest& test;
  std::string name{}, title{};  // of the program
  instruments::TestParameter parameter{};
  std::string parameter_name{};   // "C"
  std::span<const Vec3> moved{};  // what else moves the tip in each pose; empty: nothing
};
// What it shows, by its program where that is run, and the program to be written where that is
// asked for.
struct ShownBar {
  std::vector<double> readings{};
  std::vector<double> back{};  // of the second pass of a program
  double largest_difference = 0.0;
  std::optional<programs::TestPiece> program{};
};
[[nodiscard]] Result<ShownBar> bar_of_words(const MotionWords& words, const MotionSetup& setup,
                                            const BarOfRun& run);
[[nodiscard]] std::optional<Diagnostics> add_bar(MotionAnswer& answer, const MotionWords& words,
                                                 const MotionSetup& setup,
                                                 const instruments::MotionTest& test,
                                                 const std::string& parameter, const ShownBar& bar);

// The program that was run, and how far its readings are from analytic ones.
void add_program_run(MotionAnswer& answer, const ProgramWords& words, double largest_difference);

}  // namespace frustum::app
