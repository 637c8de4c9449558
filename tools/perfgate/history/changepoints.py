"""Where a series of times changed for good.

The split that sets two parts apart most, by ranks (Pettitt, Applied Statistics 28, 1979), is kept if
shuffled series are rarely split as well; then both parts are searched. Many small steps, of which none
is ever proven against its neighbour, show here as one.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import List, Sequence, Tuple

from ..stats.bounds import median_of_sorted

ALPHA = 0.01
SHUFFLES = 999
LEAST_PART = 3   # values on each side


@dataclass(frozen=True)
class Change:
    """Between `index - 1` and `index` of a series."""

    index: int
    before: float  # medians
    after: float
    p_value: float

    @property
    def ratio(self) -> float:
        return self.after / self.before


def median(values: Sequence[float]) -> float:
    return median_of_sorted(sorted(values))


def ranks(values: Sequence[float]) -> List[float]:
    """From 1; equal values share the mean of theirs."""
    order = sorted(range(len(values)), key=lambda i: values[i])
    found = [0.0] * len(values)
    start = 0
    while start < len(order):
        end = start
        while end < len(order) and values[order[end]] == values[order[start]]:
            end += 1
        for i in order[start:end]:
            found[i] = 0.5 * (start + 1 + end)
        start = end
    return found


def best_split(ranked: Sequence[float]) -> Tuple[float, int]:
    """The largest distance of a sum of ranks from what chance gives, in deviations, and where."""
    n = len(ranked)
    best, place, total = 0.0, 0, 0.0
    for i in range(1, n - LEAST_PART + 1):
        total += ranked[i - 1]
        if i < LEAST_PART:
            continue
        deviation = math.sqrt(i * (n - i) * (n + 1) / 12.0)
        distance = abs(total - i * (n + 1) / 2.0) / deviation
        if distance > best:
            best, place = distance, i
    return best, place


def changes(values: Sequence[float], seed: int = 1) -> List[Change]:
    """All changes of a series, from left to right. Seeded: the same series gives the same."""
    found: List[Change] = []
    search(list(values), 0, len(values), random.Random(seed), found)
    edges = [0, *sorted(change.index for change in found), len(values)]
    by_index = {change.index: change for change in found}
    return [Change(at, median(values[left:at]), median(values[at:right]), by_index[at].p_value)
            for left, at, right in zip(edges, edges[1:], edges[2:])]


def search(values: List[float], left: int, right: int, rng: random.Random,
           found: List[Change]) -> None:
    if right - left < 2 * LEAST_PART:
        return
    ranked = ranks(values[left:right])
    distance, place = best_split(ranked)
    if place == 0:
        return
    as_far = 0
    for _ in range(SHUFFLES):
        rng.shuffle(ranked)
        as_far += best_split(ranked)[0] >= distance
    p_value = (1 + as_far) / (1 + SHUFFLES)
    if p_value > ALPHA:
        return
    middle = left + place
    found.append(Change(middle, 0.0, 0.0, p_value))
    search(values, left, middle, rng, found)
    search(values, middle, right, rng, found)
