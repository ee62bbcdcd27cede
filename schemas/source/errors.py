"""Machine errors: the [errors] tables of jobs, studies and motion tests, and error files."""

from vocabulary import (Schema, any_of, choice, count, flag, list_of, loosely, map_of, numbers, ref, table, text, texts, matrix,
                        number, integer)

_AMOUNT = {"type": ["string", "number"]}


def amount(about):
    return {"description": about + ": an amount with its unit, or a distribution", **_AMOUNT}


def position(about):
    return {"description": about + ": a position with its unit, mm or deg", **_AMOUNT}


FACTOR = table("Times a factor of another axis", {
    "axis!": choice("XYZABC", "The axis whose position the factor depends on"),
    "table!": numbers("Its positions, rising; mm, deg of a rotary axis"),
    "values!": numbers("The factor at each; straight between them, held beyond"),
})

SHAPE = loosely(table("One term of an error as a function of its axis's position", {
    "value": amount("Constant"),
    "linear": amount("Rises by this over the span"),
    "zero": position("Where a linear error is zero"),
    "polynomial": texts("Coefficients of 1, t, t^2, ..., t from -1 to +1 over the span, each with its unit"),
    "harmonic": count("Order of a harmonic over the span", 1),
    "amplitude": amount("Of a harmonic"),
    "phase": {"description": "Of a harmonic or cyclic error: text with its unit, or degrees", **_AMOUNT},
    "cyclic": amount("Amplitude of an error that repeats with `period`"),
    "period": position("Of a cyclic error"),
    "reversal": amount("Full jump at a reversal: hysteresis or backlash"),
    "settle": position("Travel over which a reversal is taken up"),
    "tent": amount("Straight from 0 at the ends of the span to this at `at`"),
    "at": position("Where a tent has its peak"),
    "span": texts("From and to, with units; default: what the operation of error_span travels, or the travel",
                  minItems=2, maxItems=2),
    "table": numbers("Positions, rising, in position_unit"),
    "values": any_of("Values at the positions of `table`, or a row for each of `first`; in value_unit",
                     numbers(), matrix()),
    "position_unit": choice(["mm", "deg"], "Of `table`"),
    "value_unit": choice(["um", "urad"], "Of `values`"),
    "interpolation": choice(["linear", "cubic"], "Between the points of a table", default="linear"),
    "periodic": flag("The table repeats; its last value is its first", default=False),
    "surface": texts("Two axes whose positions an error depends on", minItems=2, maxItems=2),
    "first": numbers("Positions of the first axis of a surface; mm, deg of a rotary axis"),
    "second": numbers("Positions of its second axis"),
    "csv": text("CSV file with a column of this error"),
    "times": ref("errorFactor"),
}, minProperties=1))

ENTRY = any_of("Text as on the command line (\"linear 10um\"), a table, or several terms", {"type": "string"},
               ref("errorShape"), list_of(ref("errorShape"), minItems=1))

DEFS = {"errorFactor": FACTOR, "errorShape": SHAPE, "errorEntry": ENTRY}

_OPTIONS = {
    "drawn": map_of({"type": "string"}, "Quantities drawn once, by which several errors are written"),
    "file": text("Error file, or the name of a shipped one; what is written beside it overrides it"),
    "csv": texts("CSV files with columns of errors"),
    "etalon": text("Calibration file of a laser tracer (Etalon)"),
    "grid": text("CSV file of errors over the working volume"),
    "datum": texts("Primary and secondary reference axis", minItems=2, maxItems=2),
}


def errors_table(about, names=None):
    options = {k: v for k, v in _OPTIONS.items() if names is None or k in names}
    return table(about, options, closed=False, additionalProperties=ref("errorEntry"))


ERRORS = Schema(
    "errors", "1.0", "Error file",
    table("Geometric errors of one machine, for --errors and for `file` of [errors]", {
        "title!": text("What the errors are of"),
        "source": text("Where the numbers come from"),
        "machine!": text("Name of the machine that they belong to"),
        "structure": text("Its structure code; a machine without these axes on these sides is refused"),
        "errors!": errors_table("By ISO 230-1 names, or symbols that the machine declares",
                                ["drawn", "csv", "etalon", "grid", "datum"]),
    }),
    files="machines/errors/*.toml", readers=["kinematics/errors/error_table.cpp"], defs=DEFS)
