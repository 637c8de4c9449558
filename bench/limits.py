#!/usr/bin/env python3
"""Holds the core operations to the bytes that have to move, and to instructions counted before.

  limits.py count PROGRAM --out FILE       count with callgrind; half a minute
  limits.py bytes FILE                     against the factors below
  limits.py instructions FILE              against bench/results/limits.json, to within 1 %
  limits.py renew PROGRAM --reason TEXT    make what is counted now the baseline, and say why

No clock takes part, so a verdict is the same on a busy machine. Exit status: 0 within the limits,
1 outside them, 2 usage, 77 where nothing can be said (with the reason).

The caches are simulated: first level 32 KiB 8-way, last level 2 MiB 16-way, empty at the start. The
meshes of 400,000 triangles take 15 MB with positions and normals, seven times that, and no column
that is read at random fits: whatever is read twice is fetched twice, as from memory. A smaller last
level would not hold the megabyte in which the builder links a block of vertices, and would judge it
on a machine that it is not made for.
"""

import argparse
import concurrent.futures
import datetime
import json
import os
import pathlib
import shutil
import subprocess
import sys

import count as counting
from perf_format import markdown

BASELINE = pathlib.Path(__file__).resolve().parent / "results" / "limits.json"
CACHES = ["--I1=32768,8,64", "--D1=32768,8,64", "--LL=2097152,16,64"]
SKIPPED = 77
LINE = 64
TOLERANCE = 0.01        # instructions, either way: a gain that is not recorded hides the next loss
BYTES_TOLERANCE = 0.03  # against the baseline; addresses move lines between sets
MIN_REASON = 10         # characters

ANYWHERE = "vertices and neighbours lie anywhere: a line of 64 bytes for each"
TWICE = "corners are read twice, first to know which faces touch which block of vertices"
# Bytes moved at most, as a multiple of what any implementation has to move (PERF.md, "Method": each
# column once, which is the limit), and why it is not nearer to 1.
FACTORS = {
    "build/grid/400k/1": (1.75, TWICE),
    "build/shuffled/400k/1": (26.0, "corners go to blocks that no cache holds, then to their vertices"),
    "face_normals/grid/400k/1": (1.05, ""),
    "face_normals/shuffled/400k/1": (3.2, ANYWHERE),
    "vertex_normals_facelist/grid/400k/1": (1.65, TWICE),
    "vertex_normals_facelist/grid/400k/1/angle": (1.65, TWICE),
    "vertex_normals_facelist/shuffled/400k/1": (13.5, ANYWHERE),
    "vertex_normals_halfedge/grid/400k/1": (1.05, ""),
    "vertex_normals_halfedge/grid/400k/1/angle": (1.05, ""),
    "vertex_normals_halfedge/shuffled/400k/1": (14.0, ANYWHERE),
    "one_ring/grid/400k/1": (1.05, ""),
    "one_ring/grid/400k/1/pass": (1.05, ""),
    "one_ring/shuffled/400k/1": (12.0, ANYWHERE),
    "boundary_loops/grid/400k/1": (1.1, ""),
    "components/grid/400k/1": (1.25, "parents are read once more to become labels"),
    "components/shuffled/400k/1": (1.25, "parents are read once more to become labels"),
    "close_boundary/grid/400k/1": (1.45, "opposite is read three times: to find, to copy, to go round"),
    "open_boundary/grid/400k/1": (1.3, "face and next are checked before anything is made"),
    "reorder_hilbert/grid/400k/1": (6.0, "each digit of the keys is a pass over all of them"),
    "validate/grid/400k/1": (2.5, "two passes read origin and opposite"),
}
PATTERNS = ["^(" + "|".join(name for name in FACTORS if f"/{order}/" in name) + ")$"
            for order in ("grid", "shuffled")]


def fail(message):
    print(f"limits.py: {message}", file=sys.stderr)
    raise SystemExit(2)


def skip(reason):
    print(f"skipped: {reason}")
    raise SystemExit(SKIPPED)


# -- counting


def system():
    """"debian 12": the library's memset and memcpy are counted, too."""
    try:
        lines = pathlib.Path("/etc/os-release").read_text(encoding="utf-8").splitlines()
    except OSError:
        return "unknown"
    values = {key: value.strip('"') for key, _, value in (line.partition("=") for line in lines)}
    return f"{values.get('ID', 'unknown')} {values.get('VERSION_ID', '')}".strip()


def context_of(program):
    """What the numbers depend on besides the sources."""
    ran = subprocess.run([program, "--smoke", "--benchmark_filter=^build/grid/200/1/L1$",
                          "--benchmark_format=json"], check=True, stdout=subprocess.PIPE)
    told = json.loads(ran.stdout)["context"]
    version = subprocess.run(["valgrind", "--version"], check=True, stdout=subprocess.PIPE)
    return {"compiler": told["compiler"], "flags": told["flags"], "index_bits": told["index_bits"],
            "system": system(), "valgrind": version.stdout.decode().strip(), "caches": " ".join(CACHES)}


def has_avx2():
    try:
        return " avx2 " in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").replace("\n", " \n")
    except OSError:
        return False


def counted(program, jobs):
    """The context and the rows, by name. Skips where this cannot be done."""
    if shutil.which("valgrind") is None:
        skip("valgrind is not installed")
    if not has_avx2():
        skip("the processor has no AVX2, and the path for it is what is counted")
    context = context_of(program)
    if not context["flags"].startswith("Release:"):
        skip(f"the program was built as {context['flags']!r}; only Release counts")
    if context["index_bits"] != "32":
        skip(f"indices of {context['index_bits']} bits move other bytes")
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        parts = list(pool.map(lambda pattern: counting.count(program, pattern, "avx2", [], CACHES),
                              PATTERNS))
    rows = {}
    for row in (row for part in parts for row in part):
        variant = f"/{row['variant']}" if row["variant"] else ""
        name = f"{row['operation']}/{row['dataset']}/{row['size']}/1{variant}"
        rows[name] = {"instructions": row["instructions"], "bytes": LINE * row["last_level_misses"],
                      "compulsory_bytes": row["compulsory_bytes"], "elements": row["elements"],
                      "element": row["element"]}
        if "classification" in row:
            rows[name]["classification"] = row["classification"]
    return {"context": context, "rows": rows}


# -- judging


def judge_bytes(document):
    """Lines of a table, and what is wrong."""
    table, wrong = [], []
    for name, (factor, reason) in FACTORS.items():
        row = document["rows"].get(name)
        if row is None:
            wrong.append(f"{name}: was not counted")
            continue
        moved = row["bytes"] / row["compulsory_bytes"]
        per_element = row["bytes"] / row["elements"]
        limit = row["compulsory_bytes"] / row["elements"]
        table.append([name, f"{per_element:.1f} a {row['element']}", f"{limit:.1f}", f"{moved:.2f}",
                      f"{factor:.2f}", reason])
        if moved > factor:
            wrong.append(f"{name}: {per_element:.1f} bytes a {row['element']} are {moved:.2f} times the "
                         f"{limit:.1f} that have to move; at most {factor:.2f} times")
    return table, wrong


def differences(name, row, before):
    """What moved by more than it may, as sentences."""
    for key, tolerance in (("instructions", TOLERANCE), ("classification", TOLERANCE),
                           ("bytes", BYTES_TOLERANCE)):
        if key not in row and key not in before:
            continue
        if not row.get(key) or not before.get(key):
            yield f"{name}: {key} was counted on one side only"
            continue
        change = row[key] / before[key] - 1
        if abs(change) > tolerance:
            yield (f"{name}: {row[key]} {key}, {change:+.2%} of {before[key]}; at most "
                   f"{tolerance:.0%}{'' if change > 0 else ' (a gain: record it with renew)'}")


def judge_instructions(document, baseline):
    table, wrong = [], []
    names = list(dict.fromkeys([*baseline["rows"], *document["rows"]]))
    for name in names:
        row, before = document["rows"].get(name), baseline["rows"].get(name)
        if row is None or before is None:
            wrong.append(f"{name}: {'was not counted' if row is None else 'is not in the baseline'}")
            continue
        wrong += differences(name, row, before)
        table.append([name, row["element"], f"{row['instructions'] / row['elements']:.2f}",
                      f"{row['instructions'] / before['instructions'] - 1:+.3%}",
                      f"{row['bytes'] / before['bytes'] - 1:+.2%}"])
    return table, wrong


def conclude(header, table, wrong):
    print(markdown(header, table))
    for line in wrong:
        print(f"FAILED {line}")
    return 1 if wrong else 0


def read(path):
    try:
        document = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except FileNotFoundError:
        skip(f"{path} is not there: nothing was counted")
    except (OSError, ValueError) as error:
        fail(f"{path}: {error}")
    if not isinstance(document, dict) or not isinstance(document.get("rows"), dict) or not document["rows"]:
        fail(f"{path}: holds no counted rows")
    return document


# -- commands


def run_count(options):
    options.out.unlink(missing_ok=True)  # what is left of another build would be judged
    document = counted(options.program, options.jobs)
    options.out.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    print(f"{len(document['rows'])} operations counted")
    return 0


def run_bytes(options):
    return conclude(["operation", "bytes", "have to move", "times", "at most", "why not less"],
                    *judge_bytes(read(options.counts)))


def run_instructions(options):
    document, baseline = read(options.counts), read(options.baseline)
    for key, value in baseline["context"].items():
        if document["context"].get(key) != value:
            skip(f"the baseline is for {key} {value!r}, this is {document['context'].get(key)!r}")
    status = conclude(["operation", "element", "instructions/element", "since the baseline", "bytes"],
                      *judge_instructions(document, baseline))
    if status != 0:
        print("If that is wanted: bench/limits.py renew build/release/bench/hedgerow_bench --reason WHY")
    return status


def run_renew(options):
    reason = " ".join((options.reason or "").split())
    if len(reason) < MIN_REASON:
        fail("--reason: why the baseline changes, in a sentence; it is stored beside the numbers")
    document = counted(options.program, options.jobs)
    missing = [name for name in FACTORS if name not in document["rows"]]
    if missing:
        fail(f"not counted: {', '.join(missing)}")
    today = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")
    document = {"reason": reason, "date": today, **document}
    if options.baseline.exists():
        print("\n".join(judge_instructions(document, read(options.baseline))[1]) or "no row changed")
    whole = options.baseline.with_suffix(".new")
    whole.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    whole.replace(options.baseline)
    print(f"wrote {options.baseline}; its reason belongs in the commit, too")
    return 0


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name, function in (("count", run_count), ("renew", run_renew)):
        command = commands.add_parser(name)
        command.add_argument("program")
        command.add_argument("--jobs", type=int, default=os.cpu_count())
        command.set_defaults(run=function)
        if name == "count":
            command.add_argument("--out", type=pathlib.Path, required=True)
        else:
            command.add_argument("--reason", help="why; stored, and refused if it says nothing")
            command.add_argument("--baseline", type=pathlib.Path, default=BASELINE)
    for name, function in (("bytes", run_bytes), ("instructions", run_instructions)):
        command = commands.add_parser(name)
        command.add_argument("counts", type=pathlib.Path)
        command.set_defaults(run=function)
        if name == "instructions":
            command.add_argument("--baseline", type=pathlib.Path, default=BASELINE)
    options = parser.parse_args(arguments)
    return options.run(options)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
