"""The report as one self-contained HTML page with a picture of every benchmark."""

from __future__ import annotations

import math
from html import escape
from typing import Any, List, Mapping

from ..model.entry import ratios
from . import svg, words
from .page import page

HEAD = ("<tr><th>verdict</th><th>benchmark</th><th class=n>change</th><th class=n>interval</th>"
        "<th class=n>n</th><th class=n>base</th><th class=n>margin</th>"
        "<th class=n>could detect</th><th>remarks</th></tr>")
# Open from the start: what somebody has to look at.
OPEN = ("REGRESSION", "ERROR", "WAIVED", "LAYOUT_SENSITIVE")


def table_row(row: Mapping[str, Any]) -> str:
    is_timed = row["n"] > 0
    sight = words.percent(row["detectable"]) if row["detectable"] is not None else "nothing"
    numbers = [words.percent(row["ratio"]), words.interval(row), str(row["n"]),
               words.nanoseconds(row["base_ns"]), f"{100 * (row['margin'] - 1):.1f}%", sight]
    remarks = "; ".join(filter(None, [words.instructions(row), *words.remarks(row)]))
    return (f'<tr><td class="{row["verdict"]}">{row["verdict"]}</td>'
            f"<td><code>{escape(row['name'])}</code></td>"
            + "".join(f"<td class=n>{escape(text) if is_timed else ''}</td>" for text in numbers)
            + f"<td>{escape(remarks)}</td></tr>")


def picture(row: Mapping[str, Any]) -> str:
    """Dots and lines of one benchmark; empty where it was not measured in pairs."""
    known = [value for value in ratios(row["pairs"]) if value is not None]
    if not known or row["ratio"] is None:
        return ""
    bounds = [None if row[key] is None else math.log(row[key]) for key in ("lower", "upper")]
    strip = svg.strip_plot(known, math.log(row["margin"]), math.log(row["ratio"]), *bounds)
    base, head = ([pair[side] for pair in row["pairs"]] for side in (1, 2))
    drift = svg.drift_plot(base, head)
    is_open = " open" if row["verdict"] in OPEN else ""
    return (f'<details{is_open}><summary><span class="{row["verdict"]}">{row["verdict"]}</span> '
            f"<code>{escape(row['name'])}</code> {escape(words.measured(row))}</summary>"
            f'<p class="soft">Each pair as a ratio head / base, the margin as a band, the interval '
            f"as a bar:</p>{strip}"
            f'<p class="soft">Times round by round, base grey, head blue:</p>{drift}</details>')


def facts(report: Mapping[str, Any]) -> str:
    rows: List[str] = []
    for part in ("host", "base", "head"):
        for key, value in report[part].items():
            rows.append(f"<tr><td>{part}</td><td>{escape(str(key))}</td>"
                        f"<td><code>{escape(str(value))}</code></td></tr>")
    rows += [f"<tr><td>run</td><td>{key}</td><td><code>{escape(str(report[key]))}</code></td></tr>"
             for key in ("tool", "started", "mode", "seed", "tests")]
    return ("<h2>Host and programs</h2><div class=wide><table>" + "".join(rows)
            + "</table></div>")


def html(report: Mapping[str, Any]) -> str:
    rows = words.worst_first(report["benchmarks"])
    parts = [f'<h1 class="{report["verdict"]}">{escape(report["headline"])}</h1>',
             f"<p>{escape(words.tally(rows))}. Exit {report['exit']}.</p>"]
    parts += [f"<p>{escape(words.suite_line(suite))}</p>" for suite in report["suites"]]
    parts += [f'<p class="soft">{escape(note)}</p>' for note in report["notes"]]
    parts.append("<h2>Benchmarks</h2><div class=wide><table>" + HEAD
                 + "".join(map(table_row, rows)) + "</table></div>")
    failures = [row for row in rows if words.is_failure(row)]
    if failures:
        parts.append("<h2>Measure again</h2>")
        parts += [f"<p><code>{escape(words.reproduce(report, row))}</code></p>" for row in failures]
    pictures = "".join(map(picture, rows))
    if pictures:
        parts.append("<h2>Pairs</h2>" + pictures)
    parts.append(facts(report))
    return page(f"perfgate: {report['verdict']}", "\n".join(parts))
