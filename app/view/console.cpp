#include "app/view/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <iostream>
#include <system_error>

namespace frustum::app {

int refuse(const Diagnostics& diagnostics) {
  print(std::cerr, diagnostics);
  return kBadInput;
}

int refuse(const std::string& message, const std::string& hint) {
  return refuse(Diagnostics{error(message, hint)});
}

report::ProgressStyle progress_style(bool quiet) {
  if (quiet) return report::ProgressStyle::silent;
  return isatty(STDERR_FILENO) != 0 ? report::ProgressStyle::bar : report::ProgressStyle::log;
}

bool stdout_is_terminal() { return isatty(STDOUT_FILENO) != 0; }

Result<std::vector<double>> numbers_of(const std::string& text, std::size_t count,
                                       const std::string& what) {
  std::vector<double> numbers;
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::size_t first = std::min(text.find_first_not_of(' ', start), comma);
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data() + first, text.data() + comma, value);
    const bool whole =
        std::string_view(end, text.data() + comma).find_first_not_of(' ') == std::string_view::npos;
    if (status != std::errc{} || !whole || !std::isfinite(value)) {
      return error(
          fmt::format("'{}' in {} is not a number", text.substr(start, comma - start), what),
          fmt::format("expected {} numbers separated by commas", count));
    }
    numbers.push_back(value);
    start = comma + 1;
  }
  if (numbers.size() != count) {
    return error(fmt::format("{} has {} numbers, expected {}", what, numbers.size(), count));
  }
  return numbers;
}

Result<std::filesystem::path> output_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!problem && std::filesystem::is_directory(folder, problem)) return folder;
  Diagnostic failure = error("the output folder cannot be made", problem ? problem.message() : "");
  failure.file = folder.string();
  return failure;
}

}  // namespace frustum::app
