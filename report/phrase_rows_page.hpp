// The texts of the page and of the summary on a terminal: part of the table of phrases.hpp.
//
// Units: none. Errors: none.
#pragma once

#include "report/phrase_row.hpp"

namespace frustum::report {

// In the order of the page.
inline constexpr PhraseRow kPageRows[] = {
    {"Measurement report", "Messbericht"},
    {"Untitled run", "Ohne Titel"},
    {"Pass", "Konform"},
    {"Fail", "Nicht konform"},
    {"Uncertain", "Unentschieden"},
    {"PASS", "KONFORM"},
    {"FAIL", "NICHT KONFORM"},
    {"UNCERTAIN", "UNENTSCHIEDEN"},
    {"passes", "konform"},
    {"fails", "nicht konform"},
    {"uncertain", "unentschieden"},
    {"not measured", "nicht gemessen"},
    {"pass", "konform"},
    {"fail", "nicht konform"},
    {"1 collision", "1 Kollision"},
    {"{0} collisions", "{0} Kollisionen"},
    {"Machine tool", "Werkzeugmaschine"},
    {"Machine", "Maschine"},
    {"Structure", "Strukturcode"},
    {"Program", "Programm"},
    {"Tool", "Werkzeug"},
    {"Points probed", "Angetastete Punkte"},
    {"Cycle time", "Programmlaufzeit"},
    {"Removed", "Abgetragen"},
    {"Bodies", "Körper"},
    {"Errors", "Abweichungen"},
    {"Characteristics", "Merkmale"},
    {"Characteristic", "Merkmal"},
    {"Value", "Messwert"},
    {"Geometric", "Geometrisch"},
    {"Nominal", "Nennwert"},
    {"Tolerance", "Toleranz"},
    {"95\u202f% interval", "95-%-Intervall"},
    {"95 % interval", "95-%-Intervall"},
    {"Used", "Ausgenutzt"},
    {"Verdict", "Entscheidung"},
    {"{0} of {1}", "{0}, {1}"},
    {" to ", " zu "},
    {", section ", ", Schnitt "},
    {", sections ", ", Schnitte "},
    {"{0} in frame {1}", "{0} im Koordinatensystem {1}"},
    {"corrected, without the value", "korrigiert, ohne den Messwert"},
    {"{0} without the seam at {1}° ± {2}°", "{0} ohne die Naht bei {1}° ± {2}°"},
    {"{0}: {1} without the seam at {2} deg +- {3} deg",
     "{0}: {1} ohne die Naht bei {2} deg +- {3} deg"},
    {"Decision rule: {0}. ", "Entscheidungsregel: {0}. "},
    {"U is the expanded measurement uncertainty: value ± U holds the true value in "
     "95\u202f% of measurements",
     "U ist die erweiterte Messunsicherheit: Messwert ± U enthält den wahren Wert bei "
     "95\u202f% der Messungen"},
    {"; of those beside which “not proven” stands that is not shown",
     "; wo „nicht nachgewiesen“ steht, ist das nicht gezeigt"},
    {" The interval holds it too; of forms and zones, which noise makes larger, it "
     "reaches farther down than up, and 95\u202f% is the least.",
     " Das Intervall enthält ihn ebenfalls; bei Formabweichungen und Zonen, die das "
     "Rauschen vergrößert, reicht es weiter nach unten als nach oben, und 95\u202f% sind "
     "das Mindeste."},
    {" One without the value is corrected for a known bias of the measurement; the value "
     "is not.",
     " Ein Intervall ohne den Messwert ist um eine bekannte systematische Messabweichung "
     "korrigiert, der Messwert nicht."},
    {"Used: share of the tolerance taken by the value, or by its distance from the "
     "nominal where there is one.",
     "Ausgenutzt: Anteil der Toleranz, den der Messwert einnimmt; wo es einen Nennwert "
     "gibt, der Anteil der Grenzabweichung (±), den die Abweichung vom Nennwert einnimmt."},
    {" Geometric: what the way of milling leaves where the machine makes no error; the "
     "value holds it.",
     " Geometrisch: was die Art des Fräsens auch auf einer abweichungsfreien Maschine "
     "stehen lässt; der Messwert enthält es."},
    {"<p class=\"caution\"><b>U is not known: no accuracy of the CMM is stated.</b> "
     "Nothing is said of how far the values are from the truth. State it by "
     "<code>--e0</code> and <code>--l-per-um</code>, or by <code>--cmm</code>.</p>\n",
     "<p class=\"caution\"><b>U ist unbekannt: für das Koordinatenmessgerät ist keine "
     "Genauigkeit angegeben.</b> Wie weit die Messwerte von den wahren Werten entfernt "
     "sind, ist damit nicht gesagt. Anzugeben mit <code>--e0</code> und "
     "<code>--l-per-um</code> oder mit <code>--cmm</code>.</p>\n"},
    {"<p class=\"caution\"><b>U = 0: no error of the CMM is stated.</b> The values are "
     "those of an ideal machine; no real CMM measures so. State one by <code>e0</code> "
     "and <code>l_per_um</code>.</p>\n",
     "<p class=\"caution\"><b>U = 0: für das Koordinatenmessgerät ist keine Abweichung "
     "angegeben.</b> Die Messwerte sind die eines idealen Geräts; so misst kein "
     "wirkliches. Anzugeben mit <code>e0</code> und <code>l_per_um</code>.</p>\n"},
    {"U is not known: no accuracy of the CMM is stated (--e0, --l-per-um)",
     "U ist unbekannt: für das Koordinatenmessgerät ist keine Genauigkeit angegeben "
     "(--e0, --l-per-um)"},
    {"U = 0: no error of the CMM is stated (e0 and l_per_um)",
     "U = 0: für das Koordinatenmessgerät ist keine Abweichung angegeben (e0 und l_per_um)"},
    {"Form", "Formabweichung"},
    {"Deviation from the least-squares element over the angle about its axis, outward "
     "where material is left. Grey circles, dashed: the highest and the lowest point (no "
     "limits); drawn through: zero.",
     "Abweichung vom Ausgleichselement nach Gauß (kleinste Quadrate) über dem Winkel um "
     "dessen Achse, nach außen, wo Werkstoff stehen geblieben ist. Graue Kreise, "
     "gestrichelt: höchster und tiefster Punkt (keine Grenzen); durchgezogen: null."},
    {"highest less lowest point {0} {2}, {1} {2} per division",
     "höchster minus tiefster Punkt {0} {2}, {1} {2} je Teilung"},
    {"Polar chart of {0}: {1}", "Polardiagramm von {0}: {1}"},
    {"section {0}", "Schnitt {0}"},
    {"deviation, {0}", "Abweichung, {0}"},
    {"Profiles", "Profile"},
    {"Where two lines are compared: how far their points are from the planned lines, in "
     "the direction measured, over the place along the lines from the planned point of "
     "the first. Dashed: least-squares straight lines. A distance is that of the dashed "
     "lines at position 0, second less first.",
     "Wo zwei Linien verglichen werden: Abstand ihrer Punkte von den Solllinien in "
     "Messrichtung, über der Lage entlang der Linien ab dem Sollpunkt der ersten. "
     "Gestrichelt: Ausgleichsgeraden (kleinste Quadrate). Ein Abstand ist der der "
     "gestrichelten Geraden an der Stelle 0, zweite minus erste."},
    {"position along, {0}", "Lage entlang, {0}"},
    {"error across, {0}", "Abweichung quer, {0}"},
    {"Profiles of the two lines of {0}", "Profile der beiden Linien von {0}"},
    {"Workpiece", "Werkstück"},
    {"Finished workpiece coloured by its deviation from nominal",
     "Fertiges Werkstück, eingefärbt nach der Abweichung von der Nenngeometrie"},
    {"Finished workpiece coloured by its deviation, to be turned: arrow keys turn, plus "
     "and minus zoom",
     "Fertiges Werkstück, eingefärbt nach der Abweichung, drehbar: Pfeiltasten drehen, "
     "Plus und Minus zoomen"},
    {"Oblique", "Schräg"},
    {"Top", "Oben"},
    {"Front", "Vorn"},
    {"Side", "Seite"},
    {"Blue: material missing; red: material left; grey: no nominal surface.",
     "Blau: Werkstoff fehlt; rot: Werkstoff ist stehen geblieben; grau: ohne Nennfläche."},
    {"Drag or use the arrow keys to turn; + and − or the wheel with Ctrl to zoom; click "
     "the surface to read its deviation.",
     "Drehen durch Ziehen oder mit den Pfeiltasten; zoomen mit + und − oder mit Strg und "
     "dem Rad; ein Klick auf die Fläche zeigt ihre Abweichung."},
    {"no nominal", "ohne Nennfläche"},
    {"Injected errors", "Eingebrachte Maschinenabweichungen"},
    {"Errors injected", "Eingebrachte Maschinenabweichungen"},
    {"None: the machine is geometrically ideal.", "Keine: die Maschine ist geometrisch ideal."},
    {"none injected", "keine eingebracht"},
    {"Error", "Abweichung"},
    {"Meaning", "Bedeutung"},
    {"Axis positions", "Achspositionen"},
    {"Axis positions of {0}", "Achspositionen von {0}"},
    {"Operation", "Bearbeitung"},
    {"Axis", "Achse"},
    {"From", "Von"},
    {"To", "Bis"},
    {"Range", "Bereich"},
    {"rotary axes, degrees", "Drehachsen, Grad"},
    {"linear axes, {0}", "Linearachsen, {0}"},
    {"cone angle φ, degrees", "Kegelwinkel φ, Grad"},
    {"block", "Satz"},
    {"Features", "Geometrieelemente"},
    {"Feature", "Geometrieelement"},
    {"Element", "Art"},
    {"Points", "Punkte"},
    {"Radius", "Radius"},
    {"Half angle", "Halber Kegelwinkel"},
    {"RMS", "Quadratischer Mittelwert"},
    {"Slowed by axis limits: 1 block", "Durch Achsgrenzen gebremst: 1 Satz"},
    {"Slowed by axis limits: {0} blocks", "Durch Achsgrenzen gebremst: {0} Sätze"},
    {"1 block slowed by axis limits", "1 Satz durch Achsgrenzen gebremst"},
    {"{0} blocks slowed by axis limits", "{0} Sätze durch Achsgrenzen gebremst"},
    {"Slowed blocks", "Gebremste Sätze"},
    {"Line", "Zeile"},
    {"Programmed feed, {0}", "Programmierter Vorschub, {0}"},
    {"Reached feed, {0}", "Erreichter Vorschub, {0}"},
    {"line {0}: axis {1}, {2} instead of {3} {4}", "Zeile {0}: Achse {1}, {2} statt {3} {4}"},
    {"Collisions", "Kollisionen (Meldungen auf Englisch)"},
    {"Collisions ({0})", "Kollisionen ({0}, Meldungen auf Englisch)"},
    {"Collision", "Kollision"},
    {"line {0}: ", "Zeile {0}: "},
    {"and {0} more", "und {0} weitere"},
    {"Machine collisions were not looked for: neither the machine file nor the job states "
     "bodies.",
     "Maschinenkollisionen wurden nicht gesucht: weder Maschinendatei noch Auftrag geben "
     "Körper an."},
    {"1 body of machine and fixtures, with tools and blank",
     "1 Körper von Maschine und Spannmitteln, dazu Werkzeuge und Rohteil"},
    {"{0} bodies of machine and fixtures, with tools and blank",
     "{0} Körper von Maschine und Spannmitteln, dazu Werkzeuge und Rohteil"},
    {"{0}: none moves against another.", "{0}: keiner bewegt sich gegen einen anderen."},
    {", line {0}", ", Zeile {0}"},
    {" in {0}", " in {0}"},
    {"{0}: {1} and {2} meet{3}.", "{0}: {1} und {2} treffen sich{3}."},
    {"{0}: smallest distance {1}, {2} to {3}{4}.", "{0}: kleinster Abstand {1}, {2} zu {3}{4}."},
    {"Remarks", "Hinweise (Meldungen auf Englisch)"},
    {"Process", "Ablauf"},
    {"Volumes", "Volumen"},
    {"Volume", "Volumen"},
    {"Blank", "Rohteil"},
    {"Finished", "Fertigteil"},
    {"Numbers budget", "Rechengenauigkeit"},
    {"Approximation", "Näherung"},
    {"Bound", "Schranke"},
    {"Worst seen", "Größter Wert"},
    {"worst bound {0}, {1} of {2} sampled points proven",
     "größte Schranke {0}, {1} von {2} geprüften Punkten bewiesen"},
    {"Timings", "Rechenzeiten"},
    {"Step", "Schritt"},
    {"Time", "Zeit"},
    {"Together", "Zusammen"},
    {"together {0} s", "zusammen {0} s"},
    {"Written", "Datei"},
    {"Made by Frustum", "Erstellt mit Frustum"},
    {". Workpiece view: three.js (MIT licence). The notices of all bundled packages are "
     "in the source of this page.",
     ". Werkstückansicht: three.js (MIT-Lizenz). Die Hinweise aller enthaltenen Pakete "
     "stehen im Quelltext dieser Seite."},
};

}  // namespace frustum::report
