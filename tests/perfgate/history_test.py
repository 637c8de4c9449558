#!/usr/bin/env python3
"""Histories: what is appended, what is read back, and which drifts are found; and the noise of a host."""

import json
import os
import random
import subprocess
import sys
import unittest

import support
from perfgate.history.changepoints import changes
from runner import GateTest

FAST = {"sample_ms": 0.001, "epochs": 1, "looks": [10]}


def noisy(level, count, seed, spread=0.01):
    draw = random.Random(seed)
    return [level * (1 + draw.uniform(-spread, spread)) for _ in range(count)]


class ChangePoints(unittest.TestCase):
    def test_a_step_is_found_where_it_is(self):
        for seed in range(10):
            found = changes(noisy(100, 20, seed) + noisy(106, 20, seed + 100))
            self.assertEqual(len(found), 1, seed)
            self.assertAlmostEqual(found[0].index, 20, delta=2)
            self.assertAlmostEqual(found[0].ratio, 1.06, delta=0.01)

    def test_ten_steps_of_one_percent_are_no_secret(self):
        drift = [value for step in range(11) for value in noisy(100 * 1.01**step, 5, step, 0.02)]
        found = changes(drift)
        self.assertGreaterEqual(len(found), 1)
        self.assertGreater(found[-1].after / found[0].before, 1.05)

    def test_noise_alone_is_rarely_taken_for_a_change(self):
        wrong = sum(bool(changes(noisy(100, 40, seed))) for seed in range(200))
        self.assertLessEqual(wrong, 6, "a level of one percent")

    def test_one_slow_day_is_no_change(self):
        values = noisy(100, 40, 3)
        values[17] = 300
        self.assertEqual(changes(values), [])

    def test_the_same_series_gives_the_same_changes(self):
        values = noisy(100, 20, 1) + noisy(104, 20, 2)
        self.assertEqual(changes(values), changes(values))

    def test_short_and_constant_series_have_none(self):
        for values in ([], [1.0], [1.0, 2.0], [5.0] * 50, [1.0, 1.0, 9.0, 9.0, 9.0]):
            self.assertEqual(changes(values), [])


class History(GateTest):
    def setUp(self):
        super().setUp()
        self.store = self.folder / "store.jsonl"

    def write(self, values, name="a", host="here"):
        lines = [{"schema": 1, "sha": f"{i:040x}", "started": "", "host_class": host,
                  "benchmarks": {name: {"ns": value}}} for i, value in enumerate(values)]
        with open(self.store, "a", encoding="utf-8") as file:
            file.writelines(json.dumps(line) + "\n" for line in lines)

    def test_reports_are_appended_and_read_back(self):
        self.run_gate(*self.programs({"a": 100}, {"a": 101}), *self.config(**FAST))
        for sha in ("abc", "def"):
            self.assert_ends(self.gate("history", "add", self.store, self.out / "report.json",
                                       "--sha", sha), 0, f"1 benchmarks of {sha} added")
        lines = [json.loads(line) for line in self.store.read_text().splitlines()]
        self.assertEqual([line["sha"] for line in lines], ["abc", "def"])
        self.assertEqual(lines[0]["benchmarks"]["a"]["ns"], 101)

    def test_a_report_without_a_commit_wants_one(self):
        self.run_gate(*self.programs({"a": 100}, {"a": 100}), *self.config(**FAST))
        self.assert_ends(self.gate("history", "add", self.store, self.out / "report.json"), 2, "--sha")
        self.assertFalse(self.store.exists())

    def test_many_writers_at_once_leave_whole_lines(self):
        self.run_gate(*self.programs({"a": 100}, {"a": 101}), *self.config(**FAST))
        writers = [subprocess.Popen([sys.executable, str(support.TOOLS / "perfgate"), "history", "add",
                                     str(self.store), str(self.out / "report.json"), "--sha", str(i)],
                                    stdout=subprocess.DEVNULL) for i in range(8)]
        self.assertEqual([writer.wait(timeout=60) for writer in writers], [0] * 8)
        shas = {json.loads(line)["sha"] for line in self.store.read_text().splitlines()}
        self.assertEqual(shas, {str(i) for i in range(8)})

    def test_a_line_that_was_cut_off_is_not_written_behind(self):
        self.run_gate(*self.programs({"a": 100}, {"a": 101}), *self.config(**FAST))
        self.store.write_text('{"schema": 1, "sha"')
        self.assert_ends(self.gate("history", "add", self.store, self.out / "report.json", "--sha", "x"),
                         2, "a write was cut off there")
        self.assertEqual(self.store.read_text(), '{"schema": 1, "sha"')

    def test_drift_is_an_exit_code(self):
        self.write(noisy(100, 20, 1) + noisy(108, 20, 2))
        ran = self.gate("history", "changepoints", self.store)
        self.assert_ends(ran, 1, "SLOWER a", "1 changes in 1 benchmarks on here")
        found = json.loads(self.gate("history", "changepoints", self.store, "--json").stdout)
        self.assertAlmostEqual(found["changes"][0]["index"], 20, delta=2)
        self.assert_ends(self.gate("history", "changepoints", self.store, "--margin", "0.2"), 0)

    def test_hosts_are_not_mixed(self):
        self.write(noisy(100, 20, 1), host="old")
        self.write(noisy(300, 20, 2), host="new")
        self.assert_ends(self.gate("history", "changepoints", self.store), 0, "on new")
        self.assert_ends(self.gate("history", "changepoints", self.store, "--host", "none"), 2,
                         "nothing was measured on 'none'")

    def test_a_chart_is_one_page(self):
        self.write(noisy(100, 20, 1), name="<b>&")
        page = self.folder / "page.html"
        self.assert_ends(self.gate("history", "chart", self.store, "--out", page), 0)
        text = page.read_text(encoding="utf-8")
        self.assertIn("&lt;b&gt;&amp;", text)
        self.assertEqual(text.count("<svg"), 1)

    def test_broken_histories(self):
        good = json.dumps({"schema": 1, "benchmarks": {"a": {"ns": 1}}})
        for text, message in (("", "an empty history"), ("{", ":1: not JSON"),
                              (good + "\n[]", ":2: not a line of a history"),
                              (good.replace("1,", "7,"), "not a line of a history of schema 1"),
                              (good.replace('{"a": {"ns": 1}}', "3"), "benchmarks is no object"),
                              (good.replace('"ns": 1', '"ns": -1'), "a: ns is -1"),
                              (good.replace('"ns": 1', '"ns": NaN'), "a: ns is nan")):
            with self.subTest(text=text):
                self.store.write_text(text)
                self.assert_ends(self.gate("history", "changepoints", self.store), 2, message)


class Noise(GateTest):
    def test_a_host_is_probed_and_judged(self):
        ran = self.gate("host", "--seconds", "0.3", "--limit", "9", "--json")
        self.assert_ends(ran, 0)
        facts = json.loads(ran.stdout)
        self.assertEqual(set(facts["probe"]), {"alu_sd", "l2_sd", "dram_sd"})
        self.assertEqual(facts["cores"], os.cpu_count())
        self.assert_ends(self.gate("host", "--seconds", "0.3", "--limit", "0"), 3, "unfit")

    def test_a_program_against_itself(self):
        path = self.program("base", {"a": [100, 101, 99, 100, 102], "b": 50})
        file = self.folder / "calibration.json"
        arguments = ("aa", "--exe", path, "--no-probe", "--calibration", file,
                     *self.config(**FAST))
        self.assert_ends(self.gate(*arguments, "--runs", 2), 0, "same program: 0 of 2 runs red")
        self.assert_ends(self.gate(*arguments, "--runs", 1), 0, "0 of 3 runs red")
        found = json.loads(file.read_text())
        self.assertEqual(found["benchmarks"]["b"], {"pairs": 30, "mad": 0.0, "sd": 0.0, "tie_rate": 1.0,
                                                    "recommended_margin": 0.0})
        self.assertGreater(found["benchmarks"]["a"]["recommended_margin"], 0.0)
        other = self.program("other", {"a": 100, "b": 60})
        self.assert_ends(self.gate(*arguments, "--runs", 1, "--other", other), 1,
                         "RED b", "separate builds: 1 of 1 runs red")

    def test_a_calibration_widens_the_margin(self):
        path = self.program("base", {"a": 100})
        file = self.folder / "calibration.json"
        self.gate("aa", "--exe", path, "--no-probe", "--calibration", file, "--runs", 1,
                  *self.config(**FAST))
        document = json.loads(file.read_text())
        document["benchmarks"]["a"].update(mad=0.05)
        file.write_text(json.dumps(document))
        programs = self.programs({"a": 100}, {"a": 110})
        self.assert_ends(self.run_gate(*programs, *self.config(calibration=str(file), **FAST)), 0)
        self.assertAlmostEqual(self.row("a")["margin"], 1.1618, places=3)
        self.assert_ends(self.run_gate(*programs, *self.config(**FAST)), 1)


if __name__ == "__main__":
    unittest.main()
