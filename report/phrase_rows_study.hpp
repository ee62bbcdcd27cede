// The texts of a study of many machines: part of the table of phrases.hpp.
//
// Units: none. Errors: none.
// Source: DIN EN ISO 14253-1, DIN 55350 for the German terms
#pragma once

#include "report/phrase_row.hpp"

namespace frustum::report {

// On the page, then in the text on a terminal.
inline constexpr PhraseRow kStudyRows[] = {
    {"Study of many machines", "Studie über viele Maschinen"},
    {"Machines drawn", "Gezogene Maschinen"},
    {"Seed and scheme", "Startwert und Verfahren"},
    {"random", "zufällig"},
    {"latin", "Latin Hypercube"},
    {"sobol", "Sobol"},
    {"Engine", "Rechenweg"},
    {"full", "vollständig"},
    {"linear", "linear"},
    {", within {0} of whole trials (by {1} controls, statistically)",
     ", innerhalb {0} vollständiger Durchläufe (nach {1} Kontrollen, statistisch)"},
    {"{0}: {1}", "{0} (Begründung auf Englisch: {1})"},
    {"Job", "Auftragsdatei"},
    {"Motion test", "Bewegungsprüfung"},
    {"One pose", "Eine Stellung"},
    {"home", "Grundstellung"},
    {"1 draw failed, counted as not conforming; the first, {0}: {1}",
     "1 Ziehung schlug fehl und zählt als nicht konform; die erste, {0} (Meldung auf "
     "Englisch): {1}"},
    {"{0} draws failed, counted as not conforming; the first, {1}: {2}",
     "{0} Ziehungen schlugen fehl und zählen als nicht konform; die erste, {1} (Meldung auf "
     "Englisch): {2}"},
    {"Not reached: {0}", "Nicht erreicht (Meldung auf Englisch): {0}"},
    {"What the machines make", "Was die Maschinen fertigen"},
    {"characteristic", "Merkmal"},
    {"median (95 % interval)", "Median (95-%-Intervall)"},
    {"limit", "Grenzwert"},
    {"conforming (95 % interval)", "konform (95-%-Intervall)"},
    {"Parts within all limits: {0}.", "Teile innerhalb aller Grenzwerte: {0}."},
    {"Smallest, quartiles, largest, {0}", "Kleinster Wert, Quartile, größter Wert, {0}"},
    {"Each box holds the middle half of the machines, its bar is the median; the whiskers "
     "reach the smallest and the largest value. Dashed: the limits, where they are near.",
     "Jeder Kasten enthält die mittlere Hälfte der Maschinen, sein Strich ist der Median; die "
     "Linien reichen bis zum kleinsten und zum größten Wert. Gestrichelt: die Grenzwerte, wo "
     "sie nahe liegen."},
    {"Box plots", "Boxplots"},
    {"Distributions", "Verteilungen"},
    {"share of the machines", "Anteil der Maschinen"},
    {"The share of machines whose value is not larger. With 95 % confidence the whole line "
     "of all machines is in the band (Dvoretzky, Kiefer, Wolfowitz).",
     "Der Anteil der Maschinen, deren Wert nicht größer ist. Mit 95 % Vertrauen liegt die "
     "ganze Linie aller Maschinen im Band (Dvoretzky, Kiefer, Wolfowitz)."},
    {"Two characteristics of each machine", "Zwei Merkmale jeder Maschine"},
    {"{0} over {1}", "{0} über {1}"},
    {"The first machines of the study. Dashed: limits.",
     "Die ersten Maschinen der Studie. Gestrichelt: Grenzwerte."},
    {"What a guard band costs", "Was ein Sicherheitsband kostet"},
    {"guard band, in U = 2 u (negative: beyond the limit)",
     "Sicherheitsband in U = 2 u (negativ: jenseits des Grenzwerts)"},
    {"risk", "Risiko"},
    {"consumer: a bad part is accepted", "Abnehmer: ein nicht konformes Teil wird angenommen"},
    {"producer: a good part is rejected", "Lieferant: ein konformes Teil wird zurückgewiesen"},
    {"Both risks are below {0} with any of these guard bands: {1}.",
     "Beide Risiken sind mit jedem dieser Sicherheitsbänder kleiner als {0}: {1}."},
    {"Which errors make it", "Welche Abweichungen es bewirken"},
    {"Errors of {0}", "Abweichungen, die {0} bewirken"},
    {"share", "Anteil"},
    {"total index", "Gesamtindex"},
    {"share of the mean square", "Anteil am mittleren Quadrat"},
    {"Total index: the share of the variance that would be left if all other errors were "
     "known. Share of the mean square: of the deviations of all points; these shares add up "
     "to 1.",
     "Gesamtindex: der Anteil der Varianz, der bliebe, wenn alle anderen Abweichungen bekannt "
     "wären. Anteil am mittleren Quadrat: an den Abweichungen aller Punkte; diese Anteile "
     "ergeben zusammen 1."},
    {"Tolerances", "Toleranzen"},
    {"factor on their tolerances", "Faktor auf ihre Toleranzen"},
    {"Tolerances that would do", "Toleranzen, die genügen würden"},
    {"So that {0} % of the parts keep {1}: cost {2}. One factor for all errors would be {3}, "
     "at a cost of {4}.",
     "Damit {0} % der Teile {1} einhalten: Kosten {2}. Ein Faktor für alle Abweichungen wäre "
     "{3}, bei Kosten von {4}."},
    {"Set-ups", "Aufspannungen"},
    {"{0}, part at {1}", "{0}, Teil bei {1}"},
    {"cone half angle", "halber Kegelwinkel"},
    {"inclination", "Neigung"},
    {"Signal, rms {0}", "Signal, quadratischer Mittelwert, {0}"},
    {"Errors that show", "Sichtbare Abweichungen"},
    {"Directions", "Richtungen"},
    {"Signal: root mean square of all points' deviations over all machines. Errors that "
     "show: how many of them, alone and at their limits, make 1 µm of form or more. "
     "Directions: in how many independent ways the deviations scatter (participation ratio). "
     "A strong signal in few directions does not separate one error from another.",
     "Signal: quadratischer Mittelwert der Abweichungen aller Punkte über alle Maschinen. "
     "Sichtbare Abweichungen: wie viele von ihnen, allein und an ihren Grenzen, 1 µm "
     "Formabweichung oder mehr bewirken. Richtungen: auf wie viele unabhängige Arten die "
     "Abweichungen streuen (Partizipationszahl). Ein starkes Signal in wenigen Richtungen "
     "trennt eine Abweichung nicht von der anderen."},
    {"{0}: 1 machine, seed {1}, {2}, engine {3}",
     "{0}: 1 Maschine, Startwert {1}, {2}, Rechenweg {3}"},
    {"{0}: {1} machines, seed {2}, {3}, engine {4}",
     "{0}: {1} Maschinen, Startwert {2}, {3}, Rechenweg {4}"},
    {" (within {0} of whole trials, by 1 control)",
     " (innerhalb {0} vollständiger Durchläufe, nach 1 Kontrolle)"},
    {" (within {0} of whole trials, by {1} controls)",
     " (innerhalb {0} vollständiger Durchläufe, nach {1} Kontrollen)"},
    {" ({0})", " (Begründung auf Englisch: {0})"},
    {"median", "Median"},
    {"max", "größter"},
    {"P(conforms), 95 % interval", "P(konform), 95-%-Intervall"},
    {"all limits: {0} ({1} .. {2})", "alle Grenzwerte: {0} ({1} .. {2})"},
    {"{0}, exact for normal laws: mean {1}, median {2}, 95 % {3}",
     "{0}, exakt bei Normalverteilungen: Mittelwert {1}, Median {2}, 95 % {3}"},
    {"{0}, {1}: accept up to {2} {3}; accepted {4}, consumer's risk {5}, producer's risk {6}",
     "{0}, {1}: Annahme bis {2} {3}; angenommen {4}, Abnehmerrisiko {5}, Lieferantenrisiko "
     "{6}"},
    {"shares of {0}: mean square, total index, first order",
     "Anteile an {0}: mittleres Quadrat, Gesamtindex, erste Ordnung"},
    {"{0} within its limit for {1} %: all errors x {2}",
     "{0} in seinem Grenzwert für {1} %: alle Abweichungen x {2}"},
    {"; or", "; oder"},
    {" (cost {0}, of one factor {1})", " (Kosten {0}, mit einem einzigen Faktor {1})"},
    {"cone {0} deg, inclined {1} deg: rms {2} {3}, errors that show: {4}",
     "Kegel {0} deg, geneigt um {1} deg: quadratischer Mittelwert {2} {3}, sichtbare "
     "Abweichungen: {4}"},
    {"1 draw failed, the first ({0}): {1}",
     "1 Ziehung schlug fehl, die erste ({0}, Meldung auf Englisch): {1}"},
    {"{0} draws failed, the first ({1}): {2}",
     "{0} Ziehungen schlugen fehl, die erste ({1}, Meldung auf Englisch): {2}"},
    {"not reached: {0}", "nicht erreicht (Meldung auf Englisch): {0}"},
};

}  // namespace frustum::report
