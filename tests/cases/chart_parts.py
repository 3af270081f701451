"""The parts of the chart, without the program: edits of scenes, limits of ladders, spans of time in which histories can be told."""
import argparse
import fractions
import pathlib
import sys
import tempfile
import types
import unittest

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src" / "chart"))
sys.dont_write_bytecode = True

import labels
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from command_line import Part, parse
from files import write_whole
from history import scales, smooth_attitude
from ladder import Ladder
from messages import Refusal
from reference import Reference
from runs import FINISHED, TOO_DEAR, Run, Runner
from scene_text import SceneText
from spread import run_part
from survey import Survey
from variants import Settings, Stepping, Variants

BLOCK = """# Grüße
cables:
  line:          # a line
    type: rope
    elements: &n 8   # of eight
    node_velocity: [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0], [5, 0, 0], [6, 0, 0], [7, 0, 0], [8, 0, 0]]
  rod: {type: rope, elements: 1}
  twin:
    type: rope
    elements: *n
time:
  end: 10
  step: 1e-2     # s
  adaptive:
    tolerance: 1e-3
  spectral_radius: 0.5
points: {a: {position: [0, 0, 0], motion: {file: motion.csv}}, b: {position: [1, 0, 0]}}
"""
HALF = Settings(fractions.Fraction(1, 2), Stepping(step=0.02, tolerance=4e-3))


class Edits(unittest.TestCase):
    def variants(self, text=BLOCK):
        return Variants(SceneText(text))

    def test_only_what_is_named_changes(self):
        changed = self.variants().written_text(HALF).splitlines()
        different = [(old, new) for old, new in zip(BLOCK.splitlines(), changed) if old != new]
        self.assertEqual(len(changed), len(BLOCK.splitlines()))
        self.assertEqual([new.strip() for _, new in different],
                         ["elements: &n 4   # of eight",
                          "node_velocity: [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0], [6.0, 0.0, 0.0], [8.0, 0.0, 0.0]]",
                          "step: 0.02     # s", "tolerance: 0.004"])

    def test_scene_as_written_keeps_its_numbers(self):
        variants = self.variants()
        again = SceneText(variants.written_text(variants.own()))
        for path in (("time", "step"), ("time", "adaptive", "tolerance")):
            self.assertEqual(again.number(*path), variants.scene.number(*path))
        self.assertEqual(again.elements(), variants.scene.elements())

    def test_adaptive_is_taken_away(self):
        for text in (BLOCK, "time: {end: 10, step: 0.01, adaptive: {tolerance: 1.0e-3}}\ncables: {c: {elements: 4}}\n",
                     "time: {adaptive: {tolerance: 1.0e-3}, end: 10, step: 0.01}\ncables: {c: {elements: 4}}\n"):
            fixed = SceneText(self.variants(text).written_text(Settings(fractions.Fraction(1), Stepping(step=0.01))))
            self.assertIsNone(fixed.find("time", "adaptive"))
            self.assertEqual((fixed.number("time", "end"), fixed.number("time", "step")), (10, 0.01))

    def test_absent_keys_are_added(self):
        for text in (BLOCK, "{time: {end: 10, step: 0.01}, cables: {c: {elements: 4}}, points: {b: {position: [0, 0, 0]}}}"):
            run = SceneText(self.variants(text).run_text(Settings(fractions.Fraction(1), Stepping("plain", 0.01, 1e-4))))
            self.assertEqual(run.value("time", "scheme"), "plain")
            self.assertEqual(run.number("time", "adaptive", "tolerance"), 1e-4)
            self.assertEqual(run.number("output", "interval"), 0.1)
            self.assertEqual(run.find("output", "history").value[0].value, "b")

    def test_radius_goes_with_its_scheme(self):
        other = SceneText(self.variants().run_text(Settings(fractions.Fraction(1), Stepping("plain", 0.01))))
        self.assertIsNone(other.find("time", "spectral_radius"))
        own = SceneText(self.variants().run_text(Settings(fractions.Fraction(1), Stepping("", 0.01))))
        self.assertEqual(own.number("time", "spectral_radius"), 0.5)

    def test_what_an_alias_repeats_is_not_changed_alone(self):
        for text, place in (("cables: {c: {length: &n 10, elements: *n}}\n", "cables.c.length"),
                            ("cables: {c: {elements: 4}}\ntime: &t {step: 0.1}\nother: *t\n", "other.step")):
            with self.assertRaises(Refusal) as caught:
                SceneText(text).edited({("cables", "c", "elements"): "8", ("time", "step"): "0.2"})
            self.assertIn(place, str(caught.exception))
        text = "cables: {c: {elements: &n 4}, d: {elements: *n}}\n"
        both = {("cables", name, "elements"): "8" for name in "cd"}
        self.assertEqual(SceneText(text).edited(both).count("8"), 1)

    def test_shape_with_a_row_for_each_node(self):
        text = "cables: {c: {elements: 2, shape: [[0, 0, 0], [1, 0, 0], [4, 0, 0]]}, d: {elements: 4, shape: [[0, 0, 0], [1, 0, 0]]}}\n"
        double = SceneText(self.variants(text).written_text(Settings(fractions.Fraction(2), None)))
        rows = [float(row.value[0].value) for row in double.find("cables", "c", "shape").value]
        self.assertEqual(rows, [0, 0.5, 1, 2.5, 4])
        self.assertEqual(len(double.find("cables", "d", "shape").value), 2)


TIMES = numpy.linspace(0, 10, 201)


def run_of(h, dt, motion, settings=None):
    """Stands for a run: a history that depends on the sizes as `motion` says."""
    return types.SimpleNamespace(times=TIMES, columns={"p.x": motion(TIMES, h, dt)}, settings=settings, elements=1 / h, steps=10 / dt)


def reference_of(motion):
    meshes, steps = [1, 1 / 2, 1 / 4, 1 / 8], [0.4, 0.2, 0.1, 0.05]
    mesh_runs = [run_of(h, 0.2, motion) for h in meshes]
    step_runs = [mesh_runs[2] if dt == 0.2 else run_of(1 / 4, dt, motion) for dt in steps]
    return Reference([Ladder("mesh", meshes, mesh_runs), Ladder("step", steps, step_runs)], mesh_runs[2], False)


class Truth(unittest.TestCase):
    def test_limits_of_both_sizes(self):
        reference = reference_of(lambda t, h, dt: numpy.sin(t) + 0.1 * h**2 * t + 0.5 * dt**2 * numpy.cos(t))
        self.assertLess(numpy.abs(reference.truth["p.x"] - numpy.sin(TIMES)).max(), 1e-12)
        self.assertEqual({kind: round(order, 6) for kind, order in reference.orders().items()}, {"mesh": 2, "step": 2})

    def test_first_order(self):
        reference = reference_of(lambda t, h, dt: numpy.sin(t) + 0.1 * h**2 + 0.5 * dt * numpy.cos(t))
        self.assertAlmostEqual(reference.orders()["step"], 1)
        self.assertLess(numpy.abs(reference.truth["p.x"] - numpy.sin(TIMES)).max(), 1e-12)

    def test_noise_is_not_extrapolated(self):
        noise = numpy.random.default_rng(1)
        reference = reference_of(lambda t, h, dt: numpy.sin(t) + 0.02 * noise.standard_normal(t.size))
        # Each series is off by 0.02 of a range of 2, the sum of three by root 3 times that; doubt is to say so.
        self.assertGreater(reference.doubt["p.x"], 0.01)
        self.assertFalse(reference.can_tell("p.x", 0.003))

    def test_no_error_is_told_below_the_doubt(self):
        noise = numpy.random.default_rng(1)
        reference = reference_of(lambda t, h, dt: numpy.sin(t) + 0.02 * noise.standard_normal(t.size))
        finest = reference.ladders[0].runs[-1]
        finest.columns = {"p.x": reference.truth["p.x"]}
        self.assertEqual(reference.errors(finest)["p.x"][0], reference.doubt["p.x"])
        self.assertTrue(reference.is_bound(finest, "p.x"))
        off = run_of(1, 1, lambda t, h, dt: reference.truth["p.x"] + 1)
        self.assertFalse(reference.is_bound(off, "p.x"))
        self.assertAlmostEqual(reference.errors(off)["p.x"][0], 0.5, delta=0.05)

    def test_extrapolated_is_said_of_what_is(self):
        smooth = reference_of(lambda t, h, dt: numpy.sin(t) + 0.1 * h**2 * t + 0.5 * dt**2 * numpy.cos(t))
        self.assertEqual([smooth.extrapolated(ladder) for ladder in smooth.ladders], [(1, 1), (1, 1)])
        # Every mesh moves the result by as much as the one before.
        rough = reference_of(lambda t, h, dt: numpy.sin(t) + 1e-3 * numpy.log2(h) + 0.5 * dt**2 * numpy.cos(t))
        self.assertEqual([rough.extrapolated(ladder) for ladder in rough.ladders], [(0, 1), (1, 1)])

    def test_chaos_has_an_end(self):
        def motion(t, h, dt):
            apart = numpy.minimum(1.0, 1e-5 * numpy.exp(2 * t))
            return numpy.sin(t) + apart * numpy.sin(300 * h + 7000 * dt + t)
        judged = reference_of(motion).judged["p.x"]
        # 1e-5 exp(2 t) is a tenth of the range of 2 at t = 5.
        self.assertTrue(4 < judged.end < 7 and judged.start == 0, judged)

    def test_a_start_that_settles(self):
        judged = reference_of(lambda t, h, dt: numpy.sin(t) + numpy.exp(-2 * t) * numpy.cos(numpy.pi * numpy.log2(h))).judged["p.x"]
        self.assertTrue(1 <= judged.start <= 3 and judged.end == 10, judged)

    def test_what_is_prescribed_tells_nothing(self):
        self.assertEqual(reference_of(lambda t, h, dt: numpy.sin(t)).columns, [])


class Machine:
    """Stands for a Runner: runs cost their work, and those of a tolerance take the longest step, whatever it is."""

    def __init__(self, variants, budget):
        self.variants, self.budget, self.all, self.folder = variants, budget, {}, "folder"
        self.work = Runner.work.__get__(self)
        self.expected_cpu = lambda settings: 0.0

    finished = property(lambda self: [run for run in self.all.values() if run.is_finished])
    spent = property(lambda self: float(len(self.all)))

    def run(self, settings, limit=numpy.inf):
        status = FINISHED if len(self.all) < self.budget else TOO_DEAR
        stepping = settings.stepping
        steps = 200 if stepping.tolerance is not None else round(10 / stepping.step)
        columns = {"p.x": numpy.sin(TIMES) + (10 / steps) ** 2}
        return self.all.setdefault(settings, Run(settings, None, status, process_cpu=[1.0], steps=steps, times=TIMES, columns=columns))


def survey_of(text, budget=1000):
    variants = Variants(SceneText(text))
    return Survey(Machine(variants, budget), variants, [])


FIXED = "cables: {c: {elements: 8}}\ntime: {end: 10, step: 0.01}\noutput: {interval: 0.1, history: [c]}\n"


class Surveys(unittest.TestCase):
    def test_tolerances_that_take_the_same_steps_are_one_rung(self):
        survey = survey_of(FIXED)
        rungs = [Settings(fractions.Fraction(1), Stepping(step=0.01, tolerance=10.0**-power)) for power in range(4)]
        ladder = survey._climb("tolerance", rungs, survey._step_size("tolerance"), 1.0)
        self.assertEqual([run.settings.stepping.tolerance for run in ladder.runs], [1e-3])

    def test_work_of_both_kinds_of_steps_is_comparable(self):
        machine = survey_of(FIXED).runner
        adaptive = Settings(fractions.Fraction(1), Stepping(step=0.01, tolerance=1e-3))
        machine.run(adaptive)
        fixed = Settings(fractions.Fraction(1), Stepping(step=10 / 200))
        self.assertAlmostEqual(machine.work(adaptive), machine.work(fixed))

    def test_parts_deal_out_the_grid(self):
        survey = survey_of(FIXED)
        grid = survey.grid()
        self.assertEqual({float(settings.mesh) for settings in grid}, {0.25, 0.5, 1, 2, 4})
        done = []
        for number in (1, 2, 3):
            survey = survey_of(FIXED)
            self.assertIn(f"part {number} of 3", run_part(survey.runner, grid, Part(number, 3)))
            done += survey.runner.all
        self.assertEqual((len(done), set(done)), (len(grid), set(grid)))
        costs = [survey.runner.work(settings) for settings in survey.runner.all]
        self.assertEqual(costs, sorted(costs))

    def test_a_part_ends_with_its_budget(self):
        survey = survey_of(FIXED, budget=4)
        self.assertIn("4 of ", run_part(survey.runner, survey.grid(), Part(1, 1)))
        self.assertEqual(len(survey.runner.all), 5)

    def test_repetitions_change_no_decision(self):
        variants = Variants(SceneText(FIXED))
        runner = Runner([sys.executable], variants, pathlib.Path("nowhere"), 10.0, None)
        runner.all["first"] = Run(None, None, FINISHED, process_cpu=[2.0, 3.0, 3.0])
        runner.all["part"] = Run(None, None, FINISHED, process_cpu=[5.0, 1.0], is_of_part=True)
        self.assertEqual((runner.left, runner.spent), (7.0, 9.0))


class Words(unittest.TestCase):
    def test_schemes_leave_the_scene_alone(self):
        given = parse(["--schemes", "plain,generalized_alpha", "scene.yaml"])
        self.assertEqual((given.schemes, given.scene.name), (["plain", "generalized_alpha"], "scene.yaml"))
        for words in (["--schemes", "plain", "euler"], ["scene.yaml", "--part", "0/2"], ["scene.yaml", "--part", "2"]):
            with self.assertRaises(Refusal):
                parse(words + ([] if "scene.yaml" in words else ["--schemes", "euler"]))

    def test_files_are_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "chart.yaml"
            write_whole(path, "old")
            with self.assertRaises(UnicodeEncodeError):
                write_whole(path, "half\ud800")
            self.assertEqual((path.read_text(), [one.name for one in path.parent.iterdir()]), ("old", ["chart.yaml"]))


class Labels(unittest.TestCase):
    def test_words_keep_clear_of_points_and_each_other(self):
        figure, axes = plt.subplots(figsize=(8, 6))
        places = [(0.4, 0.5), (0.45, 0.51), (0.55, 0.52), (0.42, 0.47), (0.6, 0.6)]
        axes.plot(*zip(*places), "o", label="points")
        axes.set(xlim=(0, 1), ylim=(0, 1))
        axes.legend()
        figure.draw_without_rendering()
        taken = labels.obstacles(axes)
        for point in places[:3]:
            labels.place(axes, "1 %: 24 el., step 0.01 s", point, taken)
        boxes = [box for box, _ in taken]
        for place in range(len(boxes) - 3, len(boxes)):
            self.assertFalse(any(boxes[place].overlaps(other) for other in boxes[:place]))


class Scales(unittest.TestCase):
    def test_small_components_and_constant_forces(self):
        t = TIMES
        columns = {"p.x": numpy.sin(t), "p.y": 1e-12 * numpy.cos(7 * t), "p.z": numpy.full_like(t, -200.0), "c.tension_to": 1e3 + 1e-9 * t}
        found = scales(columns, False)
        self.assertAlmostEqual(found["p.y"], 0.1 * found["p.x"])
        self.assertEqual(found["c.tension_to"], numpy.abs(columns["c.tension_to"]).max() * 1e-3)

    def test_attitudes_do_not_jump(self):
        angle = numpy.linspace(0, 12, 200)
        columns = {"b.qw": numpy.cos(angle / 2), "b.qx": numpy.sin(angle / 2), "b.qy": 0 * angle, "b.qz": 0 * angle}
        jumping = numpy.where(columns["b.qw"] < 0, -1, 1)
        told = {name: values * jumping for name, values in columns.items()}
        smooth_attitude(told, list(told))
        for name in columns:
            numpy.testing.assert_allclose(told[name], columns[name])


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program")
    parser.add_argument("--scratch")
    unittest.main(argv=[sys.argv[0], *parser.parse_known_args()[1]])
