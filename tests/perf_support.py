"""Results made by hand, for the tests of what bench/perf_table.py writes."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bench"))

import perf_results  # noqa: E402
import perf_targets  # noqa: E402

NO_COUNTS = {"context": {}, "rows": []}


def entry(name, milliseconds, **more):
    times = milliseconds if isinstance(milliseconds, list) else [milliseconds]
    return {"name": name, "times_ns": [1e6 * time for time in times], "processor_ns": 1e6 * times[0],
            "halfedges": 12_000_000, "vertices": 2_000_000, "faces": 4_000_000,
            "mesh_bytes": 104_000_000, "read": 60_000_000, "written": 40_000_000, "mix": "copy",
            "gb_per_s": {"copy": 10.0, "copy-streaming": 20.0}, **more}


def bandwidth(mix, threads, **rates):
    return {"name": f"bandwidth/{mix}/3MiB/{threads}", "mix": mix, "gb_per_s": rates}


def document(*rows):
    context = {"cpu": "a processor", "caches": [{"type": "Data", "level": 1, "bytes": 32768,
                                                 "sharing": 1}]}
    return {"context": context, "rows": list(rows)}


def results(*rows):
    return perf_results.Results(document(*rows))


def line_of(table, start):
    """The cells, by their heads, of the one line of a table whose first cells are `start`."""
    prefix = "| " + " | ".join(start) + " |"
    lines = [line for line in table.splitlines() if line.startswith(prefix)]
    assert len(lines) == 1, (start, table)
    cells, heads = ([cell.strip() for cell in line.strip("|").split("|")]
                    for line in (lines[0], table.splitlines()[0]))
    return dict(zip(heads, cells))


def verdict_of(targets, title, *rows, counts=None):
    found = [(value, verdict) for target, value, verdict
             in perf_targets.evaluate(targets, results(*rows), counts or NO_COUNTS)
             if target.title.startswith(title)]
    assert len(found) == 1, title
    return found[0]
