// Any program for one machine: tool poses become its axes, its words and its feeds.
//
// Model    : the program is followed block by block as the machine's controller would follow it.
//            Each block is passed on in the form asked for: tip coordinates with rotary words
//            (tool-centre-point control on), tip coordinates with tool vectors, or axis positions
//            (control off). Where the controller would not keep the programmed path in that form,
//            points are inserted by halving until it does, within the tolerances. Where a rotary
//            axis runs out of travel the tool is lifted off, the axes turn, and the tool comes
//            back.
// Feeds    : a block takes the time that the program gave it. Axis positions with rotary motion
//            carry inverse time, all else the feed of the tip.
// Units    : mm, rad
// Errors   : poses out of reach or travel, axes the machine lacks, tools and work offsets that the
//            setup lacks where axis positions depend on them, cutting moves without a feed; each
//            with the source line
// Accuracy : tip within `tolerance` of the programmed path at equal fractions of the block, tool
//            axis within `angle_tolerance`
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "core/units.hpp"
#include "kinematics/controller/setup.hpp"
#include "kinematics/model/machine.hpp"
#include "parser/motion.hpp"

namespace frustum::post {

enum class OutputForm : std::uint8_t { axes, tip, vectors };
// Which arcs stay arcs: none; flat ones in X and Y of at most a turn; all.
enum class ArcForm : std::uint8_t { none, flat, all };
// Whose length the reader counts: that of the number which the program gives, that of the tool in
// the spindle where it is switched on, or always that.
enum class LengthForm : std::uint8_t { by_number, by_tool, always_by_tool };

struct PlanOptions {
  OutputForm output = OutputForm::tip;
  ArcForm arcs = ArcForm::all;
  LengthForm length = LengthForm::by_number;
  bool zero_is_spindle = false;  // number 0 is that of the tool in the spindle, else no length
  // The reader follows great circles where the program asks for them; else they become short
  // blocks.
  bool great_circle = false;
  Mm tolerance{1e-3};
  Rad angle_tolerance{1e-6};
  // Tool vectors nearer to the pole than this leave the turning axis where it suits the path; the
  // tool may be off by as much.
  Rad pole_tolerance{1e-7};
  Mm lift{50.0};             // along the tool axis, before rotary axes are rewound
  double lift_feed = 500.0;  // mm/min, of the way back to the part
};

struct MachineProgram {
  std::vector<parser::Motion> motions{};
  Diagnostics warnings{};
  std::size_t inserted = 0;  // points between the program's own
  std::size_t rewinds = 0;
};

[[nodiscard]] Result<MachineProgram> plan_for_machine(const kinematics::Machine& machine,
                                                      const kinematics::Setup& setup,
                                                      std::span<const parser::Motion> motions,
                                                      const PlanOptions& options = {});

}  // namespace frustum::post
