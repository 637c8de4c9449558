"""The tables of triangulations, cells, flips, decimation and subdivision, which are measured by themselves."""

from perf_format import markdown, number, percent
from perf_results import FOLDER
from perf_tables import targets_table
from perf_targets import SERIAL, Target, name, share, times_faster

PLANAR = FOLDER / "results" / "planar.json"
PATTERN = "^(triangulate|voronoi|flip|delaunay|decimate|subdivide)/"
MILLION, IN_CACHE = "points/2M", "points/20k"  # by triangles: a million points, ten thousand
# What each operation is counted by.
ELEMENTS = {"triangulate": "points", "voronoi": "points", "flip": "flips",
            "delaunay": "flips", "decimate": "collapses",
            "subdivide": "output_halfedges"}


def rate(element, *row_name):
    """Millions of elements a second."""
    def value(results, _counts):
        row = results.get(name(*row_name))
        return row[element] / row.ns * 1e3 if row else None
    return value


def accepted(*row_name):
    """Percent of the candidates of parallel rounds."""
    def value(results, _counts):
        row = results.get(name(*row_name))
        return row["accepted_percent"] if row else None
    return value


def best_share(variants):
    def value(results, counts):
        found = [share("subdivide", "grid/1M", SERIAL, variant)(results, counts) for variant in variants]
        return max((each for each in found if each), default=None)
    return value


PLANAR_TARGETS = (
    Target("planar Delaunay, 1M uniform points, exact, 1 thread",
           rate("points", "triangulate", MILLION, SERIAL), 1.0, 2.5, "M points/s"),
    Target("the same, times faster than CGAL",
           times_faster(("triangulate", MILLION, SERIAL), ("cgal",)), 1, None),
    Target("flips, in cache, 1 thread", rate("flips", "flip", IN_CACHE, SERIAL), 10, 30, "M flips/s"),
    Target("flips in batches, in cache, 1 thread",
           rate("flips", "flip", IN_CACHE, SERIAL, "batch"), 10, 30, "M flips/s"),
    Target("parallel rounds on a terrain, candidates accepted",
           accepted("delaunay", "terrain/2M", SERIAL), 90, None, "%"),
    Target("one level of Catmull-Clark, grid of 1M triangles, output half-edges, 1 thread",
           rate("output_halfedges", "subdivide", "grid/1M", SERIAL, "catmull-clark"), 100, None, "M/s"),
    Target("one level of Loop", rate("output_halfedges", "subdivide", "grid/1M", SERIAL, "loop"),
           100, None, "M/s"),
    Target("the better of them, of the byte limit", best_share(("catmull-clark", "loop")), None, 60, "%"),
    Target("quadric collapses, in cache, 1 thread",
           rate("collapses", "decimate", "terrain/20k", SERIAL, "queue"), 0.7, 3, "M collapses/s"),
    Target("the same in rounds",
           rate("collapses", "decimate", "terrain/20k", SERIAL, "rounds"), 0.7, 3, "M collapses/s"),
    Target("quadric collapses, 1M faces, 1 thread, in rounds",
           rate("collapses", "decimate", "terrain/1M", SERIAL, "rounds"), 0.7, 3, "M collapses/s"),
    Target("the same, candidates accepted",
           accepted("decimate", "terrain/1M", SERIAL, "rounds"), 90, None, "%"),
)


def planar_table(results, _counts):
    body = []
    for row in results:
        if row.operation not in ELEMENTS:
            continue
        if not row.times_ns:
            body.append([row.label, str(row.threads), f"not measured: {row.error}"])
            continue
        element = ELEMENTS[row.operation]
        body.append([row.label, str(row.threads), number(row.ns / 1e6), percent(row.spread), element,
                     number(row[element] / row.ns * 1e3)])
    return markdown(["benchmark", "threads", "ms", "spread", "of", "M/s"], body)


def planar_machine_table(results, _counts):
    context = results.context
    names = (("processor", "cpu"), ("compiler", "compiler"), ("peers", "peers"), ("date", "date"),
             ("rounds", "rounds"))
    return markdown(["", ""], [[title, str(context[key])] for title, key in names if key in context],
                    left=2)


def planar_tables():
    return {"planar-machine": planar_machine_table, "planar-targets": targets_table(PLANAR_TARGETS),
            "planar": planar_table}
