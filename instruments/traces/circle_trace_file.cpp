#include "instruments/traces/circle_trace_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/constants.hpp"
#include "core/counted.hpp"
#include "core/decimal.hpp"
#include "instruments/traces/trace_table.hpp"

namespace frustum::instruments {
namespace {

// A step this much wider than the usual one is a gap.
constexpr double kGap = 5.0;
// Of the stroke: a run reads micrometres; the bar comes in from 1.5 mm.
constexpr double kOutside = 0.2;
// Overshoot of our programs.
constexpr double kHalfTurn = 180.0 * kRadPerDeg, kSlight = 2.0 * kRadPerDeg;

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
    plane_ = all.plane;
    length_ = all.length;
    feed_ = all.feed;
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
  std::optional<Diagnostics> agree(std::string_view key, const std::vector<std::string>& units,
                                   std::optional<double>& known) {
    const auto stated = table_.number_note(key, units);
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
    if (auto problem = agree("radius", {"mm"}, length)) return problem;
    if (auto problem = agree("feed", {"mm/min"}, all.feed)) return problem;
    if (auto problem = agree("temperature", {"degC", "°C", "C"}, all.temperature)) return problem;
    if (length) all.length = *length;
    const auto plane = table_.note("plane");
    if (!plane) return std::nullopt;
    const auto named = plane_named(plane->value);
    if (!named) {
      return Diagnostics{table_.placed(
          error("unknown-choice"_id, fmt::format("'{}' is no plane", plane->value), "XY, YZ, ZX"),
          plane->line)};
    }
    if (words_.of_rotary_axis) {
      return Diagnostics{table_.placed(
          error("contradiction"_id,
                fmt::format("the file is of a circle in plane {}, the test turns a rotary axis",
                            name_of(*named)),
                "give the trace of this test"),
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
    const bool of_times = words_.marks || words_.capture.lo != CircleTraceWords{}.capture.lo ||
                          words_.capture.hi != CircleTraceWords{}.capture.hi;
    if (!by_time_ && of_times) {
      return table_.placed(error("angles-stated"_id,
                                 "the file has angles: --angle feed, --overshoot and --capture are "
                                 "of recordings by time",
                                 "leave them out, or give a column time_s"),
                           table_.header_line());
    }
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
    if (words_.of_rotary_axis) {
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
      // Outside are the feed-in and the feed-out.
      if (!words_.marks && std::abs(deviation) > words_.stroke) {
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
    if (words_.marks) return spread_between_marks(sense, samples);
    if (comes_in_and_goes_out(samples)) {
      problems_.push_back(table_.placed(
          error(
              "marks-in-recording"_id,
              fmt::format("the {} run begins {:g} mm and ends {:g} mm from the nominal length, as "
                          "a bar that comes in and goes out",
                          name_of(sense), samples.front().deviation, samples.back().deviation),
              "angle feed finds the circle between feed-in and feed-out; or leave their samples "
              "out"),
          samples.front().line));
      return false;
    }
    for (Sample& each : samples) {
      const double share = (each.place - first) / (last - first);
      each.place =
          sense == Sense::ccw ? arc.lo + share * arc.width() : arc.hi - share * arc.width();
    }
    return true;
  }

  // The recording is longer than the circle: outside at both ends, inside all the way between.
  [[nodiscard]] bool comes_in_and_goes_out(const std::vector<Sample>& samples) const {
    const auto is_outside = [&](const Sample& each) {
      return std::abs(each.deviation) > kOutside * words_.stroke;
    };
    const auto tenth = static_cast<std::ptrdiff_t>(samples.size() / 10);
    return is_outside(samples.front()) && is_outside(samples.back()) && tenth > 0 &&
           std::none_of(samples.begin() + tenth, samples.end() - tenth, is_outside);
  }

  // When the bar has come in: where the ramp of samples outside, `first` to `last`, would be at the
  // nominal length. Nothing where they are no ramp.
  static std::optional<double> time_of_mark(const std::vector<Sample>& samples, std::size_t first,
                                            std::size_t last) {
    double n = 0.0, t = 0.0, d = 0.0, tt = 0.0, td = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const double time = samples[i].place - samples[first].place;
      n += 1.0;
      t += time;
      d += samples[i].deviation;
      tt += time * time;
      td += time * samples[i].deviation;
    }
    const double slope = (n * td - t * d) / (n * tt - t * t);
    if (!(n >= 3.0) || !(std::abs(slope) > 0.0) || !std::isfinite(slope)) return std::nullopt;
    return samples[first].place + (t - d / slope) / n;
  }

  // Of a recording from before the feed-in to after the feed-out: times to angles, evenly over
  // capture and overshoot; what is not of the capture is left out.
  bool spread_between_marks(Sense sense, std::vector<Sample>& samples) {
    const double outside = kOutside * words_.stroke;
    const auto in_run = [&](const Sample& each) { return std::abs(each.deviation) <= outside; };
    const auto begin = std::ranges::find_if(samples, in_run);
    const auto end = std::find_if(samples.rbegin(), samples.rend(), in_run).base();
    if (begin == samples.end()) {
      problems_.push_back(table_.placed(
          error("stroke-exceeded"_id,
                fmt::format("the {} run never comes within {:g} mm of the nominal length",
                            name_of(sense), outside),
                "check --length and the unit of the column"),
          samples.front().line));
      return false;
    }
    const auto into = static_cast<std::size_t>(begin - samples.begin()),
               out = static_cast<std::size_t>(end - samples.begin());
    const auto from = time_of_mark(samples, ramp_before(samples, into), into);
    const auto to = time_of_mark(samples, out, ramp_after(samples, out));
    if (!from || !to || !(*to > *from)) {
      problems_.push_back(table_.placed(
          error("marks-missing"_id,
                fmt::format("the {} run has no {}: three samples or more beyond {:g} mm that move "
                            "at more than {:g} mm/s",
                            name_of(sense), from ? "feed-out" : "feed-in", outside, kStands),
                "record from before the bar comes in to after it has gone out; without both the "
                "times are spread over the capture: leave --angle feed out"),
          samples.front().line));
      return false;
    }
    const auto& arc = words_.capture;
    const double over = words_.overshoot.value_or(plane_ == Plane::XY ? kHalfTurn : kSlight);
    const double whole = arc.width() + 2.0 * over;
    if (auto problem = other_feed(sense, whole, *to - *from, samples.front().line)) {
      problems_.push_back(*std::move(problem));
      return false;
    }
    std::vector<Sample> kept;
    for (Sample each : samples) {
      const double turned = whole * (each.place - *from) / (*to - *from) - over;
      if (turned < 0.0 || turned > arc.width()) continue;
      each.place = sense == Sense::ccw ? arc.lo + turned : arc.hi - turned;
      if (std::abs(each.deviation) > words_.stroke) {
        problems_.push_back(table_.placed(
            error("stroke-exceeded"_id,
                  fmt::format("{:g} mm from the nominal length, beyond the stroke of {:g} mm",
                              each.deviation, words_.stroke),
                  "check the unit of the column and the length of the bar"),
            each.line));
        return false;
      }
      kept.push_back(each);
    }
    samples = std::move(kept);
    return !samples.empty();
  }
  // A recording whose time is not that of the arc at the feed that it states: it stands, or runs
  // slower, somewhere between the marks.
  [[nodiscard]] std::optional<Diagnostic> other_feed(Sense sense, double arc, double time,
                                                     int line) const {
    constexpr double kOff = 0.1;  // that acceleration does not come to
    if (!feed_ || !(*feed_ > 0.0) || !(length_ > 0.0)) return std::nullopt;
    const double expected = arc * length_ / (*feed_ / kSecondsPerMinute);
    if (std::abs(time - expected) <= kOff * expected) return std::nullopt;
    return table_.placed(
        error("time-mismatch"_id,
              fmt::format("the {} run takes {:.4g} s between its marks, {:g} deg at {:g} mm/min "
                          "take {:.4g} s",
                          name_of(sense), time, as_stated(arc * kDegPerRad), *feed_, expected),
              "leave pauses between feed-in, circle and feed-out out; check feed, --capture and "
              "--overshoot"),
        line);
  }
  // The bar stands before it comes in and after it has gone out: the ramp is what moves.
  static std::size_t ramp_before(const std::vector<Sample>& samples, std::size_t into) {
    std::size_t first = into;
    while (first > 0 && moves(samples[first - 1], samples[first])) --first;
    return first;
  }
  static std::size_t ramp_after(const std::vector<Sample>& samples, std::size_t out) {
    std::size_t last = out;
    while (last < samples.size() && moves(samples[last - 1], samples[last])) ++last;
    return last;
  }
  static constexpr double kStands = 0.05;  // mm/s
  static bool moves(const Sample& a, const Sample& b) {
    return std::abs(b.deviation - a.deviation) > kStands * (b.place - a.place);
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
  Plane plane_ = Plane::XY;
  double length_ = 0.0;
  std::optional<double> feed_{};
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
