#!/usr/bin/env python3
"""Pictures of meshes. usage: cli_render_test.py PROGRAM"""

import os
import pathlib
import re
import subprocess
import sys

from support import cli
from support.cli import ProgramTest
from support.png import Png

SHADINGS = ("smooth", "flat", "normals", "valence", "components", "defects")
SMALL = ("--width", "96", "--height", "64")
# A square in the plane z = 0, seen from above; the same from below is its back.
SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
SQUARE_FROM_BELOW = SQUARE.replace("1 2 3 4", "4 3 2 1")


def is_near(colour, other, tolerance=2):
    return all(abs(a - b) <= tolerance for a, b in zip(colour, other))


class Render(ProgramTest):
    def draw(self, mesh, *options):
        out = self.path("out.png")
        self.done("render", mesh, out, *SMALL, *options)
        return Png(out)

    def test_every_shading_draws_something_of_the_size_asked_for(self):
        mesh = self.file("cube.obj", cli.CUBE)
        for shading in SHADINGS:
            for more in ((), ("--wireframe",), ("--ao", "8")):
                picture = self.draw(mesh, "--shading", shading, *more)
                self.assertEqual((picture.width, picture.height), (96, 64))
                corner = picture.at(0, 0)
                unlike = sum(not is_near(pixel, corner, 40) for pixel in picture.pixels())
                self.assertGreater(unlike, 300, (shading, more))

    def test_the_bytes_do_not_depend_on_the_threads(self):
        mesh = self.path("mesh.ply")
        self.done("generate", "gyroid", mesh, "--size", "20000")
        for options in (("--wireframe",), ("--ao", "16"), ("--shading", "valence")):
            pictures = set()
            for threads in (1, 2, 3, 8):
                out = self.path(f"{threads}.png")
                self.done("render", mesh, out, "--width", "200", "--height", "150", "--threads",
                          threads, *options)
                pictures.add(pathlib.Path(out).read_bytes())
            self.assertEqual(len(pictures), 1, options)

    def test_the_camera_leaves_a_margin_and_wastes_no_room(self):
        for name in ("grid", "torus", "icosphere", "terrain"):
            mesh = self.path(name + ".ply")
            self.done("generate", name, mesh, "--size", "2000")
            picture = self.draw(mesh, "--shading", "normals")
            # Paper is grey; the colours of normals are not.
            met = [(x, y) for y in range(picture.height) for x in range(picture.width)
                   if max(picture.at(x, y)) - min(picture.at(x, y)) > 40]
            left, right = min(x for x, y in met), max(x for x, y in met)
            top, bottom = min(y for x, y in met), max(y for x, y in met)
            self.assertGreaterEqual(min(left, 95 - right, top, 63 - bottom), 2, name)
            width_share, height_share = (right - left) / 96, (bottom - top) / 64
            self.assertGreater(max(width_share, height_share), 0.75, name)

    def test_a_normal_is_its_colour(self):
        # (0, 0, 1) is (1/2, 1/2, 1) in linear light: 188, 188, 255 in sRGB.
        picture = self.draw(self.file("a.obj", SQUARE), "--shading", "normals")
        self.assertTrue(is_near(picture.at(48, 32), (188, 188, 255)), picture.at(48, 32))
        picture = self.draw(self.file("b.obj", SQUARE_FROM_BELOW), "--shading", "normals")
        self.assertTrue(is_near(picture.at(48, 32), (188, 188, 0)), picture.at(48, 32))

    def test_the_back_of_a_face_is_red(self):
        red, green, blue = self.draw(self.file("a.obj", SQUARE)).at(48, 32)
        self.assertLess(abs(red - blue), 40)
        red, green, blue = self.draw(self.file("b.obj", SQUARE_FROM_BELOW)).at(48, 32)
        self.assertGreater(red, blue + 60)
        self.assertGreater(red, green + 40)

    def test_lines_follow_halfedges_and_not_the_diagonals_of_quads(self):
        square = self.file("a.obj", SQUARE)
        cut = self.file("b.obj", SQUARE.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 4"))
        plain = self.draw(square, "--shading", "flat").at(48, 32)
        lined = self.draw(square, "--shading", "flat", "--wireframe")
        self.assertTrue(is_near(lined.at(48, 32), plain))
        with_diagonal = self.draw(cut, "--shading", "flat", "--wireframe")
        dark = sum(sum(with_diagonal.at(x, y)) < sum(plain) - 150
                   for x in range(40, 57) for y in range(24, 41))
        self.assertGreater(dark, 5)
        rim = sum(not is_near(a, b, 30) for a, b in
                  zip(lined.pixels(), self.draw(square, "--shading", "flat").pixels()))
        self.assertGreater(rim, 60)

    def test_occlusion_darkens_the_inside_of_a_corner_only(self):
        # Two walls that meet at a right angle.
        walls = self.file("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\n"
                                   "f 1 2 3 4\nf 1 4 6 5\n")
        square = self.file("b.obj", SQUARE)
        changes = {}
        for name, mesh in (("walls", walls), ("square", square)):
            before = self.draw(mesh, "--shading", "normals")
            after = self.draw(mesh, "--shading", "normals", "--ao", "64")
            # Paper is grey, and darker where the shadow falls on the floor.
            changes[name] = [sum(a) - sum(b) for a, b in zip(before.pixels(), after.pixels())
                             if max(a) - min(a) > 30]
        self.assertGreater(max(changes["walls"]), 60)
        self.assertGreaterEqual(min(changes["walls"]), -6)
        self.assertLessEqual(sum(change > 12 for change in changes["square"]), 8)

    def test_components_get_different_colours_the_largest_first(self):
        mesh = self.file("a.obj", SQUARE + "v 2 0 0\nv 3 0 0\nv 2 1 0\nf 5 6 7\n")
        out = self.path("out.png")
        report = self.json("render", mesh, out, *SMALL, "--shading", "components")
        self.assertEqual([entry["meaning"] for entry in report["legend"]],
                         ["component 1: 4 vertices", "component 2: 3 vertices"])
        self.assertEqual(len({entry["colour"] for entry in report["legend"]}), 2)
        picture = Png(out)
        self.assertGreater(sum(b > r + 30 for r, g, b in picture.pixels()), 200)
        self.assertGreater(sum(r > b + 60 for r, g, b in picture.pixels()), 200)

    def test_valences_are_counted_in_the_legend(self):
        report = self.json("render", self.file("a.obj", cli.TETRAHEDRON), self.path("a.png"),
                           *SMALL, "--shading", "valence")
        self.assertEqual(len(report["legend"]), 7)
        self.assertIn("valence 3", report["legend"][0]["meaning"])
        self.assertIn(": 4 vertices", report["legend"][0]["meaning"])

    def test_defects_are_marked_and_listed(self):
        report = self.json("render", self.file("a.obj", cli.THREE_ON_AN_EDGE),
                           self.path("a.png"), *SMALL, "--shading", "defects")
        meanings = [entry["meaning"] for entry in report["legend"]]
        self.assertIn("nonmanifold-edge: 1", meanings)
        colour = next(entry["colour"] for entry in report["legend"]
                      if entry["meaning"] == "nonmanifold-edge: 1")
        wanted = tuple(int(colour[i:i + 2], 16) for i in (1, 3, 5))
        marked = sum(is_near(pixel, wanted, 12) for pixel in Png(self.path("a.png")).pixels())
        self.assertGreater(marked, 20)

    def test_duplicate_faces_are_coloured_as_the_input_numbers_them(self):
        # Face 0 is dropped: the duplicates are 2 and 3 of the input, 1 and 2 of the mesh.
        mesh = self.file("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 1 0\n"
                                  "f 1 1 2\nf 1 4 5\nf 1 2 3 4\nf 2 3 4 1\n")
        self.done("render", mesh, self.path("a.png"), *SMALL, "--shading", "defects")
        picture = Png(self.path("a.png"))
        orange = sum(r > b + 60 for r, g, b in picture.pixels())
        grey = sum(abs(r - b) < 25 and 90 < r < 215 for r, g, b in picture.pixels())
        self.assertGreater(orange, 300)
        self.assertGreater(grey, 50)

    def test_a_mesh_without_faces_is_paper(self):
        for text in ("", "v 0 0 0\nv 1 1 1\n", "v 3 3 3\nv 3 3 3\nv 3 3 3\nf 1 2 3\n"):
            picture = self.draw(self.file("a.obj", text), "--ao", "8", "--wireframe")
            self.assertTrue(all(max(pixel) - min(pixel) < 40 for pixel in picture.pixels()))

    def test_vertices_that_are_not_finite_are_left_out(self):
        mesh = self.file("a.obj", SQUARE + "v nan 0 0\nv inf 1 1\nf 1 2 5\nf 1 2 6\n")
        plain = self.draw(self.file("b.obj", SQUARE), "--shading", "normals")
        picture = self.draw(mesh, "--policy", "non-finite=keep", "--shading", "normals")
        unlike = sum(not is_near(a, b, 8) for a, b in zip(picture.pixels(), plain.pixels()))
        self.assertLess(unlike, 10)

    def test_the_numbers_are_printed(self):
        report = self.json("render", self.file("a.obj", cli.CUBE), self.path("A.PNG"), *SMALL,
                           "--wireframe", "--ao", "9")
        self.assertEqual({key: report[key] for key in ("width", "height", "shading", "wireframe",
                                                       "ao", "faces", "legend")},
                         {"width": 96, "height": 64, "shading": "smooth", "wireframe": True,
                          "ao": 9, "faces": 6, "legend": []})
        self.assertEqual(report["bytes"], os.path.getsize(self.path("A.PNG")))
        self.assertEqual(set(report["timings_ms"]), {"read", "build", "tree", "draw"})

    def test_bad_options_are_usage_errors_and_write_nothing(self):
        mesh = self.file("a.obj", cli.CUBE)
        for options in (("--width", "0"), ("--height", "-3"), ("--width", "99999"),
                        ("--shading", "cel"), ("--ao", "-1"), ("--ao", "many")):
            self.fails(2, "render", mesh, self.path("a.png"), *options)
        line = self.fails(2, "render", mesh, self.path("a.jpg"))
        self.assertIn("unknown-extension", line)
        self.fails(2, "render", mesh, self.path("a"))
        self.fails(2, "render", mesh)
        self.assertEqual(os.listdir(self.folder), ["a.obj"])

    def test_a_picture_that_cannot_be_written_is_an_output_error(self):
        mesh = self.file("a.obj", cli.CUBE)
        self.fails(4, "render", mesh, self.path("no/such/folder/a.png"), *SMALL)

    def test_a_mesh_that_cannot_be_read_is_an_input_error(self):
        self.fails(3, "render", self.path("none.obj"), self.path("a.png"))
        self.fails(3, "render", self.file("a.obj", cli.OUT_OF_RANGE), self.path("a.png"))
        self.fails(1, "render", self.file("b.obj", cli.THREE_ON_AN_EDGE), self.path("a.png"),
                   "--strict")
        self.assertFalse(os.path.exists(self.path("a.png")))

    def test_the_gallery_shows_what_its_script_draws(self):
        if cli.SANITIZED:
            self.skipTest("takes minutes under a sanitizer")
        root = pathlib.Path(__file__).resolve().parent.parent
        shown = re.findall(r"\(tools/gallery/(\w+\.png)\)", (root / "README.md").read_text())
        subprocess.run([root / "tools/gallery/make", self.folder], check=True,
                       env={**os.environ, "HEDGEROW": cli.PROGRAM})
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(shown))
        for name in shown:
            drawn, kept = Png(self.path(name)), Png(root / "tools/gallery" / name)
            self.assertEqual((drawn.width, drawn.height), (kept.width, kept.height))
            unlike = sum(not is_near(a, b, 12) for a, b in zip(drawn.pixels(), kept.pixels()))
            self.assertLess(unlike, 0.01 * kept.width * kept.height, name)


if __name__ == "__main__":
    cli.main(sys.argv)
