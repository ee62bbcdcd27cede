"""Documents of motion tests and of their evaluation; one form for all, whose keys are those that a test has."""

from results import NUMBER, document, known
from vocabulary import (choice, count, flag, list_of, map_of, matrix, number, numbers, or_null, share, table, tables,
                        text, texts, vector)

_MAPS = table("", {"A!": matrix("Six of each position of A: x y z um, a b c urad"),
                   "C!": list_of(matrix(), "At each position of A, of each of C"),
                   "poses!": list_of(matrix(), "Of both together")})
_TERMS = or_null(map_of(NUMBER, "By term: um; square urad"))
_SPIKE = or_null(table("", {"height_um!": number(""), "sd_um!": number(""), "over_mm!": number("")}))
_FATE = tables("", {"error!": text(""), "cancelled!": texts(""), "kept!": texts("")})

EVALUATION = or_null(table("Values of the standard, um", {
    **{name: known("ISO 230-4") for name in [
        "G_ccw_ls", "G_cw_ls", "G_bi_ls", "G_ccw_mz", "G_cw_mz", "G_bi_mz", "D_mean_radial", "F_ccw_max", "F_ccw_min",
        "F_cw_max", "F_cw_min"]},
    "centre_bi": list_of(NUMBER, ""), "signature": _TERMS, "signature_sd": _TERMS, "signature_sd_per_um": _TERMS,
    "contribution_um": map_of(NUMBER, "G of each term alone; null: not separated"),
    "contribution_share": map_of(NUMBER, ""),
    "residual_rms": NUMBER,
    "spikes": or_null(table("Reversal spikes", {
        "X": _SPIKE, "Y": _SPIKE, "Z": _SPIKE, "signature_without": map_of(NUMBER, ""), "residual_rms": NUMBER})),
    "harmonics_um": map_of(NUMBER, "Of a turn"), "form_um": NUMBER,
    "rms_um": {"description": "Of an R-test: x, y, z", "type": ["array", "number", "object"]},
    **{name: {"description": "ISO 230-2", "type": ["number", "array", "null"], "items": NUMBER} for name in [
        "x_up", "x_down", "B_i", "B", "B_mean", "s_up", "s_down", "R_up", "R_down", "R_i", "R", "E_up", "E_down", "E",
        "M", "A_up", "A_down", "A"]},
}))

MOTION = document("motion", "Motion test", "frustum motion --json, motion.json", {
    "test!": text("circle, rotary, cone, chase, line, diagonal, touch, probe, vectors, trace"),
    "files": texts("Measured"), "job": text("Of a probed part"),
    "machine": text(""), "structure": text(""), "tool_length_mm": number(""), "errors": map_of(text(""), "Injected"),
    "setup_um": table("", {"ball!": vector(""), "table_ball!": vector(""), "length!": number("")}),
    "noise_um": number("Standard deviation"), "resolution_um": number(""), "seed": count("Of the noise"),
    "plane": text(""), "axis": text(""), "direction": text(""), "hold": text(""), "sense": text(""),
    "dynamics": text("Masses and springs moved the readings"),
    "length_mm": number(""), "center_mm": vector(""), "radius_mm": number(""), "cone_angle_deg": number(""),
    "inclination_deg": number(""), "table_ball_mm": vector(""), "ball_diameter_mm": number(""),
    "feed_mm_min": number(""), "feed_deg_min": number(""), "temperature_degC": number(""),
    "angles_deg": numbers(""), "ccw_angles_deg": numbers(""), "cw_angles_deg": numbers(""),
    "ccw_um": numbers("Radial deviation"), "cw_um": numbers("Radial deviation"), "reading_um": numbers(""),
    "reading_back_um": numbers("Of a program's way back"),
    "displacement_um": matrix("x, y, z, frame of the table"),
    "axes": map_of(numbers(), "Positions at each reading, mm and deg", "^[XYZABC]$"),
    "runs": count("Up and down"), "targets_mm": numbers(""), "deviations_up_um": matrix("A row a target"),
    "deviations_down_um": matrix(""),
    "straightness_um": map_of(table("", {"least_squares!": number(""), "end_points!": number(""),
                                         "minimum_zone!": number("")}), "Across the axis, by direction"),
    "points": count("Along each diagonal"), "lengths_mm": map_of(number(""), "By diagonal"),
    "diagonals": map_of(numbers(), "Readings by diagonal, um"),
    "evaluation": EVALUATION,
    "told": texts("Errors that the test shows"), "not_told": texts("Errors that it does not"),
    "setup_found_um": table("", {"table_ball": vector(""), "length": number(""), "center": numbers("", 2),
                                 "mean_radius": number("")}),
    "setup_sheet": table("", {
        "g54_in_table_mm!": vector(""), "capture_deg!": numbers("", 2), "pass_deg!": numbers("", 2),
        "travels!": {"type": ["object", "array"]}, "largest_reading_um!": number(""), "stroke_um!": number(""),
        "nearest_mm!": NUMBER, "nearest!": text("")}),
    "program": table("The NC program that was run", {"file!": text(""), "largest_difference_um!": number("")}),
    "pretravel_um": table("", {"constant!": number(""), "lobe!": number(""), "lobe_phase_deg!": number("")}),
    "touches": count(""), "log": text("File of measured touches"),
    "plan": matrix("Of each touch: positions of A and C, point; or feature, section, pose; the first is 0"),
    "poses": list_of(map_of(number(""), "deg, by letter"), ""),
    "A_deg": numbers("Positions"), "C_deg": numbers("Positions"),
    "identified": _MAPS, "sd": _MAPS, "scatter": _MAPS, "visible": _MAPS,
    "repeat": count(""), "largest_difference": table("", {"um!": number(""), "urad!": number("")}),
    "residuals": table("What is left over", {
        "rms_um!": number(""), "expected_rms_um!": NUMBER, "degrees_of_freedom!": count(""), "probability!": NUMBER,
        "largest_um!": number(""), "largest_sd_um!": NUMBER, "largest_at!": text(""),
        "consistent!": choice(["yes", "no"]), "suspects!": texts(""), "residual_um!": numbers(""),
        "sd_um!": numbers("")}),
    "unchecked": texts("Touches that nothing checks"),
    "characteristics": tables("Of a probed part", {"name!": text(""), "unit!": text(""), "on_cmm!": NUMBER,
                                                   "on_machine!": NUMBER, "difference!": NUMBER}),
    "cancel": texts("Errors that cancel on the machine"), "cancel_in_part": _FATE, "stay": texts(""),
    "grow": texts(""), "without_effect": texts(""),
    "gains": table("", {"characteristics!": texts(""), "characteristic_units!": texts(""), "errors!": texts(""),
                        "units!": texts(""), "on_cmm!": matrix(""), "on_machine!": matrix("")}),
    "vectors": map_of(table("", {
        "side!": choice(["table", "head"]), "point_mm!": vector(""), "direction!": vector(""),
        "nominal_point_mm!": vector(""), "nominal_direction!": vector(""), "from_previous_mm!": vector(""),
        "point_off_um!": vector(""), "direction_off_urad!": vector("")}), "By rotary axis"),
    "diagnostics": tables("", {"severity!": text(""), "id!": text(""), "message!": text(""), "hint!": text("")}),
})

MOTIONS = [MOTION]
