// Job: a trial, its path, its derivatives; and the finished workpiece along rays.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "app/job/job.hpp"
#include "app/job/job_evidence.hpp"
#include "app/job/job_report.hpp"
#include "app/job/nc_file.hpp"
#include "app/job/trial_run.hpp"
#include "core/constants.hpp"
#include "core/units.hpp"
#include "parser/writing/canonical_json.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/words.hpp"
#include "report/exchange/json_report.hpp"
#include "trials/sensitivity.hpp"
#include "trials/trial.hpp"

namespace frustum::python {
namespace {

namespace py = pybind11;
using app::Job;

app::JobOverrides overrides_of(const py::object& errors, std::optional<std::uint64_t> draw,
                               const std::optional<std::string>& tool_radius_error) {
  app::JobOverrides overrides{.errors = error_words(errors),
                              .tool_radius_error = tool_radius_error};
  overrides.errors.draw = draw;
  return overrides;
}

Job loaded(const std::string& file, const app::JobOverrides& overrides) {
  const py::gil_scoped_release released;
  return required(app::load_job(file, overrides, true));
}

// Of errors that the job does not know: their shapes find their spans in its program.
struct Commanded {
  trials::CommandedPiece piece{};
  kinematics::GeometricErrors errors{};
};
Commanded commanded(const Job& job) {
  Commanded made{.piece = required(trials::command_piece(job.machine, job.piece))};
  made.errors = required(trials::errors_for(job.machine, job.errors, job.piece, made.piece));
  return made;
}

struct PathColumns {
  std::vector<std::string> axes{};
  std::vector<double> positions{};
  std::vector<Vec3> tips{}, directions{};
  std::vector<double> times{};
  std::vector<std::int64_t> lines{};
};

PathColumns path_columns(const Job& job) {
  const Commanded made = commanded(job);
  const auto travel =
      required(trials::tool_travel(job.machine, made.errors, trials::setup_of(job.piece),
                                   made.piece.program, app::trial_options_of(job)));
  const kinematics::ToolPath& path = travel.path;
  PathColumns columns{.times = path.times};
  for (const kinematics::ToolPose& pose : path.poses) {
    columns.tips.push_back(pose.tip);
    columns.directions.push_back(pose.axis);
  }
  columns.lines.assign(path.poses.size(), 0);
  for (const kinematics::PathSegment& segment : path.segments) {
    const auto line = static_cast<std::int64_t>(path.blocks[segment.block].source_line);
    columns.lines[segment.first_pose + 1] = line;
    if (columns.lines[segment.first_pose] == 0) columns.lines[segment.first_pose] = line;
  }
  std::vector<std::pair<kinematics::AxisLetter, double>> shown;
  for (const auto letter : kinematics::kAxisLetters) {
    const kinematics::Joint* joint = job.machine.joint(letter);
    if (joint == nullptr) continue;
    shown.emplace_back(letter, joint->rotary() ? kDegPerRad : 1.0);
    columns.axes.emplace_back(1, to_char(letter));
  }
  for (const kinematics::AxisState& state : path.axes) {
    for (const auto& [letter, factor] : shown)
      columns.positions.push_back(state.q[letter] * factor);
  }
  return columns;
}

py::dict path_of(const std::string& file, const py::object& errors,
                 std::optional<std::uint64_t> draw) {
  const Job job = loaded(file, overrides_of(errors, draw, std::nullopt));
  PathColumns columns;
  {
    const py::gil_scoped_release released;
    columns = path_columns(job);
  }
  py::dict path;
  path["axis_names"] = columns.axes;
  path["axes"] = array_of(columns.positions)
                     .reshape({static_cast<py::ssize_t>(columns.tips.size()),
                               static_cast<py::ssize_t>(columns.axes.size())});
  path["tip"] = array_of(columns.tips);
  path["direction"] = array_of(columns.directions);
  path["time"] = array_of(columns.times);
  path["line"] = py::array_t<std::int64_t>(static_cast<py::ssize_t>(columns.lines.size()),
                                           columns.lines.data());
  return path;
}

// --- the part ------------------------------------------------------------------------------------

class PartAlongRays {
 public:
  explicit PartAlongRays(std::shared_ptr<const stock::Workpiece> part) : part_(std::move(part)) {}

  // Intervals of all rays one after the other, and where those of each begin.
  py::tuple along(const py::object& origins, const py::object& directions, double from,
                  double to) const {
    const std::vector<Ray> rays = rays_of(origins, directions);
    check_span(from, to);
    std::vector<IntervalSet> found(rays.size());
    {
      const py::gil_scoped_release released;
      tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
        found[i] = part_->material_along(rays[i], {from, to});
      });
    }
    std::vector<std::int64_t> first{0};
    std::vector<double> ends;
    for (const IntervalSet& set : found) {
      for (const Interval& each : set.intervals()) ends.insert(ends.end(), {each.lo, each.hi});
      first.push_back(static_cast<std::int64_t>(ends.size() / 2));
    }
    return py::make_tuple(
        py::array_t<std::int64_t>(static_cast<py::ssize_t>(first.size()), first.data()),
        array_of(ends).reshape({static_cast<py::ssize_t>(ends.size() / 2), py::ssize_t{2}}));
  }

  // Where each ray enters the material first.
  py::dict first(const py::object& origins, const py::object& directions, double from,
                 double to) const {
    const std::vector<Ray> rays = rays_of(origins, directions);
    check_span(from, to);
    std::vector<std::optional<stock::SurfacePoint>> found(rays.size());
    {
      const py::gil_scoped_release released;
      tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
        found[i] = part_->first_surface(rays[i], {from, to});
      });
    }
    py::array_t<bool> hit(static_cast<py::ssize_t>(rays.size()));
    std::vector<Vec3> points(rays.size(), Vec3::Zero()), normals(rays.size(), Vec3::Zero());
    std::vector<double> s(rays.size(), 0.0), bound(rays.size(), 0.0);
    py::array_t<std::int64_t> line(static_cast<py::ssize_t>(rays.size()));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hit.mutable_data()[i] = found[i].has_value();
      line.mutable_data()[i] = found[i] ? found[i]->source_line : 0;
      if (!found[i]) continue;
      s[i] = found[i]->s;
      points[i] = found[i]->point;
      normals[i] = found[i]->normal;
      bound[i] = found[i]->bound;
    }
    py::dict all;
    all["hit"] = hit;
    all["s"] = array_of(s);
    all["point"] = array_of(points);
    all["normal"] = array_of(normals);
    all["line"] = line;
    all["bound"] = array_of(bound);
    return all;
  }

 private:
  static void check_span(double from, double to) {
    if (!(from < to) || !std::isfinite(from) || !std::isfinite(to)) {
      refuse_argument("end", fmt::format("{:g} is not above start, {:g}", to, from));
    }
  }
  static std::vector<Ray> rays_of(const py::object& origins, const py::object& directions) {
    const RowArray origin(origins, "origins", 3), direction(directions, "directions", 3);
    if (origin.rows() != direction.rows()) {
      refuse_argument("directions",
                      fmt::format("{} rows for {} origins", direction.rows(), origin.rows()));
    }
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < origin.rows(); ++i) {
      const auto unit = UnitVec3::of(direction.vector(i));
      if (!unit) refuse_argument("directions", fmt::format("row {} has no length", i));
      rays.push_back({origin.vector(i), unit->vec()});
    }
    return rays;
  }

  std::shared_ptr<const stock::Workpiece> part_;
};

class TrialOfJob {
 public:
  TrialOfJob(Job job, trials::Trial trial) : job_(std::move(job)), trial_(std::move(trial)) {}

  [[nodiscard]] py::dict values() const {
    py::dict all;
    for (const auto& c : trial_.measurement.characteristics) all[py::str(c.name)] = c.value;
    return all;
  }
  [[nodiscard]] py::dict units() const {
    py::dict all;
    for (const auto& c : trial_.measurement.characteristics) all[py::str(c.name)] = c.unit;
    return all;
  }
  [[nodiscard]] bool passes() const { return trial_.measurement.passes(); }
  [[nodiscard]] double cycle_time() const { return trial_.cycle_time; }
  [[nodiscard]] std::string json() const {
    const py::gil_scoped_release released;
    return report::json_report(app::report_of(job_, trial_, required(app::evidence_of(job_))));
  }
  [[nodiscard]] py::dict points() const {
    py::dict all;
    for (const metrology::MeasuredFeature& feature : trial_.measurement.features) {
      std::vector<Vec3> points, normals;
      std::vector<double> deviations;
      for (const metrology::MeasuredPoint& each : feature.points) {
        points.push_back(each.point);
        normals.push_back(each.normal);
        deviations.push_back(each.deviation * kUmPerMm);
      }
      py::dict of;
      of["point"] = array_of(points);
      of["normal"] = array_of(normals);
      of["deviation"] = array_of(deviations);
      all[py::str(feature.name)] = of;
    }
    return all;
  }
  [[nodiscard]] PartAlongRays workpiece() const { return PartAlongRays(trial_.workpiece); }

 private:
  Job job_;
  trials::Trial trial_;
};

TrialOfJob trial_of(const std::string& file, const py::object& errors,
                    std::optional<std::uint64_t> draw,
                    const std::optional<std::string>& tool_radius_error) {
  Job job = loaded(file, overrides_of(errors, draw, tool_radius_error));
  const py::gil_scoped_release released;
  app::TrialRun run(report::ProgressStyle::silent);
  auto trial = required(run.trial(job));
  return {std::move(job), std::move(trial)};
}

py::dict sensitivity_of(const std::string& file, const std::vector<std::string>& parameters,
                        const py::object& errors) {
  const Job job = loaded(file, overrides_of(errors, std::nullopt, std::nullopt));
  trials::Sensitivity found;
  {
    const py::gil_scoped_release released;
    const auto names = parameters.empty() ? trials::constant_errors(job.machine) : parameters;
    const auto named = required(trials::parameters_named(job.machine, names));
    const Commanded made = commanded(job);
    found = required(trials::sensitivity(job.machine, made.errors, job.piece, made.piece, named,
                                         app::path_options_of(job)));
  }
  const auto rows = static_cast<py::ssize_t>(found.odd.rows());
  const auto columns = static_cast<py::ssize_t>(found.odd.cols());
  const auto table = [&](const Eigen::MatrixXd& of) {
    Numbers all({rows, columns});
    for (py::ssize_t i = 0; i < rows; ++i) {
      for (py::ssize_t k = 0; k < columns; ++k) all.mutable_at(i, k) = of(i, k);
    }
    return all;
  };
  std::vector<std::string> characteristics, asked;
  for (const auto& c : found.measurement.characteristics) characteristics.push_back(c.name);
  for (const auto& parameter : found.parameters) asked.push_back(parameter.name);
  py::dict all;
  all["characteristics"] = characteristics;
  all["parameters"] = asked;
  all["odd"] = table(found.odd);
  all["even"] = table(found.even);
  return all;
}

// A line of JSON a motion.
std::vector<std::string> canonical_motions(const std::string& file, const std::string& dialect) {
  const py::gil_scoped_release released;
  const std::vector<std::string> known{"",          "fanuc",      "iso",   "linuxcnc",
                                       "sinumerik", "heidenhain", "cldata"};
  if (std::ranges::find(known, dialect) == known.end()) {
    refuse_argument("dialect", fmt::format("'{}' is not known", dialect),
                    "fanuc, linuxcnc, sinumerik, heidenhain or cldata");
  }
  const auto nc = required(app::open_nc(file, dialect));
  std::vector<std::string> lines;
  auto options = app::options_for(file);
  options.contours_without_diameter = true;
  const auto take = [&](parser::Motion&& motion) { lines.push_back(parser::to_json_line(motion)); };
  (void)required(parser::interpret(nc.program, take, options));
  return lines;
}

}  // namespace

void bind_job(py::module_& module) {
  py::class_<PartAlongRays>(module, "Workpiece", "The finished part, exact along any ray. mm.")
      .def("along", &PartAlongRays::along, py::arg("origins"), py::arg("directions"),
           py::arg("start") = 0.0, py::arg("end") = 1e4,
           "(first, intervals): material on each ray between start and end; the intervals of ray i "
           "are intervals[first[i]:first[i + 1]], mm along it.")
      .def("first", &PartAlongRays::first, py::arg("origins"), py::arg("directions"),
           py::arg("start") = 0.0, py::arg("end") = 1e4,
           "Where each ray enters material: hit, s, point, normal, NC line (0: blank), bound.");
  py::class_<TrialOfJob>(module, "_Trial")
      .def_property_readonly("values", &TrialOfJob::values)
      .def_property_readonly("units", &TrialOfJob::units)
      .def_property_readonly("passes", &TrialOfJob::passes)
      .def_property_readonly("cycle_time", &TrialOfJob::cycle_time)
      .def_property_readonly("points", &TrialOfJob::points)
      .def_property_readonly("workpiece", &TrialOfJob::workpiece)
      .def("json", &TrialOfJob::json);
  module.def("_trial", &trial_of);
  module.def("_path", &path_of);
  module.def("_sensitivity", &sensitivity_of);
  module.def("_motions", &canonical_motions);
}

}  // namespace frustum::python
