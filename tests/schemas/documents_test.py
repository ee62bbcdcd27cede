"""The documents and tables that the commands write are valid by their schemas, and say which schema that is."""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from kinds import ROOT, schema_of

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("skipped: python3-jsonschema is not installed (scripts/setup --with-schemas)")
    sys.exit(77)

from files_test import TABLES, faults_of

PROGRAM = os.environ["FRUSTUM_PROGRAM"]
VERSION = re.search(r"project\(Frustum VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
CONE = "program cone --machine iwf-bc --center=-65,0,150 --radius 25 --chord-tolerance 0.5 --out piece"
FULL = os.environ.get("FRUSTUM_LAWS") == "full"

# Each of them has its form in `schema`. In their order: later ones read what earlier ones wrote.
DOCUMENTS = [
    CONE,
    "run piece/job.toml --out out --error EX0C=10um --export out/c.csv",
    "run none.toml",
    "measure --plan piece/cone.plan.toml --points out/points.csv --e0 0.5um",
    "sensitivity piece/job.toml --parameter EX0C --parameter EB0C --out sensitivity",
    "cut piece/job.toml --mesh part.ply --pitch 6 --snapshots 1 --removal removal.csv",
    "cut piece/job.toml --point 0,0,0",
    "parse piece/cone.nc",
    "check piece/cone.nc --job piece/job.toml",
    "check piece/cone.nc piece/cone.nc",
    "pose iwf-bc --axes X=1,C=30 --error EX0C=10um",
    "pose iwf-bc --inverse 0,0,100,0,0.6,0.8",
    "errors iwf-bc",
    "fit circle2d out/points.csv --feature cylinder",
    "fit cylinder out/points.csv --feature cylinder --criterion mz",
    "post piece/cone.nc --job piece/job.toml --to sinumerik --output axes -o cone.mpf",
    "diff piece/cone.nc cone.mpf --job piece/job.toml",
    "diff piece/cone.nc piece/other.nc --job piece/job.toml",
    "compensate piece/job.toml --error EX0C=20um --out compensated",
    "cmm piece/job.toml",
    "cmm piece/job.toml --seeds 3",
    "volumetric iwf-bc --error EXX=linear_10um --grid 2 --out volume",
    "dynamics iwf-bc --axes Z=300 --tool-length 150 --frf 20,57 --rates X=0.1:1 --circle XY --radius 50 --feed 10000 "
    "--move X:100:0.5:4:100 --map Y=-300:300:3,Z=-100:500:3 --out dynamics",
    "identify {root}/examples/r-test/study.toml",
    "design --machine zx-yac --patterns 1-a",
    "study {root}/examples/jang-study/proposed.toml --samples 200 --out study --csv draws.csv",
    "motion circle --machine iwf-bc --plane XY --length 150 --center 0,0,150 --angles 0,45,90,135,180,225,270,315 "
    "--error EC0Y=20urad --out circle",
    "motion rotary --machine zx-yac --axis C --direction radial --ball 100,0,100 --length 150 --angles 0,90,180,270 "
    "--out rotary",
    "motion cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 --center=-65,0,150 --angles 0,90,180,270 "
    "--out cone",
    "motion chase --machine zx-yac --ball 80,30,60 --at A=0,C=0;A=-30,C=60 --out chase",
    "motion line --machine iwf-bc --axis X --targets 0,50,100 --runs 2 --out line",
    "motion diagonal --machine iwf-bc --box X=-100:100,Y=-100:100,Z=100:200 --points 3 --out diagonal",
    "motion touch --machine ac-probe --noise 0.35um --repeat 2 --out touch",
    "motion vectors --machine zx-yac --error EX0C=10um --out vectors",
    "motion trace {root}/examples/ballbar/measured.csv --plane XY --length 150",
    "motion trace line/trace.csv --axis X",
    "motion trace touch/touches.csv --machine ac-probe --noise 0.35um",
    "motion run circle/test.toml",
    "benchmark score {root}/benchmark {root}/benchmark/submissions/frustum-prior",
    "reference",
    "tools piece/job.toml",
    "view piece/job.toml --snapshots 0 --out played",
    "history {root}/examples/history --out history",
    "compare part_0001.ply part_0001.ply --tolerance 1um",
]
# What takes seconds, in `make laws`.
if FULL:
    DOCUMENTS += [
        "identify {root}/examples/ibaraki-2010/study.toml",
        "design --machine zx-yac",
        "benchmark verify {root}/benchmark --only m01",
    ]
# Without a form in `schema`.
LISTS = [("machines", "machines"), ("motion names", "motion-names")]
# Files written on the way, and the tables that they are.
WRITTEN = [
    ("out/points.csv", "points"), ("out/c.csv", "characteristics"), ("sensitivity/sensitivity.csv", "sensitivity"),
    ("removal.csv", "removal"), ("draws.csv", "samples"), ("dynamics/frf.csv", "frf"), ("dynamics/map.csv", "map"),
    ("circle/trace.csv", "circle-trace"), ("rotary/trace.csv", "turn-trace"), ("cone/trace.csv", "turn-trace"),
    ("chase/trace.csv", "pose-trace"), ("line/trace.csv", "line-trace"), ("diagonal/trace.csv", "diagonal-trace"),
    ("touch/touches.csv", "touches"), ("vectors/vectors.csv", "vectors"),
]


class DocumentsTest(unittest.TestCase):
    validators = {}

    def validate(self, name, document, what):
        if name not in self.validators:
            self.validators[name] = Draft202012Validator(schema_of("documents", name))
        wrong = [f"{'/'.join(map(str, each.absolute_path))}: {each.message[:300]}"
                 for each in self.validators[name].iter_errors(document)]
        self.assertEqual(wrong[:5], [], what)

    def printed(self, words, folder):
        arguments = [word.replace("{root}", str(ROOT)).replace("_", " ") if word.startswith("EXX=") else
                     word.replace("{root}", str(ROOT)) for word in words.split()]
        done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, cwd=folder)
        self.assertIn(done.returncode, (0, 1, 2), done.stderr)
        self.assertTrue(done.stdout, f"{words}: {done.stderr}")
        return done.stdout

    def test_documents_of_commands(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            seen = {self.of_command(DOCUMENTS[0], folder)}
            program, job = folder / "piece" / "cone.nc", folder / "piece" / "job.toml"
            (folder / "piece" / "other.nc").write_text(program.read_text().replace("X1", "X2", 40))
            job.write_text(job.read_text().replace("report = true", "report = false"))
            seen |= {self.of_command(words, folder) for words in DOCUMENTS[1:]}
            for words, kind in LISTS:
                self.validate(kind, json.loads(self.printed(words + " --json", folder)), words)
                seen.add(kind)
            for line in self.printed("parse piece/cone.nc --canon", folder).splitlines():
                self.validate("canonical-motion", json.loads(line), line)
            seen.add("canonical-motion")
            self.of_files(folder, seen)
        for file in sorted((ROOT / "benchmark" / "answers").glob("*.json")):
            self.validate("benchmark-answers", json.loads(file.read_text()), file)
        self.validate("benchmark-commitments", json.loads((ROOT / "benchmark" / "commitments.json").read_text()), "")
        seen |= {"benchmark-answers", "benchmark-commitments"}
        known = {file.name.removesuffix(".schema.json") for file in (ROOT / "schemas" / "documents").glob("*.json")}
        # serve runs until it is stopped; a design of pieces and tests takes half a minute.
        self.assertEqual(known - seen, {"serve", "test-design"})

    def of_command(self, words, folder):
        document = json.loads(self.printed(words + " --json --quiet", folder))
        schema = re.fullmatch(r"frustum/([a-z-]+)/\d+", document["schema"])
        self.assertTrue(schema, words)
        self.assertEqual(document["version"], VERSION, words)
        if words.startswith("run none"):
            self.assertEqual(schema.group(1), "failure")
        else:
            self.assertNotEqual(schema.group(1), "failure", f"{words}: {document}")
        self.validate(schema.group(1), document, words)
        return schema.group(1)

    def of_files(self, folder, seen):
        self.printed("check piece/cone.nc --job piece/job.toml --baseline known.json --write-baseline --json", folder)
        for file in sorted(folder.rglob("*.json")):
            document = json.loads(file.read_text())
            if "schema" in document:
                name = document["schema"].split("/")[1]
                self.assertEqual(document["version"], VERSION, file)
            else:
                name = "baseline"
            self.validate(name, document, file)
            seen.add(name)
        for name, kind in WRITTEN:
            self.assertEqual(faults_of((folder / name).read_text(), TABLES[kind]), [], name)


if __name__ == "__main__":
    unittest.main()
