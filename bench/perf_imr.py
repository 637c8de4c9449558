"""The tables of the IMR 2011 suite, which is measured by itself."""

import math

from perf_format import markdown, number
from perf_planar import planar_machine_table
from perf_results import FOLDER
from perf_tables import targets_table
from perf_targets import PAIR, SERIAL, Target, name

IMR = FOLDER / "results" / "imr.json"
PREFIX = "imr_"
ROWS = ("circulator", "barycenter", "normals", "smoothing", "subdivision", "collapse")
RIVALS = ("openmesh", "cgal")
# Removing a vertex is another edit than collapsing an edge, with the same result here.
COLUMNS = ("pointer", "struct", "openmesh", "cgal", "cgal-removal")


def datasets(results):
    """Names of the meshes, in the order in which they were measured."""
    return list(dict.fromkeys(f"{row.dataset}/{row.size}" for row in results
                              if row.operation.startswith(PREFIX)))


def times_faster(results, test, data, threads):
    """Time of the fastest rival on one thread, by ours."""
    mine = results.get(name(PREFIX + test, data, threads))
    # What uses one thread on any number of them is measured on one.
    mine = mine or results.get(name(PREFIX + test, data, SERIAL))
    theirs = [results.get(name(PREFIX + test, data, SERIAL, rival)) for rival in RIVALS]
    theirs = [row.ns for row in theirs if row]
    return min(theirs) / mine.ns if mine and theirs else None


def least(test):
    """On the mesh where we gain the least."""
    def value(results, _counts):
        found = [times_faster(results, test, data, SERIAL) for data in datasets(results)]
        return min((ratio for ratio in found if ratio), default=None)
    return value


def geometric_mean(ratios):
    known = [ratio for ratio in ratios if ratio]
    return math.exp(sum(map(math.log, known)) / len(known)) if known else None


def mean_of_tests(threads):
    """Over all tests, of the mean over all meshes."""
    def value(results, _counts):
        means = [geometric_mean(times_faster(results, test, data, threads) for data in datasets(results))
                 for test in ROWS]
        return geometric_mean(means) if all(means) else None
    return value


IMR_TARGETS = (
    *(Target(f"{test}, 1 thread, times faster than OpenMesh and CGAL, on the mesh where it is least",
             least(test), 1, None) for test in ROWS),
    Target("geometric mean of the six, 1 thread", mean_of_tests(SERIAL), None, 3),
    Target("the same, 2 threads", mean_of_tests(PAIR), None, 5),
)


def milliseconds(row):
    return number(row.ns / 1e6) if row else ""


def imr_table(results, _counts):
    """A line for each test and mesh, ours first."""
    body = []
    for test in ROWS:
        for data in datasets(results):
            error = results.rows[name(PREFIX + test, data, SERIAL)].error
            if error:
                body.append([test, data, f"not measured: {error}"])
                continue
            rows = [results.get(name(PREFIX + test, data, threads)) for threads in (SERIAL, PAIR)]
            rows += [results.get(name(PREFIX + test, data, SERIAL, other)) for other in COLUMNS]
            ratio = times_faster(results, test, data, SERIAL)
            body.append([test, data, *map(milliseconds, rows), f"{number(ratio)} x" if ratio else ""])
    return markdown(["test", "mesh", "Hedgerow, ms", "2 threads", *COLUMNS, "faster, 1 thread"], body,
                    left=2)


def other_ways_table(results, _counts):
    """The same tests by other ways through the engine."""
    body = []
    for row in results:
        test = row.operation.removeprefix(PREFIX)
        if test not in ROWS or row.variant in ("", *COLUMNS) or not row.times_ns:
            continue
        usual = results.get(name(row.operation, f"{row.dataset}/{row.size}", row.threads))
        body.append([f"{test}/{row.dataset}/{row.size}/{row.variant}", str(row.threads),
                     milliseconds(row), number(row.ns / usual.ns) if usual else ""])
    return markdown(["benchmark", "threads", "ms", "times the usual way"], body)


def imr_tables():
    return {"imr-targets": targets_table(IMR_TARGETS), "imr": imr_table, "imr-ways": other_ways_table,
            "imr-machine": planar_machine_table}
