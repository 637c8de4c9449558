#!/usr/bin/env python3
"""The limits of bytes and instructions must fail when they should.

usage: limits_test.py BENCH
"""

import contextlib
import copy
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BENCH = sys.argv[1]
ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))

import limits  # noqa: E402  (the path comes first)

BUILD = "build/grid/400k/1"
FACES = "face_normals/grid/400k/1"


def limits_command(*options, **environment):
    return subprocess.run([sys.executable, str(ROOT / "bench" / "limits.py"), *options], check=False,
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=600,
                          env={**os.environ, **environment})


class Folder(unittest.TestCase):
    """The committed baseline as what was counted: within all limits, until a test changes it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.baseline = json.loads(limits.BASELINE.read_text(encoding="utf-8"))
        self.counted = copy.deepcopy(self.baseline)

    def judge(self, command):
        counts, baseline = self.folder / "counts.json", self.folder / "baseline.json"
        counts.write_text(json.dumps(self.counted), encoding="utf-8")
        baseline.write_text(json.dumps(self.baseline), encoding="utf-8")
        options = ["--baseline", str(baseline)] if command == "instructions" else []
        return limits_command(command, str(counts), *options)

    def assert_failed(self, command, *words):
        ran = self.judge(command)
        self.assertEqual(ran.returncode, 1, ran.stdout + ran.stderr)
        failed = [line for line in ran.stdout.splitlines() if line.startswith("FAILED ")]
        self.assertEqual(len(failed), 1, ran.stdout)
        for word in words:
            self.assertIn(word, failed[0])

    def assert_passed(self, command):
        ran = self.judge(command)
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
        self.assertNotIn("FAILED", ran.stdout)


class Bytes(Folder):
    def test_of_the_baseline_are_within_the_limits(self):
        self.assert_passed("bytes")

    def test_above_a_limit_fail_and_name_the_operation(self):
        row = self.counted["rows"][FACES]
        row["bytes"] = int(limits.FACTORS[FACES][0] * row["compulsory_bytes"]) + limits.LINE
        self.assert_failed("bytes", FACES, "at most 1.05 times")

    def test_of_an_operation_that_was_not_counted_fail(self):
        del self.counted["rows"][BUILD]
        self.assert_failed("bytes", BUILD, "was not counted")

    def test_have_a_limit_near_what_is_reached(self):
        for name, (factor, _) in limits.FACTORS.items():
            row = self.baseline["rows"][name]
            self.assertLess(factor, 1.2 * row["bytes"] / row["compulsory_bytes"], name)


class Instructions(Folder):
    def test_of_the_baseline_pass(self):
        self.assert_passed("instructions")

    def test_may_differ_by_a_hundredth(self):
        for factor in (1.0099, 0.9901):
            self.counted["rows"][BUILD]["instructions"] = int(
                factor * self.baseline["rows"][BUILD]["instructions"])
            self.assert_passed("instructions")

    def test_that_are_more_fail(self):
        self.counted["rows"][BUILD]["instructions"] *= 1.011
        self.assert_failed("instructions", BUILD, "+1.10%", "instructions")

    def test_that_are_fewer_fail_until_they_are_recorded(self):
        self.counted["rows"][BUILD]["instructions"] *= 0.985
        self.assert_failed("instructions", BUILD, "-1.50%", "renew")

    def test_of_an_altered_baseline_fail(self):
        self.baseline["rows"][FACES]["instructions"] //= 2
        self.assert_failed("instructions", FACES, "+100.00%")

    def test_of_the_classification_are_held_too(self):
        self.counted["rows"][BUILD]["classification"] *= 1.02
        self.assert_failed("instructions", BUILD, "classification")
        del self.counted["rows"][BUILD]["classification"]
        self.assert_failed("instructions", BUILD, "one side only")

    def test_are_held_beside_the_bytes(self):
        self.counted["rows"][FACES]["bytes"] *= 1.04
        self.assert_failed("instructions", FACES, "bytes")

    def test_on_one_side_only_fail(self):
        del self.counted["rows"][FACES]
        self.assert_failed("instructions", FACES, "was not counted")
        self.counted = copy.deepcopy(self.baseline)
        del self.baseline["rows"][FACES]
        self.assert_failed("instructions", FACES, "is not in the baseline")

    def test_of_another_compiler_say_nothing(self):
        self.counted["context"]["compiler"] = "gcc 13.1.0"
        ran = self.judge("instructions")
        self.assertEqual(ran.returncode, limits.SKIPPED)
        self.assertIn("gcc 13.1.0", ran.stdout)


class Files(Folder):
    def test_that_are_missing_skip(self):
        ran = limits_command("bytes", str(self.folder / "nothing.json"))
        self.assertEqual(ran.returncode, limits.SKIPPED)
        self.assertIn("nothing was counted", ran.stdout)

    def test_that_are_broken_end_with_2(self):
        for text in ("", "{", "[]", "{}", '{"rows": {}}', '{"rows": []}', "\0"):
            file = self.folder / "broken.json"
            file.write_text(text, encoding="utf-8")
            for command in ("bytes", "instructions"):
                ran = limits_command(command, str(file))
                self.assertEqual(ran.returncode, 2, (text, ran.stdout))
                self.assertIn("broken.json", ran.stderr)

    def test_hold_every_operation_that_has_a_limit_and_a_reason(self):
        self.assertEqual(set(self.baseline["rows"]), set(limits.FACTORS))
        self.assertGreaterEqual(len(self.baseline["reason"]), limits.MIN_REASON)


class Counting(Folder):
    def without_valgrind(self, *options):
        """A path with nothing on it."""
        return limits_command(*options, PATH=str(self.folder))

    def test_needs_valgrind_and_forgets_what_was_counted_before(self):
        out = self.folder / "counts.json"
        out.write_text("old", encoding="utf-8")
        ran = self.without_valgrind("count", BENCH, "--out", str(out))
        self.assertEqual(ran.returncode, limits.SKIPPED)
        self.assertIn("valgrind", ran.stdout)
        self.assertFalse(out.exists())

    def test_needs_avx2(self):
        self.addCleanup(setattr, limits, "has_avx2", limits.has_avx2)
        self.addCleanup(setattr, limits.shutil, "which", limits.shutil.which)
        limits.has_avx2, limits.shutil.which = (lambda: False), (lambda name: name)
        out = io.StringIO()
        with self.assertRaises(SystemExit) as ended, contextlib.redirect_stdout(out):
            limits.counted(BENCH, 1)
        self.assertEqual(ended.exception.code, limits.SKIPPED)
        self.assertIn("AVX2", out.getvalue())

    def test_of_another_kind_of_build_says_nothing(self):
        program = self.folder / "program"
        for key, value in (("flags", "Debug: -g"), ("index_bits", "64")):
            context = {**self.baseline["context"], key: value}
            program.write_text(f"#!/bin/sh\necho '{json.dumps({'context': context})}'\n", encoding="utf-8")
            program.chmod(0o755)
            ran = limits_command("count", str(program), "--out", str(self.folder / "counts.json"))
            self.assertEqual(ran.returncode, limits.SKIPPED, ran.stderr)
            self.assertTrue(value in ran.stdout or "valgrind" in ran.stdout or "AVX2" in ran.stdout)

    def test_is_renewed_with_a_reason_only(self):
        baseline = self.folder / "baseline.json"
        for reason in ([], ["--reason", ""], ["--reason", "  \n "], ["--reason", "faster"]):
            ran = limits_command("renew", BENCH, "--baseline", str(baseline), *reason)
            self.assertEqual(ran.returncode, 2, reason)
            self.assertIn("--reason", ran.stderr)
        self.assertFalse(baseline.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
