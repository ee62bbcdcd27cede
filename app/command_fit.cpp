// frustum fit: one associated element from points.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/console.hpp"
#include "metrology/least_squares.hpp"
#include "metrology/point_file.hpp"

namespace frustum::app {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string element{};
  std::string points{};
  std::string criterion = "ls";
  bool json = false;
};

ordered_json numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

ordered_json parameters_of(const metrology::Element& element) {
  return std::visit(
      [](const auto& e) {
        ordered_json p{{"point", numbers(e.point)}};
        if constexpr (requires { e.axis; }) p["axis"] = numbers(e.axis);
        if constexpr (requires { e.radius; }) p["radius"] = e.radius;
        if constexpr (requires { e.tube_radius; }) p["tube_radius"] = e.tube_radius;
        if constexpr (requires { e.half_angle; }) p["half_angle"] = e.half_angle;
        return p;
      },
      element);
}

int fit(const Options& options) {
  const auto points = metrology::read_points(options.points);
  if (!points) return refuse(points.error());
  const auto fitted = metrology::fit_element(options.element, *points);
  if (!fitted) {
    Diagnostics problems = fitted.error();
    for (Diagnostic& d : problems) d.file = options.points;
    return refuse(problems);
  }
  const ordered_json parameters = parameters_of(fitted->element);
  if (!options.json) {
    std::cout << fmt::format("{} by least squares, {} points\n", options.element, points->size());
    for (const auto& [name, value] : parameters.items()) {
      std::cout << fmt::format("  {:<11} {}\n", name, value.dump());
    }
    std::cout << fmt::format("  form        {:.6f} um\n  rms         {:.6f} um\n",
                             fitted->form * kUmPerMm, fitted->rms * kUmPerMm);
    return kDone;
  }
  ordered_json covariance = ordered_json::array();
  for (Eigen::Index i = 0; i < fitted->covariance.rows(); ++i) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index j = 0; j < fitted->covariance.cols(); ++j)
      row.push_back(fitted->covariance(i, j));
    covariance.push_back(row);
  }
  std::cout << ordered_json{{"element", options.element}, {"criterion", options.criterion},
                            {"parameters", parameters},   {"form", fitted->form},
                            {"rms", fitted->rms},         {"residuals", fitted->residuals},
                            {"covariance", covariance}}
                   .dump(2)
            << '\n';
  return kDone;
}

}  // namespace

void add_fit(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("fit", "One element fitted to points");
  command
      ->add_option("element", options->element,
                   "line, line2d, plane, circle, circle2d, sphere, cylinder, cone or torus")
      ->required()
      ->check(CLI::IsMember({"line", "line2d", "plane", "circle", "circle2d", "sphere", "cylinder",
                             "cone", "torus"}));
  command->add_option("points", options->points, "CSV or columns x y z, mm")->required();
  command->add_option("--criterion", options->criterion, "ls: least squares")
      ->check(CLI::IsMember({"ls"}));
  command->add_flag("--json", options->json, "One JSON document on stdout (mm, rad)");
  command->footer("Example: frustum fit cone points.csv --json");
  command->callback([options, &exit_code] { exit_code = fit(*options); });
}

}  // namespace frustum::app
