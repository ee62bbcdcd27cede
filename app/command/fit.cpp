// frustum fit: one associated element from points, by any criterion and under constraints.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/unit_option.hpp"
#include "app/job/number_list.hpp"
#include "app/view/console.hpp"
#include "core/program_version.hpp"
#include "core/units.hpp"
#include "metrology/fit/association.hpp"
#include "metrology/points/point_file.hpp"

namespace frustum::app {
namespace {

using metrology::Association;
using nlohmann::ordered_json;

// What a user may ask for; the words are those of associate().
constexpr std::array<const char*, 9> kElements{"line",   "line2d",   "plane", "circle", "circle2d",
                                               "sphere", "cylinder", "cone",  "torus"};
struct CriterionRow {
  const char* name;
  const char* meaning;
};
constexpr std::array<CriterionRow, 5> kCriteria{
    CriterionRow{"ls", "least squares"}, CriterionRow{"mz", "minimum zone"},
    CriterionRow{"mi", "maximum inscribed"}, CriterionRow{"mc", "minimum circumscribed"},
    CriterionRow{"om", "outside the material"}};

struct FitOptions : AnswerOptions {
  std::string element{};
  std::string points{};
  std::string criterion = "ls";
  std::string parallel{}, perpendicular{}, outward{};
  std::optional<double> radius{}, tube_radius{}, half_angle{};
  std::string unit{};
  std::optional<std::string> feature{};
  bool hole = false;
  bool unweighted = false;
};

// "i,j,k" of any length but 0.
Result<std::optional<UnitVec3>> direction_of(const std::string& text, const char* option) {
  if (text.empty()) return std::optional<UnitVec3>();
  const auto numbers = numbers_of(text, 3, option);
  if (!numbers) return numbers.error();
  const Vec3 v((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  if (!v.allFinite() || !(v.norm() > 0.0)) {
    return error("no-direction"_id, fmt::format("{} {}: not a direction", option, text),
                 "for example 0,0,1");
  }
  return std::optional<UnitVec3>(metrology::unit(v));
}

Result<metrology::AssociationOptions> association_options(const FitOptions& o) {
  metrology::AssociationOptions made;
  Diagnostics problems;
  const auto keep = [&](auto result, auto& place) {
    if (result) {
      place = *result;
    } else {
      problems.insert(problems.end(), result.error().begin(), result.error().end());
    }
  };
  made.criterion = metrology::criterion_named(o.criterion).value();
  keep(direction_of(o.parallel, "--axis"), made.constraints.parallel_to);
  keep(direction_of(o.perpendicular, "--perpendicular-to"), made.constraints.perpendicular_to);
  std::optional<UnitVec3> outward;
  keep(direction_of(o.outward, "--outward"), outward);
  if (outward) made.outward = outward->vec();
  made.constraints.radius = o.radius;
  made.constraints.tube_radius = o.tube_radius;
  if (o.half_angle) made.constraints.half_angle = *o.half_angle * kRadPerDeg;
  made.is_hole = o.hole;
  if (!problems.empty()) return problems;
  return made;
}

ordered_json coordinates_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

ordered_json parameters_of(const metrology::Element& element) {
  return std::visit(
      [](const auto& e) {
        ordered_json p{{"point", coordinates_of(e.point)}};
        if constexpr (requires { e.axis; }) p["axis"] = coordinates_of(e.axis);
        if constexpr (requires { e.radius; }) p["radius"] = e.radius;
        if constexpr (requires { e.tube_radius; }) p["tube_radius"] = e.tube_radius;
        if constexpr (requires { e.half_angle; }) p["half_angle"] = e.half_angle;
        return p;
      },
      element);
}

ordered_json matrix_json(const Eigen::MatrixXd& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

ordered_json certificate_json(const metrology::Certificate& certificate) {
  ordered_json contacts = ordered_json::array();
  for (const metrology::Contact& c : certificate.contacts) {
    contacts.push_back(
        {{"point", c.point}, {"multiplier", c.multiplier}, {"side", c.is_high ? "high" : "low"}});
  }
  return {{"contacts", std::move(contacts)},
          {"imbalance", certificate.imbalance},
          {"gap", certificate.gap}};
}

// Of fits that report how well their points determine the parameters.
template <typename Fit>
void add_condition(ordered_json& json, const Fit& fit) {
  if constexpr (requires { fit.condition; }) json["condition"] = fit.condition;
}

std::string fit_json(const FitOptions& o, const Association& found) {
  const auto& fit = found.fit;
  ordered_json json{{"schema", "frustum/fit/1"},
                    {"version", program_version()},
                    {"element", o.element},
                    {"criterion", o.criterion},
                    {"parameters", parameters_of(fit.element)},
                    {"form", fit.form},
                    {"rms", fit.rms},
                    {"residuals", fit.residuals},
                    {"covariance", matrix_json(fit.covariance)},
                    {"iterations", fit.iterations}};
  add_condition(json, fit);
  if (found.certificate) json["certificate"] = certificate_json(*found.certificate);
  return json.dump(2) + '\n';
}

// How each parameter is shown to people.
struct ParameterRow {
  const char* name;
  double factor;
  const char* unit;
};
constexpr std::array<ParameterRow, 5> kParameters{
    ParameterRow{"point", 1.0, "mm"}, ParameterRow{"axis", 1.0, ""},
    ParameterRow{"radius", 1.0, "mm"}, ParameterRow{"tube_radius", 1.0, "mm"},
    ParameterRow{"half_angle", kDegPerRad, "deg"}};

std::string parameter_text(const ordered_json& value, const ParameterRow& row) {
  std::string text;
  const ordered_json list = value.is_array() ? value : ordered_json::array({value});
  for (const auto& number : list) {
    text += fmt::format("{}{:.9f}", text.empty() ? "" : "  ", row.factor * number.get<double>());
  }
  return text + (*row.unit == 0 ? "" : " ") + row.unit;
}

std::string fit_text(const FitOptions& o, const Association& found, std::size_t points) {
  const auto& fit = found.fit;
  const auto* const criterion =
      std::find_if(kCriteria.begin(), kCriteria.end(),
                   [&](const CriterionRow& row) { return o.criterion == row.name; });
  std::string text = fmt::format("{} by {}, {} points\n", o.element, criterion->meaning, points);
  const ordered_json parameters = parameters_of(fit.element);
  for (const ParameterRow& row : kParameters) {
    if (!parameters.contains(row.name)) continue;
    text += fmt::format("  {:<11} {}\n", row.name, parameter_text(parameters[row.name], row));
  }
  text += fmt::format("  form        {:.6f} um\n  rms         {:.6f} um\n", fit.form * kUmPerMm,
                      fit.rms * kUmPerMm);
  if (found.certificate) {
    text += fmt::format("  contacts    {}; no better element near by more than {:.2g} um\n",
                        found.certificate->contacts.size(), found.certificate->gap * kUmPerMm);
  }
  return text;
}

int fit(const FitOptions& o) {
  auto options = association_options(o);
  if (!options) return refuse(options.error(), o);
  const auto unit = unit_of(o.unit);
  if (!unit) return refuse(unit.error(), o);
  auto cloud = metrology::read_point_cloud(o.points, *unit, o.feature);
  if (!cloud) return refuse(cloud.error(), o);
  if (!o.unweighted) options->weights = std::move(cloud->weights);
  const auto found = metrology::associate(o.element, cloud->points, *options);
  if (!found) {
    Diagnostics problems = found.error();
    for (Diagnostic& d : problems) d.file = o.points;
    return refuse(problems, o);
  }
  if (o.json) {
    std::cout << fit_json(o, *found);
  } else if (!o.quiet) {
    std::cout << fit_text(o, *found, cloud->points.size());
  }
  return kDone;
}

template <typename Rows, typename Name>
std::vector<std::string> names_of(const Rows& rows, Name name) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(name(row));
  return names;
}

void add_constraints(Command& command, FitOptions& o) {
  command.option("--axis", o.parallel, "i,j,k: the axis, or the normal, is parallel to this");
  command.option("--perpendicular-to", o.perpendicular,
                 "i,j,k: the axis, or the normal, is perpendicular to this");
  command.option("--radius", o.radius, "Fixed radius, mm").holds(positive_number());
  command.option("--tube-radius", o.tube_radius, "Fixed radius of a torus' tube, mm")
      .holds(positive_number());
  command.option("--half-angle", o.half_angle, "Fixed half angle of a cone, degrees")
      .holds(positive_number());
  command.option("--outward", o.outward, "i,j,k: out of the material, for a plane or line2d by om");
  command.flag("--hole", o.hole, "By om: the points are those of a hole, not of a boss");
}

}  // namespace

void add_fit(Command& program) {
  auto o = std::make_shared<FitOptions>();
  Command command = program.command("fit", "One element fitted to points");
  const auto elements = names_of(kElements, [](const char* name) { return name; });
  const auto criteria = names_of(kCriteria, [](const CriterionRow& row) { return row.name; });
  command.option("element", o->element, fmt::format("{}", fmt::join(elements, ", ")))
      .required()
      .one_of(elements);
  command
      .option("points", o->points,
              "CSV or columns x y z, or a PLY; mm unless the file states a unit")
      .required();
  command.option("--feature", o->feature,
                 "The points of this feature, of a file that has several (as points.csv of run)");
  std::string meanings;
  for (const CriterionRow& row : kCriteria) {
    meanings += fmt::format("{}{}: {}", meanings.empty() ? "" : ", ", row.name, row.meaning);
  }
  command.option("--criterion", o->criterion, meanings + " (ls)").one_of(criteria);
  add_constraints(command, *o);
  command.flag("--unweighted", o->unweighted, "Leave the column weight of the file aside");
  add_unit_option(command, o->unit);
  add_answer_options(command, *o);
  command.footer("Example: frustum fit cylinder points.csv --criterion mz --axis 0,0,1 --json");
  command.computes([o] { return fit(*o); });
}

}  // namespace frustum::app
