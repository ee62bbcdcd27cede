// The texts of a machine's history: part of the table of phrases.hpp.
//
// Units: none. Errors: none.
// Source: DIN ISO 7870-2 for the German terms
#pragma once

#include "report/phrase_row.hpp"

namespace frustum::report {

// On the page, then in the text on a terminal.
inline constexpr PhraseRow kHistoryRows[] = {
    {"History of a machine", "Verlauf einer Maschine"},
    {"Values", "Werte"},
    {"Limits and mean are of the results as found or without a state, the trend is of what "
     "came since the last adjustment; the tolerance is that of the last result. ±: 95 % "
     "interval of the slope by the scatter about the line.",
     "Grenzen und Mittelwert sind aus den vorgefundenen Ergebnissen und denen ohne Zustand, "
     "der Trend ist aus dem, was nach der letzten Justierung kam; die Toleranz ist die des "
     "letzten Ergebnisses. ±: 95-%-Intervall der Steigung aus der Streuung um die Gerade."},
    {"Quantity", "Größe"},
    {"Results", "Ergebnisse"},
    {"Last", "Letzter Wert"},
    {"Mean", "Mittelwert"},
    {"Control limits", "Eingriffsgrenzen"},
    {"Trend in 30 days", "Trend in 30 Tagen"},
    {"{0} fail", "{0} nicht konform"},
    {"As found and as left", "Vorgefunden und hinterlassen"},
    {"What each adjustment changed.", "Was jede Justierung geändert hat."},
    {"As left and next found", "Hinterlassen und wieder vorgefunden"},
    {"What changed in service from an adjustment to the next result.",
     "Was sich im Betrieb von einer Justierung bis zum nächsten Ergebnis geändert hat."},
    {"Days", "Tage"},
    {"Change", "Änderung"},
    {"Dates are never those of the file system.", "Kein Datum stammt aus dem Dateisystem."},
    {"Document", "Dokument"},
    {"Date from", "Datum aus"},
    {"State", "Zustand"},
    {"State from", "Zustand aus"},
    {"Without a value", "Ohne Wert"},
    {"{0}: no value of {1}", "{0}: kein Wert von {1}"},
    {"index", "Liste"},
    {"document", "Dokument"},
    {"file name", "Dateiname"},
    {"folder name", "Ordnername"},
    {"nowhere", "unbekannt"},
    {"identification", "Identifikation"},
    {"motion", "Bewegungsprüfung"},
    {"as-found", "vorgefunden"},
    {"as-left", "hinterlassen"},
    {"1 value", "1 Größe"},
    {"{0} values", "{0} Größen"},
    {"1 point beyond limits", "1 Punkt außerhalb der Grenzen"},
    {"{0} points beyond limits", "{0} Punkte außerhalb der Grenzen"},
    {"Limits of", "Grenzen aus"},
    {"the first {0} results, or of all where there are fewer",
     "den ersten {0} Ergebnissen, oder allen, wo es weniger sind"},
    {"Judged since", "Beurteilt ab"},
    {"What fails", "Außerhalb der Grenzen"},
    {"Control charts", "Qualitätsregelkarten"},
    {"Dots: as found; rings: as left after an adjustment, which do not enter the limits; "
     "orange: beyond a limit or the tolerance; whiskers: 95 % interval of the value, where "
     "it is stated. Grey, dashed: control limits, mean ± 2.66 times the mean moving range, "
     "below them the moving ranges with their limit of 3.267 times their mean (ISO 7870-2). "
     "Red, dashed: tolerance, where it is near. Green, dashed: least-squares trend.",
     "Punkte: vorgefunden; Ringe: nach einer Justierung hinterlassen, sie gehen nicht in die "
     "Grenzen ein; orange: außerhalb einer Grenze oder der Toleranz; senkrechte Striche: "
     "95-%-Intervall des Werts, wo es angegeben ist. Grau, gestrichelt: Eingriffsgrenzen, "
     "Mittelwert ± 2,66-mal mittlere gleitende Spannweite, darunter die gleitenden "
     "Spannweiten mit ihrer Grenze, dem 3,267-Fachen ihres Mittelwerts (ISO 7870-2). Rot, "
     "gestrichelt: Toleranz, wo sie nahe liegt. Grün, gestrichelt: Trend nach kleinsten "
     "Quadraten."},
    {"Made by Frustum {0}. The licences of the bundled packages are in the source of this page.",
     "Erstellt mit Frustum {0}. Die Lizenzen der enthaltenen Pakete stehen im Quelltext dieser "
     "Seite."},
    {"LCL", "UEG"},
    {"UCL", "OEG"},
    {"mean", "Mittelwert"},
    {"moving range", "Spannweite"},
    {"{0}: {1} over the date", "{0}: {1} über dem Datum"},
    {"1 result: no control limits, they need {0}",
     "1 Ergebnis: keine Eingriffsgrenzen, dafür sind {0} nötig"},
    {"{0} results: no control limits, they need {1}",
     "{0} Ergebnisse: keine Eingriffsgrenzen, dafür sind {1} nötig"},
    {"limits of {0} results: provisional below {1}",
     "Grenzen aus {0} Ergebnissen: vorläufig, solange es weniger als {1} sind"},
    {", out of its tolerance {0}", ", außerhalb der Toleranz {0}"},
    {", not proven within its tolerance {0}", ", nicht nachweislich in der Toleranz {0}"},
    {", above the upper control limit {0}", ", über der oberen Eingriffsgrenze {0}"},
    {", below the lower control limit {0}", ", unter der unteren Eingriffsgrenze {0}"},
    {", changed by {0}, limit {1}", ", geändert um {0}, Grenze {1}"},
    {", machine {0}", ", Maschine {0}"},
    {"{0}: 1 result from {1} to {2}", "{0}: 1 Ergebnis von {1} bis {2}"},
    {"{0}: {1} results from {2} to {3}", "{0}: {1} Ergebnisse von {2} bis {3}"},
    {"quantity", "Größe"},
    {"unit", "Einheit"},
    {"results", "Ergebnisse"},
    {"first", "erster Wert"},
    {"last", "letzter Wert"},
    {"control limits", "Eingriffsgrenzen"},
    {"tolerance", "Toleranz"},
    {"trend in 30 days", "Trend in 30 Tagen"},
    {"verdict", "Entscheidung"},
    {"Control limits need {0} results as found, and are provisional below {1}.",
     "Eingriffsgrenzen brauchen {0} vorgefundene Ergebnisse und sind vorläufig, solange es "
     "weniger als {1} sind."},
    {"adjusted, as found to as left", "justiert, vorgefunden bis hinterlassen"},
    {"drifted, as left to next found", "gewandert, hinterlassen bis wieder vorgefunden"},
    {"from", "von"},
    {"to", "bis"},
    {"days", "Tage"},
    {"change", "Änderung"},
    {"result", "Ergebnis"},
    {"date", "Datum"},
    {"date from", "Datum aus"},
    {"state", "Zustand"},
    {"state from", "Zustand aus"},
};

}  // namespace frustum::report
