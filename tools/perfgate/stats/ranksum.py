"""Bounds for samples that were not taken in pairs: weaker, because both sides then carry the drift of
the host, and because it takes two distributions of the same shape to speak of one ratio."""

from __future__ import annotations

import math
from functools import lru_cache
from statistics import NormalDist
from typing import List, Optional, Sequence, Tuple

from .bounds import Bounds, median_of_sorted

# Up to this product of the sample sizes the distribution is counted; above, the normal one is within
# a rank of it.
EXACT_PRODUCT = 2500


@lru_cache(maxsize=None)
def rank_sum_counts(m: int, n: int) -> Tuple[int, ...]:
    """How many of the C(m + n, m) orders of two samples have u pairs in which the second is smaller,
    for u = 0..mn: the coefficients of the Gaussian binomial, a product of (1 - q^(n+i)) / (1 - q^i).
    (Mann and Whitney, Annals of Mathematical Statistics 18, 1947.)"""
    size = m * n + 1
    counts = [1] + [0] * (size - 1)
    for i in range(1, m + 1):
        for u in range(size - 1, n + i - 1, -1):
            counts[u] -= counts[u - n - i]
        for u in range(i, size):
            counts[u] += counts[u - i]
    return tuple(counts)


def rank_sum_index(m: int, n: int, alpha: float) -> int:
    """The largest k for which the k-th smallest of the mn differences is a lower bound of the shift
    that is wrong with probability alpha at most; 0 if none is."""
    if m * n > EXACT_PRODUCT:
        spread = math.sqrt(m * n * (m + n + 1) / 12.0)
        return max(0, math.floor(m * n / 2.0 + NormalDist().inv_cdf(alpha) * spread - 0.5))
    limit = alpha * math.comb(m + n, m)
    cumulated = 0
    for k, count in enumerate(rank_sum_counts(m, n)):
        cumulated += count
        if cumulated > limit:
            return k
    return m * n


def unpaired_bounds(base: Sequence[float], head: Sequence[float], alpha: float,
                    pass_alpha: float) -> Optional[Bounds]:
    """The same as `bounds_of`, from times that have no partner: Hodges and Lehmann's estimate of the
    log ratio and its interval. `n` is the size of the smaller sample. Zeros are dropped."""
    log_base = [math.log(value) for value in base if value > 0]
    log_head = [math.log(value) for value in head if value > 0]
    m, n = len(log_base), len(log_head)
    if m == 0 or n == 0:
        return None
    shifts: List[float] = sorted(h - b for h in log_head for b in log_base)
    k, loose = (rank_sum_index(m, n, level) for level in (alpha, pass_alpha))
    return Bounds(n=min(m, n), k=k, alpha=alpha, ties=sum(1 for shift in shifts if shift == 0.0),
                  estimate=median_of_sorted(shifts),
                  lower=shifts[k - 1] if k else None,
                  upper=shifts[len(shifts) - k] if k else None,
                  pass_lower=shifts[loose - 1] if loose else None,
                  pass_upper=shifts[len(shifts) - loose] if loose else None)
