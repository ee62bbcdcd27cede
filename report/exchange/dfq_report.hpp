// The characteristics as a Q-DAS ASCII transfer file (.dfq), one set of values a run.
//
// K-fields: K0100 number of characteristics; K1001, K1002 part number and name; for characteristic
// n K2001/n number, K2002/n name, K2022/n decimals, K2101/n nominal, K2110/n lower and K2111/n
// upper limit, K2142/n unit, K2900/n (remark) the parameter of a form where the plan states one;
// then K0001/n value and K0002/n attribute (0 valid, 255 not measured).
// A form has an upper limit only.
// Units  : each characteristic in its own (um, mm, deg, urad), as K2142 says; fixed decimals as
//          K2022 says
// Errors : none; a file with characters beyond ASCII is UTF-8 and begins with a byte order mark, as
//          no public source states an encoding; others are ASCII
// Source : AQDEF, the field list of the transfer format
#pragma once

#include <string>

#include "report/run_report.hpp"

namespace frustum::report {

[[nodiscard]] std::string dfq_report(const RunReport& report);

}  // namespace frustum::report
