#include "instruments/traces/circle_trace_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/counted.hpp"
#include "instruments/traces/trace_table.hpp"

namespace frustum::instruments {
namespace {

// A step this much wider than the usual one is a gap.
constexpr double kGap = 5.0;

const std::vector<std::string>& columns() {
  static const std::vector<std::string> kColumns{"run",        "angle_deg", "time_s",   "radial_um",
                                                 "reading_um", "radial_mm", "length_mm"};
  return kColumns;
}

std::optional<Sense> sense_named(const std::string& text) {
  std::string small = text;
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const Sense sense : kSenses) {
    if (small == name_of(sense)) return sense;
  }
  return std::nullopt;
}

struct Sample {
  double place = 0.0;  // rad, or s
  double deviation = 0.0;
  int line = 0;
};
using Runs = std::map<Sense, std::vector<Sample>>;

class TraceReader {
 public:
  TraceReader(const TraceTable& table, const CircleTraceWords& words)
      : table_(table), words_(words) {}

  // Adds what the file states to what is known so far, and its runs.
  std::optional<Diagnostics> read(CircleTraces& all) {
    if (auto problem = read_notes(all)) return problem;
    if (auto problem = choose_columns(all)) return Diagnostics{*std::move(problem)};
    Runs runs;
    if (auto problem = read_rows(all.length, runs)) return problem;
    for (auto& [sense, samples] : runs) {
      if (by_time_ && !spread(sense, samples)) continue;
      check(sense, samples);
      for (const CircleTrace& other : all.traces) {
        if (other.sense != sense) continue;
        problems_.push_back(table_.placed(
            error("given-twice"_id, fmt::format("there is a second {} run", name_of(sense)),
                  "a circular test has one run of either sense"),
            samples.front().line));
      }
      CircleTrace trace{.sense = sense};
      for (const Sample& each : samples) {
        trace.angle.push_back(each.place);
        trace.deviation.push_back(each.deviation);
      }
      all.traces.push_back(std::move(trace));
    }
    if (!problems_.empty()) return problems_;
    return std::nullopt;
  }

 private:
  // A number that the file states must be that of the words and of other files.
  std::optional<Diagnostics> agree(std::string_view key, std::optional<double>& known) {
    const auto stated = table_.number_note(key);
    if (!stated) return stated.error();
    if (!*stated) return std::nullopt;
    if (known && std::abs(*known - **stated) > 1e-6) {
      return Diagnostics{table_.placed(
          error("contradiction"_id,
                fmt::format("the file states {} {:g}, else {:g}", key, **stated, *known)),
          table_.note(key)->line)};
    }
    known = **stated;
    return std::nullopt;
  }

  std::optional<Diagnostics> read_notes(CircleTraces& all) {
    std::optional<double> length = all.length > 0.0 ? std::optional(all.length) : words_.length;
    if (auto problem = agree("radius", length)) return problem;
    if (auto problem = agree("feed", all.feed)) return problem;
    if (auto problem = agree("temperature", all.temperature)) return problem;
    if (length) all.length = *length;
    const auto plane = table_.note("plane");
    if (!plane) return std::nullopt;
    const auto named = plane_named(plane->value);
    if (!named) {
      return Diagnostics{table_.placed(
          error("unknown-choice"_id, fmt::format("'{}' is no plane", plane->value), "XY, YZ, ZX"),
          plane->line)};
    }
    if (words_.plane && *words_.plane != *named) {
      return Diagnostics{table_.placed(
          error("contradiction"_id, fmt::format("the file states plane {}, the command {}",
                                                name_of(*named), name_of(*words_.plane))),
          plane->line)};
    }
    all.plane = *named;
    return std::nullopt;
  }

  std::optional<Diagnostic> choose_columns(const CircleTraces& all) {
    const auto one_of = [&](std::vector<std::string> names, std::string& chosen) {
      const auto count = std::ranges::count_if(names, [&](const std::string& name) {
        if (!table_.has(name)) return false;
        chosen = name;
        return true;
      });
      return count == 1
                 ? std::optional<Diagnostic>{}
                 : table_.placed(error("missing-column"_id,
                                       fmt::format("expected one of the columns {}, found {}",
                                                   fmt::join(names, ", "), count)),
                                 table_.header_line());
    };
    if (auto problem = one_of({"angle_deg", "time_s"}, place_)) return problem;
    if (auto problem = one_of({"radial_um", "reading_um", "radial_mm", "length_mm"}, reading_))
      return problem;
    by_time_ = place_ == "time_s";
    if (reading_ == "length_mm" && !(all.length > 0.0)) {
      return table_.placed(error("length-unknown"_id, "lengths need the nominal length of the bar",
                                 "give --length, or a comment \"# radius 150\""),
                           table_.header_line());
    }
    const auto run = table_.note("run");
    if (run) run_ = sense_named(run->value);
    if (run && !run_) {
      return table_.placed(
          error("unknown-choice"_id, fmt::format("'{}' is no run", run->value), "ccw, cw"),
          run->line);
    }
    if (run_ || table_.has("run")) return std::nullopt;
    if (words_.sense_may_be_missing) {
      run_ = rises() ? Sense::ccw : Sense::cw;
      return std::nullopt;
    }
    return table_.placed(error("run-unknown"_id, "the file does not say in which sense it was run",
                               "add a column run with ccw or cw, or a comment \"# run ccw\""),
                         table_.header_line());
  }

  [[nodiscard]] bool rises() const {
    if (by_time_ || table_.rows() < 2) return true;
    const auto first = table_.number(0, place_), last = table_.number(table_.rows() - 1, place_);
    return !first || !last || *last >= *first;
  }

  std::optional<Diagnostics> read_rows(double length, Runs& runs) {
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      std::optional<Sense> sense = run_;
      if (table_.has("run")) {
        sense = sense_named(table_.text(row, "run"));
        if (!sense) {
          return Diagnostics{table_.placed(
              error("unknown-choice"_id, fmt::format("'{}' is no run", table_.text(row, "run")),
                    "ccw, cw"),
              table_.line(row))};
        }
      }
      const auto place = table_.number(row, place_);
      if (!place) return place.error();
      const auto reading = table_.number(row, reading_);
      if (!reading) return reading.error();
      const double deviation = reading_.ends_with("_um") ? *reading / kUmPerMm
                               : reading_ == "length_mm" ? *reading - length
                                                         : *reading;
      if (std::abs(deviation) > words_.stroke) {
        return Diagnostics{table_.placed(
            error("stroke-exceeded"_id,
                  fmt::format("{} = {:g} is {:g} mm from the nominal length, beyond the stroke of "
                              "{:g} mm",
                              reading_, *reading, deviation, words_.stroke),
                  "check the unit of the column and the length of the bar"),
            table_.line(row))};
      }
      runs[*sense].push_back({*place * (by_time_ ? 1.0 : kRadPerDeg), deviation, table_.line(row)});
    }
    return std::nullopt;
  }

  // Times to angles, evenly over the capture arc; false where they do not rise.
  bool spread(Sense sense, std::vector<Sample>& samples) {
    const double first = samples.front().place, last = samples.back().place;
    const auto& arc = words_.capture;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      if (samples[i].place > samples[i - 1].place) continue;
      problems_.push_back(table_.placed(
          error("times-fall"_id, fmt::format("time {:g} s follows {:g} s: times must rise",
                                             samples[i].place, samples[i - 1].place)),
          samples[i].line));
      return false;
    }
    if (samples.size() < 3) return true;  // which check() tells
    for (Sample& each : samples) {
      const double share = (each.place - first) / (last - first);
      each.place =
          sense == Sense::ccw ? arc.lo + share * arc.width() : arc.hi - share * arc.width();
    }
    return true;
  }

  void check(Sense sense, const std::vector<Sample>& samples) {
    if (samples.size() < 3) {
      problems_.push_back(
          table_.placed(error("too-few-samples"_id,
                              fmt::format("the {} run has {}, expected 3 or more", name_of(sense),
                                          counted(samples.size(), "sample"))),
                        samples.front().line));
      return;
    }
    std::vector<double> steps;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      steps.push_back(sign_of(sense) * (samples[i].place - samples[i - 1].place));
    }
    std::vector<double> sorted = steps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double usual = std::abs(*middle);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double from = samples[i].place * kDegPerRad, to = samples[i + 1].place * kDegPerRad;
      if (!(steps[i] > 0.0)) {
        problems_.push_back(table_.placed(
            error("angles-fall-back"_id,
                  fmt::format("angle {:g} deg follows {:g} deg in a {} run", to, from,
                              name_of(sense)),
                  sense == Sense::ccw ? "angles of a ccw run rise; those of a cw run fall"
                                      : "angles of a cw run fall; those of a ccw run rise"),
            samples[i + 1].line));
        return;
      }
      if (steps[i] > kGap * usual) {
        problems_.push_back(table_.placed(
            error("trace-gap"_id,
                  fmt::format("no samples between {:g} and {:g} deg, the usual step is {:.3g} deg",
                              from, to, usual * kDegPerRad),
                  "measure the run again, or leave the arc before or after the gap out"),
            samples[i + 1].line));
      }
    }
  }

  const TraceTable& table_;
  const CircleTraceWords& words_;
  std::string place_{}, reading_{};
  bool by_time_ = false;
  std::optional<Sense> run_{};
  Diagnostics problems_{};
};

}  // namespace

Result<CircleTraces> read_circle_traces(std::span<const std::filesystem::path> files,
                                        const CircleTraceWords& words) {
  CircleTraces all;
  if (words.plane) all.plane = *words.plane;
  if (words.length) all.length = *words.length;
  for (const auto& file : files) {
    const auto table = TraceTable::read(file, columns());
    if (!table) return table.error();
    if (auto problems = TraceReader(*table, words).read(all)) return *std::move(problems);
  }
  if (!(all.length > 0.0)) {
    return error("length-unknown"_id, "the nominal length of the bar is not known",
                 "give --length, or a comment \"# radius 150\" in the file");
  }
  std::ranges::sort(all.traces, {}, &CircleTrace::sense);
  return all;
}

}  // namespace frustum::instruments
