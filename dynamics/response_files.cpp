#include "dynamics/response_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/counted.hpp"
#include "core/made_by.hpp"
#include "core/text_words.hpp"
#include "core/whole_file.hpp"
#include "dynamics/response_units.hpp"

namespace frustum::dynamics {
namespace {

using Complex = std::complex<double>;
using Responses = std::vector<FrequencyResponse>;

constexpr double kMicrometres = 1e6;
constexpr std::string_view kDirections = "xyz";

bool is_even(const std::vector<double>& frequencies) {
  if (frequencies.size() < 2) return false;
  const double step = frequencies[1] - frequencies[0];
  for (std::size_t i = 2; i < frequencies.size(); ++i) {
    if (std::abs(frequencies[i] - frequencies[0] - static_cast<double>(i) * step) > 1e-9 * step)
      return false;
  }
  return true;
}

std::string axis_record(int type, std::string_view label, std::string_view unit) {
  return fmt::format("{:>10}{:>5}{:>5}{:>5} {:<20} {:<20}\n", type, 0, 0, 0, label, unit);
}

std::string dataset_58(const FrequencyResponse& r, std::string_view title) {
  const bool even = is_even(r.frequencies);
  std::string text = fmt::format("    -1\n    58\n{:.80}\n{}\nNONE\n{:.80}\nNONE\n", title,
                                 "compliance of the tip, " + r.name(), made_by());
  text += fmt::format("{:>5}{:>10}{:>5}{:>10} {:<10}{:>10}{:>4} {:<10}{:>10}{:>4}\n", 4, 0, 0, 0,
                      "TIP", 1, r.motion + 1, "TIP", 1, r.force + 1);
  const double first = r.frequencies.empty() ? 0.0 : r.frequencies.front();
  const double step = even ? r.frequencies[1] - first : 0.0;
  text += fmt::format("{:>10}{:>10}{:>10}{:>13.5E}{:>13.5E}{:>13.5E}\n", 6, r.frequencies.size(),
                      even ? 1 : 0, first, step, 0.0);
  text += axis_record(18, "Frequency", "Hz") + axis_record(8, "Displacement", "m") +
          axis_record(13, "Force", "N") + axis_record(0, "NONE", "NONE");
  for (std::size_t i = 0; i < r.compliance.size(); ++i) {
    const Complex& g = r.compliance[i];
    if (even) {
      text += fmt::format("{:>20.12E}{:>20.12E}{}", g.real(), g.imag(),
                          i % 2 == 1 || i + 1 == r.compliance.size() ? "\n" : "");
    } else {
      text += fmt::format("{:>13.5E}{:>20.12E}{:>20.12E}\n", r.frequencies[i], g.real(), g.imag());
    }
  }
  return text + "    -1\n";
}

// --- reading ---------------------------------------------------------------------------------

struct Place {
  const std::filesystem::path& file;
  [[nodiscard]] Diagnostic fault(int line, std::string message, std::string hint) const {
    Diagnostic problem = error("response-file"_id, std::move(message), std::move(hint));
    problem.file = file.string();
    problem.line = line;
    return problem;
  }
};

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string_view field(std::string_view line, std::size_t at, std::size_t width) {
  return at < line.size() ? trimmed(line.substr(at, width)) : std::string_view{};
}

// Fortran writes exponents with D, too.
std::optional<double> number_of(std::string_view word) {
  std::string plain(word);
  for (char& c : plain) {
    if (c == 'D' || c == 'd') c = 'E';
  }
  return finite_number_in_word(plain);
}

std::optional<std::string> why_not_rising(const std::vector<double>& frequencies) {
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    if (!(frequencies[i] >= 0.0) || (i > 0 && !(frequencies[i] > frequencies[i - 1]))) {
      return fmt::format("the frequency {:g} Hz does not rise", frequencies[i]);
    }
  }
  return std::nullopt;
}

// N and m for one of a file that labels no units: dataset 164 states by what SI is multiplied.
struct FileUnits {
  double length = 1.0;
  double force = 1.0;
};

// A response, and the nodes between which it was measured.
struct NodalResponse {
  FrequencyResponse response{};
  std::string nodes{};
  int line = 0;
};

// One dataset 58, from the line after its number.
class Dataset58 {
 public:
  Dataset58(const std::vector<std::string_view>& lines, std::size_t first, const Place& place,
            const FileUnits& units)
      : lines_(lines), first_(first), place_(place), units_(units) {}

  // Time signals, spectra and coherences are beside the responses in the same file, and so are
  // rotations.
  [[nodiscard]] std::optional<Diagnostic> missing() const {
    if (first_ + kData <= lines_.size()) return std::nullopt;
    return fault(0, "the dataset 58 ends too soon");
  }
  [[nodiscard]] bool is_response() const {
    return field(lines_[first_ + kDirectionLine], 0, 5) == "4" && direction(51) && direction(76);
  }

  [[nodiscard]] Result<NodalResponse> read() const {
    const int motion = *direction(51), force = *direction(76);
    FrequencyResponse response{std::abs(motion) - 1, std::abs(force) - 1, {}, {}};
    auto values = numbers();
    if (!values) return values.error();
    const auto unit = motion_unit(type_of(kOrdinate), label_of(kOrdinate), units_.length);
    if (!unit) {
      return fault(kOrdinate, fmt::format("the ordinate of type {} in '{}' is no displacement, "
                                          "velocity or acceleration in a unit that is known",
                                          type_of(kOrdinate), label_of(kOrdinate)));
    }
    const auto newton = force_unit(type_of(kDenominator), label_of(kDenominator), units_.force);
    if (!newton) {
      return fault(kDenominator,
                   fmt::format("what the response is divided by, of type {} in '{}', is no force "
                               "in a unit that is known",
                               type_of(kDenominator), label_of(kDenominator)));
    }
    const double sign = (motion < 0) == (force < 0) ? 1.0 : -1.0;
    for (const auto& [frequency, value] : *values) {
      const Complex derivative = std::pow(Complex(0.0, kTurn * frequency), unit->order);
      if (derivative == 0.0) continue;  // a velocity at rest says nothing of the displacement
      response.frequencies.push_back(frequency);
      response.compliance.push_back(sign * unit->si / *newton * value / derivative);
    }
    if (const auto why = why_not_rising(response.frequencies)) return fault(kData, *why);
    return NodalResponse{std::move(response),
                         fmt::format("{} and {}", field(lines_[first_ + kDirectionLine], 41, 10),
                                     field(lines_[first_ + kDirectionLine], 66, 10)),
                         static_cast<int>(first_ + kDirectionLine + 1)};
  }

 private:
  // Lines of the dataset.
  static constexpr std::size_t kDirectionLine = 5, kForm = 6, kOrdinate = 8, kDenominator = 9,
                               kData = 11;

  [[nodiscard]] Diagnostic fault(std::size_t line, std::string message) const {
    return place_.fault(static_cast<int>(first_ + line + 1), std::move(message),
                        "a universal file, dataset 58, of frequency responses: m, mm, um, m/s, "
                        "m/s^2 or g for N");
  }
  [[nodiscard]] std::optional<int> direction(std::size_t at) const {
    const auto value = number_in_word<int>(field(lines_[first_ + kDirectionLine], at, 4));
    return value && *value != 0 && std::abs(*value) <= 3 ? value : std::nullopt;
  }
  [[nodiscard]] int type_of(std::size_t line) const {
    return number_in_word<int>(field(lines_[first_ + line], 0, 10)).value_or(-1);
  }
  [[nodiscard]] std::string_view label_of(std::size_t line) const {
    return field(lines_[first_ + line], 47, 20);
  }

  struct Line {
    double frequency = 0.0;
    Complex value{};
  };
  [[nodiscard]] Result<std::vector<Line>> numbers() const {
    const std::string_view form = lines_[first_ + kForm];
    const auto type = number_in_word<int>(field(form, 0, 10));
    const auto count = number_in_word<int>(field(form, 10, 10));
    const auto even = number_in_word<int>(field(form, 20, 10));
    const auto from = number_of(field(form, 30, 13)), step = number_of(field(form, 43, 13));
    constexpr int kMost = 10'000'000;
    if (!type || (*type != 5 && *type != 6) || !count || *count < 1 || *count > kMost || !even ||
        !from || !step) {
      return fault(kForm, "the data are no complex numbers with a known spacing");
    }
    const std::size_t width = *type == 6 ? 20 : 13;
    const std::size_t wanted = static_cast<std::size_t>(*count) * (*even == 1 ? 2 : 3);
    std::vector<double> values;
    for (std::size_t k = kData; values.size() < wanted; ++k) {
      if (first_ + k >= lines_.size() || trimmed(lines_[first_ + k]) == "-1") {
        return fault(k, fmt::format("{} missing", counted(wanted - values.size(), "number")));
      }
      const std::string_view line = lines_[first_ + k];
      for (std::size_t at = 0;
           !trimmed(line.substr(std::min(at, line.size()))).empty() && values.size() < wanted;) {
        const bool abscissa = *even != 1 && values.size() % 3 == 0;
        const std::size_t wide = abscissa ? 13 : width;
        const auto value = number_of(field(line, at, wide));
        if (!value) return fault(k, fmt::format("'{}' is not a number", field(line, at, wide)));
        values.push_back(*value);
        at += wide;
      }
    }
    std::vector<Line> found;
    for (std::size_t i = 0; i < static_cast<std::size_t>(*count); ++i) {
      if (*even == 1) {
        found.push_back(
            {*from + static_cast<double>(i) * *step, {values[2 * i], values[2 * i + 1]}});
      } else {
        found.push_back({values[3 * i], {values[3 * i + 1], values[3 * i + 2]}});
      }
    }
    return found;
  }

  const std::vector<std::string_view>& lines_;
  std::size_t first_;
  const Place& place_;
  FileUnits units_;
};

std::optional<FileUnits> units_in(const std::vector<std::string_view>& lines, std::size_t first) {
  if (first + 1 >= lines.size()) return std::nullopt;
  const auto length = number_of(field(lines[first + 1], 0, 25));
  const auto force = number_of(field(lines[first + 1], 25, 25));
  if (!length || !force || !(*length > 0.0) || !(*force > 0.0)) return std::nullopt;
  return FileUnits{1.0 / *length, 1.0 / *force};
}

Result<Responses> read_universal(const std::vector<std::string_view>& lines, const Place& place) {
  FileUnits units;
  std::vector<NodalResponse> found;
  int others = 0, binary = 0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (trimmed(lines[i]) != "-1") continue;
    const std::string_view number = trimmed(lines[i + 1]);
    if (number.starts_with("58b")) ++binary;
    if (number == "164") {
      const auto stated = units_in(lines, i + 2);
      if (!stated) {
        return place.fault(static_cast<int>(i + 4), "the dataset 164 states no units",
                           "two numbers above 0 by which m and N are multiplied");
      }
      units = *stated;
    }
    if (number != "58") continue;
    const Dataset58 dataset(lines, i + 2, place, units);
    if (auto problem = dataset.missing()) return *std::move(problem);
    if (!dataset.is_response()) {
      ++others;
      continue;
    }
    auto response = dataset.read();
    if (!response) return response.error();
    found.push_back(*std::move(response));
  }
  if (found.empty() && others + binary > 0) {
    return place.fault(
        0,
        fmt::format("there is no frequency response in this file, but {} of another function or "
                    "without directions X, Y, Z, and {} in binary",
                    others, binary),
        "export frequency responses (type 4) as text, dataset 58");
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (found[k].response.name() != found[i].response.name()) continue;
      return place.fault(found[i].line,
                         fmt::format("{} is there twice, of the nodes {} and of the nodes {}",
                                     found[i].response.name(), found[k].nodes, found[i].nodes),
                         "keep the responses of the tip alone");
    }
  }
  Responses responses;
  for (NodalResponse& each : found) responses.push_back(std::move(each.response));
  return responses;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = std::min(line.find(','), line.size());
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.size()) return cells;
    line.remove_prefix(comma + 1);
  }
}

// Columns of the real part; that of the imaginary part follows.
struct CsvColumn {
  std::size_t at = 0;
  FrequencyResponse response{};
};

Result<Responses> read_csv(const std::vector<std::string_view>& lines, const Place& place) {
  const std::string hint = "a first line frequency_hz,Gxx_re,Gxx_im,.. and numbers in Hz and um/N";
  std::vector<CsvColumn> columns;
  std::size_t width = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int number = static_cast<int>(i + 1);
    if (trimmed(lines[i]).empty() || trimmed(lines[i]).front() == '#') continue;
    const auto cells = cells_of(lines[i]);
    if (width == 0) {
      width = cells.size();
      for (std::size_t k = 1; k + 1 < cells.size(); k += 2) {
        const std::string_view name = cells[k];
        const auto motion = name.size() > 2 ? kDirections.find(name[1]) : std::string_view::npos;
        const auto force = name.size() > 2 ? kDirections.find(name[2]) : std::string_view::npos;
        const bool known = name.size() == 6 && name[0] == 'G' && name.ends_with("_re") &&
                           motion != std::string_view::npos && force != std::string_view::npos &&
                           cells[k + 1] == std::string(name.substr(0, 3)) + "_im";
        if (!known) {
          return place.fault(
              number, fmt::format("'{}' and '{}' are no response", name, cells[k + 1]), hint);
        }
        columns.push_back(
            {k, {static_cast<Eigen::Index>(motion), static_cast<Eigen::Index>(force), {}, {}}});
      }
      if (cells[0] != "frequency_hz" || columns.empty() || width != 1 + 2 * columns.size()) {
        return place.fault(number, "the first line names no frequency and responses", hint);
      }
      continue;
    }
    std::vector<double> values;
    for (const std::string_view cell : cells) {
      const auto value = finite_number_in_word(cell);
      if (!value) return place.fault(number, fmt::format("'{}' is not a number", cell), hint);
      values.push_back(*value);
    }
    if (values.size() != width) {
      return place.fault(
          number, fmt::format("{}, expected {}", counted(values.size(), "cell"), width), hint);
    }
    for (CsvColumn& column : columns) {
      column.response.frequencies.push_back(values[0]);
      column.response.compliance.emplace_back(values[column.at] / kMicrometres,
                                              values[column.at + 1] / kMicrometres);
    }
  }
  Responses responses;
  for (CsvColumn& column : columns) {
    if (const auto why = why_not_rising(column.response.frequencies)) {
      return place.fault(0, *why, hint);
    }
    if (!column.response.frequencies.empty()) responses.push_back(std::move(column.response));
  }
  return responses;
}

}  // namespace

std::string FrequencyResponse::name() const {
  return fmt::format("G{}{}", kDirections[static_cast<std::size_t>(motion)],
                     kDirections[static_cast<std::size_t>(force)]);
}

std::string universal_file(std::span<const FrequencyResponse> responses, std::string_view title) {
  std::string text;
  for (const FrequencyResponse& r : responses) text += dataset_58(r, title);
  return text;
}

std::string response_csv(std::span<const FrequencyResponse> responses) {
  std::string text = "frequency_hz";
  for (const FrequencyResponse& r : responses) {
    text += fmt::format(",{0}_re,{0}_im", r.name());
  }
  text += '\n';
  const std::size_t count = responses.empty() ? 0 : responses.front().frequencies.size();
  for (std::size_t i = 0; i < count; ++i) {
    text += fmt::format("{}", responses.front().frequencies[i]);
    for (const FrequencyResponse& r : responses) {
      text += fmt::format(",{},{}", r.compliance[i].real() * kMicrometres,
                          r.compliance[i].imag() * kMicrometres);
    }
    text += '\n';
  }
  return text;
}

Result<Responses> read_responses(std::string_view text, const std::filesystem::path& file) {
  const Place place{file};
  const auto lines = lines_of(text);
  const bool universal =
      std::ranges::any_of(lines, [](std::string_view line) { return trimmed(line) == "-1"; });
  auto responses = universal ? read_universal(lines, place) : read_csv(lines, place);
  if (responses && responses->empty()) {
    return place.fault(0, "there is no frequency response in this file",
                       "a universal file with dataset 58, or CSV: frequency_hz,Gxx_re,Gxx_im");
  }
  return responses;
}

Result<Responses> load_responses(const std::filesystem::path& file) {
  return read_whole_file(file).and_then(
      [&](const std::string& text) { return read_responses(text, file); });
}

}  // namespace frustum::dynamics
