"""The tables of PERF.md that set the representations side by side, and what follows from them."""

import pathlib

from perf_format import number
from perf_results import FOLDER, Results, read_results

REPRESENTATIONS = FOLDER / "results" / "representations.json"
PREFIX = "represent_"

# Columns, with the header of each.
KINDS = {"flat": "flat", "flat-stored": "flat, stored", "flat-closed": "flat, closed",
         "radial": "flat + radial", "directed-edge": "directed edge", "corner-table": "corner table",
         "adjacency": "adjacency", "dcel": "DCEL", "split-edge": "split edge", "winged-tables": "winged tables",
         "nonmanifold": "non-manifold", "pointer-half": "pointer half-edge",
         "pointer-winged": "pointer winged"}
# Rows: what is asked, and of what.
QUESTIONS = {
    "build": "build, edge",
    "face_vertices": "vertices round, face", "face_edges": "edges round, face",
    "face_faces": "faces across, face", "face_neighbours": "faces across counted, face",
    "face_degree": "degree, half-edge", "edge_faces": "faces of, edge",
    "ring_halfedges": "half-edges clockwise, vertex",
    "ring_reversed": "half-edges counter-clockwise, vertex",
    "ring_vertices": "neighbours, vertex", "ring_faces": "faces at, vertex",
    "boundary_loop": "one boundary loop, boundary edge",
    "boundary_loops": "all boundary loops, half-edge",
    "is_boundary_half": "on boundary?, half-edge", "is_boundary_edge": "on boundary?, edge",
    "is_boundary_vertex": "on boundary?, vertex", "is_boundary_face": "on boundary?, face",
    "components": "components, edge", "euler": "Euler characteristic, edge", "genus": "genus, edge",
    "vertex_normals": "vertex normals, vertex",
}
SIZES = ("10k", "1M", "4M")
ORDERS = ("grid", "shuffled")


class Answers:
    """Nanoseconds an element: `get(order, size, question, kind)`, None where it was not measured."""

    def __init__(self, results):
        self.rows = {(row.dataset, row.size, row.operation.removeprefix(PREFIX), row.variant): row
                     for row in results.timed() if row.operation.startswith(PREFIX)}

    def get(self, order, size, question, kind):
        row = self.rows.get((order, size, question, kind))
        return row.ns / row["elements"] if row else None

    def bytes_per_edge(self, order, size, kind):
        row = self.rows.get((order, size, "build", kind))
        return row["bytes_per_edge"] if row else None


FOLDED = 0.01  # ns: the compiler has found the answer, and no element was looked at


def cells_of(values):
    """Texts, the least in bold."""
    values = [0 if value is not None and value < FOLDED else value for value in values]
    found = [value for value in values if value is not None]
    return ["" if value is None else f"**{number(value)}**" if value == min(found) else number(value)
            for value in values]


def comparison_table(order, size):
    def table(results, _counts):
        answers = Answers(results)
        body = [["bytes an edge", *cells_of([answers.bytes_per_edge(order, size, kind)
                                             for kind in KINDS])]]
        for question, title in QUESTIONS.items():
            values = [answers.get(order, size, question, kind) for kind in KINDS]
            body.append([title, *cells_of(values)])
        lines = ["| ns for each | " + " | ".join(KINDS.values()) + " |",
                 "|---|" + "---:|" * len(KINDS)]
        return "\n".join(lines + ["| " + " | ".join(cells) + " |" for cells in body])
    return table


def choice(results, _counts):
    """When each is the right choice, in the numbers of the largest meshes."""
    answers = Answers(results)
    size = SIZES[-1]

    def told(question, kind, order="grid"):
        value = answers.get(order, size, question, kind)
        return "?" if value is None else number(value)

    def size_of(kind):
        value = answers.bytes_per_edge("grid", size, kind)
        return "?" if value is None else number(value)

    lines = [
        f"On 4M triangles, in order / shuffled. **Flat** ({size_of('flat')} bytes an edge, built in "
        f"{told('build', 'flat')} / {told('build', 'flat', 'shuffled')} ns an edge) where memory and "
        f"the build count, or whole passes over faces ({told('face_vertices', 'flat')} ns for the "
        f"vertices of one): the default.",
        f"**Flat, stored** ({size_of('flat-stored')} bytes) for polygons, and where vertices are "
        f"walked: a ring costs {told('ring_vertices', 'flat-stored')} ns for "
        f"{told('ring_vertices', 'flat')}, as no remainder is computed; shuffled, where memory is "
        f"waited for, {told('ring_vertices', 'flat-stored', 'shuffled')} for "
        f"{told('ring_vertices', 'flat', 'shuffled')}.",
        f"**Flat, closed** ({size_of('flat-closed')} bytes) where holes are walked: "
        f"{told('boundary_loop', 'flat-closed')} ns an edge of a loop for "
        f"{told('boundary_loop', 'flat')}.",
        f"**Flat + radial** ({size_of('radial')} bytes, {told('build', 'radial')} ns) where edges have "
        f"more than two faces: the cycle of an edge costs {told('edge_faces', 'radial')} ns for "
        f"{told('edge_faces', 'flat')} by `opposite`.",
        f"**Directed edge** and **corner table** ({size_of('directed-edge')} bytes each) for code that is "
        f"written for them: records in place of columns gain a ring nothing "
        f"({told('ring_vertices', 'directed-edge')} / "
        f"{told('ring_vertices', 'directed-edge', 'shuffled')} ns), and each step through opposite "
        f"corners costs twice as much ({told('ring_vertices', 'corner-table')} / "
        f"{told('ring_vertices', 'corner-table', 'shuffled')}).",
        f"**DCEL** ({size_of('dcel')} bytes) for a shuffled mesh that stays so, since all about a "
        f"half-edge is in one or two cache lines: a ring in {told('ring_vertices', 'dcel', 'shuffled')} "
        f"ns, counter-clockwise in {told('ring_reversed', 'dcel', 'shuffled')} for "
        f"{told('ring_reversed', 'flat-closed', 'shuffled')} of the closed columns; in order it is "
        f"behind them.",
        f"**Split edge** ({size_of('split-edge')} bytes) where only rings are walked, which it has "
        f"stored: {told('ring_halfedges', 'split-edge', 'shuffled')} ns for the half-edges of a ring, "
        f"but {told('face_vertices', 'split-edge', 'shuffled')} for the vertices of a face, shuffled.",
        f"**Adjacency** ({size_of('adjacency')} bytes) where no vertex has an id, as when faces alone are "
        f"joined or counted: the faces across one in {told('face_faces', 'adjacency')} / "
        f"{told('face_faces', 'adjacency', 'shuffled')} ns; components, Euler characteristic and "
        f"genus come together from orbits, {told('genus', 'adjacency')} ns an edge.",
        f"**Winged tables** ({size_of('winged-tables')} bytes) to exchange: each step compares "
        f"vertices, {told('ring_vertices', 'winged-tables')} ns a ring.",
        f"**Non-manifold** records ({size_of('nonmanifold')} bytes, built in "
        f"{told('build', 'nonmanifold')} ns) where rings are read far more often than made, on any "
        f"input: {told('ring_vertices', 'nonmanifold')} / "
        f"{told('ring_vertices', 'nonmanifold', 'shuffled')} ns, normals in "
        f"{told('vertex_normals', 'nonmanifold')} / "
        f"{told('vertex_normals', 'nonmanifold', 'shuffled')}.",
        f"The meshes of **pointers** ({size_of('pointer-half')} and {size_of('pointer-winged')} bytes "
        f"before what the allocator adds, built in {told('build', 'pointer-half')} and "
        f"{told('build', 'pointer-winged')} ns) nowhere but where records must keep their address; "
        f"rings cost {told('ring_vertices', 'pointer-half')} and "
        f"{told('ring_vertices', 'pointer-winged')} ns.",
    ]
    return "\n".join(lines)


def representation_tables():
    tables = {f"represent-{order}-{size}": comparison_table(order, size)
              for size in SIZES for order in ORDERS}
    return {"represent-choice": choice, **tables}


def read_representations(path=REPRESENTATIONS):
    """The stored answers, or none at all."""
    if not pathlib.Path(path).exists():
        return Results({"context": {}, "rows": []})
    return read_results(path)
