// frustum program cone: writes a cone test piece.
#include <fmt/format.h>

#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/number_list.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "programs/test_piece_files.hpp"

namespace frustum::app {
namespace {

using kinematics::Machine;
using programs::ConeFrustum;
namespace fs = std::filesystem;

// What was given on the command line; the rest comes from the preset.
struct ConeOptions : PieceOptions {
  std::string preset = "inclined";
  std::string form{};  // vector, where the dialect has vectors
  std::string limits = "nas979";
  std::string center{};
  std::optional<double> cone_angle{}, inclination{}, orientation{}, radius{}, height{},
      cylinder_height{}, tool_diameter{}, tool_length{}, start_angle{}, allowance{},
      chord_tolerance{}, feed{}, speed{};
};

Result<ConeFrustum> cone_of(const ConeOptions& o) {
  ConeFrustum cone = o.preset == "nas979" ? ConeFrustum::nas979() : ConeFrustum{};
  const auto set_angle = [](Rad& to, const std::optional<double>& deg) {
    if (deg) to = Rad{*deg * kRadPerDeg};
  };
  const auto set = [](Mm& to, const std::optional<double>& mm, double scale = 1.0) {
    if (mm) to = Mm{*mm * scale};
  };
  set_angle(cone.cone_angle, o.cone_angle);
  set_angle(cone.inclination, o.inclination);
  set_angle(cone.orientation, o.orientation);
  set(cone.radius, o.radius);
  set(cone.height, o.height);
  set(cone.cylinder_height, o.cylinder_height);
  set(cone.tool_diameter, o.tool_diameter);
  set(cone.tool_length, o.tool_length);
  set(cone.allowance, o.allowance);
  set(cone.chord_tolerance, o.chord_tolerance, 1e-3);
  if (o.start_angle) cone.start_angle = Rad{*o.start_angle * kRadPerDeg};
  if (o.feed) cone.feed = *o.feed;
  if (o.speed) cone.spindle_speed = *o.speed;
  if (!o.center.empty()) {
    const auto center = numbers_of(o.center, 3, "--center");
    if (!center) return center.error();
    cone.center = Vec3((*center)[0], (*center)[1], (*center)[2]);
  }
  cone.form = form_of(o.form, o.dialect);
  cone.limits = o.limits == "tenth" ? programs::ConeLimits::tenth : programs::ConeLimits::nas979;
  return cone;
}

Result<std::vector<fs::path>> write_cone(const ConeOptions& options, const Machine& machine,
                                         const fs::path& machine_file) {
  const auto cone = cone_of(options);
  if (!cone) return cone.error();
  const auto piece =
      programs::cone_frustum(*cone, machine, *parser::dialect_named(options.dialect));
  if (!piece) return piece.error();
  return programs::write_test_piece(*piece, name_for_job(machine_file, options.out), options.out);
}

}  // namespace

void add_cone(Command& kinds) {
  auto o = std::make_shared<ConeOptions>();
  Command cone = kinds.command(
      "cone", "The cone frustum test: NAS 979, or an inclined cone with cylinder and groove");
  add_piece_options(cone, *o, "job.toml, cone.nc (.ngc, .mpf, .h) and cone.plan.toml");
  cone.option("--preset", o->preset, "inclined (default) or nas979: what the options start from")
      .one_of({"inclined", "nas979"});
  cone.option("--cone-angle", o->cone_angle, "Half apex angle, deg (45)");
  cone.option("--inclination", o->inclination, "Tilt of the cone's axis, deg (30)");
  cone.option("--orientation", o->orientation, "Turn about the table's Z, deg (0)");
  cone.option("--radius", o->radius, "Tool-tip circle, mm (40)");
  cone.option("--center", o->center,
              "x,y,z of that circle's centre in the table frame, mm (-65,0,150)");
  cone.option("--height", o->height, "Height of the cone, mm (5)");
  cone.option("--cylinder-height", o->cylinder_height, "Height of the cylinder below, mm (6)");
  cone.option("--tool-diameter", o->tool_diameter, "mm (12)");
  cone.option("--tool-length", o->tool_length, "Gauge point to tip, mm (150)");
  cone.option("--start-angle", o->start_angle, "Where the cut begins and ends, deg (0)");
  cone.option("--allowance", o->allowance, "Stock left by roughing, mm (0.2)");
  cone.option("--chord-tolerance", o->chord_tolerance, "Of finished circles, um (0.005)");
  cone.option("--feed", o->feed, "mm/min (500)");
  cone.option("--speed", o->speed, "Spindle, 1/min (8333)");
  add_form_option(cone, o->form);
  cone.option("--limits", o->limits, "nas979, or tenth: a tenth of its limits")
      .one_of({"nas979", "tenth"});
  cone.footer("Example: frustum program cone --machine iwf-bc --center=-65,0,150 --out cone");
  cone.runs([o] {
    return write_piece(*o, [&o](const Machine& machine, const fs::path& file) {
      return write_cone(*o, machine, file);
    });
  });
}

}  // namespace frustum::app
