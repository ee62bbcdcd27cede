// CYCL DEF of Klartext.
#include <fmt/format.h>

#include <cmath>

#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

class CycleReader {
 public:
  explicit CycleReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read_cycle(std::uint32_t column) {
    const bool defines = in_.take_name("DEF");
    const auto number = defines ? in_.number() : std::nullopt;
    if (!number) {
      return in_.fail(column, defines ? "CYCL DEF has no number" : "CYCL CALL is not simulated",
                      "write the cycle out as L blocks");
    }
    const double cycle = std::floor(number->value + 1e-6);
    const int part = static_cast<int>(std::lround((number->value - cycle) * 10.0));
    if (cycle == 247.0) return read_preset(column);
    if (cycle == 9.0) return read_dwell_cycle(part, column);
    if (cycle == 32.0) return note(draft_, "CYCL DEF 32", column, in_.text_to(";"));
    in_.fail(column, fmt::format("CYCL DEF {} is not simulated", cycle),
             cycle == 19.0  ? "use PLANE SPATIAL"
             : cycle == 7.0 ? "set the work offset in the job, and call it by CYCL DEF 247 Q339=1"
                            : "write the cycle out as L blocks");
  }

 private:
  void read_preset(std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, "CYCL DEF 247"), column);
    while (!in_.at_end()) {
      if (in_.peek() == ';') {
        draft_.read_comment();
        continue;
      }
      const std::uint32_t place = in_.column();
      const std::string name = in_.name();
      if (name.empty()) return in_.fail_unexpected("write CYCL DEF 247 DATUM SETTING Q339=+1");
      if (!in_.take('=')) continue;  // the cycle's name
      if (name != "Q339") {
        return in_.fail(place, fmt::format("{} has no meaning in CYCL DEF 247", name),
                        "the preset's number is Q339");
      }
      add_number(block_, 'P', in_.signed_number(name, place), place, "Q339=");
    }
  }

  void read_dwell_cycle(int part, std::uint32_t column) {
    if (part == 0) return note(draft_, "CYCL DEF 9", column, in_.text_to(";"));
    const std::uint32_t place = in_.column();
    // "DWELL 2", "V.ZEIT 2", "V.TIME2"
    while (!in_.letters().empty() || in_.take('.')) {
    }
    add_dwell(draft_, in_.signed_number("CYCL DEF 9.1", place), column);
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

void read_heidenhain_cycle(BlockDraft& draft, std::uint32_t column) {
  CycleReader(draft).read_cycle(column);
}

}  // namespace frustum::parser
