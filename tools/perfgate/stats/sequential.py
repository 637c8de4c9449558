"""Looks: when to stop sampling, and what is known then.

The chance of a false red in a run, `alpha_run`, is split equally over the planned looks, and in each
look over the tests: one for each gated benchmark and one for the mean of the suite. So it holds
however the benchmarks depend on each other, and whoever looks first.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, List, Mapping, Optional, Sequence, Tuple

from .bounds import Bounds, bounds_of, sign_p_value
from .holm import holm_levels

REGRESSION = "REGRESSION"
IMPROVEMENT = "IMPROVEMENT"
SMALL_SLOWDOWN = "SMALL_SLOWDOWN"
EQUIVALENT = "EQUIVALENT"
PASS = "PASS"
UNSTABLE = "UNSTABLE"
INCONCLUSIVE = "INCONCLUSIVE"

# At the last look: noise that hides even a slowdown of three margins.
UNSTABLE_FACTOR = 3.0


@dataclass(frozen=True)
class Plan:
    """The looks of a run and the chances of being wrong."""

    looks: Tuple[int, ...] = (16, 24, 48, 96)
    alpha_run: float = 0.01
    pass_alpha: float = 0.05

    @property
    def look_alpha(self) -> float:
        return self.alpha_run / len(self.looks)


@dataclass(frozen=True)
class Outcome:
    """Where the sampling of one benchmark stands."""

    verdict: str
    bounds: Bounds
    is_open: bool  # more pairs are wanted, and the plan has a look left for them


def verdict_of(bounds: Bounds, margin: float, is_exhausted: bool) -> str:
    """What bounds prove. `is_exhausted`: the plan has no look after this."""
    if bounds.lower is not None and bounds.upper is not None:
        if bounds.lower > margin:
            return REGRESSION
        if bounds.upper < -margin:
            return IMPROVEMENT
        if bounds.lower > 0:
            return SMALL_SLOWDOWN
    if bounds.pass_upper is not None and bounds.pass_lower is not None:
        if bounds.pass_upper < margin:
            return EQUIVALENT if bounds.pass_lower > -margin else PASS
    if is_exhausted and bounds.lower is not None:
        if margin + bounds.estimate - bounds.lower > UNSTABLE_FACTOR * margin:
            return UNSTABLE
    return INCONCLUSIVE


def is_decided(bounds: Bounds, margin: float) -> bool:
    """Red, or a slowdown beyond the margin is excluded at the passing level."""
    is_red = bounds.lower is not None and bounds.lower > margin
    is_passed = bounds.pass_upper is not None and bounds.pass_upper < margin
    return is_red or is_passed


def replay(ratios: Mapping[str, Sequence[Optional[float]]], margins: Mapping[str, float],
           plan: Plan, tests: int) -> Dict[str, Outcome]:
    """The state of every benchmark with the pairs measured so far, in the order they were measured;
    None for a pair that says nothing.

    Each look takes the first pairs of those that earlier looks left open, `looks[i]` or as many as
    there are. A run calls this after each look and measures on where `is_open`; whoever reads the
    stored pairs calls it once and comes to the same. `tests` is the size of the family. A benchmark
    without a pair that says something has no outcome.
    """
    outcomes: Dict[str, Outcome] = {}
    active = [name for name, values in ratios.items() if any(v is not None for v in values)]
    reds = 0
    for position, look in enumerate(plan.looks):
        is_last = position == len(plan.looks) - 1
        seen = {name: [v for v in ratios[name][:look] if v is not None] for name in active}
        p_values = [sign_p_value(seen[name], margins[name]) for name in active]
        family = max(tests - reds, len(active), 1)
        levels = holm_levels(p_values, plan.look_alpha, family)
        still_active: List[str] = []
        for name, level in zip(active, levels):
            bounds = bounds_of(seen[name], level, plan.pass_alpha)
            if bounds is None:  # nothing but dropped pairs so far
                still_active.append(name)
                continue
            decided = is_decided(bounds, margins[name])
            verdict = verdict_of(bounds, margins[name], is_last and len(ratios[name]) >= look)
            outcomes[name] = Outcome(verdict, bounds, not decided and not is_last)
            reds += verdict == REGRESSION
            if not decided and len(ratios[name]) > look:
                still_active.append(name)
        active = still_active
    return outcomes
