#include "app/motion/motion_answer.hpp"

#include <fmt/format.h>

#include <sstream>

#include "core/decimal.hpp"
#include "core/program_version.hpp"
#include "instruments/approach.hpp"
#include "instruments/reach.hpp"
#include "instruments/readings.hpp"

namespace frustum::app {

using instruments::TestPose;

std::vector<double> coordinates(const Vec3& v, double factor) {
  return {factor * v.x(), factor * v.y(), factor * v.z()};
}

std::vector<double> in_um(std::vector<double> mm) {
  for (double& each : mm) each *= kUmPerMm;
  return mm;
}

std::vector<double> in_degrees(std::vector<double> rad) {
  for (double& each : rad) each *= kDegPerRad;
  return rad;
}

Document axes_of(const kinematics::Machine& machine, const std::vector<TestPose>& poses) {
  Document axes;
  for (const auto letter : kinematics::kAxisLetters) {
    if (machine.joint(letter) == nullptr) continue;
    std::vector<double> positions;
    for (const TestPose& pose : poses) {
      positions.push_back(pose.at.q[letter] * (is_rotary(letter) ? kDegPerRad : 1.0));
    }
    axes[std::string(1, to_char(letter))] = std::move(positions);
  }
  return axes;
}

std::vector<double> parameters_of(const instruments::MotionTest& test) {
  std::vector<double> parameters;
  for (const TestPose& pose : test.poses) parameters.push_back(pose.parameter);
  return parameters;
}

MotionAnswer answer_of(const std::string& test, const std::string& title,
                       const MotionSetup& setup) {
  Document errors;
  std::string written;
  for (const auto& entry : setup.entries) {
    errors[entry.name] = entry.written;
    written += fmt::format("{}{} = {}", written.empty() ? "" : "; ", entry.name, entry.written);
  }
  if (written.empty()) written = "no errors";
  const instruments::SetupErrors& off = setup.setup;
  const instruments::Instrument& instrument = setup.instrument;
  MotionAnswer answer{
      .document = {{"schema", "frustum/motion/1"},
                   {"version", program_version()},
                   {"test", test},
                   {"machine", setup.machine.name()},
                   {"structure", setup.machine.structure()},
                   {"tool_length_mm", setup.tool_length},
                   {"errors", errors},
                   {"setup_um", Document{{"ball", coordinates(off.ball, kUmPerMm)},
                                         {"table_ball", coordinates(off.table_ball, kUmPerMm)},
                                         {"length", off.length * kUmPerMm}}},
                   {"noise_um", instrument.noise * kUmPerMm},
                   {"resolution_um", instrument.resolution * kUmPerMm},
                   {"seed", instrument.seed}},
      .text = fmt::format("{} on {}, {}\n", title, setup.machine.name(), written)};
  const auto um = [](const Vec3& v) {
    return fmt::format("{:g}, {:g}, {:g} µm", v.x() * kUmPerMm, v.y() * kUmPerMm, v.z() * kUmPerMm);
  };
  answer.page.title = title;
  answer.page.facts = {{"Machine", setup.machine.title()},
                       {"Structure", setup.machine.structure()},
                       {"Errors", written},
                       {"Spindle ball off", um(off.ball)},
                       {"Table ball off", um(off.table_ball)},
                       {"Bar longer by", fmt::format("{:g} µm", off.length * kUmPerMm)},
                       {"Tool length", fmt::format("{:g} mm", setup.tool_length)}};
  if (instrument.noise > 0.0) {
    answer.page.facts.push_back(
        {"Noise", fmt::format("{:g} µm, seed {}", instrument.noise * kUmPerMm, instrument.seed)});
  }
  return answer;
}

void add_probing_programs(MotionAnswer& answer, const instruments::ProbingProgram& program) {
  for (const auto& [ending, dialect] :
       {std::pair{"ngc", parser::Dialect::linuxcnc}, std::pair{"nc", parser::Dialect::fanuc},
        std::pair{"mpf", parser::Dialect::sinumerik},
        std::pair{"h", parser::Dialect::heidenhain}}) {
    answer.files[fmt::format("{}.{}", program.name, ending)] = probing_text(program, dialect);
  }
  answer.files[program.name + ".a"] = probing_mask(program);
}

void add_lobes(MotionAnswer& answer, const instruments::ProbeLobes& lobes) {
  answer.document["pretravel_um"] =
      Document{{"constant", lobes.constant * kUmPerMm},
               {"lobe", lobes.amplitude * kUmPerMm},
               {"lobe_phase_deg", as_stated(lobes.phase * kDegPerRad)}};
  if (!lobes.any()) return;
  answer.page.facts.push_back(
      {"Pre-travel",
       fmt::format("{:g} µm, three lobes of {:g} µm at {:g}°", lobes.constant * kUmPerMm,
                   lobes.amplitude * kUmPerMm, as_stated(lobes.phase * kDegPerRad))});
}

void add_warnings(MotionAnswer& answer) {
  std::vector<Document> list;
  for (const Diagnostic& each : answer.warnings) {
    list.push_back({{"severity", to_string(each.severity)},
                    {"id", each.id.text()},
                    {"message", each.message},
                    {"hint", each.hint}});
  }
  answer.document["diagnostics"] = list;
}

Result<std::vector<double>> shown_by_bar(const MotionSetup& setup,
                                         const instruments::MotionTest& test, double stroke,
                                         const std::string& parameter,
                                         std::span<const Vec3> moved) {
  const kinematics::ForwardChain actual(setup.machine, setup.errors, setup.tool_length);
  const auto run = instruments::with_approach(test, setup.errors);
  auto readings = instruments::shown(setup.instrument,
                                     instruments::bar_readings(actual, run, setup.setup, moved), 0);
  if (auto problem = instruments::beyond_stroke(test, readings, stroke, parameter)) {
    return *std::move(problem);
  }
  return readings;
}

void add_told(MotionAnswer& answer, const instruments::Told& told) {
  answer.page.told = told.told;
  answer.page.not_told = told.not_told;
  answer.document["told"] = told.told;
  answer.document["not_told"] = told.not_told;
  answer.text += fmt::format(
      "told, whatever the set-up: {}\nnot told alone: {}\n",
      told.told.empty() ? "nothing" : fmt::format("{}", fmt::join(told.told, ", ")),
      told.not_told.empty() ? "nothing" : fmt::format("{}", fmt::join(told.not_told, ", ")));
}

}  // namespace frustum::app
