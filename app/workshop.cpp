#include "app/workshop.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "app/console.hpp"
#include "app/job.hpp"
#include "app/machine_files.hpp"
#include "core/spelling.hpp"
#include "trials/trial.hpp"

namespace frustum::app {
namespace {

// "5=120.5"
Result<std::pair<std::string, std::string>> halves_of(const std::string& text, const char* what,
                                                      const char* example) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos && equals > 0) {
    return std::pair{text.substr(0, equals), text.substr(equals + 1)};
  }
  return error(fmt::format("{} {}: expected {}", what, text, example));
}

std::optional<Diagnostic> add_tool_length(const std::string& text, kinematics::Setup& setup) {
  const auto halves = halves_of(text, "--tool-length", "NUMBER=LENGTH, for example 1=150");
  if (!halves) return halves.error().front();
  const auto number = numbers_of(halves->first, 1, "--tool-length");
  const auto length = numbers_of(halves->second, 1, "--tool-length");
  if (!number) return number.error().front();
  if (!length) return length.error().front();
  const double n = number->front();
  if (!(n >= 1.0 && n <= 99999.0 && n == std::floor(n))) {
    return error(fmt::format("--tool-length {}: a tool is named by its number", text),
                 "1 to 99999");
  }
  if (!(length->front() >= 0.0)) {
    return error(fmt::format("--tool-length {}: a length is not negative", text),
                 "mm from the spindle's gauge point to the tip");
  }
  setup.tools[static_cast<int>(n)].length = length->front();
  return std::nullopt;
}

std::optional<Diagnostic> add_offset(const std::string& text, kinematics::Setup& setup) {
  const auto halves = halves_of(text, "--offset", "G54=X,Y,Z in mm");
  if (!halves) return halves.error().front();
  for (int number = 1; number <= 6; ++number) {
    if (halves->first != fmt::format("G{}", 53 + number)) continue;
    const auto origin = numbers_of(halves->second, 3, "--offset");
    if (!origin) return origin.error().front();
    setup.work_offsets[number] = Vec3((*origin)[0], (*origin)[1], (*origin)[2]);
    return std::nullopt;
  }
  return error(fmt::format("--offset {}: no such work offset", halves->first), "G54 to G59");
}

}  // namespace

Result<Workshop> workshop_of(const WorkshopWords& words) {
  kinematics::Setup setup;
  std::optional<kinematics::Machine> machine;
  if (!words.job.empty()) {
    auto job = load_job(words.job, {}, false);
    if (!job) return job.error();
    setup = trials::setup_of(job->piece);
    machine = job->machine;
  } else {
    // The table's own origin is what a program without a setup sheet means.
    setup.work_offsets[1] = Vec3::Zero();
  }
  for (const std::string& text : words.tool_lengths) {
    if (auto problem = add_tool_length(text, setup)) return *problem;
  }
  for (const std::string& text : words.offsets) {
    if (auto problem = add_offset(text, setup)) return *problem;
  }
  if (!words.machine.empty()) {
    auto loaded = load_machine(words.machine, ".");
    if (!loaded) return loaded.error();
    machine = *std::move(loaded);
  }
  if (!machine) return error("no machine", "name one with --machine, or a job with --job");
  return Workshop{*std::move(machine), std::move(setup)};
}

}  // namespace frustum::app
