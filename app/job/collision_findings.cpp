#include "app/job/collision_findings.hpp"

#include <span>

#include "app/job/job_report.hpp"
#include "trials/trial.hpp"

namespace frustum::app {
namespace {

lint::Check check_of(const stock::Collision& collision) {
  switch (collision.kind) {
    case stock::CollisionKind::rapid_through_material:
      return lint::Check::rapid_in_material;
    case stock::CollisionKind::feed_with_spindle_off:
      return lint::Check::spindle_off;
    case stock::CollisionKind::bodies_meet:
      return lint::Check::machine_collision;
    case stock::CollisionKind::body_in_material:
      break;
  }
  return lint::Check::body_in_material;
}

std::string remedy_of(const stock::Collision& collision) {
  if (collision.kind == stock::CollisionKind::rapid_through_material) {
    return "retract before the move, or cut there by feed";
  }
  if (collision.kind == stock::CollisionKind::bodies_meet) {
    return "another way to the place, another clamping, or a longer tool";
  }
  if (collision.body == stock::CollisionBody::shank) {
    return "longer flutes, cuts of less depth, or a shank_diameter that is smaller than the cutter";
  }
  return "a longer tool or a slimmer holder, or another way to the place";
}

}  // namespace

Result<std::vector<lint::Finding>> collisions_of(const Job& job) {
  trials::TrialOptions options;
  options.path_bound = job.path_bound;
  options.measure = false;
  const auto trial = run_trial(job.machine, std::span<const kinematics::ErrorEntry>(), job.piece,
                               job.cmm, options);
  if (!trial) {
    Diagnostics problems = trial.error();
    for (Diagnostic& d : problems) {
      if (d.file.empty()) d.file = job.file.string();
    }
    return problems;
  }
  std::vector<lint::Finding> findings;
  for (const Diagnostic& d : trial->warnings) {
    if (d.id != "spindle-hand"_id) continue;
    findings.push_back({.check = lint::Check::spindle_hand,
                        .severity = lint::info_of(lint::Check::spindle_hand).severity,
                        .file = d.file == job.piece.program_file ? "" : d.file,
                        .line = static_cast<std::uint32_t>(d.line),
                        .column = 1,
                        .message = d.message,
                        .hint = d.hint});
  }
  for (const stock::Collision& collision : trial->collisions) {
    const lint::Check check = check_of(collision);
    // The check of the program itself finds these.
    if (check == lint::Check::spindle_off) continue;
    findings.push_back({.check = check,
                        .severity = lint::info_of(check).severity,
                        .file = file_of(collision, ""),  // none: that of the main program
                        .line = collision.source_line,
                        .column = 1,
                        .message = collision_text(collision),
                        .hint = remedy_of(collision)});
  }
  return findings;
}

}  // namespace frustum::app
