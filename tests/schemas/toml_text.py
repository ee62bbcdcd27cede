"""TOML of parsed TOML, with inline tables: for files of which the tests change a key."""

import json


def value_text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return "[" + ", ".join(value_text(each) for each in value) + "]"
    return "{ " + ", ".join(f"{json.dumps(key)} = {value_text(each)}" for key, each in value.items()) + " }"


def toml_text(document):
    return "".join(f"{json.dumps(key)} = {value_text(value)}\n" for key, value in document.items())
