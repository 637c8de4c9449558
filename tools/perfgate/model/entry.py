"""What is measured of one benchmark, as it stands in report.json.

    name        as the programs list it
    state       measured, new, removed, identical (same machine code) or skipped
    error       why there is no verdict: crashed, timed out, another result; or null
    iterations  of one sample, the same on both sides; null where the program chose
    pairs       rows [order, base_ns, head_ns, [pids], [env_pads], base_min_ns, head_min_ns], one a
                round: order is "AB" or "BA", times are medians over the epochs of a process
    fresh       pairs of the confirmation, likewise
    layouts     [{name, pairs}], with both programs linked in other ways
    samples     {base: [ns], head: [ns]}: times without partners, instead of pairs
    ir          {base: [...], head: [...], base_ll, head_ll, void}: instructions an iteration, each
                counted twice; last-level misses; why they do not count
    mem         {base: {counter: [values seen]}, head: ...}
    checksum    {base: [seen], head: [seen]}
    own_mad     deviation against itself from the calibration, or null

All else in an entry is computed from these, and from the configuration, by `report.judge`.
"""

from __future__ import annotations

import math
from typing import Any, Dict, List, Optional, Sequence

from ..errors import usage
from ..stats.bounds import log_ratio

Entry = Dict[str, Any]

MEASURED, NEW, REMOVED, IDENTICAL, SKIPPED = "measured", "new", "removed", "identical", "skipped"
STATES = (MEASURED, NEW, REMOVED, IDENTICAL, SKIPPED)
ORDERS = ("AB", "BA")


def new_entry(name: str, state: str = MEASURED) -> Entry:
    return {"name": name, "state": state, "error": None, "iterations": None, "pairs": [],
            "fresh": [], "layouts": [], "samples": None, "ir": None, "mem": None,
            "checksum": {"base": [], "head": []}, "own_mad": None}


RAW_KEYS = tuple(new_entry(""))


def ratios(pairs: Sequence[Sequence[Any]]) -> List[Optional[float]]:
    return [log_ratio(pair[1], pair[2]) for pair in pairs]


def median_times(entry: Entry) -> Dict[str, Optional[float]]:
    """The median time of each side over all pairs, or samples."""
    def median(values: List[float]) -> Optional[float]:
        ordered = sorted(values)
        return ordered[len(ordered) // 2] if ordered else None

    if entry["samples"] is not None:
        return {side: median(entry["samples"][side]) for side in ("base", "head")}
    return {"base": median([pair[1] for pair in entry["pairs"]]),
            "head": median([pair[2] for pair in entry["pairs"]])}


def is_time(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and \
        math.isfinite(value) and value >= 0


def check_pairs(pairs: Any, where: str) -> None:
    if not isinstance(pairs, list):
        raise usage(f"{where}: a list of pairs is wanted")
    for number, pair in enumerate(pairs, 1):
        if not isinstance(pair, list) or len(pair) < 3 or pair[0] not in ORDERS:
            raise usage(f"{where}: pair {number} is {str(pair)[:60]}; [order, base_ns, head_ns, ...] "
                        "with order AB or BA is wanted")
        if not is_time(pair[1]) or not is_time(pair[2]):
            raise usage(f"{where}: pair {number} has times {pair[1]!r} and {pair[2]!r}; times are "
                        "finite and not negative")


def check_values(value: Any, where: str) -> None:
    if not isinstance(value, list) or not all(is_time(item) for item in value):
        raise usage(f"{where}: a list of numbers that are finite and not negative is wanted")


def check_sides(value: Any, where: str) -> None:
    if not isinstance(value, dict) or not {"base", "head"} <= set(value):
        raise usage(f"{where}: base and head are wanted")


def check_entry(entry: Any, number: int) -> Entry:
    """The measured part of an entry of a report, if it has the form described above."""
    where = f"benchmark {number}"
    if not isinstance(entry, dict) or not isinstance(entry.get("name"), str):
        raise usage(f"{where}: an object with a name is wanted")
    where = f"{where} ({entry['name']})"
    raw = {**new_entry(entry["name"]), **{key: entry[key] for key in RAW_KEYS if key in entry}}
    if raw["state"] not in STATES:
        raise usage(f"{where}: state is {raw['state']!r}; known are {', '.join(STATES)}")
    check_pairs(raw["pairs"], f"{where}: pairs")
    check_pairs(raw["fresh"], f"{where}: fresh")
    if not isinstance(raw["layouts"], list):
        raise usage(f"{where}: layouts: a list is wanted")
    for layout in raw["layouts"]:
        if not isinstance(layout, dict) or not isinstance(layout.get("name"), str):
            raise usage(f"{where}: layouts: objects with a name are wanted")
        check_pairs(layout.get("pairs"), f"{where}: layout {layout['name']}")
    check_sides(raw["checksum"], f"{where}: checksum")
    for key in ("samples", "ir"):
        if raw[key] is not None:
            check_sides(raw[key], f"{where}: {key}")
            for side in ("base", "head"):
                check_values(raw[key][side], f"{where}: {key}.{side}")
    if raw["mem"] is not None:
        check_sides(raw["mem"], f"{where}: mem")
        for side in ("base", "head"):
            if not isinstance(raw["mem"][side], dict):
                raise usage(f"{where}: mem.{side}: counters are wanted")
            for counter, values in raw["mem"][side].items():
                check_values(values, f"{where}: mem.{side}.{counter}")
    if raw["own_mad"] is not None and not is_time(raw["own_mad"]):
        raise usage(f"{where}: own_mad is {raw['own_mad']!r}")
    return raw
