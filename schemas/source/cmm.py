"""The virtual CMM, and how uncertainties are found and conformity is decided."""

from vocabulary import (Schema, angle, any_of, by, choice, constant, count, flag, integer, length, number, positive,
                        stated_length, table, text, vector)

CMM_KEYS = {
    "e0": stated_length("E = e0 + L/k: largest error of indication at length 0"),
    "l_per_um": positive("k: mm of length per um of error; absent: no part that grows"),
    "seed": count("Of the machine that is drawn", default=0),
    "model": choice(["linear", "field"], "linear: independent points; field: a machine with errors over its volume",
                    default="linear"),
    "p_form": stated_length("Of a field: largest form of the 25-point sphere; default e0"),
    "travel": vector("Of a field: mm"),
    "position": vector("Of a field: the workpiece's origin from the centre of the volume, mm"),
    "stylus": table("The stylus", {
        "direction": vector("From the ball to the head, frame of the workpiece; default [0, 0, 1]"),
        "length!": length("Of the shank above the ball", "positive"),
        "diameter!": length("Of the shank", "positive"),
        "modulus": positive("GPa; default 600, cemented carbide"),
    }),
    "probe": table("Errors of the probe", {
        "pre_travel": stated_length("The same in every direction; qualification takes it out"),
        "lobe": stated_length("Amplitude of a three-lobed pre-travel"),
        "lobe_phase": angle("Of the lobes, from the stylus' own zero direction"),
        "ball_form": stated_length("Largest departure of the ball from a sphere"),
        "force": number("N at the trigger; bends the stylus", minimum=0),
        "repeatability": stated_length("Standard deviation of a point"),
        "scan_noise": stated_length("What scanning adds, standard deviation"),
    }),
    "temperature": table("Temperatures", {
        "part": number("degC; default 20", minimum=-40, maximum=60),
        "scales": number("degC; default 20", minimum=-40, maximum=60),
        "part_expansion": number("um/(m K); default 11.5", minimum=0),
        "scale_expansion": number("um/(m K); default 8", minimum=0),
        "compensated": flag("The machine corrects by sensors and stated coefficients", default=False),
        "sensor_error": number("Half width, K", minimum=0),
        "expansion_error": number("Half width, um/(m K)", minimum=0),
    }),
}

CMM_TABLE = table("The CMM that measures", CMM_KEYS)

DECISION = choice(["simple", "iso14253"], "How conformity is decided: by the value, or with its uncertainty "
                  "(ISO 14253-1)", default="simple")

UNCERTAINTY = table("How uncertainties are found", {
    "method!": choice(["monte_carlo", "linear"], "By draws (GUM supplement 1) or by linear propagation"),
    "draws": any_of("Number of draws, or \"adaptive\"", {"type": "integer", "minimum": 1, "maximum": 10000000},
                    constant("adaptive")),
    "digits": integer("Significant digits that adaptive draws make stable", minimum=1, maximum=2),
    "seed": count("Of the draws", default=1),
}, **by("method", {"monte_carlo": "draws digits seed", "linear": ""}))

REPORT_HEAD = table("Head of the report", {
    "part": text("Name of the part", minLength=1),
    "part_number": text("Its number", minLength=1),
    "serial_number": text("Its serial number", minLength=1),
    "order": text("Order", minLength=1),
    "operator": text("Who measured", minLength=1),
    "date": text("Year-month-day, with a time of day or without", minLength=1,
                 pattern=r"^\d{4}-\d\d-\d\d(T\d\d:\d\d:\d\d(Z|[+-]\d\d:\d\d)?)?$"),
    "cmm": text("On what", minLength=1),
})

CMM = Schema("cmm", "1.0", "CMM",
             table("A CMM alone, for --cmm: the keys of a job's inspection.cmm", CMM_KEYS),
             readers=["metrology/probing/cmm_model.cpp"])
