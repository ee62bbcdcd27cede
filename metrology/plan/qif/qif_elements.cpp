#include "metrology/plan/qif/qif_elements.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"

namespace frustum::metrology {

using pugi::xml_node;

QifElements::QifElements(const QifDocument& document) : document_(document) {
  const xml_node units = root().child("FileUnits").child("PrimaryUnits");
  length_unit_ = qif_text(units.child("LinearUnit").child("UnitName"));
  take_angular_unit();
}

void QifElements::take_angular_unit() {
  const xml_node unit = root().child("FileUnits").child("PrimaryUnits").child("AngularUnit");
  angle_unit_ = qif_text(unit.child("UnitName"));
  const xml_node factor = unit.child("UnitConversion").child("Factor");
  if (!factor) return;
  const auto stated = qif_numbers(factor);
  rad_ = stated && stated->size() == 1 ? stated->front() : 0.0;
  // A degree in however many digits.
  constexpr double kDigits = 1e-6;
  if (std::abs(rad_ / kRadPerDeg - 1.0) < kDigits) rad_ = kRadPerDeg;
  if (rad_ > 0.0 && std::isfinite(rad_)) return;
  note(unit, "angle-unit"_id, "has a unit that is none",
       "AngularUnit/UnitConversion/Factor says how many radians a unit is");
  rad_ = 1.0;
}

void QifElements::note(xml_node element, DiagnosticId id, std::string_view message,
                       std::string hint) {
  noted_.push_back(document_.fault(element, id, message, std::move(hint)));
}

void QifElements::add_list(xml_node list) {
  for (const xml_node element : list) {
    const auto id = element.attribute("id");
    if (!id || by_id_.emplace(id.value(), element).second) continue;
    note(element, "bad-reference"_id, "has an id that another element has",
         "each id is expected once");
  }
}

xml_node QifElements::with_id(const std::string& id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? xml_node() : found->second;
}

xml_node QifElements::referred(xml_node from, const char* name, std::string_view expected) {
  const std::string id = qif_text(from.child(name));
  const xml_node found = with_id(id);
  if (found && found.name() == expected) return found;
  note(from, "bad-reference"_id,
       id.empty() ? fmt::format("has no <{}>", name)
       : found    ? fmt::format("refers by <{}> to {}, a <{}>", name, id, found.name())
                  : fmt::format("refers by <{}> to {}, which is not there", name, id),
       fmt::format("the id of a <{}> is expected", expected));
  return {};
}

void QifElements::refuse_second(xml_node element) {
  const xml_node second = element.next_sibling(element.name());
  if (second) note(second, "bad-numbers"_id, "is there twice", "it is expected once");
}

double QifElements::number(xml_node parent, const char* name, const char* unit_attribute,
                           const std::string& unit) {
  const xml_node element = parent.child(name);
  if (!element) {
    note(parent, "missing-element"_id, fmt::format("has no <{}>", name), "a number is expected");
    return 1.0;
  }
  refuse_second(element);
  const auto numbers = qif_numbers(element);
  if (!numbers || numbers->size() != 1) {
    note(element, "bad-numbers"_id, fmt::format("is '{}'", qif_text(element)),
         "one finite number is expected");
    return 1.0;
  }
  const auto own = element.attribute(unit_attribute);
  if (own && own.value() != unit) {
    note(element, "own-unit"_id, fmt::format("has a unit of its own, {}", own.value()),
         fmt::format("the primary unit of the document is expected: {}", unit));
  }
  return numbers->front();
}

double QifElements::length(xml_node parent, const char* name) {
  return number(parent, name, "linearUnit", length_unit_) * document_.mm();
}

double QifElements::positive_length(xml_node parent, const char* name) {
  const double value = length(parent, name);
  if (value > 0.0) return value;
  note(parent.child(name), "plan-value"_id, fmt::format("is {:g} mm", value),
       "a length greater than 0 is expected");
  return 1.0;
}

double QifElements::angle(xml_node parent, const char* name) {
  return number(parent, name, "angularUnit", angle_unit_) * rad_;
}

Vec3 QifElements::triple(xml_node parent, const char* name) {
  const xml_node element = parent.child(name);
  if (!element) {
    note(parent, "missing-element"_id, fmt::format("has no <{}>", name),
         "three numbers are expected");
    return Vec3::UnitZ();
  }
  refuse_second(element);
  const auto numbers = qif_numbers(element);
  if (numbers && numbers->size() == 3) return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  note(element, "bad-numbers"_id, fmt::format("is '{}'", qif_text(element)),
       "three finite numbers are expected");
  return Vec3::UnitZ();
}

Vec3 QifElements::place(xml_node parent, const char* name) {
  const auto own = parent.child(name).attribute("linearUnit");
  if (own && own.value() != length_unit_) {
    note(parent.child(name), "own-unit"_id, fmt::format("has a unit of its own, {}", own.value()),
         fmt::format("the primary unit of the document is expected: {}", length_unit_));
  }
  return triple(parent, name) * document_.mm();
}

Vec3 QifElements::direction(xml_node parent, const char* name) {
  const Vec3 found = triple(parent, name);
  // Unit vectors are written in a few digits at worst.
  if (std::abs(found.norm() - 1.0) < 1e-3) return found;
  note(parent.child(name), "bad-numbers"_id, fmt::format("has the length {:g}", found.norm()),
       "a unit vector is expected");
  return Vec3::UnitZ();
}

}  // namespace frustum::metrology
