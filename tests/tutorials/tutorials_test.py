"""Follows the tutorials: writes the files that they show, runs their commands, compares what they print.

In docs/tutorials/*.md a block
    ```toml file=NAME      (any language) is written to NAME in the tutorial's own empty folder,
    ```sh                  is run by bash there, with `frustum` on the path; every line must succeed,
    ```sh exit=1           ... the last line ends with this exit code,
    ```text                after it, is what that printed: its lines, in this order; `...` stands for any lines, and
                           within a line for anything. Blanks count once,
    ```python              is run after those before it, in the same interpreter, where the Python module is built.
Arguments: names of tutorials, all where there are none.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs" / "tutorials"
PROGRAM = Path(os.environ["FRUSTUM_PROGRAM"])
FENCE = re.compile(r"^```(\w+)([^\n]*)\n(.*?)^```$", re.M | re.S)


def blocks_of(text):
    """(language, {word: value}, content) of each block, in order."""
    for match in FENCE.finditer(text):
        words = dict(word.split("=", 1) for word in match.group(2).split() if "=" in word)
        yield match.group(1), words, match.group(3)


def pattern_of(line):
    parts = [re.escape(" ".join(part.split())) for part in line.split("...")]
    return re.compile(" ?.* ?".join(parts))


def missing_line(expected, printed):
    """The first line of `expected` that `printed` has not, in its place; None where it has them all."""
    lines = [" ".join(line.split()) for line in printed.splitlines()]
    at, anywhere = 0, True
    for line in expected.splitlines():
        if line.strip() == "...":
            anywhere = True
            continue
        pattern = pattern_of(line)
        while at < len(lines) and not pattern.fullmatch(lines[at]):
            if not anywhere:
                return line
            at += 1
        if at == len(lines):
            return line
        at, anywhere = at + 1, False
    return None


# Runs one block a line of JSON after the other, and answers with what each printed.
INTERPRETER = """
import contextlib, io, json, sys, traceback
names = {"__name__": "__main__"}
for line in sys.stdin:
    out, failed = io.StringIO(), False
    with contextlib.redirect_stdout(out):
        try:
            exec(compile(json.loads(line), "tutorial", "exec"), names)
        except BaseException:
            failed = True
            out.write(traceback.format_exc())
    print(json.dumps([failed, out.getvalue()]), flush=True)
"""


class Follower:
    """One reader of one tutorial, in a folder of its own."""

    def __init__(self, test, folder):
        self.test, self.folder, self.printed, self.python = test, folder, "", None
        self.environment = {**os.environ, "PATH": f"{folder / '.bin'}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8",
                            "COLUMNS": "120"}
        (folder / ".bin").mkdir()
        (folder / ".bin" / "frustum").symlink_to(PROGRAM)

    def run(self, script, exit_code):
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=self.folder, env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.test.assertEqual(done.returncode, exit_code, f"{script}\n{done.stdout}")
        self.printed = done.stdout

    def run_python(self, code):
        if self.python is None:
            self.python = subprocess.Popen([os.environ["FRUSTUM_PYTHON"], "-c", INTERPRETER], cwd=self.folder, text=True,
                                           env=self.environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.python.stdin.write(json.dumps(code) + "\n")
        self.python.stdin.flush()
        failed, self.printed = json.loads(self.python.stdout.readline())
        self.test.assertFalse(failed, f"{code}\n{self.printed}")

    def close(self):
        if self.python is not None:
            self.python.communicate()

    def follow(self, language, words, content):
        if "file" in words:
            file = self.folder / words["file"]
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(content)
        elif language == "sh":
            self.run(content, int(words.get("exit", 0)))
        elif language == "python":
            self.run_python(content)
        elif language == "text":
            line = missing_line(content, self.printed)
            self.test.assertIsNone(line, f"not printed, or not there: {line}\nprinted was:\n{self.printed}")


class TutorialsTest(unittest.TestCase):
    def test_every_tutorial_can_be_followed(self):
        wanted = sys.argv[1:]
        followed = 0
        for page in sorted(FOLDER.glob("*.md")):
            blocks = list(blocks_of(page.read_text()))
            needs_python = any(language == "python" for language, _, _ in blocks)
            if not blocks or wanted and page.stem not in wanted:
                continue
            if needs_python and not os.environ.get("FRUSTUM_PYTHON"):
                print(f"{page.stem}: skipped, the Python module is not built")
                continue
            with self.subTest(page.stem), tempfile.TemporaryDirectory() as folder:
                follower = Follower(self, Path(folder))
                try:
                    for block in blocks:
                        follower.follow(*block)
                finally:
                    follower.close()
                followed += 1
                print(f"{page.stem}: {len(blocks)} blocks")
        self.assertGreater(followed, 0)


class WrongTutorialTest(unittest.TestCase):
    """The comparison itself can fail."""

    def test_other_output_is_found(self):
        self.assertIsNone(missing_line("form 1.2 um\n...\npass\n", "form  1.2   um\nmore\nand more\npass\n"))
        self.assertIsNone(missing_line("form ... um\n", "head\nform 1.25 um\n"))
        self.assertEqual(missing_line("form 1.3 um\n", "form 1.2 um\n"), "form 1.3 um")
        self.assertEqual(missing_line("one\nthree\n", "one\ntwo\nthree\n"), "three")
        self.assertEqual(missing_line("two\n...\none\n", "one\ntwo\n"), "one")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
