// Fits of elements, and what the commands identify, motion and dynamics answer.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include "app/dynamics/dynamics_answer.hpp"
#include "app/dynamics/dynamics_json.hpp"
#include "app/job/machine_files.hpp"
#include "app/motion/measured_motion.hpp"
#include "app/motion/test_file.hpp"
#include "app/view/identification_view.hpp"
#include "dynamics/model_file.hpp"
#include "metrology/fit/association.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/words.hpp"

namespace frustum::python {
namespace {

namespace py = pybind11;

py::dict parameters_of(const metrology::Element& element) {
  py::dict all;
  std::visit(
      [&](const auto& e) {
        const auto vector = [](const Vec3& v) {
          return array_of(std::vector<double>(v.begin(), v.end()));
        };
        all["point"] = vector(e.point);
        if constexpr (requires { e.axis; }) all["axis"] = vector(e.axis);
        if constexpr (requires { e.radius; }) all["radius"] = e.radius;
        if constexpr (requires { e.tube_radius; }) all["tube_radius"] = e.tube_radius;
        if constexpr (requires { e.half_angle; }) all["half_angle"] = e.half_angle;
      },
      element);
  return all;
}

std::optional<UnitVec3> direction_of(const py::object& given, const std::string& name) {
  if (given.is_none()) return std::nullopt;
  const auto unit = UnitVec3::of(Vec3(RowArray(given, name, 3).only_row().data()));
  if (!unit) refuse_argument(name, "a direction without length", "for example (0, 0, 1)");
  return unit;
}

py::dict fit(const std::string& element, const py::object& points, const std::string& criterion,
             const py::object& axis, std::optional<double> radius, std::optional<double> half_angle,
             const py::object& weights, const py::object& outward, bool hole) {
  const RowArray rows(points, "points", 3);
  const auto by = metrology::criterion_named(criterion);
  if (!by) {
    refuse_argument("criterion", fmt::format("'{}' is not known", criterion),
                    fmt::format("{}", fmt::join(metrology::kCriterionNames, ", ")));
  }
  metrology::AssociationOptions options{.criterion = *by, .is_hole = hole};
  options.constraints.parallel_to = direction_of(axis, "axis");
  options.constraints.radius = radius;
  options.constraints.half_angle = half_angle;
  if (const auto out = direction_of(outward, "outward")) options.outward = out->vec();
  if (!weights.is_none()) {
    const RowArray given(weights, "weights", rows.rows());
    options.weights.assign(given.only_row().begin(), given.only_row().end());
  }
  const std::vector<Vec3> cloud = rows.vectors();
  metrology::Association found;
  {
    const py::gil_scoped_release released;
    found = required(metrology::associate(element, cloud, options));
  }
  py::dict all;
  all["element"] = element;
  all["criterion"] = criterion;
  all["parameters"] = parameters_of(found.fit.element);
  all["form"] = found.fit.form;
  all["rms"] = found.fit.rms;
  all["residuals"] = array_of(found.fit.residuals);
  if (found.certificate) all["gap"] = found.certificate->gap;
  return all;
}

std::string identify(const std::string& file) {
  const py::gil_scoped_release released;
  const auto study = required(app::load_study(file, app::read_measured_motion));
  return app::identification_json(study, required(app::identify_study(study)));
}

py::tuple motion(const std::string& file, const py::object& errors,
                 std::optional<std::uint64_t> draw) {
  auto words = error_words(errors);
  words.draw = draw;
  std::string document;
  std::vector<std::string> warnings;
  {
    const py::gil_scoped_release released;
    auto test = required(app::read_test_file(file));
    app::common_words(test.words).errors = words;
    auto answered = app::answer_of(test.words);
    if (!answered) throw Refused(app::in_test_file(test, answered.error()));
    const auto answer = *std::move(answered);
    document = answer.document.json();
    for (const Diagnostic& each : answer.warnings) warnings.push_back(to_string(each));
  }
  return py::make_tuple(document, warnings);
}

std::string dynamics_document(const std::string& name, const std::string& at, double tool_length,
                              const std::string& frequencies, const std::string& rates,
                              const std::string& map, const std::string& quantity,
                              std::size_t modes) {
  const py::gil_scoped_release released;
  const auto file = required(app::find_machine(name, "."));
  const auto machine = required(kinematics::Machine::load(file));
  const auto model = required(frustum::dynamics::load_model(file, machine));
  if (!model) throw Refused({frustum::dynamics::no_dynamics(machine, file)});
  const auto request = required(app::read_dynamics_request(machine, *model,
                                                           {.axes = at,
                                                            .tool_length = tool_length,
                                                            .frequencies = frequencies,
                                                            .rates = rates,
                                                            .map = map,
                                                            .quantity = quantity}));
  const auto answer = required(app::answer_dynamics(*model, request));
  return app::dynamics_json({machine, *model, request, answer, modes, std::nullopt, std::nullopt});
}

}  // namespace

void bind_answers(py::module_& module) {
  module.def("fit", &fit, py::arg("element"), py::arg("points"), py::kw_only(),
             py::arg("criterion") = "ls", py::arg("axis") = py::none(),
             py::arg("radius") = py::none(), py::arg("half_angle") = py::none(),
             py::arg("weights") = py::none(), py::arg("outward") = py::none(),
             py::arg("hole") = false,
             "The element (line, plane, circle, sphere, cylinder, cone, torus, line2d, circle2d) "
             "associated with points (n, 3), mm: parameters (half_angle in rad), form, rms, "
             "residuals. criterion: ls, mz, mi, mc, om.");
  module.def("_identify", &identify);
  module.def("_motion", &motion);
  module.def("_dynamics", &dynamics_document);
}

}  // namespace frustum::python
