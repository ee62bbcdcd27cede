#include "kinematics/errors/error_assignment.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/constants.hpp"
#include "core/counted.hpp"
#include "core/spelling.hpp"
#include "kinematics/errors/reference_axes.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {
namespace {

AxisRange default_span(const Joint& joint, const AxisSpans& spans) {
  const auto given = spans.find(joint.letter);
  if (given != spans.end() && given->second.width() > 0.0) return given->second;
  return joint.travel;
}

HarmonicTerm wave(const ErrorShape& shape, double frequency, double origin) {
  return {shape.amount.value, frequency, origin, shape.phase.value};
}

// +1 where +q moves the part that the axis carries along its letter's direction, -1 where against
// it.
double sense_of_motion(const Joint& joint) {
  const auto along = static_cast<Eigen::Index>(joint.letter) % 3;
  return joint.side * (joint.direction[along] < 0.0 ? -1.0 : 1.0);
}

std::vector<double> values_of(const std::vector<Amount>& amounts) {
  std::vector<double> values;
  values.reserve(amounts.size());
  for (const Amount& amount : amounts) values.push_back(amount.value);
  return values;
}

// Lays a shape over its span (thesis sections 3.8 and 3.9).
PlainTerm plain_term(const ErrorShape& shape, const Joint& joint, const AxisSpans& spans) {
  const AxisRange span = shape.span ? *shape.span : default_span(joint, spans);
  const double amount = shape.amount.value;
  switch (shape.kind) {
    case ErrorShape::Kind::linear:
      return LinearTerm{amount / span.width(), shape.zero.value_or(0.0)};
    case ErrorShape::Kind::polynomial:
      return PolynomialTerm{values_of(shape.coefficients), span.middle(), 0.5 * span.width()};
    case ErrorShape::Kind::harmonic:
      // Linear axes: half periods over the span, counted from its middle; rotary axes: whole
      // periods, counted from zero.
      if (joint.rotary()) return wave(shape, kTurn * shape.order / span.width(), 0.0);
      return wave(shape, 0.5 * kTurn * shape.order / span.width(), span.middle());
    case ErrorShape::Kind::cyclic:
      return wave(shape, kTurn / shape.period, 0.0);
    case ErrorShape::Kind::reversal:
      // The part lags behind its own motion by half the jump.
      return ReversalTerm{-sense_of_motion(joint) * 0.5 * amount};
    case ErrorShape::Kind::tent:
      return TriangularTerm{amount, span.lo, shape.peak.value, span.hi};
    case ErrorShape::Kind::table:
      return TableTerm::of(shape.points, shape.interpolation, shape.periodic);
    case ErrorShape::Kind::surface:
      return shape.surface;
    case ErrorShape::Kind::field:  // check_shape() refuses it
    case ErrorShape::Kind::constant:
      break;
  }
  return ConstantTerm{amount};
}

ErrorTerm term_of(const ErrorShape& shape, const Joint& joint, const AxisSpans& spans) {
  PlainTerm term = plain_term(shape, joint, spans);
  if (!shape.factor) return std::visit([](auto& t) -> ErrorTerm { return std::move(t); }, term);
  return ModulatedTerm{std::move(term), shape.factor->axis,
                       TableTerm::of(shape.factor->points, TableKind::linear, false)};
}

struct NamedError {
  ErrorName error;
  double scale = 1.0;
  bool carries = false;
};

Result<NamedError> find_error(const Machine& machine, const std::string& name,
                              std::span<const AxisLetter> datum) {
  if (const auto alias = machine.aliases().find(name); alias != machine.aliases().end()) {
    return NamedError{alias->second.error, alias->second.scale, alias->second.carries};
  }
  if (const auto unknown = unknown_error(machine, name)) return *unknown;
  const auto error_name = ErrorName::parse(name);
  if (const auto reason = machine.refused(*error_name, datum)) {
    return error(
        "reference-axes"_id, fmt::format("error {}: {}", name, *reason),
        "choose other reference axes with the machine file's key datum, or say which ones the "
        "errors are written for: [errors] datum");
  }
  return NamedError{*error_name};
}

const char* a_length_or_an_angle(UnitKind kind) {
  return kind == UnitKind::angle ? "an angle" : "a length";
}

bool is_drawn(const ErrorShape& shape) {
  const auto drawn = [](const Amount& amount) { return !amount.drawn.empty(); };
  return drawn(shape.amount) || drawn(shape.phase) || drawn(shape.peak) ||
         std::any_of(shape.coefficients.begin(), shape.coefficients.end(), drawn);
}

// What is wrong with a shape for this error; nothing when it is right.
std::optional<Diagnostic> check_shape(const Machine& machine, const ErrorEntry& entry,
                                      const ErrorShape& shape, const ErrorName& name) {
  const auto problem = [&](const std::string& what, std::string hint) {
    return error("error-kind"_id, fmt::format("error {} = {}: {}", entry.name, entry.written, what),
                 std::move(hint));
  };
  const UnitKind wanted = is_rotation(name.direction) ? UnitKind::angle : UnitKind::length;
  const bool nothing = shape.kind == ErrorShape::Kind::constant && shape.amount.value == 0.0 &&
                       shape.amount.kind == UnitKind::none;
  if (shape.amount.kind != wanted && !nothing) {
    return problem(fmt::format("expected {}", a_length_or_an_angle(wanted)),
                   wanted == UnitKind::angle ? "for example 30 urad" : "for example 10 um");
  }
  const UnitKind along = is_rotary(name.axis) ? UnitKind::angle : UnitKind::length;
  if (shape.position_kind != UnitKind::none && shape.position_kind != along) {
    return problem(
        fmt::format("a position of {} is {}", to_char(name.axis), a_length_or_an_angle(along)),
        along == UnitKind::angle ? "for example 90 deg" : "for example 100 mm");
  }
  if (name.location && shape.kind != ErrorShape::Kind::constant) {
    return problem("a location error is a constant", "component errors such as EXX take shapes");
  }
  std::vector<AxisLetter> needed;
  if (shape.factor) needed.push_back(shape.factor->axis);
  if (shape.kind == ErrorShape::Kind::surface) {
    needed.push_back(shape.surface.first);
    needed.push_back(shape.surface.second);
  }
  for (const AxisLetter axis : needed) {
    if (machine.joint(axis) != nullptr) continue;
    return problem(fmt::format("machine {} has no axis {}", machine.name(), to_char(axis)),
                   "the error depends on its position");
  }
  return std::nullopt;
}

std::optional<Diagnostic> undrawn_field(const ErrorEntry& entry, const ErrorShape& shape) {
  if (shape.kind != ErrorShape::Kind::field) return std::nullopt;
  return error(
      "error-kind"_id,
      fmt::format("error {} = {}: a random field is drawn by a study", entry.name, entry.written),
      "frustum study draws it; write a harmonic or a table here");
}

// Names the file that an entry is in.
Diagnostic in_file_of(const ErrorEntry& entry, Diagnostic problem) {
  if (!entry.file.empty()) {
    problem.file = entry.file;
    problem.key = "errors." + entry.name;
  }
  return problem;
}

void apply(GeometricErrors& errors, const NamedError& named, ErrorFunction function,
           double constant) {
  AxisErrors& axis = errors[named.error.axis];
  const auto d = static_cast<std::size_t>(named.error.direction);
  if (named.carries) {
    axis.carried_tilt[static_cast<Eigen::Index>(d) - 3] = named.scale * constant;
  } else if (named.error.location) {
    axis.location[d] = named.scale * constant;
  } else {
    axis.component[d] = std::move(function);
  }
}

// Lays entries over the axes of one machine.
class Resolver {
 public:
  Resolver(const Machine& machine, std::span<const AxisLetter> datum, const AxisSpans& spans)
      : machine_(machine), datum_(datum), spans_(spans) {}

  void add(const ErrorEntry& entry) {
    if (!entry.datum.empty()) return;
    if (entry.grid != nullptr) {
      errors_.add_grid(entry.grid, 1.0);
      return;
    }
    const auto named = find_error(machine_, entry.name, datum_);
    if (!named) {
      for (const Diagnostic& problem : named.error()) refuse(entry, problem);
      return;
    }
    const Joint& joint = *machine_.joint(named->error.axis);
    if (std::any_of(entry.terms.begin(), entry.terms.end(), is_drawn)) undrawn_.push_back(&entry);
    ErrorFunction function;
    double constant = 0.0;
    std::optional<double> settle;
    for (const ErrorShape& written : entry.terms) {
      if (const auto problem = check_shape(machine_, entry, written, named->error)) {
        refuse(entry, *problem);
        continue;
      }
      if (const auto problem = undrawn_field(entry, written)) {
        refuse(entry, *problem);
        continue;
      }
      if (const auto problem = vanishing_span(entry, written, joint)) {
        refuse(entry, *problem);
        continue;
      }
      if (written.settle && settle && *settle != *written.settle) refuse_settle(entry, *named);
      if (written.settle) settle = written.settle;
      constant += written.amount.value;
      const ErrorFunction one({term_of(written, joint, spans_)});
      function = function.plus(one, named->scale);
    }
    apply(errors_, *named, std::move(function), constant);
    const std::string key = named->error.text();
    lost_motion_.erase(key);
    if (settle) lost_motion_[key] = {&entry, *settle, named->error.axis};
  }

  Result<GeometricErrors> result() {
    if (!undrawn_.empty()) refuse_undrawn();
    for (const auto& [key, own] : lost_motion_) {
      double& of_axis = errors_[own.axis].lost_motion;
      const auto before = first_.emplace(own.axis, &own).first->second;
      if (before->distance != own.distance) {
        refuse(*own.entry,
               error("lost-motion-distance"_id,
                     fmt::format("error {}: {} takes up its play over another distance than in {}",
                                 own.entry->name, to_char(own.axis), before->entry->name),
                     "an axis has one lost motion: give one take-up distance"));
      }
      of_axis = own.distance;
    }
    if (!problems_.empty()) return problems_;
    return errors_;
  }

 private:
  // Steeper than any machine where the axis hardly moves: a shape over that is a mistake.
  [[nodiscard]] std::optional<Diagnostic> vanishing_span(const ErrorEntry& entry,
                                                         const ErrorShape& shape,
                                                         const Joint& joint) const {
    constexpr double kLeast = 1e-3;  // mm
    constexpr double kLeastTurn = 1e-6;
    using enum ErrorShape::Kind;
    const auto given = spans_.find(joint.letter);
    const bool spans = shape.kind == linear || shape.kind == polynomial || shape.kind == harmonic ||
                       shape.kind == tent;
    if (!spans || shape.span || given == spans_.end()) return std::nullopt;
    const double width = given->second.width();
    if (width == 0.0 || width >= (joint.rotary() ? kLeastTurn : kLeast)) return std::nullopt;
    return error("error-span"_id,
                 fmt::format("error {} = {}: {} travels only {:.2g} {} in the operation of "
                             "[error_span]",
                             entry.name, entry.written, to_char(joint.letter), width,
                             joint.rotary() ? "rad" : "mm"),
                 "write a span: over 0mm..200mm; or name another operation");
  }

  struct LostMotion {
    const ErrorEntry* entry = nullptr;
    double distance = 0.0;
    AxisLetter axis = AxisLetter::X;
  };

  void refuse(const ErrorEntry& entry, const Diagnostic& problem) {
    problems_.push_back(in_file_of(entry, problem));
  }
  // Once for all of them: one word makes them right.
  void refuse_undrawn() {
    const ErrorEntry& first = *undrawn_.front();
    const std::string others =
        undrawn_.size() > 1 ? ", nor " + counted(undrawn_.size() - 1, "other") : "";
    refuse(first,
           error("error-not-drawn"_id,
                 fmt::format("error {} = {}: the amount is a distribution and has not been drawn{}",
                             first.name, first.written, others),
                 "draw it: --draw SEED, or error_draw = { seed = 1 } in the job"));
  }
  void refuse_settle(const ErrorEntry& entry, const NamedError& named) {
    refuse(entry, error("lost-motion-distance"_id,
                        fmt::format("error {}: two take-up distances of {}", entry.name,
                                    to_char(named.error.axis)),
                        "an axis has one lost motion: give one take-up distance"));
  }

  const Machine& machine_;
  std::span<const AxisLetter> datum_;
  const AxisSpans& spans_;
  GeometricErrors errors_;
  std::map<std::string, LostMotion> lost_motion_;
  std::map<AxisLetter, const LostMotion*> first_;
  std::vector<const ErrorEntry*> undrawn_;
  Diagnostics problems_;
};

}  // namespace

std::optional<Diagnostic> unknown_error(const Machine& machine, const std::string& name) {
  if (machine.aliases().contains(name)) return std::nullopt;
  const auto error_name = ErrorName::parse(name);
  const std::string lists = fmt::format("'frustum errors {}' lists the names", machine.name());
  if (!error_name) {
    std::vector<std::string> known;
    for (const ErrorName& e : machine.error_names()) known.push_back(e.text());
    for (const auto& [alias, meaning] : machine.aliases()) known.push_back(alias);
    return error("unknown-error"_id,
                 fmt::format("unknown error name '{}' for machine {}", name, machine.name()),
                 nearest_word(name, known) ? suggestion(name, known) : lists);
  }
  if (machine.joint(error_name->axis) == nullptr) {
    return error("unknown-axis"_id,
                 fmt::format("error {}: machine {} ({}) has no axis {}", name, machine.name(),
                             machine.structure(), to_char(error_name->axis)),
                 lists);
  }
  return std::nullopt;
}

Diagnostics unfit_shapes(const Machine& machine, const ErrorEntry& entry) {
  const auto alias = machine.aliases().find(entry.name);
  const auto name = alias != machine.aliases().end() ? std::optional(alias->second.error)
                                                     : ErrorName::parse(entry.name);
  if (!name || machine.joint(name->axis) == nullptr) return {};  // which unknown_error() tells
  Diagnostics problems;
  for (const ErrorShape& shape : entry.terms) {
    const auto problem = check_shape(machine, entry, shape, *name);
    if (problem) problems.push_back(in_file_of(entry, *problem));
  }
  return problems;
}

Result<GeometricErrors> resolve(const Machine& machine, std::span<const ErrorEntry> entries,
                                const AxisSpans& spans) {
  const auto stated = std::find_if(entries.begin(), entries.end(),
                                   [](const ErrorEntry& entry) { return !entry.datum.empty(); });
  const bool restate = stated != entries.end() && stated->datum != machine.datum();
  if (restate) {
    for (const AxisLetter axis : stated->datum) {
      if (machine.joint(axis) != nullptr) continue;
      return error("unknown-axis"_id,
                   fmt::format("datum: machine {} has no axis {}", machine.name(), to_char(axis)));
    }
  }
  Resolver resolver(machine, restate ? stated->datum : machine.datum(), spans);
  for (const ErrorEntry& entry : entries) resolver.add(entry);
  auto errors = resolver.result();
  if (!errors || !restate) return errors;
  return restated(machine, *errors);
}

}  // namespace frustum::kinematics
