// frustum program surface: writes a test piece of a user's own surface.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/machine_files.hpp"
#include "app/job/number_list.hpp"
#include "programs/surface/surface_net.hpp"
#include "programs/surface/surface_piece.hpp"
#include "programs/test_piece_files.hpp"

namespace frustum::app {
namespace {

using kinematics::Machine;
using programs::SurfacePiece;
namespace fs = std::filesystem;

struct SurfaceOptions : PieceOptions {
  std::string net{}, center{}, method{}, form{};
  std::optional<double> cutter{}, cusp{}, lead{}, thickness{}, orientation{}, feed{}, speed{},
      tool_length{};
  std::optional<std::uint64_t> blocks{};
};

// Two rows are milled by the flank, more by a ball, and each has words of its own.
Diagnostics unused_options(const SurfaceOptions& o, bool is_ruled) {
  Diagnostics unused;
  const auto note = [&](const char* option, bool is_given) {
    if (!is_given) return;
    unused.push_back(
        error("option-conflict"_id,
              is_ruled ? fmt::format("{} is of a ball, and a net of two rows is milled by the "
                                     "flank in one pass",
                                     option)
                       : fmt::format("{} is of a flank, and a net of more than two rows is milled "
                                     "by a ball",
                                     option),
              is_ruled ? "leave it out, or give the net another row" : "leave it out"));
  };
  note("--cusp", is_ruled && o.cusp.has_value());
  note("--lead", is_ruled && o.lead.has_value());
  note("--method", !is_ruled && !o.method.empty());
  return unused;
}

Result<SurfacePiece> surface_of(const SurfaceOptions& o) {
  auto net = programs::read_surface_net(o.net);
  if (!net) return std::move(net).error();
  if (Diagnostics unused = unused_options(o, net->rows() == 2); !unused.empty()) return unused;
  SurfacePiece piece{.surface = *std::move(net)};
  if (o.cutter) piece.cutter = Mm{*o.cutter};
  if (o.cusp) piece.cusp = Mm{*o.cusp / kUmPerMm};
  if (o.lead) piece.lead = Rad{*o.lead * kRadPerDeg};
  if (o.thickness) piece.thickness = Mm{*o.thickness};
  if (o.orientation) piece.orientation = Rad{*o.orientation * kRadPerDeg};
  if (o.blocks) piece.blocks = static_cast<std::size_t>(*o.blocks);
  if (o.feed) piece.feed = *o.feed;
  if (o.speed) piece.spindle_speed = *o.speed;
  if (o.tool_length) piece.tool_length = Mm{*o.tool_length};
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
  return piece;
}

Result<std::vector<fs::path>> write_surface(const SurfaceOptions& options, const Machine& machine,
                                            const fs::path& machine_file) {
  const auto wanted = surface_of(options);
  if (!wanted) return wanted.error();
  const auto piece =
      programs::surface_piece(*wanted, machine, *parser::dialect_named(options.dialect));
  if (!piece) return piece.error();
  return programs::write_test_piece(*piece, name_for_job(machine_file, options.out), options.out);
}

}  // namespace

void add_surface(Command& kinds) {
  auto o = std::make_shared<SurfaceOptions>();
  Command surface = kinds.command(
      "surface", "A surface of your own: a net of control points, by flank or by ball");
  add_piece_options(surface, *o, "job.toml, surface.nc (.ngc, .mpf, .h), blank and plan");
  surface
      .option("--net", o->net,
              "CSV of control points: row,x,y,z; two rows: a ruled surface by the flank, more: by "
              "a ball")
      .required();
  surface.option("--cutter", o->cutter, "Diameter, mm (flank 20, ball 10)");
  surface.option("--method", o->method, "Of a flank: two-point, balanced, three-point (default)")
      .one_of({"two-point", "balanced", "three-point"});
  surface.option("--cusp", o->cusp, "Between passes of a ball, um (2)");
  surface.option("--lead", o->lead, "Of a ball-ended tool from the normal along u, deg (15)");
  surface.option("--blocks", o->blocks, "Of one pass (flank 4000, ball 400)");
  surface.option("--thickness", o->thickness, "Of the sheet that is the blank, mm (10)");
  surface.option("--center", o->center,
                 "x,y,z of the net's origin in the table frame, mm (0,0,120)");
  surface.option("--orientation", o->orientation, "Turn about the table's Z, deg (0)");
  surface.option("--feed", o->feed, "mm/min (600)");
  surface.option("--speed", o->speed, "Spindle, 1/min (6000)");
  surface.option("--tool-length", o->tool_length, "Gauge point to tip, mm (150)");
  add_form_option(surface, o->form);
  surface.footer("Example: frustum program surface --machine zx-yac --net net.csv --out surface");
  surface.runs([o] {
    return write_piece(*o, [&o](const Machine& machine, const fs::path& file) {
      return write_surface(*o, machine, file);
    });
  });
}

}  // namespace frustum::app
