"""Machine files: axes, travels, aliases of errors, the control, bodies, masses and springs."""

from vocabulary import (Schema, any_of, by, choice, count, flag, map_of, number, numbers, positive, table, tables, text,
                        texts, vector, length, list_of, rows)

CONTROL_OF_PROGRAMS = {
    "words": texts("M and G words of the machine's builder that move nothing"),
    "units": choice(["mm", "inch"], "Of Fanuc-like programs, the unit before the first G20 or G21"),
    "max_blocks": count("Blocks that may run again before they are an endless loop", 1, default=2000000),
    "decimal_point": choice(["calculator", "increment"],
                            "How numbers without a point count: calculator (X10 is 10 mm) or increment (0.010 mm)"),
}

BODY_SHAPES = {"box": "size!", "cylinder": "diameter! height!", "mesh": "file!"}


def body_table(about, more, places):
    keys = {
        "name!": text("By which reports call it"),
        "shape!": choice(BODY_SHAPES, "box, cylinder about Z, or mesh"),
        "size": vector("Of a box, mm: x, y, z"),
        "diameter": length("Of a cylinder", "positive"),
        "height": length("Of a cylinder", "positive"),
        "file": text("Of a mesh: STL, PLY, OBJ, OFF or 3MF, mm"),
        "origin": vector("Where the body's own origin is, mm"),
        "tilt": vector("Turns about X, then Y, then Z, deg"),
        **more,
    }
    rest = " name! origin tilt " + places
    return tables(about, keys, **by("shape", {k: v + rest for k, v in BODY_SHAPES.items()}))


_PAIR = "[stiffness, damping]"
_ON = choice(["moving", "fixed"], "Which body it is fastened to", default="moving")

_SOLID = tables("Solids that make the body; instead of mass, com and inertia", {
    "shape!": choice(["box", "cylinder", "prism"], "box, cylinder about Z, or prism along Z"),
    "size": vector("Of a box, mm"),
    "diameter": positive("Of a cylinder, mm"),
    "length": positive("Of a cylinder or prism, mm"),
    "outline": rows(2, "Of a prism: corners one after the other, mm"),
    "at": vector("Of its centre, mm"),
    "rotation": vector("Turns about X, then Y, then Z, deg"),
    "mass": positive("kg; or density"),
    "density": positive("kg/m^3: steel 7850, cast iron 7200"),
}, oneOf=[{"required": ["mass"]}, {"required": ["density"]}],
    **by("shape", {"box": "size! at rotation mass density", "cylinder": "diameter! length! at rotation mass density",
                   "prism": "outline! length! at rotation mass density"}))

_RIGID = table("A rigid body", {
    "mass": positive("kg"),
    "com": vector("Centre of mass, mm, frame of the machine at zero of all axes"),
    "inertia": numbers("[xx, yy, zz, xy, xz, yz], kg m^2, about the centre of mass, xy = -sum m x y", 6),
    "element": _SOLID,
}, oneOf=[{"required": ["mass", "com", "inertia"]}, {"required": ["element"]}])

_CONTROLLED = "tn feed_forward_velocity feed_forward_acceleration reference_inertia scale on"
_CONTROL = table("The control of the axis: its drive answers to a position controller", {
    "kind": choice(["spring", "direct", "screw"], "spring: no control", default="spring"),
    "kv": positive("Position gain, 1/s"),
    "kp": positive("Velocity gain, kN s/m (N m s/rad)"),
    "tn": positive("Integral time, ms"),
    "feed_forward_velocity": number("Share of 1", minimum=0, maximum=2),
    "feed_forward_acceleration": number("Share of 1", minimum=0, maximum=2),
    "reference_inertia": positive("Of the acceleration feed-forward, kg (kg m^2)"),
    "motor_inertia": positive("Of a screw, kg (kg m^2) reduced to the axis"),
    "stiffness": positive("Of a screw, N/um (N m/rad)"),
    "damping": number("Of a screw, kN s/m (N m s/rad)", minimum=0),
    "scale": vector("Where the position is measured, mm"),
    "on": _ON,
}, **by("kind", {
    "spring": "",
    "direct": "kv! kp! " + _CONTROLLED,
    "screw": "kv! kp! motor_inertia! stiffness! damping! " + _CONTROLLED,
}, otherwise="spring"))

DYNAMICS = table("Masses, springs and dampers", {
    "workpiece": choice(["bed", "ground"], "What a workpiece is on that no axis moves", default="bed"),
    "body!": map_of(_RIGID, "bed, and one body an axis", "^(bed|[XYZABC])$", required=["bed"]),
    "mount": tables("Springs between bed and ground", {
        "at!": vector("mm"),
        "stiffness!": vector("x, y, z, N/um"),
        "damping!": vector("x, y, z, kN s/m"),
    }),
    "axis!": map_of(table("How an axis is guided and driven", {
        "carriage": tables("Of a linear axis", {
            "at!": vector("mm"),
            "normal!": vector("Unit vector across the axis"),
            "stiffness!": numbers("[along the normal, lateral], N/um", 2),
            "damping!": numbers("[along the normal, lateral], kN s/m", 2),
            "on": _ON,
        }),
        "bearing": tables("Of a rotary axis", {
            "at!": vector("mm"),
            "axial!": numbers(_PAIR + ", N/um and kN s/m", 2),
            "radial!": numbers(_PAIR + ", N/um and kN s/m", 2),
            "tilt": numbers(_PAIR + ", N m/rad and N m s/rad", 2),
            "on": _ON,
        }),
        "drive!": table("The spring along the axis", {
            "at!": vector("mm"),
            "stiffness!": number("N/um (N m/rad)", minimum=0),
            "damping!": number("kN s/m (N m s/rad)", minimum=0),
            "on": _ON,
        }),
        "control": _CONTROL,
    }), "By axis", "^[XYZABC]$"),
})

_AXIS = table("One axis", {
    "direction": vector("Unit vector of positive motion of the tool relative to the workpiece (ISO 841), so that what carries "
                        "the workpiece moves the other way; default: the letter's own"),
    "offset": vector("Where the axis is, mm, from the part before it (0, 0, 0); of a rotary axis a point of its line"),
    "travel": numbers("[lowest, highest], mm; deg of a rotary axis", 2),
    "endless": flag("A rotary axis without ends", default=False),
    "home": number("Reference position, mm or deg; of Z where programs lift the tool to, as a rule the upper end of its travel", default=0),
    "velocity": positive("Greatest speed, mm/s or deg/s"),
    "acceleration": positive("Greatest, mm/s^2 or deg/s^2"),
    "jerk": positive("Greatest, mm/s^3 or deg/s^3"),
    "servo_gain": positive("Velocity gain of the position loop, 1/s"),
    "functional_point": any_of("About which its angular errors turn: a point of its frame, mm, or \"tip\"",
                               vector(""), {"const": "tip"}),
}, anyOf=[{"required": ["travel"]}, {"required": ["endless"]}])

MACHINE = Schema(
    "machine", "1.1", "Machine file",
    table("A machine: its chain of axes from the bed to tool and workpiece", {
        "name!": text("Short name, by which jobs and reports call it"),
        "title": text("What it is, in words"),
        "source": text("Where its numbers come from"),
        "structure!": text("Structure code after ISO 10791 from tool (t) over bed (b) to workpiece (w), such as "
                           "t-(C)-Z-b-X-Y-A-C-w"),
        "rotation_order": choice(["zyx", "xyz"], "In which angular errors of one axis act", default="zyx"),
        "rotary_error_frame": choice(["stator", "rotor"], "In whose directions errors of rotary axes are",
                                     default="stator"),
        "datum": texts("Primary and secondary reference axis, to which location errors refer", maxItems=2),
        "spindle": table("The spindle", {"offset": vector("Gauge point from the last part of the tool side, mm (0, 0, 0)")}),
        "table": table("The table", {"offset": vector("Its origin from the last part of the workpiece side, mm (0, 0, 0)")}),
        "axis!": map_of(_AXIS, "Axes by letter, each of the structure", "^[XYZABC]$"),
        "alias": map_of(table("One symbol", {
            "error!": text("ISO 230-1 name"),
            "scale": number("Amount of the error for one of the symbol", default=1),
            "carries": flag("Of an orientation error of a linear axis: turns all that the axis carries", default=False),
            "meaning": text("In words"),
        }), "Further symbols of errors, as papers have them"),
        "controller": table("What its control assumes of programs", CONTROL_OF_PROGRAMS),
        "bodies": body_table("Bodies of the machine, for collisions", {
            "on!": text("bed, spindle, table, or an axis by its letter"),
            "ignore": texts("Bodies that it may touch"),
        }, "on! ignore"),
        "dynamics": DYNAMICS,
    }),
    files="machines/*.toml",
    readers=["kinematics/model/machine_file.cpp", "kinematics/model/machine_body.cpp", "dynamics/model_file.cpp",
             "dynamics/body_reader.cpp"])
