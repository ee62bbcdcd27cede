"""Documents of the main commands: run, measure, cut, check, parse, program, pose, post, diff, compensate, fit, cmm."""

from vocabulary import (DIALECTS, Schema, any_of, choice, complex_number, constant, count, flag, integer, list_of,
                        map_of, matrix, number, numbers, or_null, share, table, tables, text, texts, vector, with_keys)


def document(name, title, about, keys, version="1.0", **more):
    """A document of the program: its form in `schema`, the program's version, then its own keys."""
    head = {
        "schema!": constant(f"frustum/{name}/1", "Form of the document"),
        "version!": text("Of the program that wrote it"),
    }
    defs = more.pop("defs", None)
    return Schema(name, version, title, table(about, {**head, **keys}, **more), defs=defs)


SEVERITY = choice(["error", "warning", "note"], "How grave it is")
DIAGNOSTIC = table("", {
    "severity!": SEVERITY,
    "id!": text("Kind of fault, which never changes"),
    "message!": text("What is wrong"),
    "file": text("Where"),
    "line": count("Where; the first is 1"),
    "column": count("Where; the first is 1"),
    "key": text("Path of the key in a TOML file"),
    "hint": text("What to do"),
})
DIAGNOSTICS = list_of(DIAGNOSTIC, "What was found")
NUMBER = or_null(number(""))
PLACE = numbers("mm", 3)


def known(about):
    return or_null(number(about))


FAILURE = document("failure", "No result", "What --json prints where a command has no result", {
    "status!": constant("error"),
    "diagnostics!": DIAGNOSTICS,
})

_BODIES = table("Bodies of machine and fixtures", {
    "looked_for!": flag("There are bodies"),
    "bodies!": count("Their number"),
    "smallest_distance_mm": number("Between two that may not meet"),
    "between": texts("These two", minItems=2, maxItems=2),
    "line": count("Of the program, where that is"),
    "file": text("The subprogram that it is in"),
    "text!": text("In words"),
})

_FEATURE = table("", {
    "name!": text("Of the plan"),
    "kind!": text("Of the plan"),
    "points!": count("Measured"),
    "parameters!": map_of(any_of("", NUMBER, list_of(NUMBER)), "Of the fitted element: mm; angles rad"),
    "form!": table("Deviations from the element", {"value_um!": known("Peak to valley"), "rms_um!": known("rms")}),
    "compensation_difference_um!": known("What two ways to take off the ball's radius differ by at most"),
    "deviations_um": list_of(NUMBER, "Of ruled features: of each point"),
    "geometric_um": list_of(NUMBER, "Of ruled features: what the tool leaves of it"),
})

_PROFILE = table("", {
    "feature!": text("Line"),
    "position_mm!": list_of(NUMBER, "Along it"),
    "deviation_um!": list_of(NUMBER, "Across it"),
    "fit_offset_um!": known("Of the fitted line"),
    "fit_slope_urad!": known("Of the fitted line"),
})

_CHARACTERISTIC = table("", {
    "name!": text("Of the plan"),
    "kind!": text("Of the plan"),
    "parameter": text("Of a form, where the plan states one: RONp"),
    "features!": texts("Of the plan"),
    "sections": list_of(count(""), "That were evaluated; the first is 0"),
    "frame": text("Of the plan"),
    "floating": constant(True, "The zone is not tied to the datum system"),
    "value!": known("In `unit`"),
    "geometric": known("Share of it that an error-free machine makes"),
    "unit!": choice(["um", "urad", "mm", "deg"], "Of value, tolerance and uncertainties"),
    "tolerance!": known("Of the plan"),
    "expanded_uncertainty!": known("U, k = 2"),
    "pass!": flag("Within tolerance, by the rule of decision"),
    "verdict!": choice(["pass", "fail", "uncertain"], "By the rule of decision"),
    "coverage": text("How often value +- U and the interval hold the true value"),
    "interval": list_of(NUMBER, "Coverage interval", minItems=2, maxItems=2),
    "interval_holds_value": flag("Whether the value is within"),
    "standard_uncertainty": known("u"),
    "draws": count("Of a Monte Carlo evaluation"),
    "stable": flag("Its digits are"),
    "nominal!": known("Of the plan"),
    "deviation!": known("From the nominal; without one the value"),
    "tolerance_used!": known("Share of the tolerance"),
    "profiles": list_of(_PROFILE, "Of compared lines"),
    "without_seam": table("The same without the seam", {
        "value!": NUMBER, "at_deg!": NUMBER, "within_deg!": NUMBER}),
    "harmonics": tables("Of a roundness", {
        "undulations!": count("Per revolution"), "amplitude_um!": NUMBER, "phase_deg!": NUMBER}),
})

RESULT = document("result", "Result of a run or measurement", "result.json, and frustum run --json, measure --json", {
    "title!": text("Of the job or plan"),
    "status!": choice(["pass", "fail", "uncertain"], "Of all characteristics"),
    "machine!": text("Its name"),
    "structure!": text("Its structure code"),
    "program!": text("NC program"),
    "evidence!": table("What the result rests on; what is not stated is null", {
        "version!": text("Of the program"),
        "part!": or_null(text("")), "part_number!": or_null(text("")), "serial_number!": or_null(text("")),
        "order!": or_null(text("")), "operator!": or_null(text("")), "date!": or_null(text("")),
        "cmm!": or_null(text("")),
        "measuring!": map_of({"type": "string"}, "How it was measured"),
        "error_draw!": or_null(table("Which draw of errors", {"seed!": count(""), "index!": count("")})),
        "files!": tables("Read, with their digests", {
            "role!": text("What it is"), "name!": text("File"), "sha256!": or_null(text(""))}),
    }),
    "features!": list_of(_FEATURE, "Of the plan, as measured"),
    "characteristics!": list_of(_CHARACTERISTIC, "Of the plan, as evaluated"),
    "datum_system": table("Where the measured part is in its workpiece frame", {
        "origin_mm!": list_of(NUMBER, ""), "axes!": list_of(list_of(NUMBER), "Three unit vectors"),
        "datums!": tables("What each datum fixes", {"feature!": text(""), "degrees!": texts("")}),
        "free_degrees!": texts("That no datum fixes"),
    }),
    "timing!": map_of(number(""), "s of computation, by task"),
    "cycle_time_s": known("Of the program, within the limits of the axes"),
    "limited_blocks": tables("Whose feed an axis limits", {
        "line!": count(""), "axis!": text(""), "programmed_feed!": NUMBER, "reached_feed!": NUMBER}),
    "diagnostics!": DIAGNOSTICS,
    "errors!": tables("Injected", {"name!": text(""), "value!": text("As written"), "meaning!": text("")}),
    "tools!": tables("Of the job", {"number!": count(""), "description!": text("")}),
    "volumes!": table("mm^3", {"blank_mm3!": NUMBER, "finished_mm3!": NUMBER, "removed_mm3!": NUMBER}),
    "collisions!": tables("Found", {"line!": count(""), "message!": text("")}),
    "machine_collisions": _BODIES,
    "axis_ranges!": tables("Travelled by each operation", {
        "operation!": text(""),
        "axes!": map_of(table("", {"min!": NUMBER, "max!": NUMBER, "range!": NUMBER,
                                   "unit!": choice(["mm", "deg"])}), "By letter", "^[XYZABC]$"),
    }),
    "budget!": tables("Approximations with their bounds", {
        "name!": text(""), "bound!": NUMBER, "worst!": NUMBER, "unit!": text("")}),
    "point_bounds": table("How exact the probed points are", {
        "points!": count(""), "worst_bound_um!": NUMBER, "sampled!": count("Proven by interval arithmetic, tried"),
        "proven!": count(""), "regular!": count(""), "refuted!": count("")}),
    "notes!": texts("Further remarks"),
})

_LINE = {"line!": count("Of the program"), "program_file": text("Subprogram that it is in")}
_STATE = {**_LINE, "block!": or_null(count("Path segment")), "time_s!": number("Into the program")}
_WORST = or_null(table("", {"deviation_um!": number(""), "point!": PLACE, "line": count(""),
                            "program_file": text("Subprogram that it is in"), "block!": or_null(count(""))}))
_SNAPSHOTS = list_of(table("", {"file!": text("Mesh"), **_STATE, "volume_mm3!": number("")}), "Meshes along the way")

CUT = document("cut", "Cut part", "frustum cut --json", {
    "engine": choice(["ray", "polyhedral"], "What made the mesh"),
    "facet_bound_um": number("Of the polyhedral engine"),
    "worst_chord_um": number("Of --chord: the largest distance found while refining, before folds are mended and --decimate"),
    "unresolved_edges": count("Of --chord: edges beside which the surface was not found while refining"),
    "unresolved_vertices": count("Of --chord: vertices left off the surface, before --decimate"),
    "vertices": count("Of the mesh"), "triangles": count("Of the mesh"),
    "closed": flag("The mesh is"), "manifold": flag("The mesh is"),
    "volume_mm3": number("Of the finished part"), "blank_volume_mm3": number(""), "removed_volume_mm3": number(""),
    "vertices_with_nominal": count("Compared with a nominal"),
    "deviation_um": numbers("Lowest and highest", 2),
    "gouge": _WORST, "excess": _WORST,
    "until!": table("How far the program was cut", _STATE),
    "finished!": flag("To its end"),
    "collisions!": count("Number"),
    "collision_list!": tables("Each", {
        **_LINE, "text!": text("In words"), "kind!": text("Id"), "body!": text("Which body"), "tool!": count("Number"),
        "depth_mm!": known(""), "point!": PLACE, "last_line!": count(""), "other_body": text("")}),
    "machine_collisions!": _BODIES,
    "made_by": table("Which block made a point", {
        "point!": PLACE, "on_surface!": flag(""), "line": count(""), "program_file": text("Subprogram that it is in"),
        "block": or_null(count("")), "normal": PLACE}),
    "snapshots": _SNAPSHOTS,
    "removal": table("Removed volume block by block", {"file!": text("CSV"), "blocks!": count(""),
                                                       "volume_mm3!": number("")}),
    "passes!": flag("Nothing collides, and limits are kept"),
}, "1.1")

SNAPSHOTS = document("snapshots", "Index of snapshots", "Beside the meshes of frustum cut --snapshots", {
    "snapshots!": _SNAPSHOTS}, "1.1")

PROGRAM = document("program", "Written test piece", "frustum program --json", {"files!": texts("Written")})

_AXES = map_of(number(""), "mm and deg, by letter", "^[XYZABC]$")
_TOOL = table("", {"tip!": vector("mm, frame of the table"), "axis!": vector("Unit vector from the tip to the spindle")})
POSE = document("pose", "Pose", "frustum pose --json; with --inverse the solutions alone", {
    "axes": _AXES, "nominal": _TOOL, "actual": _TOOL,
    "error_um": vector("Tip, actual less nominal"), "error_urad": vector("Turn of the tool, frame of the table"),
    "within_travel": flag("All axes are"), "beyond_travel": texts("What is not"),
    "solutions": tables("Of --inverse", {"axes!": _AXES, "within_travel!": flag(""), "singular!": flag("")}),
}, oneOf=[{"required": ["solutions"]}, {"required": ["axes", "nominal", "actual", "error_um", "error_urad",
                                                     "within_travel", "beyond_travel"]}])

PARSE = document("parse", "Parsed program", "frustum parse --json", {
    "program!": text("File"),
    "dialect!": choice(DIALECTS, ""),
    "recognised_by!": or_null(text("Reason; null where --dialect says it")),
    "blocks!": count("Run"),
    "motions!": map_of(count(""), "Number of each type"),
    "diagnostics!": DIAGNOSTICS,
})

_COUNTS = table("Findings by severity", {"error!": count(""), "warning!": count(""), "note!": count(""),
                                         "suppressed": count("")})
_FINDING = table("", {
    "id!": text("Of the check"), "severity!": SEVERITY, "file!": text("Where"), "line!": count("Where"),
    "column!": count("Where; 0: the line"), "message!": text("What"), "hint!": text("What to do"),
    "count!": count("How often"), "places!": count("In so many lines"),
    "diagnostic!": or_null(text("Id of the fault of the program")),
    "suppressed": choice(["comment", "baseline"], "By what"), "reason": text("Of the comment"),
})
_CHECKED = {
    "file!": text("Program"), "dialect!": text(""), "machine!": or_null(text("")),
    "status!": choice(["pass", "fail"]), "blocks!": count("Run"), "motions!": count(""), "counts!": _COUNTS,
    "findings!": list_of(_FINDING, ""), "suppressed!": list_of(_FINDING, ""),
    "left_out!": map_of(count(""), "Findings of a check beyond those listed"),
    "subprogram": constant(True, "Another program calls it"),
}
_TROUBLES = {"troubles": tables("What could not be checked", {
    "diagnostic!": text("Id"), "severity!": SEVERITY, "file!": or_null(text("")), "line!": count(""),
    "column!": count(""), "message!": text(""), "hint!": text("")})}
CHECK = document("check", "Checked program", "frustum check --json of one program", {**_CHECKED, **_TROUBLES})
CHECK_FILES = document("check-files", "Checked programs", "frustum check --json of several programs or folders", {
    "status!": choice(["pass", "fail"]), "counts!": _COUNTS,
    "files!": list_of(table("", _CHECKED), "Each program"), **_TROUBLES})

DIFF = document("diff", "Compared programs", "frustum diff --json", {
    "same!": flag("Within the tolerances"),
    "largest_tip_um!": number(""), "largest_axis_urad!": number(""), "largest_time_ratio!": number(""),
    "first_difference": table("Where they differ first", {
        "kind!": text(""), "first_line!": count(""), "second_line!": count(""), "first_file!": text(""),
        "second_file!": text(""), "tip_um!": number(""), "axis_urad!": number(""), "time_ratio!": number(""),
        "likely_cause!": text("Empty: none is known")}),
})

POST = document("post", "Post-processed program", "frustum post --json", {
    "output!": text("File"), "dialect!": choice(DIALECTS, ""), "machine!": text(""), "lines!": count("Written"),
    "inserted_points!": count("Between those of the program"), "rewinds!": count("Of rotary axes"),
    "diagnostics!": texts("In words"), "diagnostic_ids!": texts("Their ids")})

_PATH_ERROR = table("", {"tip_um!": number(""), "axis_urad!": number("")})
COMPENSATE = document("compensate", "Compensated program", "frustum compensate --json", {
    "files!": texts("Written"), "before!": _PATH_ERROR, "after!": _PATH_ERROR,
    "at_turns!": {**_PATH_ERROR, "description": "Where an axis takes up its reversal"},
    "reached!": flag("What is left is small enough")})

FIT = document("fit", "Fitted element", "frustum fit --json; mm and rad", {
    "element!": text(""), "criterion!": choice(["ls", "mz", "mi", "mc", "om"]),
    "parameters!": table("Of the element, as far as it has them", {
        "point": numbers("mm"), "axis": numbers("Unit vector"), "radius": number("mm"), "tube_radius": number("mm"),
        "half_angle": number("rad")}),
    "form!": number("Peak to valley of the residuals, mm"), "rms!": number("mm"),
    "residuals!": numbers("One a point, mm; outside is positive"),
    "covariance!": matrix("Of the parameters; [] where the criterion has none"),
    "iterations!": count("Of the solver"), "condition": known("Of the parameters"),
    "certificate": table("Of all criteria but ls", {
        "contacts!": tables("", {"point!": count(""), "multiplier!": number(""), "side!": choice(["high", "low"])}),
        "imbalance!": number(""), "gap!": number("By which an element near by could be better at most, mm")}),
})

CMM_TEST = document("cmm", "Acceptance test of a CMM", "frustum cmm --json", {
    "passes!": flag(""), "worst_length_share!": known("Of its limit; null where that is 0"),
    "probing_form_um!": number(""), "probing_size_um!": number(""), "probing_limit_um!": number(""),
    "lengths!": tables("105 of them", {"direction!": vector(""), "length_mm!": number(""), "repetition!": count(""),
                                       "error_um!": number(""), "limit_um!": number("")})})
CMM_SERIES = document("cmm-series", "Acceptance tests of many CMMs", "frustum cmm --seeds N --json", {
    "machines!": count(""), "passed!": count(""),
    "worst_length_share!": table("Of its limit", {"best!": NUMBER, "median!": NUMBER, "worst!": NUMBER}),
    "failed_on_sphere!": count(""), "failed_seeds!": list_of(count(""), "")})

COMPARE = document("compare", "Compared shapes", "frustum compare --json", {
    "points!": count("Vertices"), "nominal_facets!": count(""), "aligned!": text("How"),
    "lowest_um!": number(""), "highest_um!": number(""), "mean_um!": number(""), "rms_um!": number(""),
    "sd_um!": number(""),
    "quantiles!": tables("", {"p!": share(""), "value_um!": number("")}),
    "histogram!": tables("", {"from_um!": number(""), "to_um!": number(""), "count!": count("")}),
    "tolerance_um": number(""), "within_percent": number(""), "status": choice(["pass", "fail"]),
    "nominal_from_part!": table("", {"translation_mm!": vector(""), "rotation!": matrix("")}),
    "files!": texts("Written")})

ERROR_NAMES = document("errors", "Errors of a machine", "frustum errors --json", {
    "machine!": text(""), "structure!": text(""),
    "axes!": tables("From the bed outwards", {
        "axis!": text(""), "side!": choice(["tool", "workpiece"]), "unit!": choice(["mm", "deg"]),
        "errors!": text("Where they act"), "travel!": or_null(numbers("null: endless", 2))}),
    "errors!": tables("Names that it accepts", {
        "name!": text(""), "unit!": choice(["um", "urad"]), "meaning!": text(""), "alias_of": text("")}),
    "zero_by_choice!": tables("", {"name!": text(""), "reason!": text("")})})

SERVE = document("serve", "Served folder", "frustum serve --json", {"url!": text("")})

TOOLS = document("tools", "Tools of a job", "frustum tools --json", {"tools!": tables("", {
    "number!": count(""), "name!": text(""), "type!": text(""), "description!": text("In words")})})

VIEW = document("view", "Played program", "frustum view --json, view.json", {
    "title!": text(""), "machine!": text(""), "program!": text("Its file"), "lines!": count("Of the program"),
    "blocks!": count("That move"), "cycle_time_s!": number(""), "errors!": map_of(text(""), "Injected"),
    "largest_deviation_um!": number("Of the tip"), "points!": count("Of the path on the page"),
    "points_left_out!": count("Nearer to the way between others than the chord"), "chord_um!": number(""),
    "steps!": tables("Of the workpiece", {
        "time_s!": number(""), "line!": count("Of the program"), "triangles!": count(""), "volume_mm3!": NUMBER}),
    "page_bytes!": count("")})

_CHANGES = tables("", {"from!": text("Date"), "to!": text("Date"), "days!": number(""), "change!": number("")})
HISTORY = document("history", "Results over their dates", "frustum history --json, history.json", {
    "title!": text(""), "machine!": text(""), "status!": choice(["pass", "fail"]),
    "baseline!": count("Results that the limits are of; 0: all"), "since!": or_null(text("Date")),
    "results!": tables("Files", {
        "file!": text(""), "document!": text("Its form"), "title!": text(""), "date!": text(""), "date_from!": text(""),
        "state!": or_null(choice(["as-found", "as-left"])), "state_from!": or_null(text("")),
        "without_value!": texts("What the file has no value of")}),
    "series!": tables("Values of one name", {
        "name!": text(""), "group!": text(""), "kind!": text(""), "unit!": text(""), "nominal!": NUMBER,
        "points!": tables("By date", {
            "date!": text(""), "state!": or_null(choice(["as-found", "as-left"])), "value!": NUMBER,
            "half_width_95!": known("Of its interval"), "moving_range!": NUMBER, "tolerance!": NUMBER,
            "judged!": flag("By the limits"), "beyond!": texts("Limits")}),
        "counted!": count("Values that limits and trend are of"),
        "limits!": or_null(table("Individuals and moving ranges", {
            "mean!": number(""), "mean_moving_range!": number(""), "lower!": number(""), "upper!": number(""),
            "upper_moving_range!": number(""), "values!": count(""), "provisional!": flag("Of fewer than 20")})),
        "trend!": or_null(table("Straight line", {
            "from!": text("Date"), "per_day!": number(""), "half_width_95_per_day!": NUMBER,
            "significant!": flag(""), "residual_sd!": NUMBER})),
        "adjustments!": _CHANGES, "drifts!": _CHANGES, "remark!": text("On the limits")}),
    "failures!": texts("What is beyond"), "diagnostics!": DIAGNOSTICS})

_COMMAND = {"$ref": "#/$defs/command"}
REFERENCE = document("reference", "Commands and options", "frustum reference --json", {"program!": _COMMAND}, defs={
    "command": table("", {
        "name!": text(""), "description!": text(""),
        "options!": tables("", {"names!": texts(""), "positional!": flag(""), "required!": flag(""),
                                "value!": text("What it takes"), "words!": texts(""), "help!": text("")}),
        "commands!": list_of(_COMMAND, "")})})

RESULTS = [FAILURE, RESULT, CUT, SNAPSHOTS, PROGRAM, POSE, PARSE, CHECK, CHECK_FILES, DIFF, POST, COMPENSATE, FIT,
           CMM_TEST, CMM_SERIES, COMPARE, ERROR_NAMES, SERVE, TOOLS, VIEW, HISTORY,
           REFERENCE]
