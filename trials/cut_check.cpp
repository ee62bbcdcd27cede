#include "trials/cut_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kinematics/controller/source_lines.hpp"
#include "stock/collision/collision.hpp"

namespace frustum::trials {
namespace {

struct PointCount {
  std::size_t uncut = 0;   // on the blank's own surface
  std::size_t others = 0;  // cut by another operation
};

PointCount count_strangers(const programs::Operation& operation, const kinematics::ToolPath& path,
                           const metrology::MeasuredFeature& feature) {
  PointCount count;
  for (const metrology::Touch& touch : feature.touches) {
    const auto& by = touch.provenance;
    if (!by) continue;
    if (!by->segment) {
      ++count.uncut;
    } else if (!kinematics::comes_from(path.blocks[path.segments[*by->segment].block],
                                       operation.first_line, operation.last_line)) {
      ++count.others;
    }
  }
  return count;
}

Diagnostic finding(const std::string& feature, const std::string& operation, std::size_t points,
                   const PointCount& count) {
  if (count.uncut > 0) {
    return warning("uncut-feature"_id,
                   fmt::format("feature '{}': {} of {} measured points are on the uncut blank, not "
                               "on what operation '{}' cuts",
                               feature, count.uncut, points, operation),
                   "the blank needs more allowance than the errors move the cut");
  }
  return warning("foreign-cut"_id,
                 fmt::format("feature '{}': {} of {} measured points were cut by another operation "
                             "than '{}'",
                             feature, count.others, points, operation),
                 "look at the passes that come near this feature");
}

}  // namespace

std::optional<Diagnostic> away_from_blank(const stock::Workpiece& workpiece,
                                          const programs::TestPiece& piece) {
  const std::size_t segments = workpiece.removed().path().segments.size();
  if (segments == 0) return std::nullopt;
  const Box blank = workpiece.blank().bounds();
  Box swept = workpiece.removed().box(0);
  for (std::uint32_t i = 0; i < segments; ++i) {
    const Box& box = workpiece.removed().box(i);
    if (overlap(box, blank)) return std::nullopt;
    swept = united(swept, box);
  }
  const auto text = [](const Box& box) {
    return fmt::format("[{:.3f}, {:.3f}, {:.3f}] to [{:.3f}, {:.3f}, {:.3f}]", box.min.x(),
                       box.min.y(), box.min.z(), box.max.x(), box.max.y(), box.max.z());
  };
  Diagnostic away =
      error("blank-untouched"_id,
            fmt::format("nothing is removed: the tool, {}, never comes to the blank, {}",
                        text(swept), text(blank)),
            "check the origin of the blank, the work offsets and the lengths of the tools");
  away.file = piece.program_file;
  return away;
}

Diagnostics against_hand(const stock::Workpiece& workpiece, const programs::TestPiece& piece) {
  Diagnostics findings;
  for (const std::uint32_t index : stock::cuts_against_hand(workpiece)) {
    const kinematics::PathBlock& block = workpiece.removed().path().blocks[index];
    const bool is_left =
        workpiece.removed().tool(block.tool).spec().hand == cutter::CutterHand::left;
    Diagnostic found =
        warning("spindle-hand"_id,
                fmt::format("tool T{} is a {}-hand cutter and cuts while the spindle turns {}",
                            block.tool, is_left ? "left" : "right",
                            is_left ? "clockwise (M3)" : "counterclockwise (M4)"),
                fmt::format("turn the spindle by {}, or state hand = \"{}\" for the tool",
                            is_left ? "M4" : "M3", is_left ? "right" : "left"));
    found.file = block.source_file ? *block.source_file : piece.program_file;
    found.line = static_cast<int>(block.source_line);
    findings.push_back(std::move(found));
  }
  return findings;
}

Diagnostics wrongly_cut_features(const programs::TestPiece& piece, const kinematics::ToolPath& path,
                                 const metrology::Measurement& measurement) {
  Diagnostics findings;
  for (const programs::Operation& operation : piece.operations) {
    for (const std::string& name : operation.makes) {
      const auto feature =
          std::find_if(measurement.features.begin(), measurement.features.end(),
                       [&](const metrology::MeasuredFeature& f) { return f.name == name; });
      if (feature == measurement.features.end()) continue;
      const PointCount count = count_strangers(operation, path, *feature);
      if (count.uncut + count.others > 0) {
        findings.push_back(finding(name, operation.name, feature->points.size(), count));
      }
    }
  }
  return findings;
}

}  // namespace frustum::trials
