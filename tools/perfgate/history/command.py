"""Keep the times of every commit, and find what drifts slowly.

  add STORE REPORT --sha SHA   append the head's times of a report.json
  chart STORE --out PAGE       one HTML page with a line for each benchmark
  changepoints STORE           where times changed for good; exit 1 if by more than --margin (3 %)
"""

from __future__ import annotations

import argparse
import pathlib
from html import escape
from typing import Any, Dict, List, Tuple

from ..errors import OK, REGRESSION, usage
from ..model.headline import percent
from ..model.jsonio import dumps, read, write_text
from ..model.report import judge, raw_of
from ..output import svg
from ..output.page import page
from ..output.words import nanoseconds
from .changepoints import changes, median
from .store import append, line_of, read_history, series

RELEASE_MARGIN = 0.03


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="what", metavar="add|chart|changepoints", required=True)
    add = commands.add_parser("add", help="append a report")
    add.add_argument("store")
    add.add_argument("report")
    add.add_argument("--sha", help="the commit (default: that in the report)")
    chart = commands.add_parser("chart", help="write a page")
    chart.add_argument("store")
    chart.add_argument("--out", type=pathlib.Path, default=pathlib.Path("history.html"))
    points = commands.add_parser("changepoints", help="where times changed for good")
    points.add_argument("store")
    points.add_argument("--margin", type=float, default=RELEASE_MARGIN)
    points.add_argument("--json", action="store_true")
    for command in (chart, points):
        command.add_argument("--host", help="class of host (default: that of the last line)")


def chosen(options: argparse.Namespace) -> Tuple[str, Dict[str, List[Any]]]:
    lines = read_history(options.store)
    host = options.host or str(lines[-1].get("host_class"))
    found = series(lines, host)
    if not found:
        raise usage(f"{options.store}: nothing was measured on {host!r}")
    return host, found


def add(options: argparse.Namespace) -> int:
    report = judge(raw_of(read(options.report), options.report))
    sha = options.sha or report["head"].get("sha") or report["head"].get("commit")
    if not sha:
        raise usage(f"{options.report}: the report names no commit; give one with --sha")
    line = line_of(report, str(sha))
    if not line["benchmarks"]:
        raise usage(f"{options.report}: nothing was timed: there is nothing to keep")
    append(options.store, line)
    print(f"{len(line['benchmarks'])} benchmarks of {sha} added to {options.store}")
    return OK


def chart(options: argparse.Namespace) -> int:
    host, found = chosen(options)
    parts = [f"<h1>History on {escape(host)}</h1>"]
    for name, points in sorted(found.items()):
        values = [ns for _, ns in points]
        marks = [change.index for change in changes(values)]
        first, last = points[0], points[-1]
        parts.append(f"<h2><code>{escape(name)}</code></h2>"
                     f"{svg.series_plot(values, marks, 'times by commit')}"
                     f'<p class="soft">{escape(first[0][:12])} {nanoseconds(first[1])} to '
                     f"{escape(last[0][:12])} {nanoseconds(last[1])}, {len(points)} commits, "
                     f"median {nanoseconds(median(values))}</p>")
    write_text(options.out, page("perfgate: history", "\n".join(parts)))
    print(f"{len(found)} benchmarks drawn in {options.out}")
    return OK


def changepoints(options: argparse.Namespace) -> int:
    """A release is slower where the last level is above the first by more than the margin."""
    host, found = chosen(options)
    rows: List[Dict[str, Any]] = []
    slower: List[str] = []
    for name, points in sorted(found.items()):
        changed = changes([ns for _, ns in points])
        for change in changed:
            rows.append({"benchmark": name, "sha": points[change.index][0], "index": change.index,
                         "before_ns": change.before, "after_ns": change.after,
                         "ratio": change.ratio, "p": change.p_value})
        if changed and changed[-1].after / changed[0].before > 1 + options.margin:
            slower.append(f"{name}: {percent(changed[-1].after / changed[0].before)} since "
                          f"{points[0][0][:12]}, in {len(changed)} step"
                          f"{'' if len(changed) == 1 else 's'}")
    if options.json:
        print(dumps({"host_class": host, "changes": rows, "slower": slower}), end="")
    else:
        for row in rows:
            print(f"{row['benchmark']}  {percent(row['ratio'])} at {row['sha'][:12]}  "
                  f"{nanoseconds(row['before_ns'])} to {nanoseconds(row['after_ns'])}  p={row['p']:.3f}")
        print(f"{len(rows)} changes in {len(found)} benchmarks on {host}")
        for text in slower:
            print(f"SLOWER {text}")
    return REGRESSION if slower else OK


def main(options: argparse.Namespace) -> int:
    return {"add": add, "chart": chart, "changepoints": changepoints}[options.what](options)
