// Frequency responses: magnitude on a logarithmic scale above phase, several motions for one force.
//
// Units: Hz, the unit that the title names, degrees. Errors: none; values that are not above 0 or
// not finite break a line, nothing is drawn of less than two frequencies.
#pragma once

#include <string>
#include <vector>

namespace frustum::report {

struct FrequencyLine {
  std::string name{};
  std::vector<double> frequency{};
  std::vector<double> magnitude{};
  std::vector<double> phase{};
  bool dashed = false;  // measured
};

struct FrequencyChart {
  std::string title{};
  std::string unit{};
  std::vector<FrequencyLine> lines{};  // dashed ones have the colour of the line of their name
  // Below it a test tells nothing; of the first line's frequencies, empty for none.
  std::vector<double> floor{};
};

[[nodiscard]] std::string frequency_figure(const FrequencyChart& chart);

}  // namespace frustum::report
