#!/usr/bin/env python3
"""Points in the plane: delaunay and voronoi. usage: cli_planar_test.py PROGRAM"""

import math
import random
import sys
import xml.etree.ElementTree

from support import cli
from support.cli import ProgramTest

SQUARE = "0 0\n4 0\n4 3\n0 3\n1 1\n"


def random_points(count, seed=1):
    numbers = random.Random(seed)
    return "".join(f"{numbers.random()} {numbers.random()}\n" for _ in range(count))


def read_off(path):
    """Vertices and faces of an OFF file."""
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    assert words[0] == "OFF"
    vertex_count, face_count = int(words[1]), int(words[2])
    numbers = iter(words[4:])
    vertices = [tuple(float(next(numbers)) for _ in range(3)) for _ in range(vertex_count)]
    faces = [[int(next(numbers)) for _ in range(int(next(numbers)))] for _ in range(face_count)]
    return vertices, faces


def area(vertices, face):
    points = [vertices[v] for v in face]
    return sum(p[0] * q[1] - q[0] * p[1]
               for p, q in zip(points, points[1:] + points[:1])) / 2


class Delaunay(ProgramTest):
    def test_points_become_triangles_over_the_same_points(self):
        out = self.path("a.off")
        report = self.json("delaunay", self.file("a.xy", SQUARE), out)
        self.assertEqual(report["before"], {"points": 5, "repeated_points": 0})
        self.assertEqual(report["after"],
                         {"vertices": 5, "faces": 4, "edges": 8, "boundary_edges": 4,
                          "constrained_edges": 0})
        vertices, faces = read_off(out)
        self.assertEqual(vertices[2], (4, 3, 0))
        self.assertEqual([area(vertices, face) > 0 for face in faces], [True] * 4)
        self.assertAlmostEqual(sum(area(vertices, face) for face in faces), 12)

    def test_a_csv_with_named_columns_gives_the_same_mesh(self):
        text = 'name,Y,"x"\n"a, ""b""",0,0\nc,0,4\n# comment\n\nd,3,4\ne,3,0,5\nf, 1 ,1\n'
        first, second = self.path("a.off"), self.path("b.off")
        self.done("delaunay", self.file("a.xy", SQUARE), first)
        self.done("delaunay", self.file("b.csv", text), second)
        self.assertEqual(read_off(first), read_off(second))
        self.done("delaunay", self.file("c.CSV", SQUARE.replace(" ", ",")), second)
        self.assertEqual(read_off(first), read_off(second))

    def test_points_that_make_no_triangle_are_kept(self):
        for text, points in (("# none\n", 0), ("1 2\n", 1), ("0 0\n1 1\n2 2\n", 3)):
            report = self.json("delaunay", self.file("a.xy", text), self.path("a.ply"))
            self.assertEqual((report["after"]["vertices"], report["after"]["faces"]), (points, 0))

    def test_repeated_points_are_counted_and_refused_under_strict(self):
        points = self.file("a.xy", SQUARE + "4 0\n-0 0\n")
        report = self.json("delaunay", points, self.path("a.svg"))
        self.assertEqual(report["before"]["repeated_points"], 2)
        for command in ("delaunay", "voronoi"):
            error = self.fails(1, command, points, self.path("b.svg"), "--strict")
            self.assertIn("2 points", error)
            self.assertIn("point 5", error)

    def test_edges_are_kept_and_drawn(self):
        kite = self.file("kite.xy", "-2 0\n0 -1\n2 0\n0 1\n")
        edges = self.file("edges.csv", "from,to\n0,2\n1,2\n")
        report = self.json("delaunay", kite, self.path("a.svg"), "--edges", edges)
        self.assertEqual(report["after"]["edges"], 5)
        self.assertEqual(report["after"]["constrained_edges"], 2)
        root = xml.etree.ElementTree.parse(self.path("a.svg")).getroot()
        drawn = [path.get("d").count("M") for path in root.iter() if path.get("class")]
        self.assertEqual(drawn, [0, 2, 3])
        out = self.path("a.off")
        self.done("delaunay", kite, out, "--edges", edges)
        self.assertTrue(all({0, 2} <= set(face) for face in read_off(out)[1]))

    def test_bad_edges_are_named(self):
        square = self.file("a.xy", SQUARE)
        for text, code in (("0 2\n1 3\n", "crossing-edges: edge 1 crosses edge 0"),
                           ("0 1\n0 5\n", "index-out-of-range: edge 1 refers to point 5"),
                           ("0 -1\n", "index-out-of-range: edge 0 refers to point -1"),
                           ("2 2\n", "repeated-vertex: edge 0"),
                           ("0 1.5\n", "bad-number: edge 0"), ("0 1e30\n", "bad-number: edge 0"),
                           ("0\n", "missing-value")):
            edges = self.file("edges.xy", text)
            error = self.fails(3, "delaunay", square, self.path("a.svg"), "--edges", edges)
            self.assertIn("edges.xy", error)
            self.assertIn(code, error)
        self.fails(3, "delaunay", square, self.path("a.svg"), "--edges", self.path("none.xy"))
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        self.fails(2, "delaunay", mesh, self.path("a.ply"), "--edges", edges)

    def test_every_thread_count_writes_the_same_bytes(self):
        points = self.file("a.xy", random_points(30000))
        for command in ("delaunay", "voronoi"):
            files = set()
            for threads in (1, 2, 8):
                out = self.path(f"{threads}.ply")
                self.done(command, points, out, "--threads", threads)
                with open(out, "rb") as file:
                    files.add(file.read())
            self.assertEqual(len(files), 1)

    def test_the_edges_of_a_surface_are_flipped(self):
        mesh, out = self.path("terrain.ply"), self.path("out.ply")
        self.done("generate", "terrain", mesh, "--size", "5000")
        for order in ("rounds", "queue"):
            report = self.json("delaunay", mesh, out, "--order", order)
            self.assertGreater(report["before"]["failing_edges"], 100)
            self.assertEqual(report["after"]["failing_edges"], 0)
            self.assertGreater(report["flips"], 100)
            self.assertGreaterEqual(report["candidates"], report["flips"] + report["postponed"])
            self.assertEqual(report["before"]["edges"], report["after"]["edges"])
            after = self.json("inspect", out)
            self.assertEqual((after["faces"], after["manifold"]), (report["after"]["faces"], True))
            again = self.json("delaunay", out, self.path("again.ply"), "--order", order)
            self.assertEqual((again["flips"], again["before"]["failing_edges"]), (0, 0))

    def test_the_test_by_circles_looks_at_the_plane_only(self):
        kite = self.file("a.obj", "v -1 0 9\nv 0 -4 0\nv 0 4 0\nv 1 0 9\nf 1 2 3\nf 2 4 3\n")
        report = self.json("delaunay", kite, self.path("b.obj"), "--test", "in-circle")
        self.assertEqual((report["flips"], report["after"]["failing_edges"]), (1, 0))
        report = self.json("delaunay", kite, self.path("b.obj"))
        self.assertEqual(report["flips"], 0)

    def test_flips_stop_where_they_are_told_to(self):
        mesh = self.path("terrain.ply")
        self.done("generate", "terrain", mesh, "--size", "5000")
        report = self.json("delaunay", mesh, self.path("b.ply"), "--max-flips", "7")
        self.assertEqual((report["flips"], report["cut_short"]), (7, True))
        self.assertGreater(report["after"]["failing_edges"], 0)


class Voronoi(ProgramTest):
    def test_the_cells_fill_the_box(self):
        out = self.path("a.off")
        report = self.json("voronoi", self.file("a.xy", random_points(300)), out,
                           "--box", "-1,-1,3,2")
        self.assertEqual(report["box"], [-1, -1, 3, 2])
        self.assertEqual(report["after"]["faces"], 300)
        self.assertAlmostEqual(report["cell_area"]["sum"], report["box_area"])
        self.assertEqual(report["box_area"], 12)
        vertices, faces = read_off(out)
        self.assertEqual(report["after"]["vertices"], len(vertices))
        self.assertEqual(len(vertices) - report["after"]["edges"] + len(faces), 1)
        self.assertAlmostEqual(sum(area(vertices, face) for face in faces), 12, places=4)
        corners = {(x, y) for x, y, _ in vertices}
        self.assertTrue({(-1, -1), (3, -1), (3, 2), (-1, 2)} <= corners)

    def test_each_cell_is_nearest_to_its_point(self):
        text = random_points(60)
        points = [tuple(map(float, line.split())) for line in text.splitlines()]
        out = self.path("a.off")
        self.done("voronoi", self.file("a.xy", text), out)
        vertices, faces = read_off(out)
        for site, face in zip(points, faces):
            for v in face:
                own = math.dist(site, vertices[v][:2])
                self.assertLess(own, min(math.dist(p, vertices[v][:2]) for p in points) + 1e-5)

    def test_a_point_that_is_not_in_the_box_is_named(self):
        points = self.file("a.xy", SQUARE)
        for box in ("0,0,4,3", "-1,-1,3.9,4", "nan,-1,5,5", "5,5,-1,-1"):
            error = self.fails(2, "voronoi", points, self.path("a.svg"), f"--box={box}")
            self.assertIn("site-outside-box", error)
        self.done("voronoi", points, self.path("a.svg"), "--box=-1,-1,5,4")

    def test_no_points_have_no_cells(self):
        report = self.json("voronoi", self.file("a.xy", "# none\n"), self.path("a.svg"))
        self.assertEqual(report["after"], {"vertices": 0, "faces": 0, "edges": 0})


class Picture(ProgramTest):
    def test_a_picture_has_each_edge_and_each_point_once(self):
        points = self.file("a & b.xy", random_points(50))
        for command in ("delaunay", "voronoi"):
            out = self.path("a.SVG")
            report = self.json(command, points, out)
            root = xml.etree.ElementTree.parse(out).getroot()
            space = "{http://www.w3.org/2000/svg}"
            self.assertEqual(root.tag, space + "svg")
            self.assertEqual(len(root.findall(f".//{space}circle")), 50)
            lines = sum(path.get("d").count("M") for path in root.iter(space + "path"))
            self.assertEqual(lines, report["after"]["edges"])
            _, _, width, height = map(float, root.get("viewBox").split())
            for path in root.iter(space + "path"):
                numbers = path.get("d").replace("M", " ").replace("L", " ").split()
                for x, y in zip(numbers[::2], numbers[1::2]):
                    self.assertTrue(0 <= float(x) <= width and 0 <= float(y) <= height)


class BadInput(ProgramTest):
    def test_text_errors_have_their_place(self):
        for name, text, place, code in (
                ("a.xy", "0 0\n1 x\n", ":2:3", "bad-number"),
                ("a.xy", "0 0\n\n1\n", ":3:2", "missing-value"),
                ("a.xy", "0,0\n", ":1:1", "bad-number"),
                ("a.xy", "0 nan\n", ":1:3", "non-finite"),
                ("a.xy", "0 1e999\n", ":1:3", "non-finite"),
                ("a.csv", "0,0\n1;2\n", ":2:1", "bad-number"),
                ("a.csv", "x,y\n1\n", ":2:2", "missing-value"),
                ("a.csv", "x,y\n1,\n", ":2:3", "missing-value"),
                ("a.csv", "x,y\n1 2,3\n", ":2:3", "bad-number"),
                ("a.csv", "y,z,x\n1,\"a,b\",inf\n", ":2:9", "non-finite"),
                ("a.csv", "0,0\nx,y\n", ":2:1", "bad-number"),
                ("a.xy", "", ":1:1", "empty-file"),
                ("a.xy", b"\xff\xfe0\x00", ":1:1", "utf16-text"),
                ("a.xy", b"0 0\n\x00", ":2:1", "nul-byte")):
            with self.subTest(text=text):
                points = self.file(name, text)
                for command in ("delaunay", "voronoi"):
                    error = self.fails(3, command, points, self.path("o.svg"),
                                       pattern=cli.TEXT_PLACE)
                    self.assertIn(f"{name}{place}: error: {code}: ", error)

    def test_coordinates_that_signs_cannot_be_exact_for_are_named(self):
        for text, options in (("0 0\n1 1e300\n", ()), ("0 0\n1e-100 0\n", ()),
                              ("0 0\nnan 0\n", ("--policy", "non-finite=keep"))):
            points = self.file("a.xy", text)
            for command in ("delaunay", "voronoi"):
                error = self.fails(3, command, points, self.path("o.svg"), *options)
                self.assertIn("coordinate-out-of-range", error)
                self.assertIn("point 1", error)

    def test_what_floats_cannot_hold_needs_a_picture(self):
        points = self.file("a.xy", "0 0\n1e40 0\n0 1e40\n")
        self.assertIn("coordinate-out-of-range",
                      self.fails(3, "delaunay", points, self.path("o.ply")))
        self.done("delaunay", points, self.path("o.svg"))

    def test_mistakes_end_with_status_2(self):
        points = self.file("a.xy", SQUARE)
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        for arguments in (("delaunay", points), ("delaunay", points, self.path("o.png")),
                          ("delaunay", mesh, self.path("o.svg")),
                          ("delaunay", mesh, self.path("o.ply"), "--test", "nonsense"),
                          ("delaunay", mesh, self.path("o.ply"), "--order", "random"),
                          ("delaunay", mesh, self.path("o.ply"), "--max-flips", "-1"),
                          ("voronoi", points, self.path("o.glb")),
                          ("voronoi", points, self.path("o.svg"), "--box", "1,2,3"),
                          ("voronoi", points, self.path("o.svg"), "--box", "1,2,3,x")):
            with self.subTest(arguments=arguments):
                self.fails(2, *arguments)

    def test_points_are_read_from_xy_and_csv_only(self):
        mesh = self.file("a.obj", cli.TETRAHEDRON)
        self.assertIn("unknown-extension", self.fails(3, "voronoi", mesh, self.path("o.svg")))
        self.fails(3, "voronoi", self.path("missing.xy"), self.path("o.svg"))

    def test_an_output_that_cannot_be_made_ends_with_status_4(self):
        points = self.file("a.xy", SQUARE)
        for command in ("delaunay", "voronoi"):
            for name in ("none/o.svg", "none/o.ply"):
                self.fails(4, command, points, self.path(name))

    def test_a_line_with_more_than_two_numbers_is_warned_about(self):
        points = self.file("a.xy", "0 0 5\n1 0 5 # comment\n0 1 # comment\n")
        status, _out, err = cli.run("delaunay", points, self.path("o.svg"))
        self.assertEqual(status, 0)
        self.assertIn(":1: warning: extra-values:", err)
        self.assertIn("(2 times)", err)


if __name__ == "__main__":
    cli.main(sys.argv)
