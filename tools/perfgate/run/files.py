"""Stored results instead of programs: all that can be said of samples without partners."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Tuple

from ..errors import BROKEN, GateError, usage
from ..model.config import Config
from ..model.entry import NEW, REMOVED, Entry, new_entry
from ..model.google_json import Row, parse
from ..model.jsonio import read_text
from .fingerprint import SHOWN, refuse_unfit

WEAKER = ("stored results, measured one side after the other: what the host did meanwhile is in the "
          "difference, and the intervals take both sides to vary alike")


def read_side(paths: List[str]) -> Tuple[Mapping[str, Any], Dict[str, List[Row]]]:
    """The context of the first file, and the rows of all, by name."""
    rows: Dict[str, List[Row]] = {}
    contexts = []
    for path in paths:
        document = parse(read_text(path), path)
        contexts.append(document.context)
        for name, found in document.by_name().items():
            rows.setdefault(name, []).extend(found)
    if not rows:
        raise usage(f"{paths[0]}: no measurements (aggregates do not count)")
    return contexts[0], rows


def digests(rows: List[Row]) -> List[str]:
    found = []
    for row in rows:
        high, low = row.counters.get("digest_hi"), row.counters.get("digest_lo")
        if high is not None and low is not None:
            text = f"{(int(high) << 32) + int(low):016x}"
            if text not in found:
                found.append(text)
    return found


def entry_of(name: str, base: List[Row], head: List[Row], config: Config) -> Entry:
    entry = new_entry(name)
    entry["samples"] = {}
    for side, rows in (("base", base), ("head", head)):
        for row in rows:
            if row.error is not None:
                entry["error"] = f"the {side} says: {row.error}"
        times = [row.metric(config.metric) for row in rows if row.error is None]
        if any(time is None for time in times):
            raise usage(f"{name}: the {side} has no counter {config.metric!r}")
        entry["samples"][side] = times
        entry["checksum"][side] = digests(rows)
    return entry


def compare_files(raw: Dict[str, Any], base_paths: List[str], head_paths: List[str],
                  config: Config) -> None:
    raw["mode"] = "unpaired"
    (base_context, base), (head_context, head) = read_side(base_paths), read_side(head_paths)
    for side, context in (("base", base_context), ("head", head_context)):
        raw[side] = {key: context[key] for key in SHOWN if key in context}
    raw["notes"] += refuse_unfit(raw["base"], raw["head"], [base_context, head_context], config)
    raw["notes"].append(WEAKER)
    for name in base:
        if not config.is_chosen(name):
            continue
        if name in head:
            raw["benchmarks"].append(entry_of(name, base[name], head[name], config))
        else:
            raw["benchmarks"].append(new_entry(name, REMOVED))
    raw["benchmarks"] += [new_entry(name, NEW) for name in head
                          if name not in base and config.is_chosen(name)]
    if not raw["benchmarks"]:
        raise GateError(BROKEN, f"no benchmark is called {config.filter!r}")
