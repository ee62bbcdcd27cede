"""Which kind of file a TOML file is, and the schemas by name."""

import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "schemas" / "source"))
sys.dont_write_bytecode = True


def kind_of(document):
    """The name of the schema of a TOML document, by the keys that its kind alone has."""
    if "axis" in document and "structure" in document:
        return "machine"
    if "test" in document:
        return "motion-test"
    if "program" in document:
        return "job"
    if "probe" in document and "feature" in document:
        return "plan"
    if "part" in document or isinstance(document.get("motion"), list):
        return "identification"
    if {"job", "motion", "target"} & set(document):
        return "study"
    if "result" in document:
        return "history"
    if "measured" in document:
        return "values"
    if "errors" in document:
        return "errors"
    if "tool" in document:
        return "tools"
    return "check-settings"


def schema_of(family, name):
    return json.loads((ROOT / "schemas" / family / f"{name}.schema.json").read_text())
