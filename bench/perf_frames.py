"""The tables of PERF.md about the ray tracer's frames, from what hedgerow_frames recorded."""

import json
import pathlib

from perf_format import markdown, number
from perf_results import FOLDER
from perf_targets import Target

FRAMES = FOLDER / "results" / "frames.json"

# Recorded one by one, as each takes minutes: the options of hedgerow_frames.
STILL = ("--stages", "S0,S2,S3,S4,S5")
SOME, ALL = ("--stages", "S6", "--moved", "1"), ("--stages", "S6", "--moved", "100")
PARALLEL, DOUBLE = ("--loops", "parallel"), ("--loops", "double")
SMALL, LONG = ("--size", "200000"), ("--frames", "10000")
PARTS = {
    "terrain": STILL,
    "terrain-1": (*SOME, *PARALLEL, "--frames", "2000"),
    "terrain-1-double": (*SOME, *DOUBLE, "--frames", "2000"),
    "terrain-100": (*ALL, *PARALLEL, "--frames", "300"),
    "small-1": (*SMALL, *SOME, *PARALLEL, *LONG),
    "small-1-double": (*SMALL, *SOME, *DOUBLE, *LONG),
    "small-100": (*SMALL, *ALL, *PARALLEL, *LONG),
    "small-100-double": (*SMALL, *ALL, *DOUBLE, *LONG),
}
# The same of a mesh file.
MESH_PARTS = {
    "dragon": ("--stages", "S3,S5"),
    "dragon-1": (*SOME, *PARALLEL, "--frames", "2000"),
    "dragon-100": (*ALL, *PARALLEL, "--frames", "500"),
}
MESHES = {"terrain": "terrain, 2M triangles", "small": "terrain, 200k triangles",
          "dragon": "dragon, 871k triangles"}

HIT = "normal and one-ring, coherent"
MAIN_LOOP = "100% moved, in turn, 2 threads"
SOME_LOOP, WHOLE_LOOP = "1% moved, in turn, 2 threads", "1% moved, all updated, in turn, 2 threads"
PARTS_OF_A_FRAME = ("deform", "normals", "refit", "rays", "hits")
TIMES = ("p50", "p95", "p99", "p99.9", "max")


class Frames:
    """The rows of all parts; `get(part, what, variant)` is a value, or None."""

    def __init__(self, document):
        self.context = document["context"]
        self.rows = document["rows"]
        self.values = {(row["part"], row["what"], row["variant"]): row["value"]
                       for row in self.rows}

    def get(self, part, what, variant):
        return self.values.get((part, what, variant))

    def of(self, part, stage):
        return [row for row in self.rows if (row["part"], row["stage"]) == (part, stage)]


def read_frames(path=FRAMES):
    """What was recorded, or nothing at all."""
    if not pathlib.Path(path).exists():
        return Frames({"context": {}, "rows": []})
    return Frames(json.loads(pathlib.Path(path).read_text(encoding="utf-8")))


def with_part(frames, part, recorded):
    """The document with the rows of one part replaced."""
    if recorded["failed"]:
        raise SystemExit(f"wrong answers are not recorded: {recorded['failed']}")
    rows = {name: [row for row in frames.rows if row["part"] == name]
            for name in (*PARTS, *MESH_PARTS)}
    rows[part] = [{"part": part, **row} for row in recorded["rows"]]
    context = {**recorded["context"]}
    context.pop("mesh", None)
    return {"context": context, "rows": [row for name in rows for row in rows[name]]}


def ratio(over, under):
    """One value, or a sum of values, by another."""
    def value(frames, _counts):
        top, bottom = ([frames.get(*key) for key in keys] for keys in (over, under))
        return None if None in top + bottom else sum(top) / sum(bottom)
    return value


def single(*key):
    return lambda frames, _counts: frames.get(*key)


def blob_share(frames, _counts):
    """Per cent of a full pass by the same method, after the five microseconds that are allowed."""
    some = frames.get("terrain", "1% moved, area", "1 thread")
    full = frames.get("terrain", "gather, area", "1 thread")
    return None if None in (some, full) else 100 * max(0.0, some - 0.005) / full


def copied(frames, _counts):
    found = [row["value"] for row in frames.rows if row["what"] == "copied to attach"]
    return max(found, default=None)


def most_allocations(frames, _counts):
    return max((row["value"] for row in frames.rows if row["variant"] == "allocations"),
               default=None)


def share_of_refit(frames, _counts):
    parts = [frames.get("terrain-100", MAIN_LOOP, part) for part in ("normals", "refit")]
    return None if None in parts else 100 * parts[1] / sum(parts)


def full_frame(part):
    """OpenMesh's normals and a tree built anew, by ours and a refit."""
    return ratio([(part, "100% moved, normals", "openmesh"),
                  (part, "100% moved, tree built anew", "openmesh")],
                 [(part, MAIN_LOOP, "normals"), (part, MAIN_LOOP, "refit")])


def normals_of_some(part):
    return ratio([(part, WHOLE_LOOP, "normals")], [(part, SOME_LOOP, "normals")])


def hash_map(part):
    return ratio([(part, HIT, "edge hash map")], [(part, HIT, "hedgerow")])


def frame_targets():
    lines = [Target("copied to attach a mesh of triangles", copied, 0, 0, "bytes", is_least=False),
             Target("allocations a frame after frame 2, but for Embree's own", most_allocations, 0, 0,
                    "", is_least=False),
             Target("terrain: share of the refit in normals and refit, all moved", share_of_refit,
                    None, 90, "%"),
             Target("terrain: normals after 1 % moved, 1 thread, of a full walk, less 5 us",
                    blob_share, 2.5, None, "%", is_least=False)]
    for name in ("terrain", "dragon"):
        lines += [
            Target(f"{name}: normals and refit, all moved, times faster than OpenMesh's normals and "
                   "a rebuild", full_frame(f"{name}-100"), 3, None),
            Target(f"{name}: normals in a frame, 1 % moved, times faster than of everything",
                   normals_of_some(f"{name}-1"), 10, None),
            Target(f"{name}: normal and one-ring at a hit, coherent", single(name, HIT, "hedgerow"),
                   60, 25, "ns", is_least=False),
            Target(f"{name}: the same, times faster than by a hash map", hash_map(name), 8, 20),
        ]
    return tuple(lines)


def loops_table(frames, _counts):
    """Times of the frames of each loop, in milliseconds."""
    body = []
    for part, what in loops_of(frames):
        count = next(row["note"].split()[0] for row in frames.of(part, "S6")
                     if (row["what"], row["variant"]) == (what, "p50"))
        body.append([MESHES[part.split("-")[0]], what, count,
                     *(number(frames.get(part, what, name)) for name in TIMES)])
    return markdown(["mesh", "frames", "count", *(f"{name}, ms" for name in TIMES)], body, left=2)


def stages_table(frames, _counts):
    """What a frame of each loop consists of."""
    body = []
    for part, what in loops_of(frames):
        times = [frames.get(part, what, name) for name in PARTS_OF_A_FRAME]
        cells = [f"{number(ms)} ({100 * ms / sum(times):.0f} %)" for ms in times]
        note = next(row["note"] for row in frames.of(part, "S6")
                    if (row["what"], row["variant"]) == (what, "allocations"))
        body.append([MESHES[part.split("-")[0]], what, *cells,
                     number(frames.get(part, what, "allocations")), note.split()[1]])
    return markdown(["mesh", "frames", *(f"{name}, ms" for name in PARTS_OF_A_FRAME),
                     "allocations a frame", "by Embree in all"], body, left=2)


def loops_of(frames):
    """(part, loop) of every loop, as recorded."""
    return list(dict.fromkeys((row["part"], row["what"]) for row in frames.rows
                              if row["variant"] == "p50"))


def beside_table(part, stage, unit):
    """Questions as lines, and a column for each who answered; the least in bold."""
    def table(frames, _counts):
        rows = [row for row in frames.of(part, stage) if row["unit"] == unit]
        who = list(dict.fromkeys(row["variant"] for row in rows))
        body = []
        for what in dict.fromkeys(row["what"] for row in rows):
            values = [frames.get(part, what, name) for name in who]
            known = [value for value in values if value is not None]
            body.append([what, *("" if value is None else
                                 f"**{number(value)}**" if value == min(known) and len(known) > 1
                                 else number(value) for value in values)])
        return markdown([unit, *who], body)
    return table


def list_table(stage, part="terrain"):
    """The rows of a stage as they are."""
    def table(frames, _counts):
        body = [[row["what"], row["variant"], number(row["value"]), row["unit"], row["note"]]
                for row in frames.of(part, stage)]
        return markdown(["what", "", "", "unit", "remark"], body, left=2)
    return table


def frame_tables():
    return {"frames-loops": loops_table, "frames-stages": stages_table,
            "frames-hits-terrain": beside_table("terrain", "S5", "ns/hit"),
            "frames-hits-dragon": beside_table("dragon", "S5", "ns/hit"),
            "frames-import": list_table("S0"), "frames-normals": list_table("S2"),
            "frames-trees": list_table("S3"), "frames-rays": list_table("S4")}
