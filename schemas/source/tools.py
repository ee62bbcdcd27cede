"""Cutters: [tool.N] of jobs, and tool libraries."""

from vocabulary import Schema, angle, by, choice, length, list_of, map_of, number, rows, table, text, positive

# What a type needs and takes; the keys that all have are below.
TYPES = {
    "flat": "diameter! flute_length end_angle",
    "ball": "diameter! flute_length",
    "bull": "diameter! corner_radius! flute_length end_angle",
    "taper": "diameter! taper_angle! corner_radius flute_length",
    "taper_ball": "diameter! taper_angle! flute_length",
    "drill": "diameter! tip_angle! flute_length",
    "chamfer": "diameter! tip_angle! tip_diameter flute_length",
    "lollipop": "diameter! neck_diameter!",
    "t_slot": "diameter! flute_length! corner_radius",
    "dovetail": "diameter! taper_angle! flute_length!",
    "barrel": "diameter! flank_radius! flute_length! corner_radius belly_height",
    "lens": "diameter! end_radius! corner_radius flute_length",
    "apt": "D! R E F alpha beta H!",
    "profile": "outline!",
    "measured": "points file",
}

_COMMON = {
    "name": text("By which programs may call it"),
    "hand": choice(["right", "left"], "Of the cut", default="right"),
    "length": length("From the gauge point to the tip", "positive"),
    "radius_error": length("By this the tool is larger in radius"),
    "length_error": length("By this it is longer than `length` says"),
    "run_out": length("Offset of the tool axis from the spindle axis at the gauge point", "non_negative"),
    "run_out_tilt": angle("Angle between the two"),
    "neck_diameter": length("Of a neck above the flutes; of a lollipop, its neck", "positive"),
    "neck_length": length("Of the neck", "positive"),
    "neck_angle": angle("Of a neck that widens", "non_negative"),
    "shank_diameter": length("Above flutes and neck", "positive"),
    "holder": rows(3, "Cones of the holder from the tool upwards: [height of the cone, lower diameter, upper diameter], mm"),
}

_OF_TYPES = {
    "diameter": length("Of the cutter", "positive"),
    "flute_length": length("Of the part that cuts", "positive"),
    "end_angle": angle("By which the end face is hollow", "non_negative"),
    "corner_radius": length("Of the corner", "non_negative"),
    "taper_angle": angle("Of the flank from the axis"),
    "tip_angle": angle("Included angle of the tip", "positive"),
    "tip_diameter": length("Of the flat tip", "non_negative"),
    "flank_radius": length("Of a barrel's flank", "positive"),
    "belly_height": length("Where a barrel is widest; default: half the flutes", "positive"),
    "end_radius": length("Of a lens' end", "positive"),
    "D": length("APT: diameter", "positive"),
    "R": length("APT: corner radius", "non_negative"),
    "E": length("APT: centre of the corner from the axis"),
    "F": length("APT: centre of the corner above the tip"),
    "alpha": angle("APT: slope of the end"),
    "beta": angle("APT: taper of the flank"),
    "H": length("APT: height", "positive"),
    "outline": rows(3, "Of a profile cutter, from the axis on: [radius, height, radius of the arc that leads there or 0], mm"),
    "points": rows(2, "Of a measured cutter: [height, radius], mm"),
    "file": text("Of a measured cutter: CSV file with columns Z and R"),
}

_TYPE = choice(TYPES, "Kind of cutter")


def _cutter(complete):
    """A cutter of a job may change one of a library, and then states only what changes."""
    keys = {"type!" if complete else "type": _TYPE, **_COMMON, **_OF_TYPES}
    all_have = " " + " ".join(_COMMON)
    needed = all_have.replace(" length ", " length! ") if complete else all_have
    cases = {k: (v if complete else v.replace("!", "")) + needed for k, v in TYPES.items()}
    return table("A cutter", keys, **by("type", cases))


CUTTER = _cutter(True)
CHANGED_CUTTER = _cutter(False)
NUMBERED = r"^0*[1-9][0-9]{0,4}$"

TOOLS = Schema(
    "tools", "1.1", "Tool library",
    table("Cutters by number, for `tools` of a job", {
        "title": text("Of the library"),
        "tool!": map_of(CUTTER, "By number", NUMBERED, minProperties=1),
    }),
    readers=["cutter/body/cutter_file.cpp", "cutter/body/cutter_spec.cpp"])
