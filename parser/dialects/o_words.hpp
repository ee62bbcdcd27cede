// The O words of LinuxCNC, and what follows each.
//
// Units : none
// Errors: none
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "parser/language/flow.hpp"

namespace frustum::parser {

enum class OWordNeeds : std::uint8_t { nothing, expression, perhaps_expression, arguments };

struct OWord {
  std::string_view name;
  FlowKind kind;
  OWordNeeds needs;
  Turns turns = Turns::while_true;
};
// The first of a kind is the one that is written: endwhile may end a repeat, too.
inline constexpr std::array kOWords{
    OWord{"sub", FlowKind::subprogram, OWordNeeds::nothing},
    OWord{"endsub", FlowKind::end_sub, OWordNeeds::perhaps_expression},
    OWord{"return", FlowKind::give_back, OWordNeeds::perhaps_expression},
    OWord{"call", FlowKind::call, OWordNeeds::arguments},
    OWord{"if", FlowKind::branch, OWordNeeds::expression},
    OWord{"elseif", FlowKind::else_branch, OWordNeeds::expression},
    OWord{"else", FlowKind::otherwise, OWordNeeds::nothing},
    OWord{"endif", FlowKind::end_branch, OWordNeeds::nothing},
    OWord{"while", FlowKind::loop, OWordNeeds::expression},
    OWord{"endwhile", FlowKind::end_loop, OWordNeeds::nothing},
    OWord{"do", FlowKind::loop, OWordNeeds::nothing, Turns::until_end},
    OWord{"repeat", FlowKind::loop, OWordNeeds::expression, Turns::counted},
    OWord{"endrepeat", FlowKind::end_loop, OWordNeeds::nothing},
    OWord{"break", FlowKind::leave_loop, OWordNeeds::nothing},
    OWord{"continue", FlowKind::next_turn, OWordNeeds::nothing},
};

}  // namespace frustum::parser
