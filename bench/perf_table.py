#!/usr/bin/env python3
"""Writes the tables of PERF.md from the results of the benchmarks; nobody types a number there.

  perf_table.py --measure build/release/bench/hedgerow_bench [--mesh FILE] [--processes 3]
      runs the benchmarks, stores bench/results/results.json and rewrites the tables
  perf_table.py                 rewrites the tables from the stored results
  perf_table.py --check         exit status 1 if the tables are not those of the stored results
  perf_table.py --targets PROG  measures only what the table of targets needs, and prints that table

A table stands between the lines `<!-- table:NAME begin -->` and `<!-- table:NAME end -->`. The time of
a benchmark is the median over processes of the mean over the iterations in one process; its spread is
the range over the processes as a share of the median.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
RESULTS = FOLDER / "results" / "results.json"
PERF = FOLDER.parent / "PERF.md"

NS_PER_UNIT = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
COUNTERS = ("bytes", "faces", "halfedges", "mesh_bytes", "processor_ns", "vertices")
BASELINES = ("pointer", "struct")
PEERS = ("openmesh", "cgal", "meshoptimizer")
# The bandwidth kernel that mixes reads and writes as the operation does.
BANDWIDTH_KERNEL = {
    "boundary_loops": "read", "components": "read", "one_ring": "read", "validate": "read",
    "build": "copy", "fill_column": "copy", "close_boundary": "copy", "open_boundary": "copy",
    "reorder_hilbert": "copy", "reorder_morton": "copy", "reorder_breadth_first": "copy",
    "face_normals": "triad", "vertex_normals_facelist": "triad",
    "vertex_normals_halfedge": "triad",
}
# Where an operation's competitors are found, if not under its own name.
COMPETES_WITH = {"vertex_normals_facelist": "vertex_normals_halfedge"}
TABLES = {
    "build": ("build",),
    "normals": ("face_normals", "vertex_normals_facelist", "vertex_normals_halfedge"),
    "memory": ("fill_column",),
    "queries": ("one_ring", "boundary_loops", "components"),
    "whole-mesh": ("close_boundary", "open_boundary", "validate", "reorder_hilbert",
                   "reorder_morton", "reorder_breadth_first"),
}
# What, of ours, against the fastest of these, at least so many times faster.
TARGETS = (
    ("build, ordered grid", "build/grid/4M/2", ("build/grid/4M/1/openmesh", "build/grid/4M/1/cgal"), 8),
    ("build, shuffled grid", "build/shuffled/4M/2",
     ("build/shuffled/4M/1/openmesh", "build/shuffled/4M/1/cgal"), 10),
    ("face normals", "face_normals/grid/4M/2", ("face_normals/grid/4M/1/openmesh",), 4),
    ("vertex normals, linear face list", "vertex_normals_facelist/grid/4M/2",
     ("vertex_normals_halfedge/grid/4M/1/openmesh",), 5),
    ("vertex normals, half-edge gather", "vertex_normals_halfedge/grid/4M/2",
     ("vertex_normals_halfedge/grid/4M/1/openmesh",), 3),
)
TARGET_BYTES_PER_TRIANGLE = 27


class Row:
    """One benchmark: its name taken apart, and its times in nanoseconds, one a process."""

    def __init__(self, name):
        self.name = name
        parts = name.split("/")
        self.operation, self.dataset, self.size = parts[:3]
        self.threads = int(parts[3])
        self.variant = "/".join(parts[4:])
        self.times_ns = []
        self.processor_ns = []
        self.error = None
        self.counters = {}

    @property
    def ns(self):
        return statistics.median(self.times_ns)

    @property
    def spread(self):
        return (max(self.times_ns) - min(self.times_ns)) / self.ns

    @property
    def gb_per_s(self):
        return self.counters["bytes"] / self.ns


def read_results(path):
    """The context and the rows by name, in the order of the file, of Google Benchmark's JSON."""
    document = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    rows = {}
    for entry in document["benchmarks"]:
        if entry.get("run_type") == "aggregate":
            continue
        row = rows.setdefault(entry["name"], Row(entry["name"]))
        if entry.get("error_occurred"):
            row.error = entry.get("error_message", "")
            continue
        row.times_ns.append(entry["real_time"] * NS_PER_UNIT[entry["time_unit"]])
        if "processor_ns" in entry:
            row.processor_ns.append(entry["processor_ns"])
        row.counters = {key: entry[key] for key in COUNTERS if key in entry}
    return document["context"], rows


def merge(documents):
    """One document from those of several processes, with only what the tables need."""
    kept = ("name", "run_type", "real_time", "time_unit", "error_occurred", "error_message")
    context = {key: value for key, value in documents[0]["context"].items()
               if key not in ("executable", "host_name", "load_avg")}
    context["processes"] = str(len(documents))
    benchmarks = []
    for document in documents:
        for entry in document["benchmarks"]:
            if entry.get("run_type") == "aggregate":
                continue
            small = {key: entry[key] for key in kept + COUNTERS if key in entry}
            if "real_time" in small:
                small["real_time"] = float(f"{small['real_time']:.5g}")
            benchmarks.append(small)
    return {"context": context, "benchmarks": benchmarks}


def write_document(document, path):
    """JSON with one benchmark a line, so that a change shows as changed lines."""
    lines = ",\n".join("  " + json.dumps(entry) for entry in document["benchmarks"])
    context = json.dumps(document["context"], indent=1)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'{{"context": {context},\n"benchmarks": [\n{lines}\n]}}\n', encoding="utf-8")


def measure(program, options, processes):
    documents = []
    for number in range(processes):
        print(f"process {number + 1} of {processes}", file=sys.stderr)
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "out.json"
            command = [program, f"--benchmark_out={out}", "--benchmark_out_format=json", *options]
            status = subprocess.run(command, check=False, stdout=sys.stderr).returncode
            if status not in (0, 1):
                raise SystemExit(f"{program} ended with status {status}")
            documents.append(json.loads(out.read_text(encoding="utf-8")))
    return merge(documents)


def number(value):
    """Three significant digits, without an exponent."""
    if value == 0:
        return "0"
    digits = 2
    while digits > 0 and abs(value) >= 10 ** (3 - digits):
        digits -= 1
    if abs(value) < 0.1:
        return f"{value:.3g}"
    return f"{value:.{digits}f}"


def markdown(header, body):
    """A table; every column but the first is right-aligned."""
    lines = ["| " + " | ".join(header) + " |",
             "|---|" + "---:|" * (len(header) - 1)]
    lines += ["| " + " | ".join(cells) + " |" for cells in body]
    return "\n".join(lines)


def bandwidth(rows, kernel, threads):
    """Best GB/s of a kernel with plain or streaming stores, or None."""
    rates = [row.gb_per_s for row in rows.values()
             if row.operation == "bandwidth" and row.threads == threads and row.times_ns
             and row.dataset in (kernel, kernel + "-streaming")]
    return max(rates, default=None)


def machine_table(context, rows):
    caches = ", ".join(
        f"L{cache['level']} {cache['type']} {cache['size'] // 1024} KiB x{context['num_cpus'] // max(1, cache['num_sharing'])}"
        for cache in context.get("caches", []))
    library = context.get("benchmark_library", "Google Benchmark")
    if context.get("library_build_type") == "debug":
        library += ", which reports itself as a debug build (only the loop around a measurement is its)"
    names = (("processor", "cpu"), ("processors", "processors"), ("memory, GiB", "memory_gib"),
             ("system", "system"), ("transparent huge pages", "transparent_huge_pages"),
             ("governor", "governor"), ("compiler", "compiler"), ("flags", "flags"),
             ("index bits", "index_bits"), ("peers", "peers"), ("date", "date"),
             ("processes", "processes"))
    body = [[title, str(context[key])] for title, key in names if key in context]
    body.insert(3, ["caches", caches])
    body.append(["benchmark library", library])
    shared = shared_time(rows)
    if shared is not None:
        body.append(["time taken by other programs", f"{100 * max(0.0, shared):.0f} % of the serial rows'"])
    lines = ["| | |", "|---|---|"] + ["| " + " | ".join(cells) + " |" for cells in body]
    return "\n".join(lines)


def shared_time(rows):
    """Share of the time of the serial measurements in which this process did not run."""
    serial = [row for row in rows.values() if row.threads == 1 and row.processor_ns]
    passed = sum(sum(row.times_ns) for row in serial)
    return 1 - sum(sum(row.processor_ns) for row in serial) / passed if passed else None


def bandwidth_table(context, rows):
    measured = [row for row in rows.values() if row.operation == "bandwidth" and row.times_ns]
    threads = sorted({row.threads for row in measured})
    body = []
    for kernel in dict.fromkeys(row.dataset for row in measured):
        of_kernel = {row.threads: row for row in measured if row.dataset == kernel}
        size = next(iter(of_kernel.values())).size
        body.append([kernel, size] + [number(of_kernel[t].gb_per_s) if t in of_kernel else ""
                                      for t in threads])
    header = ["kernel", "three arrays"] + [f"GB/s, {t} thread{'s' if t > 1 else ''}" for t in threads]
    return markdown(header, body)


def targets_table(context, rows):
    body = []
    for title, ours, theirs, factor in TARGETS:
        mine = rows.get(ours)
        others = [rows[name] for name in theirs if name in rows and rows[name].times_ns]
        if mine is None or not mine.times_ns or not others:
            body.append([title, ours, "", "", f"{factor} x", "not measured"])
            continue
        best = min(others, key=lambda row: row.ns)
        reached = best.ns / mine.ns
        mark = "" if reached >= factor else " (missed)"
        body.append([title, f"{ours}: {number(mine.ns / 1e6)} ms",
                     f"{best.name}: {number(best.ns / 1e6)} ms", "", f"{factor} x",
                     f"{number(reached)} x{mark}"])
    for row in rows.values():
        if row.name != TARGETS[0][1] or not row.times_ns:
            continue
        bytes_per_triangle = row.counters["mesh_bytes"] / row.counters["faces"]
        mark = "" if bytes_per_triangle <= TARGET_BYTES_PER_TRIANGLE else " (missed)"
        body.append(["connectivity, bytes a triangle", row.dataset + "/" + row.size, "", "",
                     f"at most {TARGET_BYTES_PER_TRIANGLE}",
                     f"{bytes_per_triangle:.2f}{mark}"])
    body = [[*cells[:3], *cells[4:]] for cells in body]
    return markdown(["what", "ours, 2 threads", "fastest of theirs", "must", "reached"], body)


def competitor(rows, row, name):
    operation = COMPETES_WITH.get(row.operation, row.operation)
    found = rows.get(f"{operation}/{row.dataset}/{row.size}/1/{name}")
    return found if found is not None and found.times_ns else None


def cells_of(rows, row, names):
    """One line: time, rates, and how many times faster than each competitor."""
    title = "/".join(part for part in (row.operation, row.dataset, row.size, row.variant) if part)
    if not row.times_ns:
        return [title, str(row.threads), f"not measured: {row.error}"] + [""] * (6 + len(names))
    kernel = BANDWIDTH_KERNEL.get(row.operation, "triad")
    limit = bandwidth(rows, kernel, row.threads)
    share = f"{100 * row.gb_per_s / limit:.0f} %" if limit else ""
    cells = [title, str(row.threads), number(row.ns / 1e6), f"{100 * row.spread:.0f} %",
             number(row.counters["halfedges"] / row.ns * 1e3),
             number(row.ns / row.counters["halfedges"]),
             number(row.ns / row.counters["vertices"]), number(row.gb_per_s), share]
    for name in names:
        other = competitor(rows, row, name)
        is_ours = row.variant not in BASELINES + PEERS
        cells.append(number(other.ns / row.ns) if other is not None and is_ours else "")
    return cells


def operations_table(operations):
    def table(context, rows):
        chosen = [row for operation in operations for row in rows.values()
                  if row.operation == operation]
        names = [name for name in BASELINES + PEERS
                 if any(competitor(rows, row, name) is not None for row in chosen)]
        header = ["benchmark", "threads", "ms", "spread", "M half-edges/s", "ns/half-edge",
                  "ns/vertex", "GB/s", "of bandwidth"] + [f"x {name}" for name in names]
        return markdown(header, [cells_of(rows, row, names) for row in chosen])
    return table


def all_tables():
    tables = {"machine": machine_table, "bandwidth": bandwidth_table, "targets": targets_table}
    tables.update({name: operations_table(operations) for name, operations in TABLES.items()})
    return tables


def rewrite(text, context, rows):
    """The text with every table between its markers made anew."""
    for name, make in all_tables().items():
        begin, end = f"<!-- table:{name} begin -->\n", f"<!-- table:{name} end -->"
        if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
            raise SystemExit(f"the markers of table {name} must stand there once, in order")
        head, rest = text.split(begin)
        tail = rest.split(end)[1]
        text = f"{head}{begin}{make(context, rows)}\n{end}{tail}"
    return text


def target_filter():
    names = [name for _, ours, theirs, _ in TARGETS for name in (ours, *theirs)]
    return "^(" + "|".join(dict.fromkeys(names)) + ")/manual_time$"


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--measure", metavar="PROGRAM")
    parser.add_argument("--targets", metavar="PROGRAM")
    parser.add_argument("--mesh", help="also measure on this mesh")
    parser.add_argument("--processes", type=int, default=3)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS)
    parser.add_argument("--perf", type=pathlib.Path, default=PERF)
    options = parser.parse_args(arguments)

    if options.targets:
        document = measure(options.targets, ["--benchmark_min_time=0.2",
                                             f"--benchmark_filter={target_filter()}"],
                           options.processes)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "results.json"
            write_document(document, path)
            print(targets_table(*read_results(path)))
        return 0
    if options.measure:
        extra = ["--benchmark_min_time=0.2"] + (["--mesh", options.mesh] if options.mesh else [])
        write_document(measure(options.measure, extra, options.processes), options.results)

    text = options.perf.read_text(encoding="utf-8")
    made = rewrite(text, *read_results(options.results))
    if options.check:
        if made != text:
            print(f"{options.perf}: the tables are not those of {options.results}; "
                  "run bench/perf_table.py", file=sys.stderr)
        return 0 if made == text else 1
    options.perf.write_text(made, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
