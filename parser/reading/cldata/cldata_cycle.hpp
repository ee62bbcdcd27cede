// CYCLE records of APT CLDATA, in the forms of ISO 4343 and of the CAM systems:
//
//   CYCLE/DRILL,DEPTH,12,MMPM,100,CLEAR,3,RAPTO,1,RETURN,20,DWELL,.5    (Creo)
//   CYCLE/DRILL,RAPTO,3,FEDTO,-12,RTRCTO,AUTO,MMPM,100                  (NX)
//   CYCLE/DRILL,12,100,MMPM,3                                           (depth, feed, clearance)
//   CYCLE/DEEP2,FEDTO,12,1STPECK,5,SUBPECK,2,MMPM,100,RAPTO,3,RTRCTO,25 (SolidWorks CAM)
//   CYCLE/OFF, CYCLE/ON
//
// The GOTO records after it name the top of each hole. Heights count from there along the tool:
// CLEAR is where the tool comes to, RAPTO how much further it goes by rapid (beside FEDTO, or
// without CLEAR: up to which height), RETURN or RTRCTO where it goes afterwards (AUTO, 0: as high
// as before the first hole).
// Units : those of the file, seconds
// Errors: by LineScanner::fail: cycles that are not simulated, words that are unknown or miss their
//         number, a cycle without depth, feed or clearance
// Source: ISO 4343:2000, 10.8
#pragma once

#include "parser/reading/cldata/cldata_record.hpp"
#include "parser/reading/cldata/cldata_settings.hpp"

namespace frustum::parser {

// Adds the words of the cycle: hole_cycle.hpp.
void read_cldata_cycle(LineScanner& in, const CldataRecord& record, const CldataModes& modes,
                       Block& block);

}  // namespace frustum::parser
