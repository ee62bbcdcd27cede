"""Studies of populations of machines, studies that identify the errors of one, and measured values."""

from cmm import CMM_TABLE
from errors import DEFS, errors_table
from vocabulary import (Schema, any_of, choice, count, flag, length, list_of, map_of, matrix, number, numbers, positive,
                        rows, share, stated_amount, stated_length, table, tables, text, texts, angle)

POPULATION = Schema(
    "study", "1.0", "Study of a population",
    table("What many machines make, drawn from the laws of their errors", {
        "title": text("Of the report"),
        "job": text("The job of the part"),
        "motion": text("Instead of a job: the file of a motion test"),
        "target": choice(["volumetric"], "Instead of a job: one pose of a machine"),
        "machine": text("Of target = \"volumetric\": machine file, or the name of a shipped machine"),
        "axes": text("The pose: \"Y=-225,Z=-480\", mm and deg"),
        "tool_length": length("At that pose", "non_negative"),
        "samples": count("How many machines", 1, maximum=2**32),
        "seed": count("Which lottery", default=1),
        "scheme": choice(["random", "latin", "sobol"], "How draws are spread", default="random"),
        "engine": choice(["auto", "linear", "full"], "linear: first order in the errors; full: every machine cuts and "
                         "is measured", default="auto"),
        "keep": list_of({"enum": ["characteristics", "amounts", "points"]}, "What of each draw is written"),
        "errors": errors_table("Laws of the errors; instead of those of the job"),
        "tolerances": table("Of amounts that are written as tolerances", {
            "read_as": choice(["uniform", "normal-2sd", "normal-3sd", "normal-3sd-cut", "triangular"],
                              "What a tolerance T means", default="uniform"),
            "scale": map_of(number(minimum=0), "Factors on the amounts of errors, by patterns such as E?X:harmonic"),
        }),
        "correlated": tables("Constants that are not independent", {
            "names!": texts("Of the errors", minItems=2),
            "correlation!": matrix("A row and a column for each name"),
        }),
        "limits": table("Limits instead of the plan's, by the names of characteristics", {
            "at_least": number("The exit code is 1 where a smaller share conforms", exclusiveMinimum=0, maximum=1),
        }, closed=False, additionalProperties={"type": "string"}),
        "measurement": table("How parts are measured", {
            "noise": flag("With the errors of the job's CMM", default=False),
            "u": text("Standard uncertainty for risks, with its unit"),
        }),
        "stop": table("When it is enough: half widths of 95 % intervals by \"NAME q95\"", {
            "samples_at_most": count("No more draws than these", 1),
        }, closed=False, additionalProperties={"type": "string"}),
        "risk": table("Risks of wrong decisions", {
            "rules": texts("simple, guard 1.0, consumer 0.005"),
        }),
        "shares": table("Which errors make it", {
            "characteristic": text("Of this one; default: all"),
            "groups": map_of(texts(), "Errors by patterns, under names of your own"),
        }),
        "allocate": table("Which tolerances would do", {
            "characteristic!": text("Of this one"),
            "probability": number("That must conform", exclusiveMinimum=0, exclusiveMaximum=1, default=0.95),
            "cost": map_of(positive(), "Of each group of [shares]"),
        }),
        "map": table("Which set-ups of a cone show the errors", {
            "cone_angle!": numbers("deg"),
            "inclination!": numbers("deg"),
            "center!": rows(3, "mm"),
        }),
    }, oneOf=[{"required": ["job"]}, {"required": ["motion"]}, {"required": ["target", "machine"]}],
        dependentRequired={key: ["target"] for key in ("machine", "axes", "tool_length")}),
    files="study.toml",
    readers=["app/study/study_file.cpp", "app/study/study_tables.cpp", "kinematics/errors/error_table.cpp"], defs=DEFS)

IDENTIFICATION = Schema(
    "identification", "1.0", "Study of measured parts and tests",
    table("For frustum identify: what was measured of one machine; for frustum design --study: what could be", {
        "title": text("Of the report"),
        "part": tables("Test pieces", {
            "name!": text("By which reports call it"),
            "job!": text("The job that cuts it"),
            "measured": texts("Files of measured values: .toml, .json results or .csv points; several are several "
                              "parts of one kind"),
            "rows": choice(["characteristics", "points", "floating-points"], "Of a design: what counts of it",
                           default="characteristics"),
            "hours": positive("Of a design: machine and CMM together"),
        }),
        "motion": tables("Motion tests", {
            "name": text("By which reports call it; default: that of the file"),
            "test!": text("File of the test"),
            "traces": texts("Files of measured readings"),
            "noise": text("Standard deviation of a reading, with its unit"),
            "angle": choice(["commanded", "feed"], "How recordings by time have their angles: over the capture, or "
                            "between feed-in and feed-out", default="commanded"),
            "overshoot": number("With feed: before and after the capture, deg; default 180 in XY, else 2", minimum=0,
                                maximum=360),
            "ball": text("exact: the ball in the spindle is on its axis; or a name: tests with the same share its offset"),
            "ball_uncertainty": text("What is known of that offset beforehand: a standard deviation with its unit"),
            "hours": positive("Of a design"),
        }),
        "unknown": table("What is to be found", {
            "errors": texts("Machine errors; default: the machine's symbols, else its location errors"),
            "tool_radius": choice(["common", "each", "exact"], "Radius error of the tools: one of all parts, one of "
                                  "each, none", default="common"),
        }),
        "known": map_of(any_of("", stated_amount(""), table("", {
            "value!": stated_amount("With its unit"),
            "uncertainty!": stated_amount("Standard uncertainty"),
        })), "Errors known from elsewhere: exactly, or with their standard uncertainties"),
        "uncertainty": table("Of what was measured", {
            "cmm": CMM_TABLE,
            "floor": table("Standard uncertainty that every value has at least", {
                "length": stated_length("Of lengths"),
                "angle": stated_amount("Of angles"),
            }),
        }),
        "times": table("What work takes, for designs", {
            "piece_setup_min": number("For each piece, min; default 30", minimum=0),
            "cmm_setup_min": number("For each piece, min; default 30", minimum=0),
            "touch_s": number("For each probed point, s; default 3", minimum=0),
            "test_setup_min": number("For each motion test, min; default 15", minimum=0),
        }),
        "method": table("How it is computed", {
            "refine": flag("Beyond first order in the errors", default=True),
            "recipe": choice(["none", "case-1", "case-2"], "Closed formulas beside it", default="none"),
        }),
        "compare": map_of(map_of(stated_amount(""), ""), "Estimates of others, by a name and their errors"),
    }, anyOf=[{"required": ["part"]}, {"required": ["motion"]}]),
    readers=["app/job/study.cpp", "app/motion/measured_motion.cpp", "metrology/probing/cmm_model.cpp"])

VALUES = Schema(
    "values", "1.0", "Measured values",
    table("Characteristics of a part as a CMM reported them", {
        "title": text("Of the part"),
        "source": text("Where the values come from"),
        "measured!": map_of(any_of("", {"type": "string"}, table("", {
            "value!": text("With its unit"),
            "uncertainty": text("Standard uncertainty, with its unit"),
        })), "By the names of the plan's characteristics", minProperties=1),
    }),
    readers=["app/job/measured_values.cpp"])

HISTORY = Schema(
    "history", "1.0", "Index of results over their dates",
    table("For frustum history: which files are read", {
        "title": text("Of the report"),
        "machine": text("Of results that name none"),
        "result!": tables("Results", {
            "date": text("Of the measurement, 2026-03-02; default: what the document or its name states"),
            "file!": text("Document of run, measure, identify or motion"),
            "state": choice(["as-found", "as-left"], "Of the machine, beside an adjustment"),
        }),
    }),
    files="history.toml",
    readers=["app/history/result_folder.cpp"])
