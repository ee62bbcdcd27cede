#include "parser/reading/sinumerik/sinumerik_swivel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "parser/dialects/code_table.hpp"
#include "parser/reading/sinumerik/sinumerik_values.hpp"

namespace frustum::parser {
namespace {

struct SwivelParameter {
  std::string_view name;
  char letter;
  const char* spelled;
};
// The parameters of CYCLE800 in their order; those without a letter are looked at by the reader.
constexpr std::array kSwivelParameters{
    SwivelParameter{"_FR", 0, ""},       SwivelParameter{"_TC", 0, ""},
    SwivelParameter{"_ST", 0, ""},       SwivelParameter{"_MODE", 'Q', "_MODE="},
    SwivelParameter{"_X0", 'X', "_X0="}, SwivelParameter{"_Y0", 'Y', "_Y0="},
    SwivelParameter{"_Z0", 'Z', "_Z0="}, SwivelParameter{"_A", 'A', "_A="},
    SwivelParameter{"_B", 'B', "_B="},   SwivelParameter{"_C", 'C', "_C="},
    SwivelParameter{"_X1", 'u', "_X1="}, SwivelParameter{"_Y1", 'v', "_Y1="},
    SwivelParameter{"_Z1", 'w', "_Z1="}, SwivelParameter{"_DIR", 'd', "_DIR="},
    SwivelParameter{"_FR_I", 0, ""},     SwivelParameter{"_DMODE", 0, ""}};
constexpr std::size_t kSwivelData = 1;
constexpr std::size_t kSwivelStatus = 2;

class SwivelReader {
 public:
  explicit SwivelReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read(std::uint32_t column) {
    const auto is_swivel = [](const Word& word) {
      return word.letter == kNamedWord && code_at(word.number).word.starts_with("CYCLE800");
    };
    if (std::any_of(block_.words.begin(), block_.words.end(), is_swivel)) {
      return in_.fail("word-twice"_id, column, "CYCLE800 twice in a block", "write two blocks");
    }
    const bool bare = !in_.take('(');
    std::string data = "0";
    std::string written;
    bool any = false;
    std::vector<Word> words;
    for (std::size_t i = 0; !bare && !in_.failed(); ++i) {
      if (in_.at_end()) {
        in_.fail("bracket-not-closed"_id, column, "the bracket of CYCLE800 is not closed",
                 "close it with )");
        return;
      }
      if (i >= kSwivelParameters.size()) {
        in_.fail("argument-count"_id, in_.column(), "CYCLE800 has too many parameters",
                 fmt::format("it takes {}", kSwivelParameters.size()));
        return;
      }
      if (in_.peek() != ',' && in_.peek() != ')') {
        any = true;
        read_swivel_parameter(i, words, data);
      }
      if (in_.take(')')) break;
      if (in_.at_end()) continue;
      if (!in_.take(',')) in_.fail_unexpected("separate the parameters of CYCLE800 by ,");
    }
    const bool cancels = !any || data == "0";
    add_code(block_, *find_code(Dialect::sinumerik, cancels ? "CYCLE800()" : "CYCLE800"), column);
    if (cancels) return;
    block_.words.insert(block_.words.end(), words.begin(), words.end());
    if (std::none_of(words.begin(), words.end(), [](const Word& w) { return w.letter == 'Q'; })) {
      in_.fail("value-missing"_id, column, "CYCLE800 without a swivel mode",
               "give 57 as the fourth parameter");
    }
  }

 private:
  void read_swivel_parameter(std::size_t i, std::vector<Word>& words, std::string& data) {
    const SwivelParameter& parameter = kSwivelParameters.at(i);
    const std::uint32_t column = in_.column();
    if (i == kSwivelData) {
      if (!in_.take('"')) {
        in_.fail("wrong-type"_id, column, "the swivel data record is a text",
                 "write its name in \"\"");
        return;
      }
      data = in_.text_to("\"");
      // No name is the first record, which is in use.
      if (!in_.take('"'))
        in_.fail("text-not-closed"_id, column, "the text is not closed", "close it with \"");
      return;
    }
    Word word;
    word.letter = parameter.letter;
    word.spelled = parameter.spelled;
    word.column = column;
    read_sinumerik_value(draft_, word, std::string(parameter.name));
    if (parameter.letter != 0) {
      words.push_back(word);
    } else if (i == 0 && (word.number != 0.0 || !word.expression.empty())) {
      draft_.add_event("CYCLE800", column, "the retract before the swivel");
    } else if (i == kSwivelStatus && !word.expression.empty()) {
      in_.fail("not-supported"_id, column, "the status of CYCLE800 is computed",
               "write 0 for a new swivel, 1 for one on top of the last");
    } else if (i == kSwivelStatus && static_cast<long>(std::min(word.number, 1e6)) % 10 == 1) {
      words.push_back({kSwivelOnTop, false, column, 1.0, {}, Measure::modal, "_ST="});
    }
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

void read_sinumerik_swivel(BlockDraft& draft, std::uint32_t column) {
  SwivelReader(draft).read(column);
}

}  // namespace frustum::parser
