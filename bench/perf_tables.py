"""The tables of PERF.md, each a function of the results and the counts."""

import statistics

from perf_format import markdown, number, optional, percent
from perf_results import BASELINES, PATHS, PEERS, size_of
from perf_targets import TARGETS, FOUNDATION, evaluate

# What an operation is counted by, and the tables that show it.
ELEMENTS = {"face_normals": "faces", "vertex_normals_facelist": "vertices",
            "vertex_normals_halfedge": "vertices"}
OPERATIONS = {
    "build": ("build",),
    "face-normals": ("face_normals",),
    "vertex-normals": ("vertex_normals_facelist", "vertex_normals_halfedge"),
    "queries": ("one_ring", "circulator", "boundary_loops", "components", "build_radial"),
    "whole-mesh": ("close_boundary", "open_boundary", "validate", "reorder_hilbert",
                   "reorder_morton", "reorder_breadth_first", "reorder_fronts"),
    "memory": ("fill_column",),
}
# In the table of sizes, and in the one of code paths.
SWEPT = ("build", "face_normals", "vertex_normals_facelist", "vertex_normals_halfedge", "one_ring")
SINGULAR = {"halfedges": "half-edge", "faces": "face", "vertices": "vertex"}
SMALLEST_SHOWN = 500_000  # triangles; smaller ones stand in the table of sizes
GIB = 1 << 30


def element_of(row):
    return ELEMENTS.get(row.operation, "halfedges")


def machine_table(results, _counts):
    context = results.context
    caches = ", ".join(f"L{cache['level']} {cache['type'].lower()} {cache['bytes'] // 1024} KiB"
                       for cache in context["caches"])
    names = (("processor", "cpu"), ("processors", "processors"), ("memory, GiB", "memory_gib"),
             ("system", "system"), ("transparent huge pages", "transparent_huge_pages"),
             ("governor", "governor"), ("compiler", "compiler"), ("flags", "flags"),
             ("index bits", "index_bits"), ("peers", "peers"), ("date", "date"), ("rounds", "rounds"))
    body = [[title, str(context[key])] for title, key in names if key in context]
    body.insert(3, ["caches", caches])
    if "again" in context:
        body.append(["some groups measured again", ", ".join(context["again"])])
    taken = taken_by_others(results)
    if taken is not None:
        body.append(["time taken by other programs", f"{percent(max(0.0, taken))} of the serial rows'"])
    return markdown(["", ""], body, left=2)


def taken_by_others(results):
    """Share of the time of the serial measurements in which this process did not run."""
    serial = [row for row in results.timed(threads=1) if "processor_ns" in row.entry]
    passed = sum(statistics.median(row.times_ns) for row in serial)
    return 1 - sum(row["processor_ns"] for row in serial) / passed if passed else None


def bandwidth_table(results, _counts):
    rows = [row for row in results if row.operation == "bandwidth"]
    threads = sorted({row.threads for row in rows})
    body = []
    for mix in dict.fromkeys(row.dataset for row in rows):
        for kernel in next(row for row in rows if row.dataset == mix)["gb_per_s"]:
            rates = [results.bandwidth(mix, count).get(kernel) for count in threads]
            body.append([kernel, next(row.size for row in rows if row.dataset == mix),
                         *map(optional, rates)])
    header = ["kernel", "three arrays"]
    header += [f"GB/s, {count} thread{'s' if count > 1 else ''}" for count in threads]
    return markdown(header, body)


def targets_table(targets):
    def table(results, counts):
        body = [[target.title, target.bound(target.must), target.bound(target.moonshot),
                 "" if value is None else number(value) + target.suffix(), verdict]
                for target, value, verdict in evaluate(targets, results, counts)]
        return markdown(["what", "must", "moonshot", "reached", ""], body)
    return table


def line_of(results, row, names):
    """Time, rates, and how many times faster than each competitor."""
    if not row.times_ns:
        return [row.label, str(row.threads), f"not measured: {row.error}"] + [""] * (5 + len(names))
    count = row[element_of(row)]
    cells = [row.label, str(row.threads), number(row.ns / 1e6), percent(row.spread),
             number(row.ns / count), number(row.bytes / count), number(row.gb_per_s),
             percent(results.share(row))]
    for name in names:
        other = results.competitor(row, name) if row.is_ours else None
        cells.append(number(other.ns / row.ns) if other else "")
    return cells


def operations_table(operations):
    def table(results, _counts):
        rows = [row for row in results if row.operation in operations
                and row.variant not in PATHS
                and (size_of(row) >= SMALLEST_SHOWN or not row.times_ns)]
        rows.sort(key=lambda row: operations.index(row.operation))
        names = [name for name in BASELINES + PEERS
                 if any(results.competitor(row, name) for row in rows)]
        element = SINGULAR[ELEMENTS.get(operations[0], "halfedges")]
        header = ["benchmark", "threads", "ms", "spread", f"ns/{element}", f"B/{element}", "GB/s",
                  "of limit"] + [f"x {name}" for name in names]
        return markdown(header, [line_of(results, row, names) for row in rows])
    return table


def sizes_table(results, _counts):
    """ns an element, one and all threads, of every order and size."""
    threads = results.thread_counts()
    chosen = [min(threads), max(threads)] if threads else []
    rows = [row for row in results.timed() if row.operation in SWEPT and not row.variant
            and row.dataset in ("grid", "scan", "shuffled")]
    keys = sorted({(row.dataset, size_of(row), row.size) for row in rows})
    body = []
    for dataset, _, size in keys:
        cells = [f"{dataset}/{size}"]
        for operation in SWEPT:
            found = [results.get(f"{operation}/{dataset}/{size}/{count}") for count in chosen]
            cells.append(" / ".join(number(row.ns / row[element_of(row)]) if row else "-"
                                    for row in found))
        body.append(cells)
    header = ["mesh"] + [f"{operation}, ns/{SINGULAR[ELEMENTS.get(operation, 'halfedges')]}"
                         for operation in SWEPT]
    return markdown(header, body)


def views_table(results, _counts):
    """The implicit columns and the stored ones, on the same triangles."""
    body = []
    for stored in results.timed(variant="stored"):
        implicit = results.get(f"{stored.operation}/{stored.dataset}/{stored.size}/{stored.threads}")
        if not implicit:
            continue
        body.append([f"{stored.operation}/{stored.dataset}/{stored.size}", str(stored.threads),
                     number(implicit.ns / 1e6), number(stored.ns / 1e6),
                     number(stored.ns / implicit.ns)])
    return markdown(["operation", "threads", "implicit, ms", "stored, ms", "stored/implicit"], body)


def strategy_table(results, _counts):
    """What the builder chose, and what the other strategy would have taken."""
    body = []
    for row in results.timed("strategy", variant=""):
        window, partition = (results.get(f"{row.name}/{name}") for name in ("window", "partition"))
        if not window or not partition:
            continue
        chosen, other = (window, partition) if row["is_window"] else (partition, window)
        body.append([f"{row.dataset}/{row.size}", number(window["scans_per_face"]),
                     number(window.ns / row["faces"]), number(partition.ns / row["faces"]),
                     chosen.variant, number(other.ns / chosen.ns)])
    return markdown(["mesh", "scans a face", "window, ns/face", "partition, ns/face", "chosen",
                     "the other takes, times"], body)


def paths_table(results, _counts):
    """The narrower paths beside the widest."""
    body = []
    for portable in results.timed(variant="portable"):
        wide = results.get(portable.name.removesuffix("/portable"))
        avx2 = results.get(portable.name.replace("portable", "avx2"))
        if wide and avx2 and portable.operation in SWEPT:
            body.append([f"{portable.operation}/{portable.dataset}/{portable.size}",
                         str(portable.threads), number(wide.ns / 1e6), number(avx2.ns / 1e6),
                         number(portable.ns / 1e6), number(avx2.ns / wide.ns),
                         number(portable.ns / avx2.ns)])
    return markdown(["operation", "threads", "widest, ms", "AVX2, ms", "portable, ms",
                     "AVX2/widest", "portable/AVX2"], body)


def counts_table(_results, counts):
    """Instructions and bytes as counted, for each path on each order."""
    body = []
    for row in counts["rows"]:
        count = row["elements"]
        moved = 64 * row["last_level_misses"]
        operation = "/".join(part for part in (row["operation"], row["variant"]) if part)
        body.append([operation, f"{row['dataset']}/{row['size']}", row["path"], row["element"],
                     number(row["instructions"] / count), number(moved / count),
                     number(row["compulsory_bytes"] / count),
                     number(moved / row["compulsory_bytes"])])
    return markdown(["operation", "mesh", "path", "element", "instructions/element", "bytes/element",
                     "had to move", "ratio"], body, left=4)


def headline_table(results, _counts):
    """The operations beside the fastest peer, for the front page."""
    titles = (("build, ordered grid", "build", "grid"), ("build, shuffled grid", "build", "shuffled"),
              ("face normals", "face_normals", "grid"),
              ("vertex normals, linear face list", "vertex_normals_facelist", "grid"),
              ("vertex normals, half-edge gather", "vertex_normals_halfedge", "grid"))
    body = []
    for title, operation, dataset in titles:
        ours = results.get(f"{operation}/{dataset}/4M/{max(results.thread_counts(), default=1)}")
        others = [results.competitor(ours, peer) for peer in PEERS] if ours else []
        fastest = min((row for row in others if row), key=lambda row: row.ns, default=None)
        if fastest:
            body.append([title, f"{number(ours.ns / 1e6)} ms",
                         f"{number(fastest.ns / 1e6)} ms ({fastest.variant})",
                         f"{number(fastest.ns / ours.ns)} x"])
    return markdown(["", "Hedgerow", "fastest other", "ratio"], body)


def readme_tables():
    return {"headline": headline_table}


def all_tables():
    tables = {"machine": machine_table, "bandwidth": bandwidth_table,
              "foundation": targets_table(FOUNDATION), "targets": targets_table(TARGETS),
              "sizes": sizes_table, "views": views_table, "strategy": strategy_table,
              "paths": paths_table, "counts": counts_table}
    tables.update({name: operations_table(operations) for name, operations in OPERATIONS.items()})
    return tables


def rewrite(text, results, counts, tables=None):
    """The text with every table (`all_tables()` if not told) between its markers made anew."""
    for name, make in (tables or all_tables()).items():
        begin, end = f"<!-- table:{name} begin -->\n", f"<!-- table:{name} end -->"
        if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
            raise SystemExit(f"the markers of table {name} must stand there once, in order")
        head, rest = text.split(begin)
        tail = rest.split(end)[1]
        text = f"{head}{begin}{make(results, counts)}\n{end}{tail}"
    return text
