// What records of APT CLDATA say beside the path: texts, notes, comments, what had to be assumed.
//
// Units : none
// Errors: by LineScanner::fail: a record that goes on behind its end
#pragma once

#include <string>

#include "parser/language/block.hpp"
#include "parser/reading/cldata/cldata_record.hpp"
#include "parser/reading/line_scanner.hpp"

namespace frustum::parser {

// Of one record; what it takes becomes a comment of the block.
class CldataRemarks {
 public:
  CldataRemarks(LineScanner& in, CldataRecord& record, Block& block)
      : in_(in), record_(record), block_(block) {}

  // $$ remark
  bool take_comment();
  // Of a record that goes on with a remark before it: $$-> CSYS / 1.0, 0.0, $
  [[nodiscard]] std::string numbers_of_remark();
  // PARTNO FLANGE, PPRINT/DONE
  bool take_text();
  // Records that change nothing which is simulated. `frame` is that of the MSYS before.
  bool take_note(std::string& frame);
  // ROTABL/0.0,,TABLE,CLW
  bool take_turn_of_nothing();
  // Of records that could change the path, the forms that do not.
  bool take_harmless();
  // The arguments of all lines that it goes over.
  [[nodiscard]] std::string rest_of_record();
  void assumed(const char* name, const char* text);

 private:
  void add(const char* event, std::string text);
  void check_inserted();
  bool note(const char* event);
  bool note_frame(std::string& before);

  LineScanner& in_;
  CldataRecord& record_;
  Block& block_;
};

}  // namespace frustum::parser
