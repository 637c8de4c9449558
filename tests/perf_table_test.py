#!/usr/bin/env python3
"""Tests of bench/perf_table.py on results made by hand."""

import importlib.util
import json
import pathlib
import tempfile
import unittest

PATH = pathlib.Path(__file__).resolve().parent.parent / "bench" / "perf_table.py"
SPEC = importlib.util.spec_from_file_location("perf_table", PATH)
perf_table = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(perf_table)


def entry(name, milliseconds, **more):
    return {"name": name, "run_type": "iteration", "real_time": milliseconds, "time_unit": "ms",
            "bytes": 1e8, "halfedges": 1e7, "vertices": 2e6, "faces": 3e6, "mesh_bytes": 7.8e7,
            **more}


def document(*benchmarks):
    context = {"cpu": "a processor", "num_cpus": 2, "caches": [
        {"type": "Data", "level": 1, "size": 32768, "num_sharing": 1}],
        "library_build_type": "debug", "benchmark_library": "Google Benchmark 1.7.1",
        "executable": "x", "host_name": "y", "load_avg": [1]}
    return {"context": context, "benchmarks": list(benchmarks)}


def read(*benchmarks):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "results.json"
        perf_table.write_document(document(*benchmarks), path)
        return perf_table.read_results(path)


def line_of(table, start):
    """The cells of the one line of a table whose first cells are `start`."""
    prefix = "| " + " | ".join(start) + " |"
    lines = [line for line in table.splitlines() if line.startswith(prefix)]
    assert len(lines) == 1, (start, table)
    return [cell.strip() for cell in lines[0].strip("|").split("|")]


class ReadResults(unittest.TestCase):
    def test_takes_the_median_over_processes(self):
        _, rows = read(entry("build/grid/4M/1", 30), entry("build/grid/4M/1", 10),
                       entry("build/grid/4M/1", 20))
        self.assertEqual(rows["build/grid/4M/1"].ns, 20e6)
        self.assertEqual(rows["build/grid/4M/1"].spread, 1.0)

    def test_leaves_aggregates_out(self):
        _, rows = read(entry("build/grid/4M/1", 10),
                       {**entry("build/grid/4M/1", 99), "run_type": "aggregate"})
        self.assertEqual(rows["build/grid/4M/1"].times_ns, [10e6])

    def test_converts_units_of_time(self):
        _, rows = read({**entry("build/grid/10k/1", 5), "time_unit": "us"})
        self.assertEqual(rows["build/grid/10k/1"].ns, 5e3)


class Merge(unittest.TestCase):
    def test_keeps_every_process_and_nothing_that_names_the_host(self):
        merged = perf_table.merge([document(entry("a/b/c/1", 1)), document(entry("a/b/c/1", 2))])
        self.assertEqual([e["real_time"] for e in merged["benchmarks"]], [1, 2])
        self.assertEqual(merged["context"]["processes"], "2")
        self.assertNotIn("host_name", merged["context"])
        self.assertNotIn("executable", merged["context"])


class Tables(unittest.TestCase):
    def test_give_rates_and_the_share_of_the_bandwidth(self):
        context, rows = read(entry("bandwidth/copy/3MiB/1", 10), entry("build/grid/4M/1", 20),
                             entry("bandwidth/copy-streaming/3MiB/1", 5),
                             entry("bandwidth/copy/3MiB/2", 1))
        table = perf_table.all_tables()["build"](context, rows)
        cells = line_of(table, ["build/grid/4M", "1"])
        # 20 ms for 1e7 half-edges and 1e8 bytes; the faster of the two copies moves 20 GB/s.
        self.assertEqual(cells[2:], ["20.0", "0 %", "500", "2.00", "10.0", "5.00", "25 %"])

    def test_give_ratios_to_the_same_dataset_and_show_where_we_lose(self):
        context, rows = read(entry("one_ring/grid/4M/2", 20), entry("one_ring/grid/4M/1/cgal", 60),
                             entry("one_ring/grid/4M/1/openmesh", 10),
                             entry("one_ring/shuffled/4M/1/openmesh", 999))
        table = perf_table.all_tables()["queries"](context, rows)
        header = [cell.strip() for cell in table.splitlines()[0].strip("|").split("|")]
        cells = dict(zip(header, line_of(table, ["one_ring/grid/4M", "2"])))
        self.assertEqual((cells["x openmesh"], cells["x cgal"]), ("0.50", "3.00"))
        # The row of a peer has no ratio.
        peer = dict(zip(header, line_of(table, ["one_ring/grid/4M/openmesh", "1"])))
        self.assertEqual((peer["ms"], peer["x openmesh"]), ("10.0", ""))

    def test_measure_the_face_list_against_the_peers_own_vertex_normals(self):
        context, rows = read(entry("vertex_normals_facelist/grid/4M/1", 10),
                             entry("vertex_normals_halfedge/grid/4M/1/openmesh", 70))
        table = perf_table.all_tables()["normals"](context, rows)
        self.assertEqual(line_of(table, ["vertex_normals_facelist/grid/4M", "1"])[-1], "7.00")

    def test_show_what_was_not_measured_and_why(self):
        context, rows = read({"name": "build/grid/4M/1/openmesh", "run_type": "iteration",
                              "error_occurred": True, "error_message": "refuses a face"})
        table = perf_table.all_tables()["build"](context, rows)
        self.assertIn("not measured: refuses a face", table)

    def test_say_which_targets_are_missed(self):
        context, rows = read(entry("build/grid/4M/2", 10), entry("build/grid/4M/1/openmesh", 90),
                             entry("build/grid/4M/1/cgal", 79), entry("face_normals/grid/4M/2", 10),
                             entry("face_normals/grid/4M/1/openmesh", 40))
        table = perf_table.targets_table(context, rows)
        # The faster of the two peers counts.
        self.assertEqual(line_of(table, ["build, ordered grid"])[-2:], ["8 x", "7.90 x (missed)"])
        self.assertEqual(line_of(table, ["face normals"])[-1], "4.00 x")
        self.assertEqual(line_of(table, ["build, shuffled grid"])[-1], "not measured")
        self.assertEqual(line_of(table, ["connectivity, bytes a triangle"])[-1], "26.00")

    def test_write_numbers_with_three_digits_and_no_exponent(self):
        self.assertEqual([perf_table.number(x) for x in (0, 0.0123, 0.5, 9.999, 12.34, 1234.5)],
                         ["0", "0.0123", "0.50", "10.00", "12.3", "1234"])


class Rewrite(unittest.TestCase):
    def text(self, names):
        return "".join(f"prose of {name}\n<!-- table:{name} begin -->\nold\n"
                       f"<!-- table:{name} end -->\n" for name in names) + "last words\n"

    def test_replaces_what_is_between_the_markers_and_nothing_else(self):
        results = read(entry("build/grid/4M/1", 20))
        names = list(perf_table.all_tables())
        once = perf_table.rewrite(self.text(names), *results)
        self.assertNotIn("old\n", once)
        self.assertIn("| build/grid/4M | 1 | 20.0 |", once)
        for name in names:
            self.assertIn(f"prose of {name}\n<!-- table:{name} begin -->\n", once)
        self.assertTrue(once.endswith("last words\n"))
        self.assertEqual(perf_table.rewrite(once, *results), once)

    def test_refuses_a_text_without_the_markers(self):
        with self.assertRaises(SystemExit):
            perf_table.rewrite(self.text(["machine"]), *read(entry("build/grid/4M/1", 20)))

    def test_check_fails_on_a_number_typed_by_hand(self):
        with tempfile.TemporaryDirectory() as folder:
            perf = pathlib.Path(folder) / "PERF.md"
            results = pathlib.Path(folder) / "results.json"
            perf_table.write_document(document(entry("build/grid/4M/1", 20)), results)
            perf.write_text(self.text(list(perf_table.all_tables())), encoding="utf-8")
            arguments = ["--perf", str(perf), "--results", str(results)]
            self.assertEqual(perf_table.main(arguments), 0)
            self.assertEqual(perf_table.main([*arguments, "--check"]), 0)
            perf.write_text(perf.read_text(encoding="utf-8").replace("20.0", "19.0"),
                            encoding="utf-8")
            self.assertEqual(perf_table.main([*arguments, "--check"]), 1)


class Context(unittest.TestCase):
    def test_says_that_the_library_is_a_debug_build(self):
        table = perf_table.machine_table(*read(entry("build/grid/4M/1", 20)))
        self.assertIn("debug build", table)
        self.assertIn("a processor", table)
        self.assertIn("L1 Data 32 KiB x2", table)

    def test_says_how_much_of_the_time_others_took(self):
        table = perf_table.machine_table(*read(
            entry("build/grid/4M/1", 20, processor_ns=15e6), entry("one_ring/grid/4M/1", 20,
                                                                   processor_ns=5e6),
            entry("build/grid/4M/2", 20, processor_ns=40e6)))
        self.assertIn("50 % of the serial rows'", table)

    def test_is_stored_as_json(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a" / "results.json"
            perf_table.write_document(document(entry("a/b/c/1", 1)), path)
            self.assertEqual(json.loads(path.read_text())["benchmarks"][0]["name"], "a/b/c/1")


if __name__ == "__main__":
    unittest.main()
