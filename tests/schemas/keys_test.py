"""The schemas of files have the keys that the readers ask for: those in the readers' sources, and those that the
program suggests where one is misspelt."""

import os
import re
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

from kinds import ROOT, kind_of, schema_of
from reader_keys import keys_of
from toml_text import toml_text

from catalogue import FILES

PROGRAM = os.environ["FRUSTUM_PROGRAM"]

# What a reader's source asks for that is no key of this kind of file, since it also reads another kind, or looks
# whether the file is of another.
OF_OTHER_FILES = {
    "job": {"bodies", "ignore", "on", "source", "structure"},
    "machine": {"fixtures", "bed"},
    "errors": {"file"},
    "study": {"part", "program", "test", "source", "structure"},
    "identification": {"machine", "program", "target"},
    "motion-test": {"source", "structure", "table_ball", "title"},
}
# Keys whose names the readers put together.
COMPOSED = {
    "job": {"G54", "G55", "G56", "G57", "G58", "G59"},
    "motion-test": {"ball_um", "length_um", "table_ball_um"},
}


def properties_of(schema):
    found = set()
    if not isinstance(schema, dict):
        return found
    for name, each in schema.get("properties", {}).items():
        found |= {name} | properties_of(each)
    for each in (schema.get("items"), schema.get("additionalProperties"), *schema.get("patternProperties", {}).values(),
                 *schema.get("anyOf", [])):
        found |= properties_of(each)
    return found


class SourceTest(unittest.TestCase):
    def test_every_key_of_the_readers_is_in_the_schema_and_no_other(self):
        for kind in FILES:
            with self.subTest(kind.name):
                asked = set().union(*(keys_of(reader) for reader in kind.readers)) | COMPOSED.get(kind.name, set())
                stated = properties_of(kind.body).union(*(properties_of(each) for each in kind.defs.values()))
                self.assertGreater(len(asked), 2)
                self.assertEqual(asked - stated, OF_OTHER_FILES.get(kind.name, set()), "asked for, not in the schema")
                self.assertEqual(stated - asked, set(), "in the schema, not asked for")

    def test_every_reader_belongs_to_a_schema(self):
        known = {reader for kind in FILES for reader in kind.readers}
        # They look into files of other readers, or change them.
        others = {"app/job/named_files.cpp", "app/study/place_in_file.cpp", "app/command/cmm_option.cpp"}
        for source in ROOT.glob("*/**/*.cpp"):
            name = str(source.relative_to(ROOT))
            if name.startswith(("tests/", "build", "core/")) or "node_modules" in name:
                continue
            if re.search(r"TomlDocument::(load|parse)\(", source.read_text()):
                self.assertIn(name, known | others)


def resolved(schema, root):
    while "$ref" in schema:
        schema = root["$defs"][schema["$ref"].rsplit("/", 1)[1]]
    return schema


def allowed_keys(schema, value):
    """The keys of a table that its schema allows beside those that are there; None where it does not say."""
    if schema.get("x-loose"):
        return set(value)
    keys = set(schema.get("properties", {}))
    rule = schema
    while "propertyNames" in rule.get("then", {}):
        condition = rule["if"]["properties"]
        if all(value.get(key) == each["const"] if key in value else key not in rule["if"].get("required", [])
               for key, each in condition.items()):
            keys &= set(rule["then"]["propertyNames"]["enum"])
        rule = rule.get("else", {})
    return {key for key in keys if set(schema.get("dependentRequired", {}).get(key, [])) <= set(value)}


def misspelt(value, schema, root, expected):
    """The document with each allowed key of each table beside a misspelt one; `expected`: what is to be suggested."""
    schema = resolved(schema, root)
    if isinstance(value, list):
        items = resolved(schema.get("items", {}), root)
        if "anyOf" in schema:
            items = next((resolved(each, root).get("items", {}) for each in schema["anyOf"]
                          if each.get("type") == "array"), {})
        return [misspelt(each, items, root, expected) for each in value]
    if not isinstance(value, dict):
        return value
    if "anyOf" in schema and "properties" not in schema and "additionalProperties" not in schema:
        tables = [resolved(each, root) for each in schema["anyOf"]]
        schema = next((each for each in tables if each.get("type") == "object"), {})
    changed = {}
    others = list(schema.get("patternProperties", {}).values()) or [schema.get("additionalProperties")]
    for key, each in value.items():
        inner = schema.get("properties", {}).get(key, others[0] if isinstance(others[0], dict) else {})
        changed[key] = misspelt(each, inner, root, expected)
    if schema.get("additionalProperties") is False and "patternProperties" not in schema:
        for key in sorted(allowed_keys(schema, value)):
            wrong = key + "_"
            changed[wrong] = 0
            expected.append((wrong, key))
    return changed


# For each kind of file: the command that reads FILE, which lies beside what its folder has.
READ_BY = [
    ("machines/iwf-bc.toml", ["errors", "FILE"]),
    ("machines/zx-yac.toml", ["errors", "FILE"]),
    ("machines/iwf-bc.toml", ["dynamics", "FILE"]),
    ("examples/dynamics/cantilever-original.toml", ["dynamics", "FILE"]),
    ("examples/cone/job.toml", ["check", "--job", "FILE"]),
    ("examples/parts/crown/job.toml", ["check", "--job", "FILE"]),
    ("examples/parts/flange/job.toml", ["check", "--job", "FILE"]),
    ("examples/cone/cone.plan.toml", ["measure", "--plan", "FILE", "--points", "none.csv"]),
    ("examples/ibaraki-2010/workpiece-1/step.plan.toml", ["measure", "--plan", "FILE", "--points", "none.csv"]),
    ("examples/jang-study/general.toml", ["study", "FILE"]),
    ("examples/ballbar/machines.toml", ["study", "FILE"]),
    ("examples/ibaraki-2010/study.toml", ["identify", "FILE"]),
    ("examples/r-test/study.toml", ["identify", "FILE"]),
    ("examples/ballbar/circle.toml", ["motion", "run", "FILE"]),
    ("examples/ballbar/rotary-c.toml", ["motion", "run", "FILE"]),
    ("examples/r-test/grid.toml", ["motion", "run", "FILE"]),
    ("examples/touch-probe/calibration.toml", ["motion", "run", "FILE"]),
    ("examples/ibaraki-2010/table-5.toml", ["identify", "study.toml"]),
    ("machines/errors/bossoni-cone-limits.toml", ["pose", "iwf-bc", "--axes", "X=1", "--errors", "FILE"]),
]


class SuggestionTest(unittest.TestCase):
    def test_the_program_knows_every_key_of_the_schema_where_the_schema_has_it(self):
        for name, words in READ_BY:
            with self.subTest(f"{name} by {words[0]}"), tempfile.TemporaryDirectory() as folder:
                self.read(ROOT / name, words, Path(folder))

    def read(self, source, words, folder):
        # Beside it is what it names: its folder, and those beside that.
        for beside in source.parent.parent.iterdir():
            if beside != source.parent:
                (folder / beside.name).symlink_to(beside)
        (folder / source.parent.name).mkdir()
        for beside in source.parent.iterdir():
            if beside != source:
                (folder / source.parent.name / beside.name).symlink_to(beside)
        file = folder / source.parent.name / source.name
        document = tomllib.loads(source.read_text())
        schema = schema_of("files", kind_of(document))
        expected = []
        # [dynamics] has a reader of its own, which comes after that of the axes.
        changed = document
        if words[0] == "dynamics":
            within = schema["properties"]["dynamics"]
            changed = {**document, "dynamics": misspelt(document["dynamics"], within, schema, expected)}
        else:
            changed = misspelt({key: each for key, each in document.items() if key != "dynamics"}, schema, schema,
                               expected)
        file.write_text(toml_text(changed))
        done = subprocess.run([PROGRAM, *(str(file) if word == "FILE" else word for word in words)], text=True,
                              capture_output=True, cwd=file.parent)
        self.assertEqual(done.returncode, 2, done.stderr)
        said = {}
        for key, meant in re.findall(r"\b([A-Za-z_0-9]+_)(?:'|\"|:| ).*?unknown key.*?did you mean ([A-Za-z_0-9]+)\?",
                                     done.stderr):
            said.setdefault(key, set()).add(meant)
        for wrong, key in expected:
            self.assertIn(key, said.get(wrong, set()), f"{wrong}: {done.stderr[:2000]}")


# Kinds of which the tree has no file: name and text of one, and the command that reads it in examples/cone.
WRITTEN = [
    ("tools.toml", "tools", "title = 'Mine'\ntool.1 = { type = 'flat', diameter = 12, length = 150 }\n"
     "tool.2 = { type = 'barrel', diameter = 10, flank_radius = 80, flute_length = 30, length = 120 }\n"
     "tool.3 = { type = 'apt', D = 10, H = 20, length = 120 }\n", ["check", "--job", "job.toml"]),
    ("cmm.toml", "cmm", "e0 = '0.5 um'\nl_per_um = 600\nmodel = 'field'\nstylus = { length = 50, diameter = 2 }\n"
     "probe = { force = 0.1 }\ntemperature = { compensated = true }\n",
     ["measure", "--plan", "cone.plan.toml", "--points", "points.csv", "--cmm", "cmm.toml"]),
    (".frustum.toml", "check-settings", "machine = 'iwf-bc'\ncontroller = { units = 'mm' }\n", ["check", "."]),
]


class WrittenFilesTest(unittest.TestCase):
    def test_the_program_knows_their_keys(self):
        for name, kind, text, words in WRITTEN:
            with self.subTest(kind), tempfile.TemporaryDirectory() as place:
                folder = Path(place)
                for beside in (ROOT / "examples" / "cone").iterdir():
                    (folder / beside.name).write_text(beside.read_text())
                job = folder / "job.toml"
                if kind == "tools":
                    job.write_text("tools = 'tools.toml'\n" + re.sub(r"(?m)^tool\.1.*\n", "", job.read_text()))
                (folder / "points.csv").write_text("feature,section,x,y,z\ncone,0,1,2,3\n")
                schema, expected = schema_of("files", kind), []
                (folder / name).write_text(toml_text(misspelt(tomllib.loads(text), schema, schema, expected)))
                done = subprocess.run([PROGRAM, *words], text=True, capture_output=True, cwd=folder)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertGreater(len(expected), 10)
                for wrong, key in expected:
                    self.assertRegex(done.stderr, rf"\b{wrong}(?![a-z_]).*unknown key.*did you mean {key}\?", done.stderr)


if __name__ == "__main__":
    unittest.main()
