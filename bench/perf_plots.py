#!/usr/bin/env python3
"""Draws the pictures of PERF.md from the stored results, as SVG.

  perf_plots.py            writes bench/results/*.svg (needs matplotlib)
  perf_plots.py --check    exit status 1 if a picture is not that of the stored results, 77 if
                           matplotlib is missing or of another version than the pictures were made by
"""

import argparse
import io
import pathlib
import re
import sys

from perf_imr import IMR, PREFIX, datasets
from perf_imr import ROWS as SIX_TESTS
from perf_results import FOLDER, read_counts, read_results
from perf_tables import ELEMENTS, SINGULAR, SWEPT

PICTURES = FOLDER / "results"
ORDERS = {"grid": "#1b6ca8", "scan": "#d1730b", "shuffled": "#2e8b57"}
OPERATION_COLOURS = dict(zip(SWEPT + ("components", "boundary_loops"),
                             ("#1b6ca8", "#d1730b", "#2e8b57", "#8a3fa0", "#b3261e", "#6b6b6b",
                              "#b89b00")))
LIBRARY_COLOURS = {"pointer": "#6b6b6b", "struct": "#b89b00", "openmesh": "#1b6ca8", "cgal": "#b3261e"}
MISSING = 77
VERSION = re.compile(r"<!-- matplotlib (\S+) -->")
WINDOW_LIMIT = 45  # scans a face; the builder's own constant


def titled(operation):
    return operation.replace("_", " ")


def grid_of_panels(pyplot, count, columns=3):
    rows = -(-count // columns)
    figure, axes = pyplot.subplots(rows, columns, figsize=(4.2 * columns, 3.3 * rows), squeeze=False)
    panels = list(axes.flat)
    for spare in panels[count:]:
        spare.axis("off")
    return figure, panels[:count], panels[count:]


def mark_caches(axis, results):
    """The caches, as lines; one that is far larger than all that was measured is left out."""
    low, high = axis.get_xlim()
    for level, size in results.caches():
        if low < size < high:
            axis.axvline(size, color="#999999", linewidth=0.8, linestyle=":")
            axis.annotate(f"L{level}", (size, 0.98), xycoords=("data", "axes fraction"), fontsize=8,
                          color="#666666", rotation=90, va="top", ha="right")


def speed_over_size(pyplot, results, _counts):
    from matplotlib import ticker
    figure, panels, spare = grid_of_panels(pyplot, len(SWEPT))
    for axis, operation in zip(panels, SWEPT):
        element = ELEMENTS.get(operation, "halfedges")
        for order, colour in ORDERS.items():
            for threads in results.thread_counts():
                rows = sorted(results.timed(operation, dataset=order, threads=threads, variant=""),
                              key=lambda row: row.working_set)
                axis.plot([row.working_set for row in rows],
                          [row[element] / row.ns * 1e3 for row in rows], color=colour, marker="o",
                          markersize=3, linewidth=1.2, linestyle="--" if threads == 1 else "-",
                          label=f"{order}, {threads} thread{'s' if threads > 1 else ''}")
        axis.set_xscale("log", base=2)
        axis.set_yscale("log")
        axis.set_title(titled(operation), fontsize=10)
        axis.set_xlabel("bytes of mesh, positions and normals")
        axis.set_ylabel(f"million {SINGULAR[element]}s/s".replace("vertexs", "vertices"))
        axis.set_xticks([1 << bits for bits in range(15, 34, 4)])
        axis.xaxis.set_major_formatter(binary_size)
        axis.xaxis.set_minor_locator(ticker.NullLocator())
        mark_caches(axis, results)
    handles, labels = panels[0].get_legend_handles_labels()
    spare[0].legend(handles, labels, loc="center", frameon=False)
    return figure


def binary_size(value, _position):
    for unit in ("B", "KiB", "MiB", "GiB"):
        if value < 1024 or unit == "GiB":
            return f"{value:.0f} {unit}"
        value /= 1024
    return ""


def share_over_threads(pyplot, results, _counts):
    figure, panels, _ = grid_of_panels(pyplot, len(ORDERS))
    for axis, order in zip(panels, ORDERS):
        for operation, colour in OPERATION_COLOURS.items():
            rows = sorted(results.timed(operation, dataset=order, size="4M", variant=""),
                          key=lambda row: row.threads)
            if rows:
                axis.plot([row.threads for row in rows],
                          [100 * (results.share(row) or 0) for row in rows], color=colour,
                          marker="o", label=titled(operation))
        axis.set_title(f"{order}, 4M triangles", fontsize=10)
        axis.set_xticks(results.thread_counts())
        axis.set_xlabel("threads")
        axis.set_ylabel("% of the bandwidth of the same mix")
        axis.set_ylim(0, 105)
    panels[-1].legend(fontsize=8, frameon=False)
    return figure


def roofline(pyplot, results, counts):
    """Instructions a second over instructions a byte that had to move: what was counted, over time."""
    from matplotlib.lines import Line2D
    figure, axis = pyplot.subplots(figsize=(9, 5))
    threads = results.thread_counts()
    styles = dict(zip(threads, ("o", "s", "^", "D")))
    points, legend = [], {}
    for row in counts["rows"]:
        for count in threads:
            name = f"{row['operation']}/{row['dataset']}/{row['size']}/{count}"
            # What was counted is what is timed: a wider path has fewer instructions.
            timed = results.get(name + "/avx2") or results.get(name)
            if row["path"] != "avx2" or row["variant"] or timed is None:
                continue
            intensity = row["instructions"] / row["compulsory_bytes"]
            points.append(intensity)
            colour = OPERATION_COLOURS.get(row["operation"], "#333333")
            axis.plot(intensity, row["instructions"] / timed.ns, styles[count], color=colour,
                      fillstyle="full" if row["dataset"] == "grid" else "none")
            legend[titled(row["operation"])] = Line2D([], [], color=colour, marker="o", linewidth=0)
    for count in threads:
        label = f"{count} thread{'s' if count > 1 else ''}"
        legend[label] = Line2D([], [], color="#555555", marker=styles[count], linewidth=0)
    low, high = min(points, default=0.1) / 2, max(points, default=10) * 2
    for count in threads:
        rates = results.bandwidth("triad", count)
        peak = float(results.context.get("instructions_per_ns", 0)) * count
        if not rates or not peak:
            continue
        rate = max(rates.values())
        edge = peak / rate
        axis.plot([low, min(edge, high), high], [low * rate, min(edge, high) * rate, min(peak, high * rate)],
                  color="#555555", linewidth=1)
        # Along the flat part, where no other roof is near.
        axis.annotate(f"triad and issue, {count} thread{'s' if count > 1 else ''}",
                      (high, min(peak, high * rate)), fontsize=8, color="#555555", ha="right",
                      va="bottom")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("counted instructions a byte that had to move")
    axis.set_ylabel("10^9 instructions/s")
    axis.legend(legend.values(), legend.keys(), fontsize=8, frameon=False, loc="upper left",
                bbox_to_anchor=(1, 1))
    return figure


def strategy(pyplot, results, _counts):
    figure, axis = pyplot.subplots(figsize=(10, 4.5))
    for variant, colour in (("window", "#1b6ca8"), ("partition", "#d1730b")):
        made, real = [], []
        for window in results.timed("strategy", variant="window"):
            timed = results.get(window.name.removesuffix("window") + variant)
            points = made if window.dataset.startswith("moved") else real
            points.append((window["scans_per_face"], timed.ns / timed["faces"]))
        if made:
            axis.plot(*zip(*sorted(made)), color=colour, marker="o", markersize=4,
                      label=f"{variant}: grid of 1M triangles, some of them moved")
        if real:
            axis.plot(*zip(*real), "x", color=colour, label=f"{variant}: scans and models")
    axis.axvline(WINDOW_LIMIT, color="#555555", linewidth=0.8, linestyle=":")
    axis.annotate("window | partition", (WINDOW_LIMIT, 0.97), xycoords=("data", "axes fraction"),
                  fontsize=8, ha="center", va="top", color="#555555")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("scans a face that the window takes")
    axis.set_ylabel("build, ns/face, 1 thread")
    axis.legend(fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def six_tests(pyplot, _results, _counts):
    """How many times as long each library takes, on each mesh, as Hedgerow on one thread."""
    from matplotlib import ticker
    results = read_results(IMR)
    meshes = datasets(results)
    figure, panels, spare = grid_of_panels(pyplot, len(SIX_TESTS))
    for axis, test in zip(panels, SIX_TESTS):
        for place, mesh in enumerate(meshes):
            mine = results.get(f"{PREFIX}{test}/{mesh}/1")
            for offset, (library, colour) in enumerate(LIBRARY_COLOURS.items()):
                other = results.get(f"{PREFIX}{test}/{mesh}/1/{library}")
                if mine and other:
                    axis.plot([other.ns / mine.ns], [place + 0.15 * (offset - 1.5)], "o", markersize=5,
                              color=colour, label=library if place == 0 else None)
        axis.axvline(1, color="#444444", linewidth=1)
        axis.set_xscale("log", base=2)
        axis.set_xlim(0.1, 12)
        axis.xaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        axis.set_yticks(range(len(meshes)), meshes)
        axis.invert_yaxis()
        axis.set_title(test)
        axis.set_xlabel("times as long as Hedgerow")
        axis.grid(True, axis="x", which="both", color="#e4e4e4", linewidth=0.5)
    panels[0].legend(fontsize=7)
    assert not spare
    return figure


DRAWN = {"speed_over_size": speed_over_size, "share_over_threads": share_over_threads,
         "roofline": roofline, "strategy": strategy, "six_tests": six_tests}


def draw(function, results, counts):
    """The picture as text: the same for the same numbers and the same matplotlib."""
    import matplotlib
    matplotlib.use("SVG")
    from matplotlib import pyplot
    pyplot.rcParams.update({"svg.hashsalt": "hedgerow", "svg.fonttype": "none", "font.size": 9,
                            "font.family": "sans-serif", "axes.spines.top": False,
                            "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25})
    figure = function(pyplot, results, counts)
    figure.tight_layout()
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    pyplot.close(figure)
    lines = [line.rstrip() for line in text.getvalue().splitlines()]
    return "\n".join(lines) + f"\n<!-- matplotlib {matplotlib.__version__} -->\n"


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args(arguments)
    try:
        import matplotlib
    except ImportError:
        print("matplotlib is missing (Debian: python3-matplotlib)", file=sys.stderr)
        return MISSING if options.check else 1
    results, counts = read_results(), read_counts()
    status = 0
    for name, function in DRAWN.items():
        path = pathlib.Path(PICTURES) / f"{name}.svg"
        if not options.check:
            path.write_text(draw(function, results, counts), encoding="utf-8")
            continue
        stored = path.read_text(encoding="utf-8") if path.exists() else ""
        made_by = VERSION.search(stored)
        if made_by and made_by.group(1) != matplotlib.__version__:
            print(f"{path}: drawn by matplotlib {made_by.group(1)}, this is {matplotlib.__version__}",
                  file=sys.stderr)
            return MISSING
        if stored != draw(function, results, counts):
            print(f"{path}: not that of the results; run bench/perf_plots.py", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
