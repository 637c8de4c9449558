"""Lines that GitHub shows beside the run."""

from __future__ import annotations

from typing import Any, List, Mapping

from . import words

MOST = 10  # of each kind; GitHub shows no more


def escaped(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def property_escaped(text: str) -> str:
    return escaped(text).replace(":", "%3A").replace(",", "%2C")


def annotations(report: Mapping[str, Any]) -> str:
    errors: List[str] = []
    warnings: List[str] = []
    for row in words.worst_first(report["benchmarks"]):
        kind, lines = ("error", errors) if words.is_failure(row) else ("warning", warnings)
        if kind == "error" or words.is_warning(row):
            title = property_escaped(f"perfgate {row['verdict']}")
            lines.append(f"::{kind} title={title}::{escaped(words.line(row))}")
    for suite in report["suites"]:
        if suite["is_red"]:
            errors.insert(0, f"::error title=perfgate suite::{escaped(words.suite_line(suite))}")
    shown = errors[:MOST] + warnings[:MOST]
    if not shown:
        shown = [f"::notice title=perfgate::{escaped(report['headline'])}"]
    return "\n".join(shown) + "\n"
