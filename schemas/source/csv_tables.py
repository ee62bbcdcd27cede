"""Tables as CSV: which columns they have, as metadata of CSV on the Web (W3C)."""

_UNITS = {"mm": "mm", "um": "µm", "deg": "deg", "urad": "µrad", "s": "s", "Hz": "Hz"}


def column(name, about, kind="number", unit="", needed=True, pattern=None):
    described = {"titles": name, "name": name.replace(" ", "_"), "datatype": kind, "required": needed,
                 "dc:description": about}
    if unit:
        described["schema:unitText"] = unit
    if pattern:
        described["urn:frustum:columnPattern"] = pattern
    return described


def text(name, about, needed=True, **more):
    return column(name, about, "string", needed=needed, **more)


def whole(name, about, needed=True, **more):
    return column(name, about, "integer", needed=needed, **more)


def several(names, about, unit="", needed=True):
    return [column(name, about, unit=unit, needed=needed) for name in names]


def repeated(name, pattern, about, kind="number", unit=""):
    """Any number of columns whose names match the pattern."""
    return column(name, about, kind, unit, needed=False, pattern=pattern)


class Table:
    def __init__(self, name, version, title, about, columns, files="", least=0):
        self.name, self.version, self.title, self.about = name, version, title, about
        self.columns, self.files, self.least = columns, files, least

    def document(self):
        return {
            "@context": ["http://www.w3.org/ns/csvw", {"@language": "en"}],
            "@id": f"urn:frustum:schema:tables:{self.name}:{self.version}",
            "url": self.files or f"{self.name}.csv",
            "dc:title": self.title,
            "dc:description": self.about,
            "schema:version": self.version,
            "dialect": {"commentPrefix": "#", "trim": True},
            "tableSchema": {"columns": self.columns},
        }


_XYZ = several("xyz", "Coordinate", "mm")
_AXES = repeated("AXIS", "[XYZABC]", "Commanded position of the axis, mm; deg of a rotary axis")
_AXES_DEG = repeated("AXIS_deg", "[ABC]_deg", "Position of the rotary axis", unit="deg")

POINTS = Table(
    "points", "1.1", "Measured points",
    "Points of a CMM, read by measure, fit and identify, and written by run and motion probe. Read with columns in any "
    "order, under German and other names too (docs/exchange.md), and without a header as x y z or x y z i j k", [
        text("feature", "Of the plan", False), whole("section", "Of the feature; the first is 0", False), *_XYZ,
        *several(["nominal_x", "nominal_y", "nominal_z"], "Nearest place on the planned surface", "mm", False),
        *several("ijk", "Planned normal there, out of the material", "", False),
        column("deviation", "Along it", unit="mm", needed=False),
        *several(["deviation_x", "deviation_y", "deviation_z"], "Not read: of the coordinate from its nominal", "mm", False),
        text("point", "Not read: number or name of the point", False),
        column("geometric", "What the tool leaves at a point of a ruled feature", unit="mm", needed=False),
        column("weight", "For fit only: of the square", needed=False)],
    "points.csv")

TABLES = [
    POINTS,
    Table("characteristics", "1.0", "Characteristics", "Written by --export FILE.csv of run and measure", [
        text("name", "Of the plan"), text("kind", "With the parameter of a form after it"), text("features", "Of the plan"),
        column("value", "In unit", needed=False), column("nominal", "In unit", needed=False),
        column("deviation", "In unit", needed=False), column("tolerance", "In unit", needed=False),
        column("expanded_uncertainty", "U, k = 2, in unit", needed=False), text("unit", "um, urad, mm or deg"),
        text("verdict", "pass, fail or uncertain"), column("interval_low", "Coverage interval", needed=False),
        column("interval_high", "Coverage interval", needed=False), text("coverage", "How often they hold", False)]),
    Table("sensitivity", "1.0", "Sensitivities", "sensitivity.csv: a row a characteristic, a column an error", [
        text("characteristic", "Of the plan"), text("unit", "Of the characteristic"),
        repeated("ERROR [per UNIT]", r".+ \[per (um|urad)\]", "Derivative")]),
    Table("removal", "1.0", "Removal by block", "Written by cut --removal", [
        whole("line", "Of the program"), whole("block", "Path segment"), text("kind", "rapid or feed"),
        whole("tool", "Number"), column("start_s", "Into the program", unit="s", needed=False),
        column("end_s", "Into the program", unit="s", needed=False),
        column("volume_mm3", "Removed", unit="mm^3"),
        column("rate_mm3_per_min", "Removed per minute", unit="mm^3/min"),
        column("axial_mm", "Axial engagement", unit="mm"), column("radial_mm", "Radial engagement", unit="mm", needed=False),
        column("largest_thickness_mm", "Of the chip", unit="mm"), column("mean_thickness_mm", "Of the chip", unit="mm"),
        column("first_contact_s", "Into the program", unit="s", needed=False),
        column("last_contact_s", "Into the program", unit="s", needed=False)]),
    Table("samples", "1.0", "Samples of a study", "Written by study --csv: a row a draw", [
        whole("draw", "Number of the draw"),
        repeated("DATASET", r"(characteristics|amounts|phases|peaks|coefficients)/.+",
                 "As in the HDF5 files: um, urad; phases deg")]),
    Table("circle-trace", "1.0", "Trace of a ball bar", "Read by motion trace --plane and as traces of a study, written "
          "by motion circle", [
              text("run", "ccw or cw", False), column("angle_deg", "Rises in a ccw run, falls in a cw run", unit="deg",
                                                      needed=False),
              column("time_s", "Instead of the angle", unit="s", needed=False),
              column("radial_um", "Radial deviation", unit="um", needed=False),
              column("reading_um", "The same", unit="um", needed=False),
              column("radial_mm", "Length of the bar", unit="mm", needed=False),
              column("length_mm", "The same", unit="mm", needed=False)], "trace.csv", least=2),
    Table("turn-trace", "1.0", "Readings of a bar over a turn", "Of rotary and cone tests", [
        column("angle_deg", "Of the test", unit="deg"), column("reading_um", "Of the bar", unit="um")], "trace.csv"),
    Table("line-trace", "1.0", "Positioning along an axis", "Read by motion trace --axis, written by motion line", [
        whole("run", "The first is 1"), text("direction", "up or down"), column("target_mm", "", unit="mm"),
        column("deviation_um", "", unit="um")], "trace.csv"),
    Table("diagonal-trace", "1.0", "Readings along diagonals", "Of diagonal tests", [
        text("diagonal", "+++, ++-, ..."), column("length_mm", "Along it", unit="mm"),
        column("reading_um", "", unit="um")], "trace.csv"),
    Table("pose-trace", "1.0", "Displacements of an R-test", "Of chase tests: a row a pose, in the order of the test", [
        _AXES_DEG, *several(["x_um", "y_um", "z_um"], "Frame of the table", "um")], "trace.csv"),
    Table("touches", "1.0", "Touches of a calibration", "Of touch tests; A, C, POINT, BALLX, BALLY, BALLZ as DPRNT "
          "writes them are read too", [
              *several(["A_deg", "C_deg"], "Positions", "deg"), whole("point", "Of the plan of touches"),
              *several(["x_mm", "y_mm", "z_mm"], "Touched point", "mm", False),
              *several(["ball_x_mm", "ball_y_mm", "ball_z_mm"], "Instead: centre of the ball", "mm", False)],
          "touches.csv"),
    Table("part-touches", "1.0", "Touches of a part on its machine", "Of motion probe", [
        _AXES_DEG, repeated("PLACE", r"[A-Za-z_]+", "What was touched, where", "string")], "touches.csv"),
    Table("vectors", "1.0", "Lines of rotary axes", "Written by motion vectors", [
        text("axis", "Letter"), text("side", "table or head"),
        *several(["x_mm", "y_mm", "z_mm"], "Point of the line, frame of the machine", "mm"),
        *several("ijk", "Its direction"), *several(["dx_um", "dy_um", "dz_um"], "Point, from nominal", "um"),
        *several(["di_urad", "dj_urad", "dk_urad"], "Direction, from nominal", "urad")]),
    Table("setup", "1.0", "Set-up sheet", "Of a bar whose program is written", [
        text("what", "In words"), text("value", "With its unit")]),
    Table("frf", "1.0", "Frequency responses", "Written by dynamics --frf --out; read by --measured", [
        column("frequency_hz", "", unit="Hz"),
        repeated("Gab_re, Gab_im", r"G[xyz][xyz]_(re|im)", "Motion along a by a force along b", unit="um/N")]),
    Table("map", "1.0", "Map over two axes", "Written by dynamics --map --out", [
        _AXES, repeated("QUANTITY", r"\S.*", "Value there")]),
    Table("axis-errors", "1.0", "Errors of an axis", "Read by csv of [errors]", [
        repeated("AXIS_mm, AXIS_deg", r"[XYZABC]_(mm|deg)", "First column: position of the axis, rising"),
        repeated("ERROR_um, ERROR_urad", r"E[XYZABC][XYZABC]_(um|mm|urad|rad|deg|arcsec)", "Error there")]),
    Table("error-grid", "1.0", "Errors over the volume", "Read by grid of [errors]", [
        *several(["x_mm", "y_mm", "z_mm"], "Positions of the linear axes", "mm"),
        *several(["dx_um", "dy_um", "dz_um"], "Displacement of the tool", "um"),
        *several(["da_urad", "db_urad", "dc_urad"], "Rotation of the tool", "urad", False)]),
    Table("control-points", "1.0", "Control points of an S-shaped piece", "Read by program s-piece --points", [
        text("curve", "C0, C1, and D0, D1"), *_XYZ]),
    Table("surface-net", "1.0", "Net of control points", "Read by program surface --net", [
        whole("row", "Of the net"), *_XYZ]),
    Table("cutter-profile", "1.0", "Measured cutter", "Read by file of a measured cutter", [
        column("Z_mm", "Height above the tip", unit="mm"), column("R_mm", "Radius there", unit="mm")]),
    Table("benchmark-questions", "1.0", "Questions of the benchmark: points", "Written by benchmark make", [
        text("id", "q001, ..."), text("piece", "Which"), *_XYZ, *several("ijk", "Normal, out of the material")],
        "questions.csv"),
    Table("benchmark-poses", "1.0", "Questions of the benchmark: poses", "Written by benchmark make", [
        text("id", "p001, ..."), whole("pose", "The first is 1"), _AXES], "poses.csv"),
    Table("benchmark-laws", "1.0", "Laws of the benchmark's errors", "Written by benchmark make", [
        text("name", "Of the unknown"), text("unit", "Of mean and sd"), column("mean", "Of its law"),
        column("sd", "Of its law")], "laws.csv"),
    Table("benchmark-prior", "1.0", "What the laws alone say", "Written by benchmark make", [
        text("id", "Of a question, or name of an unknown"), column("sd", "Of the laws")], "prior/mNN.csv"),
    Table("benchmark-predictions", "1.0", "Predictions of a submission", "Read by benchmark score", [
        text("id", "Of the question"), column("mean_um", "", unit="um"), column("sd_um", "", unit="um")],
        "predictions.csv"),
    Table("benchmark-errors", "1.0", "Errors of a submission", "Read by benchmark score", [
        text("name", "Of the unknown"), column("mean", "In unit"), column("sd", "In unit"), text("unit", "As in laws.csv")],
        "errors.csv"),
    Table("benchmark-rtest", "1.0", "R-test of the benchmark", "Written by benchmark make", [
        whole("pose", "The first is 1"), _AXES, *several(["dx_um", "dy_um", "dz_um"], "Of the tip, frame of the table",
                                                         "um")], "motion/rtest.csv"),
    Table("benchmark-ballbar", "1.0", "Circles of the benchmark", "Written by benchmark make", [
        whole("pose", "The first is 1"), _AXES, text("direction", "ccw or cw"),
        *several(["dx_um", "dy_um", "dz_um"], "Of the tip, frame of the table", "um")], "motion/ballbar.csv"),
]
