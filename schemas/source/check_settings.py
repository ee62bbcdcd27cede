"""Settings of frustum check: .frustum.toml."""

from machine import CONTROL_OF_PROGRAMS
from vocabulary import DIALECTS, Schema, choice, count, flag, table, text, texts

CHECK_SETTINGS = Schema(
    "check-settings", "1.0", "Settings of checks",
    table("For programs of a folder and those below it, as options of frustum check", {
        "machine": text("Machine file, or the name of a shipped machine"),
        "job": text("Takes machine, tool lengths and work offsets from a job"),
        "tool_length": texts("NUMBER=LENGTH, mm"),
        "tool_diameter": texts("NUMBER=DIAMETER, mm"),
        "offset": texts("G54=X,Y,Z, mm"),
        "start": text("X0,Y0,Z100: where the axes are before the program"),
        "controller": table("What the control assumes", CONTROL_OF_PROGRAMS),
        "dialect": choice(DIALECTS, "Of all programs; default: recognised from each"),
        "search": texts("Folders with subprograms"),
        "disable": texts("Checks that are left out, by id"),
        "fail_on": choice(["error", "warning", "note"], "Findings from which the exit code is 1", default="error"),
        "tools": text("LinuxCNC tool table"),
        "baseline": text("File of known findings"),
        "most_repeats": count("Blocks that loops and repeats run again before the check ends", 1),
        "inch_machine": flag("Tool table and parameters count in inches", default=False),
        "block_delete": flag("Blocks that begin with / are left out", default=False),
        "endings": texts("Of files that are programs, in a folder"),
        "exclude": texts("Patterns of files that are not checked"),
    }),
    files=".frustum.toml", readers=["app/job/check_settings.cpp"])
