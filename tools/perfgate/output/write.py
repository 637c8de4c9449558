"""All outputs of a report into one folder."""

from __future__ import annotations

import os
import pathlib
import tempfile
from typing import Any, Callable, List, Mapping, Tuple

from ..errors import usage
from ..model.jsonio import dumps, write_text
from .annotations import annotations
from .exporters import bencher, smaller_is_better
from .html import html
from .junit import junit
from .markdown import markdown

FILES: List[Tuple[str, Callable[[Mapping[str, Any]], str]]] = [
    ("report.json", dumps), ("junit.xml", junit), ("summary.md", markdown), ("report.html", html),
    ("bencher.json", lambda report: dumps(bencher(report))),
    ("smaller_is_better.json", lambda report: dumps(smaller_is_better(report))),
]


def prepare(folder: pathlib.Path) -> None:
    """Before anything is measured: what cannot be written at the end would be lost."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise usage(f"{folder}: cannot be written: {error.strerror}") from None


def write_all(report: Mapping[str, Any], folder: pathlib.Path) -> None:
    prepare(folder)
    for name, make in FILES:
        write_text(folder / name, make(report))


def github_lines(report: Mapping[str, Any]) -> str:
    """Annotations, where GitHub reads them; and the summary of the step."""
    if os.environ.get("GITHUB_ACTIONS") != "true":
        return ""
    summary = os.environ.get("GITHUB_STEP_SUMMARY")
    if summary:
        try:
            with open(summary, "a", encoding="utf-8") as file:
                file.write(markdown(report))
        except OSError:
            return f"::warning::the summary cannot be written to {summary}\n" + annotations(report)
    return annotations(report)
