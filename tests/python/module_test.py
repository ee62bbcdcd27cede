"""The module against the program: the same numbers, bit for bit; and what it refuses."""

import json
import os
import resource
import subprocess
import tempfile
import unittest

import numpy as np

import frustum

PROGRAM = os.environ["FRUSTUM_PROGRAM"]
EXAMPLES = os.path.join(os.getcwd(), "examples")


def printed(*arguments, exit_codes=(0, 1)):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
    assert done.returncode in exit_codes, done.stderr
    return done.stdout


def document(*arguments):
    return json.loads(printed(*arguments, "--json"))


class MachineTest(unittest.TestCase):
    def setUp(self):
        self.machine = frustum.Machine("iwf-bc")
        rng = np.random.default_rng(5)
        low, high = np.where(np.isinf(self.machine.travels), [-180, 180], self.machine.travels).T
        self.axes = low + (high - low) * rng.random((300, 5))

    def test_poses_are_those_of_the_program(self):
        errors = {"EX0C": "10 um", "EB0B": "30 urad", "EXX": "linear 5um"}
        tip, direction = self.machine.pose(self.axes, errors, tool_length=120.0)
        for i in (0, 7, 299):
            words = ",".join(f"{name}={value!r}" for name, value in zip(self.machine.axes, self.axes[i].tolist()))
            options = [f"--error={name}={value}" for name, value in errors.items()]
            actual = document("pose", "iwf-bc", "--axes", words, "--tool-length", "120", *options)["actual"]
            self.assertEqual(actual["tip"], tip[i].tolist())
            self.assertEqual(actual["axis"], direction[i].tolist())

    def test_inverse_leads_back(self):
        tip, direction = self.machine.pose(self.axes, tool_length=80.0)
        for i in range(0, 300, 7):
            found = self.machine.inverse(tip[i], direction[i], tool_length=80.0, previous=self.axes[i])
            again, _ = self.machine.pose(found, tool_length=80.0)
            self.assertLess(abs(again - tip[i]).max(), 1e-9)
            self.assertLess(abs(found - self.axes[i]).max(), 1e-8)

    def test_one_row_and_views_that_are_not_contiguous(self):
        whole, _ = self.machine.pose(self.axes)
        one, _ = self.machine.pose(self.axes[3])
        self.assertEqual(one.shape, (3,))
        self.assertTrue((one == whole[3]).all())
        back, _ = self.machine.pose(self.axes[::-2])
        self.assertTrue((back == whole[::-2]).all())
        columns, _ = self.machine.pose(np.asfortranarray(self.axes))
        self.assertTrue((columns == whole).all())
        self.assertEqual(self.machine.pose(np.zeros((0, 5)))[0].shape, (0, 3))

    def test_what_is_no_position_is_refused(self):
        wrong = {
            "shape": np.zeros((4, 3)),
            "row 1, column 2 is nan": np.where(np.arange(10).reshape(2, 5) == 7, np.nan, 0.0),
            "complex": np.zeros((2, 5), complex),
            "bool": np.zeros((2, 5), bool),
            "no real numbers": "X=1",
            "object": [[None] * 5],
        }
        for says, given in wrong.items():
            with self.assertRaises(frustum.InputError) as raised:
                self.machine.pose(given)
            self.assertIn(says, str(raised.exception))
            self.assertEqual(raised.exception.diagnostics[0]["key"], "axes")

    def test_diagnostics_have_their_place(self):
        with self.assertRaises(frustum.InputError) as raised:
            frustum.Machine("iwf-bx")
        self.assertEqual(raised.exception.diagnostics[0]["id"], "unknown-machine")
        self.assertIn("iwf-bc", raised.exception.diagnostics[0]["hint"])
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "job.toml")
            with open(file, "w") as out:
                out.write('machine = "iwf-bc"\nprogramme = "a.nc"\n')
            with self.assertRaises(frustum.InputError) as raised:
                frustum.Job(file).trial()
            self.assertTrue(all(each["file"] == file for each in raised.exception.diagnostics))
            self.assertTrue(any(each["line"] == 2 for each in raised.exception.diagnostics))
        with self.assertRaises(frustum.InputError):
            self.machine.pose(self.axes, errors={"EX0Q": "1 um"})
        with self.assertRaises(frustum.InputError):
            self.machine.inverse([[0, 0, 100.0]], [[0, 0, 0]])
        for tip, direction, says in (([0, 0, 0], [0, 0, -1.0], "B = "), ([1000, 0, 0], [0, 0, 1.0], "X = ")):
            with self.assertRaises(frustum.InputError) as raised:
                self.machine.inverse(tip, direction)
            self.assertIn(says, str(raised.exception))
        for wrong in ({"tool_length": float("nan")}, {"tool_length": -5.0}, {"approach": np.full(5, 7.0)},
                      {"approach": np.zeros((2, 5))}):
            with self.assertRaises(frustum.InputError):
                self.machine.pose(np.zeros(5), **wrong)
        for rows in (0, 2):
            with self.assertRaises(frustum.InputError):
                self.machine.inverse([0, 0, 0], [0, 0, 1.0], previous=np.zeros((rows, 5)))

    def test_drawn_errors_have_a_draw(self):
        law = {"EX0C": "uniform -10um..10um"}
        with self.assertRaises(frustum.InputError):
            self.machine.pose(np.zeros(5), law)
        one, _ = self.machine.pose(np.zeros(5), law, draw=1)
        two, _ = self.machine.pose(np.zeros(5), law, draw=2)
        self.assertFalse((one == two).all())
        self.assertTrue(np.isinf(self.machine.travels[4]).all())

    def test_ten_thousand_calls_leave_nothing_behind(self):
        def size():
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # KiB

        def calls(count):
            for _ in range(count):
                self.machine.pose(self.axes[:20], {"EX0C": "10 um"})
                try:
                    self.machine.pose([1.0])
                except frustum.InputError:
                    pass

        calls(2000)
        before = size()
        calls(10000)
        self.assertLess(size() - before, 2048)


class JobTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.piece = os.path.join(cls.folder.name, "piece")
        printed("program", "cone", "--machine", "iwf-bc", "--chord-tolerance", "2", "--cone-angle", "45",
             "--inclination", "30", "--out", cls.piece)
        cls.file = os.path.join(cls.piece, "job.toml")
        cls.job = frustum.Job(cls.file)
        cls.trial = cls.job.trial({"EX0C": "10 um"})

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_trial_is_that_of_run(self):
        out = os.path.join(self.folder.name, "out")
        printed("run", self.file, "--error", "EX0C=10 um", "--out", out)
        with open(os.path.join(out, "result.json")) as file:
            result = json.load(file)
        self.assertEqual({c["name"]: c["value"] for c in result["characteristics"]}, self.trial.values)
        self.assertEqual([c["value"] for c in self.trial.document()["characteristics"]],
                         [c["value"] for c in result["characteristics"]])
        self.assertIn("cone.roundness", self.trial._repr_html_())

    def test_the_tip_goes_where_the_machine_puts_it(self):
        path = self.job.path()
        self.assertTrue((np.diff(path["time"]) >= 0).all())
        self.assertEqual(path["axes"].shape, (len(path["time"]), 5))
        self.assertGreater(path["line"].max(), 100)
        norms = np.linalg.norm(path["direction"], axis=1)
        self.assertLess(abs(norms - 1).max(), 1e-12)

    def test_rays_meet_what_was_probed(self):
        points = self.trial.points["cone"]
        away = points["point"] + 1.0 * points["normal"]
        # The points are of the datum system, which is the part's own here within the errors.
        first = self.trial.workpiece.first(away, -points["normal"], 0.0, 5.0)
        self.assertTrue(first["hit"].all())
        self.assertLess(abs(first["s"] - 1.0).max(), 0.1)
        start, ends = self.trial.workpiece.along(away, -points["normal"], 0.0, 5.0)
        self.assertEqual(start[-1], len(ends))
        self.assertTrue((ends[start[:-1], 0] == first["s"]).all())

    def test_sensitivities_are_those_of_the_command(self):
        found = self.job.sensitivity(["EX0C", "EB0C"])
        by_command = document("sensitivity", self.file, "--parameter", "EX0C", "--parameter", "EB0C")
        self.assertEqual(found["parameters"], ["EX0C", "EB0C"])
        self.assertEqual(found["odd"].shape, (len(found["characteristics"]), 2))
        self.assertIn("EX0C", json.dumps(by_command))
        self.assertGreater(abs(found["odd"]).max(), 0.1)

    def test_populations_are_the_draws_of_a_study(self):
        study = os.path.join(self.folder.name, "study.toml")
        with open(study, "w") as out:
            out.write('job = "piece/job.toml"\nengine = "full"\n[errors]\nEX0C = "uniform -10um..10um"\n')
        population = frustum.Population(study, seed=4)
        values, failures = population.evaluate(3)
        self.assertEqual(failures, {})
        csv = os.path.join(self.folder.name, "draws.csv")
        printed("study", study, "--samples", "3", "--seed", "4", "--csv", csv, "--out",
             os.path.join(self.folder.name, "study"))
        with open(csv) as file:
            heads = file.readline().rstrip("\n").split(",")
            rows = [dict(zip(heads, line.split(","))) for line in file]
        for k, name in enumerate(population.characteristics):
            self.assertEqual([float(row["characteristics/" + name]) for row in rows], values[:, k].tolist())
        again, _ = population.evaluate(1, first=2)
        self.assertTrue((again[0] == values[2]).all())
        with self.assertRaises(frustum.InputError):
            population.evaluate(3, first=2**32 - 2)
        bent = os.path.join(self.folder.name, "bent.toml")
        with open(bent, "w") as out:
            out.write('job = "piece/job.toml"\n[errors]\nEXX = "tent 10um at uniform -100mm..100mm"\n')
        with self.assertRaises(frustum.InputError):
            frustum.Population(bent).evaluate(1, engine="linear")
        amounts = population.amounts(3)["amounts/EX0C/0"]
        self.assertLessEqual(abs(amounts).max(), 0.010)

    def test_motions_are_those_of_parse(self):
        file = os.path.join(self.piece, "cone.nc")
        lines = [json.loads(line) for line in printed("parse", file, "--canon").splitlines()]
        self.assertEqual(frustum.Program(file).motions, lines)


class AnswersTest(unittest.TestCase):
    def test_fits_are_those_of_the_command(self):
        rng = np.random.default_rng(2)
        angle, height = rng.uniform(0, 2 * np.pi, 200), rng.uniform(0, 30, 200)
        points = np.c_[10 * np.cos(angle), 10 * np.sin(angle), height] + rng.normal(0, 0.002, (200, 3))
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "points.csv")
            with open(file, "w") as out:
                out.write("x,y,z\n" + "".join(",".join(map(repr, row)) + "\n" for row in points.tolist()))
            for criterion in ("ls", "mz", "mi", "mc"):
                by_command = document("fit", "cylinder", file, "--criterion", criterion)
                found = frustum.fit("cylinder", points, criterion=criterion)
                self.assertEqual(by_command["parameters"]["radius"], found["parameters"]["radius"])
                self.assertEqual(by_command["parameters"]["axis"], found["parameters"]["axis"].tolist())
                self.assertEqual(by_command["residuals"], found["residuals"].tolist())
        for wrong in ({"criterion": "xx"}, {"axis": (0, 0, 0)}, {"axis": np.zeros((0, 3))}, {"axis": np.ones((2, 3))},
                      {"weights": np.ones(3)}, {"weights": np.zeros((0, 200))}):
            with self.assertRaises(frustum.InputError):
                frustum.fit("cylinder", points, **wrong)
        with self.assertRaises(frustum.InputError):
            frustum.fit("cylinder", points[:2])

    def test_motion_tests_are_those_of_the_command(self):
        by_command = document("motion", "circle", "--machine", "iwf-bc", "--plane", "XY", "--center", "0,0,150",
                              "--angles", "0,40,80,120,160,200,240,280,320", "--error", "EC0Y=30urad")
        answer = frustum.motion("circle", {"EC0Y": "30urad"}, machine="iwf-bc", plane="XY", center=[0, 0, 150],
                                angles=np.arange(0, 360, 40))
        warnings = answer.pop("warnings")
        by_command.pop("warnings", None)
        self.assertEqual(answer["evaluation"], by_command["evaluation"])
        self.assertEqual(answer["ccw_um"], by_command["ccw_um"])
        self.assertEqual(warnings, [])
        self.assertIn("polyline", answer._repr_svg_())
        with self.assertRaises(frustum.InputError) as raised:
            frustum.motion("circle", machine="iwf-bc", plan="XY", center=[0, 0, 150])
        self.assertTrue(any("plane" in each["hint"] + each["message"] + each["key"]
                            for each in raised.exception.diagnostics))

    def test_signals_are_as_before_a_study(self):
        def caught():
            with open("/proc/self/status") as file:
                return next(line for line in file if line.startswith("SigCgt"))

        before = caught()
        frustum.study(os.path.join(EXAMPLES, "ballbar", "machines.toml"), samples=50)
        self.assertEqual(caught(), before)

    def test_documents_are_those_of_the_commands(self):
        file = os.path.join(EXAMPLES, "ibaraki-2010", "study.toml")
        self.assertEqual(frustum.identify(file), document("identify", file))
        machine = os.path.join(EXAMPLES, "dynamics", "cantilever-original.toml")
        self.assertEqual(frustum.dynamics(machine, frequencies="20,57"),
                         document("dynamics", machine, "--frf", "20,57"))
        file = os.path.join(EXAMPLES, "ballbar", "machines.toml")
        with tempfile.TemporaryDirectory() as folder:
            by_command = document("study", file, "--samples", "500", "--out", os.path.join(folder, "out"))
        self.assertEqual(frustum.study(file, samples=500), by_command)


if __name__ == "__main__":
    unittest.main(verbosity=1)
