"""Every TOML file and every table of the tree is valid by its schema, and what is wrong is not."""

import copy
import csv
import io
import json
import os
import re
import sys
import tomllib
import unittest
from pathlib import Path

from kinds import ROOT, kind_of, schema_of

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("skipped: python3-jsonschema is not installed (scripts/setup --with-schemas)")
    sys.exit(77)

# Files of the fuzzers are wrong on purpose, or may be.
FUZZED = "tests/fuzz/"
LEAST_FILES = {"job": 14, "plan": 14, "machine": 8, "errors": 5, "study": 8, "identification": 5, "motion-test": 10,
               "values": 2}
# The machines of the benchmark are written by one command: one of them stands for all but in `make laws`.
FULL = os.environ.get("FRUSTUM_LAWS") == "full"


def files_of_tree(pattern):
    for folder in ("machines", "examples", "tests", "benchmark"):
        for file in sorted((ROOT / folder).rglob(pattern)):
            if FULL or not re.search(r"/m(0[2-9]|[12]\d)(/|\.csv)", str(file)):
                yield file


class FilesTest(unittest.TestCase):
    def test_schemas_are_schemas(self):
        schemas = sorted(ROOT.glob("schemas/*/*.schema.json"))
        self.assertGreater(len(schemas), 35)
        for file in schemas:
            Draft202012Validator.check_schema(json.loads(file.read_text()))

    def test_every_key_has_a_meaning(self):
        def nameless(schema, path):
            for name, each in schema.get("properties", {}).items():
                if not each.get("description"):
                    yield f"{path}.{name}"
            for key, each in schema.items():
                for inner in (each if isinstance(each, list) else each.values() if key == "properties" else [each]):
                    if isinstance(inner, dict) and key not in ("if", "then", "else", "allOf", "oneOf"):
                        yield from nameless(inner, f"{path}.{key}")

        for file in sorted(ROOT.glob("schemas/*/*.schema.json")):
            self.assertEqual(list(nameless(json.loads(file.read_text()), file.name)), [])

    def test_every_file_is_valid(self):
        validators, counts = {}, {}
        for file in files_of_tree("*.toml"):
            if FUZZED in str(file):
                continue
            document = tomllib.loads(file.read_text())
            kind = kind_of(document)
            if kind not in validators:
                validators[kind] = Draft202012Validator(schema_of("files", kind))
            wrong = [f"{'/'.join(map(str, each.absolute_path))}: {each.message[:200]}"
                     for each in validators[kind].iter_errors(document)]
            self.assertEqual(wrong, [], f"{file} as {kind}")
            counts[kind] = counts.get(kind, 0) + 1
        print("valid:", ", ".join(f"{n} {kind}" for kind, n in sorted(counts.items())))
        for kind, least in LEAST_FILES.items():
            self.assertGreaterEqual(counts.get(kind, 0), least, kind)


    def test_expected_numbers_are_valid_and_finite(self):
        validator = Draft202012Validator(json.loads(Path(__file__).with_name("data.schema.json").read_text()))

        def refuse(word):
            raise ValueError(f"{word} is no number")

        files = [*files_of_tree("*.json")]
        files = [file for file in files if "tests/data" in str(file)]
        self.assertGreater(len(files), 8)
        for file in files:
            validator.validate(json.loads(file.read_text(), parse_constant=refuse))


class WrongFilesTest(unittest.TestCase):
    """Each of these the program refuses, too."""

    def refused(self, file, change):
        document = tomllib.loads((ROOT / file).read_text())
        validator = Draft202012Validator(schema_of("files", kind_of(document)))
        self.assertTrue(validator.is_valid(document))
        changed = copy.deepcopy(document)
        change(changed)
        self.assertFalse(validator.is_valid(changed))

    def test_misspelt_and_missing_keys_wrong_types_units_and_combinations(self):
        machine, job, plan = "machines/iwf-bc.toml", "examples/cone/job.toml", "examples/cone/cone.plan.toml"
        self.refused(machine, lambda d: d.update(titel="Misspelt"))
        self.refused(machine, lambda d: d.pop("structure"))
        self.refused(machine, lambda d: d["axis"].update(U=d["axis"]["X"]))
        self.refused(machine, lambda d: d["axis"]["X"].update(travel=[1]))
        self.refused(machine, lambda d: d["axis"]["X"].update(direction="1, 0, 0"))
        self.refused(job, lambda d: d["blank"].update(shape="ball"))
        self.refused(job, lambda d: d["blank"].update(bottom_diameter=10))
        self.refused(job, lambda d: d["tool"]["1"].update(diameter="12 litres"))
        self.refused(job, lambda d: d["tool"]["1"].update(end_radius=5))
        self.refused(job, lambda d: d.update(errors={"EXX": {"linaer": "10 um"}}))
        self.refused(job, lambda d: d["inspection"].update(cmm={"e0": 0.5}))
        self.refused(plan, lambda d: d["feature"][0].update(kind="spline"))
        self.refused(plan, lambda d: d["characteristic"][0].update(tolerance=8))
        self.refused(plan, lambda d: d["probe"].update(ball_diameter=-2))
        self.refused("examples/ballbar/circle.toml", lambda d: d.update(targets=[0, 1]))
        self.refused("examples/ballbar/circle.toml", lambda d: d.update(test="square"))
        self.refused("examples/jang-study/general.toml", lambda d: d.update(samples=0))
        self.refused("examples/jang-study/general.toml", lambda d: d.update(motion="circle.toml"))


# --- tables --------------------------------------------------------------------------------------

DATATYPES = {"number": re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"), "integer": re.compile(r"[+-]?\d+"),
             "string": re.compile(r".*", re.S)}


def faults_of(text, table):
    """What is wrong with a table by its metadata: columns, missing ones, cells."""
    lines = "".join(line for line in text.splitlines(True) if not line.startswith("#") and line.strip())
    # Traces of other programs are separated by semicolons; the header has no other use for them.
    separator = ";" if ";" in lines.split("\n", 1)[0] else ","
    rows = list(csv.reader(io.StringIO(lines), skipinitialspace=True, delimiter=separator))
    columns = table["tableSchema"]["columns"]
    faults, of_columns = [], []
    header = [name.strip() for name in rows[0]]
    for name in header:
        exact = [each for each in columns if each["titles"] == name and "urn:frustum:columnPattern" not in each]
        alike = [each for each in columns if re.fullmatch(each.get("urn:frustum:columnPattern", "(?!)"), name)]
        if not exact and not alike:
            return [f"no column {name}"]
        of_columns.append((exact or alike)[0])
    faults += [f"column {each['titles']} is missing" for each in columns
               if each["required"] and each["titles"] not in header]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(header):
            return [f"row {number} has {len(row)} cells"]
        for cell, each in zip(row, of_columns):
            filled = cell.strip()
            if filled == "" and not each["required"]:
                continue
            if separator == ";":
                filled = filled.replace(",", ".")
            if not DATATYPES[each["datatype"]].fullmatch(filled):
                return [f"row {number}: '{cell}' is no {each['datatype']}"]
    return faults


TABLES = {file.name.removesuffix(".csv-metadata.json"): json.loads(file.read_text())
          for file in sorted((ROOT / "schemas" / "tables").glob("*.json"))}

# Of a file the table that it is, by the end of its path; the first that fits counts.
TABLE_OF = [
    (r"tests/data/.*\.csv", None),  # of our own, has its metadata here
    (r"ballbar/measured\.csv", "circle-trace"), (r"r-test/measured\.csv", "pose-trace"),
    (r"ballbar/table-8/.*\.csv", "turn-trace"), (r"/points\.csv", "points"), (r"/questions\.csv", "benchmark-questions"),
    (r"/poses\.csv", "benchmark-poses"), (r"/laws\.csv", "benchmark-laws"), (r"prior/m\d\d\.csv", "benchmark-prior"),
    (r"/predictions\.csv", "benchmark-predictions"), (r"submissions/.*/errors\.csv", "benchmark-errors"),
    (r"motion/rtest\.csv", "benchmark-rtest"), (r"motion/ballbar\.csv", "benchmark-ballbar"),
]


class TablesTest(unittest.TestCase):
    def test_metadata_say_what_they_describe(self):
        self.assertGreater(len(TABLES), 25)
        for name, table in TABLES.items():
            self.assertEqual(table["@context"][0], "http://www.w3.org/ns/csvw")
            names = [each["name"] for each in table["tableSchema"]["columns"]]
            self.assertEqual(len(set(names)), len(names), name)
            for each in table["tableSchema"]["columns"]:
                self.assertIn(each["datatype"], DATATYPES)
                self.assertTrue(each["dc:description"] or each["titles"])

    def test_every_table_is_valid(self):
        seen = 0
        for file in files_of_tree("*.csv"):
            if FUZZED in str(file):
                continue
            kinds = [kind for pattern, kind in TABLE_OF if re.search(pattern + "$", str(file))]
            self.assertTrue(kinds, f"{file} is of no known table")
            own = Path(__file__).with_name(f"{file.name}-metadata.json")
            table = TABLES[kinds[0]] if kinds[0] else json.loads(own.read_text())
            self.assertEqual(faults_of(file.read_text(), table), [], file)
            seen += 1
        print("valid:", seen, "tables")
        self.assertGreater(seen, 20)

    def test_wrong_tables_are_not_valid(self):
        table = TABLES["pose-trace"]
        self.assertEqual(faults_of("A_deg,C_deg,x_um,y_um,z_um\n0,0,1,2,3\n", table), [])
        self.assertTrue(faults_of("A_deg,C_deg,x_um,y_um\n0,0,1,2\n", table))
        self.assertTrue(faults_of("A_deg,C_deg,x_um,y_um,z_mm\n0,0,1,2,3\n", table))
        self.assertTrue(faults_of("A_deg,C_deg,x_um,y_um,z_um\n0,0,1,two,3\n", table))
        self.assertTrue(faults_of("A_deg,C_deg,x_um,y_um,z_um\n0,0,1,2\n", table))


if __name__ == "__main__":
    unittest.main()
