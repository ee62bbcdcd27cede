#include "report/exchange/junit_report.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>
#include <string_view>
#include <unordered_set>

#include "core/program_version.hpp"
#include "report/form_parameter.hpp"
#include "report/html/html_text.hpp"
#include "report/number_text.hpp"
#include "report/verdict.hpp"

namespace frustum::report {
namespace {

using metrology::CharacteristicResult;
using pugi::xml_node;

class Suite {
 public:
  Suite(xml_node suite, std::string part) : suite_(suite), part_(std::move(part)) {
    xml_node property = suite_.append_child("properties").append_child("property");
    property.append_attribute("name") = "frustum.version";
    property.append_attribute("value") = std::string(program_version()).c_str();
  }

  // A test that passes has no message: what is doubtful of its uncertainty is its output.
  void pass(const std::string& name, std::string_view doubt) {
    xml_node node = add_case(name);
    if (doubt.empty()) return;
    node.append_child("system-out")
        .text()
        .set(fmt::format("coverage of the uncertainty: {}", doubt).c_str());
  }
  void fail(const std::string& name, const char* type, const std::string& message) {
    ++failures_;
    add_fault(name, "failure", type, message);
  }
  void error(const std::string& name, const char* type, const std::string& message) {
    ++errors_;
    add_fault(name, "error", type, message);
  }
  // The counts, on this and on the root.
  void close(xml_node root) {
    for (xml_node node : {root, suite_}) {
      node.append_attribute("name") = part_.c_str();
      node.append_attribute("tests") = tests_;
      node.append_attribute("failures") = failures_;
      node.append_attribute("errors") = errors_;
      node.append_attribute("time") = "0";
    }
  }

 private:
  xml_node add_case(const std::string& name) {
    ++tests_;
    xml_node node = suite_.append_child("testcase");
    node.append_attribute("name") = readable_text(name).c_str();
    node.append_attribute("classname") = part_.c_str();
    node.append_attribute("time") = "0";
    return node;
  }
  void add_fault(const std::string& name, const char* element, const char* type,
                 const std::string& message) {
    xml_node fault = add_case(name).append_child(element);
    fault.append_attribute("type") = type;
    fault.append_attribute("message") = readable_text(message).c_str();
  }

  xml_node suite_;
  std::string part_;
  int tests_ = 0, failures_ = 0, errors_ = 0;
};

std::string shortfall(const CharacteristicResult& c) {
  const std::string parameter = parameter_text(c.kind, c.parameter);
  std::string text = fmt::format("{}{}value {} {}", parameter, parameter.empty() ? "" : ": ",
                                 result_text(c), c.unit);
  if (const std::string nominal = nominal_text(c); !nominal.empty()) text += ", nominal " + nominal;
  text += fmt::format(", tolerance {}, expanded uncertainty ", value_text(c.tolerance, c.unit));
  if (c.is_accuracy_unknown) return text + "not stated";
  const bool is_proven = doubt_of(c).empty();
  text += fmt::format("{} ({})", uncertainty_text(c.expanded_uncertainty),
                      is_proven ? "95 %" : "coverage not proven");
  if (c.interval)
    text += fmt::format(", {}interval {}", is_proven ? "95 % " : "", interval_text(c));
  return text;
}

void add_characteristic(Suite& suite, const CharacteristicResult& c) {
  switch (outcome_of(c)) {
    case Outcome::pass:
      return suite.pass(c.name, doubt_of(c));
    case Outcome::fail:
      return suite.fail(c.name, "out of tolerance", shortfall(c));
    case Outcome::uncertain:
      return suite.fail(c.name, "uncertain", shortfall(c));
    case Outcome::not_measured:
      return suite.error(c.name, "not measured", "the value is not a finite number");
  }
}

std::string faults_of(const RunReport& report) {
  std::string text;
  const auto add = [&](const std::string& line) { text += (text.empty() ? "" : "; ") + line; };
  for (const Diagnostics* diagnostics : {&report.diagnostics, &report.measurement.diagnostics}) {
    for (const Diagnostic& d : *diagnostics) {
      if (d.severity == Severity::error) add(to_string(d));
    }
  }
  for (const Collision& collision : report.collisions) add("collision: " + collision.text);
  return text;
}

}  // namespace

std::string junit_report(const RunReport& report, const metrology::InspectionPlan& plan) {
  pugi::xml_document document;
  xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  xml_node root = document.append_child("testsuites");
  Suite suite(root.append_child("testsuite"), readable_text(report.title));
  const std::string faults = faults_of(report);
  bool is_told = faults.empty();
  for (const CharacteristicResult& c : report.measurement.characteristics) {
    add_characteristic(suite, c);
  }
  std::unordered_set<std::string_view> measured;
  for (const CharacteristicResult& c : report.measurement.characteristics) measured.insert(c.name);
  for (const metrology::PlannedCharacteristic& planned : plan.characteristics) {
    if (measured.contains(planned.name)) continue;
    suite.error(planned.name, "not measured", faults.empty() ? "no result" : faults);
    is_told = true;
  }
  if (!is_told) suite.error("run", "fault", faults);
  suite.close(root);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

}  // namespace frustum::report
