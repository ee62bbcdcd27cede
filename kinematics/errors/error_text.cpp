// Reads errors as people write them in words: on the command line and as texts of an [errors]
// table.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "core/spelling.hpp"
#include "kinematics/errors/error_shape.hpp"
#include "kinematics/errors/harmonic_order.hpp"

namespace frustum::kinematics {
namespace {

constexpr const char* kForms =
    "write NAME=VALUE, for example EB0C=30urad, \"EXX=linear 10um\" or "
    "\"EYX=harmonic 1 10um over 0mm..200mm phase 90deg\"";
constexpr const char* kAmounts =
    "an amount is 10um, uniform -10um..10um, normal 0um sd 5um limit 15um, nominal 2um tolerance "
    "1um, or the name of a drawn quantity";

struct Keyword {
  std::string_view word;
  ErrorShape::Kind kind;
};
constexpr std::array kKinds{Keyword{"constant", ErrorShape::Kind::constant},
                            Keyword{"linear", ErrorShape::Kind::linear},
                            Keyword{"polynomial", ErrorShape::Kind::polynomial},
                            Keyword{"harmonic", ErrorShape::Kind::harmonic},
                            Keyword{"cyclic", ErrorShape::Kind::cyclic},
                            Keyword{"reversal", ErrorShape::Kind::reversal},
                            Keyword{"tent", ErrorShape::Kind::tent},
                            Keyword{"field", ErrorShape::Kind::field},
                            Keyword{"table", ErrorShape::Kind::table},
                            Keyword{"surface", ErrorShape::Kind::surface}};
constexpr std::array<std::string_view, 18> kOptions{
    "over", "zero",  "phase",      "period",  "settle",    "at", "times",       "uniform", "normal",
    "sd",   "limit", "triangular", "nominal", "tolerance", "as", "correlation", "kernel",  ".."};

bool is_keyword(std::string_view word) {
  return std::find(kOptions.begin(), kOptions.end(), word) != kOptions.end() ||
         std::any_of(kKinds.begin(), kKinds.end(),
                     [&](const Keyword& k) { return k.word == word; });
}

// "; did you mean uniform?" of a misspelt law, or another word that may stand there.
std::string meant_law(std::string_view word, std::vector<std::string> candidates = {}) {
  candidates.insert(candidates.end(), {"uniform", "normal", "triangular", "nominal"});
  const auto near = nearest_word(word, candidates);
  return near ? fmt::format("; did you mean {}?", *near) : std::string();
}

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) > 127;
}

bool is_bare_number(std::string_view word) {
  if (const auto dots = word.rfind(".."); dots != std::string_view::npos)
    word.remove_prefix(dots + 2);
  const auto parsed = parse_quantity(word);
  return parsed && parsed->kind == UnitKind::none;
}

// Words of the text; "10 um" counts as one, and so does "-10 um .. 10 um".
std::vector<std::string> words_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    const bool after_order = words.size() == 2 && words[0] == "harmonic";
    const bool follows_dots = !words.empty() && words.back().ends_with("..");
    const bool is_unit = is_letter(word.front()) && !is_keyword(word) && !words.empty() &&
                         !after_order && is_bare_number(words.back());
    if (is_unit || follows_dots || (word.starts_with("..") && !words.empty())) {
      words.back() += word;
    } else {
      words.push_back(word);
    }
  }
  return words;
}

// Reads words from left to right; the first problem stays.
class WordReader {
 public:
  WordReader(std::string_view text, const DrawnQuantities& names)
      : words_(words_of(text)), names_(names) {}

  [[nodiscard]] bool done() const { return next_ >= words_.size() || !problem_.empty(); }
  [[nodiscard]] const std::string& problem() const { return problem_; }
  void fail(std::string text) {
    if (problem_.empty()) problem_ = std::move(text);
  }
  [[nodiscard]] std::string_view peek() const {
    return next_ < words_.size() ? std::string_view(words_[next_]) : std::string_view();
  }
  bool take(std::string_view word) {
    if (peek() != word || word.empty()) return false;
    ++next_;
    return true;
  }
  std::string word(const char* what) {
    if (next_ < words_.size()) return words_[next_++];
    fail(fmt::format("{} is missing", what));
    return {};
  }

  ParsedQuantity quantity(std::optional<UnitKind> kind, const char* what) {
    const std::string text = word(what);
    if (!problem_.empty()) return {1.0, UnitKind::none};
    const auto parsed = parse_quantity(text);
    if (!parsed) {
      fail(parsed.error().front().message);
      return {1.0, UnitKind::none};
    }
    if (kind && parsed->kind != *kind) fail(fmt::format("expected {}", what));
    return *parsed;
  }

  Distribution distribution() {
    Distribution d;
    if (take("nominal")) return tolerance();
    if (peek() == "uniform" || peek() == "triangular") {
      const std::string law = word("");
      const std::string text = word("a range such as -10um..10um");
      const auto range = parse_range(text);
      if (!range) {
        fail(fmt::format("'{} {}' is not a range such as -10um..10um", law, text));
        return d;
      }
      if (law == "triangular") d.kind = Distribution::Kind::triangular;
      d.unit = range->first.kind;
      d.lo = range->first.value;
      d.hi = range->second.value;
      return d;
    }
    if (!take("normal")) {
      fail(fmt::format("'{}' is not a distribution{}", peek(), meant_law(peek())));
      return d;
    }
    d.kind = Distribution::Kind::normal;
    const ParsedQuantity mean = quantity(std::nullopt, "the mean of the normal distribution");
    if (!take("sd")) fail("'normal' needs its standard deviation: normal 0um sd 5um");
    const ParsedQuantity deviation = quantity(std::nullopt, "the standard deviation");
    d.unit = deviation.kind;
    d.mean = mean.value;
    d.deviation = deviation.value;
    if (mean.kind != d.unit && mean.value != 0.0) fail("mean and sd have different units");
    if (!(d.deviation > 0.0)) fail("the standard deviation must be above 0");
    if (take("limit")) {
      const ParsedQuantity limit = quantity(d.unit, "the limit in the unit of sd");
      d.limit = limit.value;
      // A narrower window is uniform but for its name, and costs many draws.
      if (!(limit.value >= 0.1 * d.deviation)) fail("the limit must be at least a tenth of sd");
    }
    return d;
  }

  Amount amount(const char* what) {
    if (peek() == "uniform" || peek() == "normal" || peek() == "triangular" ||
        peek() == "nominal") {
      Amount drawn{.value = 1.0};
      drawn.drawn.push_back({.distribution = distribution()});
      drawn.kind = drawn.drawn.front().distribution.unit;
      if (drawn.kind == UnitKind::none) fail("the amount has no unit");
      return drawn;
    }
    return product(word(what));
  }

  // "10um", "-a1", "0.5*M", "b1*cos(zeta-90deg)"
  Amount product(std::string_view text) {
    const bool several = text.find('*') != std::string_view::npos;
    Amount amount{.value = 1.0};
    sum_ = false;
    while (!text.empty() && problem_.empty()) {
      std::size_t end = 0, depth = 0;
      for (; end < text.size() && (text[end] != '*' || depth > 0); ++end) {
        if (text[end] == '(') ++depth;
        if (text[end] == ')' && depth > 0) --depth;
      }
      factor(text.substr(0, end), amount);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (sum_ && several) fail("a sum such as zeta+90deg is no factor of a product");
    return amount;
  }

 private:
  // What follows "nominal": "17urad tolerance 4urad as normal-3sd".
  Distribution tolerance() {
    Distribution d{.kind = Distribution::Kind::tolerance};
    const ParsedQuantity nominal = quantity(std::nullopt, "the nominal value");
    if (!take("tolerance")) fail("'nominal' needs its tolerance: nominal 17urad tolerance 4urad");
    const ParsedQuantity size = quantity(std::nullopt, "the tolerance");
    d.unit = size.kind;
    d.mean = nominal.value;
    d.limit = size.value;
    if (nominal.kind != d.unit && nominal.value != 0.0)
      fail("nominal value and tolerance have different units");
    if (!(size.value > 0.0)) fail("the tolerance must be above 0");
    if (take("as")) {
      const std::string text = word("how the tolerance is read");
      d.reading = tolerance_reading_named(text);
      if (!d.reading) {
        fail(
            fmt::format("'{}' is no reading of a tolerance: uniform, normal-2sd, normal-3sd, "
                        "normal-3sd-cut or triangular",
                        text));
      }
    }
    return d;
  }

  void has_unit(UnitKind unit, Amount& amount) {
    if (unit != UnitKind::none && amount.kind != UnitKind::none)
      fail("a product has one factor with a unit");
    if (unit != UnitKind::none) amount.kind = unit;
  }

  void factor(std::string_view text, Amount& amount) {
    const bool negated = text.size() > 1 && text[0] == '-' && is_letter(text[1]);
    if (negated) {
      amount.value = -amount.value;
      text.remove_prefix(1);
    }
    if (text.empty() || !is_letter(text[0])) {
      const auto parsed = parse_quantity(text);
      if (!parsed) return fail(parsed.error().front().message);
      has_unit(parsed->kind, amount);
      amount.value *= parsed->value;
      return;
    }
    DrawnFactor drawn;
    for (const auto& [word, function] : {std::pair{"cos(", DrawnFactor::Function::cosine},
                                         std::pair{"sin(", DrawnFactor::Function::sine}}) {
      if (text.starts_with(word) && text.back() == ')') {
        drawn.function = function;
        text = text.substr(4, text.size() - 5);
        break;
      }
    }
    const std::size_t sign = text.find_first_of("+-");
    drawn.name = std::string(text.substr(0, sign));
    const auto known = names_.find(drawn.name);
    if (known == names_.end()) {
      std::vector<std::string> others;
      for (const auto& [name, distribution] : names_) others.push_back(name);
      for (const Keyword& k : kKinds)
        if (k.kind < ErrorShape::Kind::table) others.emplace_back(k.word);
      return fail(fmt::format("'{}' is neither a number with a unit nor a drawn quantity", text) +
                  meant_law(text, std::move(others)));
    }
    drawn.distribution = known->second;
    if (sign != std::string_view::npos) {
      const auto shift = parse_quantity(text.substr(sign));
      if (!shift || shift->kind != drawn.distribution.unit)
        return fail(fmt::format("'{}': what is added has not the unit of {}", text, drawn.name));
      // "-zeta+90deg" is -(zeta - 90deg).
      drawn.shift = negated ? -shift->value : shift->value;
      sum_ = sum_ || drawn.function == DrawnFactor::Function::itself;
    }
    if (drawn.function == DrawnFactor::Function::itself) {
      has_unit(drawn.distribution.unit, amount);
    } else if (drawn.distribution.unit != UnitKind::angle) {
      fail(fmt::format("{} is not an angle", drawn.name));
    }
    amount.drawn.push_back(std::move(drawn));
  }

  std::vector<std::string> words_;
  const DrawnQuantities& names_;
  std::size_t next_ = 0;
  bool sum_ = false;  // the product read last holds a drawn quantity and something added
  std::string problem_;
};

// Reads the words of one term.
class TermReader {
 public:
  TermReader(std::string_view text, const DrawnQuantities& names) : in_(text, names) {}

  Result<ErrorShape> read() {
    kind();
    while (!in_.done()) option();
    if (shape_.kind == ErrorShape::Kind::cyclic && !(shape_.period > 0.0))
      in_.fail("a cyclic error needs its period, above 0: period 5mm");
    if (shape_.kind == ErrorShape::Kind::tent && shape_.peak.kind == UnitKind::none)
      in_.fail("a triangular error needs the place of its peak: at 90deg");
    if (shape_.kind == ErrorShape::Kind::field) check_field();
    if (!in_.problem().empty()) return error("error-text"_id, in_.problem(), kForms);
    return shape_;
  }

 private:
  using Kind = ErrorShape::Kind;

  void kind() {
    for (const Keyword& keyword : kKinds) {
      if (keyword.kind >= Kind::table || !in_.take(keyword.word)) continue;
      shape_.kind = keyword.kind;
      break;
    }
    if (shape_.kind == Kind::harmonic) {
      const double order = in_.quantity(UnitKind::none, "the order of the harmonic").value;
      shape_.order = static_cast<int>(std::clamp(order, 0.0, 1e4));
      if (shape_.order != order || shape_.order < 1 || shape_.order > kHighestHarmonic) {
        in_.fail(fmt::format("the order of a harmonic is a whole number from 1 to {}",
                             kHighestHarmonic));
      }
    }
    if (shape_.kind == Kind::polynomial) {
      while (!in_.done() && in_.peek() != "over" && in_.peek() != "times") {
        shape_.coefficients.push_back(amount("a coefficient with its unit"));
      }
      if (shape_.coefficients.empty()) in_.fail("a polynomial needs coefficients");
      for (const Amount& c : shape_.coefficients) {
        if (c.kind != UnitKind::none) shape_.amount.kind = c.kind;
      }
      return;
    }
    shape_.amount = amount("an amount with its unit");
  }

  Amount amount(const char* what) {
    Amount read = in_.amount(what);
    if (read.kind == UnitKind::none && (read.value != 0.0 || !read.drawn.empty()))
      in_.fail("the amount has no unit");
    return read;
  }

  void option() {
    const Kind k = shape_.kind;
    const bool waves = k == Kind::harmonic || k == Kind::cyclic;
    const bool spans = k == Kind::linear || k == Kind::polynomial || k == Kind::harmonic ||
                       k == Kind::tent || k == Kind::field;
    if (spans && in_.take("over")) {
      span();
    } else if (waves && in_.take("phase")) {
      shape_.phase = in_.amount("the phase as an angle");
      if (shape_.phase.kind != UnitKind::angle) in_.fail("expected the phase as an angle");
    } else if (k == Kind::linear && in_.take("zero")) {
      shape_.zero = position("the position of the zero");
    } else if (k == Kind::cyclic && in_.take("period")) {
      shape_.period = position("the period, 5mm or 10deg");
    } else if (k == Kind::field && in_.take("correlation")) {
      shape_.correlation = position("the correlation length, 40mm or 30deg");
    } else if (k == Kind::field && in_.take("kernel")) {
      kernel();
    } else if (k == Kind::reversal && in_.take("settle")) {
      shape_.settle = position("the take-up distance, 0.01mm or 0.1deg");
      if (*shape_.settle < 0.0) in_.fail("the take-up distance is 0 or more");
    } else if (k == Kind::tent && in_.take("at")) {
      shape_.peak = in_.amount("the place of the peak");
      place(shape_.peak.kind);
    } else if (in_.take("times")) {
      factor();
    } else {
      in_.fail(fmt::format("'{}' is not understood here", in_.peek()));
    }
  }

  void kernel() {
    const std::string text = in_.word("gaussian or matern32");
    for (const FieldKernel known : {FieldKernel::gaussian, FieldKernel::matern32}) {
      if (text != name_of(known)) continue;
      shape_.kernel = known;
      return;
    }
    in_.fail(fmt::format("'{}' is no kernel: gaussian or matern32", text));
  }

  void check_field() {
    if (!(shape_.correlation > 0.0))
      in_.fail("a field needs its correlation length, above 0: correlation 40mm");
    if (!shape_.amount.drawn.empty() || !(shape_.amount.value > 0.0))
      in_.fail("the amount of a field is its standard deviation, a number above 0");
    if (shape_.factor) in_.fail("a field takes no factor of another axis");
  }

  double position(const char* what) {
    const ParsedQuantity q = in_.quantity(std::nullopt, what);
    place(q.kind);
    return q.value;
  }

  void place(UnitKind kind) {
    if (kind == UnitKind::none) in_.fail("a position has no unit");
    if (shape_.position_kind != UnitKind::none && shape_.position_kind != kind)
      in_.fail("positions in mm and in degrees are mixed");
    shape_.position_kind = kind;
  }

  void span() {
    const std::string text = in_.word("a span such as 0mm..200mm");
    const auto range = parse_range(text);
    if (!range || range->first.kind == UnitKind::none) {
      return in_.fail(fmt::format("'over {}' is not a span such as 0mm..200mm", text));
    }
    place(range->first.kind);
    shape_.span = AxisRange{range->first.value, range->second.value};
  }

  // "times B -90deg:2.5 0deg:0.5 90deg:2.5"
  void factor() {
    AxisFactor factor;
    const std::string letter = in_.word("the axis of the factor");
    const auto axis = axis_named(letter);
    if (!axis) return in_.fail(fmt::format("'{}' is not an axis", letter));
    factor.axis = *axis;
    while (!in_.done() && in_.peek().find(':') != std::string_view::npos) {
      const std::string word = in_.word("");
      const std::size_t colon = word.find(':');
      const auto at = parse_quantity(word.substr(0, colon));
      const auto value = parse_quantity(word.substr(colon + 1));
      const UnitKind wanted = is_rotary(factor.axis) ? UnitKind::angle : UnitKind::length;
      if (!at || !value || at->kind != wanted || value->kind != UnitKind::none)
        return in_.fail(fmt::format("'{}' is not a position and a factor such as 90{}:1.5", word,
                                    is_rotary(factor.axis) ? "deg" : "mm"));
      if (!factor.points.empty() && !(at->value > factor.points.back().first))
        return in_.fail("the positions of a factor must increase");
      factor.points.emplace_back(at->value, value->value);
    }
    if (factor.points.size() < 2) return in_.fail("a factor needs at least two points");
    shape_.factor = std::move(factor);
  }

  WordReader in_;
  ErrorShape shape_;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::string_view name_of(ErrorShape::Kind kind) {
  return kKinds.at(static_cast<std::size_t>(kind)).word;
}

std::optional<std::pair<ParsedQuantity, ParsedQuantity>> parse_range(std::string_view text) {
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) return std::nullopt;
  const auto lo = parse_quantity(text.substr(0, dots));
  const auto hi = parse_quantity(text.substr(dots + 2));
  if (!lo || !hi || lo->kind != hi->kind || !(lo->value < hi->value)) return std::nullopt;
  return std::pair{*lo, *hi};
}

Result<Distribution> parse_distribution(std::string_view text) {
  const DrawnQuantities none;
  WordReader in(text, none);
  const Distribution distribution = in.distribution();
  if (in.problem().empty() && !in.done())
    in.fail(fmt::format("'{}' is not understood here", in.peek()));
  if (!in.problem().empty())
    return error("error-text"_id, fmt::format("'{}': {}", text, in.problem()), kAmounts);
  return distribution;
}

Result<Amount> parse_amount(std::string_view text, const DrawnQuantities& drawn) {
  WordReader in(text, drawn);
  Amount amount = in.amount("an amount with its unit");
  if (in.problem().empty() && !in.done())
    in.fail(fmt::format("'{}' is not understood here", in.peek()));
  if (!in.problem().empty())
    return error("error-text"_id, fmt::format("'{}': {}", text, in.problem()), kAmounts);
  return amount;
}

Result<ErrorEntry> parse_error(std::string_view text, const DrawnQuantities& drawn) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    return error("error-text"_id, fmt::format("'{}' is not an error", text), kForms);
  }
  const std::string name(trimmed(text.substr(0, equals)));
  const std::string value(text.substr(equals + 1));
  ErrorEntry entry{.name = name, .written = value};
  std::size_t start = 0;
  while (start != std::string::npos) {
    const std::size_t plus = value.find(" + ", start);
    const std::size_t length = plus == std::string::npos ? plus : plus - start;
    auto shape = TermReader(value.substr(start, length), drawn).read();
    if (!shape) {
      Diagnostic failure = shape.error().front();
      failure.message = fmt::format("error {} = {}: {}", name, value, failure.message);
      return failure;
    }
    entry.terms.push_back(*std::move(shape));
    start = plus == std::string::npos ? plus : plus + 3;
  }
  return entry;
}

}  // namespace frustum::kinematics
