#include "kinematics/geometric_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/spelling.hpp"
#include "kinematics/machine.hpp"

namespace frustum::kinematics {
namespace {

constexpr std::string_view kDirections = "XYZABC";

std::optional<std::size_t> direction_index(char letter) {
  const auto at = kDirections.find(letter);
  if (at == std::string_view::npos) return std::nullopt;
  return at;
}

AxisRange default_span(const Joint& joint, const AxisSpans& spans) {
  const auto given = spans.find(joint.letter);
  if (given != spans.end() && given->second.width() > 0.0) return given->second;
  return joint.travel;
}

// Lays a shape over its span (thesis sections 3.8 and 3.9).
ErrorTerm term_of(const ErrorShape& shape, const Joint& joint, const AxisSpans& spans) {
  const AxisRange span = shape.span ? *shape.span : default_span(joint, spans);
  const double amount = shape.amount.value;
  switch (shape.kind) {
    case ErrorShape::Kind::linear:
      return LinearTerm{amount / span.width(), shape.zero.value_or(0.0)};
    case ErrorShape::Kind::harmonic:
      // Linear axes: half periods over the span, counted from its middle; rotary axes: whole periods,
      // counted from zero.
      if (joint.rotary()) {
        return HarmonicTerm{amount, 2.0 * std::numbers::pi * shape.order / span.width(), 0.0,
                            shape.phase};
      }
      return HarmonicTerm{amount, std::numbers::pi * shape.order / span.width(), span.middle(),
                          shape.phase};
    case ErrorShape::Kind::table:
      return TableTerm::of(shape.points, TableKind::linear, false);
    case ErrorShape::Kind::constant:
      break;
  }
  return ConstantTerm{amount};
}

struct NamedError {
  ErrorName error;
  double scale = 1.0;
  bool carries = false;
};

Result<NamedError> find_error(const Machine& machine, const std::string& name) {
  if (const auto alias = machine.aliases().find(name); alias != machine.aliases().end()) {
    return NamedError{alias->second.error, alias->second.scale, alias->second.carries};
  }
  std::vector<std::string> known;
  for (const ErrorName& e : machine.error_names()) known.push_back(e.text());
  for (const auto& [alias, meaning] : machine.aliases()) known.push_back(alias);
  const auto error_name = ErrorName::parse(name);
  if (!error_name) {
    return error(fmt::format("unknown error name '{}' for machine {}", name, machine.name()),
                 nearest_word(name, known)
                     ? suggestion(name, known)
                     : fmt::format("'frustum errors {}' lists the names", machine.name()));
  }
  if (machine.joint(error_name->axis) == nullptr) {
    return error(fmt::format("error {}: machine {} ({}) has no axis {}", name, machine.name(),
                             machine.structure(), to_char(error_name->axis)),
                 fmt::format("'frustum errors {}' lists the names", machine.name()));
  }
  if (const auto reason = machine.refused(*error_name)) {
    return error(fmt::format("error {}: {}", name, *reason),
                 "choose other reference axes with the machine file's key datum");
  }
  return NamedError{*error_name};
}

std::optional<Diagnostic> check_units(const ErrorEntry& entry, const ErrorShape& shape,
                                      const NamedError& named) {
  const UnitKind wanted = is_rotation(named.error.direction) ? UnitKind::angle : UnitKind::length;
  if (shape.amount.kind != wanted && shape.kind != ErrorShape::Kind::table) {
    return error(fmt::format("error {} = {}: expected {}", entry.name, entry.written,
                             wanted == UnitKind::angle ? "an angle" : "a length"),
                 wanted == UnitKind::angle ? "for example 30 urad" : "for example 10 um");
  }
  if (named.error.location && shape.kind != ErrorShape::Kind::constant) {
    return error(
        fmt::format("error {} = {}: a location error is a constant", entry.name, entry.written),
        "component errors such as EXX take shapes");
  }
  return std::nullopt;
}

void apply(GeometricErrors& errors, const NamedError& named, std::vector<ErrorTerm> terms,
           double constant) {
  AxisErrors& axis = errors[named.error.axis];
  const auto d = static_cast<std::size_t>(named.error.direction);
  if (named.carries) {
    axis.carried_tilt[static_cast<Eigen::Index>(d) - 3] = named.scale * constant;
  } else if (named.error.location) {
    axis.location[d] = named.scale * constant;
  } else {
    axis.component[d] = ErrorFunction(std::move(terms));
  }
}

}  // namespace

std::optional<ErrorName> ErrorName::parse(std::string_view text) {
  if (text.size() >= 3 && text.front() == 'E') text.remove_prefix(1);
  const bool location = text.size() == 3 && (text[1] == '0' || text[1] == 'O');
  if (!location && text.size() != 2) return std::nullopt;
  const auto axis = direction_index(text.back());
  const auto direction = direction_index(text.front());
  if (!axis || !direction) return std::nullopt;
  return ErrorName{static_cast<ErrorDirection>(*direction), static_cast<AxisLetter>(*axis),
                   location};
}

std::string ErrorName::text() const {
  return fmt::format("E{}{}{}", kDirections[static_cast<std::size_t>(direction)],
                     location ? "0" : "", to_char(axis));
}

std::string ErrorName::meaning() const {
  const char d = kDirections[static_cast<std::size_t>(direction)];
  if (location) {
    return is_rotation(direction) ? fmt::format("orientation of {} about {}", to_char(axis), d)
                                  : fmt::format("position of {} in {}", to_char(axis), d);
  }
  const std::string axis_text(1, to_char(axis));
  if (d == to_char(axis)) return "positioning of " + axis_text;
  if (!is_rotary(axis)) {
    return fmt::format("{} of {} {} {}", is_rotation(direction) ? "angular motion" : "straightness",
                       axis_text, is_rotation(direction) ? "about" : "in", d);
  }
  if (is_rotation(direction)) return fmt::format("tilt motion of {} about {}", axis_text, d);
  const bool axial = static_cast<std::size_t>(direction) + 3 == static_cast<std::size_t>(axis);
  return fmt::format("{} motion of {} in {}", axial ? "axial" : "radial", axis_text, d);
}

bool AxisErrors::depends_on_direction() const {
  return std::any_of(component.begin(), component.end(),
                     [](const ErrorFunction& f) { return f.depends_on_direction(); });
}

bool GeometricErrors::depends_on_direction() const {
  return std::any_of(axes_.begin(), axes_.end(),
                     [](const AxisErrors& axis) { return axis.depends_on_direction(); });
}

GeometricErrors GeometricErrors::plus(const GeometricErrors& others, double factor) const {
  GeometricErrors sum = *this;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    AxisErrors& axis = sum.axes_[i];
    const AxisErrors& other = others.axes_[i];
    for (std::size_t k = 0; k < axis.component.size(); ++k) {
      axis.component[k] = axis.component[k].plus(other.component[k], factor);
      axis.location[k] += factor * other.location[k];
    }
    axis.carried_tilt += factor * other.carried_tilt;
    axis.settling = std::max(axis.settling, other.settling);
  }
  return sum;
}

Result<GeometricErrors> resolve(const Machine& machine, std::span<const ErrorEntry> entries,
                                const AxisSpans& spans) {
  GeometricErrors errors;
  Diagnostics problems;
  for (const ErrorEntry& entry : entries) {
    auto named = find_error(machine, entry.name);
    if (!named) {
      problems.insert(problems.end(), named.error().begin(), named.error().end());
      continue;
    }
    const Joint& joint = *machine.joint(named->error.axis);
    std::vector<ErrorTerm> terms;
    double constant = 0.0;
    for (ErrorShape shape : entry.terms) {
      if (const auto problem = check_units(entry, shape, *named)) {
        problems.push_back(*problem);
        continue;
      }
      constant += shape.amount.value;
      shape.amount.value *= named->scale;
      for (auto& point : shape.points) point.second *= named->scale;
      terms.push_back(term_of(shape, joint, spans));
    }
    apply(errors, *named, std::move(terms), constant);
  }
  if (!problems.empty()) return problems;
  return errors;
}

}  // namespace frustum::kinematics
