"""Frustum: a virtual five-axis machine tool.

An NC program goes in, a CMM report comes out; machines may have any geometric error of ISO 230-1.
Lengths are mm, angles degrees; deviations and characteristics um and urad. What is wrong with an input
raises InputError, whose `diagnostics` name file, line, what was wrong and what was expected.
"""

import json as _json
import os as _os
import tempfile as _tempfile

from ._frustum import InputError, Machine, Population, Workpiece, __version__, fit, machines
from . import _frustum

__all__ = [
    "Answer", "InputError", "Job", "Machine", "Population", "Program", "Trial", "Workpiece",
    "dynamics", "fit", "identify", "machines", "motion", "study",
]


def _path(file):
    return _os.fspath(file)


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


class Answer(dict):
    """A document as `frustum COMMAND --json` prints it; notebooks show its numbers, and traces as a polar chart."""

    def _repr_html_(self):
        rows = []

        def walk(name, value):
            if isinstance(value, dict):
                for key, each in value.items():
                    walk(f"{name}.{key}" if name else key, each)
            elif isinstance(value, list) and value and all(isinstance(each, dict) for each in value):
                # Characteristics, estimates and what else has a name.
                for number, each in enumerate(value):
                    walk(f"{name}[{each.get('name', number)}]", {k: v for k, v in each.items() if k != "name"})
            elif _is_number(value) or isinstance(value, str):
                rows.append((name, f"{value:.6g}" if isinstance(value, float) else str(value)))

        walk("", self)
        return _table(("quantity", "value"), rows)

    def _repr_svg_(self):
        angles = self.get("angles_deg")
        traces = {name: self[name] for name in ("ccw_um", "cw_um", "reading_um") if name in self}
        numbers = [angles or [], *traces.values()]
        drawable = angles and traces and all(_is_number(each) for of in numbers for each in of)
        return _polar(angles, traces) if drawable else None


def _escaped(text):
    return str(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _table(heads, rows):
    head = "".join(f"<th>{_escaped(each)}</th>" for each in heads)
    body = "".join("<tr>" + "".join(f"<td>{_escaped(each)}</td>" for each in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _polar(angles, traces, size=360):
    """Readings about their mean circle, magnified so that the largest is a third of its radius."""
    from math import cos, pi, sin

    middle, radius = size / 2, size / 3
    largest = max((abs(v) for trace in traces.values() for v in trace), default=0.0) or 1.0
    colours = ("#0b6fa4", "#b04a1f", "#3d7a37")
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size} {size}" width="{size}" height="{size}" '
        f'role="img" aria-label="Readings about their circle, largest {largest:.4g} um">',
        f'<circle cx="{middle}" cy="{middle}" r="{radius:.3f}" fill="none" stroke="#999"/>',
    ]
    for colour, (name, trace) in zip(colours, traces.items()):
        points = []
        for angle, value in zip(angles, trace):
            r = radius * (1 + value / (3 * largest))
            points.append(f"{middle + r * cos(angle * pi / 180):.2f},{middle - r * sin(angle * pi / 180):.2f}")
        parts.append(f'<polyline points="{" ".join(points)}" fill="none" stroke="{colour}"/>')
    labels = ", ".join(f"{name[:-3]} ({colour})" for colour, name in zip(("blue", "red", "green"), traces))
    parts.append(f'<text x="8" y="{size - 8}" font-size="11">{labels}; largest {largest:.4g} um</text></svg>')
    return "".join(parts)


class Program:
    """An NC program; `motions` are its canonical motions, a dict each, as `frustum parse --canon` prints them.

    dialect: fanuc, linuxcnc, sinumerik, heidenhain or cldata; recognised from the file where it is not given.
    """

    def __init__(self, file, dialect=""):
        self.file = _path(file)
        self.motions = [_json.loads(line) for line in _frustum._motions(self.file, dialect)]

    def __repr__(self):
        return f"frustum.Program({self.file!r}, {len(self)} motions)"

    def __len__(self):
        return len(self.motions)

    def __iter__(self):
        return iter(self.motions)


class Trial:
    """One machine that has cut and measured one part."""

    def __init__(self, made):
        self._made = made

    def __repr__(self):
        return f"frustum.Trial({len(self.values)} characteristics, {'pass' if self.passes else 'fail'})"

    @property
    def values(self):
        """Value of each characteristic, in `units`."""
        return self._made.values

    @property
    def units(self):
        return self._made.units

    @property
    def passes(self):
        return self._made.passes

    @property
    def cycle_time(self):
        """s"""
        return self._made.cycle_time

    @property
    def points(self):
        """By feature: point, normal (n, 3) in the datum system, deviation (n,) in um from the fitted element."""
        return self._made.points

    @property
    def workpiece(self):
        return self._made.workpiece

    def document(self):
        """As result.json of `frustum run`, without surface, proof and timings."""
        return Answer(_json.loads(self._made.json()))

    def _repr_html_(self):
        units = self.units
        return _table(("characteristic", "value", "unit"),
                      [(name, f"{value:.4f}", units[name]) for name, value in self.values.items()])


class Job:
    """A job file: machine, program, blank and inspection plan.

    errors: a dict {"EX0C": "10 um"}, the name of an error file, or a list of them; they go before the job's own.
    draw: seed of errors that are written as distributions.
    """

    def __init__(self, file):
        self.file = _path(file)

    def __repr__(self):
        return f"frustum.Job({self.file!r})"

    def trial(self, errors=None, draw=None, tool_radius_error=None):
        return Trial(_frustum._trial(self.file, errors, draw, tool_radius_error))

    def path(self, errors=None, draw=None):
        """Where the tool goes in the workpiece frame: axis_names, axes (n, axes), tip, direction (n, 3),
        time (n,) in s, line (n,) of the NC program. Between rows it goes straight, within the job's path bound."""
        return _frustum._path(self.file, errors, draw)

    def sensitivity(self, parameters=(), errors=None):
        """Derivatives of the characteristics (mm, rad) to machine errors (mm, rad): odd and even part, each
        (characteristics, parameters)."""
        parameters = [parameters] if isinstance(parameters, str) else list(parameters)
        return _frustum._sensitivity(self.file, parameters, errors)


def study(file, samples=None, seed=None, scheme="", engine="", errors=None, out=None):
    """Draws the machines of a study and evaluates them: the document of `frustum study`. out: a folder for the
    samples, which are not kept without it."""
    out = None if out is None else _path(out)
    return Answer(_json.loads(_frustum._study(_path(file), samples, seed, scheme, engine, errors, out)))


def identify(file):
    """Machine errors that explain measured parts and motion tests: the document of `frustum identify`."""
    return Answer(_json.loads(_frustum._identify(_path(file))))


def _toml(value):
    if hasattr(value, "tolist"):  # of numpy
        value = value.tolist()
    if hasattr(value, "__fspath__"):
        value = _os.fspath(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if _is_number(value):
        return repr(value)
    if isinstance(value, str):
        return _json.dumps(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_json.dumps(str(k))} = {_toml(v)}" for k, v in value.items()) + "}"
    return "[" + ", ".join(_toml(each) for each in value) + "]"


def motion(test, errors=None, draw=None, **keys):
    """A motion test: a test file, or a kind of test (circle, rotary, cone, chase, line, diagonal, touch) with the
    keys of its file (none where a value is None), for example motion("circle", machine="iwf-bc", plane="XY", center=[0, 0, 150]).

    The document of `frustum motion`, with `warnings`."""
    if not keys:
        document, warnings = _frustum._motion(_path(test), errors, draw)
    else:
        lines = [f"test = {_toml(test)}"] + [
            f"{_json.dumps(key)} = {_toml(value)}" for key, value in keys.items() if value is not None]
        with _tempfile.TemporaryDirectory() as folder:
            file = _os.path.join(folder, "test.toml")
            with open(file, "w", encoding="utf-8") as out:
                out.write("\n".join(lines) + "\n")
            document, warnings = _frustum._motion(file, errors, draw)
    answer = Answer(_json.loads(document))
    answer["warnings"] = warnings
    return answer


def dynamics(machine, axes="", tool_length=0.0, frequencies="", rates="", map="", quantity="", modes=20):
    """Modes, compliances and deviations in motion of a machine with [dynamics]: the document of
    `frustum dynamics`, whose words the arguments are: axes="X=0,Y=10", frequencies="1:200"."""
    return Answer(_json.loads(
        _frustum._dynamics(_path(machine), axes, tool_length, frequencies, rates, map, quantity, modes)))
