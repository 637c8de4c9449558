"""The report as text for a terminal or a log."""

from __future__ import annotations

from typing import Any, List, Mapping

from . import words

OPEN_ROWS = 20


def text(report: Mapping[str, Any], show_all: bool = False) -> str:
    rows = words.worst_first(report["benchmarks"])
    quiet = [row for row in rows if row["verdict"] in ("EQUIVALENT", "PASS", "IDENTICAL")]
    shown = rows if show_all else [row for row in rows if row not in quiet or row["waiver"]]
    lines: List[str] = [report["headline"]]
    lines += [words.line(row) for row in shown]
    if len(shown) < len(rows):
        lines.append(f"and {len(rows) - len(shown)} more: {words.tally(quiet)}")
    lines += [words.suite_line(suite) for suite in report["suites"]]
    lines += [f"note: {note}" for note in report["notes"]]
    for row in rows:
        if words.is_failure(row):
            lines.append(f"again: {words.reproduce(report, row)}")
    lines.append(f"exit {report['exit']}")
    return "\n".join(lines) + "\n"
