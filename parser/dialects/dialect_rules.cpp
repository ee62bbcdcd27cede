#include "parser/dialects/dialect_rules.hpp"

namespace frustum::parser {

const DialectRules& rules_of(Dialect dialect) {
  static const std::array kRules{&fanuc_rules(), &linuxcnc_rules(), &sinumerik_rules(),
                                 &heidenhain_rules(), &cldata_rules()};
  static_assert(kRules.size() == kDialects.size());
  return *kRules[static_cast<std::size_t>(dialect)];
}

std::string_view letter_use(const DialectRules& rules, char letter) {
  for (const LetterUse& use : rules.letters) {
    if (use.letter == letter) return use.use;
  }
  return {};
}

}  // namespace frustum::parser
