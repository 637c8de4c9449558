#!/usr/bin/env python3
"""Tests of bench/perf_table.py and what it is made of, on results made by hand."""

import json
import pathlib
import tempfile
import unittest

from perf_support import NO_COUNTS, bandwidth, document, entry, line_of, results, verdict_of

import count
import perf_format
import perf_frames
import perf_imr
import perf_planar
import perf_representations
import perf_results
import perf_table
import perf_tables
import perf_targets


class ResultsOfARun(unittest.TestCase):
    def test_give_the_median_and_the_middle_half_of_the_times(self):
        row = results(entry("build/grid/4M/1", [30, 10, 20, 1000, 15])).get("build/grid/4M/1")
        self.assertEqual(row.ns, 20e6)
        self.assertEqual(row.spread, 0.75)

    def test_limit_is_the_best_kernel_of_the_mix_with_no_more_threads(self):
        both = results(entry("build/grid/4M/1", 10),
                       entry("build/grid/4M/2", 5, gb_per_s={"copy": 12.0, "copy-streaming": 16.0}))
        # Two threads may not be held to less than one of them moved alone.
        self.assertEqual(both.limit_gb_per_s(both.get("build/grid/4M/2")), 20.0)
        self.assertEqual(both.share(both.get("build/grid/4M/1")), 0.5)

    def test_rows_of_narrower_paths_become_variants(self):
        narrower = document(bandwidth("copy", 1, copy=1.0), entry("build/grid/4M/1", 2))
        merged = perf_results.merge(document(entry("build/grid/4M/1", 1)),
                                    {"portable": narrower, "avx2": narrower})
        self.assertEqual([row["name"] for row in merged["rows"]],
                         ["build/grid/4M/1", "build/grid/4M/1/portable", "build/grid/4M/1/avx2"])

    def test_are_stored_as_json(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a" / "results.json"
            perf_results.write_document(document(entry("a/b/4k/1", 1)), path)
            self.assertEqual(json.loads(path.read_text())["rows"][0]["name"], "a/b/4k/1")
            self.assertEqual(perf_results.read_results(path).get("a/b/4k/1").ns, 1e6)


class Tables(unittest.TestCase):
    def test_give_rates_an_element_and_the_share_of_the_limit(self):
        table = perf_tables.all_tables()["build"](results(entry("build/grid/4M/1", 20)), NO_COUNTS)
        cells = line_of(table, ["build/grid/4M", "1"])
        # 20 ms for 12e6 half-edges and 1e8 bytes; the faster of the two copies moves 20 GB/s.
        self.assertEqual((cells["ms"], cells["ns/half-edge"], cells["B/half-edge"], cells["GB/s"],
                          cells["of limit"]), ("20.0", "1.67", "8.33", "5.00", "25 %"))

    def test_show_the_paths_side_by_side_and_not_among_the_operations(self):
        rows = results(entry("build/grid/4M/1", 10), entry("build/grid/4M/1/avx2", 20),
                       entry("build/grid/4M/1/portable", 30))
        cells = line_of(perf_tables.all_tables()["paths"](rows, NO_COUNTS), ["build/grid/4M", "1"])
        self.assertEqual((cells["widest, ms"], cells["AVX2, ms"], cells["portable, ms"]),
                         ("10.0", "20.0", "30.0"))
        self.assertEqual((cells["AVX2/widest"], cells["portable/AVX2"]), ("2.00", "1.50"))
        self.assertNotIn("avx2", perf_tables.all_tables()["build"](rows, NO_COUNTS))

    def test_give_ratios_to_the_same_dataset_and_show_where_we_lose(self):
        table = perf_tables.all_tables()["queries"](
            results(entry("one_ring/grid/4M/2", 20), entry("one_ring/grid/4M/1/cgal", 60),
                    entry("one_ring/grid/4M/1/openmesh", 10),
                    entry("one_ring/shuffled/4M/1/openmesh", 999)), NO_COUNTS)
        cells = line_of(table, ["one_ring/grid/4M", "2"])
        self.assertEqual((cells["x openmesh"], cells["x cgal"]), ("0.50", "3.00"))
        # The row of a peer has no ratio.
        peer = line_of(table, ["one_ring/grid/4M/openmesh", "1"])
        self.assertEqual((peer["ms"], peer["x openmesh"]), ("10.0", ""))

    def test_measure_the_face_list_against_the_peers_own_vertex_normals(self):
        table = perf_tables.all_tables()["vertex-normals"](
            results(entry("vertex_normals_facelist/grid/4M/1", 10),
                    entry("vertex_normals_halfedge/grid/4M/1/openmesh", 70)), NO_COUNTS)
        cells = line_of(table, ["vertex_normals_facelist/grid/4M", "1"])
        self.assertEqual((cells["x openmesh"], cells["ns/vertex"]), ("7.00", "5.00"))

    def test_show_what_was_not_measured_and_why(self):
        table = perf_tables.all_tables()["build"](
            results({"name": "build/grid/4M/1/openmesh", "error": "refuses a face"}), NO_COUNTS)
        self.assertIn("not measured: refuses a face", table)

    def test_put_the_fastest_peer_on_the_front_page(self):
        table = perf_tables.headline_table(
            results(entry("build/grid/4M/2", 10), entry("build/grid/4M/1/openmesh", 90),
                    entry("build/grid/4M/1/cgal", 80)), NO_COUNTS)
        self.assertEqual(list(line_of(table, ["build, ordered grid"]).values()),
                         ["build, ordered grid", "10.0 ms", "80.0 ms (cgal)", "8.00 x"])

    def test_put_both_forms_side_by_side(self):
        table = perf_tables.all_tables()["views"](
            results(entry("one_ring/grid/4M/1", 20), entry("one_ring/grid/4M/1/stored", 30)), NO_COUNTS)
        self.assertEqual(line_of(table, ["one_ring/grid/4M", "1"])["stored/implicit"], "1.50")

    def test_show_a_wrong_choice_of_the_builder(self):
        table = perf_tables.all_tables()["strategy"](
            results(entry("strategy/moved-5/1M/1", 40, is_window=1),
                    entry("strategy/moved-5/1M/1/window", 40, scans_per_face=3.5),
                    entry("strategy/moved-5/1M/1/partition", 20)), NO_COUNTS)
        cells = line_of(table, ["moved-5/1M"])
        self.assertEqual((cells["scans a face"], cells["chosen"], cells["the other takes, times"]),
                         ("3.50", "window", "0.50"))

    def test_show_all_sizes_of_an_order(self):
        table = perf_tables.all_tables()["sizes"](
            results(entry("build/scan/4M/1", 12), entry("build/scan/4M/2", 6),
                    entry("build/scan/10k/1", 24)), NO_COUNTS)
        self.assertEqual(line_of(table, ["scan/4M"])["build, ns/half-edge"], "1.00 / 0.50")
        self.assertEqual(line_of(table, ["scan/10k"])["build, ns/half-edge"], "2.00 / -")

    def test_say_how_much_of_the_time_others_took(self):
        table = perf_tables.machine_table(
            results(entry("build/grid/4M/1", 20, processor_ns=15e6),
                    entry("one_ring/grid/4M/1", 20, processor_ns=5e6),
                    entry("build/grid/4M/2", 20, processor_ns=40e6)), NO_COUNTS)
        self.assertIn("50 % of the serial rows'", table)
        self.assertIn("L1 data 32 KiB", table)

    def test_write_numbers_with_three_digits_and_no_exponent(self):
        self.assertEqual([perf_format.number(x) for x in (0, 0.0123, 0.5, 9.999, 12.34, 1234.5)],
                         ["0", "0.0123", "0.50", "10.00", "12.3", "1234"])


class Targets(unittest.TestCase):
    def test_are_met_missed_or_not_measured(self):
        rows = (entry("build/grid/4M/2", 10), entry("build/grid/4M/1/openmesh", 90),
                entry("build/grid/4M/1/cgal", 79))
        # The faster of the two peers counts.
        self.assertEqual(verdict_of(perf_targets.FOUNDATION, "build, ordered", *rows),
                         (7.9, "**missed**"))
        self.assertEqual(verdict_of(perf_targets.FOUNDATION, "build, shuffled", *rows),
                         (None, "not measured"))
        self.assertEqual(verdict_of(perf_targets.FOUNDATION, "connectivity", *rows), (26.0, "met"))

    def test_with_an_alternative_are_met_by_either(self):
        rows = (entry("build/grid/4M/1", 100), bandwidth("triad", 1, triad=10.0))
        # 1 GB/s where the limit is 20, but 120 M half-edges/s on half of the stated bandwidth.
        self.assertEqual(verdict_of(perf_targets.TARGETS, "build, ordered, 1 thread, at", *rows),
                         (240.0, "met"))
        self.assertEqual(verdict_of(perf_targets.TARGETS, "build, ordered, 1 thread, times", *rows)[1],
                         "met by the other")

    def test_reach_the_moonshot(self):
        rows = (entry("build/grid/4M/1", 20), entry("build/grid/4M/2", 10))
        self.assertEqual(verdict_of(perf_targets.TARGETS, "build, ordered, 2 threads, times f", *rows),
                         (2.0, "moonshot"))

    def test_take_the_share_of_classification_from_the_counts(self):
        counts = {"rows": [{"operation": "build", "dataset": "grid", "path": "avx2",
                            "instructions": 1000, "classification": 40}]}
        self.assertEqual(verdict_of(perf_targets.TARGETS, "classification", counts=counts), (4.0, "met"))

    def test_name_rows_that_their_own_filter_lets_through(self):
        import re
        pattern = re.compile(perf_targets.row_filter())
        for row in ("build/grid/4M/1", "build/shuffled/4M/1/cgal", "reorder_fronts/shuffled/4M/2",
                    "vertex_normals_facelist/grid/4M/1/angle", "one_ring/shuffled/4M/1/pass",
                    "face_normals/scan/1k/2"):
            self.assertTrue(pattern.search(row), row)
        self.assertFalse(pattern.search("validate/grid/4M/1"))


class Counts(unittest.TestCase):
    DUMP = """# callgrind format
desc: Trigger: Client Request: build/grid/4M/1

events: Ir Dr DLmr DLmw
fn=(1) hedgerow::kernels::check_triangle_runs(int)
0 100 10 2 1
calls=1 0
0 40 4 1 0
fn=(2) hedgerow::kernels::(anonymous namespace)::link(int)
+3 40 4 1 0
fn=(1)
* 7 1 0 0

totals: 147 15 3 1
"""

    def test_leave_the_callees_out_of_a_function(self):
        part = count.Part(self.DUMP)
        self.assertEqual(part.name, "build/grid/4M/1")
        self.assertEqual(part.totals["Ir"], 147)
        self.assertEqual(sorted(part.instructions_of.values()), [40, 107])

    def test_become_a_row(self):
        row = count.row_of({"name": "build/grid/4M/1", "halfedges": 12, "compulsory_bytes": 96},
                           count.Part(self.DUMP), "avx2")
        self.assertEqual((row["last_level_misses"], row["classification"]), (4, 107))
        self.assertEqual(row["functions"], {"check_triangle_runs": 107, "link": 40})


class Rewrite(unittest.TestCase):
    def text(self, names):
        return "".join(f"prose of {name}\n<!-- table:{name} begin -->\nold\n"
                       f"<!-- table:{name} end -->\n" for name in names) + "last words\n"

    def test_replaces_what_is_between_the_markers_and_nothing_else(self):
        found = results(entry("build/grid/4M/1", 20))
        names = list(perf_tables.all_tables())
        once = perf_tables.rewrite(self.text(names), found, NO_COUNTS)
        self.assertNotIn("old\n", once)
        self.assertIn("| build/grid/4M | 1 | 20.0 |", once)
        for name in names:
            self.assertIn(f"prose of {name}\n<!-- table:{name} begin -->\n", once)
        self.assertTrue(once.endswith("last words\n"))
        self.assertEqual(perf_tables.rewrite(once, found, NO_COUNTS), once)

    def test_refuses_a_text_without_the_markers(self):
        with self.assertRaises(SystemExit):
            perf_tables.rewrite(self.text(["machine"]), results(entry("build/grid/4M/1", 20)), NO_COUNTS)

    def test_check_fails_on_a_number_typed_by_hand(self):
        with tempfile.TemporaryDirectory() as folder:
            perf = pathlib.Path(folder) / "PERF.md"
            stored = pathlib.Path(folder) / "results.json"
            perf_results.write_document(document(entry("build/grid/4M/1", 20)), stored)
            names = [*perf_tables.all_tables(), *perf_representations.representation_tables(),
                     *perf_planar.planar_tables(), *perf_imr.imr_tables(),
                     "frames-targets", *perf_frames.frame_tables()]
            perf.write_text(self.text(names), encoding="utf-8")
            readme = pathlib.Path(folder) / "README.md"
            readme.write_text(self.text(perf_tables.readme_tables()), encoding="utf-8")
            arguments = ["--perf", str(perf), "--results", str(stored), "--readme", str(readme)]
            self.assertEqual(perf_table.main(arguments), 0)
            self.assertEqual(perf_table.main([*arguments, "--check"]), 0)
            perf.write_text(perf.read_text(encoding="utf-8").replace("20.0", "19.0"),
                            encoding="utf-8")
            self.assertEqual(perf_table.main([*arguments, "--check"]), 1)


class Again(unittest.TestCase):
    def test_new_rows_take_the_place_of_their_namesakes(self):
        stored = {"context": {"date": "then", "cpu": "one"},
                  "rows": [bandwidth("copy", 1, copy=9.0), entry("a/grid/1M/1", 3),
                           entry("b/grid/1M/1", 4)]}
        newer = {"context": {"date": "now", "cpu": "one"},
                 "rows": [bandwidth("copy", 1, copy=5.0), entry("b/grid/1M/1", 2),
                          entry("c/grid/1M/1", 1)]}
        document = perf_results.replace(stored, newer)
        self.assertEqual([row["name"] for row in document["rows"]],
                         ["bandwidth/copy/3MiB/1", "a/grid/1M/1", "b/grid/1M/1", "c/grid/1M/1"])
        self.assertEqual(document["rows"][0]["gb_per_s"], {"copy": 9.0})
        self.assertEqual(document["rows"][2]["times_ns"], [2e6])
        self.assertEqual(document["context"],
                         {"date": "then", "cpu": "one", "again": ["now"]})
        self.assertNotIn("again", stored["context"])


if __name__ == "__main__":
    unittest.main()
