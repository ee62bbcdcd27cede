"""Motion tests: ball bar, R-test, laser, touch-trigger probe."""

from errors import DEFS, errors_table
from vocabulary import (Schema, angle, any_of, by, choice, count, flag, length, number, numbers, positive, table, text,
                        vector)

_COMMON = ("machine! tool_length at setup program servo_lag dialect ball_known instrument errors")
_RUN = " feed dynamics jerk"
KINDS = {
    "circle": "plane! center! length angles feed dynamics",
    "rotary": "axis! direction! ball! hold length angles" + _RUN,
    "cone": "cone_angle! inclination! radius! center! sense angles" + _RUN,
    "chase": "ball! " + _RUN,
    "line": "axis! targets! runs" + _RUN,
    "diagonal": "box! points" + _RUN,
    "touch": "repeat pretravel lobe lobe_phase",
}

MOTION_TEST = Schema(
    "motion-test", "1.0", "Motion test",
    table("A test of a machine's motion, as frustum motion run reads it", {
        "test!": choice(KINDS, "Which test"),
        "machine!": text("Machine file, or the name of a shipped machine"),
        "tool_length": length("From the gauge point to the ball", "non_negative"),
        "at": text("Where the other axes are: \"A=-90\", mm and deg; of a chase, poses separated by ;"),
        "plane": choice(["XY", "YZ", "ZX"], "Of a circle"),
        "center": vector("Of the circle, frame of the table, mm"),
        "length": length("Of the bar; default 150", "positive"),
        "angles": numbers("Where it is read, deg; default: 3600 midpoints"),
        "axis": choice("XYZABC", "Of a rotary or line test"),
        "direction": choice(["axial", "radial", "tangential"], "Of the bar"),
        "hold": choice(["rotor", "bed"], "Where the bar's direction is held"),
        "ball": vector("Table ball, frame of the table, mm"),
        "cone_angle": angle("Half apex angle"),
        "inclination": angle("Tilt of the cone's axis"),
        "radius": length("Of the tool-tip circle", "positive"),
        "sense": choice(["normal", "radial"], "Of the bar of a cone"),
        "targets": numbers("Of a line, mm"),
        "runs": count("Up and down, so many times", 2, maximum=1000, default=5),
        "box": text("Of diagonals: \"X=-200:200,Y=-200:200,Z=100:400\", mm"),
        "points": count("Along each diagonal", 2, maximum=100000, default=11),
        "repeat": count("Calibrations, for their scatter", 1, default=1),
        "pretravel": text("Of the probe, with its unit"),
        "lobe": text("Amplitude of a three-lobed pre-travel, with its unit"),
        "lobe_phase": number("Of the lobes, deg", default=0),
        "feed": positive("mm/min; deg/min where a rotary axis leads"),
        "dynamics": choice(["off", "quasi_static", "linear"], "What masses and springs do", default="off"),
        "jerk": flag("From rest to rest within the jerk limits", default=False),
        "setup": table("Errors of the set-up, um", {
            "ball_um": vector("Spindle ball off the spindle axis"),
            "table_ball_um": vector("Table ball off its nominal place"),
            "length_um": number("Bar longer than stated"),
        }),
        "program": text("NC program that is run instead of the test's own path"),
        "servo_lag": flag("Of that program: axes lag by their velocity gains", default=False),
        "dialect": choice(["fanuc", "linuxcnc", "sinumerik", "heidenhain"], "Of that program"),
        "ball_known": flag("The table ball's place is known, not found from the readings", default=False),
        "instrument": table("The instrument", {
            "noise": text("Standard deviation of a reading, with its unit (of a touch: two)"),
            "resolution": text("Of a reading, with its unit"),
            "seed": count("Of the noise", default=1),
            "stroke": length("Of the bar to either side; default 1", "positive"),
        }),
        "errors": errors_table("Errors of the machine"),
    }, **by("test", {kind: f"{keys} {_COMMON}" for kind, keys in KINDS.items()}),
        dependentRequired={"servo_lag": ["program"], "dialect": ["program"]}),
    readers=["app/motion/test_file.cpp", "kinematics/errors/error_table.cpp"], defs=DEFS)
