#include "report/terminal_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/units.hpp"
#include "report/form_parameter.hpp"
#include "report/number_text.hpp"
#include "report/tool_text.hpp"
#include "report/verdict.hpp"

namespace frustum::report {
namespace {

// Columns that a UTF-8 text takes: one for each code point, which holds for the texts of this
// trade.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == '\x7f'; }, ' ');
  return text;
}

std::string padded(const std::string& text, std::size_t width, bool to_the_right) {
  const std::size_t used = columns_of(text);
  const std::string fill(width > used ? width - used : 0, ' ');
  return to_the_right ? fill + text : text + fill;
}

constexpr std::size_t kLabel = 11;  // columns

// Units of a terminal are in ASCII: "um", "uin".
std::string with_ascii_unit(const std::string& number, std::string_view unit,
                            const Wording& words) {
  return number + " " + std::string(words.unit(unit));
}

// One page under way: knows the width, the colours and how to wrap.
class Page {
 public:
  Page(const TerminalOptions& options, const ReportStyle& style)
      : words(style),
        options_(options),
        width_(static_cast<std::size_t>(std::max(options.width, 60))) {}

  [[nodiscard]] std::string take() { return std::move(text_); }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t list_limit() const { return options_.list_limit; }

  void line(const std::string& content = {}) {
    text_ += content;
    text_.erase(text_.find_last_not_of(' ') + 1);
    text_ += '\n';
  }

  void heading(const std::string& content) {
    line();
    line(bold(content));
  }

  // `label`, then `content` wrapped at words and indented after the label.
  void labelled(const std::string& label, const std::string& content) {
    std::string current = label;
    std::size_t used = columns_of(label);
    const std::string indent(used, ' ');
    bool is_line_empty = true;
    std::size_t at = 0;
    const std::string clean = printable(content);
    while (at < clean.size()) {
      const std::size_t end = std::min(clean.find(' ', at), clean.size());
      const std::string word = clean.substr(at, end - at);
      at = end + 1;
      if (word.empty()) continue;
      if (!is_line_empty && used + 1 + columns_of(word) > width_) {
        line(current);
        current = indent;
        used = indent.size();
        is_line_empty = true;
      }
      if (!is_line_empty) current += ' ';
      used += columns_of(word) + (is_line_empty ? 0 : 1);
      current += word;
      is_line_empty = false;
    }
    line(current);
  }

  [[nodiscard]] std::string bold(const std::string& content) const { return coded("1", content); }
  [[nodiscard]] std::string verdict(metrology::Verdict verdict) const {
    if (verdict == metrology::Verdict::uncertain) return coded("1;33", words("UNCERTAIN"));
    const bool pass = verdict == metrology::Verdict::pass;
    return coded(pass ? "1;32" : "1;31", pass ? words("PASS") : words("FAIL"));
  }
  // A short name at the beginning of a line, and the blanks after it.
  [[nodiscard]] std::string label(Phrase name) const {
    const std::string text = words(name);
    return padded(text, std::max(kLabel, columns_of(text) + 1), false);
  }

  const Wording words;

 private:
  [[nodiscard]] std::string coded(std::string_view code, const std::string& content) const {
    return options_.colour ? fmt::format("\x1b[{}m{}\x1b[0m", code, content) : content;
  }

  TerminalOptions options_;
  std::size_t width_;
  std::string text_;
};

void write_head(Page& page, const RunReport& report) {
  const std::string title =
      printable(report.title.empty() ? page.words("Untitled run") : report.title);
  const std::size_t used = columns_of(title) + 4;
  const std::string gap(page.width() > used ? page.width() - used : 2, ' ');
  page.line(page.bold(title) + gap + page.verdict(report.verdict()));
  const std::string structure = report.structure.empty() ? "" : " [" + report.structure + "]";
  if (!report.machine.empty()) page.labelled(page.label("Machine"), report.machine + structure);
  if (!report.program.empty()) page.labelled(page.label("Program"), report.program);
  for (const auto& [number, tool] : report.tools) {
    page.labelled(padded(fmt::format("{} {}", page.words("Tool"), number), kLabel, false),
                  tool_text(tool, page.words));
  }
  if (report.volumes.removed) {
    const double mm3 = *report.volumes.removed;
    page.labelled(page.label("Removed"),
                  page.words.is_inch() ? page.words.fixed(page.words.shown(mm3, "mm3"), 3) + " in3"
                                       : page.words.fixed(mm3 / 1e3, 2) + " cm3");
  }
}

void write_machine_bodies(Page& page, const RunReport& report) {
  if (report.machine_bodies) {
    page.labelled(page.label("Bodies"), machine_bodies_text(*report.machine_bodies, page.words));
  }
}

void write_errors(Page& page, const RunReport& report) {
  if (report.errors.empty() && report.machine.empty()) return;  // no machine tool was simulated
  if (report.errors.empty()) {
    page.labelled(page.label("Errors"), page.words("none injected"));
    return;
  }
  page.heading(page.words("Errors injected"));
  std::size_t name_width = 0;
  std::size_t value_width = 0;
  for (const InjectedError& injected : report.errors) {
    name_width = std::max(name_width, columns_of(injected.name));
    value_width = std::max(value_width, columns_of(injected.written));
  }
  for (const InjectedError& injected : report.errors) {
    const std::string label = "  " + padded(printable(injected.name), name_width + 2, false) +
                              padded(printable(injected.written), value_width + 2, false);
    page.labelled(label, page.words.sentence(injected.meaning));
  }
}

std::string uncertainty_cell(const metrology::CharacteristicResult& c, const Wording& words) {
  if (c.is_accuracy_unknown) return "-";
  const std::string doubt = words.word(doubt_of(c));
  return words.uncertainty(c.expanded_uncertainty, c.unit) +
         (doubt.empty() ? "" : fmt::format(" ({})", doubt));
}

void write_characteristics(Page& page, const RunReport& report) {
  const auto& characteristics = report.measurement.characteristics;
  if (characteristics.empty()) return;
  const bool has_nominal = std::any_of(characteristics.begin(), characteristics.end(),
                                       [](const auto& c) { return !nominal_text(c).empty(); });
  std::vector<std::vector<std::string>> rows;
  const Wording& words = page.words;
  rows.push_back({words("Characteristic"), words("Value"), words("Nominal"), words("Tolerance"),
                  is_accuracy_unknown(report.measurement) ? "U" : "U (95%)", words("95 % interval"),
                  words("Used"), words("Verdict")});
  for (const metrology::CharacteristicResult& c : characteristics) {
    const std::optional<double> used = used_share(c);
    const std::string plus_minus = c.nominal ? "+-" : "";
    rows.push_back({printable(name_text(c, words)), with_ascii_unit(words.result(c), c.unit, words),
                    words.nominal(c), plus_minus + words.value(c.tolerance, c.unit),
                    uncertainty_cell(c, words), words.interval(c),
                    used ? fixed_text(100.0 * *used, 0) + " %" : "-", ""});
  }
  const bool has_interval = std::any_of(characteristics.begin(), characteristics.end(),
                                        [](const auto& c) { return c.simulated.has_value(); });
  if (!has_interval) {
    for (auto& row : rows) row.erase(row.begin() + 5);
  }
  if (!has_nominal) {
    for (auto& row : rows) row.erase(row.begin() + 2);
  }
  const std::size_t columns = rows.front().size();
  std::vector<std::size_t> widths(columns, 0);
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < columns; ++k) widths[k] = std::max(widths[k], columns_of(row[k]));
  }
  page.line();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string text = padded(rows[r][0], widths[0], false);
    for (std::size_t k = 1; k + 1 < columns; ++k)
      text += "  " + padded(rows[r][k], widths[k], true);
    if (r == 0) {
      page.line(page.bold(text + "  " + words("Verdict")));
      page.line(std::string(columns_of(text) + 2 + columns_of(words("Verdict")), '-'));
    } else {
      page.line(text + "  " + page.verdict(characteristics[r - 1].verdict()));
    }
  }
}

void write_without_seam(Page& page, const RunReport& report) {
  for (const metrology::CharacteristicResult& c : report.measurement.characteristics) {
    if (!c.without_seam) continue;
    page.labelled(
        "", page.words("{0}: {1} without the seam at {2} deg +- {3} deg", printable(c.name),
                       with_ascii_unit(page.words.value(c.without_seam->value, c.unit), c.unit,
                                       page.words),
                       page.words.general(c.without_seam->at * kDegPerRad),
                       page.words.general(c.without_seam->within * kDegPerRad)));
  }
}

void write_no_uncertainty(Page& page, const RunReport& report) {
  if (!has_no_uncertainty(report.measurement)) return;
  page.labelled("", is_accuracy_unknown(report.measurement)
                        ? page.words("U is not known: no accuracy of the CMM is stated (--e0, "
                                     "--l-per-um)")
                        : page.words("U = 0: no error of the CMM is stated (e0 and l_per_um)"));
}

void write_cycle(Page& page, const RunReport& report) {
  if (!report.cycle_time) return;
  page.line();
  page.labelled(page.label("Cycle time"), page.words.number(duration_text(*report.cycle_time)));
  if (report.slowed.empty()) return;
  const Wording& words = page.words;
  page.line("  " + (report.slowed.size() == 1
                        ? words("1 block slowed by axis limits")
                        : words("{0} blocks slowed by axis limits", report.slowed.size())));
  const auto feed = [&](double value) {
    return words.fixed(words.shown(value, "mm/min"), words.is_inch() ? 2 : 0);
  };
  // The worst are enough; the JSON document has them all.
  const std::size_t shown = std::min<std::size_t>(report.slowed.size(), 5);
  for (std::size_t k = 0; k < shown; ++k) {
    const SlowedBlock& block = report.slowed[k];
    page.line("  " + words("line {0}: axis {1}, {2} instead of {3} {4}", block.line, block.axis,
                           feed(block.reached_feed), feed(block.programmed_feed),
                           words.unit("mm/min")));
  }
}

void write_bounds(Page& page, const RunReport& report) {
  if (!report.bounds || report.bounds->points == 0) return;
  const PointBounds& b = *report.bounds;
  page.line();
  const std::string bound =
      with_ascii_unit(page.words.fixed(page.words.shown(b.worst_bound * kUmPerMm, "um"),
                                       page.words.is_inch() ? 3 : 4),
                      "um", page.words);
  page.labelled(
      page.label("Points"),
      page.words("worst bound {0}, {1} of {2} sampled points proven", bound, b.proven, b.sampled));
}

void write_collisions(Page& page, const RunReport& report) {
  if (report.collisions.empty()) return;
  page.heading(page.words("Collisions ({0})", report.collisions.size()));
  const std::size_t shown = std::min(report.collisions.size(), page.list_limit());
  for (std::size_t k = 0; k < shown; ++k) {
    const Collision& collision = report.collisions[k];
    const std::string place = collision.line > 0 ? page.words("line {0}: ", collision.line) : "";
    page.labelled("  ", place + collision.text);
  }
  if (shown < report.collisions.size()) {
    page.line("  " + page.words("and {0} more", report.collisions.size() - shown));
  }
}

void write_diagnostics(Page& page, const RunReport& report) {
  Diagnostics all = report.diagnostics;
  all.insert(all.end(), report.measurement.diagnostics.begin(),
             report.measurement.diagnostics.end());
  if (all.empty() && report.notes.empty()) return;
  page.heading(page.words("Remarks"));
  const std::size_t shown = std::min(all.size(), page.list_limit());
  for (std::size_t k = 0; k < shown; ++k) page.labelled("  ", to_string(all[k]));
  if (shown < all.size()) page.line("  " + page.words("and {0} more", all.size() - shown));
  for (const std::string& note : report.notes) page.labelled("  ", note);
}

constexpr std::size_t kFootLabel = 9;  // columns

void write_foot(Page& page, const RunReport& report) {
  if (!report.timings.empty()) {
    std::string text;
    double sum = 0.0;
    for (const Timing& timing : report.timings) {
      sum += timing.seconds;
      text += fmt::format("{} {} s, ", page.words.word(timing.name),
                          page.words.fixed(timing.seconds, 2));
    }
    page.line();
    page.labelled(padded(page.words("Time"), kFootLabel, false),
                  text + page.words("together {0} s", page.words.fixed(sum, 2)));
  }
  if (report.files.empty()) return;
  if (report.timings.empty()) page.line();
  bool is_first = true;
  for (const std::string& file : report.files) {
    page.labelled(padded(is_first ? page.words("Written") : "", kFootLabel, false), file);
    is_first = false;
  }
}

}  // namespace

std::string terminal_report(const RunReport& report, const TerminalOptions& options) {
  Page page(options, report.style);
  write_head(page, report);
  write_machine_bodies(page, report);
  write_errors(page, report);
  write_characteristics(page, report);
  write_without_seam(page, report);
  write_no_uncertainty(page, report);
  write_cycle(page, report);
  write_bounds(page, report);
  write_collisions(page, report);
  write_diagnostics(page, report);
  write_foot(page, report);
  return page.take();
}

}  // namespace frustum::report
