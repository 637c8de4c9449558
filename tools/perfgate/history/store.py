"""A history: one JSON object a line, only ever appended to; a line for each report."""

from __future__ import annotations

import fcntl
import json
import os
from typing import Any, Dict, List, Mapping

from .. import SCHEMA
from ..errors import usage
from ..model.jsonio import loads, read_text

Line = Dict[str, Any]


def line_of(report: Mapping[str, Any], sha: str) -> Line:
    """What is kept of a report: times of the head, ratios, instructions."""
    rows = {}
    for row in report["benchmarks"]:
        if row["head_ns"] is None:
            continue
        kept: Dict[str, Any] = {"ns": row["head_ns"], "ratio": row["ratio"],
                                "verdict": row["verdict"], "n": row["n"]}
        if row["ir"] is not None and not row["ir"].get("void") and row["ir"]["head"]:
            kept["ir"] = min(row["ir"]["head"])
        rows[row["name"]] = kept
    return {"schema": SCHEMA, "sha": sha, "started": report["started"],
            "host_class": report["host"].get("class", "unknown"), "benchmarks": rows}


def append(path: str, line: Line) -> None:
    """One write of one line, locked and synced: readers see it whole or not at all."""
    data = (json.dumps(line, separators=(",", ":"), allow_nan=False) + "\n").encode()
    try:
        descriptor = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CREAT, 0o644)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX)
            size = os.fstat(descriptor).st_size
            if size and os.pread(descriptor, 1, size - 1) != b"\n":
                raise usage(f"{path}: the last line has no end: a write was cut off there; remove it")
            written = os.write(descriptor, data)
            if written != len(data):
                os.ftruncate(descriptor, size)
                raise usage(f"{path}: cannot be written: the disk is full")
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except OSError as error:
        raise usage(f"{path}: cannot be written: {error.strerror}") from None


def check_line(line: Any, where: str) -> Line:
    if not isinstance(line, dict) or line.get("schema") != SCHEMA:
        raise usage(f"{where}: not a line of a history of schema {SCHEMA}")
    if not isinstance(line.get("benchmarks"), dict):
        raise usage(f"{where}: benchmarks is no object")
    for name, row in line["benchmarks"].items():
        value = row.get("ns") if isinstance(row, dict) else None
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0 <= value < 1e300:
            raise usage(f"{where}: {name}: ns is {value!r}; a time is wanted")
    return line


def read_history(path: str) -> List[Line]:
    lines = []
    for number, text in enumerate(read_text(path).splitlines(), 1):
        if text.strip():
            where = f"{path}:{number}"
            lines.append(check_line(loads(text, where), where))
    if not lines:
        raise usage(f"{path}: an empty history")
    return lines


def series(lines: List[Line], host: str) -> Dict[str, List[Any]]:
    """(commit, ns) of each benchmark on hosts of one class, in order; zeros say nothing."""
    found: Dict[str, List[Any]] = {}
    for line in lines:
        if line.get("host_class") == host:
            for name, row in line["benchmarks"].items():
                if row["ns"] > 0:
                    found.setdefault(name, []).append((str(line.get("sha", "?")), float(row["ns"])))
    return found
