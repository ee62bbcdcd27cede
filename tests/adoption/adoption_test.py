"""CITATION.cff, the recipes of examples/ci, the container file and scripts/release hold what they say."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["FRUSTUM_PROGRAM"]
VERSION = re.search(r"project\(Frustum VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)

# The public schema of CFF 1.2.0: what it needs, and what it knows at the top.
CFF_NEEDED = {"authors", "cff-version", "message", "title"}
CFF_KNOWN = CFF_NEEDED | {
    "abstract", "commit", "contact", "date-released", "doi", "identifiers", "keywords", "license", "license-url",
    "preferred-citation", "references", "repository", "repository-artifact", "repository-code", "type", "url", "version"}


class CitationTest(unittest.TestCase):
    def test_it_has_what_the_public_schema_needs_and_is_of_this_version(self):
        text = (ROOT / "CITATION.cff").read_text()
        keys = re.findall(r"^([a-z-]+):", text, re.M)
        self.assertEqual(len(keys), len(set(keys)))
        self.assertLessEqual(CFF_NEEDED, set(keys))
        self.assertLessEqual(set(keys), CFF_KNOWN)
        self.assertRegex(text, r"(?m)^cff-version: 1\.2\.0$")
        self.assertRegex(text, rf"(?m)^version: {re.escape(VERSION)}$")
        self.assertRegex(text, r"(?m)^type: software$")
        self.assertRegex(text, r"(?m)^license: Apache-2\.0$")
        self.assertRegex(text, r"(?m)^authors:\n  - name: \S")


def commands_of(recipe):
    """The commands of `frustum` in a recipe, in their order."""
    return re.findall(r"^\s*(?:- )?(frustum .*)$", (ROOT / "examples" / "ci" / recipe).read_text(), re.M)


class RecipesTest(unittest.TestCase):
    """A repository with parts/ is checked by the commands of the recipe, as a runner would: the first that fails ends it."""

    def run_recipe(self, recipe, folder):
        for command in commands_of(recipe):
            done = subprocess.run(["bash", "-c", command], cwd=folder, text=True, capture_output=True,
                                  env={**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"})
            if done.returncode != 0:
                return done.returncode
        return 0

    def repository(self, folder):
        (folder / "bin").mkdir()
        (folder / "bin" / "frustum").symlink_to(PROGRAM)
        done = subprocess.run([PROGRAM, *("program cone --machine iwf-bc --center=-65,0,150 --radius 25 "
                               "--chord-tolerance 0.5 --out parts/cone --quiet").split()],
                              cwd=folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        job = folder / "parts" / "cone" / "job.toml"
        job.write_text(job.read_text().replace("report = true", "report = false"))

    def test_they_pass_what_is_right_and_fail_what_is_wrong(self):
        recipe = "github.yml"
        self.assertEqual(commands_of("gitlab-ci.yml"), commands_of(recipe))
        self.assertEqual(len(commands_of(recipe)), 2)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.repository(folder)
            self.assertEqual(self.run_recipe(recipe, folder), 0)
            self.assertEqual(json.loads((folder / "findings.sarif").read_text())["version"], "2.1.0")
            self.assertIn("<testsuite", (folder / "out" / "junit.xml").read_text())
            job = folder / "parts" / "cone" / "job.toml"
            right = job.read_text()
            job.write_text(right.replace("[errors]", "[errors]\nEX0C = \"300 um\"\n", 1))
            self.assertNotEqual(job.read_text(), right)
            self.assertEqual(self.run_recipe(recipe, folder), 1, "a part out of tolerance")
            job.write_text(right)
            (folder / "parts" / "wrong.nc").write_text("%\nO1\nG21 G90 G54\nT1 M6\nG0 X0 Y0\nG1 X10\nM30\n%\n")
            self.assertEqual(self.run_recipe(recipe, folder), 1, "a cut without feed and spindle")

    def test_recipes_have_no_tabs_and_even_indentation(self):
        for recipe in (ROOT / "examples" / "ci").glob("*.yml"):
            for number, line in enumerate(recipe.read_text().splitlines(), 1):
                self.assertNotIn("\t", line)
                self.assertEqual((len(line) - len(line.lstrip())) % 2, 0, f"{recipe.name}:{number}")


class ReleaseTest(unittest.TestCase):
    def test_version_citation_changelog_and_schemas_agree(self):
        done = subprocess.run([ROOT / "scripts" / "release", "--check"], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(VERSION, done.stdout)

    def test_another_version_is_refused(self):
        with tempfile.TemporaryDirectory() as name:
            tree = Path(name)
            for each in ("scripts", "schemas", "docs"):
                shutil.copytree(ROOT / each, tree / each)
            for each in ("CMakeLists.txt", "CHANGELOG.md"):
                shutil.copy(ROOT / each, tree)
            text = (ROOT / "CITATION.cff").read_text()
            (tree / "CITATION.cff").write_text(text.replace(f"version: {VERSION}", "version: 9.9.9"))
            done = subprocess.run([tree / "scripts" / "release", "--check"], text=True, capture_output=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("CITATION.cff", done.stderr)

    def test_container_and_release_run_the_same_commands(self):
        build = re.search(r"RUN apt-get update && (.*)", (ROOT / "Containerfile").read_text()).group(1)
        self.assertIn(f"&& {build}\"", (ROOT / "scripts" / "release").read_text())
        for script in re.findall(r"scripts/[a-z-]+", build):
            self.assertTrue(os.access(ROOT / script, os.X_OK), script)


if __name__ == "__main__":
    unittest.main()
