"""Jobs: a part with its machine, program, blank, tools and plan."""

from cmm import CMM_TABLE, DECISION, REPORT_HEAD, UNCERTAINTY
from errors import DEFS, errors_table
from machine import body_table
from tools import CHANGED_CUTTER, NUMBERED
from vocabulary import (DIALECTS, Schema, by, choice, count, flag, length, map_of, number, numbers, positive, ref, rows,
                        table, tables, text, texts, vector)

_BLANKS = {
    "box": "size! origin",
    "cylinder": "diameter! height! origin",
    "frustum": "bottom_diameter! top_diameter! height! origin",
    "loft": "sections! origin",
    "mesh": "file! origin",
}

CONTROLLER = {
    "time_law": flag("Feeds keep to the limits of the axes", default=False),
    "jerk": flag("And to their jerk limits", default=False),
    "corner_time": positive("s in which a corner may be passed"),
    "jerk_time": positive("s in which an axis reaches its acceleration where it states no jerk"),
    "default_rapid": positive("mm/s, of axes that state no velocity"),
    "default_rotary_rapid": positive("deg/s, the same of rotary axes"),
    "servo_lag": flag("Axes lag by their velocity gains", default=False),
    "dynamics": choice(["off", "quasi_static", "linear"], "What the masses and springs of the machine do to the path",
                       default="off"),
    "dynamics_step": number("s: step in time", minimum=1e-5, maximum=5e-3),
    "dynamics_renewal": positive("mm of travel after which the model is made anew"),
    "dynamics_rotary_renewal": positive("deg of travel after which the model is made anew"),
}

JOB = Schema(
    "job", "1.1", "Job",
    table("One part: machine, NC program, blank, tools, plan", {
        "title!": text("Of the report"),
        "machine!": text("Machine file, or the name of a shipped machine"),
        "program!": table("The NC program", {
            "file!": text("Path from the folder of the job"),
            "dialect": choice(DIALECTS, "Default: recognised from the file"),
        }),
        "setup": table("How the workpiece is clamped", {
            "origin": vector("Workpiece origin in the frame of the table, mm"),
            "tilt": vector("Turns about X, then Y, then Z, deg"),
        }),
        "offsets": table("Origins of work offsets in the frame of the table, mm", {
            f"G{n}": vector("mm; of G54 default [0, 0, 0]" if n == 54 else "mm") for n in range(54, 60)}),
        "blank!": table("The blank, frame of the workpiece", {
            "shape!": choice(_BLANKS, "What it is"),
            "size": vector("Of a box, mm"),
            "diameter": length("Of a cylinder", "positive"),
            "height": length("Of a cylinder or frustum", "positive"),
            "bottom_diameter": length("Of a frustum", "positive"),
            "top_diameter": length("Of a frustum", "positive"),
            "sections": rows(3, "Of a loft: [z, size in x, size in y], mm"),
            "file": text("Of a mesh: STL, PLY, OBJ, OFF or 3MF, mm"),
            "origin": vector("Middle of its bottom face, mm; default: the workpiece origin is on the top face"),
        }, **by("shape", _BLANKS)),
        "fixtures": body_table("Bodies beside the workpiece, frame of the table", {}, ""),
        "nominal": table("Nominal surface, with which the finished part is compared", {
            "file!": text("Mesh, mm"),
            "origin": vector("Its origin in the frame of the workpiece, mm"),
        }),
        "tools": text("Tool library (.toml), or a LinuxCNC tool table (.tbl)"),
        "tool": map_of(CHANGED_CUTTER, "Cutters by number; beside a library, what they change of it", NUMBERED),
        "operation": tables("Which blocks of the program make which features", {
            "name!": text("By which errors and reports refer to it"),
            "kind": choice(["other", "cone"], "cone: the test of NAS 979", default="other"),
            "makes": texts("Features of the plan"),
            "lines": numbers("[first, last] line of the program", 2),
        }),
        "error_span": table("Over which travel errors have their span", {"operation!": text("That of this operation")}),
        "error_draw": table("Which draw of errors that are written as distributions", {
            "seed!": count("Of the lottery"),
            "index": count("Which draw", default=0, maximum=2**32 - 1),
        }),
        "errors": errors_table("Errors of the machine, by ISO 230-1 names or symbols that it declares"),
        "inspection": table("How the part is measured", {
            "plan": text("Inspection plan"),
            "cmm": CMM_TABLE,
            "uncertainty": UNCERTAINTY,
            "decision": DECISION,
        }),
        "report": REPORT_HEAD,
        "controller": table("What the control does with feeds", CONTROLLER),
        "accuracy": table("Bounds of approximations", {
            "path_bound": length("Of the tool path; default 0.01 um", "positive")}),
        "output": table("What is written", {
            "report": flag("report.html", default=True),
            "mesh_pitch": length("Pitch of the mesh of the report's picture", "positive"),
            "export": texts("Results in other formats: .qif, .csv, .xml, .dfq, .json"),
        }),
    }),
    files="**/job.toml",
    readers=["app/job/job.cpp", "app/job/controller_settings.cpp", "app/job/export_request.cpp",
             "app/job/mesh_input.cpp", "app/job/compensated_job.cpp", "metrology/decision_rule.cpp",
             "metrology/plan/report_header.hpp", "metrology/plan/monte_carlo_settings.cpp",
             "metrology/probing/cmm_model.cpp", "kinematics/errors/error_table.cpp", "cutter/body/cutter_file.cpp",
             "cutter/body/cutter_spec.cpp", "kinematics/model/machine_body.cpp"],
    defs=DEFS)
