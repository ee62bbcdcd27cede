// frustum program s-piece: writes an S-shaped piece.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/number_list.hpp"
#include "programs/s_piece/control_points.hpp"
#include "programs/s_piece/s_piece.hpp"
#include "programs/test_piece_files.hpp"

namespace frustum::app {
namespace {

using kinematics::Machine;
using programs::SPiece;
namespace fs = std::filesystem;

struct SPieceOptions : PieceOptions {
  std::string center{}, method{}, points{}, form{};
  std::optional<double> cutter{}, height{}, overhang{}, orientation{}, feed{}, speed{},
      tool_length{};
  std::optional<std::uint64_t> blocks{};
};

Result<SPiece> s_piece_of(const SPieceOptions& o) {
  SPiece piece;
  const auto set = [](Mm& to, const std::optional<double>& mm) {
    if (mm) to = Mm{*mm};
  };
  set(piece.cutter, o.cutter);
  set(piece.height, o.height);
  set(piece.overhang, o.overhang);
  set(piece.tool_length, o.tool_length);
  if (o.orientation) piece.orientation = Rad{*o.orientation * kRadPerDeg};
  if (o.blocks) piece.blocks = static_cast<std::size_t>(*o.blocks);
  if (o.feed) piece.feed = *o.feed;
  if (o.speed) piece.spindle_speed = *o.speed;
  if (!o.method.empty()) {
    const auto named = std::ranges::find(programs::kFlankMethodNames, std::string_view(o.method));
    piece.method = static_cast<programs::FlankMethod>(named - programs::kFlankMethodNames.begin());
  }
  piece.form = form_of(o.form, o.dialect);
  if (!o.center.empty()) {
    const auto center = numbers_of(o.center, 3, "--center");
    if (!center) return center.error();
    piece.center = Vec3((*center)[0], (*center)[1], (*center)[2]);
  }
  if (o.points.empty()) return piece;
  if (o.height) {
    return error("option-conflict"_id, "--height and --points exclude each other",
                 "the height is that between both curves of the file");
  }
  auto points = programs::read_control_points(o.points);
  if (!points) return std::move(points).error();
  piece.points = *std::move(points);
  return piece;
}

// What the cutter leaves where the machine makes no error, by each method.
void show_methods(const SPiece& piece) {
  const auto shape = programs::geometry(piece);
  if (!shape) return;
  std::cout << "geometric deviation of the method, um, no error of the machine:\n";
  for (const auto& found : programs::method_deviations(piece, *shape)) {
    std::cout << fmt::format("  {:<12} {:+9.3f} .. {:+8.3f}  rms {:7.3f}{}\n",
                             programs::kFlankMethodNames.at(static_cast<std::size_t>(found.method)),
                             found.lowest * kUmPerMm, found.highest * kUmPerMm,
                             found.rms * kUmPerMm,
                             found.method == piece.method ? "  (this program)" : "");
  }
}

Result<std::vector<fs::path>> write_s_piece(const SPieceOptions& options, const Machine& machine,
                                            const fs::path& machine_file) {
  const auto wanted = s_piece_of(options);
  if (!wanted) return wanted.error();
  const auto piece = programs::s_piece(*wanted, machine, *parser::dialect_named(options.dialect));
  if (!piece) return piece.error();
  auto written =
      programs::write_test_piece(*piece, name_for_job(machine_file, options.out), options.out);
  if (written && !options.json && !options.quiet) show_methods(*wanted);
  return written;
}

}  // namespace

void add_s_piece(Command& kinds) {
  auto o = std::make_shared<SPieceOptions>();
  Command piece = kinds.command(
      "s-piece", "The S-shaped piece: a wall with ruled flanks, milled by the flank of the cutter");
  add_piece_options(piece, *o, "job.toml, s-piece.nc (.ngc, .mpf, .h), blank and plan");
  piece.option("--method", o->method, "two-point, balanced or three-point (default)")
      .one_of({"two-point", "balanced", "three-point"});
  piece.option("--cutter", o->cutter, "Diameter of the cutter, mm (20)");
  piece.option("--height", o->height, "Of the wall, mm (30)");
  piece.option("--overhang", o->overhang, "Of the cutter's tip below the wall, mm (2)");
  piece.option("--blocks", o->blocks, "Of one finished flank (4000)");
  piece.option("--center", o->center,
               "x,y,z of the control points' origin in the table frame, mm (40,25,120)");
  piece.option("--orientation", o->orientation, "Turn about the table's Z, deg (0)");
  piece.option("--points", o->points,
               "CSV of other control points: curve,x,y,z with curves C0, C1 (and D0, D1)");
  piece.option("--feed", o->feed, "mm/min (600)");
  piece.option("--speed", o->speed, "Spindle, 1/min (4000)");
  piece.option("--tool-length", o->tool_length, "Gauge point to tip, mm (150)");
  add_form_option(piece, o->form);
  piece.footer("Example: frustum program s-piece --machine zx-yac --out s");
  piece.runs([o] {
    return write_piece(*o, [&o](const Machine& machine, const fs::path& file) {
      return write_s_piece(*o, machine, file);
    });
  });
}

}  // namespace frustum::app
