// How a part was measured: part of the table of phrases.hpp.
//
// Units: none. Errors: none.
// Source: DIN EN ISO 10360, DIN EN ISO 14253-1, DIN EN ISO 5459 for the German terms
#pragma once

#include "report/phrase_row.hpp"

namespace frustum::report {

// The statement and its words.
inline constexpr PhraseRow kMeasuringRows[] = {
    {"How it was measured", "Messbedingungen"},
    {"Files", "Dateien"},
    {"File", "Datei"},
    {"Name", "Name"},
    {"not stated", "nicht angegeben"},
    {"not proven", "nicht nachgewiesen"},
    {"not known: it was read from a pipe", "unbekannt: aus einer Pipe gelesen"},
    {"Draw of the errors", "Ziehung der Abweichungen"},
    {"seed {0}, number {1}", "Startwert {0}, Nummer {1}"},
    {"Measured by", "Gemessen mit"},
    {"Accuracy", "Genauigkeit"},
    {"Probe", "Taster"},
    {"Stylus", "Taststift"},
    {"Temperature", "Temperatur"},
    {"Alignment", "Ausrichtung"},
    {"Filter", "Filter"},
    {"Association", "Zuordnung"},
    {"Form parameter", "Formkenngröße"},
    {"Uncertainty", "Messunsicherheit"},
    {"Decision rule", "Entscheidungsregel"},
    {"points of a CMM, read from a file",
     "Punkte eines Koordinatenmessgeräts, aus einer Datei gelesen"},
    {"virtual CMM on a mesh", "virtuelles Koordinatenmessgerät auf einem Netz"},
    {"virtual CMM", "virtuelles Koordinatenmessgerät"},
    {"{0}, {1}, seed {2}", "{0}, {1}, Startwert {2}"},
    {"21 parametric errors", "21 parametrische Abweichungen"},
    {"linear error field and noise", "lineares Abweichungsfeld und Rauschen"},
    {"{0} + L/{1} (L in mil, E in µin)", "{0} + L/{1} (L in mil, E in µin)"},
    {"{0} + L/{1} (L in mm, E in µm)", "{0} + L/{1} (L in mm, E in µm)"},
    {"ideal, E0 = 0: the machine makes no error, and every U is 0",
     "ideal, E0 = 0: das Gerät hat keine Abweichungen, jedes U ist 0"},
    {"not stated: the mesh counts as the part, and every U is 0",
     "nicht angegeben: das Netz gilt als das Teil, jedes U ist 0"},
    {"not stated: every U is 0, which says nothing about the machine",
     "nicht angegeben: jedes U ist 0, was nichts über das Gerät sagt"},
    {"; how errors grow with length is not stated, no U contains it",
     "; wie Abweichungen mit der Länge wachsen, ist nicht angegeben und in keinem U "
     "enthalten"},
    {"ball diameter {0}", "Kugeldurchmesser {0}"},
    {", compensated along the normal of the fitted element",
     ", korrigiert entlang der Normalen des Ausgleichselements"},
    {", compensated against the approach", ", korrigiert entgegen der Antastrichtung"},
    {"length {0}, shank {1}, from the ball along ({2}, {3}, {4})",
     "Länge {0}, Schaft {1}, von der Kugel aus entlang ({2}; {3}; {4})"},
    {"part {0} °C, {1} µm/(m K); scales {2} °C, {3} µm/(m K); {4}",
     "Teil {0} °C, {1} µm/(m K); Maßstäbe {2} °C, {3} µm/(m K); {4}"},
    {"compensated", "kompensiert"},
    {"not compensated", "nicht kompensiert"},
    {", sensors right to ± {0} K, coefficients to ± {1} µm/(m K)",
     ", Sensoren auf ± {0} K richtig, Ausdehnungskoeffizienten auf ± {1} µm/(m K)"},
    {"none: results are in the frame in which the points come",
     "keine: Ergebnisse im Koordinatensystem der Punkte"},
    {"best fit of {0} by least squares", "Einpassung von {0} nach kleinsten Quadraten"},
    {"datums {0}", "Bezüge {0}"},
    {", each by its own least-squares element",
     ", jeder durch sein eigenes Ausgleichselement nach Gauß"},
    {", touched from outside the material (ISO 5459)",
     ", von außerhalb des Werkstoffs anliegend (ISO 5459)"},
    {", by least squares in this order", ", nach kleinsten Quadraten in dieser Reihenfolge"},
    {"to {0} UPR", "bis {0} W/U"},
    {"from {0} UPR", "ab {0} W/U"},
    {"cut-off {0}", "Grenzwellenlänge {0}"},
    {"long waves from {0} removed", "lange Wellen ab {0} entfernt"},
    {"{0}: Gaussian, {1}", "{0}: Gauß, {1}"},
    {"none: forms hold all undulations and the noise of the machine",
     "keine: Formabweichungen enthalten alle Welligkeiten und das Rauschen des Geräts"},
    {"; its {0} a point make a perfect circle of 36 points {1}, of 360 points {2}",
     "; seine {0} je Punkt machen aus einem idealen Kreis mit 36 Punkten {1}, mit 360 "
     "Punkten {2}"},
    {"; all others none", "; alle anderen keine"},
    {"least squares", "kleinste Quadrate (Gauß)"},
    {"minimum zone", "Minimumzone (Tschebyscheff)"},
    {"maximum inscribed", "Pferchelement"},
    {"minimum circumscribed", "Hüllelement"},
    {"outside the material", "außerhalb des Werkstoffs"},
    {"datum {0}", "Bezug {0}"},
    {"floating, planned geometry fitted to the points",
     "eingepasst, Nenngeometrie in die Punkte gelegt"},
    {"not stated: nothing is said of how far the values are from the truth",
     "nicht angegeben: wie weit die Messwerte von den wahren Werten entfernt sind, ist "
     "nicht gesagt"},
    {"value +- U holds the true value in 95 % of measurements, by what is stated of the "
     "machine",
     "Messwert +- U enthält den wahren Wert bei 95 % der Messungen, nach den Angaben zum "
     "Gerät"},
    {"; not proven where single touched points decide: {0}",
     "; nicht nachgewiesen, wo einzelne berührte Punkte entscheiden: {0}"},
    {"; the interval is simulated (Monte Carlo)", "; das Intervall ist simuliert (Monte Carlo)"},
    {"simple acceptance: the value is within the tolerance; U is not taken into account "
     "(ISO 14253-1 is not applied)",
     "einfache Annahme: der Messwert liegt innerhalb der Toleranz; U bleibt "
     "unberücksichtigt (ISO 14253-1 ist nicht angewendet)"},
    {"ISO 14253-1: pass where value + U, and value - U of a value with two limits, is "
     "within the tolerance, fail where all of value +- U is outside, uncertain otherwise "
     "and where U is not proven or not stated",
     "ISO 14253-1: Konformität, wo Messwert + U, bei zwei Grenzen auch Messwert - U, "
     "innerhalb der Toleranz liegt; Nichtkonformität, wo Messwert +- U ganz außerhalb "
     "liegt; sonst und wo U nicht nachgewiesen oder nicht angegeben ist, unentschieden"},
};

}  // namespace frustum::report
