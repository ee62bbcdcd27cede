// Machine: axes, forward and inverse kinematics of many positions at once.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "app/job/machine_files.hpp"
#include "core/constants.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/words.hpp"

namespace frustum::python {

namespace py = pybind11;
using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Joint;
using kinematics::Machine;

app::ErrorWords error_words(const py::object& errors) {
  app::ErrorWords words;
  if (errors.is_none()) return words;
  const auto take = [&words](const py::handle& each) {
    if (py::isinstance<py::str>(each) || py::hasattr(each, "__fspath__")) {
      words.files.push_back(each.cast<std::filesystem::path>().string());
      return;
    }
    if (!py::isinstance<py::dict>(each)) {
      refuse_argument("errors", "neither the name of an error file nor a dict",
                      "for example {\"EX0C\": \"10 um\"}");
    }
    for (const auto& [name, value] : py::reinterpret_borrow<py::dict>(each)) {
      words.errors.push_back(std::string(py::str(name)) + "=" + std::string(py::str(value)));
    }
  };
  if (py::isinstance<py::list>(errors) || py::isinstance<py::tuple>(errors)) {
    for (const py::handle each : errors) take(each);
  } else {
    take(errors);
  }
  return words;
}

kinematics::GeometricErrors errors_of(const py::object& errors, const Machine& machine,
                                      std::optional<std::uint64_t> draw) {
  auto words = error_words(errors);
  words.draw = draw;
  const auto entries =
      required(app::gather_errors({}, words, app::drawn_by(words, std::nullopt), machine));
  return required(kinematics::resolve(machine, entries));
}

namespace {

// Rows of such positions have the axes that the machine has, in the order of axis letters.
class AxisColumns {
 public:
  explicit AxisColumns(const Machine& machine) {
    for (const AxisLetter letter : kinematics::kAxisLetters) {
      if (const Joint* joint = machine.joint(letter)) axes_.push_back({letter, joint->rotary()});
    }
  }
  [[nodiscard]] std::size_t count() const { return axes_.size(); }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& axis : axes_) names.emplace_back(1, to_char(axis.letter));
    return names;
  }
  // mm and degrees.
  [[nodiscard]] AxisPositions read(std::span<const double> row) const {
    AxisPositions q;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      q[axes_[k].letter] = axes_[k].rotary ? row[k] * kRadPerDeg : row[k];
    }
    return q;
  }
  void write(const AxisPositions& q, double* row) const {
    for (const auto& axis : axes_) {
      *row++ = axis.rotary ? q[axis.letter] * kDegPerRad : q[axis.letter];
    }
  }

 private:
  struct Column {
    AxisLetter letter = AxisLetter::X;
    bool rotary = false;
  };
  std::vector<Column> axes_{};
};

void check_tool_length(double tool_length) {
  constexpr double kLongest = 1e9;  // mm, as far as axes go
  if (tool_length >= 0.0 && tool_length <= kLongest) return;
  refuse_argument("tool_length",
                  fmt::format("{}: expected a length in mm, 0 to {:g}", tool_length, kLongest));
}

// Few poses are not worth another thread.
constexpr std::size_t kGrain = 512;

py::tuple pose(const Machine& machine, const py::object& axes, const py::object& errors,
               double tool_length, const py::object& approach, std::optional<std::uint64_t> draw) {
  check_tool_length(tool_length);
  const AxisColumns columns(machine);
  const RowArray at(axes, "axes", columns.count());
  std::optional<RowArray> heading;
  if (!approach.is_none()) {
    heading.emplace(approach, "approach", columns.count());
    if (heading->rows() != at.rows()) {
      refuse_argument("approach",
                      fmt::format("{} rows for {} of axes", heading->rows(), at.rows()));
    }
    for (std::size_t i = 0; i < heading->rows(); ++i) {
      for (const double each : heading->row(i)) {
        if (std::abs(each) > 1.0) {
          refuse_argument("approach", fmt::format("row {}: {} is not within -1 .. 1", i, each));
        }
      }
    }
  }
  const auto geometric = errors_of(errors, machine, draw);
  Numbers tips = at.like(3), directions = at.like(3);
  double *tip = tips.mutable_data(), *direction = directions.mutable_data();
  {
    const py::gil_scoped_release released;
    const kinematics::ForwardChain chain(machine, geometric, tool_length);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, at.rows(), kGrain),
                      [&](const auto& range) {
                        for (std::size_t i = range.begin(); i < range.end(); ++i) {
                          kinematics::AxisState state{columns.read(at.row(i)), {}};
                          if (heading) {
                            const auto row = heading->row(i);
                            std::size_t k = 0;
                            for (const AxisLetter letter : kinematics::kAxisLetters) {
                              if (machine.joint(letter) != nullptr)
                                state.heading[letter] = row[k++];
                            }
                          }
                          const auto tool = kinematics::tool_pose(chain.table_from_tool(state));
                          std::copy_n(tool.tip.data(), 3, tip + 3 * i);
                          std::copy_n(tool.axis.data(), 3, direction + 3 * i);
                        }
                      });
  }
  return py::make_tuple(tips, directions);
}

Numbers inverse(const Machine& machine, const py::object& tips, const py::object& directions,
                double tool_length, const py::object& previous) {
  check_tool_length(tool_length);
  const AxisColumns columns(machine);
  const RowArray tip(tips, "tip", 3), direction(directions, "direction", 3);
  if (tip.rows() != direction.rows()) {
    refuse_argument("direction", fmt::format("{} rows for {} tips", direction.rows(), tip.rows()));
  }
  AxisPositions at = machine.home();
  if (!previous.is_none()) {
    at = columns.read(RowArray(previous, "previous", columns.count()).only_row());
  }
  Numbers axes = tip.like(columns.count());
  double* row = axes.mutable_data();
  const py::gil_scoped_release released;
  for (std::size_t i = 0; i < tip.rows(); ++i, row += columns.count()) {
    const auto axis = UnitVec3::of(direction.vector(i));
    if (!axis) refuse_argument("direction", fmt::format("row {} has no length", i));
    const auto found = kinematics::inverse(machine, {tip.vector(i), *axis}, tool_length, at);
    if (!found) {
      Diagnostics problems = found.error();
      for (Diagnostic& each : problems) each.message = fmt::format("row {}: {}", i, each.message);
      throw Refused(std::move(problems));
    }
    at = found->front().axes;
    if (!found->front().within_travel) {
      const auto beyond = kinematics::travel_violations(machine, at);
      Diagnostic problem = error("axis-overtravel"_id, fmt::format("row {}: beyond travel: {}", i,
                                                                   fmt::join(beyond, "; ")));
      problem.key = "tip";
      throw Refused({std::move(problem)});
    }
    columns.write(at, row);
  }
  return axes;
}

Numbers travels(const Machine& machine) {
  const auto names = AxisColumns(machine).names();
  Numbers all({static_cast<py::ssize_t>(names.size()), py::ssize_t{2}});
  double* to = all.mutable_data();
  for (const AxisLetter letter : kinematics::kAxisLetters) {
    const Joint* joint = machine.joint(letter);
    if (joint == nullptr) continue;
    const double factor = joint->rotary() ? kDegPerRad : 1.0;
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    *to++ = joint->endless ? -kEndless : joint->travel.lo * factor;
    *to++ = joint->endless ? kEndless : joint->travel.hi * factor;
  }
  return all;
}

}  // namespace

void bind_machine(py::module_& module) {
  py::class_<Machine>(module, "Machine",
                      "A machine file, or a shipped machine by its name.\n\n"
                      "Positions are arrays (n, axes) in mm and degrees, a column an axis in the "
                      "order of `axes`.")
      .def(py::init([](const std::filesystem::path& name) {
             return required(app::load_machine(name.string(), "."));
           }),
           py::arg("name"))
      .def_property_readonly("name", &Machine::name)
      .def_property_readonly("title", &Machine::title)
      .def_property_readonly("structure", &Machine::structure)
      .def_property_readonly("axes", [](const Machine& m) { return AxisColumns(m).names(); })
      .def_property_readonly("travels", &travels,
                             "(axes, 2), mm and degrees; infinite where endless")
      .def("pose", &pose, py::arg("axes"), py::arg("errors") = py::none(),
           py::arg("tool_length") = 0.0, py::arg("approach") = py::none(),
           py::arg("draw") = py::none(),
           "Tip (mm) and tool axis in the frame of the table, each (n, 3). errors: a dict "
           "{\"EX0C\": \"10 um\"}, an error file, or a list of them. approach: -1 to 1 for each "
           "axis, "
           "the direction it came in. draw: seed of errors that are written as "
           "distributions.")
      .def("inverse", &inverse, py::arg("tip"), py::arg("direction"), py::arg("tool_length") = 0.0,
           py::arg("previous") = py::none(),
           "Axis positions of the nominal machine for each tip and tool axis: the solution within "
           "travel that is nearest to the one before, the first nearest to `previous` (default: "
           "home). Refused: a tip that no position within travel reaches.")
      .def("__repr__", [](const Machine& m) { return "frustum.Machine(" + m.name() + ")"; });
  module.def(
      "machines",
      [] {
        std::vector<std::string> names;
        for (const auto& file : app::shipped_machines()) names.push_back(file.stem().string());
        return names;
      },
      "Names of the shipped machines.");
}

}  // namespace frustum::python
