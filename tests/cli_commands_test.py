#!/usr/bin/env python3
"""What each command of the program does. usage: cli_commands_test.py PROGRAM"""

import json
import math
import os
import pathlib
import sys

from support import cli
from support.cli import ProgramTest


class Inspect(ProgramTest):
    def test_the_fields_are_those_of_the_contract_in_their_order(self):
        report = self.json("inspect", self.file("a.obj", cli.TETRAHEDRON))
        self.assertEqual(list(report), cli.INSPECT_FIELDS)
        self.assertEqual(list(report["valence"]), ["min", "max", "mean"])
        self.assertEqual(list(report["bytes"]), ["connectivity", "peak"])
        self.assertEqual(list(report["timings_ms"]), ["read", "build", "validate"])

    def test_a_tetrahedron_is_a_sphere(self):
        report = self.json("inspect", self.file("a.obj", cli.TETRAHEDRON))
        expected = {"vertices": 4, "faces": 4, "triangles": 4, "quads": 0, "polygons": 0,
                    "halfedges": 12, "edges": 6, "boundary_edges": 0, "components": 1, "euler": 2,
                    "boundary_loops": 0, "genus": 0, "closed": True, "manifold": True,
                    "oriented": True, "valence": {"min": 3, "max": 3, "mean": 3.0},
                    "defects": [], "defects_total": 0}
        self.assertEqual({field: report[field] for field in expected}, expected)

    def test_what_is_not_defined_is_null(self):
        report = self.json("inspect", self.file("a.obj", cli.THREE_ON_AN_EDGE))
        self.assertEqual((report["nonmanifold_edges"], report["manifold"]), (1, False))
        self.assertIsNone(report["genus"])
        self.assertIsNone(report["boundary_loops"])
        empty = self.json("inspect", self.file("b.obj", "v 0 0 0\n"))
        self.assertEqual((empty["vertices"], empty["isolated_vertices"]), (1, 1))
        self.assertEqual(empty["valence"], {"min": None, "max": None, "mean": None})

    def test_degenerate_faces_are_dropped_and_counted(self):
        text = cli.TETRAHEDRON + "f 1 1 2\nf 1 2\n"
        report = self.json("inspect", self.file("a.obj", text))
        self.assertEqual((report["faces"], report["degenerate_faces"]), (4, 2))
        self.assertEqual([defect["kind"] for defect in report["defects"]],
                         ["too-few-corners", "repeated-vertex"])
        self.assertEqual([defect["face"] for defect in report["defects"]], [5, 4])

    def test_at_most_100_defects_are_listed_and_all_are_counted(self):
        text = cli.TETRAHEDRON + "v 0 0 0\n" * 150
        report = self.json("inspect", self.file("a.obj", text))
        self.assertEqual((len(report["defects"]), report["defects_total"]), (100, 150))
        self.assertEqual(report["defects"][0], {"kind": "isolated-vertex", "vertex": 4})

    def test_a_triangle_mesh_takes_at_most_27_bytes_a_triangle(self):
        out = self.path("torus.ply")
        self.done("generate", "torus", out, "--size", "10000")
        report = self.json("inspect", out)
        wide = 2 if "64 bits" in self.done("--version") else 1
        self.assertLessEqual(report["bytes"]["connectivity"], 27 * wide * report["triangles"])
        self.assertGreater(report["bytes"]["peak"], report["bytes"]["connectivity"])

    def test_the_text_is_plain_and_names_every_count(self):
        text = self.done("inspect", self.file("a.obj", cli.CUBE))
        self.assertTrue(text.isascii())
        for word in ("vertices", "quads", "genus", "digest", "valence"):
            self.assertIn(word, text)


class Normals(ProgramTest):
    def test_both_methods_write_the_same_bytes(self):
        meshes = [self.file("cube.obj", cli.CUBE),
                  self.file("three.obj", cli.THREE_ON_AN_EDGE + "f 1 1 2\nv 5 5 5\n"),
                  self.file("grid.obj", cli.shuffled_grid(30))]
        for mesh in meshes:
            for weight in ("uniform", "area", "angle", "max"):
                files = []
                for method in ("halfedge", "facelist"):
                    for threads in (1, 3):
                        out = self.path(f"{method}{threads}.ply")
                        self.done("normals", mesh, out, "--weight", weight, "--method", method,
                                  "--threads", threads)
                        files.append(pathlib.Path(out).read_bytes())
                self.assertEqual(len(set(files)), 1, f"{mesh} {weight}")

    def test_the_file_has_six_floats_a_vertex_and_the_kept_faces(self):
        mesh = self.file("a.obj", cli.CUBE + "f 1 1 2\n")
        out = self.path("a.ply")
        self.done("normals", mesh, out)
        header, properties, vertices, faces, left = cli.read_normals_ply(out)
        self.assertEqual(header[1], "format binary_little_endian 1.0")
        self.assertEqual(properties[:6],
                         [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")])
        self.assertEqual((len(vertices), len(faces), left), (8, 6, 0))
        self.assertEqual(faces[0], (0, 3, 2, 1))
        for x, y, z, *normal in vertices:
            for found, corner in zip(normal, (x, y, z)):
                self.assertAlmostEqual(found, (2 * corner - 1) / math.sqrt(3), places=6)

    def test_max_weights_are_exact_on_a_sphere(self):
        sphere = self.path("sphere.ply")
        out = self.path("normals.ply")
        self.done("generate", "icosphere", sphere, "--size", "1280")
        self.done("normals", sphere, out, "--weight", "max")
        vertices = cli.read_normals_ply(out)[2]
        self.assertGreater(len(vertices), 100)
        for x, y, z, *normal in vertices:
            length = math.sqrt(x * x + y * y + z * z)
            cosine = sum(a * b for a, b in zip(normal, (x, y, z))) / length
            self.assertAlmostEqual(cosine, 1, places=5)


class Convert(ProgramTest):
    def test_a_mesh_survives_every_format_that_keeps_it(self):
        mesh = self.file("a.obj", cli.CUBE)
        wanted = self.json("inspect", mesh)["digest"]
        for name in ("b.ply", "c.off", "e.wet", "d.OBJ"):
            out = self.path(name)
            self.done("convert", mesh, out)
            report = self.json("inspect", out)
            self.assertEqual((report["quads"], report["digest"]), (6, wanted))
            mesh = out

    def test_winged_edge_tables_keep_their_numbers(self):
        text = "wet 1\nvertices 3\n0 0 0 3\n1 0 0 3\n0 1 0 2\nfaces 1\n2\nedges 3\n"
        rows = "3 1 2 3 0 0 1 0\n2 3 3 1 0 0 1 0\n2 1 0 0 1 2 0 1\n"
        out = self.path("b.wet")
        self.done("convert", self.file("a.wet", text + rows), out)
        with open(out, encoding="ascii") as file:
            lines = [line for line in file if not line.startswith("#")]
        self.assertEqual("".join(lines), text + rows)
        bad = self.file("c.wet", text + rows.replace("2 3 3 1 0 0 1 0", "2 3 3 2 0 0 1 0"))
        line = self.fails(3, "convert", bad, out, pattern=cli.TEXT_PLACE)
        self.assertTrue(line.endswith("edges row 2, column next_cw: found 2, "
                                      "consistent would be 1"), line)

    def test_stl_takes_polygons_apart_and_says_so(self):
        mesh = self.file("a.obj", cli.CUBE)
        status, _, errors = cli.run("convert", mesh, self.path("a.stl"))
        self.assertEqual(status, 0)
        self.assertIn("warning", errors)
        report = self.json("inspect", self.path("a.stl"))
        self.assertEqual((report["triangles"], report["closed"]), (12, True))


class Generate(ProgramTest):
    def test_every_shape_is_what_its_name_says(self):
        sphere = {"closed": True, "manifold": True, "oriented": True, "genus": 0}
        disk = {"closed": False, "manifold": True, "oriented": True, "genus": 0,
                "boundary_loops": 1}
        shapes = {
            "grid": disk, "terrain": disk, "fan": {"manifold": True, "oriented": True},
            "strip": {"manifold": True, "oriented": True, "boundary_loops": 1},
            "icosphere": sphere, "torus": {**sphere, "genus": 1},
            "gyroid": {"manifold": True, "oriented": True},
            "mobius": {"oriented": False, "manifold": True, "closed": False, "euler": 0},
            "klein": {"oriented": False, "manifold": True, "closed": True, "euler": 0}}
        for shape, facts in shapes.items():
            with self.subTest(shape=shape):
                out = self.path(shape + ".ply")
                self.done("generate", shape, out, "--size", "2000")
                report = self.json("inspect", out)
                self.assertGreater(report["faces"], 0)
                self.assertEqual({field: report[field] for field in facts}, facts)

    def test_a_larger_size_makes_more_faces_and_the_same_size_the_same_bytes(self):
        faces = [self.json("generate", "grid", self.path("a.ply"), "--size", size)["faces"]
                 for size in (100, 400)]
        self.assertLess(faces[0], faces[1])
        first = (self.folder / "a.ply").read_bytes()
        self.done("generate", "grid", self.path("b.ply"), "--size", "400", "--threads", "3")
        self.assertEqual((self.folder / "b.ply").read_bytes(), first)


class Reorder(ProgramTest):
    def test_a_shuffled_grid_is_helped_and_stays_the_same_surface(self):
        mesh = self.file("a.obj", cli.shuffled_grid(200))
        before = self.json("inspect", mesh)
        for order in ("hilbert", "morton", "bfs", "vertex-cache", "fronts"):
            with self.subTest(order=order):
                out = self.path(order + ".ply")
                found = self.json("reorder", mesh, out, "--order", order)
                self.assertTrue(found["helped"])
                self.assertLess(found["after"]["lines_per_face"],
                                found["before"]["lines_per_face"])
                after = self.json("inspect", out)
                for field in cli.INSPECT_FIELDS[:23]:
                    self.assertEqual(after[field], before[field], field)
                again = self.json("reorder", out, self.path("again.ply"), "--order", order)
                self.assertAlmostEqual(again["before"]["lines_per_face"],
                                       found["after"]["lines_per_face"])

    def test_positions_go_with_their_vertices(self):
        mesh = self.file("a.obj", cli.CUBE)
        self.done("reorder", mesh, self.path("b.ply"))
        self.done("normals", self.path("b.ply"), self.path("n.ply"))
        for x, y, z, *normal in cli.read_normals_ply(self.path("n.ply"))[2]:
            for found, corner in zip(normal, (x, y, z)):
                self.assertAlmostEqual(found, (2 * corner - 1) / math.sqrt(3), places=6)

    def test_it_says_whether_it_helped(self):
        out = self.done("reorder", self.file("a.obj", cli.CUBE), self.path("b.ply"))
        self.assertRegex(out, r"it (helped|did not help): ")


class Repair(ProgramTest):
    def test_the_result_is_manifold_and_the_maps_lead_back(self):
        mesh = self.file("a.obj", cli.BAD)
        maps_path = self.path("maps.json")
        report = self.json("repair", mesh, self.path("b.obj"), "--maps", maps_path)
        after = self.json("inspect", self.path("b.obj"))
        self.assertEqual((after["nonmanifold_edges"], after["nonmanifold_vertices"]), (0, 0))
        self.assertEqual((after["faces"], report["faces_dropped"]), (3, 1))
        self.assertEqual(after["vertices"], 6 + report["vertices_split"])
        maps = json.loads(pathlib.Path(maps_path).read_text())
        self.assertEqual(list(maps), ["vertices_new_to_old", "faces_new_to_old"])
        self.assertEqual(maps["faces_new_to_old"], [0, 1, 2])
        self.assertEqual(len(maps["vertices_new_to_old"]), after["vertices"])
        positions = [[line for line in pathlib.Path(path).read_text().splitlines()
                      if line.startswith("v ")] for path in (mesh, self.path("b.obj"))]
        old = [tuple(map(float, line.split()[1:])) for line in positions[0]]
        new = [tuple(map(float, line.split()[1:])) for line in positions[1]]
        self.assertEqual(new, [old[v] for v in maps["vertices_new_to_old"]])

    def test_policies_are_obeyed(self):
        mesh = self.file("a.obj", cli.BAD)
        report = self.json("repair", mesh, self.path("b.obj"), "--policy", "isolated-vertex=skip",
                           "--policy", "nonmanifold-edge=skip")
        self.assertEqual(report["policies"]["nonmanifold-edge"], "skip")
        self.assertEqual(report["after"]["defects"]["isolated-vertex"], 0)
        self.assertEqual(report["after"]["defects"]["nonmanifold-edge"], 0)
        self.assertEqual(report["vertices_split"], 0)
        self.assertGreater(report["vertices_dropped"], 0)

    def test_under_strict_nothing_is_written_while_defects_remain(self):
        mesh = self.file("a.obj", cli.BAD)
        self.fails(1, "repair", mesh, self.path("b.obj"), "--strict")
        self.assertFalse(os.path.exists(self.path("b.obj")))
        self.done("repair", mesh, self.path("b.obj"), "--strict", "--policy",
                  "isolated-vertex=skip")

    def test_repair_merges_vertices_within_a_distance_and_drops_faces_that_come_twice(self):
        mesh = self.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.001 0 0\nv 0 1.001 0\nv 1 1 0\n"
                         "f 1 2 3\nf 4 6 5\nf 2 3 1\n")
        maps_path = self.path("maps.json")
        report = self.json("repair", mesh, self.path("b.obj"), "--weld", "0.01",
                           "--drop-duplicates", "--maps", maps_path)
        self.assertEqual(report["vertices_merged"], 2)
        self.assertEqual(report["after"]["vertices"], 4)
        self.assertEqual(report["faces_dropped"], 1)
        self.assertEqual(report["policies"]["duplicate-face"], "skip")
        with open(maps_path, encoding="utf-8") as file:
            maps = json.load(file)
        self.assertEqual(maps["vertices_new_to_old"], [0, 1, 2, 5])
        self.assertEqual(maps["faces_new_to_old"], [0, 1])
        found = self.json("inspect", self.path("b.obj"))
        self.assertEqual((found["edges"], found["boundary_edges"]), (5, 4))
        # Nothing near: nothing merged.
        report = self.json("repair", mesh, self.path("b.obj"), "--weld", "0")
        self.assertEqual(report["vertices_merged"], 0)
        for wrong in ("-1", "nan", "far"):
            self.fails(2, "repair", mesh, self.path("b.obj"), "--weld", wrong)

    def test_orient_turns_the_face_that_disagrees(self):
        mesh = self.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                  "f 1 2 3\nf 1 2 4\nf 2 4 3\nf 3 4 1\n")
        report = self.json("repair", mesh, self.path("b.obj"), "--orient")
        self.assertEqual(report["orientation"]["faces_turned"], [1])
        self.assertEqual(report["orientation"]["proofs"], [])
        after = self.json("inspect", self.path("b.obj"))
        self.assertTrue(after["oriented"] and after["closed"])
        self.assertEqual(report["vertices_split"], 0)

    def test_orient_proves_that_a_moebius_band_has_no_orientation(self):
        self.done("generate", "mobius", self.path("a.obj"), "--size", "100")
        report = self.json("repair", self.path("a.obj"), self.path("b.obj"), "--orient")
        self.assertEqual(report["orientation"]["nonorientable_patches"], 1)
        self.assertGreater(len(report["orientation"]["proofs"][0]), 2)
        self.assertEqual(report["orientation"]["faces_turned"], [])
        out = self.done("repair", self.path("a.obj"), self.path("b.obj"), "--orient")
        self.assertIn("no orientation: faces ", out)

    def test_the_text_says_what_was_changed(self):
        out = self.done("repair", self.file("a.obj", cli.BAD), self.path("b.obj"))
        for word in ("nonmanifold-edge", "split", "repeated-vertex", "dropped"):
            self.assertIn(word, out)


class Subdivide(ProgramTest):
    def test_a_cube_is_refined_and_counted(self):
        mesh = self.file("a.obj", cli.CUBE)
        out = self.path("b.ply")
        report = self.json("subdivide", mesh, out, "--scheme", "catmull-clark", "--levels", "2")
        self.assertEqual((report["scheme"], report["levels"]), ("catmull-clark", 2))
        self.assertEqual(report["before"], {"vertices": 8, "faces": 6, "halfedges": 24})
        self.assertEqual(report["after"], {"vertices": 98, "faces": 96, "halfedges": 384})
        found = self.json("inspect", out)
        self.assertEqual((found["vertices"], found["quads"], found["euler"]), (98, 96, 2))

    def test_triangle_schemes_refuse_quads(self):
        for scheme in ("loop", "sqrt3"):
            err = self.fails(3, "subdivide", self.file("a.obj", cli.CUBE), self.path("b.ply"),
                             "--scheme", scheme, "--levels", "1")
            self.assertIn("face 0 has 4 corners", err)
            self.assertFalse(os.path.exists(self.path("b.ply")))
            self.done("subdivide", self.file("a.obj", cli.TETRAHEDRON), self.path("c.ply"),
                      "--scheme", scheme, "--levels", "1")

    def test_more_levels_than_an_index_can_count_are_a_limit(self):
        mesh = self.file("a.obj", cli.CUBE)
        err = self.fails(5, "subdivide", mesh, self.path("b.ply"), "--scheme", "catmull-clark",
                         "--levels", "64")
        self.assertIn("too-many-elements", err)
        # 24 * 4^20 half-edges: countable with 64 bits, and a hundred terabytes.
        err = self.fails(5, "subdivide", mesh, self.path("b.ply"), "--scheme", "catmull-clark",
                         "--levels", "20")
        self.assertIn("out-of-memory" if cli.index_bits() == 64 else "too-many-elements", err)
        self.assertFalse(os.path.exists(self.path("b.ply")))

    def test_wrong_levels_and_schemes_are_usage(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        self.fails(2, "subdivide", mesh, self.path("b.ply"), "--scheme", "loop", "--levels", "-1")
        self.fails(2, "subdivide", mesh, self.path("b.ply"), "--scheme", "butterfly")
        self.fails(2, "subdivide", mesh, self.path("b.ply"))


class Decimate(ProgramTest):
    def test_a_torus_keeps_its_hole(self):
        self.done("generate", "torus", self.path("a.ply"), "--size", "3000")
        out = self.path("b.obj")
        for order in ("queue", "rounds"):
            report = self.json("decimate", self.path("a.ply"), out, "--faces", "500", "--order",
                               order)
            self.assertEqual((report["faces"], report["ended_by"], report["order"]),
                             (500, "faces", order))
            self.assertIn(report["after"]["faces"], (499, 500))
            self.assertEqual(report["before"]["vertices"] - report["collapses"],
                             report["after"]["vertices"])
            self.assertEqual(report["rounds"] > 0, order == "rounds")
            self.assertLessEqual(report["accepted"], report["candidates"])
            found = self.json("inspect", out)
            self.assertEqual((found["genus"], found["manifold"], found["faces"]),
                             (1, True, report["after"]["faces"]))

    def test_what_cannot_be_reached_is_said(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        text = self.done("decimate", mesh, self.path("b.ply"), "--faces", "2")
        self.assertIn("no other edge can be collapsed", text)
        self.assertEqual(self.json("decimate", mesh, self.path("b.ply"), "--faces", "2")["ended_by"],
                         "refused")

    def test_wrong_numbers_are_usage(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        for arguments in ((), ("--faces",), ("--faces", "9", "--order", "any"), ("--faces", "-3"), ("--faces", "many"),
                          ("--faces", "1e99")):
            self.fails(2, "decimate", mesh, self.path("b.ply"), *arguments)
        self.assertFalse(os.path.exists(self.path("b.ply")))


class Smooth(ProgramTest):
    def test_a_spike_is_pulled_in_and_the_outline_stays(self):
        mesh = self.file("a.obj", cli.shuffled_grid(6))
        for options in ((), ("--in-place",), ("--weights", "cotangent", "--step", "0.5")):
            report = self.json("smooth", mesh, self.path("b.obj"), "--iterations", "3", *options)
            self.assertEqual(report["before"], report["after"])
            self.assertTrue(0 < report["moved_vertices"] <= 25)
            self.assertGreater(report["largest_move"], 0)
        self.assertEqual(report["update"], "double-buffered")

    def test_no_iteration_is_a_copy(self):
        mesh = self.file("a.obj", cli.CUBE)
        text = self.done("smooth", mesh, self.path("b.obj"), "--iterations", "0")
        self.assertIn("0 of 8 vertices moved", text)

    def test_cotangents_want_triangles(self):
        err = self.fails(3, "smooth", self.file("a.obj", cli.CUBE), self.path("b.obj"),
                         "--iterations", "1", "--weights", "cotangent")
        self.assertIn("face 0 has 4 corners", err)
        self.assertFalse(os.path.exists(self.path("b.obj")))

    def test_wrong_numbers_are_usage(self):
        mesh = self.file("a.obj", cli.CUBE)
        for arguments in ((), ("--iterations", "-1"), ("--iterations", "1", "--step", "0"),
                          ("--iterations", "1", "--step", "1.5"), ("--iterations", "1", "--weights", "x")):
            self.fails(2, "smooth", mesh, self.path("b.ply"), *arguments)


if __name__ == "__main__":
    cli.main(sys.argv)
