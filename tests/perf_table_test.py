#!/usr/bin/env python3
"""Tests of bench/perf_table.py and what it is made of, on results made by hand."""

import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bench"))

import count  # noqa: E402
import perf_format  # noqa: E402
import perf_frames  # noqa: E402
import perf_planar  # noqa: E402
import perf_representations  # noqa: E402
import perf_results  # noqa: E402
import perf_table  # noqa: E402
import perf_tables  # noqa: E402
import perf_targets  # noqa: E402

NO_COUNTS = {"context": {}, "rows": []}


def entry(name, milliseconds, **more):
    times = milliseconds if isinstance(milliseconds, list) else [milliseconds]
    return {"name": name, "times_ns": [1e6 * time for time in times], "processor_ns": 1e6 * times[0],
            "halfedges": 12_000_000, "vertices": 2_000_000, "faces": 4_000_000,
            "mesh_bytes": 104_000_000, "read": 60_000_000, "written": 40_000_000, "mix": "copy",
            "gb_per_s": {"copy": 10.0, "copy-streaming": 20.0}, **more}


def bandwidth(mix, threads, **rates):
    return {"name": f"bandwidth/{mix}/3MiB/{threads}", "mix": mix, "gb_per_s": rates}


def document(*rows):
    context = {"cpu": "a processor", "caches": [{"type": "Data", "level": 1, "bytes": 32768,
                                                 "sharing": 1}]}
    return {"context": context, "rows": list(rows)}


def results(*rows):
    return perf_results.Results(document(*rows))


def line_of(table, start):
    """The cells, by their heads, of the one line of a table whose first cells are `start`."""
    prefix = "| " + " | ".join(start) + " |"
    lines = [line for line in table.splitlines() if line.startswith(prefix)]
    assert len(lines) == 1, (start, table)
    cells, heads = ([cell.strip() for cell in line.strip("|").split("|")]
                    for line in (lines[0], table.splitlines()[0]))
    return dict(zip(heads, cells))


def verdict_of(targets, title, *rows, counts=None):
    found = [(value, verdict) for target, value, verdict
             in perf_targets.evaluate(targets, results(*rows), counts or NO_COUNTS)
             if target.title.startswith(title)]
    assert len(found) == 1, title
    return found[0]


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

    def test_portable_rows_become_a_variant(self):
        merged = perf_results.merge(document(entry("build/grid/4M/1", 1)),
                                    document(bandwidth("copy", 1, copy=1.0), entry("build/grid/4M/1", 2)))
        self.assertEqual([row["name"] for row in merged["rows"]],
                         ["build/grid/4M/1", "build/grid/4M/1/portable"])

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
        for row in ("build/grid/4M/1", "build/shuffled/4M/1/cgal", "reorder_hilbert/shuffled/4M/2",
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


class Representations(unittest.TestCase):
    def answers(self):
        def row(question, kind, milliseconds, **more):
            return entry(f"represent_{question}/grid/10k/1/{kind}", milliseconds, elements=1e6, **more)
        return results(row("build", "flat", 3, bytes_per_edge=17.5),
                       row("build", "dcel", 6, bytes_per_edge=43.0),
                       row("ring_vertices", "flat", [9, 7, 8]), row("ring_vertices", "dcel", 4))

    def test_sets_the_least_of_each_question_in_bold(self):
        lines = perf_representations.comparison_table("grid", "10k")(self.answers(), NO_COUNTS)
        flat = list(perf_representations.KINDS).index("flat")
        dcel = list(perf_representations.KINDS).index("dcel")

        def cells(title):
            line = next(line for line in lines.splitlines() if line.startswith(f"| {title} |"))
            return [cell.strip() for cell in line.split("|")[2:-1]]
        self.assertEqual(cells("bytes an edge")[flat], "**17.5**")
        self.assertEqual(cells("build, edge")[dcel], "6.00")
        self.assertEqual(cells("neighbours, vertex")[flat], "8.00")
        self.assertEqual(cells("neighbours, vertex")[dcel], "**4.00**")
        self.assertEqual(set(cells("genus, edge")), {""})

    def test_another_size_or_order_is_another_table(self):
        other = perf_representations.comparison_table("shuffled", "10k")(self.answers(), NO_COUNTS)
        self.assertNotIn("8.00", other)


class Planar(unittest.TestCase):
    def found(self):
        return results(entry("triangulate/points/2M/1", 400, points=1_000_000),
                       entry("triangulate/points/2M/1/cgal", 800, points=1_000_000),
                       entry("flip/points/20k/1", 2, flips=10_000),
                       entry("build/grid/4M/1", 20))

    def test_rates_are_elements_by_time(self):
        table = perf_planar.planar_table(self.found(), NO_COUNTS)
        self.assertIn("| triangulate/points/2M | 1 | 400 | 0 % | points | 2.50 |", table)
        self.assertIn("| flip/points/20k | 1 | 2.00 | 0 % | flips | 5.00 |", table)
        self.assertNotIn("build", table)

    def test_targets_are_judged(self):
        lines = perf_tables.targets_table(perf_planar.PLANAR_TARGETS)(
            self.found(), NO_COUNTS).splitlines()
        self.assertTrue(lines[2].endswith("| 2.50 M points/s | moonshot |"))
        self.assertTrue(lines[3].endswith("| 2.00 x | met |"))
        self.assertTrue(lines[4].endswith("| 5.00 M flips/s | **missed** |"))
        self.assertTrue(lines[5].endswith("|  | not measured |"))


class FramesOfARayTracer(unittest.TestCase):
    LOOP = perf_frames.MAIN_LOOP

    @staticmethod
    def row(part, stage, what, variant, value, unit="ms", note=""):
        return {"part": part, "stage": stage, "what": what, "variant": variant, "value": value,
                "unit": unit, "note": note}

    def frames(self, *rows):
        return perf_frames.Frames({"context": {}, "rows": list(rows)})

    def verdict_of(self, title, *rows):
        found = [(value, verdict) for target, value, verdict
                 in perf_targets.evaluate(perf_frames.frame_targets(), self.frames(*rows), NO_COUNTS)
                 if target.title.startswith(title)]
        self.assertEqual(len(found), 1, title)
        return found[0]

    def test_are_set_beside_normals_of_openmesh_and_a_tree_built_anew(self):
        rows = (self.row("dragon-100", "S6", self.LOOP, "normals", 4),
                self.row("dragon-100", "S6", self.LOOP, "refit", 16),
                self.row("dragon-100", "S6", "100% moved, normals", "openmesh", 20),
                self.row("dragon-100", "S6", "100% moved, tree built anew", "openmesh", 30))
        self.assertEqual(self.verdict_of("dragon: normals and refit", *rows), (2.5, "**missed**"))
        self.assertEqual(self.verdict_of("dragon: normals and refit", *rows[1:]),
                         (None, "not measured"))

    def test_may_not_allocate_at_all(self):
        rows = [self.row("small-1", "S6", self.LOOP, "allocations", 0),
                self.row("small-100", "S6", self.LOOP, "allocations", 1e-4)]
        self.assertEqual(self.verdict_of("allocations", *rows), (1e-4, "**missed**"))
        self.assertEqual(self.verdict_of("allocations", rows[0]), (0, "moonshot"))

    def test_leave_five_microseconds_to_a_blob(self):
        rows = (self.row("terrain", "S2", "1% moved, area", "1 thread", 0.305),
                self.row("terrain", "S2", "gather, area", "1 thread", 10))
        value, verdict = self.verdict_of("terrain: normals after", *rows)
        self.assertAlmostEqual(value, 3)
        self.assertEqual(verdict, "**missed**")

    def test_show_the_share_of_each_stage(self):
        rows = [self.row("small-1", "S6", self.LOOP, name, 1, note="5 frames")
                for name in (*perf_frames.TIMES, *perf_frames.PARTS_OF_A_FRAME)]
        rows.append(self.row("small-1", "S6", self.LOOP, "allocations", 0,
                             note="and 5 by Embree, for 5 commits"))
        lines = perf_frames.stages_table(self.frames(*rows), NO_COUNTS)
        cells = line_of(lines, ["terrain, 200k triangles", self.LOOP])
        self.assertEqual((cells["refit, ms"], cells["by Embree in all"]), ("1.00 (20 %)", "5"))

    def test_set_the_least_of_each_question_in_bold(self):
        rows = [self.row("dragon", "S5", "one-ring", who, value, "ns/hit")
                for who, value in (("hedgerow", 20), ("cgal", 30))]
        rows.append(self.row("dragon", "S5", "two-ring", "hedgerow", 90, "ns/hit"))
        table = perf_frames.frame_tables()["frames-hits-dragon"](self.frames(*rows), NO_COUNTS)
        self.assertIn("| one-ring | **20.0** | 30.0 |", table)
        self.assertIn("| two-ring | 90.0 |  |", table)

    def test_of_one_part_are_replaced_and_wrong_ones_refused(self):
        before = self.frames(self.row("terrain", "S5", "one-ring", "hedgerow", 1),
                             self.row("dragon", "S5", "one-ring", "hedgerow", 2))
        row = {"stage": "S5", "what": "one-ring", "variant": "hedgerow", "value": 3, "unit": "ns/hit",
               "note": ""}
        after = perf_frames.Frames(perf_frames.with_part(
            before, "dragon", {"context": {"mesh": "x"}, "failed": [], "rows": [row]}))
        self.assertEqual([after.get(part, "one-ring", "hedgerow") for part in ("terrain", "dragon")],
                         [1, 3])
        self.assertNotIn("mesh", after.context)
        with self.assertRaises(SystemExit):
            perf_frames.with_part(before, "dragon", {"context": {}, "failed": ["S5"], "rows": []})


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
                     *perf_planar.planar_tables(),
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


if __name__ == "__main__":
    unittest.main()
