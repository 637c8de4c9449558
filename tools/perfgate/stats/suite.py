"""The mean of a suite: many small slowdowns that no benchmark proves alone."""

from __future__ import annotations

from typing import List, Mapping, Optional, Sequence

from .bounds import Bounds, bounds_of


def round_means(rounds: Mapping[str, Sequence[Optional[float]]]) -> List[float]:
    """The mean log ratio of all benchmarks in each round that all of them took part in. `rounds` holds
    one entry a round for each benchmark; None for a pair that was dropped."""
    if not rounds:
        return []
    together = zip(*rounds.values())  # stops with the benchmark that stopped first
    return [sum(values) / len(values) for values in together
            if not any(value is None for value in values)]


def suite_bounds(rounds: Mapping[str, Sequence[Optional[float]]], alpha: float,
                 pass_alpha: float) -> Optional[Bounds]:
    """Bounds of the median over rounds of that mean. Rounds are what is independent, not benchmarks:
    whatever disturbs all benchmarks of one round counts once."""
    return bounds_of(round_means(rounds), alpha, pass_alpha)
