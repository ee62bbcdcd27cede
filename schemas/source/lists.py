"""What the program writes as JSON without a form of its own in `schema`: lists, lines, files that it reads again."""

from vocabulary import Schema, choice, constant, count, flag, list_of, map_of, number, table, tables, text, texts, vector

MACHINES = Schema("machines", "1.1", "List of machines", list_of(table("", {
    "name!": text("By which commands call it"), "structure!": text("Structure code"), "title!": text("In words"),
    "file!": text("Its file"), "version!": text("Of the program that lists it")}), "frustum machines --json"))

MOTION_NAMES = Schema("motion-names", "1.0", "Names of motion tests", map_of(table("", {
    "machines!": text("Of which structure"), "test!": text("Command"), "shows!": text("What it shows"),
    "attributed_by!": text("Who says so")}), "frustum motion names --json, by the names of ISO 10791-6"))

_TARGET = map_of(number(""), "mm and deg; axes that move", "^[XYZABC]$")
_MOTION_KEYS = {
    "line!": count("Of the program"), "file": text("Subprogram that it is in"),
    "end": _TARGET, "tool_axis": vector("Unit vector from the tip to the spindle"),
    "coordinates": constant("machine", "The end is in machine coordinates"),
    "feed": number("mm/min, deg/min; by feed_mode"), "feed_mode": choice(["per_minute", "inverse_time", "per_revolution"]),
    "synchronised": constant(True, "With the spindle"), "center": vector("Of an arc, mm"),
    "plane": choice(["XY", "ZX", "YZ"]), "turns": {"type": "integer"}, "axes": texts("Letters"), "point": count(""),
    "away": flag("Probe: moves off"), "must_meet": flag("Probe: an error without contact"), "seconds": number("Of a dwell"),
    "tool": count("Number"), "mode": text("Of length compensation"), "tool_vectors": flag(""), "offset": count("Number"),
    "length": number("mm"), "negative": constant(True), "number": count("Of a work offset"),
    "origin": {"type": ["object", "array"], "description": "Of a work offset by axis, or of a tilted plane"},
    "path": text("Of orientations, or of rotary axes"), "x": vector("Of a tilted plane"), "z": vector("Of a tilted plane"),
    "direction": choice(["off", "clockwise", "counterclockwise"]), "speed": number("1/min"), "flood": flag("Coolant"),
    "kind": text("Of a stop"), "name": text("Of an event"), "text": text("Of an event"),
    "grade": choice(["builder", "assumed"], "Of an event"),
    "column": count("Of an error"), "id": text("Of an error"), "message": text("Of an error"), "hint": text("Of an error"),
}
TYPES = ["traverse", "home", "feed", "arc", "probe", "dwell", "tool_change", "compensation", "work_offset",
         "work_offset_setting", "orientation_path", "rotary_path", "tilted_plane", "align_to_plane", "spindle", "coolant",
         "stop", "event", "error"]
CANON = Schema("canonical-motion", "1.0", "Canonical motion", table(
    "A line of frustum parse --canon; the last has the type error where the program cannot be run on",
    {"type!": choice(TYPES, "What it is"), **_MOTION_KEYS}))

BASELINE = Schema("baseline", "1.0", "Baseline of checks", table("Known findings, written and read by frustum check", {
    "frustum_baseline!": constant(1),
    "findings!": tables("", {
        "file!": text("From the folder of the baseline"), "id!": text("Of the check"),
        "fingerprint!": text("Of the block"), "count": count("Lines", 1), "line": count("When it was written"),
        "message": text("When it was written")})}))

ANSWERS = Schema("benchmark-answers", "1.0", "Answers of the benchmark", table("answers/mNN.json", {
    "key!": text("By which the machine was made"), "errors!": map_of(number(""), "By name; um, urad"),
    "points!": map_of(number(""), "By question, um"), "poses!": map_of(number(""), "By question, um")}))

COMMITMENTS = Schema("benchmark-commitments", "1.0", "Commitments of the benchmark", map_of(
    text("", pattern="^[0-9a-f]{64}$"), "commitments.json: by machine, the digest of its answers and key"))

LISTS = [MACHINES, MOTION_NAMES, CANON, BASELINE, ANSWERS, COMMITMENTS]
