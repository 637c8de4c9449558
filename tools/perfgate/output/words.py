"""Numbers and rows in words, the same in every output."""

from __future__ import annotations

import math
import shlex
from typing import Any, Dict, List, Mapping, Optional, Sequence

from ..model.names import exact_pattern
from ..model.headline import percent
from ..model.verdicts import ORDER, WARNINGS

Row = Mapping[str, Any]


def nanoseconds(value: Optional[float]) -> str:
    if value is None:
        return "?"
    for unit, size in (("s", 1e9), ("ms", 1e6), ("us", 1e3)):
        if value >= size:
            return f"{value / size:.4g} {unit}"
    return f"{value:.4g} ns"


def interval(row: Row) -> str:
    """"[+5.2%,+7.0%]", or why there is none."""
    if row["lower"] is None:
        return "[too few pairs]"
    return f"[{percent(row['lower'])},{percent(row['upper'])}]"


def chance(alpha: float) -> str:
    """The level that was met, rounded up to two digits."""
    exponent = math.floor(math.log10(alpha))
    digits = math.ceil(alpha / 10.0 ** (exponent - 1) - 1e-9)
    return f"p<{digits * 10.0 ** (exponent - 1):.2g}".replace("e-0", "e-")


def instructions(row: Row) -> Optional[str]:
    for finding in row["findings"]:
        if finding["arm"] == "instructions" and finding["ratio"] is not None:
            return f"Ir {percent(finding['ratio'])}"
    return None


def is_decisive(row: Row) -> bool:
    return row["verdict"] in ("REGRESSION", "IMPROVEMENT", "WAIVED", "SMALL_SLOWDOWN",
                              "LAYOUT_SENSITIVE")


def measured(row: Row) -> str:
    """"+6.1% [+5.2%,+7.0%]  p<5e-5  n=24  base 12.31 ns  (margin 2.0%, could detect +2.9%)"."""
    if row["n"] == 0:
        return ""
    parts = [f"{percent(row['ratio'])} {interval(row)}"]
    if is_decisive(row) and row["lower"] is not None:
        parts.append(chance(row["alpha"]))
    parts += [f"n={row['n']}", f"base {nanoseconds(row['base_ns'])}"]
    found = instructions(row)
    if found:
        parts.append(found)
    sight = f"could detect {percent(row['detectable'])}" if row["detectable"] is not None else \
        "could detect nothing"
    parts.append(f"(margin {100 * (row['margin'] - 1):.1f}%, {sight})")
    return "  ".join(parts)


def remarks(row: Row) -> List[str]:
    """What else there is to say: red findings first."""
    texts = [finding["text"] for finding in
             sorted(row["findings"], key=lambda f: not f["is_red"])
             if finding["is_red"] or finding["arm"] != "instructions" or finding["ratio"] is None]
    texts += row["notes"]
    if row["ties"]:
        texts.append(f"{row['ties']} of {row['n']} pairs tie")
    if not row["gated"]:
        texts.append("informational")
    waiver = row["waiver"]
    if waiver is not None:
        texts.append(f"waived up to x{waiver['max_ratio']:g} until {waiver['expires']} by "
                     f"{waiver['owner']}: {waiver['reason']}")
    return texts


def line(row: Row) -> str:
    """One line of text for one benchmark."""
    parts = [f"{row['verdict']} {row['name']}"]
    if measured(row):
        parts.append(measured(row))
    if remarks(row):
        parts.append("; ".join(remarks(row)))
    return "  ".join(parts)


def worst_first(rows: Sequence[Row]) -> List[Row]:
    return sorted(rows, key=lambda row: (ORDER.index(row["verdict"]), not row["gated"],
                                         -(row["ratio"] or 0.0), row["name"]))


def tally(rows: Sequence[Row]) -> str:
    """"1 REGRESSION, 3 EQUIVALENT"."""
    counts: Dict[str, int] = {}
    for row in worst_first(rows):
        counts[row["verdict"]] = counts.get(row["verdict"], 0) + 1
    return ", ".join(f"{count} {verdict}" for verdict, count in counts.items())


def suite_line(suite: Mapping[str, Any]) -> str:
    if suite["geomean"] is None:
        return f"suite {suite['name']}: no round has all of its {suite['members']} benchmarks"
    return (f"suite {suite['name']}: mean of {suite['members']} {percent(suite['geomean'])} "
            f"{interval(suite)}  n={suite['n']}  (margin {100 * (suite['margin'] - 1):.1f}%)")


def is_failure(row: Row) -> bool:
    return row["gated"] and row["verdict"] in ("REGRESSION", "ERROR")


def is_warning(row: Row) -> bool:
    return row["verdict"] in WARNINGS or row["verdict"] == "WAIVED" or \
        (not row["gated"] and row["verdict"] in ("REGRESSION", "ERROR"))


def reproduce(report: Mapping[str, Any], row: Row) -> str:
    """The one command that measures this benchmark again, with the same seed."""
    name = exact_pattern(row["name"])
    command = report["command"] or "perfgate run --base BASE --head HEAD"
    return f"{command} --filter {shlex.quote(name)} --seed {report['seed']}"
