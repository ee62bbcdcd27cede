// The texts of motion tests of rotary axes, of set-up sheets and of probing: part of the table of
// phrases.hpp.
//
// Units: none. Errors: none.
// Source: DIN ISO 230-7 and DIN EN ISO 10360-5 for the German terms
#pragma once

#include "report/phrase_row.hpp"

namespace frustum::report {

inline constexpr PhraseRow kAxesRows[] = {
    {"Axis {0}, {1} bar held on the {2}", "Achse {0}, Kugelstab {1}, gehalten vom {2}"},
    {"axial", "axial"},
    {"radial", "radial"},
    {"tangential", "tangential"},
    {"normal", "normal"},
    {"rotor", "Rotor"},
    {"bed", "Bett"},
    {"Cone path, bar {0}", "Kegelbahn, Kugelstab {0}"},
    {"1 reading, {0} .. {1} {2}", "1 Anzeige, {0} .. {1} {2}"},
    {"{0} readings, {1} .. {2} {3}", "{0} Anzeigen, {1} .. {2} {3}"},
    {"Reading of the bar", "Anzeige des Kugelstabs"},
    {"reading", "Anzeige"},
    {"harmonic over {0}", "Harmonische über {0}"},
    {"Harmonics over {0}", "Harmonische über {0}"},
    {"harmonic", "Harmonische"},
    {"Peak to valley without mean, cos and sin: {0} {1}.",
     "Spitze-Tal-Wert ohne Mittelwert, cos und sin: {0} {1}."},
    {"peak to valley without mean, cos and sin {0} {2}, beyond two harmonics {1} {2} rms",
     "Spitze-Tal-Wert ohne Mittelwert, cos und sin {0} {2}, jenseits von zwei Harmonischen {1} "
     "{2} (quadratischer Mittelwert)"},
    {"R-test", "R-Test"},
    {"pose", "Stellung"},
    {"{0} more poses: --json", "{0} weitere Stellungen: --json"},
    {"Displacements, frame of the table", "Verschiebungen im Tischkoordinatensystem"},
    {"root mean square {0} {1}, in the frame of the table",
     "quadratischer Mittelwert {0} {1}, im Tischkoordinatensystem"},
    {"set-up found: table ball off by {0}, bar longer by {1}",
     "Aufbau gefunden: Tischkugel versetzt um {0}, Kugelstab länger um {1}"},
    {"set-up found: table ball off by {0}", "Aufbau gefunden: Tischkugel versetzt um {0}"},
    {"Set-up found, table ball off", "Aufbau gefunden, Tischkugel versetzt um"},
    {"Set-up found, bar longer by", "Aufbau gefunden, Kugelstab länger um"},
    {"Set-up found, centre of the circle", "Aufbau gefunden, Mittelpunkt des Kreises"},
    // The set-up sheet and its drawing.
    {"Set-up on the table", "Aufbau auf dem Tisch"},
    {"from above", "von oben"},
    {"from the front", "von vorn"},
    {"+ G54 at {0} {1}, {2} {3} {5}; bar {4} {5} where it is mounted",
     "+ G54 bei {0} {1}, {2} {3} {5}; Kugelstab {4} {5}, wo er eingesetzt wird"},
    {"spindle ball over table ball", "Spindelkugel über Tischkugel"},
    {"table ball", "Tischkugel"},
    {"spindle ball", "Spindelkugel"},
    {"{0} grows", "{0} wächst"},
    {"Set-up sheet", "Einrichteblatt"},
    {"what", "was"},
    {"where or how much", "wo oder wie viel"},
    {"G54 in the frame of the table, {0}", "G54 im Tischkoordinatensystem, {0}"},
    {"G54 in machine coordinates, without tool, {0}",
     "G54 in Maschinenkoordinaten, ohne Werkzeug, {0}"},
    {"T1: spindle ball, length, {0}", "T1: Spindelkugel, Länge, {0}"},
    {"table ball in the frame of the table, {0}", "Tischkugel im Tischkoordinatensystem, {0}"},
    {"bar, {0}", "Kugelstab, {0}"},
    {"capture, deg of {0}", "Aufzeichnung, deg von {0}"},
    {"with overshoot, deg", "mit Überlauf, deg"},
    {"{0} to {1}", "{0} bis {1}"},
    {"{0} to {1}, endless", "{0} bis {1}, endlos"},
    {"{0} to {1} of {2} to {3}", "{0} bis {1} von {2} bis {3}"},
    {"largest reading, of the stroke", "größte Anzeige, vom Messweg"},
    {"{0} {2} of {1} {2}", "{0} {2} von {1} {2}"},
    {"nearest approach", "kleinster Abstand"},
    {"the machine file has no bodies: not looked for",
     "die Maschinendatei gibt keine Körper an: nicht gesucht"},
    {"bar", "Kugelstab"},
    {"stem of the spindle ball", "Schaft der Spindelkugel"},
    {"cup of the table ball", "Aufnahme der Tischkugel"},
    {"{0} between {1} and {2}, at {3} deg", "{0} zwischen {1} und {2}, bei {3} deg"},
    {"The bar is mounted {0} too long, where the program stops. Travels are those of the pass.",
     "Der Kugelstab wird {0} zu lang eingesetzt, wo das Programm anhält. Die Verfahrwege sind "
     "die des Durchgangs."},
    {" Without a tool length of {0} or more the spindle is not looked at.",
     " Ohne eine Werkzeuglänge von {0} oder mehr wird die Spindel nicht betrachtet."},
    // Touch-trigger calibration and R-tests at its positions.
    {"Touch-trigger calibration of A and C", "Kalibrierung von A und C mit schaltendem Taster"},
    {"Measured touch-trigger calibration of A and C",
     "Gemessene Kalibrierung von A und C mit schaltendem Taster"},
    {"Measured touches on {0}", "Gemessene Antastungen auf {0}"},
    {"R-tests with {0} balls on {1}", "R-Tests mit {0} Kugeln auf {1}"},
    {"Errors of A and C from R-tests", "Abweichungen von A und C aus R-Tests"},
    {"Ball of the probe off", "Tastkugel versetzt um"},
    {"Artefact off", "Prüfkörper versetzt um"},
    {"Bands", "Bänder"},
    {"two standard deviations", "zwei Standardabweichungen"},
    {"{0} touches of three columns at {1} positions of A and {2} of C",
     "{0} Antastungen an drei Säulen bei {1} Positionen von A und {2} von C"},
    {"Identified errors", "Bestimmte Abweichungen"},
    {"Standard deviation, propagated from the noise of a touch",
     "Standardabweichung, fortgepflanzt aus dem Rauschen einer Antastung"},
    {"Standard deviation of {0} calibrations", "Standardabweichung aus {0} Kalibrierungen"},
    {"map", "Karte"},
    {"position, deg", "Position, deg"},
    {"A {0}, all C", "A {0}, alle C"},
    {"Errors of A, translations", "Abweichungen von A, Verschiebungen"},
    {"Errors of A, rotations", "Abweichungen von A, Drehungen"},
    {"{0}, at each position of A", "{0}, an jeder Position von A"},
    {"largest difference from the machine's own errors of A and C: {0} {2}, {1} urad",
     "größter Unterschied zu den eigenen Abweichungen der Maschine in A und C: {0} {2}, {1} "
     "urad"},
    {"Zero at A = C = 0: the error there is not seen, its part across the axis of C turns with "
     "the table. Errors of the linear axes and of the ball in the spindle appear as errors of A "
     "and C.",
     "Null bei A = C = 0: die Abweichung dort ist nicht zu sehen, ihr Teil quer zur Achse C "
     "dreht sich mit dem Tisch. Abweichungen der Linearachsen und der Kugel in der Spindel "
     "erscheinen als Abweichungen von A und C."},
    {"What is left over of the touches", "Was von den Antastungen übrig bleibt"},
    {"What is left over of the R-tests", "Was von den R-Tests übrig bleibt"},
    {"{0} degrees of freedom", "{0} Freiheitsgrade"},
    {"expected of the noise", "vom Rauschen zu erwarten"},
    {"probability {0}", "Wahrscheinlichkeit {0}"},
    {"largest", "größter"},
    {"its standard deviation", "dessen Standardabweichung"},
    {"where", "wo"},
    {"{0} rms", "{0} (quadratischer Mittelwert)"},
    {" where their noise makes {0} (probability {1})",
     " bei {0} aus ihrem Rauschen (Wahrscheinlichkeit {1})"},
    {"left over of the touches: {0}, at most {1} at {2}",
     "von den Antastungen bleibt übrig: {0}, höchstens {1} bei {2}"},
    {"left over of the R-tests: {0}, at most {1} at {2}",
     "von den R-Tests bleibt übrig: {0}, höchstens {1} bei {2}"},
    {"touch of {0} at {1}", "Antastung von {0} bei {1}"},
    {"point {0} ({1} of column {2})", "Punkt {0} ({1} von Säule {2})"},
    {"top", "Oberseite"},
    {"ball {0} ({1}) at {2}", "Kugel {0} ({1}) bei {2}"},
    {"Nothing checks the touches of {0}: three tops give the height and the tilts of a pose and "
     "no more, and what is touched at zero alone is compared with nothing. One that is off goes "
     "into the maps without a trace.",
     "Nichts prüft die Antastungen von {0}: drei Oberseiten geben Höhe und Neigungen einer "
     "Stellung und nicht mehr, und was allein bei null angetastet wird, wird mit nichts "
     "verglichen. Eine falsche geht ohne Spur in die Karten ein."},
    // The part on its machine.
    {"The part probed where it was cut", "Das Teil, angetastet, wo es gefertigt wurde"},
    {"Probed at", "Angetastet bei"},
    {"Ball", "Kugel"},
    {"Touches of", "Antastungen aus"},
    {"{0} touches with a ball of {1}", "{0} Antastungen mit einer Kugel von {1}"},
    {" at {0}", " bei {0}"},
    {"The same part on a CMM and on its machine",
     "Dasselbe Teil auf dem Koordinatenmessgerät und auf seiner Maschine"},
    {"on a CMM", "auf dem Koordinatenmessgerät"},
    {"on the machine", "auf der Maschine"},
    {"difference", "Unterschied"},
    {"The CMM makes no error here; what differs are the errors of the machine, which cut the "
     "part and probe it.",
     "Das Koordinatenmessgerät ist hier abweichungsfrei; was sich unterscheidet, sind die "
     "Abweichungen der Maschine, die das Teil gefertigt hat und antastet."},
    {"What becomes of each error on the machine", "Was auf der Maschine aus jeder Abweichung wird"},
    {"error", "Abweichung"},
    {"of its effect on a CMM", "von ihrer Wirkung auf dem Koordinatenmessgerät"},
    {"cancels", "hebt sich auf"},
    {"cancels in part", "hebt sich zum Teil auf"},
    {"stays", "bleibt"},
    {"grows", "wächst"},
    {"not in {0}", "nicht in {0}"},
    {"; in ", "; in "},
    {" (there alone)", " (nur dort)"},
    {"cancel: the machine makes them again where it probes, and no measurement there shows them",
     "heben sich auf: die Maschine macht sie beim Antasten noch einmal, und keine Messung dort "
     "zeigt sie"},
    {"cancel in part", "heben sich zum Teil auf"},
    {"are seen on the machine about as on a CMM",
     "sind auf der Maschine etwa so zu sehen wie auf dem Koordinatenmessgerät"},
    {"are seen more on the machine than on a CMM",
     "sind auf der Maschine stärker zu sehen als auf dem Koordinatenmessgerät"},
    {"do nothing to these characteristics", "ändern diese Merkmale nicht"},
    {"An error cancels where its effect on the machine is below {0} % of that on a CMM. Of "
     "component errors it is a share that grows evenly over the travel.",
     "Eine Abweichung hebt sich auf, wo ihre Wirkung auf der Maschine unter {0} % der auf dem "
     "Koordinatenmessgerät liegt. Bei Komponentenabweichungen ist es ein Anteil, der über den "
     "Verfahrweg gleichmäßig wächst."},
    {"How far out the surface seems to be", "Wie weit außen die Oberfläche zu liegen scheint"},
    {"touch", "Antastung"},
    // Vectors of the rotary axes.
    {"Kinematic vectors of the rotary axes", "Kinematische Vektoren der Drehachsen"},
    {"Lines of the rotary axes, all axes at zero", "Lage der Drehachsen, alle Achsen in null"},
    {"of the", "gehört zu"},
    {"table", "Tisch"},
    {"head", "Kopf"},
    {"point {0}", "Punkt {0}"},
    {"off by {0}", "versetzt um {0}"},
    {"direction", "Richtung"},
    {"Between the axes of a side: from_previous_mm of the document.",
     "Zwischen den Achsen einer Seite: from_previous_mm im Dokument."},
    {"Signs: a direction is that of +q by the right-hand rule. +q of an axis of the head turns "
     "the tool about it; +q of an axis of the table turns the table the other way (ISO 841).\n"
     "\n"
     "      Z                    table: point = X Y Z at which the gauge point of the spindle,\n"
     "      |   / direction             without a tool, is on the axis\n"
     "      |  o point           head:  point = from the axis to the gauge point, the axes at "
     "zero\n"
     "      | /\n"
     "      |/________ X         A control whose table is zero where it stands at q = 0 needs no\n"
     "     /                     more than these: along an axis its point is free.\n"
     "    Y\n",
     "Vorzeichen: eine Richtung ist die von +q nach der Rechte-Hand-Regel. +q einer Achse des "
     "Kopfes dreht das Werkzeug um sie; +q einer Achse des Tisches dreht den Tisch "
     "andersherum (ISO 841).\n"
     "\n"
     "      Z                    Tisch: Punkt = X Y Z, bei denen der Bezugspunkt der Spindel\n"
     "      |   / Richtung              ohne Werkzeug auf der Achse liegt\n"
     "      |  o Punkt           Kopf:  Punkt = von der Achse zum Bezugspunkt, Achsen in null\n"
     "      | /\n"
     "      |/________ X         Eine Steuerung, deren Tisch in null ist, wo er bei q = 0 steht,\n"
     "     /                     braucht nicht mehr: entlang einer Achse ist ihr Punkt frei.\n"
     "    Y\n"},
};

}  // namespace frustum::report
