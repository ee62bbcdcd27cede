// What makes a report evidence: whose part, measured with what and by which rules, from which files
// by which version. Every format of the results has the same facts.
//
// Units: none; values are texts for people, with their units. Errors: none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "metrology/plan/report_header.hpp"
#include "report/wording.hpp"

namespace frustum::report {

struct Fact {
  std::string key{};    // in JSON and QIF: "decision_rule"
  std::string label{};  // for people: "Decision rule"
  std::string value{};
};

struct HashedFile {
  // "program", "subprogram", "plan", "job", "machine", "errors", "tools", "points", "mesh", ..
  std::string role{};
  std::string name{};    // without folders, so that a report does not depend on where it was made
  std::string sha256{};  // of its bytes; empty: read from a pipe, and nobody has them any more
};
// The role, the name and the fingerprint of what a file held.
[[nodiscard]] HashedFile hashed_file(std::string role, const std::string& path,
                                     std::string_view bytes);
// For people: the fingerprint, or that there is none.
[[nodiscard]] std::string fingerprint_text(const HashedFile& file,
                                           const Wording& words = Wording());

struct Evidence {
  metrology::ReportHeader header{};
  std::vector<Fact> measuring{};  // as measuring_statement() gives them, in English and mm
  // The same as a page says them, in its language and units; empty: as above.
  std::vector<Fact> measuring_shown{};
  // Which draw of errors that are written as distributions.
  struct Draw {
    std::uint64_t seed = 0;
    std::uint32_t index = 0;
  };
  std::optional<Draw> error_draw{};
  std::vector<HashedFile> files{};
};

// The facts that a page shows of how was measured.
[[nodiscard]] const std::vector<Fact>& shown_measuring(const Evidence& evidence);
// The facts of the head that are stated.
[[nodiscard]] std::vector<Fact> stated(const metrology::ReportHeader& header);
// Measuring, and the draw.
[[nodiscard]] std::vector<Fact> made_and_measured(const Evidence& evidence);
// The same as a page shows them.
[[nodiscard]] std::vector<Fact> shown_made_and_measured(const Evidence& evidence,
                                                        const Wording& words);
// All facts, the version of the program among them, in one order for every format: head, measuring,
// draw, "sha256_program" and so on; of several files of a role "sha256_errors_2" is the second.
[[nodiscard]] std::vector<Fact> all_facts(const Evidence& evidence, const std::string& version);

}  // namespace frustum::report
