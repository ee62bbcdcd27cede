// frustum program contour: writes a contouring piece.
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/number_list.hpp"
#include "programs/contour/contour_piece.hpp"
#include "programs/test_piece_files.hpp"

namespace frustum::app {
namespace {

using kinematics::Machine;
using programs::ContourPiece;
namespace fs = std::filesystem;

struct ContourOptions : PieceOptions {
  std::string center{};
  bool bore = false;
  std::optional<double> size{}, feed{}, speed{}, tool_length{};
};

Result<ContourPiece> contour_of(const ContourOptions& o) {
  ContourPiece piece;
  piece.bore = o.bore;
  if (o.size) piece.size = {*o.size};
  if (o.feed) piece.feed = *o.feed;
  if (o.speed) piece.spindle_speed = *o.speed;
  if (o.tool_length) piece.tool_length = {*o.tool_length};
  if (!o.center.empty()) {
    const auto center = numbers_of(o.center, 3, "--center");
    if (!center) return center.error();
    piece.center = Vec3((*center)[0], (*center)[1], (*center)[2]);
  }
  return piece;
}

Result<std::vector<fs::path>> write_contour(const ContourOptions& options, const Machine& machine,
                                            const fs::path& machine_file) {
  const auto contour = contour_of(options);
  if (!contour) return contour.error();
  const auto piece =
      programs::contour_piece(*contour, machine, *parser::dialect_named(options.dialect));
  if (!piece) return piece.error();
  return programs::write_test_piece(*piece, name_for_job(machine_file, options.out), options.out);
}

}  // namespace

void add_contour(Command& kinds) {
  auto o = std::make_shared<ContourOptions>();
  Command contour = kinds.command(
      "contour", "The contouring piece: circle, diamond, square with sides of 3 deg, square");
  add_piece_options(contour, *o, "job.toml, contour.nc (.ngc, .mpf, .h), blank and plan");
  contour.option("--size", o->size, "Side of the square, mm (160)");
  contour.flag("--bore", o->bore, "With a bore of 0.1875 of the size");
  contour.option("--center", o->center,
                 "x,y,z of the top face's centre in the table frame, mm (0,0,120)");
  contour.option("--feed", o->feed, "mm/min (600)");
  contour.option("--speed", o->speed, "Spindle, 1/min (4000)");
  contour.option("--tool-length", o->tool_length, "Gauge point to tip, mm (150)");
  contour.footer("Example: frustum program contour --machine zx-yac --out contour");
  contour.runs([o] {
    return write_piece(*o, [&o](const Machine& machine, const fs::path& file) {
      return write_contour(*o, machine, file);
    });
  });
}

}  // namespace frustum::app
