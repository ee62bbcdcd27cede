"""Words in which the schemas are written: each makes a piece of JSON Schema (draft 2020-12) as a dict.

A key that ends in "!" is required. Every key has a description; its unit is in it, or in the key's name.
"""

from meanings import described as with_meanings

NUMBER = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"
LENGTHS = "mm|um|µm|μm|nm|m|in|inch"
ANGLES = "rad|mrad|urad|µrad|μrad|deg|arcsec"
DIALECTS = ["fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain", "cldata"]


def described(schema, about):
    return {"description": about, **schema} if about else schema


def text(about="", **more):
    return described({"type": "string", **more}, about)


def flag(about="", **more):
    return described({"type": "boolean", **more}, about)


def number(about="", **more):
    return described({"type": "number", **more}, about)


def positive(about="", **more):
    return number(about, exclusiveMinimum=0, **more)


def share(about=""):
    return number(about, minimum=0, maximum=1)


def integer(about="", **more):
    return described({"type": "integer", **more}, about)


def count(about="", least=0, **more):
    return integer(about, minimum=least, **more)


def choice(words, about="", **more):
    return described({"type": "string", "enum": list(words), **more}, about)


def constant(value, about=""):
    return described({"const": value}, about)


def any_of(about, *schemas):
    return described({"anyOf": list(schemas)}, about)


def or_null(schema):
    """The same, or null: what is not known or does not exist."""
    about = schema.get("description", "")
    rest = {k: v for k, v in schema.items() if k != "description"}
    if set(rest) == {"$ref"} or "type" not in rest or "enum" in rest:
        return any_of(about, rest, {"type": "null"})
    kinds = rest["type"] if isinstance(rest["type"], list) else [rest["type"]]
    return described({**rest, "type": [*kinds, "null"]}, about)


def _quantity(about, units, bare, bound):
    limits = {"positive": {"exclusiveMinimum": 0}, "non_negative": {"minimum": 0}}.get(bound, {})
    # One type with limits of either kind: editors would offer a key twice that is any of two.
    schema = {"type": ["number", "string"], **limits, "pattern": rf"^\s*{NUMBER}\s*({units})?\s*$", "x-unit": bare}
    return described(schema, about)


def length(about, bound="any", **more):
    """A bare number is mm; a text has its unit."""
    return {**_quantity(about, LENGTHS, "mm", bound), **more}


def angle(about, bound="any", **more):
    """A bare number is degrees; a text has its unit."""
    return {**_quantity(about, ANGLES, "deg", bound), **more}


def _stated(about, units):
    pattern = rf"^\s*{NUMBER}\s*({units})?\s*$"
    return described({"type": ["string", "number"], "minimum": 0, "maximum": 0, "pattern": pattern}, about)


def stated_length(about):
    """A text with its unit; a bare number other than 0 is refused, since um are meant."""
    return _stated(about, LENGTHS)


def stated_amount(about):
    """A length or an angle as a text with its unit; a bare number other than 0 is refused."""
    return _stated(about, f"{LENGTHS}|{ANGLES}")


def list_of(items, about="", **more):
    return described({"type": "array", "items": items, **more}, about)


def texts(about="", **more):
    return list_of({"type": "string"}, about, **more)


def numbers(about="", size=None, **more):
    sizes = {"minItems": size, "maxItems": size} if size else {}
    return list_of({"type": "number"}, about, **sizes, **more)


def vector(about, **more):
    return numbers(about, 3, **more)


def rows(width, about=""):
    return list_of(numbers(size=width), about)


def matrix(about=""):
    return list_of(list_of({"type": "number"}), about)


def complex_number(about=""):
    return numbers(about, 2)


def table(about, keys, closed=True, **more):
    properties, required = {}, []
    for name, schema in keys.items():
        if name.endswith("!"):
            name = name[:-1]
            required.append(name)
        properties[name] = schema
    schema = {"type": "object", "properties": properties}
    if required:
        schema["required"] = required
    if closed:
        schema["additionalProperties"] = False
    return described({**schema, **more}, about)


def tables(about, keys, **more):
    return list_of(table("", keys, **more), about)


def map_of(values, about, names=None, **more):
    """A table whose keys are names that the user chooses, or those that match a pattern."""
    if names:
        rest = {"patternProperties": {names: values}, "additionalProperties": False}
    else:
        rest = {"additionalProperties": values}
    return described({"type": "object", **rest, **more}, about)


def loosely(schema):
    """Which keys go together hangs on more than one of them: the program says it, not the schema."""
    return {**schema, "x-loose": True}


def ref(name, about=""):
    return described({"$ref": f"#/$defs/{name}"}, about)


def with_keys(schema, keys):
    """A table with further keys."""
    more = table("", keys)
    joined = {**schema, "properties": {**schema["properties"], **more["properties"]}}
    required = schema.get("required", []) + more.get("required", [])
    if required:
        joined["required"] = required
    return joined


def by(key, cases, otherwise=None):
    """Which keys go with which value of `key`: {value: "needed! needed! allowed allowed"}.

    The words are those of a table: with "!" required. `otherwise`: the value where the key is absent.
    """
    chain = {}
    for value, words in reversed(cases.items()):
        names = [word.rstrip("!") for word in words.split()]
        needed = [word[:-1] for word in words.split() if word.endswith("!")]
        condition = {"properties": {key: {"const": value}}}
        if value != otherwise:
            condition["required"] = [key]
        then = {"propertyNames": {"enum": [key, *names]}}
        if needed:
            then["required"] = needed
        # A chain of conditions, since editors complete no keys of a table with allOf.
        chain = {"if": condition, "then": then, **({"else": chain} if chain else {})}
    return chain


class Schema:
    """A kind of file or document: its name, version, where files of it are, and what it says."""

    def __init__(self, name, version, title, body, files="", readers=(), defs=None):
        self.name, self.version, self.title = name, version, title
        self.body, self.defs = with_meanings(body), {key: with_meanings(each) for key, each in (defs or {}).items()}
        self.files, self.readers = files, readers

    def document(self):
        about = self.body.get("description", "")
        rest = {k: v for k, v in self.body.items() if k != "description"}
        document = {
            "$schema": "https://json-schema.org/draft/2020-12/schema",
            "$id": f"urn:frustum:schema:{self.name}:{self.version}",
            "title": self.title,
            "description": about,
            "version": self.version,
            **rest,
        }
        if self.defs:
            document["$defs"] = self.defs
        return document
