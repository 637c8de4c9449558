#!/usr/bin/env python3
"""Counts of instructions and bytes must not depend on anything but the program and its input."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
COUNT = pathlib.Path(__file__).resolve().parent.parent / "bench" / "count.py"
PATTERN = "^(build|vertex_normals_facelist|vertex_normals_halfedge)/(grid|shuffled)/200/1$"


def counted(program, folder):
    out = pathlib.Path(folder) / "counts.json"
    subprocess.run([sys.executable, str(COUNT), program, "--smoke", "--filter", PATTERN, "--out", str(out)],
                   check=True)
    return json.loads(out.read_text(encoding="utf-8"))["rows"]


def main(program):
    if shutil.which("valgrind") is None:
        print("skipped: valgrind is not installed")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        first, second = counted(program, folder), counted(program, folder)
    # Three operations on two orders, on two paths.
    assert len(first) == 12, first
    for row, again in zip(first, second):
        assert row == again, (row, again)
        # A loop that was not counted would be cheaper than this, an element.
        assert row["instructions"] > 5 * row["elements"], row
        # Every byte that had to move was missed once, in lines of 64.
        assert 64 * row["last_level_misses"] > row["compulsory_bytes"] / 2, row
    paths = {path: sum(row["instructions"] for row in first if row["path"] == path)
             for path in ("avx2", "portable")}
    print(paths)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
