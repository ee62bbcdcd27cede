#include "app/motion/test_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/motion/setup_sheet.hpp"
#include "core/whole_file.hpp"
#include "instruments/approach.hpp"
#include "instruments/reach.hpp"
#include "instruments/readings.hpp"
#include "trials/trial.hpp"

namespace frustum::app {

using programs::MotionForm;
using programs::MotionProgramOptions;

Result<MotionProgramOptions> program_options(const ProgramWords& words) {
  MotionProgramOptions options;
  if (!words.dialect.empty()) {
    const auto dialect = parser::dialect_named(words.dialect);
    if (!dialect || *dialect == parser::Dialect::cldata) {
      return unknown_word("--dialect", words.dialect,
                          {"fanuc", "linuxcnc", "sinumerik", "heidenhain"});
    }
    options.dialect = *dialect;
  }
  if (words.form == "axes") {
    options.form = MotionForm::axes;
  } else if (!words.form.empty() && words.form != "tcp") {
    return unknown_word("--form", words.form, {"tcp", "axes"});
  }
  if (!(words.feed > 0.0 && std::isfinite(words.feed))) {
    return error("out-of-range"_id,
                 fmt::format("--program-feed {}: expected a feed above 0 mm/min", words.feed));
  }
  options.feed = words.feed;
  return options;
}

std::optional<Diagnostics> add_program(MotionAnswer& answer,
                                       const Result<programs::TestPiece>& program) {
  if (!program) return program.error();
  answer.program = NcText{program->program_file, program->program};
  return std::nullopt;
}

Result<kinematics::CommandedProgram> commanded_by(const ProgramWords& words,
                                                  const MotionSetup& setup, const Vec3& origin) {
  auto text = read_whole_file(words.file);
  if (!text) return text.error();
  programs::TestPiece piece = programs::motion_frame(origin, setup.tool_length);
  piece.dialect = words.dialect.empty() ? parser::recognise_dialect(*text, words.file).dialect
                                        : *parser::dialect_named(words.dialect);
  piece.program = *std::move(text);
  piece.program_file = words.file;
  auto commanded = trials::command_piece(setup.machine, piece);
  if (!commanded) return commanded.error();
  return std::move(commanded->program);
}

Result<std::vector<instruments::TestPose>> rests_of_program(
    const ProgramWords& words, const MotionSetup& setup, const Vec3& origin,
    std::span<const instruments::TestPose> wanted) {
  const auto commanded = commanded_by(words, setup, origin);
  if (!commanded) return commanded.error();
  return instruments::rests_at(setup.errors, *commanded, wanted);
}

Result<ProgramReadings> readings_by_program(const ProgramWords& words, const MotionSetup& setup,
                                            const BarOfProgram& bar,
                                            std::span<const instruments::Sense> senses) {
  const auto commanded = commanded_by(words, setup, bar.origin);
  if (!commanded) return commanded.error();
  const auto passes = instruments::bar_passes(setup.machine, setup.errors, *commanded, bar.test,
                                              bar.parameter, senses, {.servo_lag = bar.servo_lag});
  if (!passes) return passes.error();
  const kinematics::ForwardChain actual(setup.machine, setup.errors, setup.tool_length);
  ProgramReadings found;
  for (std::size_t k = 0; k < passes->size(); ++k) {
    instruments::MotionTest run = bar.test;
    run.poses = (*passes)[k];
    run.polynomials.reset();
    auto exact = instruments::bar_readings(actual, run, setup.setup);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      found.largest_difference =
          std::max(found.largest_difference, std::abs(exact[i] - bar.expected[k][i]));
    }
    auto seen =
        instruments::shown(setup.instrument, std::move(exact), static_cast<std::uint32_t>(k));
    if (auto problem = instruments::beyond_stroke(run, seen, bar.stroke, bar.name)) {
      return *std::move(problem);
    }
    found.shown.push_back(std::move(seen));
  }
  return found;
}

Result<ShownBar> bar_of_words(const MotionWords& words, const MotionSetup& setup,
                              const BarOfRun& run) {
  ShownBar bar;
  MotionSetup quiet = setup;
  // Of a program's run the analytic samples are what it is compared with.
  if (words.nc.run) quiet.instrument = {};
  auto shown = shown_by_bar(quiet, run.test, words.stroke, run.parameter_name, run.moved);
  if (!shown) return shown.error();
  bar.readings = *std::move(shown);
  if (words.nc.run) {
    auto found = readings_by_program(words.nc, setup,
                                     {.test = run.test,
                                      .parameter = run.parameter,
                                      .name = run.parameter_name,
                                      .origin = run.test.table_ball,
                                      .stroke = words.stroke,
                                      .servo_lag = words.nc.servo_lag,
                                      .expected = {bar.readings, bar.readings}},
                                     instruments::kSenses);
    if (!found) return found.error();
    bar.largest_difference = found->largest_difference;
    bar.readings = std::move(found->shown[0]);
    bar.back = std::move(found->shown[1]);
  }
  if (words.nc.written()) {
    const auto options = program_options(words.nc);
    if (!options) return options.error();
    auto piece = programs::bar_program(setup.machine, run.name, run.title, run.test, *options);
    if (!piece) return piece.error();
    bar.program = *std::move(piece);
  }
  return bar;
}

std::optional<Diagnostics> add_bar(MotionAnswer& answer, const MotionWords& words,
                                   const MotionSetup& setup, const instruments::MotionTest& test,
                                   const std::string& parameter, const ShownBar& bar) {
  if (words.nc.run) {
    add_program_run(answer, words.nc, bar.largest_difference);
    answer.document["reading_back_um"] = in_um(bar.back);
  }
  if (!bar.program) return std::nullopt;
  answer.program = NcText{bar.program->program_file, bar.program->program};
  return add_setup_sheet(
      answer, {setup.machine, test, *bar.program, parameter, words.stroke, bar.readings});
}

void add_program_run(MotionAnswer& answer, const ProgramWords& words, double largest_difference) {
  answer.document["program"] =
      Document{{"file", words.file}, {"largest_difference_um", largest_difference * kUmPerMm}};
  const report::Wording& wording = answer.words;
  answer.text += wording("through {0}: at most {1} {2} from analytic samples", words.file,
                         shown_um(largest_difference, wording, 4), wording.unit("um")) +
                 "\n";
  answer.page.facts.push_back({wording("NC program"), words.file});
}

}  // namespace frustum::app
