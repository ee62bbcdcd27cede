// Transformations of Klartext: TRANS DATUM, MIRROR, ROTATION and SCALE, which are cycles 7, 8, 10
// and 11 in other words; PRESET SELECT, which is cycle 247.
#include <fmt/format.h>

#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

class TransformReader {
 public:
  explicit TransformReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read_trans(std::uint32_t column) {
    const std::uint32_t place = in_.column();
    const std::string kind = in_.name();
    const bool resets = in_.take_name("RESET");
    if (kind == "DATUM") return read_datum(resets, column);
    if (kind == "MIRROR") return read_mirror(resets, column);
    if (kind == "ROTATION") return read_rotation(resets, column);
    if (kind == "SCALE") return read_scale(resets, column);
    in_.fail("unknown-word"_id, place, fmt::format("TRANS {} is not known", kind),
             "write TRANS DATUM, MIRROR, ROTATION or SCALE");
  }

  // PRESET SELECT #1; what KEEP TRANS keeps is an error to leave out.
  void read_preset(std::uint32_t column) {
    if (!in_.take_name("SELECT") || !in_.take('#')) {
      return in_.fail("not-supported"_id, column, "PRESET without SELECT and a number",
                      "write PRESET SELECT #1; the numbers of presets by name are the machine's");
    }
    code("CYCL DEF 247", column);
    add_value(draft_, 'P', "PRESET SELECT", column, "Q339=");
    end_statement(draft_);
  }

 private:
  void code(std::string_view name, std::uint32_t column) {
    add_code(block_, *find_code(Dialect::heidenhain, name), column);
  }

  void read_datum(bool resets, std::uint32_t column) {
    if (!resets) {
      if (!in_.take_name("AXIS")) {
        return in_.fail("not-supported"_id, column, "TRANS DATUM from a table is not simulated",
                        "give the shift by its values: TRANS DATUM AXIS X+10");
      }
      code("CYCL DEF 7", column);
      return read_heidenhain_axes(draft_, "TRANS DATUM");
    }
    code("CYCL DEF 7", column);
    for (const char axis : {'X', 'Y', 'Z', 'A', 'B', 'C'}) add_number(block_, axis, 0.0, column);
    end_statement(draft_);
  }

  void read_mirror(bool resets, std::uint32_t column) {
    if (resets) {
      code("CYCL DEF 8 OFF", column);
      return end_statement(draft_);
    }
    (void)in_.take_name("AXIS");
    while (!in_.at_end() && in_.peek() != ';') {
      const std::uint32_t place = in_.column();
      const std::string axes = in_.letters();
      if (axes.empty() || axes.find_first_not_of("XYZ") != std::string::npos) {
        return in_.fail("unknown-word"_id, place, "TRANS MIRROR mirrors X, Y and Z",
                        "write TRANS MIRROR AXIS X");
      }
      for (const char axis : axes) add_number(block_, axis, 0.0, place);
    }
    code("CYCL DEF 8", column);
    end_statement(draft_);
  }

  void read_rotation(bool resets, std::uint32_t column) {
    code("CYCL DEF 10", column);
    add_number(block_, 'X', 0.0, column);
    add_number(block_, 'Y', 0.0, column);
    const std::uint32_t place = in_.column();
    const std::string name = resets ? "ROT" : in_.letters();
    if (name != "ROT" && name != "IROT") {
      return in_.fail("value-missing"_id, place, "TRANS ROTATION has no ROT",
                      "write TRANS ROTATION ROT+35");
    }
    if (resets) {
      add_number(block_, 'R', 0.0, column, "ROT");
      return end_statement(draft_);
    }
    add_value(draft_, 'R', name, place, name == "ROT" ? "ROT" : "IROT");
    if (name == "IROT") block_.words.back().measure = Measure::incremental;
    end_statement(draft_);
  }

  void read_scale(bool resets, std::uint32_t column) {
    code("CYCL DEF 11", column);
    for (const char axis : {'X', 'Y', 'Z'}) add_number(block_, axis, 0.0, column);
    const std::uint32_t place = in_.column();
    if (resets) {
      add_number(block_, 'P', 1.0, column, "SCL");
    } else if (in_.letters() == "SCL") {
      add_value(draft_, 'P', "SCL", place, "SCL");
    } else {
      return in_.fail("value-missing"_id, place, "TRANS SCALE has no SCL",
                      "write TRANS SCALE SCL 0.99");
    }
    block_.words.back().decimal_point = true;  // a factor, no thousandths
    end_statement(draft_);
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

void read_heidenhain_transform(BlockDraft& draft, const std::string& statement,
                               std::uint32_t column) {
  TransformReader reader(draft);
  if (statement == "TRANS") return reader.read_trans(column);
  reader.read_preset(column);
}

}  // namespace frustum::parser
