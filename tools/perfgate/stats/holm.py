"""Family-wise error over several tests: Holm's step-down form of Bonferroni's rule."""

from __future__ import annotations

from fractions import Fraction
from typing import List, Sequence


def holm_levels(p_values: Sequence[Fraction], alpha: float, family: int) -> List[float]:
    """The level that each test is judged at, so that a test is rejected exactly when its p-value is
    at most its level, and the chance of any wrong rejection among `family` tests is at most alpha.

    The smallest p-value is held to alpha / family; each rejection takes one test out of the family
    for the next; the first that stays, stays with all above it. Tests of the family that are not in
    `p_values` count as not rejected. (Holm, Scandinavian Journal of Statistics 6, 1979.)
    """
    levels = [alpha / family] * len(p_values)
    if not p_values or min(p_values) > Fraction(alpha / family):
        return levels
    rejected = 0
    for position in sorted(range(len(p_values)), key=lambda i: p_values[i]):
        level = alpha / (family - rejected)
        levels[position] = level
        if p_values[position] > Fraction(level):
            break
        rejected += 1
    # Those that stay are all judged at the level where the procedure came to rest.
    resting = alpha / max(1, family - rejected)
    return [level if p_value <= Fraction(level) else resting
            for p_value, level in zip(p_values, levels)]
