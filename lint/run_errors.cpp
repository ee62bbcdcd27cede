#include "lint/run_errors.hpp"

#include <array>
#include <string_view>

#include "parser/interpret/state/program_position.hpp"

namespace frustum::lint {
namespace {

struct Wording {
  std::string_view part;
  Check check;
};

constexpr std::array kWordings{
    Wording{"without a feed rate", Check::feed_missing},
    Wording{"without F in G93", Check::feed_missing},
    Wording{"a feed move with feed", Check::feed_missing},
    Wording{"feed per revolution while the spindle stands", Check::spindle_off},
    Wording{"from the centre, its end", Check::arc_radii},
    Wording{"is too small: the end is", Check::arc_radii},
    Wording{"an arc with R ends at its start", Check::arc_full_by_radius},
    Wording{"the tool, of radius", Check::radius_gouge},
    Wording{"radius compensation", Check::radius_compensation},
    Wording{"entry move", Check::radius_compensation},
    Wording{"the start of the entry", Check::radius_compensation},
    Wording{"the tool table has no tool", Check::radius_compensation},
    Wording{"with a tool of no diameter", Check::radius_compensation},
    Wording{"has no value", Check::parameter_unset},
    Wording{"parameter #", Check::program_error},
    Wording{"does not exist", Check::missing_subprogram},
    Wording{"no subprogram", Check::missing_subprogram},
    Wording{"there is no part", Check::missing_label},
    Wording{"to go to", Check::missing_label},
    Wording{"subprograms within each other", Check::recursion},
    Wording{"blocks have run", Check::endless_loop},
    Wording{"M99 in the main program would repeat it for ever", Check::endless_loop},
    Wording{"no tool length is in force", Check::length_missing},
    Wording{"tool length compensation without an H word", Check::length_missing},
    Wording{"has no axis", Check::unknown_axis},
    Wording{"cannot be reached", Check::unreachable_orientation},
    Wording{"deg off the spindle", Check::unreachable_orientation},
    Wording{"great circle", Check::unreachable_orientation},
    Wording{"over-travel", Check::rotary_over_travel},
};

}  // namespace

Check check_of(const Diagnostic& error, Check otherwise) {
  for (const Wording& wording : kWordings) {
    if (error.message.find(wording.part) != std::string::npos) return wording.check;
  }
  return otherwise;
}

bool follows_from_an_earlier_one(const Diagnostic& error) {
  const std::string since = std::string("since ") + parser::kMistake;
  return (error.message + error.hint).find(since) != std::string::npos;
}

}  // namespace frustum::lint
