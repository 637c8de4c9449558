"""The measuring of a run: pairs of fresh processes, look by look, until every benchmark is decided or
the budget is spent."""

from __future__ import annotations

import time
from statistics import median
from typing import Any, Callable, Dict, List, Mapping

from ..model.config import Config
from ..model.entry import MEASURED, SKIPPED, Entry, new_entry
from ..model.time_arm import family_of, margin_for, outcomes_of
from ..model.waivers import find
from ..stats.sequential import REGRESSION, Outcome
from .program import (BY_TIME, BenchmarkError, Program, Sample, calibrate, counters_of)
from .progress import Progress
from .schedule import BLOCK, Schedule

# Of the budget, what the pairs of the looks may take; confirmation and counting take the rest.
SAMPLING_SHARE = 0.8
# At most so many regressions are measured once more, the largest first.
MOST_CONFIRMED = 8
# Longer samples than this are repeated less often in a process.
LONG_SAMPLE_S = 0.5
LONG_EPOCHS = 2


class Session:
    """Two programs, their benchmarks, and what was measured of them so far."""

    def __init__(self, base: Program, head: Program, config: Config, seed: int, floor: float,
                 progress: Progress, clock: Callable[[], float] = time.monotonic) -> None:
        self.programs = {"A": base, "B": head}
        self.config = config
        self.schedule = Schedule(seed)
        self.floor = floor
        self.progress = progress
        self.clock = clock
        self.start = clock()
        self.entries: Dict[str, Entry] = {}
        self.cost_s: Dict[str, float] = {}   # of one pair
        self.epochs: Dict[str, int] = {}
        self.notes: List[str] = []
        self.contexts: Dict[str, Mapping[str, Any]] = {}

    def elapsed(self) -> float:
        return self.clock() - self.start

    def sampling_left(self) -> float:
        return SAMPLING_SHARE * self.config.budget_s - self.elapsed()

    # -- choosing and calibrating

    def prepare(self, names: List[str]) -> None:
        """Calibrates benchmarks in random order for as long as the first look at all of them fits
        into the budget; names those that are left out."""
        first_look = self.config.looks[0]
        planned = 0.0
        self.entries = {name: new_entry(name) for name in names}
        order = self.schedule.shuffled(names)
        for number, name in enumerate(order):
            if planned > 0 and planned > self.sampling_left():
                self.leave_out(order[number:])
                break
            self.progress.show(f"calibrating {number + 1} of {len(order)}: {name}")
            planned += first_look * self.calibrate(name)

    def calibrate(self, name: str) -> float:
        """Seconds of a pair; 0 where the benchmark failed."""
        entry, base = self.entries[name], self.programs["A"]
        try:
            iterations, seconds = calibrate(base, name, self.config.sample_ms)
        except BenchmarkError as error:
            entry["error"] = str(error)
            return 0.0
        entry["iterations"] = None if base.way == BY_TIME else iterations
        # The calibrating process ran two epochs beside its setting up.
        is_long = seconds > 2 * LONG_SAMPLE_S
        self.epochs[name] = min(self.config.epochs, LONG_EPOCHS) if is_long else self.config.epochs
        sample_s = self.config.sample_ms / 1000
        self.cost_s[name] = 2 * (seconds + max(0, self.epochs[name] - 1) *
                                 (seconds / 2 if is_long else sample_s))
        return self.cost_s[name]

    def leave_out(self, names: List[str]) -> None:
        for name in names:
            self.entries[name] = new_entry(name, SKIPPED)
            self.entries[name]["error"] = "left out: the budget does not reach for a first look at it"
        self.notes.append(f"{len(names)} of {len(self.entries)} benchmarks were left out by chance: "
                          f"the first look at all takes more than the budget of "
                          f"{self.config.budget_s:g} s")

    # -- pairs

    def measure_pair(self, name: str, order: str) -> List[Any]:
        """One process of each program, in that order. Raises BenchmarkError."""
        entry = self.entries[name]
        pads = dict(zip("AB", self.schedule.pads()))
        samples: Dict[str, Sample] = {}
        for side in order:
            samples[side] = self.programs[side].sample(name, entry["iterations"] or 1,
                                                       self.epochs[name], pads[side])
        for side, key in (("A", "base"), ("B", "head")):
            self.remember(entry, key, samples[side])
        # Where each side chose its own number of iterations, the least disturbed epoch is compared.
        by_time = self.programs["A"].way == BY_TIME
        times = [min(samples[s].times_ns) if by_time else median(samples[s].times_ns) for s in "AB"]
        return [order, times[0], times[1], [samples[s].pid for s in "AB"],
                [samples[s].pad for s in "AB"], min(samples["A"].times_ns),
                min(samples["B"].times_ns)]

    def remember(self, entry: Entry, side: str, sample: Sample) -> None:
        """Keeps what does not depend on the clock: each value seen once, peaks all."""
        self.contexts.setdefault(side, sample.context)
        counters, digest = counters_of(sample)
        if entry["mem"] is None:
            entry["mem"] = {"base": {}, "head": {}}
        for key, value in counters.items():
            seen = entry["mem"][side].setdefault(key, [])
            if key == "peak_bytes" or value not in seen:
                seen.append(value)
        if digest is not None and digest not in entry["checksum"][side]:
            entry["checksum"][side].append(digest)

    def measure_block(self, name: str, into: List[Any]) -> None:
        """Two pairs, ABBA or BAAB; both are kept or none."""
        entry = self.entries[name]
        try:
            block = [self.measure_pair(name, order) for order in self.schedule.orders()]
        except BenchmarkError as error:
            entry["error"] = str(error)
            return
        into.extend(block)

    # -- looks

    def outcomes(self) -> Dict[str, Outcome]:
        entries = list(self.entries.values())
        waived = {name: find(self.config.waivers, name, "time") is not None for name in self.entries}
        family = family_of(entries, self.config, waived)
        margins = {e["name"]: margin_for(e, self.config, self.floor) for e in entries}
        return outcomes_of(entries, family, margins, self.config.plan())

    def measure(self) -> None:
        """All looks, or as many as the budget allows."""
        open_names = [name for name in self.entries if self.is_alive(name)]
        measured = 0
        for look in self.config.looks:
            while open_names and measured < look:
                cost = BLOCK * sum(self.cost_s[name] for name in open_names)
                if cost > self.sampling_left() and measured > 0:
                    self.notes.append(f"the budget of {self.config.budget_s:g} s ended the sampling "
                                      f"after {measured} pairs, with {len(open_names)} benchmarks "
                                      "open")
                    return
                for name in self.schedule.shuffled(open_names):
                    left = cost / BLOCK * (look - measured)
                    self.progress.show(f"pairs {measured + 1}-{measured + BLOCK} of {look}, "
                                       f"{len(open_names)} benchmarks: {name}", left)
                    began = self.clock()
                    self.measure_block(name, self.entries[name]["pairs"])
                    self.cost_s[name] = 0.5 * (self.cost_s[name] + (self.clock() - began) / BLOCK)
                open_names = [name for name in open_names if self.is_alive(name)]
                measured += BLOCK
            found = self.outcomes()
            open_names = [name for name in open_names if name not in found or found[name].is_open]
            if not open_names:
                return

    def is_alive(self, name: str) -> bool:
        entry = self.entries[name]
        return entry["state"] == MEASURED and entry["error"] is None

    # -- confirmation

    def confirm(self, layouts: List[Dict[str, Any]]) -> None:
        """Measures regressions once more with fresh pairs, and with both programs linked otherwise:
        `layouts` has {"name", "base", "head"} with programs."""
        found = self.outcomes()
        reds = sorted((name for name, outcome in found.items()
                       if outcome.verdict == REGRESSION and self.is_alive(name)),
                      key=lambda name: -found[name].bounds.estimate)
        for number, name in enumerate(reds):
            if number >= MOST_CONFIRMED:
                self.notes.append(f"{len(reds) - MOST_CONFIRMED} regressions of {len(reds)} were not "
                                  "measured once more: the largest were")
                break
            self.confirm_one(name, layouts)
        if reds and not layouts:
            self.notes.append("both programs were compared in one layout only: given as executables, "
                              "they cannot be linked in another order (--base-ref and --head-ref can)")

    def confirm_one(self, name: str, layouts: List[Dict[str, Any]]) -> None:
        entry = self.entries[name]
        fresh: List[Any] = []
        if self.measure_fresh(name, fresh, "once more"):
            entry["fresh"] = fresh
            for layout in layouts:
                pairs: List[Any] = []
                own = self.programs
                self.programs = {"A": layout["base"], "B": layout["head"]}
                try:
                    is_done = self.measure_fresh(name, pairs, f"in layout {layout['name']}")
                finally:
                    self.programs = own
                if is_done:
                    entry["layouts"].append({"name": layout["name"], "pairs": pairs})

    def measure_fresh(self, name: str, pairs: List[Any], how: str) -> bool:
        """Whether all pairs were measured within the budget. An error ends the benchmark."""
        while len(pairs) < self.config.confirm_pairs:
            if self.elapsed() + BLOCK * self.cost_s[name] > self.config.budget_s:
                self.notes.append(f"the budget of {self.config.budget_s:g} s left no time to measure "
                                  f"{name} {how}")
                return False
            self.progress.show(f"{name} {how}: {len(pairs)} of {self.config.confirm_pairs} pairs",
                               self.cost_s[name] * (self.config.confirm_pairs - len(pairs)))
            before = len(pairs)
            self.measure_block(name, pairs)
            if len(pairs) == before:
                return False
        return True
