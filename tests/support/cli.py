"""What the tests of the program share: running it, small meshes, reading its PLY files."""

import json
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = None  # set by main()
SANITIZED = False
RAYS = True
TIMEOUT_S = 600

TEXT_PLACE = re.compile(r"^(?P<path>.+?):\d+:\d+: error: [a-z0-9]+(-[a-z0-9]+)*: \S")
BINARY_PLACE = re.compile(r"^(?P<path>.+?)@\d+: error: [a-z0-9]+(-[a-z0-9]+)*: \S")
PLAIN_ERROR = re.compile(r"^.+: error: [a-z0-9]+(-[a-z0-9]+)*: \S")


def run(*arguments, **options):
    """Runs the program and returns (exit status, standard output, standard error)."""
    result = subprocess.run([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, timeout=TIMEOUT_S, check=False, **options)
    return result.returncode, result.stdout.decode(), result.stderr.decode(errors="replace")


def index_bits():
    """Of the program, by its own word."""
    status, out, _err = run("--version")
    assert status == 0
    return int(re.search(r"^indices +(\d+) bits$", out, re.MULTILINE).group(1))


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, and words for what the program does."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="hedgerow-cli-")
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)

    def path(self, name):
        return str(self.folder / name)

    def file(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return str(path)

    def done(self, *arguments, **options):
        """Runs the program, wants status 0, returns standard output."""
        status, out, err = run(*arguments, **options)
        self.assertEqual(status, 0, f"{arguments}: {err}")
        return out

    def json(self, *arguments, status=0):
        """Runs the program with --json, wants one object and nothing else; returns it."""
        found, out, err = run(*arguments, "--json")
        self.assertEqual(found, status, f"{arguments}: {err}")
        value = json.loads(out)
        self.assertIsInstance(value, dict)
        return value

    def fails(self, status, *arguments, pattern=PLAIN_ERROR, **options):
        """Runs the program, wants `status` and one error line of the agreed form; returns it."""
        found, out, err = run(*arguments, **options)
        self.assertEqual(found, status, f"{arguments}: {out}{err}")
        self.assertRegex(err, pattern)
        lines = err.splitlines()
        for line in lines[1:]:
            self.assertTrue(line.startswith("  "), f"detail line not indented: {line!r}")
        return lines[0]


TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
CUBE = ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
THREE_ON_AN_EDGE = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 -1 0\nf 1 2 3\nf 1 2 4\nf 2 1 5\n"
BAD = THREE_ON_AN_EDGE + "f 1 1 2\nv 9 9 9\n"
OUT_OF_RANGE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n"


# What `inspect` says, in its order.
INSPECT_FIELDS = [
    "vertices", "faces", "triangles", "quads", "polygons", "degenerate_faces", "zero_area_faces",
    "duplicate_faces", "halfedges", "edges", "boundary_edges", "nonmanifold_edges",
    "inconsistent_edges", "isolated_vertices", "nonmanifold_vertices", "components", "euler",
    "boundary_loops", "genus", "closed", "manifold", "oriented", "valence", "bytes", "timings_ms",
    "defects", "defects_total", "digest"]


def shuffled_grid(side, seed=7):
    """OBJ text of a grid of 2 side^2 triangles, vertices and faces in random order."""
    shuffle = random.Random(seed)
    count = (side + 1) ** 2
    new_number = list(range(count))
    shuffle.shuffle(new_number)
    vertices = [None] * count
    for v in range(count):
        vertices[new_number[v]] = f"v {v % (side + 1)} {v // (side + 1)} {(v * v) % 7}\n"
    faces = []
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x
            b, c, d = a + 1, a + side + 2, a + side + 1
            for face in ((a, b, c), (a, c, d)):
                faces.append("f " + " ".join(str(new_number[v] + 1) for v in face) + "\n")
    shuffle.shuffle(faces)
    return "".join(vertices + faces)


def read_normals_ply(path):
    """Vertices (six floats each) and faces of the PLY that `normals` writes."""
    data = pathlib.Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode().splitlines()
    counts = {line.split()[1]: int(line.split()[2]) for line in header
              if line.startswith("element ")}
    properties = [line for line in header if line.startswith("property ")]
    position = end
    vertices = []
    for _ in range(counts["vertex"]):
        vertices.append(struct.unpack_from("<6f", data, position))
        position += 24
    faces = []
    wide = "list int " in properties[-1] or "list uint " in properties[-1]
    for _ in range(counts["face"]):
        degree, = struct.unpack_from("<i" if wide else "<B", data, position)
        position += 4 if wide else 1
        faces.append(struct.unpack_from(f"<{degree}i", data, position))
        position += 4 * degree
    return header, properties, vertices, faces, len(data) - position


def shared_folder(source):
    """The folder of shared meshes, or None: HEDGEROW_SHARED, or beside the source tree."""
    given = os.environ.get("HEDGEROW_SHARED")
    folder = pathlib.Path(given) if given else pathlib.Path(source).parent / "shared"
    return folder if (folder / "meshes" / "MANIFEST.csv").is_file() else None


def main(arguments):
    """PROGRAM [--sanitized] [--no-rays] [unittest arguments]"""
    global PROGRAM, SANITIZED, RAYS  # pylint: disable=global-statement
    PROGRAM = arguments.pop(1)
    if "--sanitized" in arguments:
        arguments.remove("--sanitized")
        SANITIZED = True
    if "--no-rays" in arguments:
        arguments.remove("--no-rays")
        RAYS = False
    sys.argv = arguments
    unittest.main(module="__main__", verbosity=2)
