#!/usr/bin/env python3
"""The program on the shared meshes, good and bad.

usage: cli_shared_test.py PROGRAM SOURCE      exit 77: the folder of shared meshes is not there

Every good mesh: `inspect --json` agrees with each filled column of MANIFEST.csv. Every bad file:
what MANIFEST.csv expects of it, and never a crash or a hang.

The counts of the glTF rows and of the bad files are of the faces in the file, so there the faces
that `inspect` drops as degenerate are added to those that it keeps.
"""

import concurrent.futures
import csv
import json
import os
import pathlib
import subprocess
import sys

from support import cli

SKIPPED = 77
COUNTS = ("vertices", "faces", "triangles", "quads", "polygons", "degenerate_faces",
          "zero_area_faces", "duplicate_faces", "halfedges", "edges", "boundary_edges",
          "nonmanifold_edges", "inconsistent_edges", "isolated_vertices", "nonmanifold_vertices",
          "components", "euler")

def rows(folder):
    with open(folder / "MANIFEST.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def inspect(path):
    """(exit status, report or None, standard error)"""
    try:
        status, out, err = cli.run("inspect", path, "--json")
    except subprocess.TimeoutExpired:
        return None, None, "no answer in time"
    return status, json.loads(out) if status == 0 else None, err


def check_good(row, folder):
    status, report, err = inspect(folder / row["file"])
    if status != 0:
        return [f"status {status}: {err.strip()}"]
    wrong = []
    if row["format"] in ("glb", "gltf"):
        for field in ("faces", "triangles"):
            report[field] += report["degenerate_faces"]
    wrong += [f"{field} is {report[field]}, not {row[field]}" for field in COUNTS
              if row[field] != "" and report[field] != int(row[field])]
    sizes = report["triangles"] + report["quads"] + report["polygons"]
    if sizes != report["faces"]:
        wrong.append(f"triangles, quads and polygons add up to {sizes}, not {report['faces']}")
    return wrong


def check_bad(row, folder):
    path = folder / row["file"]
    status, report, err = inspect(path)
    expect = row["expect"]
    allowed = {"reject": (3,), "accept": (0,), "either": (0, 3)}[expect]
    if status not in allowed:
        return [f"status {status}, not {' or '.join(map(str, allowed))}: {err.strip()[:300]}"]
    if status == 3:
        first = err.splitlines()[0] if err else ""
        has_place = cli.TEXT_PLACE.match(first) or cli.BINARY_PLACE.match(first)
        # A file without a byte has no place to point at.
        is_plain = cli.PLAIN_ERROR.match(first) and first.startswith(str(path))
        if not has_place and not is_plain:
            return [f"message without a place: {first!r}"]
        if not has_place and os.path.getsize(path) > 0:
            return [f"message names no line or byte: {first!r}"]
        return []
    if expect == "accept":
        found = {"vertices": report["vertices"],
                 "faces": report["faces"] + report["degenerate_faces"]}
        return [f"{field} is {found[field]}, not {row[field]}" for field in found
                if row[field] != "" and found[field] != int(row[field])]
    return []


def check_all(name, folder, check):
    listed = [row for row in rows(folder) if not row["file"].endswith(".bin")]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        answers = list(pool.map(lambda row: check(row, folder), listed))
    failed = 0
    for row, wrong in zip(listed, answers):
        failed += bool(wrong)
        for line in wrong:
            print(f"FAILED {name}/{row['file']}: {line}")
    print(f"{name}: {len(listed)} files, {failed} failed")
    return failed


def main(program, source):
    shared = cli.shared_folder(source)
    if shared is None:
        print("skipped: no folder of shared meshes (HEDGEROW_SHARED or ../shared)")
        return SKIPPED
    cli.PROGRAM = program
    failed = check_all("meshes", pathlib.Path(shared) / "meshes", check_good)
    failed += check_all("bad", pathlib.Path(shared) / "bad", check_bad)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
