#include "app/dynamics/dynamics_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "report/number_text.hpp"
#include "report/page/dynamics_page.hpp"

namespace frustum::app {
namespace {

using dynamics::DynamicModel;
using dynamics::FrequencyResponse;
using report::DynamicsPage;
using report::DynamicsTable;
using report::fixed_text;

constexpr const char* kDirectionNames[] = {"x", "y", "z"};

std::vector<FrequencyResponse> responses_of(const DynamicsAnswer& answer) {
  std::vector<FrequencyResponse> responses;
  for (Eigen::Index force = 0; force < 3; ++force) {
    for (Eigen::Index motion = 0; motion < 3; ++motion) {
      FrequencyResponse r{motion, force, {}, {}};
      for (const FrequencyAnswer& f : answer.frequencies) {
        if (!r.frequencies.empty() && f.frequency <= r.frequencies.back()) continue;
        r.frequencies.push_back(f.frequency);
        r.compliance.push_back(f.compliance(motion, force));
      }
      responses.push_back(std::move(r));
    }
  }
  return responses;
}

report::FrequencyLine line_of(const FrequencyResponse& response, bool measured) {
  report::FrequencyLine line{
      kDirectionNames[response.motion], response.frequencies, {}, {}, measured};
  for (const auto& g : response.compliance) {
    line.magnitude.push_back(std::abs(g) * kMicrometres);
    line.phase.push_back(std::arg(g) * kDegPerRad);
  }
  return line;
}

std::vector<report::FrequencyChart> charts_of(std::span<const FrequencyResponse> computed,
                                              std::span<const FrequencyResponse> measured) {
  constexpr double kToldByAHammer = 0.02;  // of the direct response: 1.75 % at 1 deg askew
  std::vector<report::FrequencyChart> charts;
  for (Eigen::Index force = 0; force < 3; ++force) {
    report::FrequencyChart chart{
        fmt::format("Force along {}", kDirectionNames[force]), "µm/N", {}, {}};
    for (const FrequencyResponse& r : computed) {
      if (r.force != force) continue;
      chart.lines.push_back(line_of(r, false));
      if (r.motion != force) continue;
      for (const double size : chart.lines.back().magnitude) {
        chart.floor.push_back(kToldByAHammer * size);
      }
    }
    for (const FrequencyResponse& r : measured) {
      if (r.force == force) chart.lines.push_back(line_of(r, true));
    }
    charts.push_back(std::move(chart));
  }
  return charts;
}

DynamicsTable modes_table(const DynamicModel& model, const DynamicsAnswer& answer,
                          std::size_t count) {
  DynamicsTable table{
      "modes-table",
      "Modes without damping",
      {">mode", ">Hz", "moves most", "yields most", ">tip x 1/kg", ">tip y", ">tip z"},
      {},
      "Moves most: the body with the largest share of the kinetic energy. Yields "
      "most: the connection with the largest share of the strain energy."};
  for (std::size_t m = 0; m < count; ++m) {
    const auto k = static_cast<Eigen::Index>(m);
    const dynamics::ModePlace& place = answer.places[m];
    const Vec3 weight = answer.modes.tip.col(k).cwiseAbs2();
    table.rows.push_back(
        {std::to_string(m + 1), fixed_text(answer.modes.frequencies[k], 2),
         fmt::format("{}, {:.0f} %", model.body_name(place.body), 100.0 * place.kinetic_share),
         fmt::format("{}, {:.0f} %",
                     place.connection == 0 ? "mounts" : model.body_name(place.connection),
                     100.0 * place.strain_share),
         fmt::format("{:.2e}", weight.x()), fmt::format("{:.2e}", weight.y()),
         fmt::format("{:.2e}", weight.z())});
  }
  return table;
}

DynamicsTable rest_table(const DynamicModel& model, const DynamicsAnswer& answer) {
  DynamicsTable table{"rest", "At rest", {"quantity", ">x", ">y", ">z"}, {}, ""};
  const auto row = [&](const std::string& name, const Vec3& v, int decimals) {
    table.rows.push_back({name, fixed_text(v.x(), decimals), fixed_text(v.y(), decimals),
                          fixed_text(v.z(), decimals)});
  };
  row("static stiffness N/µm, as measured", answer.rest.stiffness() / kMicrometres, 2);
  row("sag µm", answer.rest.sag * kMicrometres, 2);
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const kinematics::Joint& joint = model.axes[k].joint;
    row(fmt::format("inertial compliance for {}, {}", to_char(joint.letter),
                    joint.rotary() ? "µm/(rad/s²)" : "µm/gn"),
        answer.rest.inertial.col(static_cast<Eigen::Index>(k)) * dynamics::inertial_scale(joint),
        joint.rotary() ? 4 : 2);
  }
  return table;
}

// The box of a body's mass and tensor, as it is in the machine; metres.
std::array<Vec3, 8> corners_of(const dynamics::BodyPlace& body) {
  const SymmetricEigen principal = symmetric_eigen(body.inertia);
  const double sum = principal.values.sum();
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Vec3 corner = body.centre;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double side = ((i >> static_cast<unsigned>(k)) & 1U) != 0 ? 0.5 : -0.5;
      // I_i + I_j - I_k = m s_k^2 / 6
      const double size =
          std::sqrt(std::max(0.0, 6.0 * (sum - 2.0 * principal.values[k]) / body.mass));
      corner += side * size * principal.vectors.col(k);
    }
    corners[i] = corner;
  }
  return corners;
}

report::ModeDrawing mode_drawing(const DynamicModel& model, const DynamicsAnswer& answer,
                                 Eigen::Index mode) {
  report::ModeDrawing drawing{
      fmt::format("Mode {}, {} Hz", mode + 1, fixed_text(answer.modes.frequencies[mode], 2)), {}};
  double most = 0.0;
  for (std::size_t b = 0; b < answer.bodies.size(); ++b) {
    const auto motion = answer.modes.shapes.col(mode).segment<6>(6 * static_cast<Eigen::Index>(b));
    report::SwingingBody body{model.body_name(b), corners_of(answer.bodies[b]), {}};
    for (std::size_t i = 0; i < body.corners.size(); ++i) {
      const Vec3 arm = body.corners[i] - answer.bodies[b].centre;
      body.swing[i] = motion.head<3>() + Vec3(motion.tail<3>()).cross(arm);
      most = std::max(most, body.swing[i].norm());
      body.corners[i] *= kMillimetres;
    }
    drawing.bodies.push_back(std::move(body));
  }
  constexpr double kLargestSwing = 120.0;  // mm on a machine of metres
  for (report::SwingingBody& body : drawing.bodies) {
    for (Vec3& swing : body.swing) swing *= most > 0.0 ? kLargestSwing / most : 0.0;
  }
  return drawing;
}

std::vector<std::string> positions_of(const dynamics::MapAxis& axis) {
  const double unit = is_rotary(axis.letter) ? kDegPerRad : 1.0;
  std::vector<std::string> names;
  for (int i = 0; i < axis.count; ++i) names.push_back(fmt::format("{:.4g}", axis.at(i) * unit));
  return names;
}

report::HeatMap heat_map_of(const WorkspaceMapRequest& request, const dynamics::WorkspaceMap& map) {
  report::HeatMap drawing{request.title,
                          std::string(1, to_char(request.rows.letter)),
                          std::string(1, to_char(request.columns.letter)),
                          positions_of(request.rows),
                          positions_of(request.columns),
                          {}};
  for (Eigen::Index r = 0; r < map.values.rows(); ++r) {
    for (Eigen::Index c = 0; c < map.values.cols(); ++c) drawing.values.push_back(map.values(r, c));
  }
  return drawing;
}

std::string map_csv(const WorkspaceMapRequest& request, const dynamics::WorkspaceMap& map) {
  const auto rows = positions_of(request.rows), columns = positions_of(request.columns);
  std::string text = fmt::format("{},{},{}\n", to_char(request.rows.letter),
                                 to_char(request.columns.letter), request.title);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      text += fmt::format("{},{},{}\n", rows[r], columns[c],
                          map.values(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)));
    }
  }
  return text;
}

std::string place_of(const DynamicModel& model, const DynamicsRequest& request) {
  std::string text;
  for (const auto letter : kinematics::kAxisLetters) {
    if (!model.axis(letter)) continue;
    const double unit = is_rotary(letter) ? kDegPerRad : 1.0;
    text += fmt::format("{}{} {:g}{}", text.empty() ? "" : ", ", to_char(letter),
                        request.axes[letter] * unit, is_rotary(letter) ? "°" : "");
  }
  return text;
}

}  // namespace

std::vector<std::string> dynamics_file_names() {
  return {"dynamics.json", "report.html", "frf.csv", "frf.uff", "map.csv"};
}

void add_dynamics_files(FileSet& files, const kinematics::Machine& machine,
                        const DynamicModel& model, const DynamicsRequest& request,
                        const DynamicsAnswer& answer, std::span<const FrequencyResponse> measured) {
  constexpr std::size_t kShownModes = 12;
  const std::size_t count = std::min(kShownModes, static_cast<std::size_t>(answer.coordinates));
  DynamicsPage page;
  page.title = machine.title();
  page.facts = {{"Machine", machine.name()},
                {"Structure", machine.structure()},
                {"Position", place_of(model, request)},
                {"Tool length", fmt::format("{:g} mm", request.tool_length)}};
  page.tables = {modes_table(model, answer, count), rest_table(model, answer)};
  if (!answer.frequencies.empty()) {
    const auto responses = responses_of(answer);
    files.add("frf.csv", response_csv(responses));
    files.add("frf.uff", universal_file(responses, machine.name()));
    page.responses = charts_of(responses, measured);
  }
  if (answer.map) {
    files.add("map.csv", map_csv(*request.map, *answer.map));
    page.maps = {heat_map_of(*request.map, *answer.map)};
    page.box_scale = request.map->title;
    const dynamics::BoxOfValues& box = answer.map->box;
    page.boxes = {{machine.name(), box.min, box.q1, box.median, box.q3, box.max, {}}};
  }
  for (std::size_t m = 0; m < count; ++m) {
    page.modes.push_back(mode_drawing(model, answer, static_cast<Eigen::Index>(m)));
  }
  files.add("report.html", dynamics_html(page));
}

}  // namespace frustum::app
