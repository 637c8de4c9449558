#!/usr/bin/env python3
"""Inputs that are no inputs: each has its exit code and a message that names the place."""

import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import time
import unittest

import support
from runner import GateTest

FAST = {"sample_ms": 0.001, "epochs": 1, "looks": [10]}
GOOD = {"name": "a", "iterations": 10, "real_time": 1.0, "cpu_time": 1.0, "time_unit": "ns"}
WAIVER = {"benchmark": "^a$", "reason": "known and wanted", "owner": "ada", "expires": "2999-01-01",
          "max_ratio": 1.1}


def stored(*rows, **more):
    return json.dumps({"context": {}, "benchmarks": list(rows), **more})


# Configuration: name, text, what the message says.
CONFIGURATIONS = [
    ("c.json", "", "not JSON"),
    ("c.json", '{"margin": 0.0', "not JSON"),
    ("c.json", "[" * 100000, "nested too deeply"),
    ("c.json", "[1]", "a table is wanted"),
    ("c.json", '{"marginn": 1}', "unknown key 'marginn'; meant is perhaps 'margin'"),
    ("c.json", '{"margin": "2%"}', "margin is '2%'; a number from"),
    ("c.json", '{"margin": -0.1}', "margin is -0.1; a number from"),
    ("c.json", '{"margin": NaN}', "margin is nan; a number from"),
    ("c.json", '{"margin": true}', "margin is True; a number from"),
    ("c.json", '{"epochs": 2.5}', "epochs is 2.5; a whole number"),
    ("c.json", '{"looks": [24, 16]}', "even numbers in ascending order"),
    ("c.json", '{"looks": []}', "even numbers in ascending order"),
    ("c.json", '{"filter": "("}', "is no regular expression"),
    ("c.json", '{"noise_policy": "ignore"}', "known are refuse, widen, warn"),
    ("c.json", '{"suites": {"all": 7}}', "suites.all is 7; text is wanted"),
    ("c.json", '{"cores": ["one"]}', "cores[0] is 'one'"),
    ("c.json", '{"layouts": [{"name": "x"}]}', "the keys name, base and head are wanted"),
    ("c.json", '{"build": {"make": []}}', "build.make: unknown"),
    ("c.json", json.dumps({"waivers": [{**WAIVER, "owner": ""}]}), "waiver 1: owner is missing"),
    ("c.json", json.dumps({"waivers": [{**WAIVER, "reason": "ok"}]}), "says nothing"),
    ("c.json", json.dumps({"waivers": [{**WAIVER, "expires": "soon"}]}), "expires is 'soon'"),
    ("c.json", json.dumps({"waivers": [{**WAIVER, "max_ratio": 0.5}]}), "max_ratio is 0.5"),
    ("c.json", json.dumps({"waivers": [{**WAIVER, "arm": "luck"}]}), "arm is 'luck'"),
    ("c.json", json.dumps({"waivers": [{**WAIVER, "until": 1}]}), "unknown key 'until'"),
    ("c.yaml", "margin: 1", "a .toml or a .json file"),
    ("c.toml", "margin = ", "not TOML" if sys.version_info >= (3, 11) else "TOML needs Python 3.11"),
    ("c.json", b"\xff\xfe{}", "not UTF-8: byte 0"),
    ("c.json", None, "cannot be read: No such file"),
]

# Stored results: text of the head's file, exit code, what the message says.
RESULTS = [
    ("", 2, "not JSON"),
    ("{\"benchmarks\": [", 2, "not JSON"),
    ("[" * 100000, 2, "nested too deeply"),
    ("[]", 2, "list instead of an object"),
    ("{}", 2, "no list 'benchmarks'"),
    (stored(), 2, "no measurements"),
    (stored(7), 2, "row 1: int instead of an object"),
    (stored({**GOOD, "name": ""}), 2, "row 1: name is ''"),
    (stored({**GOOD, "name": 3}), 2, "row 1: name is 3"),
    (stored(GOOD, {**GOOD, "real_time": -1}), 2, "row 2 (a): real_time is -1"),
    (stored({**GOOD, "real_time": float("nan")}), 2, "real_time is nan"),
    (stored({**GOOD, "real_time": float("inf")}), 2, "real_time is inf"),
    (stored(GOOD).replace("1.0", "1e999"), 2, "real_time is inf"),
    (stored({**GOOD, "real_time": "1"}), 2, "real_time is '1'; a number is wanted"),
    (stored({**GOOD, "real_time": None}), 2, "real_time is None"),
    (stored({**GOOD, "time_unit": "years"}), 2, "time_unit is 'years'; known are ns, us, ms, s"),
    (stored({**GOOD, "iterations": 0}), 2, "iterations is 0"),
    (stored({**GOOD, "iterations": 1.5}), 2, "iterations is 1.5"),
    (stored({**GOOD, "run_type": "aggregate"}), 2, "no measurements"),
    (stored(GOOD, context=[]), 2, "context is no object"),
    (stored(GOOD, context={"json_schema_version": 9}), 3, "results have schema 9; known is 1"),
    (stored({**GOOD, "error_occurred": True, "error_message": "no mesh"}), 4, "the head says: no mesh"),
    (stored({**GOOD, "name": "b"}), 4, "does not declare it"),
    (b"{\"benchmarks\": [{\"name\": \"\xc3\"}]}", 2, "not UTF-8: byte"),
]

# What a program does besides measuring, its exit code, and what the message says.
PROGRAMS = [
    ({"ns": 1, "die": "SIGKILL"}, 4, "crashed with SIGKILL"),
    ({"ns": 1, "die": "SIGSEGV", "calls": 9}, 4, "crashed with SIGSEGV"),
    ({"ns": 1, "hang": 30, "calls": 5}, 4, "timed out after 2 s and was killed"),
    ({"ns": 1, "status": 3, "says": "out of memory"}, 4, "ended with status 1: out of memory"),
    ({"ns": 1, "garbage": "Segmentation fault"}, 4, "the head's output: not JSON"),
    ({"ns": 1, "garbage": ""}, 4, "the head's output: not JSON"),
    ({"ns": 1, "garbage": "{}"}, 4, "no list 'benchmarks'"),
    ({"ns": 1, "rename": "b"}, 4, "the head has no row of that name (it has b)"),
    ({"ns": -1}, 4, "real_time is -"),
    ({"ns": 1, "error": "answer is wrong"}, 4, "the head says: answer is wrong"),
]


class Malformed(GateTest):
    def test_there_are_forty_and_more(self):
        self.assertGreaterEqual(len(CONFIGURATIONS) + len(RESULTS) + len(PROGRAMS), 40)

    def place(self, name, text):
        path = self.folder / name
        path.unlink(missing_ok=True)
        if text is not None:
            path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def assert_one_line(self, ran):
        self.assertNotIn("Traceback", ran.stderr)
        self.assertRegex(ran.stderr, r"\Aperfgate: error: .+\n\Z")

    def test_configurations(self):
        programs = self.programs({"a": 1}, {"a": 1})
        for name, text, message in CONFIGURATIONS:
            with self.subTest(config=str(text)[:60]):
                path = self.place(name, text)
                ran = self.run_gate(*programs, "--config", path)
                self.assert_ends(ran, 2, name, message)
                self.assert_one_line(ran)
                self.assertFalse(self.log.exists(), "nothing has run")

    def test_stored_results(self):
        base = self.place("base.json", stored(*[GOOD] * 20))
        for text, code, message in RESULTS:
            with self.subTest(results=str(text)[:80]):
                head = self.place("head.json", text)
                ran = self.run_gate("--base", base, "--head", head)
                self.assert_ends(ran, code, message)
                if code != 4:
                    self.assertIn("head.json", ran.stderr)
                    self.assert_one_line(ran)

    def test_stored_results_that_are_odd_and_good(self):
        rows = [{**GOOD, "real_time": 100 + i % 3} for i in range(20)]
        for odd in ([{**row, "name": "K\u00e4se/\u6f22\U0001f9c0|<&>"} for row in rows],
                    [{**row, "real_time": 0} for row in rows],
                    [{**row, "extra": 1e308, "label": "x"} for row in rows],
                    rows + [{**GOOD, "run_type": "aggregate", "aggregate_name": "mean"}]):
            base = self.place("base.json", stored(*odd))
            ran = self.run_gate("--base", base, "--head", base)
            self.assert_ends(ran, 0, "stored results")

    def test_programs_that_misbehave(self):
        for row, code, message in PROGRAMS:
            with self.subTest(program=str(row)):
                for side in ("base", "head"):
                    (self.folder / f"{side}.calls").unlink(missing_ok=True)
                ran = self.run_gate(*self.programs({"a": 1, "good": 1}, {"a": row, "good": 1}),
                                    *self.config(timeout_s=2, **FAST))
                self.assert_ends(ran, code, message)
                self.assertEqual(self.row("good")["verdict"], "EQUIVALENT", "the others go on")

    def test_a_program_that_lists_nothing_or_cannot_list(self):
        ran = self.run_gate(*self.programs({}, {}), *self.config(**FAST))
        self.assert_ends(ran, 4, "lists no benchmarks")
        arguments = self.programs({"a": 1}, {"a": 1})
        self.place("head", "#!/bin/sh\nexit 7\n").chmod(0o755)
        self.assert_ends(self.run_gate(*arguments), 4, "ended with status 7")
        self.place("head", "no program\n").chmod(0o755)
        self.assert_ends(self.run_gate(*arguments), 4, "cannot be started")

    def test_a_filter_that_finds_nothing(self):
        ran = self.run_gate(*self.programs({"a": 1}, {"a": 1}), "--filter", "^z")
        self.assert_ends(ran, 4, "no benchmark is called '^z'")

    def test_builds_that_cannot_be_compared(self):
        def programs(base, head):
            return ("--base", self.program("base", {"a": 1}, context=base),
                    "--head", self.program("head", {"a": 1}, context=head), *self.config(**FAST))
        for key, before, after in (("compiler", "gcc 12", "gcc 13"), ("flags", "-O3", "-O2"),
                                   ("library_build_type", "release", "debug"),
                                   ("json_schema_version", 1, 2)):
            with self.subTest(key=key):
                message = "schema 2; known is 1" if key == "json_schema_version" else f"{key}: "
                self.assert_ends(self.run_gate(*programs({key: before}, {key: after})), 3, message)
        ran = self.run_gate(*programs({"flags": "Debug: -g"}, {"flags": "Debug: -g"}))
        self.assert_ends(ran, 3, "the base is a debug build")

    def test_the_command_line(self):
        programs = self.programs({"a": 1}, {"a": 1})
        stored_file = self.place("s.json", stored(GOOD))
        for arguments, message in (
                ([], "no command"), (["gate"], "invalid choice"), (["run", "--bass", "x"], "unrecognized"),
                (["run"], "--base and --head are wanted"), (["run", *programs[:2]], "--head are wanted"),
                (["run", *programs, "--base-ref", "HEAD"], "not both"),
                (["run", "--head-ref", "HEAD"], "--base-ref is missing"),
                (["run", *programs, "--quick", "--strict"], "not allowed with"),
                (["run", *programs, "--seed", "x"], "invalid int value"),
                (["run", *programs, "--budget", "0"], "--budget is 0.0; a number from 1"),
                (["run", "--base", "none", "--head", "none"], "none: no such file"),
                (["run", *programs[:3], str(stored_file)], "two programs or two sets"),
                (["aa", "--exe", programs[1], "--runs", "0"], "--runs is 0"),
                (["analyze", "none.json"], "none.json: cannot be read"),
                (["history", "chart", "none.jsonl"], "none.jsonl: cannot be read")):
            with self.subTest(arguments=arguments):
                ran = self.gate(*arguments)
                self.assert_ends(ran, 2, message)
                self.assert_one_line(ran)

    def test_reports_that_are_none(self):
        self.run_gate(*self.programs({"a": 1}, {"a": 1}), *self.config(**FAST))
        good = self.report()
        entry = good["benchmarks"][0]
        for change, message in (
                ([], "list instead of an object"), ({"schema": 99}, "schema is 99"),
                ({"benchmarks": 7}, "no list 'benchmarks'"), ({"config": {"x": 1}}, "unknown key 'x'"),
                ({"benchmarks": [entry, entry]}, "is there twice"),
                ({"benchmarks": [{**entry, "state": "odd"}]}, "state is 'odd'"),
                ({"benchmarks": [{**entry, "pairs": [["AA", 1, 1]]}]}, "pair 1 is"),
                ({"benchmarks": [{**entry, "pairs": [["AB", 1, -1]]}]}, "pair 1 has times 1 and -1"),
                ({"benchmarks": [{**entry, "mem": {"base": {}}}]}, "base and head are wanted"),
                ({"notes": "x"}, "notes is 'x'; list is wanted")):
            with self.subTest(change=str(change)[:70]):
                path = self.place("r.json", json.dumps({**good, **change} if change else change))
                ran = self.gate("analyze", path)
                self.assert_ends(ran, 2, message)
                self.assert_one_line(ran)


def has_ended(pid):
    """Within ten seconds: whoever inherits a killed child may take its time to collect it."""
    for _ in range(1000):
        try:
            state = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2]
        except OSError:
            return True
        if state.split()[0] in "ZX":
            return True
        time.sleep(0.01)
    return False


class Surroundings(GateTest):
    def test_a_folder_that_cannot_be_written_is_found_before_anything_runs(self):
        (self.folder / "file").write_text("x")
        ran = self.gate("run", "--out", self.folder / "file" / "out", "--no-probe",
                        *self.programs({"a": 1}, {"a": 1}))
        self.assert_ends(ran, 2, "cannot be written: Not a directory")
        self.assertFalse(self.log.exists())

    def test_a_full_disk_leaves_the_old_report(self):
        arguments = (*self.programs({"a": 1}, {"a": 1}), *self.config(**FAST))
        self.assert_ends(self.run_gate(*arguments), 0)
        before = (self.out / "report.json").read_bytes()
        ran = subprocess.run(
            [sys.executable, str(support.TOOLS / "perfgate"), "analyze", str(self.out / "report.json"),
             "--out", str(self.out), "--margin", "0.5"], check=False, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=self.environment(),
            preexec_fn=lambda: (signal.signal(signal.SIGXFSZ, signal.SIG_IGN),
                                resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))))
        self.assert_ends(ran, 2, "report.json: cannot be written: File too large")
        self.assertEqual((self.out / "report.json").read_bytes(), before)
        self.assertEqual([name for name in os.listdir(self.out) if name.startswith("report.json.")], [])

    def start(self, *arguments):
        return subprocess.Popen(
            [sys.executable, str(support.TOOLS / "perfgate"), "run", "--out", str(self.out),
             "--no-probe", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            cwd=self.folder, env=self.environment())

    def wait_for_pairs(self, count):
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if self.log.exists() and len(self.pair_calls()) >= count:
                return
            time.sleep(0.05)
        self.fail("no pair was measured")

    def slow(self):
        return (*self.programs({"a": {"ns": 1, "hang": 0.3, "calls": 4}}, {"a": 1}),
                *self.config(sample_ms=0.001, epochs=2))

    def test_two_gates_at_once_are_one_too_many(self):
        first = self.start(*self.slow())
        try:
            self.wait_for_pairs(1)
            second = self.run_gate(*self.slow())
            self.assert_ends(second, 3, f"another gate measures on this host (process {first.pid}")
        finally:
            first.send_signal(signal.SIGTERM)
            first.communicate(timeout=60)

    def test_an_interruption_keeps_what_was_measured_and_kills_the_children(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.log.unlink(missing_ok=True)
            gate = self.start(*self.slow())
            self.wait_for_pairs(8)
            gate.send_signal(number)
            out, err = gate.communicate(timeout=60)
            self.assertEqual(gate.returncode, 5, out + err)
            self.assertIn("INTERRUPTED", out)
            report = self.report()
            self.assertEqual(report["interrupted"], number.name)
            self.assertGreaterEqual(len(report["benchmarks"][0]["pairs"]), 2)
            last = self.calls()[-1][5]
            self.assertTrue(has_ended(last), "the child is gone")


if __name__ == "__main__":
    unittest.main()
