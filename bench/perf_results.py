"""The stored results: what hedgerow_bench measured and what count.py counted."""

import json
import pathlib
import statistics

FOLDER = pathlib.Path(__file__).resolve().parent
RESULTS = FOLDER / "results" / "results.json"
COUNTS = FOLDER / "results" / "counts.json"

BASELINES = ("pointer", "struct")
PEERS = ("openmesh", "cgal", "meshoptimizer")
COMPETITORS = BASELINES + PEERS
# Where an operation's competitors are found, if not under its own name.
COMPETES_WITH = {"vertex_normals_facelist": "vertex_normals_halfedge"}
SIZE_UNITS = {"k": 1e3, "M": 1e6}


class Row:
    """One benchmark: its name taken apart, its times, and the bandwidth measured between them."""

    def __init__(self, entry):
        self.name = entry["name"]
        parts = self.name.split("/")
        self.operation, self.dataset, self.size = parts[:3]
        self.threads = int(parts[3])
        self.variant = "/".join(parts[4:])
        self.entry = entry
        self.error = entry.get("error")
        self.times_ns = entry.get("times_ns", [])

    def __getitem__(self, key):
        return self.entry[key]

    @property
    def is_ours(self):
        return self.variant not in COMPETITORS

    @property
    def label(self):
        return "/".join(part for part in (self.operation, self.dataset, self.size, self.variant) if part)

    @property
    def ns(self):
        return statistics.median(self.times_ns)

    @property
    def spread(self):
        """Range of the middle half of the times, as a share of the median."""
        if len(self.times_ns) < 2:
            return 0.0
        quarters = statistics.quantiles(self.times_ns, n=4, method="inclusive")
        return (quarters[2] - quarters[0]) / self.ns

    @property
    def bytes(self):
        return self["read"] + self["written"]

    @property
    def gb_per_s(self):
        return self.bytes / self.ns

    @property
    def working_set(self):
        """Bytes of connectivity, positions and one normal a vertex: what repeated work touches."""
        return self["mesh_bytes"] + 24 * self["vertices"]

    def per_halfedge(self, value):
        return value / self["halfedges"]


class Results:
    """Everything that was measured in one run, by name."""

    def __init__(self, document):
        self.context = document["context"]
        self.rows = {entry["name"]: Row(entry) for entry in document["rows"]}

    def __iter__(self):
        return iter(self.rows.values())

    def get(self, name):
        """The row if it has times, else None."""
        row = self.rows.get(name)
        return row if row is not None and row.times_ns else None

    def timed(self, operation=None, **fields):
        return [row for row in self if row.times_ns and operation in (None, row.operation)
                and all(getattr(row, key) == value for key, value in fields.items())]

    def competitor(self, row, name):
        operation = COMPETES_WITH.get(row.operation, row.operation)
        return self.get(f"{operation}/{row.dataset}/{row.size}/1/{name}")

    def limit_gb_per_s(self, row):
        """Rate of the best kernel with the row's mix on as many bytes, with no more threads."""
        same = [other for other in self.timed(row.operation, dataset=row.dataset, size=row.size,
                                              variant=row.variant) if other.threads <= row.threads]
        return max((rate for other in same for rate in other["gb_per_s"].values()), default=None)

    def share(self, row):
        limit = self.limit_gb_per_s(row)
        return row.gb_per_s / limit if limit else None

    def bandwidth(self, mix, threads):
        """GB/s of the kernels of a mix on arrays that no cache holds, by name; best last."""
        for row in self:
            if row.operation == "bandwidth" and (row.dataset, row.threads) == (mix, threads):
                return dict(sorted(row["gb_per_s"].items(), key=lambda item: item[1]))
        return {}

    def caches(self):
        """(level, bytes) of the caches that hold data, ascending."""
        return sorted((cache["level"], cache["bytes"]) for cache in self.context["caches"]
                      if cache["type"] != "Instruction")

    def thread_counts(self):
        return sorted({row.threads for row in self})


def size_of(row):
    """Triangles, as the name of the dataset rounds them."""
    unit = SIZE_UNITS.get(row.size[-1])
    return float(row.size[:-1]) * unit if unit else float(row.size)


def read_results(path=RESULTS):
    return Results(json.loads(pathlib.Path(path).read_text(encoding="utf-8")))


def read_counts(path=COUNTS):
    """The counted numbers, or none at all."""
    path = pathlib.Path(path)
    if not path.exists():
        return {"context": {}, "rows": []}
    return json.loads(path.read_text(encoding="utf-8"))


def write_document(document, path):
    """JSON with a row a line, so that a change shows as changed lines."""
    lines = ",\n".join(json.dumps(row) for row in document["rows"])
    context = json.dumps(document["context"], indent=1)
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'{{"context": {context},\n"rows": [\n{lines}\n]}}\n', encoding="utf-8")


def replace(stored, newer):
    """The stored document with those rows in the place of their namesakes that were measured anew."""
    rows = {entry["name"]: entry for entry in newer["rows"]
            if not entry["name"].startswith("bandwidth/")}
    kept = [rows.pop(entry["name"], entry) for entry in stored["rows"]]
    again = [*stored["context"].get("again", []), newer["context"]["date"]]
    return {"context": {**stored["context"], "again": again}, "rows": kept + list(rows.values())}


# What `HEDGEROW_SIMD` can ask for, besides the widest path of the processor, which runs without it.
PATHS = ("portable", "avx2")


def merge(main, by_path):
    """One document: the run, and the rows of the runs on narrower paths as variants."""
    rows = list(main["rows"])
    for path, narrower in by_path.items():
        rows += [{**entry, "name": f"{entry['name']}/{path}"} for entry in narrower["rows"]
                 if not entry["name"].startswith("bandwidth/")]
    return {"context": main["context"], "rows": rows}
