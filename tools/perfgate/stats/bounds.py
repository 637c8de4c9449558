"""Median, spread, and distribution-free bounds of a median."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Optional, Sequence

from .binomial import order_index, upper_tail

# The median absolute deviation of a normal distribution, times this, is its standard deviation.
NORMAL_MAD = 1.4826


def median_of_sorted(ordered: Sequence[float]) -> float:
    n = len(ordered)
    middle = n // 2
    return ordered[middle] if n % 2 else 0.5 * (ordered[middle - 1] + ordered[middle])


def mad(values: Sequence[float]) -> float:
    """Median absolute deviation from the median."""
    center = median_of_sorted(sorted(values))
    return median_of_sorted(sorted(abs(value - center) for value in values))


def robust_sd(values: Sequence[float]) -> float:
    return NORMAL_MAD * mad(values)


def log_ratio(base: float, head: float) -> Optional[float]:
    """ln(head / base); None for a pair with a zero on either side, which says nothing."""
    return math.log(head / base) if base > 0 and head > 0 else None


@dataclass(frozen=True)
class Bounds:
    """What n paired log ratios say about their median."""

    n: int
    k: int                       # rank of `lower` from below and of `upper` from above; 0: no bound
    alpha: float                 # chance of each of the two bounds to be wrong, at most
    ties: int                    # pairs with the same time on both sides
    estimate: float              # the median
    lower: Optional[float]
    upper: Optional[float]
    pass_lower: Optional[float]  # the same at the level of the passing rule
    pass_upper: Optional[float]


def bounds_of(values: Sequence[float], alpha: float, pass_alpha: float) -> Optional[Bounds]:
    """None for no values. Values in any order."""
    if not values:
        return None
    ordered = sorted(values)
    n = len(ordered)
    k = order_index(n, alpha)
    loose = order_index(n, pass_alpha)
    return Bounds(n=n, k=k, alpha=alpha, ties=sum(1 for value in ordered if value == 0.0),
                  estimate=median_of_sorted(ordered),
                  lower=ordered[k - 1] if k else None,
                  upper=ordered[n - k] if k else None,
                  pass_lower=ordered[loose - 1] if loose else None,
                  pass_upper=ordered[n - loose] if loose else None)


def sign_p_value(values: Sequence[float], threshold: float) -> Fraction:
    """The exact one-sided p-value of "the median is at most `threshold`": the lower bound of level
    alpha exceeds the threshold exactly when this is alpha or less. A value equal to the threshold
    speaks for it."""
    n = len(values)
    return upper_tail(n, sum(1 for value in values if value > threshold))


def detectable(bounds: Optional[Bounds], margin: float) -> Optional[float]:
    """The slowdown, as a log ratio, that these values would have shown with about even odds: the one
    whose lower bound, as far below its estimate as here, just reaches the margin. None: no size."""
    if bounds is None or bounds.lower is None:
        return None
    return margin + bounds.estimate - bounds.lower
