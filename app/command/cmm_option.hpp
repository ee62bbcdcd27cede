// --e0, --l-per-um, --cmm: the accuracy of the machine that has measured points, or is to measure a
// mesh.
//
// Units : mm; e0 as a length with its unit. Errors: a length below 0 or none, --cmm together with
//         the others, a file that is neither one of a CMM nor a job that states one, with file and
//         key
#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "metrology/probing/cmm_model.hpp"

namespace frustum::app {

class Command;

struct CmmWords {
  std::string e0{};
  std::optional<double> l_per_um{};
  std::string file{};

  [[nodiscard]] bool any() const { return !e0.empty() || l_per_um || !file.empty(); }
};

void add_cmm_options(Command& command, CmmWords& words);

// An ideal machine when nothing is said.
[[nodiscard]] Result<metrology::CmmModel> cmm_of(const CmmWords& words);

}  // namespace frustum::app
