"""Documents of analyses: sensitivity, identification, designs, studies, volumes, dynamics, the benchmark."""

from results import DIAGNOSTICS, NUMBER, document, known
from vocabulary import (any_of, choice, complex_number, count, flag, list_of, map_of, matrix, number, numbers, or_null,
                        share, table, tables, text, texts, vector)

UNIT = choice(["um", "urad"])

SENSITIVITY = document("sensitivity", "Sensitivities", "frustum sensitivity --json, sensitivity.json", {
    "title!": text("Of the job"), "machine!": text(""), "method!": text("analytic or differences"),
    "characteristics!": texts(""), "errors!": texts(""), "units!": list_of(UNIT, "Of the errors"),
    "characteristic_units!": list_of(UNIT, ""),
    "matrix!": list_of(list_of(NUMBER), "A row a characteristic, a column an error"),
    "even!": list_of(list_of(NUMBER), "What a form gains of an error of either sign")})

_RECIPE = tables("", {"step!": text(""), "equation!": text(""), "quantity!": text(""), "formula!": text(""),
                      "value!": NUMBER, "unit!": text("")})
IDENTIFICATION_RESULT = document("identification", "Identified errors", "frustum identify --json", {
    "title!": text("Of the study"), "machine!": text(""),
    "complete!": flag("Everything unknown is identified"), "answered!": flag("Every error is"),
    "estimates!": tables("", {
        "name!": text(""), "unit!": text(""), "value!": known(""), "standard_uncertainty!": known(""),
        "lower!": known("Of the 95 % interval"), "upper!": known(""), "fixed!": flag("Taken as exactly known"),
        "others": map_of(NUMBER, "What others found, and recipes")}),
    "covariance!": list_of(list_of(NUMBER), "In the units of the estimates"),
    "combinations!": tables("What is known of errors that cannot be separated", {
        "text!": text(""), "unit!": text(""), "value!": NUMBER, "standard_uncertainty!": NUMBER,
        "lower!": NUMBER, "upper!": NUMBER}),
    "information_shares!": map_of(map_of(NUMBER, ""), "By error: how much rests on what was measured"),
    "observability!": table("", {
        "unknowns!": count(""), "rank!": count(""), "singular_values!": list_of(NUMBER, ""), "condition!": NUMBER,
        "null_space!": texts("What is not seen"), "estimable!": texts("What is"),
        "separating_patterns": texts("Step patterns that would separate the errors")}),
    "agreement!": table("Of the measurements with the machine model", {
        "chi2!": NUMBER, "degrees_of_freedom!": {"type": "integer"}, "rejected!": flag(""), "probability!": NUMBER,
        "birge!": NUMBER}),
    "left_out!": texts("Measured, but without a derivative"),
    "setup_found!": list_of({"type": "object", "properties": {"test": {"type": "string"}},
                             "additionalProperties": {"type": ["number", "string", "null"]}},
                            "Set-ups of motion tests, um and urad"),
    "residuals!": tables("", {
        "name!": text(""), "unit!": text(""), "prior!": flag("What is known from elsewhere"), "measured!": NUMBER,
        "predicted!": NUMBER, "residual!": NUMBER, "normalised!": NUMBER, "w!": NUMBER, "outlier!": flag("")}),
    "suspect!": or_null(text("The one that is most likely wrong")),
    "recipe": _RECIPE, "recipe_corrected": _RECIPE,
    "diagnostics!": tables("", {"id!": text(""), "message!": text(""), "hint!": text("")})})

_CHOICE = {"rank!": count(""), "identifies_all!": any_of("", flag(""), choice(["yes", "no"])), "log_det!": NUMBER,
           "standard_deviations!": map_of(NUMBER, "Expected, um and urad")}
_STEP_SET = {"patterns!": texts(""), "workpieces": count("That they need"), "meets_limits": flag("Of --limit"), **_CHOICE}
_STEP_CHOICE = table("", _STEP_SET)
DESIGN = document("design", "Step patterns to cut", "frustum design --json", {
    "machine!": text(""), "unknowns!": tables("", {"name!": text(""), "unit!": text("")}),
    "left_out!": texts("That no step pattern separates"), "taken_as_exact!": texts(""), "patterns!": texts(""),
    "unreachable!": tables("", {"pattern!": text(""), "reason!": text("")}),
    "best_of_size!": list_of(table("", {**_STEP_SET, "identifying_sets!": count("")}), ""),
    "smallest!": or_null(_STEP_CHOICE), "smallest_identifying!": list_of(texts(), ""), "null_space!": texts("")})

_TEST_CHOICE = table("", {"tests!": texts(""), **_CHOICE, "hours!": NUMBER, "bits!": NUMBER})
TEST_DESIGN = document("test-design", "Pieces and tests to choose", "frustum design --study --json", {
    "machine!": text(""), "tests!": texts(""),
    "items!": map_of(table("", {"machine_hours!": NUMBER, "cmm_hours!": NUMBER, "rank!": count(""), "bits!": NUMBER,
                                "bits_per_hour!": NUMBER}), "Each by itself"),
    "best_of_size!": map_of(_TEST_CHOICE, "By number of tests"), "smallest": _TEST_CHOICE,
    "budget_hours": number(""), "within_budget": _TEST_CHOICE, "null_space!": texts("")})

_INTERVAL = or_null(list_of(NUMBER, "", minItems=2, maxItems=2))
_PROPORTION = table("", {"k!": count("Of n"), "n!": count(""), "p!": NUMBER, "ci95!": list_of(NUMBER, "")})
STUDY = document("study", "Result of a study", "result.json of frustum study", {
    "title!": text(""), "seed!": count(""), "scheme!": text(""), "samples!": count(""),
    "engine!": table("", {"name!": text(""), "bound_um!": NUMBER, "controls!": count(""), "growth!": NUMBER,
                          "reason": text("")}),
    "characteristics!": tables("", {
        "name!": text(""), "unit!": UNIT, "mean!": NUMBER, "mean_se!": NUMBER, "sd!": NUMBER, "min!": NUMBER,
        "max!": NUMBER,
        "quantiles!": tables("", {"p!": share(""), "value!": NUMBER, "ci95!": _INTERVAL}),
        "limit!": NUMBER, "both_sides!": flag(""), "conform!": or_null(_PROPORTION),
        "conform_at_bound": list_of(_PROPORTION, ""),
        "risks!": tables("", {"rule!": text(""), "acceptance_limit!": NUMBER, "accept!": NUMBER, "consumer!": NUMBER,
                              "producer!": NUMBER, "se!": table("", {"consumer!": NUMBER, "producer!": NUMBER})}),
        "exact": table("Where every law is normal", {
            "mean!": NUMBER, "rms!": NUMBER, "quantiles!": tables("", {"p!": share(""), "value!": NUMBER}),
            "conform!": NUMBER})}),
    "joint!": or_null(_PROPORTION),
    "shares!": tables("", {"characteristic!": text(""), "draws!": count(""), "groups!": tables("", {
        "name!": text(""), "mean_square!": NUMBER, "total!": NUMBER, "total_se!": NUMBER, "first!": NUMBER,
        "first_se!": NUMBER})}),
    "allocation!": or_null(table("", {
        "characteristic!": text(""), "probability!": NUMBER, "factors!": map_of(NUMBER, ""), "cost!": NUMBER,
        "one_factor!": table("", {"factor!": NUMBER, "ci95!": _INTERVAL, "cost!": NUMBER})})),
    "map!": tables("", {"cone_angle_deg!": NUMBER, "inclination_deg!": NUMBER, "center_mm!": numbers(""),
                        "rms_um!": NUMBER, "directions!": count(""), "shown!": NUMBER, "median_um!": NUMBER,
                        "median_ci95!": _INTERVAL, "q95_um!": NUMBER}),
    "not_reached!": texts("Widths that were to be reached"),
    "failed!": tables("", {"draw!": count(""), "message!": text("")})})

STUDY_RUN = document("study-run", "How a study was run", "run.json of frustum study", {
    "host!": text(""), "threads!": count(""), "ranks!": count(""), "seconds!": number(""),
    "draws_computed!": count(""), "ended_unix_s!": count("")})

_AXES = map_of(number(""), "mm and deg, by letter", "^[XYZABC]$")
_UM = table("", {"max!": number(""), "mean!": number(""), "p95!": number("")})
VOLUMETRIC = document("volumetric", "Volumetric errors", "frustum volumetric --json, volumetric.json", {
    "machine!": text(""), "structure!": text(""), "tool_length_mm!": number(""), "errors!": map_of(text(""), ""),
    "counts!": list_of(count(""), "Points along X, Y, Z"),
    "statistics_um!": table("Lengths of the error", {"tool!": _UM, "workpiece!": _UM, "relative!": _UM}),
    "worst!": table("", {"linear!": _AXES, "rotary!": _AXES, "relative_um!": vector("")}),
    "ranking!": tables("", {"name!": text(""), "side!": text(""), "gain!": number(""), "gain_unit!": text(""),
                            "share!": number("")}),
    "positions!": tables("Of the rotary axes", {"rotary!": _AXES, "points!": tables("", {
        "linear!": _AXES, "place_mm!": vector(""), "tool_um!": vector(""), "workpiece_um!": vector(""),
        "relative_um!": vector("")})})})

_POLES = table("", {"frequency_hz!": numbers(""), "damping_ratio!": numbers(""),
                    "real_poles_1_s!": any_of("", numbers(""), count(""))})
_COMPLEX = list_of(list_of(complex_number(""), ""), "")
DYNAMICS_RESULT = document("dynamics", "Dynamics", "frustum dynamics --json, dynamics.json", {
    "machine!": text(""), "structure!": text(""), "axes!": _AXES, "tool_length_mm!": number(""),
    "tip_in_machine_mm!": vector(""), "coordinates!": count("Of the model"),
    "undamped_hz!": numbers(""), "highest_hz!": number(""), "tip_shape_squared!": matrix("A row a mode"),
    "modes!": tables("", {"moves_most!": text(""), "kinetic_share!": number(""), "yields_most!": text(""),
                          "strain_share!": number("")}),
    "damped!": _POLES, "static_compliance_um_per_n!": matrix(""), "static_stiffness_n_per_um!": vector(""),
    "held_stiffness_n_per_um!": list_of(NUMBER, "With motors held"), "gravity_sag_um!": vector(""),
    "axis_order!": texts(""), "inertial_compliance!": matrix("um per m/s^2 (rad/s^2)"),
    "dominant_peaks!": tables("", {"direction!": choice("xyz"), "frequency_hz!": number(""),
                                   "compliance_um_per_n!": number("")}),
    "states": count("Of the controlled machine"), "poles": _POLES,
    "frf_um_per_n": map_of(_COMPLEX, "By frequency, Hz"), "inertial_frf": map_of(_COMPLEX, "By frequency, Hz"),
    "tracking_deviation": map_of(_COMPLEX, "By frequency, Hz"),
    "rates": table("", {"tip_in_machine_um!": vector(""), "tip_in_table_um!": vector(""),
                        "turn_in_table_urad!": vector("")}),
    "map": table("", {"rows!": list_of({"type": ["string", "number"]}, "Axis, from, to, number"),
                      "columns!": list_of({"type": ["string", "number"]}, "The same"), "quantity!": text(""),
                      "values!": matrix(""),
                      "box!": table("", {"min!": number(""), "q1!": number(""), "median!": number(""),
                                         "q3!": number(""), "max!": number("")}),
                      "frequency_range_hz!": matrix("")}),
    "circle": table("", {"radius_mm!": number(""), "feed_mm_min!": number(""), "omega_rad_s!": number(""),
                         "mean_radial_um!": number(""), "roundness_lsq_um!": number(""),
                         "phasor_x_um!": list_of(complex_number(""), ""),
                         "phasor_y_um!": list_of(complex_number(""), "")}),
    "jerk_move": table("", {"axis!": text(""), "breakpoints_s_m_s2": matrix(""), "breakpoints_s_rad_s2": matrix(""),
                            "columns!": texts(""), "rows!": matrix(""), "largest_um!": vector(""),
                            "largest_after_the_move_um!": vector(""), "peak_um!": vector("")}),
    "compare": table("", {"machine!": text(""), "rows!": texts(""), "first_um_per_gn!": list_of(NUMBER, ""),
                          "second_um_per_gn!": list_of(NUMBER, ""), "change_percent!": list_of(NUMBER, "")}),
    "identified": table("", {"parameters!": tables("", {
        "name!": text(""), "factor!": number(""), "relative_standard_uncertainty!": NUMBER,
        "interval_95!": list_of(NUMBER, "")}), "noise!": number(""), "not_separated!": list_of({}, "")})})

_SCORE = table("", {"n!": count(""), "missing": count(""), "skill!": NUMBER, "crps!": NUMBER, "rmse!": NUMBER,
                    "coverage_95!": NUMBER, "interval_score_95!": NUMBER, "log_score!": NUMBER, "within_2sd!": NUMBER})
BENCHMARK = document("benchmark", "Benchmark", "frustum benchmark make, score, baseline, verify --json", {
    "machines": tables("", {
        "id!": text(""), "points": _SCORE, "poses": _SCORE, "errors": _SCORE, "commitment_holds": flag(""),
        "differing": texts(""), "unexpected": texts(""), "holds": flag("")}),
    "unexpected": texts("Files of no machine"), "files": texts("Written"),
    "commitments": map_of(text(""), "By machine")})

ANALYSES = [SENSITIVITY, IDENTIFICATION_RESULT, DESIGN, TEST_DESIGN, STUDY, STUDY_RUN, VOLUMETRIC, DYNAMICS_RESULT,
            BENCHMARK]
