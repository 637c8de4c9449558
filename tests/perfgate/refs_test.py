#!/usr/bin/env python3
"""The gate on two commits, which it builds itself. usage: refs_test.py"""

import json
import shutil
import subprocess
import unittest

from runner import FAKE, GateTest

# A project in which nothing is compiled: the scripted program tells of the flags of its build.
CMAKE = """cmake_minimum_required(VERSION 3.16)
project(toy NONE)
set(flags "$ENV{CXXFLAGS}")
if(CMAKE_CXX_FLAGS)
  set(flags "${CMAKE_CXX_FLAGS}")
endif()
configure_file(bench.py ${CMAKE_BINARY_DIR}/bench COPYONLY)
configure_file(bench.json.in ${CMAKE_BINARY_DIR}/bench.json @ONLY)
"""


@unittest.skipUnless(shutil.which("git") and shutil.which("cmake"), "git or cmake is missing")
class Refs(GateTest):
    def setUp(self):
        super().setUp()
        self.git("init", "-q", "-b", "main")
        self.git("config", "user.name", "toy")
        self.git("config", "user.email", "toy@example.org")
        (self.folder / "CMakeLists.txt").write_text(CMAKE, encoding="utf-8")
        self.program("bench.py", {})
        (self.folder / "bench.py.json").unlink()
        self.options = self.config(
            build={"executable": "bench", "configure": ["-DCMAKE_BUILD_TYPE=Release"]},
            sample_ms=1, instructions=False)

    def git(self, *arguments):
        subprocess.run(["git", *arguments], check=True, cwd=self.folder, stdout=subprocess.DEVNULL)

    def commit(self, nanoseconds, flags="@flags@"):
        scenario = {"names": {"pass/1k": {"ns": nanoseconds}}, "context": {"flags": flags}}
        (self.folder / "bench.json.in").write_text(json.dumps(scenario), encoding="utf-8")
        self.git("add", "CMakeLists.txt", "bench.py", "bench.json.in")
        self.git("commit", "-q", "--allow-empty", "-m", f"{nanoseconds} ns")

    def test_commits_are_built_and_compared(self):
        self.commit(1000)
        self.commit(1000)
        self.assert_ends(self.run_gate("--base-ref", "HEAD~1", *self.options), 0, "1 EQUIVALENT")
        self.commit(1500)
        self.assert_ends(self.run_gate("--base-ref", "HEAD~1", *self.options), 1, "pass/1k")

    def test_each_was_told_of_its_folder_and_of_nothing_else(self):
        self.commit(1000)
        self.commit(1000)
        self.assert_ends(self.run_gate("--base-ref", "HEAD~1", *self.options), 0)
        report = json.dumps(self.report())
        self.assertIn("-ffile-prefix-map=", report)

    def test_other_flags_are_no_comparison(self):
        self.commit(1000)
        self.commit(1000, "@flags@ -O1")
        self.assert_ends(self.run_gate("--base-ref", "HEAD~1", *self.options), 3,
                         "built differently", "-O1")

    def test_a_commit_that_does_not_build_is_named(self):
        self.commit(1000)
        (self.folder / "CMakeLists.txt").write_text("message(FATAL_ERROR no)", encoding="utf-8")
        self.commit(1000)
        self.assert_ends(self.run_gate("--base-ref", "HEAD~1", *self.options), 3, "configure.log")

    def test_a_commit_that_is_none_is_named(self):
        self.commit(1000)
        self.assert_ends(self.run_gate("--base-ref", "nonsense", *self.options), 2,
                         "nonsense: no such commit")


if __name__ == "__main__":
    unittest.main()
