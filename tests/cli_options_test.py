#!/usr/bin/env python3
"""The program's options, exit statuses and messages. usage: cli_options_test.py PROGRAM"""

import json
import os
import pty
import resource
import signal
import subprocess
import sys
import unittest

from support import cli
from support.cli import ProgramTest

COMMANDS = ("inspect", "report", "normals", "render", "convert", "generate", "reorder", "repair",
            "subdivide", "decimate", "smooth", "delaunay", "voronoi")


def commands():
    """Those of a program with or without a ray tracer."""
    return tuple(name for name in COMMANDS if cli.RAYS or name != "render")


class Help(ProgramTest):
    def test_version_says_how_it_was_built(self):
        lines = self.done("--version").splitlines()
        self.assertRegex(lines[0], r"^hedgerow \d+\.\d+\.\d+$")
        fields = dict(line.split(None, 1) for line in lines[1:])
        self.assertEqual(set(fields), {"commit", "compiler", "indices", "SIMD"})
        self.assertRegex(fields["commit"], r"^(unknown|[0-9a-f]{12}(-changed)?)$")
        self.assertIn(fields["indices"], ("32 bits", "64 bits"))

    def test_help_lists_every_command_and_no_other(self):
        text = self.done("--help")
        listed = text[text.index("ommands:"):].split("\n\n")[0]
        names = tuple(line.split()[0] for line in listed.splitlines()[1:]
                      if line.startswith("  ") and line[2] != " ")
        self.assertEqual(names, commands())

    def test_every_command_has_help_with_an_example(self):
        for command in commands():
            text = self.done(command, "--help")
            self.assertIn(f"Example: hedgerow {command} ", text)
            for option in ("--json", "--threads", "--policy", "--strict", "--quiet",
                           "--no-progress"):
                self.assertIn(option, text)


class Usage(ProgramTest):
    def test_mistakes_end_with_status_2(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        for arguments in ((), ("--nonsense",), ("draw", mesh, "a.png"), ("inspect",),
                          ("inspect", mesh, "--nonsense"), ("inspect", mesh, "extra"),
                          ("inspect", mesh, "--threads", "0"),
                          ("inspect", mesh, "--threads", "two"),
                          ("inspect", mesh, "--policy", "nonsense=skip"),
                          ("inspect", mesh, "--policy", "isolated-vertex"),
                          ("inspect", mesh, "--policy", "out-of-range=split"),
                          ("inspect", mesh, "--policy", "non-finite=skip"),
                          ("normals", mesh, self.path("o.ply"), "--weight", "heavy"),
                          ("normals", mesh, self.path("o.ply"), "--method", "magic"),
                          ("normals", mesh, self.path("o.obj")),
                          ("convert", mesh, self.path("o.glb")),
                          ("convert", mesh, self.path("o.nonsense")),
                          ("generate", "nonsense", self.path("o.ply")),
                          ("generate", "grid", self.path("o.ply"), "--size", "0"),
                          ("reorder", mesh, self.path("o.ply"), "--order", "alphabetical")):
            with self.subTest(arguments=arguments):
                self.fails(2, *arguments)
        self.assertEqual(os.listdir(self.folder), ["a.obj"])

    def test_a_wrong_value_is_told_what_would_be_right(self):
        mesh, out = self.file("a.obj", cli.TETRAHEDRON), self.path("o.ply")
        for arguments, said in (
                (("generate", "grid", out, "--size", "0"),
                 '--size: takes a whole number, 1 or more, not "0"'),
                (("generate", "cone", out), "SHAPE: takes grid, "),
                (("repair", mesh, out, "--weld", "nan"),
                 '--weld: takes a number, 0 or more, not "nan"'),
                (("subdivide", mesh, out, "--scheme", "loop", "--levels", "1.5"),
                 '--levels: takes a whole number from 0 to 64, not "1.5"'),
                (("smooth", mesh, out, "--iterations", "9", "--step", "2"),
                 "--step: takes a number from 1e-06 to 1"),
                (("smooth", mesh, out), "--iterations is required"),
                (("reorder", mesh, out, "--order", "x"),
                 '--order: takes hilbert, morton, bfs, vertex-cache, fronts, not "x"'),
                (("voronoi", mesh, out, "--box", "1,2"), "--box: At least 4 required")):
            with self.subTest(arguments=arguments):
                self.assertIn(said, self.fails(2, *arguments))
        self.assertEqual(os.listdir(self.folder), ["a.obj"])

    def test_a_wrong_policy_names_what_would_be_right(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        self.assertIn("nonmanifold-edge", self.fails(2, "inspect", mesh, "--policy", "x=skip"))
        self.assertIn("fail, skip",
                      self.fails(2, "inspect", mesh, "--policy", "out-of-range=keep"))


class Input(ProgramTest):
    def test_a_missing_file_is_named(self):
        line = self.fails(3, "inspect", self.path("none.ply"))
        self.assertTrue(line.startswith(self.path("none.ply") + ": error: cannot-open: "))

    def test_a_folder_and_an_unknown_extension_are_refused(self):
        os.mkdir(self.path("folder.ply"))
        self.fails(3, "inspect", self.path("folder.ply"))
        self.fails(3, "inspect", self.file("a.xyz", "0 0 0\n"))

    def test_a_text_error_has_line_and_column(self):
        mesh = self.file("a.obj", "v 0 0 0\nv 1 zero 0\n")
        line = self.fails(3, "inspect", mesh, pattern=cli.TEXT_PLACE)
        self.assertTrue(line.startswith(f"{mesh}:2:5: error: "), line)

    def test_a_binary_error_has_a_byte(self):
        mesh = self.file("a.stl", b"\0" * 80 + b"\x02\0\0\0" + b"\0" * 50)
        self.fails(3, "inspect", mesh, pattern=cli.BINARY_PLACE)

    def test_an_index_out_of_range_names_face_index_and_count(self):
        mesh = self.file("a.obj", cli.OUT_OF_RANGE)
        line = self.fails(3, "inspect", mesh, pattern=cli.TEXT_PLACE)
        self.assertIn("index-out-of-range", line)
        for number in ("face 1", "9", "3"):
            self.assertIn(number, line)

    def test_the_policy_skip_drops_faces_out_of_range(self):
        mesh = self.file("a.obj", cli.OUT_OF_RANGE)
        report = self.json("inspect", mesh, "--policy", "out-of-range=skip")
        self.assertEqual((report["vertices"], report["faces"]), (3, 1))
        self.assertEqual(report["defects"][0]["kind"], "out-of-range")

    def test_coordinates_that_are_no_numbers_are_refused_unless_kept(self):
        mesh = self.file("a.obj", "v 0 0 0\nv nan 0 0\nv 0 inf 0\nf 1 2 3\n")
        self.fails(3, "inspect", mesh, pattern=cli.TEXT_PLACE)
        report = self.json("inspect", mesh, "--policy", "non-finite=keep")
        self.assertEqual((report["vertices"], report["faces"]), (3, 1))

    def test_a_policy_that_fails_names_the_defect(self):
        mesh = self.file("a.obj", cli.THREE_ON_AN_EDGE)
        line = self.fails(3, "inspect", mesh, "--policy", "nonmanifold-edge=fail")
        self.assertTrue(line.startswith(f"{mesh}: error: nonmanifold-edge: "), line)


def limit_file_size():
    """Makes every write behind byte 1000 of a file fail with EFBIG."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))


class Output(ProgramTest):
    def test_a_failed_run_leaves_the_old_file(self):
        good = self.file("good.obj", cli.TETRAHEDRON)
        bad = self.file("bad.obj", cli.OUT_OF_RANGE)
        open_mesh = self.file("open.obj", cli.THREE_ON_AN_EDGE)
        old = self.file("out.ply", "old contents")
        before = sorted(os.listdir(self.folder))
        grid = ("generate", "grid", old, "--size", "20000")
        for status, arguments, options in (
                (3, ("normals", bad, old), {}),
                (3, ("convert", bad, old), {}),
                (1, ("normals", open_mesh, old, "--strict"), {}),
                (1, ("convert", open_mesh, old, "--strict"), {}),
                (1, ("reorder", open_mesh, old, "--strict"), {}),
                (4, grid, {"preexec_fn": limit_file_size})):
            with self.subTest(arguments=arguments):
                self.fails(status, *arguments, **options)
                self.assertEqual((self.folder / "out.ply").read_text(), "old contents")
                self.assertEqual(sorted(os.listdir(self.folder)), before)
        self.done("convert", good, old)
        self.assertNotEqual((self.folder / "out.ply").read_bytes(), b"old contents")

    def test_an_output_that_cannot_be_made_ends_with_status_4(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        for arguments in (("convert", mesh, self.path("none/out.ply")),
                          ("normals", mesh, self.path("none/out.ply")),
                          ("generate", "grid", self.path("none/out.ply")),
                          ("repair", mesh, self.path("b.ply"), "--maps", self.path("none/maps")),
                          ("report", mesh, "--out", mesh)):
            with self.subTest(arguments=arguments):
                self.fails(4, *arguments)

    def test_standard_output_that_cannot_be_written_ends_with_status_4(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        with open("/dev/full", "wb") as full:
            result = subprocess.run([cli.PROGRAM, "inspect", mesh, "--json"], stdout=full,
                                    stderr=subprocess.PIPE, check=False, timeout=cli.TIMEOUT_S)
        self.assertEqual(result.returncode, 4)
        self.assertIn(b"standard output: error: ", result.stderr)


class Limits(ProgramTest):
    def test_more_elements_than_an_index_counts_end_with_status_5(self):
        wide = "64 bits" in self.done("--version")
        size = "4000000000000000000" if wide else "1000000000"
        self.fails(5, "generate", "grid", self.path("a.ply"), "--size", size)
        self.assertEqual(os.listdir(self.folder), [])

    def test_too_little_memory_ends_with_status_5(self):
        if cli.SANITIZED:
            self.skipTest("sanitizers need address space of their own")

        def limit_memory():
            resource.setrlimit(resource.RLIMIT_AS, (300 << 20, 300 << 20))

        line = self.fails(5, "generate", "grid", self.path("a.ply"), "--size", "50000000",
                          "--threads", "1", preexec_fn=limit_memory)
        self.assertIn("out-of-memory", line)


class Strict(ProgramTest):
    def test_defects_end_with_status_1_after_the_report(self):
        mesh = self.file("a.obj", cli.THREE_ON_AN_EDGE)
        self.assertEqual(self.json("inspect", mesh)["nonmanifold_edges"], 1)
        self.assertEqual(self.json("inspect", mesh, "--strict", status=1)["nonmanifold_edges"], 1)

    def test_a_sound_mesh_passes(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        self.json("inspect", mesh, "--strict")


def in_terminal(arguments, **environment):
    """Runs the program with a terminal as standard output and error; returns what it shows."""
    try:
        master, slave = pty.openpty()
    except OSError as error:  # a container without /dev/pts
        raise unittest.SkipTest(f"no terminal to be had: {error}") from error
    process = subprocess.Popen([cli.PROGRAM, *arguments], stdout=slave, stderr=slave,
                               env={**os.environ, "TERM": "xterm", **environment})
    os.close(slave)
    shown = b""
    while True:
        try:
            part = os.read(master, 4096)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        shown += part
    os.close(master)
    return process.wait(timeout=cli.TIMEOUT_S), shown.decode()


class Terminal(ProgramTest):
    def test_colour_is_for_terminals_and_yields_to_no_color(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        environment = {name: "" for name in ("NO_COLOR",)}
        self.assertIn("\x1b[", in_terminal(["inspect", mesh], **environment)[1])
        self.assertNotIn("\x1b[", in_terminal(["inspect", mesh], NO_COLOR="1")[1])
        self.assertNotIn("\x1b[", in_terminal(["inspect", mesh], TERM="dumb", **environment)[1])
        self.assertNotIn("\x1b", self.done("inspect", mesh))

    # With a delay of its own each run is long or short work on any machine.
    def test_a_progress_bar_is_for_terminals_and_long_work(self):
        mesh = self.file("a.obj", cli.shuffled_grid(40))
        work = ["normals", mesh, self.path("normals.ply")]
        bar = r"\[=* *\] +\d+%"
        at_once = {"HEDGEROW_PROGRESS_DELAY": "0"}
        self.assertRegex(in_terminal(work, **at_once)[1], bar)
        for quiet in ("--no-progress", "--quiet"):
            self.assertNotRegex(in_terminal(work + [quiet], **at_once)[1], bar)
        in_ten_minutes = {"HEDGEROW_PROGRESS_DELAY": "600000"}
        self.assertNotRegex(in_terminal(work, **in_ten_minutes)[1], bar)
        self.assertEqual(cli.run(*work)[2], "")


class Threads(ProgramTest):
    def test_every_thread_count_gives_the_same_digest(self):
        mesh = self.file("a.obj", cli.shuffled_grid(60))
        digests = {self.json("inspect", mesh, "--threads", threads)["digest"]
                   for threads in (1, 2, 3, 8, 16)}
        self.assertEqual(len(digests), 1)
        self.assertRegex(digests.pop(), r"^[0-9a-f]{16}$")


class Json(ProgramTest):
    def test_every_command_prints_one_object_and_nothing_else(self):
        mesh = self.file("a.obj", cli.CUBE)
        out = self.path("out.ply")
        for arguments in (("inspect", mesh), ("normals", mesh, out), ("convert", mesh, out),
                          ("generate", "torus", out), ("reorder", mesh, out),
                          ("repair", mesh, out), ("report", mesh, "--out", self.path("report"))):
            with self.subTest(arguments=arguments):
                status, text, errors = cli.run(*arguments, "--json")
                self.assertEqual((status, errors), (0, ""))
                self.assertIsInstance(json.loads(text), dict)


if __name__ == "__main__":
    cli.main(sys.argv)
