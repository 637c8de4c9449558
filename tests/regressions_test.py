#!/usr/bin/env python3
"""The seeded regressions apply to this tree, and their judges can say both yes and no."""

import contextlib
import io
import itertools
import json
import pathlib
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "bench" / "regressions"
sys.path[:0] = [str(FOLDER), str(ROOT / "bench")]

import judge  # noqa: E402  (the path comes first)
import run  # noqa: E402

SKIPPED = 77
ROW = {"name": "op/grid/100k/1/LLC", "processor_ns": 1000.0, "allocs": 2.0, "alloc_bytes": 100.0,
       "bytes_per_halfedge": 8.0, "digest_hi": 1.0, "digest_lo": 2.0}


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def program(self, name, /, **changes):
        """One that prints the row."""
        path = self.folder / name
        told = json.dumps({"benchmarks": [{**ROW, **changes}]})
        path.write_text(f"#!/bin/sh\necho '{told}'\n", encoding="utf-8")
        path.chmod(0o755)
        return path

    def judged(self, arm, head, base=None):
        return judge.ARMS[arm](base or self.program("base"), head, "^op/")


class Patches(Folder):
    def test_are_twelve_and_use_every_arm(self):
        found = run.regressions()
        self.assertEqual(len(found), 12)
        self.assertEqual({regression.arm for regression in found}, set(judge.ARMS))

    def test_apply_to_this_tree(self):
        for regression in run.regressions():
            self.assertEqual(run.applies(regression, ROOT), "", regression.name)

    def test_that_no_longer_apply_are_named(self):
        source = FOLDER / "wide-ids.patch"
        stale = self.folder / "stale-patch.patch"
        stale.write_text(source.read_text(encoding="utf-8").replace(" if(NOT", " if(WAS"), encoding="utf-8")
        said = run.applies(run.Regression(stale), ROOT)
        self.assertIn("CMakeLists.txt", said)
        folder, run.FOLDER = run.FOLDER, self.folder
        self.addCleanup(setattr, run, "FOLDER", folder)
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            self.assertEqual(run.main(["--check"]), 1)
        self.assertIn("stale-patch", out.getvalue())

    def test_without_an_arm_that_exists_are_refused(self):
        for head in ("", "What: x\nRows: ^x$\n", "What: x\nArm: colour\nRows: ^x$\n"):
            file = self.folder / "bad.patch"
            file.write_text(head + "\ndiff --git a/x b/x\n", encoding="utf-8")
            with self.assertRaises(ValueError):
                run.Regression(file)


class Memory(Folder):
    def test_that_grows_is_noticed(self):
        for key in judge.MEMORY:
            finding, is_noticed = self.judged("memory", self.program("head", **{key: ROW[key] + 1}))
            self.assertTrue(is_noticed, key)
            self.assertIn(key, finding)

    def test_that_stays_or_shrinks_is_not(self):
        for allocs in (2.0, 1.0):
            self.assertFalse(self.judged("memory", self.program("head", allocs=allocs))[1])


class Result(Folder):
    def test_that_differs_in_either_half_is_noticed(self):
        for half in ("digest_hi", "digest_lo"):
            self.assertTrue(self.judged("result", self.program("head", **{half: 7.0}))[1])
        self.assertFalse(self.judged("result", self.program("head"))[1])


class Rows(Folder):
    def test_that_one_side_does_not_have_are_an_error(self):
        head = self.program("head", name="op/grid/100k/2/LLC")
        for arm in ("memory", "result"):
            with self.assertRaises(judge.RowsError):
                self.judged(arm, head)


class Time(unittest.TestCase):
    NOISE = (1.0, 1.01, 0.99, 1.3, 1.0)  # one in five is an outlier

    def setUp(self):
        self.addCleanup(setattr, judge, "rows_of", judge.rows_of)

    def judged(self, head, base=(1.0,)):
        """With scripted times, which begin again where they end; the calls are kept."""
        times = {"base": itertools.cycle(base), "head": itertools.cycle(head)}
        self.calls = []

        def rows_of(program, _pattern, iterations):
            self.calls.append((program, iterations))
            return {ROW["name"]: {**ROW, "processor_ns": 2e6 * next(times[program])}}
        judge.rows_of = rows_of
        return judge.time("base", "head", "^op/")

    def test_of_a_tenth_more_is_noticed(self):
        finding, is_noticed = self.judged([1.1])
        self.assertTrue(is_noticed)
        self.assertIn("+10.0%", finding)
        self.assertTrue(self.judged([1.09, 1.11, 1.1], [1.0, 1.01, 0.99, 1.0])[1])

    def test_of_the_same_program_is_not(self):
        self.assertFalse(self.judged([1.0])[1])
        self.assertFalse(self.judged(self.NOISE, self.NOISE[2:] + self.NOISE[:2])[1])

    def test_of_a_gain_or_of_less_than_the_margin_is_not(self):
        for factor in (0.5, 0.95, 1.01, 1.02):
            self.assertFalse(self.judged([factor])[1], factor)

    def test_is_taken_in_pairs_of_the_same_count(self):
        self.judged([1.0])
        first, *pairs = self.calls
        self.assertEqual(first, ("base", 3))
        self.assertEqual(len(pairs), 2 * judge.PAIRS)
        self.assertEqual({iterations for _, iterations in pairs}, {10})  # of 2 ms each: 20 ms
        order = "".join(program[0] for program, _ in pairs)
        self.assertEqual(order, "bhhbhbbh" * (judge.PAIRS // 4))


class Instructions(Folder):
    def counted(self, factor):
        counts = iter([10000, round(10000 * factor)])
        patterns = []

        def count(_program, pattern, path, *_):
            patterns.append(pattern)
            self.assertEqual(path, "avx2")
            return [{"operation": "op", "dataset": "grid", "instructions": next(counts)}]
        original, judge.counting.count = judge.counting.count, count
        self.addCleanup(setattr, judge.counting, "count", original)
        finding = judge.instructions("base", "head", "^op/grid/100k/1/LLC$")
        self.assertEqual(patterns, ["^op/grid/100k/1$"] * 2)
        return finding[1]

    def test_of_more_than_a_hundredth_are_noticed(self):
        self.assertTrue(self.counted(1.011))

    def test_of_less_are_not(self):
        for factor in (1.0099, 1.0, 0.5):
            self.assertFalse(self.counted(factor), factor)


if __name__ == "__main__":
    if shutil.which("git") is None:
        print("skipped: git is not installed")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
