"""How far each operation has to reach, as numbers, and how far it does."""

# The thread counts that the targets speak of.
SERIAL, PAIR = 1, 2
GRID, SHUFFLED, REORDERED = "grid/4M", "shuffled/4M", "reordered/4M"
MAIN_OPERATIONS = ("build", "face_normals", "vertex_normals_facelist", "vertex_normals_halfedge",
                   "one_ring")
SMALL = tuple(f"{order}/{size}" for order in ("grid", "scan", "shuffled") for size in ("1k", "10k"))
TRIAD_GB_PER_S = 20.0
NOISE = 1.05


class Target:
    """One line: `value` of the results, with `must` and `moonshot` as bounds (None: no such).

    `is_least` says whether the bound is a least or a greatest value. Targets with the same
    `either` are met together as soon as one of them is.
    """

    def __init__(self, title, value, must, moonshot, unit="x", is_least=True, either=None):
        self.title, self.value, self.must, self.moonshot = title, value, must, moonshot
        self.unit, self.is_least, self.either = unit, is_least, either

    def reaches(self, value, bound):
        if value is None or bound is None:
            return False
        return value >= bound if self.is_least else value <= bound

    def bound(self, bound):
        if bound is None:
            return ""
        return f"{'at least' if self.is_least else 'at most'} {bound:g}{self.suffix()}"

    def suffix(self):
        return f" {self.unit}" if self.unit else ""


def name(operation, data, threads, variant=""):
    return f"{operation}/{data}/{threads}" + (f"/{variant}" if variant else "")


def ratio(over, under):
    """Time of `over` by time of `under`, each (operation, data, threads[, variant])."""
    def value(results, _counts):
        top, bottom = results.get(name(*over)), results.get(name(*under))
        return top.ns / bottom.ns if top and bottom else None
    return value


def times_faster(ours, peers=("openmesh", "cgal")):
    """Time of the fastest peer on the same dataset, by ours."""
    def value(results, _counts):
        mine = results.get(name(*ours))
        theirs = [results.competitor(mine, peer) for peer in peers] if mine else []
        theirs = [row.ns for row in theirs if row]
        return min(theirs) / mine.ns if theirs else None
    return value


def share(*row_name):
    """Per cent of the bandwidth of the same mix, bytes and threads."""
    def value(results, _counts):
        row = results.get(name(*row_name))
        of_limit = results.share(row) if row else None
        return 100 * of_limit if of_limit else None
    return value


def times_the_limit(*row_name):
    def value(results, _counts):
        row = results.get(name(*row_name))
        of_limit = results.share(row) if row else None
        return 1 / of_limit if of_limit else None
    return value


def normalised_rate(results, _counts):
    """M half-edges/s of the ordered build, were the triad bandwidth 20 GB/s."""
    row = results.get(name("build", GRID, SERIAL))
    triad = max(results.bandwidth("triad", SERIAL).values(), default=None)
    return row["halfedges"] / row.ns * 1e3 * TRIAD_GB_PER_S / triad if row and triad else None


def worst(ratios):
    def value(results, counts):
        known = [v for v in (each(results, counts) for each in ratios) if v is not None]
        return max(known, default=None)
    return value


def classification_share(_results, counts):
    """Per cent of the instructions of the ordered build that only look for defects."""
    for row in counts["rows"]:
        if (row["operation"], row["dataset"], row["path"]) == ("build", "grid", "avx2"):
            return 100 * row["classification"] / row["instructions"] if "classification" in row else None
    return None


def slowdown_after_reorder(threads):
    return worst([ratio((operation, REORDERED, threads), (operation, GRID, threads))
                  for operation in MAIN_OPERATIONS])


TARGETS = (
    Target("build, ordered, 1 thread, at 20 GB/s of triad", normalised_rate, 100, None,
           "M half-edges/s", either="build"),
    Target("build, ordered, 1 thread, times the limit", times_the_limit("build", GRID, SERIAL),
           4, 2, is_least=False, either="build"),
    Target("build, ordered, 2 threads, times faster than 1", ratio(("build", GRID, SERIAL), ("build", GRID, PAIR)),
           1.6, 1.9, either="scaling"),
    Target("build, ordered, 2 threads, times the limit", times_the_limit("build", GRID, PAIR),
           1.5, None, is_least=False, either="scaling"),
    Target("build, shuffled, 2 threads, times faster than OpenMesh and CGAL",
           times_faster(("build", SHUFFLED, PAIR)), 18, 40),
    Target("build, shuffled, 2 threads, time by that of the ordered one",
           ratio(("build", SHUFFLED, PAIR), ("build", GRID, PAIR)), None, 4, is_least=False),
    Target("classification of defects: the survey of all faces, which also plans the window, by instructions", classification_share,
           5, 0, "%", is_least=False),
    Target("face normals, 2 threads, of bandwidth", share("face_normals", GRID, PAIR), 60, 90, "%"),
    Target("vertex normals, face list, 2 threads, of bandwidth",
           share("vertex_normals_facelist", GRID, PAIR), 40, 80, "%"),
    Target("vertex normals, gather, 1 thread, time by that of the serial face list",
           ratio(("vertex_normals_halfedge", GRID, SERIAL), ("vertex_normals_facelist", GRID, SERIAL)),
           2.5, 1, is_least=False),
    Target("vertex normals, gather, 2 threads, time by that of the serial face list",
           ratio(("vertex_normals_halfedge", GRID, PAIR), ("vertex_normals_facelist", GRID, SERIAL)),
           1.3, None, is_least=False),
    Target("vertex normals, gather, 2 threads, of bandwidth",
           share("vertex_normals_halfedge", GRID, PAIR), None, 75, "%"),
    Target("angle weights, face list, 1 thread, time by that of area weights",
           ratio(("vertex_normals_facelist", GRID, SERIAL, "angle"),
                 ("vertex_normals_facelist", GRID, SERIAL)), 1.6, 1.3, is_least=False),
    Target("angle weights, gather, 1 thread, time by that of area weights",
           ratio(("vertex_normals_halfedge", GRID, SERIAL, "angle"),
                 ("vertex_normals_halfedge", GRID, SERIAL)), 1.6, 1.3, is_least=False),
    Target("one-ring, circulator, ordered, 1 thread, times faster than OpenMesh and CGAL",
           times_faster(("one_ring", GRID, SERIAL)), 1, 3),
    Target("one-ring, all at once, ordered, 1 thread, times faster than OpenMesh and CGAL",
           times_faster(("one_ring", GRID, SERIAL, "pass")), 1.3, 3),
    Target("one-ring, all at once, shuffled, 1 thread, times faster than OpenMesh and CGAL",
           times_faster(("one_ring", SHUFFLED, SERIAL, "pass")), 2, 3),
    Target("one-ring, circulator, ordered, 2 threads, of bandwidth", share("one_ring", GRID, PAIR),
           None, 85, "%"),
    Target("shuffled, then reordered: slowest operation by the ordered grid, 1 thread",
           slowdown_after_reorder(SERIAL), 1.15, None, is_least=False),
    Target("the same, 2 threads", slowdown_after_reorder(PAIR), 1.15, None, is_least=False),
    Target("reordering the shuffled grid, 2 threads, in its passes for vertex normals (face list)",
           ratio(("reorder_fronts", SHUFFLED, PAIR), ("vertex_normals_facelist", SHUFFLED, PAIR)),
           10, 6, is_least=False),
    Target("connected components, 2 threads, of bandwidth", share("components", GRID, PAIR), 50, 80, "%"),
    Target("boundary scan, 1 thread, of bandwidth", share("boundary_loops", GRID, SERIAL), 80, 95, "%"),
    Target("1k and 10k faces, build and normals: worst time with 2 threads by serial time",
           worst([ratio((operation, data, PAIR), (operation, data, SERIAL))
                  for operation in MAIN_OPERATIONS[:4] for data in SMALL]),
           NOISE, None, is_least=False),
    Target("portable path, 1 thread: slowest operation by AVX2",
           worst([ratio((operation, GRID, SERIAL, "portable"), (operation, GRID, SERIAL, "avx2"))
                  for operation in MAIN_OPERATIONS]), 3, None, is_least=False),
)


def bytes_per_triangle(results, _counts):
    row = results.get(name("build", GRID, PAIR))
    return row["mesh_bytes"] / row["faces"] if row else None


# What the engine was first made for: two threads beside the fastest peer, which has one.
FOUNDATION = (
    Target("build, ordered grid, times faster", times_faster(("build", GRID, PAIR)), 8, None),
    Target("build, shuffled grid, times faster", times_faster(("build", SHUFFLED, PAIR)), 10, None),
    Target("face normals, times faster", times_faster(("face_normals", GRID, PAIR), ("openmesh",)), 4, None),
    Target("vertex normals, face list, times faster",
           times_faster(("vertex_normals_facelist", GRID, PAIR), ("openmesh",)), 5, None),
    Target("vertex normals, gather, times faster",
           times_faster(("vertex_normals_halfedge", GRID, PAIR), ("openmesh",)), 3, None),
    Target("connectivity, bytes a triangle", bytes_per_triangle, 27, None, "bytes", is_least=False),
)


def evaluate(targets, results, counts):
    """(target, value, verdict) of each target, in order."""
    values = [target.value(results, counts) for target in targets]
    reached = {target.either for target, value in zip(targets, values)
               if target.either and target.reaches(value, target.must)}
    lines = []
    for target, value in zip(targets, values):
        if value is None:
            verdict = "not measured"
        elif target.reaches(value, target.moonshot):
            verdict = "moonshot"
        elif target.must is None:
            verdict = "open"
        elif target.reaches(value, target.must):
            verdict = "met"
        else:
            verdict = "met by the other" if target.either in reached else "**missed**"
        lines.append((target, value, verdict))
    return lines


def row_filter():
    """A pattern of the names that the targets need."""
    operations = "|".join([*MAIN_OPERATIONS, "reorder_fronts", "components", "boundary_loops"])
    small = "|".join(SMALL)
    return (f"^(({operations})/({GRID}|{SHUFFLED}|{REORDERED})/[12](/(openmesh|cgal|angle|pass))?"
            f"|({'|'.join(MAIN_OPERATIONS[:4])})/({small})/[12])$")
