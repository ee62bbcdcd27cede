"""Each notebook of examples/python runs from its first cell to its last, and says what its text promises."""

import json
import os
import sys
import tempfile
import unittest

FOLDER = os.path.join(os.getcwd(), "examples", "python")


class NotebooksTest(unittest.TestCase):
    def test_all_cells_run(self):
        notebooks = sorted(name for name in os.listdir(FOLDER) if name.endswith(".ipynb"))
        self.assertTrue(notebooks)
        here = os.getcwd()
        for name in notebooks:
            with self.subTest(name), open(os.path.join(FOLDER, name)) as file:
                notebook = json.load(file)
                self.assertEqual(notebook["nbformat"], 4)
                names = {"__name__": name}
                with tempfile.TemporaryDirectory() as folder:
                    os.chdir(folder)
                    try:
                        for number, cell in enumerate(notebook["cells"]):
                            if cell["cell_type"] != "code":
                                continue
                            self.assertEqual(cell["outputs"], [], "stored without outputs")
                            source = "".join(cell["source"])
                            exec(compile(source, f"{name}[{number}]", "exec"), names)
                    finally:
                        os.chdir(here)


if __name__ == "__main__":
    sys.exit(unittest.main())
