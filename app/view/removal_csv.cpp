#include "app/view/removal_csv.hpp"

#include <fmt/format.h>

#include <optional>

namespace frustum::app {
namespace {

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : std::string();
}

// Seconds keep their thousandths however long the program runs.
std::string seconds(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : std::string();
}

}  // namespace

std::string removal_csv(const kinematics::ToolPath& path,
                        std::span<const stock::BlockRemoval> removal) {
  const stock::Timetable table(path);
  std::string csv =
      "line,block,kind,tool,start_s,end_s,volume_mm3,rate_mm3_per_min,axial_mm,radial_mm,"
      "largest_thickness_mm,mean_thickness_mm,first_contact_s,last_contact_s\n";
  for (const stock::BlockRemoval& r : removal) {
    const kinematics::PathBlock& block = path.blocks[r.block];
    csv += fmt::format("{},{},{},{},{},{},{:.9g},{:.6g},{:.6g},{},{:.6g},{:.6g},{},{}\n",
                       block.source_line, r.block,
                       block.kind == kinematics::PathKind::rapid ? "rapid" : "feed", block.tool,
                       seconds(table.start(table.first_segment(r.block))),
                       seconds(table.start(table.first_segment(r.block + 1))), r.volume, r.rate,
                       r.axial_engagement, cell(r.radial_engagement), r.largest_thickness,
                       r.mean_thickness, seconds(r.first_contact), seconds(r.last_contact));
  }
  return csv;
}

}  // namespace frustum::app
