"""Inspection plans."""

from cmm import DECISION, REPORT_HEAD, UNCERTAINTY
from vocabulary import (Schema, angle, any_of, by, choice, constant, count, flag, length, list_of, loosely, number, numbers,
                        positive, rows, table, tables, text, texts, vector)

FEATURES = ["plane", "cylinder", "cone", "circle", "line", "sphere", "point", "ruled"]
CHARACTERISTICS = [
    "roundness", "cylindricity", "cone_form", "equivalent_cone_form", "flatness", "straightness", "half_angle",
    "concentricity", "perpendicularity", "radius", "diameter", "line_distance", "line_angle", "axis_straightness",
    "parallelism", "angularity", "position", "coaxiality", "symmetry", "circular_run_out", "total_run_out",
    "line_profile", "surface_profile", "thickness", "deviation"]
CRITERIA = ["ls", "mz", "mi", "mc", "om"]

_POINTS = {"type": ["integer", "array"], "items": {"type": "integer", "minimum": 1}, "minimum": 1, "maximum": 1000000}

_STRATEGY = loosely(table("Where the feature is probed; which keys go together depends on its kind", {
    "points": {"description": "Number of points (of a sphere: of each parallel, from the pole)", **_POINTS},
    "pitch": length("Distance of points, instead of their number", "positive"),
    "scan": flag("Scanned, not touched point by point", default=False),
    "start_angle": angle("Where round strategies begin"),
    "sweep": angle("How far round they go; default 360"),
    "sections": numbers("Of a round feature: heights along its axis, mm"),
    "points_per_section": count("In each section", 1),
    "generatrices": count("Of a round feature: lines along it", 1),
    "from": any_of("Along the axis or line, mm; of a ruled feature a share of u", {"type": ["number", "string"]}),
    "to": any_of("To here", {"type": ["number", "string"]}),
    "turns": number("Of a spiral"),
    "polar_from": angle("Of a sphere: first parallel, from the pole"),
    "polar_to": angle("Last parallel"),
    "twist": angle("Of a sphere: turn of each parallel against the one before"),
    "u": vector("Of a grid on a plane: its first side, mm"),
    "v": vector("Its second side, mm"),
    "columns": count("Points along u", 1),
    "rows": count("Points along v", 1),
    "rings": numbers("Of a plane: radii of rings, mm"),
    "points_per_ring": count("On each ring", 1),
    "heights": numbers("Of a ruled feature: shares of its height"),
    "geometric_um": numbers("Of a ruled feature: what the tool leaves at each point, um"),
}))

_FEATURE = {
    "name!": text("By which characteristics refer to it"),
    "kind!": choice(FEATURES, "What it is"),
    "point": vector("A point of it, mm: on the axis, in the plane, the centre"),
    "axis": vector("Of a cylinder, cone, circle, line: direction; of a plane: out of the material; of a sphere: "
                   "its pole"),
    "radius": length("Nominal", "positive"),
    "section_radius": length("Of a cone: radius in the section through `point`", "positive"),
    "half_angle": angle("Of a cone; nominal", "positive"),
    "normal": vector("Of a line: out of the material"),
    "side": choice(["outside", "inside"], "Of a round feature: a shaft or a bore", default="outside"),
    "zero": vector("Where angles count from"),
    "lower": rows(3, "Of a ruled feature: control points of its lower curve, mm"),
    "upper": rows(3, "Of its upper curve, as many"),
    "strategy": _STRATEGY,
    "extent": loosely(table("How far it reaches, where that is more than is probed", {
        "from": length("Along the axis"),
        "to": length("To here"),
        "u": vector("Of a rectangle: its first side, mm"),
        "v": vector("Its second side, mm"),
        "inner": length("Of a ring: radius", "non_negative"),
        "outer": length("Of a ring or disc: radius", "positive"),
    })),
}

_ROUND = "name! point! axis! radius! strategy! side zero extent"
_KINDS = {
    "plane": "name! point! axis! strategy! zero extent",
    "cylinder": _ROUND,
    "cone": "name! point! axis! section_radius! half_angle! strategy! side zero extent",
    "circle": _ROUND,
    "line": "name! point! axis! normal! strategy! extent",
    "sphere": "name! point! radius! strategy! axis side zero extent",
    "point": "name! point! axis!",
    "ruled": "name! lower! upper! strategy!",
}

FILTER = table("Which waves count", {
    "upr": positive("Of closed profiles: up to so many undulations per revolution"),
    "upr_from": positive("From so many"),
    "cutoff": length("Of open profiles: waves longer than this", "positive"),
    "cutoff_long": length("And shorter than this", "positive"),
}, minProperties=1)

_CHARACTERISTIC = {
    "name!": text("By which results refer to it"),
    "kind!": choice(CHARACTERISTICS, "What is evaluated"),
    "feature": text("Of one feature"),
    "features": texts("Of several"),
    "tolerance!": any_of("With its unit: um, mm, or an angle", {"type": "string"}),
    "section": count("Only this section; the first is 0"),
    "sections": numbers("Only these sections"),
    "frame": text("In this [[frame]] instead of the datum system", minLength=1),
    "direction": vector("Along which lines are compared, or a zone is directed"),
    "criterion": choice(CRITERIA, "How the element is associated: least squares, minimum zone, maximum inscribed, "
                        "minimum circumscribed, outside the material", default="ls"),
    "datum_criterion": choice(CRITERIA, "The same of datum features", default="ls"),
    "parameter": choice("tpvq", "Of form: total, peak, valley, root mean square"),
    "filter": FILTER,
    "harmonics": count("How many harmonics of a roundness are reported", 1),
    "floating": flag("The profile's zone is not tied to the datum system", default=False),
    "deviation": flag("Of sizes: the deviation from the nominal is the value", default=False),
    "point": count("Of `deviation`: which point of the feature; the first is 0"),
    "seam": table("Where a closed cut begins and ends: also evaluated without it", {
        "at!": angle("Where"),
        "within!": angle("To either side", "positive"),
    }),
}

PLAN = Schema(
    "plan", "1.0", "Inspection plan",
    table("What a CMM probes, and what is evaluated of it", {
        "title": text("Of the plan"),
        "alignment": choice(["datum", "plan"], "What results refer to: the datum system or the plan's own frame",
                            default="datum"),
        "decision": DECISION,
        "report": REPORT_HEAD,
        "uncertainty": UNCERTAINTY,
        "probe!": table("The probe", {
            "ball_diameter!": length("Of the ball", "positive"),
            "clearance": length("Where an approach begins, from the nominal surface", "positive"),
            "reach": length("How far it goes on beyond it", "positive"),
            "compensation": choice(["fitted", "approach"], "Along which direction the ball's radius is taken off",
                                   default="fitted"),
        }),
        "datum": table("The datum system", {
            "primary": text("Feature"),
            "secondary": text("Feature"),
            "tertiary": text("Feature"),
            "best_fit": any_of("Instead of primary: the part is aligned by all points of these features, or \"all\"",
                               texts(minItems=1), constant("all")),
            "criterion": choice([*CRITERIA, "base"], "How datum features are associated", default="ls"),
            "locked": texts("Degrees of freedom that a best fit leaves alone"),
        }, anyOf=[{"required": ["primary"]}, {"required": ["best_fit"]}]),
        "frame": tables("Further frames, by planes and a line", {
            "name!": text("By which characteristics refer to it"),
            "planes!": texts("Two planes"),
            "line!": text("A line"),
        }),
        "feature": tables("Features", _FEATURE, **by("kind", _KINDS)),
        "characteristic": tables("Characteristics with their tolerances", _CHARACTERISTIC,
                                 oneOf=[{"required": ["feature"]}, {"required": ["features"]}]),
        "filter": {**FILTER, "description": "Of all roundnesses and straightnesses that have none of their own"},
    }),
    files="*.plan.toml",
    readers=["metrology/plan/plan_reader.cpp", "metrology/plan/monte_carlo_settings.cpp",
             "metrology/plan/report_header.hpp", "metrology/decision_rule.cpp"])
