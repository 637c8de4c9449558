"""The arm of wall time: bounds and verdicts of all benchmarks of a run."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Dict, List, Mapping, Optional, Sequence

from ..stats.bounds import Bounds, bounds_of, median_of_sorted, robust_sd
from ..stats.margins import margin_of
from ..stats.ranksum import unpaired_bounds
from ..stats.sequential import REGRESSION, Outcome, Plan, replay, verdict_of
from ..stats.suite import suite_bounds
from .config import Config
from .entry import MEASURED, Entry, median_times, ratios

CONFIRMED, NOT_REPRODUCED, LAYOUT, UNCONFIRMED = (
    "confirmed", "not reproduced", "layout-sensitive", "not re-measured")


@dataclass(frozen=True)
class Family:
    """The tests that share the chance of a false red."""

    gated: List[str]
    shown: List[str]               # informational: judged alike, and never red
    suites: Dict[str, List[str]]   # gated benchmarks whose mean is gated, too

    @property
    def tests(self) -> int:
        return max(1, len(self.gated) + len(self.suites))


def is_timed(entry: Entry) -> bool:
    return entry["state"] == MEASURED and entry["error"] is None


def family_of(entries: Sequence[Entry], config: Config, is_waived: Mapping[str, bool]) -> Family:
    """Every benchmark that was to be measured, whatever came of it: what fails meanwhile must not
    make the others' levels depend on the data."""
    names = [entry["name"] for entry in entries if entry["state"] == MEASURED]
    gated = [name for name in names if not config.is_informational(name)]
    suites = {}
    for suite, pattern in config.suites.items():
        members = [name for name in gated
                   if re.search(pattern, name) and not is_waived.get(name, False)]
        if len(members) >= 2:  # the mean of one is that one
            suites[suite] = members
    return Family(gated, [name for name in names if name not in gated], suites)


def margin_for(entry: Entry, config: Config, floor: float) -> float:
    """`floor`: what the noise of the host asks for at least."""
    return margin_of(max(config.margin_of(entry["name"]), floor), entry["own_mad"],
                     config.min_effect_ns, median_times(entry)["base"])


def outcomes_of(entries: Sequence[Entry], family: Family, margins: Mapping[str, float],
                plan: Plan) -> Dict[str, Outcome]:
    """Informational benchmarks are judged apart: their reds take nothing from the family."""
    timed = {entry["name"]: entry for entry in entries if is_timed(entry)}
    found: Dict[str, Outcome] = {}
    for group in (family.gated, family.shown):
        pairs = {name: ratios(timed[name]["pairs"]) for name in group
                 if name in timed and timed[name]["samples"] is None}
        found.update(replay(pairs, margins, plan, family.tests))
    for name, entry in timed.items():
        if entry["samples"] is not None:
            # One look at all there is.
            bounds = unpaired_bounds(entry["samples"]["base"], entry["samples"]["head"],
                                     plan.alpha_run / family.tests, plan.pass_alpha)
            if bounds is not None:
                found[name] = Outcome(verdict_of(bounds, margins[name], True), bounds, False)
    return found


def spread_of(entry: Entry) -> Optional[float]:
    """The deviation of one paired log ratio."""
    known = [value for value in ratios(entry["pairs"]) if value is not None]
    return robust_sd(known) if len(known) >= 2 else None


def holds_again(pairs: Sequence[Sequence[object]], margin: float, pass_alpha: float) -> bool:
    """Whether fresh pairs show the slowdown again: their median beyond the margin, and a slowdown of
    nothing excluded. Not the full test: that was passed, with a chance of error that holds for it."""
    known = [value for value in ratios(pairs) if value is not None]  # type: ignore[arg-type]
    bounds = bounds_of(known, pass_alpha, pass_alpha)
    return bounds is not None and bounds.lower is not None and bounds.lower > 0 and \
        median_of_sorted(sorted(known)) > margin


def confirmation_of(entry: Entry, margin: float, pass_alpha: float) -> str:
    if not entry["fresh"]:
        return UNCONFIRMED
    if not holds_again(entry["fresh"], margin, pass_alpha):
        return NOT_REPRODUCED
    for layout in entry["layouts"]:
        if not holds_again(layout["pairs"], margin, pass_alpha):
            return LAYOUT
    return CONFIRMED


def mean_of_suite(entries: Sequence[Entry], members: Sequence[str], family: Family,
                  plan: Plan) -> Optional[Bounds]:
    """Bounds of a suite's mean; None where no round has all its benchmarks."""
    by_name = {entry["name"]: entry for entry in entries}
    rounds = {name: ratios(by_name[name]["pairs"]) for name in members
              if is_timed(by_name[name]) and by_name[name]["pairs"]}
    return suite_bounds(rounds, plan.look_alpha / family.tests, plan.pass_alpha)


def reds(outcomes: Mapping[str, Outcome], names: Sequence[str]) -> List[str]:
    return [name for name in names
            if name in outcomes and outcomes[name].verdict == REGRESSION]
