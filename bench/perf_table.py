#!/usr/bin/env python3
"""Writes the tables of PERF.md, and the one of README.md, from the results of the benchmarks; nobody types a number there.

  perf_table.py --measure build/release/bench/hedgerow_bench [--mesh FILE]... [--rounds 5]
      runs the benchmarks, some once more on each narrower path, stores bench/results/results.json
      and rewrites the tables (bench/count.py makes counts.json, bench/perf_plots.py the pictures)
  perf_table.py --measure PROG --again PATTERN
      measures only the groups with such names, which take the place of the stored ones; the table
      of the machine says when (rows that are compared with each other should be one group)
  perf_table.py --representations PROG [--rounds 3]
      the same for what all representations are asked: bench/results/representations.json
  perf_table.py --planar PROG [--rounds 5]
      the same for triangulations, flips, decimation and subdivision: bench/results/planar.json
  perf_table.py --imr PROG [--mesh FILE]... [--rounds 5]
      the same for the six tests of the IMR 2011 suite: bench/results/imr.json
  perf_table.py --frames build/release/bench/hedgerow_frames [--part NAME]... [--mesh DRAGON]
      the same for frames of a ray tracer: bench/results/frames.json, of which each part takes up
      to three minutes; without --part all that need no mesh, or with --mesh all that do
  perf_table.py                 rewrites the tables from the stored results
  perf_table.py --check         exit status 1 if the tables are not those of the stored results
  perf_table.py --targets PROG  measures only what the tables of targets need, and prints them

A table stands between the lines `<!-- table:NAME begin -->` and `<!-- table:NAME end -->`.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from perf_frames import FRAMES, MESH_PARTS, PARTS, frame_tables, frame_targets
from perf_frames import read_frames, with_part
from perf_imr import IMR, imr_tables
from perf_planar import PATTERN, PLANAR, planar_tables
from perf_representations import REPRESENTATIONS, read_representations, representation_tables
from perf_results import FOLDER, PATHS, Results, merge, read_counts, read_results, replace, write_document
from perf_results import RESULTS
from perf_tables import SWEPT, all_tables, readme_tables, rewrite, targets_table
from perf_targets import FOUNDATION, TARGETS, row_filter

PERF = FOLDER.parent / "PERF.md"
README = FOLDER.parent / "README.md"
# For meshes that are made, changed and freed again; PERF.md says why.
SMALL_PAGES = {"HEDGEROW_HUGE_PAGES": "off"}
PATHS_FILTER = f"^({'|'.join(SWEPT)})/(grid|scan|shuffled)/4M/[0-9]+$"


def run(program, options, **environment):
    """The results of one process."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "results.json"
        status = subprocess.run([program, "--out", str(out), *options], check=False,
                                env={**os.environ, **environment}).returncode
        if not out.exists():
            raise SystemExit(f"{program} ended with status {status} and no results")
        return json.loads(out.read_text(encoding="utf-8"))


def measure(program, options, pattern=None):
    """A run, and one on each narrower path for what has such a row."""
    chosen = ["--filter", pattern] if pattern else []
    usual = run(program, [*options, *chosen])
    return merge(usual, {path: run(program, [*options, "--filter", PATHS_FILTER], HEDGEROW_SIMD=path)
                         for path in PATHS})


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--measure", metavar="PROGRAM")
    parser.add_argument("--again", metavar="PATTERN", help="with --measure: only these groups")
    parser.add_argument("--targets", metavar="PROGRAM")
    parser.add_argument("--representations", metavar="PROGRAM")
    parser.add_argument("--planar", metavar="PROGRAM")
    parser.add_argument("--imr", metavar="PROGRAM")
    parser.add_argument("--frames", metavar="PROGRAM")
    parser.add_argument("--part", action="append", choices=[*PARTS, *MESH_PARTS],
                        help="of the frames, which to measure")
    parser.add_argument("--mesh", action="append", default=[], help="also measure on this mesh")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS)
    parser.add_argument("--answers", type=pathlib.Path, default=REPRESENTATIONS)
    parser.add_argument("--flat", type=pathlib.Path, default=PLANAR, help="results of --planar")
    parser.add_argument("--six", type=pathlib.Path, default=IMR, help="results of --imr")
    parser.add_argument("--drawn", type=pathlib.Path, default=FRAMES)
    parser.add_argument("--perf", type=pathlib.Path, default=PERF)
    parser.add_argument("--readme", type=pathlib.Path, default=README)
    options = parser.parse_args(arguments)

    measured = ["--rounds", str(options.rounds)]
    for mesh in options.mesh:
        measured += ["--mesh", mesh]
    if options.targets:
        results = Results(measure(options.targets, measured, row_filter()))
        for targets in (FOUNDATION, TARGETS):
            print(targets_table(targets)(results, read_counts()), end="\n\n")
        return 0
    if options.measure:
        found = measure(options.measure, measured, options.again)
        if options.again:
            stored = json.loads(options.results.read_text(encoding="utf-8"))
            found = replace(stored, found)
        write_document(found, options.results)
    if options.representations:
        answers = run(options.representations, ["--representations", *measured])
        write_document(answers, options.answers)
    if options.planar:
        flat = run(options.planar, ["--rounds", str(options.rounds), "--filter", PATTERN],
                   **SMALL_PAGES)
        write_document(flat, options.flat)
    if options.imr:
        write_document(run(options.imr, ["--imr", *measured], **SMALL_PAGES), options.six)
    if options.frames:
        record_frames(options)
    return write_pages(options)


def record_frames(options):
    """Measures the chosen parts, each of which is stored as soon as it is there."""
    chosen = options.part or (MESH_PARTS if options.mesh else PARTS)
    for part in chosen:
        if part in MESH_PARTS and not options.mesh:
            raise SystemExit(f"part {part} is of a mesh file: --mesh FILE")
        mesh = ["--mesh", options.mesh[0]] if part in MESH_PARTS else []
        recorded = run(options.frames, [*mesh, *({**PARTS, **MESH_PARTS}[part])])
        write_document(with_part(read_frames(options.drawn), part, recorded), options.drawn)


def write_pages(options):
    """Rewrites or checks each page; returns the exit status."""
    results, counts = read_results(options.results), read_counts()
    answers, frames = read_representations(options.answers), read_frames(options.drawn)
    flat, six = read_results(options.flat), read_results(options.six)
    drawn = {"frames-targets": targets_table(frame_targets()), **frame_tables()}
    pages = {options.perf: [(results, all_tables()), (answers, representation_tables()),
                            (flat, planar_tables()), (six, imr_tables()), (frames, drawn)],
             options.readme: [(results, readme_tables())]}
    status = 0
    for page, parts in pages.items():
        text = made = page.read_text(encoding="utf-8")
        for source, tables in parts:
            made = rewrite(made, source, counts, tables)
        if not options.check:
            page.write_text(made, encoding="utf-8")
        elif made != text:
            print(f"{page}: the tables are not those of {options.results}; run bench/perf_table.py",
                  file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
