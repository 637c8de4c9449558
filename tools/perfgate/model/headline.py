"""The first line of every output: the verdict, and what effect the run could have seen."""

from __future__ import annotations

import statistics
from typing import Any, List, Mapping, Optional, Sequence

from ..stats.binomial import smallest_n


def percent(ratio: Optional[float], digits: int = 1) -> str:
    """"+2.9%" for 1.029."""
    if ratio is None:
        return "?"
    if ratio >= 100:
        return f"x{ratio:.3g}"
    return f"{100 * (ratio - 1):+.{digits}f}%"


def counted(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def sight(report: Mapping[str, Any]) -> str:
    """What the run could have seen."""
    timed = [row for row in report["benchmarks"] if row["gated"] and row["n"] > 0]
    seen: List[float] = [row["detectable"] for row in timed if row["detectable"] is not None]
    if not timed:
        return "nothing was timed"
    blind = len(timed) - len(seen)
    if not seen:
        plan_alpha = report["config"]["alpha_run"] / len(report["config"]["looks"]) / report["tests"]
        return (f"it could see no slowdown at all: {counted(report['tests'], 'test')} need "
                f"{smallest_n(plan_alpha)} pairs each, and the most was {max(r['n'] for r in timed)}")
    text = f"a slowdown of {percent(statistics.median(seen))} could be seen in half of the benchmarks"
    if len(seen) > 1:
        text += f", of {percent(max(seen))} in all" if not blind else \
            f", none in {counted(blind, 'benchmark')} with too few pairs"
    return text if len(timed) > 1 else f"a slowdown of {percent(seen[0])} could be seen"


def cause(report: Mapping[str, Any], rows: Sequence[Mapping[str, Any]]) -> str:
    def names(verdict: str) -> List[str]:
        return [row["name"] for row in rows if row["verdict"] == verdict]

    errors, reds = names("ERROR"), names("REGRESSION")
    if report["verdict"] == "INTERRUPTED":
        return f"interrupted ({report['interrupted']}): no verdict"
    if report["verdict"] == "ERROR":
        return f"{counted(len(errors), 'benchmark')} of {len(rows)} broken: {errors[0]}" + \
            (" and others" if len(errors) > 1 else "")
    if report["verdict"] == "REGRESSION":
        if reds:
            return f"{counted(len(reds), 'benchmark')} of {len(rows)} regressed"
        suite = next(row for row in report["suites"] if row["is_red"])
        return f"the mean of suite {suite['name']!r} is slower by {percent(suite['geomean'])}"
    if report["verdict"] == "INCONCLUSIVE":
        return "not every benchmark could be decided, and --strict was given"
    undecided = len([row for row in rows if row["verdict"] in ("INCONCLUSIVE", "UNSTABLE")])
    if undecided:
        return f"no confirmed regression, {undecided} of {len(rows)} undecided"
    return f"no confirmed regression in {counted(len(rows), 'benchmark')}"


def headline(report: Mapping[str, Any]) -> str:
    rows = [row for row in report["benchmarks"] if row["gated"]]
    text = f"{report['verdict']}: {cause(report, rows)}; {sight(report)}"
    if report["is_quick"]:
        text += " (screening only)"
    if report["mode"] == "unpaired":
        text += " (unpaired samples: weaker)"
    return text
