"""Runs of the gate on simulated pairs: the very code that judges real ones."""

from __future__ import annotations

import math
import random
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from itertools import islice
from typing import Dict, Iterable, List, Optional, Tuple

from ..stats.sequential import IMPROVEMENT, REGRESSION, Outcome, Plan, replay
from ..stats.suite import suite_bounds
from .noise import MODELS

MARGIN = math.log1p(0.02)


@dataclass(frozen=True)
class Setting:
    """One cell of a table."""

    model: str
    sd: float            # of the paired log ratios
    effect: float        # true change, as a share: 0.05 is 5 % slower
    benchmarks: int = 50
    slow: int = 50       # how many of them have the effect; the others have none
    plan: Plan = Plan()

    @property
    def tests(self) -> int:
        return self.benchmarks + 1  # and the mean of the suite


@dataclass(frozen=True)
class Run:
    """How one simulated run ended."""

    outcomes: Dict[str, Outcome]
    is_suite_red: bool

    def reds(self) -> List[Outcome]:
        return [o for o in self.outcomes.values() if o.verdict == REGRESSION]

    def improvements(self) -> List[Outcome]:
        return [o for o in self.outcomes.values() if o.verdict == IMPROVEMENT]


def simulate_run(setting: Setting, rng: random.Random) -> Run:
    """Pairs are drawn look by look, and only for benchmarks that are still open."""
    effect = math.log1p(setting.effect)
    draw = MODELS[setting.model]
    names = [str(index) for index in range(setting.benchmarks)]
    series = {name: draw(rng, setting.sd, effect if index < setting.slow else 0.0)
              for index, name in enumerate(names)}
    ratios: Dict[str, List[Optional[float]]] = {name: [] for name in names}
    margins = {name: MARGIN for name in names}
    open_names = names
    outcomes: Dict[str, Outcome] = {}
    for look in setting.plan.looks:
        for name in open_names:
            ratios[name].extend(islice(series[name], look - len(ratios[name])))
        outcomes = replay(ratios, margins, setting.plan, setting.tests)
        open_names = [name for name in names if outcomes[name].is_open]
        if not open_names:
            break
    suite = suite_bounds(ratios, setting.plan.look_alpha / setting.tests, setting.plan.pass_alpha)
    is_red = suite is not None and suite.lower is not None and suite.lower > MARGIN
    return Run(outcomes, is_red)


@dataclass(frozen=True)
class Tally:
    """What many runs of one setting came to."""

    runs: int = 0
    red_runs: int = 0                   # with at least one red benchmark, or a red mean
    benchmarks: int = 0                 # that had the effect
    improvements: int = 0
    reds_by_look: Tuple[int, ...] = ()  # of those, red at this look or an earlier one
    pairs: int = 0                      # measured, of all benchmarks

    def plus(self, other: "Tally") -> "Tally":
        by_look = [a + b for a, b in zip(self.reds_by_look, other.reds_by_look)]
        return Tally(self.runs + other.runs, self.red_runs + other.red_runs,
                     self.benchmarks + other.benchmarks, self.improvements + other.improvements,
                     tuple(by_look), self.pairs + other.pairs)


def tally(job: Tuple[Setting, int, int]) -> Tally:
    """The runs `first` to `last - 1` of a setting; run i depends on its number alone, so that a table
    does not depend on how runs are shared among processes."""
    setting, first, last = job
    red_runs = improvements = pairs = 0
    by_look = [0] * len(setting.plan.looks)
    for number in range(first, last):
        rng = random.Random(f"{setting.model} {setting.sd} {setting.effect} {number}")
        run = simulate_run(setting, rng)
        reds = run.reds()
        red_runs += bool(reds) or run.is_suite_red
        improvements += len(run.improvements())
        pairs += sum(outcome.bounds.n for outcome in run.outcomes.values())
        for name in map(str, range(setting.slow)):
            outcome = run.outcomes[name]
            if outcome.verdict == REGRESSION:
                for position, look in enumerate(setting.plan.looks):
                    by_look[position] += outcome.bounds.n <= look
    runs = last - first
    return Tally(runs, red_runs, runs * setting.slow, improvements, tuple(by_look), pairs)


def tallies(settings: Iterable[Tuple[Setting, int]], processes: int) -> List[Tally]:
    """The tally of so many runs of each setting, in that order."""
    chunk = 250
    jobs: List[Tuple[int, Tuple[Setting, int, int]]] = []
    totals: List[Tally] = []
    for position, (setting, runs) in enumerate(settings):
        totals.append(Tally(reds_by_look=(0,) * len(setting.plan.looks)))
        for first in range(0, runs, chunk):
            jobs.append((position, (setting, first, min(first + chunk, runs))))
    if processes <= 1:
        parts = map(tally, (job for _, job in jobs))
        for (position, _), part in zip(jobs, parts):
            totals[position] = totals[position].plus(part)
        return totals
    with ProcessPoolExecutor(processes) as pool:
        for (position, _), part in zip(jobs, pool.map(tally, (job for _, job in jobs))):
            totals[position] = totals[position].plus(part)
    return totals
