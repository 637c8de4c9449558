#!/usr/bin/env python3
"""The report and its files. usage: cli_report_test.py PROGRAM"""

import html.parser
import json
import os
import pathlib
import sys

from support import cli
from support.cli import ProgramTest


class PageTags(html.parser.HTMLParser):
    """Which tags of a page are left open, and what it refers to."""

    def __init__(self):
        super().__init__()
        self.open, self.outside = [], []
        self.pictures = self.plots = 0

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.plots += tag == "svg"
        for name in ("src", "href"):
            if name in values:
                is_inside = values[name].startswith("data:image/png;base64,")
                self.pictures += is_inside
                if not is_inside:
                    self.outside.append(values[name])
        if tag not in ("meta", "img", "br", "rect", "line"):
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        if self.open and self.open[-1] == tag:
            self.open.pop()
        else:
            self.outside.append("/" + tag)


class Report(ProgramTest):
    STAGES = {"read", "build", "validate", "face_normals", "vertex_normals_facelist",
              "vertex_normals_halfedge", "one_ring", "boundary_loops", "components", "reorder",
              "dirty_normals"}
    RAY_STAGES = {"bvh_build", "bvh_refit", "rays_primary", "rays_occlusion", "hit_connectivity"}
    STAGE_FIELDS = {"name", "variant", "threads", "ms", "elements", "unit", "ns_per_element",
                    "bytes", "gb_per_s", "share_of_bandwidth", "pointer_ms", "aos_ms", "checked"}

    def check(self, report, threads):
        self.assertEqual(list(report)[:4], ["version", "commit", "machine", "bandwidth_gb_s"])
        self.assertEqual(set(report["machine"]), {"cpu", "cores", "caches", "memory", "os",
                                                  "compiler", "flags", "simd"})
        self.assertEqual(list(report["mesh"]), cli.INSPECT_FIELDS)
        for kind in ("read", "copy", "triad"):
            self.assertGreater(report["bandwidth_gb_s"][kind], 0)
        names = {stage["name"] for stage in report["stages"]}
        self.assertEqual(names, self.STAGES | (self.RAY_STAGES if cli.RAYS else set()))
        self.assertEqual(report["failed"], [])
        for stage in report["stages"]:
            self.assertLessEqual(self.STAGE_FIELDS, set(stage))
            self.assertTrue(stage["checked"], stage["name"])
            self.assertGreaterEqual(stage["runs"], 3)
            self.assertIn(stage["threads"], (1, threads))
            self.assertAlmostEqual(stage["ns_per_element"],
                                   stage["ms"] * 1e6 / stage["elements"], places=3)
            self.assertAlmostEqual(stage["gb_per_s"], stage["bytes"] / stage["ms"] / 1e6, places=3)
        for name in ("build", "face_normals", "one_ring", "components"):
            for stage in report["stages"]:
                if stage["name"] == name:
                    self.assertGreater(stage["pointer_ms"], 0)
                    self.assertGreater(stage["aos_ms"], 0)
        for part in (*self.RAY_STAGES, "render.png"):
            self.assertEqual(part in report["absent"], not cli.RAYS, part)
        self.assertFalse(names & set(report["absent"]))
        self.check_rays(report["rays"], report["mesh"]["halfedges"])

    def check_rays(self, rays, corners):
        if not cli.RAYS:
            self.assertIsNone(rays)
            return
        self.assertRegex(rays["embree"], r"^[34]\.\d+\.\d+$")
        self.assertEqual(rays["primary_rays"], rays["width"] * rays["height"])
        self.assertTrue(0 < rays["primary_hits"] < rays["primary_rays"])
        self.assertTrue(0 <= rays["occluded"] < rays["occlusion_rays"] <= rays["primary_hits"])
        self.assertGreaterEqual(rays["brute_force_rays"], 16)
        # Shared with the ray tracer, which knows 32 bits an index; a copy of wider ones.
        copied = 0 if cli.index_bits() == 32 else 4 * corners
        self.assertEqual(rays["copied_index_bytes"], copied)
        self.assertGreater(rays["tree_bytes"], 0)

    def check_page(self, page, report):
        """Well-formed, refers to nothing outside, and says what the report says."""
        tags = PageTags()
        tags.feed(page)
        self.assertEqual(tags.open, [])
        self.assertEqual(tags.outside, [])
        self.assertEqual(tags.pictures, 1 if cli.RAYS else 0)
        self.assertGreater(tags.plots, 10)
        for stage in report["stages"]:
            self.assertIn(stage["name"], page)
        for word in ("prefers-color-scheme:dark", "@media print", "name=\"viewport\"",
                     report["mesh"]["digest"]):
            self.assertIn(word, page)

    def test_every_stage_is_checked_and_measured(self):
        mesh = self.file("a.obj", cli.shuffled_grid(40))
        folder = self.path("report")
        printed = self.json("report", mesh, "--out", folder, "--threads", "2")
        self.check(printed, 2)
        self.assertEqual(json.loads((self.folder / "report" / "report.json").read_text()), printed)
        files = ["render.png", "report.html", "report.json"] if cli.RAYS else [
            "report.html", "report.json"]
        self.assertEqual(sorted(os.listdir(folder)), files)
        self.assertEqual(sorted(map(os.path.basename, printed["files"])), files)
        self.check_page(pathlib.Path(folder, "report.html").read_text(), printed)
        weights = {stage["variant"] for stage in printed["stages"]
                   if stage["name"] == "vertex_normals_halfedge"}
        self.assertEqual(weights, {"uniform", "area", "angle", "max"})
        walks = {stage["variant"] for stage in printed["stages"] if stage["name"] == "one_ring"}
        self.assertEqual(walks, {"implicit", "explicit"})

    def test_polygons_and_defects_are_reported_too(self):
        # Quads with edges of no length, and a vertex between them.
        collapsed = ("v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\nv 2 1 1\nv 1 0 0\n"
                     "f 1 2 3 4\nf 3 2 5 6\nf 2 3 4 5\n")
        for name, text in (("cube.obj", cli.CUBE), ("bad.obj", cli.BAD),
                           ("collapsed.obj", collapsed)):
            report = self.json("report", self.file(name, text), "--out", self.path("report"))
            self.check(report, report["machine"]["cores"])

    def test_the_text_says_what_is_absent_and_ends_in_a_verdict(self):
        mesh = self.file("a.obj", cli.shuffled_grid(20))
        text = self.done("report", mesh, "--out", self.path("report"), "--threads", "1")
        self.assertTrue(text.isascii())
        if cli.RAYS:
            self.assertNotIn("absent from this version", text)
        else:
            self.assertRegex(text, r"absent from this version: .*rays_primary.*render\.png")
        self.assertRegex(text.splitlines()[-1], r"^verdict: \d+ of \d+ measurements checked")


if __name__ == "__main__":
    cli.main(sys.argv)
