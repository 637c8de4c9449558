"""What Google Benchmark prints with --benchmark_format=json (its schema 1)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional

from ..errors import GateError, UNFIT, usage
from .jsonio import loads

SCHEMA = 1
NS_PER_UNIT = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
# Keys of a row that are numbers but no counters.
NOT_COUNTERS = {"family_index", "per_family_instance_index", "repetitions", "repetition_index",
                "threads", "iterations", "real_time", "cpu_time"}


@dataclass(frozen=True)
class Row:
    """One repetition of one benchmark."""

    name: str
    iterations: int
    real_ns: float
    cpu_ns: float
    counters: Mapping[str, float]
    error: Optional[str] = None

    def metric(self, name: str) -> Optional[float]:
        """The time that is compared: real_time, cpu_time, or a counter that is in nanoseconds."""
        if name == "real_time":
            return self.real_ns
        return self.cpu_ns if name == "cpu_time" else self.counters.get(name)


@dataclass(frozen=True)
class Document:
    context: Mapping[str, Any]
    rows: List[Row] = field(default_factory=list)

    def by_name(self) -> Dict[str, List[Row]]:
        found: Dict[str, List[Row]] = {}
        for row in self.rows:
            found.setdefault(row.name, []).append(row)
        return found


def time_of(entry: Mapping[str, Any], key: str, where: str) -> float:
    value = entry.get(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise usage(f"{where}: {key} is {value!r}; a number is wanted")
    if not math.isfinite(value) or value < 0:
        raise usage(f"{where}: {key} is {value}; a time is finite and not negative")
    unit = entry.get("time_unit", "ns")
    if unit not in NS_PER_UNIT:
        raise usage(f"{where}: time_unit is {unit!r}; known are {', '.join(NS_PER_UNIT)}")
    return float(value) * NS_PER_UNIT[unit]


def row_of(entry: Any, where: str) -> Optional[Row]:
    """None for an aggregate: what is computed from rows is not a measurement."""
    if not isinstance(entry, dict):
        raise usage(f"{where}: {type(entry).__name__} instead of an object")
    name = entry.get("name")
    if not isinstance(name, str) or not name:
        raise usage(f"{where}: name is {name!r}; text is wanted")
    where = f"{where} ({name})"
    if entry.get("run_type", "iteration") != "iteration":
        return None
    if entry.get("error_occurred") or entry.get("skipped"):
        return Row(name, 0, 0.0, 0.0, {}, str(entry.get("error_message") or
                                              entry.get("skip_message") or "no message"))
    iterations = entry.get("iterations", 1)
    if isinstance(iterations, bool) or not isinstance(iterations, int) or iterations < 1:
        raise usage(f"{where}: iterations is {iterations!r}; a whole number from 1 is wanted")
    counters = {key: float(value) for key, value in entry.items()
                if key not in NOT_COUNTERS and isinstance(value, (int, float))
                and not isinstance(value, bool) and abs(value) < 1e300}
    return Row(name, iterations, time_of(entry, "real_time", where),
               time_of(entry, "cpu_time", where) if "cpu_time" in entry else 0.0, counters)


def parse(text: str, where: str) -> Document:
    document = loads(text, where)
    if not isinstance(document, dict):
        raise usage(f"{where}: {type(document).__name__} instead of an object")
    context = document.get("context", {})
    if not isinstance(context, dict):
        raise usage(f"{where}: context is no object")
    version = context.get("json_schema_version", SCHEMA)
    if version != SCHEMA:
        raise GateError(UNFIT, f"{where}: results have schema {version!r}; known is {SCHEMA}")
    entries = document.get("benchmarks")
    if not isinstance(entries, list):
        raise usage(f"{where}: no list 'benchmarks': not the output of Google Benchmark")
    rows = [row_of(entry, f"{where}: row {number}") for number, entry in enumerate(entries, 1)]
    return Document(context, [row for row in rows if row is not None])
