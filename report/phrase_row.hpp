// One text in English and German.
//
// Units: none. Errors: none.
#pragma once

#include <string_view>

namespace frustum::report {

struct PhraseRow {
  std::string_view english;
  std::string_view german;
};

}  // namespace frustum::report
