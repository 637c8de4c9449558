#!/usr/bin/env python3
"""What a program that compares two builds of hedgerow_bench relies on, from outside.

usage: bench_options_test.py BENCH TEST_BENCH
"""

import json
import os
import subprocess
import sys
import unittest

BENCH, TEST_BENCH = sys.argv[1:3]
CLASSES = ("L1", "L2", "LLC", "DRAM")
COUNTERS = ("digest_hi", "digest_lo", "peak_bytes")
MAKES_A_MESH = ("build/", "close_boundary", "open_boundary", "reorder_")
PEERS = ("pointer", "struct", "openmesh", "cgal", "meshoptimizer")
# Rows whose answer no number of threads, no strategy and no way of walking may change.
SAME_ANSWER = ("build/grid/200", "build/shuffled/200", "face_normals/scan/200", "one_ring/grid/200")


def run(*options, program=BENCH, **environment):
    return subprocess.run([program, "--smoke", *options], check=False, text=True, timeout=600,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          env={**os.environ, **environment})


def rows(pattern, *options, program=BENCH, **environment):
    ran = run(f"--benchmark_filter={pattern}", "--benchmark_format=json", *options, program=program,
              **environment)
    assert ran.returncode == 0, ran.stderr
    return json.loads(ran.stdout)["benchmarks"]


def names(*options):
    ran = run("--benchmark_list_tests", *options)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout.split()


def is_ours(row):
    return row["name"].split("/")[4] not in PEERS


def digest(row):
    for half in ("digest_hi", "digest_lo"):
        assert row[half] == int(row[half]) and 0 <= row[half] < 2**32, row
    return (int(row["digest_hi"]) << 32) + int(row["digest_lo"])


class Names(unittest.TestCase):
    def test_end_in_the_class_of_the_working_set(self):
        for name in names():
            if not name.startswith("bandwidth/"):
                self.assertIn(name.split("/")[-1], CLASSES, name)

    def test_are_those_that_the_filter_and_the_rows_know(self):
        for name in ("build/grid/200/1/L1", "build/grid/200/1/window/L1"):
            self.assertEqual(names(f"--benchmark_filter=^{name}$"), [name])
            self.assertEqual([row["name"] for row in rows(f"^{name}$")], [name])

    def test_with_a_minus_are_those_that_do_not_pass(self):
        everything, passed = names(), names("--benchmark_filter=^build/")
        self.assertTrue(passed)
        self.assertEqual(names("--benchmark_filter=-^build/"),
                         [name for name in everything if name not in passed])
        self.assertEqual(names("--benchmark_filter=all"), everything)

    def test_are_listed_once(self):
        everything = names("--fixed-iterations=5")
        self.assertEqual(everything, names())
        self.assertEqual(len(everything), len(set(everything)))


class FixedIterations(unittest.TestCase):
    def test_run_each_benchmark_exactly_so_often(self):
        for count in (1, 7, 130):
            for row in rows("^(build|validate)/grid/200/", f"--fixed-iterations={count}"):
                self.assertEqual(row["iterations"], count, row)

    def test_hold_for_each_repetition(self):
        found = rows("^build/grid/200/1/L1$", "--fixed-iterations", "3", "--benchmark_repetitions=4")
        iterations = [row["iterations"] for row in found if row["run_type"] == "iteration"]
        self.assertEqual(iterations, [3, 3, 3, 3])

    def test_that_make_no_sense_are_refused(self):
        for count in ("0", "-3", "many", "1.5"):
            self.assertEqual(run("--fixed-iterations", count).returncode, 2, count)


class Counters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rows = rows("-^bandwidth/", "--fixed-iterations=2")

    def test_are_on_every_row(self):
        self.assertGreater(len(self.rows), 200)
        for row in self.rows:
            self.assertNotIn("error_occurred", row)
            for counter in COUNTERS:
                self.assertIn(counter, row, row["name"])
            self.assertGreater(row["peak_bytes"], 1e6, row)
            is_serial = row["name"].split("/")[3] == "1"
            self.assertEqual("allocs" in row, is_serial, row["name"])
            self.assertEqual("alloc_bytes" in row, is_serial, row["name"])

    def test_give_each_result_its_size(self):
        for row in self.rows:
            is_record = row["name"].startswith("represent_build/")
            if is_record or row["name"].startswith(MAKES_A_MESH) and is_ours(row):
                self.assertGreater(row["bytes_per_halfedge"], 4, row["name"])
        flat = rows("^build/icosphere/320/1/L1$")[0]
        # 12 bytes of opposites a triangle and 2 of outgoing; the corners are the caller's.
        self.assertEqual(flat["bytes_per_halfedge"], (26 * 320 + 2 * 4) / (3 * 320))

    def test_count_allocations_of_builds_and_none_of_a_frame(self):
        for row in self.rows:
            if not is_ours(row) or "allocs" not in row:
                continue
            if row["name"].startswith(("face_normals/", "vertex_normals_", "one_ring/", "circulator/")):
                self.assertEqual((row["allocs"], row["alloc_bytes"]), (0, 0), row["name"])
            if row["name"].startswith(("build/", "fill_column/", "reorder_")):
                self.assertGreater(row["allocs"], 0, row["name"])
                self.assertGreater(row["alloc_bytes"], 64 * row["allocs"] / 8, row["name"])

    def test_have_one_digest_for_one_answer(self):
        for start in SAME_ANSWER:
            ours = [row for row in self.rows if row["name"].startswith(start) and is_ours(row)]
            self.assertGreater(len(ours), 1, start)
            self.assertEqual(len({digest(row) for row in ours}), 1, start)

    def test_have_other_digests_for_other_answers(self):
        starts = [digest(row) for start in SAME_ANSWER for row in self.rows
                  if row["name"].startswith(start + "/1/L1")]
        self.assertEqual(len(set(starts)), len(SAME_ANSWER))

    def test_are_the_same_again(self):
        again = {row["name"]: row for row in rows("-^bandwidth/", "--fixed-iterations=1")}
        for row in self.rows:
            for counter in ("digest_hi", "digest_lo", "allocs", "alloc_bytes", "bytes_per_halfedge"):
                self.assertEqual(row.get(counter), again[row["name"]].get(counter), row["name"])


class CommandLine(unittest.TestCase):
    def test_that_is_wrong_ends_with_2(self):
        for options in (["--benchmark_filter=("], ["--benchmark_filter=no such row"], ["--no-such-option"],
                        ["--benchmark_format=csv"], ["--count", "("], ["--count", "x", "--benchmark_filter=x"]):
            ran = run(*options)
            self.assertEqual(ran.returncode, 2, options)
            self.assertTrue(ran.stderr.startswith("hedgerow_bench: "), ran.stderr)

    def test_names_the_program_in_the_context(self):
        ran = run("--benchmark_filter=^build/grid/200/1/L1$", "--benchmark_format=json")
        self.assertEqual(json.loads(ran.stdout)["context"]["executable"], BENCH)


class Injection(unittest.TestCase):
    NAME = "build/grid/200/1/L1"
    OTHER = "build/scan/200/1/L1"

    def rows(self, program, setting):
        found = rows(f"^({self.NAME}|{self.OTHER})$", "--fixed-iterations=20", program=program,
                     PERFGATE_INJECT=setting)
        return {row["name"]: row for row in found}

    def test_slows_the_named_row_of_the_test_bench(self):
        found = self.rows(TEST_BENCH, f"{self.NAME}:+300%")
        self.assertNotIn("injected_ns", found[self.OTHER])
        share = found[self.NAME]["injected_ns"] * 1e-6 / found[self.NAME]["real_time"]
        self.assertGreater(share, 0)
        self.assertLess(share, 1)

    def test_needs_a_name(self):
        for row in self.rows(TEST_BENCH, "").values():
            self.assertNotIn("injected_ns", row)

    def test_is_not_in_the_bench_that_is_measured(self):
        for row in self.rows(BENCH, f"{self.NAME}:+300%").values():
            self.assertNotIn("injected_ns", row)

    def test_that_cannot_be_read_ends_with_2(self):
        for setting in ("x", "x:5%", "x:+5", "x:+%", "x:+five%", "x:+-5%"):
            ran = run(f"--benchmark_filter=^{self.NAME}$", program=TEST_BENCH, PERFGATE_INJECT=setting)
            self.assertEqual(ran.returncode, 2, setting)
            self.assertIn("PERFGATE_INJECT", ran.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
