// The parts of the table of phrases (phrases.hpp).
//
// Units: none. Errors: none.
#pragma once

#include <array>
#include <cstddef>

#include "report/phrase_rows_axes.hpp"
#include "report/phrase_rows_history.hpp"
#include "report/phrase_rows_measuring.hpp"
#include "report/phrase_rows_motion.hpp"
#include "report/phrase_rows_page.hpp"
#include "report/phrase_rows_study.hpp"
#include "report/phrase_rows_words.hpp"

namespace frustum::report {

struct PhrasePart {
  const PhraseRow* rows;
  std::size_t count;
};
inline constexpr std::array kPhraseParts{PhrasePart{kPageRows, std::size(kPageRows)},
                                         PhrasePart{kMeasuringRows, std::size(kMeasuringRows)},
                                         PhrasePart{kWordRows, std::size(kWordRows)},
                                         PhrasePart{kHistoryRows, std::size(kHistoryRows)},
                                         PhrasePart{kStudyRows, std::size(kStudyRows)},
                                         PhrasePart{kMotionRows, std::size(kMotionRows)},
                                         PhrasePart{kAxesRows, std::size(kAxesRows)},
                                         PhrasePart{kSentenceRows, std::size(kSentenceRows)}};

}  // namespace frustum::report
