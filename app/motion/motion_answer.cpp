#include "app/motion/motion_answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

std::string shown_um(double mm, const report::Wording& words, int decimals) {
  // A microinch is a fortieth of a micrometre.
  const int shown = words.is_inch() ? std::max(decimals - 1, 0) : decimals;
  return words.number(fixed_decimal(words.shown(mm * kUmPerMm, "um"), shown));
}

std::vector<double> drawn_um(std::vector<double> mm, const report::Wording& words) {
  for (double& each : mm) each = words.shown(each * kUmPerMm, "um");
  return mm;
}

const char* between(const report::Wording& words) {
  return words.decimal_sign() == ',' ? "; " : ", ";
}

std::string um_amounts(const Vec3& um, const report::Wording& words) {
  const auto one = [&](double value) { return words.general(words.shown(value, "um")); };
  return one(um.x()) + between(words) + one(um.y()) + between(words) + one(um.z()) + " " +
         words.symbol("um");
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
  const report::Wording& words = setup.words;
  if (written.empty()) written = words("no errors");
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
      .text = words("{0} on {1}, {2}", title, setup.machine.name(), written) + "\n",
      .words = words};
  answer.page.style = words.style();
  answer.page.title = title;
  answer.page.facts = {{words("Machine"), setup.machine.title()},
                       {words("Structure"), setup.machine.structure()},
                       {words("Errors"), written},
                       {words("Spindle ball off"), um_amounts(off.ball * kUmPerMm, words)},
                       {words("Table ball off"), um_amounts(off.table_ball * kUmPerMm, words)},
                       {words("Bar longer by"), words.amount(off.length * kUmPerMm, "um")},
                       {words("Tool length"), words.amount(setup.tool_length, "mm")}};
  if (instrument.noise > 0.0) {
    answer.page.facts.push_back(
        {words("Noise"),
         words("{0}, seed {1}", words.amount(instrument.noise * kUmPerMm, "um"), instrument.seed)});
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
  const report::Wording& words = answer.words;
  answer.page.facts.push_back(
      {words("Pre-travel"),
       words("{0}, three lobes of {1} at {2}°", words.amount(lobes.constant * kUmPerMm, "um"),
             words.amount(lobes.amplitude * kUmPerMm, "um"),
             words.general(as_stated(lobes.phase * kDegPerRad)))});
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
  answer.document["told"] = told.told;
  answer.document["not_told"] = told.not_told;
  const report::Wording& words = answer.words;
  // "EA0A + 1.96834 EB0A" has numbers.
  const auto shown = [&](std::vector<std::string> names) {
    for (std::string& each : names) each = words.number(std::move(each));
    return names;
  };
  answer.page.told = shown(told.told);
  answer.page.not_told = shown(told.not_told);
  const auto list = [&](const std::vector<std::string>& names) {
    return names.empty() ? words("nothing") : fmt::format("{}", fmt::join(names, between(words)));
  };
  answer.text += words("identified, whatever the set-up: {0}", list(answer.page.told)) + "\n" +
                 words("not identified alone: {0}", list(answer.page.not_told)) + "\n";
}

}  // namespace frustum::app
