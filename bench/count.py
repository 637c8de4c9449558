#!/usr/bin/env python3
"""Counts instructions and last-level misses of the main operations: numbers without a clock.

  count.py build/release/bench/hedgerow_bench [--filter REGEX [--again]] [--out FILE]

Runs each operation once under callgrind, from empty caches of a fixed shape (first level 32 KiB
8-way, last level 32 MiB 16-way), on the AVX2 path and on the portable one, one thread. Two runs of
one program give the same counts on every machine with the same libraries. Takes ten minutes.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from perf_results import COUNTS, write_document
from perf_tables import ELEMENTS, SINGULAR

CACHES = ["--I1=32768,8,64", "--D1=32768,8,64", "--LL=33554432,16,64"]
PATHS = ("avx2", "portable")
OPERATIONS = ("build", "face_normals", "vertex_normals_facelist", "vertex_normals_halfedge",
              "one_ring", "components", "boundary_loops")
FILTERS = [f"^({'|'.join(OPERATIONS)})/{order}/4M/1(/angle|/pass)?$" for order in ("grid", "scan", "shuffled")]
# Functions that look for defects and do nothing else.
CLASSIFYING = re.compile(r"check_(faces|triangles|triangle_runs)")
TOP = 5  # functions that are kept with each row


class Part:
    """What callgrind counted between two dumps."""

    def __init__(self, text):
        self.name = re.search(r"^desc: Trigger: Client Request: (.*)$", text, re.M)
        self.name = self.name.group(1).strip() if self.name else None
        events = re.search(r"^events: (.*)$", text, re.M).group(1).split()
        totals = re.search(r"^totals: (.*)$", text, re.M).group(1).split()
        self.totals = dict.fromkeys(events, 0)
        self.totals.update(zip(events, map(int, totals)))
        self.instructions_of = functions(text, events.index("Ir"))


def functions(text, column):
    """Instructions of each function itself, without what it calls."""
    names, own, current, is_call = {}, {}, None, False
    for line in text.splitlines():
        if line.startswith("fn="):
            number, _, name = line[3:].partition(" ")
            if name:
                names[number] = name
            current = names[number]
        elif line.startswith("calls="):
            is_call = True  # the next line is the cost of the callee
        elif line[:1] in "0123456789+-*" and line:
            values = line.split()[1:]
            if not is_call and len(values) > column:
                own[current] = own.get(current, 0) + int(values[column])
            is_call = False
        elif line.startswith(("cfn=", "cob=", "cfi=", "cfl=")):
            number, _, name = line[4:].partition(" ")
            if line.startswith("cfn=") and name:
                names[number] = name
    return own


def count(program, pattern, path, options, caches=tuple(CACHES)):
    """The counted rows of one process."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind.out"
        command = ["valgrind", "--tool=callgrind", "--instr-atstart=no", "--cache-sim=yes", *caches,
                   f"--callgrind-out-file={out}", program, "--threads", "1", "--count", pattern, *options]
        ran = subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                             env={**os.environ, "HEDGEROW_SIMD": path})
        if ran.returncode != 0:
            raise SystemExit(f"{' '.join(command)} ended with {ran.returncode}:\n{ran.stderr.decode()[-2000:]}")
        parts = [Part(file.read_text()) for file in pathlib.Path(folder).glob("callgrind.out.*")]
        counted = {part.name: part for part in parts if part.name}
        lines = [json.loads(line) for line in ran.stdout.decode().splitlines() if line.startswith("{")]
        return [row_of(line, counted[line["name"]], path) for line in lines]


def row_of(line, part, path):
    operation, dataset, size, _, *variant = line["name"].split("/")
    element = ELEMENTS.get(operation, "halfedges")
    row = {"operation": operation, "dataset": dataset, "size": size, "variant": "/".join(variant),
           "path": path, "element": SINGULAR[element], "elements": line[element],
           "compulsory_bytes": line["compulsory_bytes"], "instructions": part.totals["Ir"],
           "last_level_misses": part.totals["DLmr"] + part.totals["DLmw"]}
    if operation == "build":
        row["classification"] = sum(cost for name, cost in part.instructions_of.items()
                                    if CLASSIFYING.search(name))
    largest = sorted(part.instructions_of.items(), key=lambda item: -item[1])[:TOP]
    row["functions"] = {short(name): cost for name, cost in largest}
    return row


def replace(stored, newer):
    """The stored rows, those that were counted anew in the place of their namesakes."""
    def key(row):
        return tuple(row[part] for part in ("operation", "dataset", "size", "variant", "path"))

    found = {key(row): row for row in newer}
    return [found.pop(key(row), row) for row in stored] + list(found.values())


def short(name):
    """A function without its arguments and namespaces."""
    return name.replace("(anonymous namespace)::", "").partition("(")[0].split("::")[-1]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--filter", action="append", help="of names; one process for each of these")
    parser.add_argument("--out", type=pathlib.Path, default=COUNTS)
    parser.add_argument("--again", action="store_true",
                        help="keep the stored rows that are not counted anew")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--smoke", action="store_true", help="on tiny meshes")
    options = parser.parse_args(arguments)

    version = subprocess.run(["valgrind", "--version"], check=True, stdout=subprocess.PIPE)
    work = [(pattern, path) for pattern in options.filter or FILTERS for path in PATHS]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = [pool.submit(count, options.program, pattern, path, ["--smoke"] if options.smoke else [])
                for pattern, path in work]
        rows = []
        for (pattern, path), job in zip(work, jobs):
            rows += job.result()
            print(f"{path}: {pattern}", file=sys.stderr)
    if not rows:
        raise SystemExit("nothing was counted")
    context = {"valgrind": version.stdout.decode().strip(), "caches": CACHES}
    if options.again:
        rows = replace(json.loads(options.out.read_text(encoding="utf-8"))["rows"], rows)
    write_document({"context": context, "rows": rows}, options.out)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
