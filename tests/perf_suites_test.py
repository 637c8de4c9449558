#!/usr/bin/env python3
"""Tests of the tables that are measured by themselves: representations, what changes meshes, the six
tests of the IMR 2011 suite, frames of a ray tracer."""

import unittest

from perf_support import NO_COUNTS, entry, line_of, results

import perf_frames
import perf_imr
import perf_planar
import perf_representations
import perf_tables
import perf_targets


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


class SixTests(unittest.TestCase):
    """Of the IMR 2011 suite."""

    def found(self, *more):
        rows = []
        for test in perf_imr.ROWS:
            rows += [entry(f"imr_{test}/grid/1M/1", 10), entry(f"imr_{test}/grid/1M/2", 5),
                     entry(f"imr_{test}/grid/1M/1/openmesh", 50), entry(f"imr_{test}/grid/1M/1/cgal", 40)]
        return results(*rows, *more)

    def verdicts(self, found):
        return [(target.title, value, verdict) for target, value, verdict
                in perf_targets.evaluate(perf_imr.IMR_TARGETS, found, NO_COUNTS)]

    def test_the_fastest_rival_counts(self):
        verdicts = self.verdicts(self.found())
        self.assertEqual(len(verdicts), 8)
        for _, value, verdict in verdicts[:6]:
            self.assertEqual((value, verdict), (4, "met"))
        self.assertAlmostEqual(verdicts[6][1], 4)
        self.assertAlmostEqual(verdicts[7][1], 8)
        self.assertEqual(verdicts[7][2], "moonshot")

    def test_the_mesh_where_we_lose_decides(self):
        lost = self.found(entry("imr_smoothing/scan/1M/1", 20),
                          entry("imr_smoothing/scan/1M/1/openmesh", 10),
                          entry("imr_collapse/scan/1M/1", 20),
                          entry("imr_collapse/scan/1M/1/cgal", 10),
                          entry("imr_collapse/scan/1M/1/cgal-removal", 5))
        verdicts = dict((title.split(",")[0], (value, verdict))
                        for title, value, verdict in self.verdicts(lost))
        self.assertEqual(verdicts["smoothing"], (0.5, "**missed**"))
        self.assertEqual(verdicts["collapse"], (0.5, "**missed**"))
        self.assertEqual(verdicts["normals"], (4, "met"))

    def test_one_thread_stands_for_two_where_there_is_nothing_to_share(self):
        found = results(entry("imr_collapse/grid/1M/1", 10), entry("imr_collapse/grid/1M/1/cgal", 30))
        self.assertEqual(perf_imr.times_faster(found, "collapse", "grid/1M", 2), 3)

    def test_a_line_shows_all_meshes_and_what_refuses(self):
        table = perf_imr.imr_table(
            self.found(*[entry(f"imr_{test}/dragon/9k/1", 1) for test in perf_imr.ROWS[1:]],
                       {"name": "imr_circulator/dragon/9k/1", "error": "several fans"}), NO_COUNTS)
        self.assertIn("| normals | grid/1M | 10.0 | 5.00 |  |  | 50.0 | 40.0 |  | 4.00 x |", table)
        self.assertIn("| circulator | dragon/9k | not measured: several fans |", table)

    def test_other_ways_are_set_beside_the_usual_one(self):
        table = perf_imr.other_ways_table(self.found(entry("imr_subdivision/grid/1M/1/edits", 25)),
                                          NO_COUNTS)
        self.assertIn("| subdivision/grid/1M/edits | 1 | 25.0 | 2.50 |", table)
        self.assertNotIn("openmesh", table)


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


if __name__ == "__main__":
    unittest.main()
