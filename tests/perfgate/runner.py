"""Runs perfgate as its users do, on scripted programs in a folder of their own."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from support import TOOLS

FAKE = pathlib.Path(__file__).resolve().parent / "fake_bench.py"


class GateTest(unittest.TestCase):
    """A folder with programs `base` and `head`, and the gate to compare them."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="perfgate_test_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.log = self.folder / "calls.log"
        self.out = self.folder / "out"

    def program(self, side, names, **scenario):
        """Writes a scripted program and returns its path. A plain number is a time."""
        path = self.folder / side
        path.write_text(f"#!{sys.executable} -SE\n" + FAKE.read_text(encoding="utf-8"), encoding="utf-8")
        path.chmod(0o755)
        rows = {name: row if isinstance(row, dict) else {"ns": row} for name, row in names.items()}
        (self.folder / f"{side}.json").write_text(
            json.dumps({"names": rows, "log": str(self.log), **scenario}), encoding="utf-8")
        return str(path)

    def programs(self, base, head, **scenario):
        return ["--base", self.program("base", base, **scenario),
                "--head", self.program("head", head, **scenario)]

    def config(self, **table):
        path = self.folder / "config.json"
        path.write_text(json.dumps(table), encoding="utf-8")
        return ["--config", str(path)]

    def gate(self, *arguments, env=None, timeout=300):
        return subprocess.run([sys.executable, str(TOOLS / "perfgate"), *map(str, arguments)],
                              check=False, text=True, timeout=timeout, cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=self.environment(env))

    def environment(self, more=None):
        clean = {key: value for key, value in os.environ.items() if not key.startswith("GITHUB_")}
        # A lock of its own: tests run beside each other.
        return {**clean, "PERFGATE_LOCK": str(self.folder / "lock"), **(more or {})}

    def run_gate(self, *arguments, **options):
        """`perfgate run` with a seed and without the probe of the host."""
        return self.gate("run", "--out", self.out, "--seed", 7, "--no-probe", *arguments, **options)

    def report(self):
        return json.loads((self.out / "report.json").read_text(encoding="utf-8"))

    def row(self, name):
        return next(row for row in self.report()["benchmarks"] if row["name"] == name)

    def calls(self):
        """What ran, in order: [program, name, iterations, repetitions, padding, pid]."""
        return [json.loads(line) for line in self.log.read_text(encoding="utf-8").splitlines()]

    def pair_calls(self):
        """The calls that measured pairs: those with all epochs."""
        return [call for call in self.calls() if call[3] > 2]

    def assert_ends(self, ran, code, *texts):
        self.assertEqual(ran.returncode, code, ran.stdout + ran.stderr)
        for text in texts:
            self.assertIn(text, ran.stdout + ran.stderr)
