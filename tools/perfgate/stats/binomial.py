"""Tails of the binomial distribution with p = 1/2, exactly: integers and fractions, no rounding."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from math import comb


@lru_cache(maxsize=None)
def lower_tail(n: int, k: int) -> Fraction:
    """P(X <= k) for X ~ Binomial(n, 1/2)."""
    if k < 0:
        return Fraction(0)
    return Fraction(sum(comb(n, i) for i in range(min(k, n) + 1)), 2**n)


def upper_tail(n: int, k: int) -> Fraction:
    """P(X >= k)."""
    return lower_tail(n, n - k)


@lru_cache(maxsize=None)
def order_index(n: int, alpha: float) -> int:
    """The largest k for which the k-th smallest of n values (k counts from 1) is a lower bound of the
    median that is wrong with probability alpha at most; 0 if none is, because n is too small.

    The k-th smallest exceeds the median only if fewer than k of the values lie at or below it:
    P(X <= k - 1). By symmetry the k-th largest is the upper bound. (David and Nagaraja, Order
    Statistics, section 7.1.)
    """
    numerator, denominator = alpha.as_integer_ratio()
    limit = numerator * 2**n
    choices = denominator  # C(n, k) times the denominator
    cumulated = choices
    k = 0
    while k < n and cumulated <= limit:
        choices = choices * (n - k) // (k + 1)
        cumulated += choices
        k += 1
    return k


def smallest_n(alpha: float) -> int:
    """How many values it takes before any bound exists: the least n with 2^-n <= alpha."""
    n = 1
    while order_index(n, alpha) == 0:
        n += 1
    return n


def most_tests(n: int, alpha_run: float, looks: int) -> int:
    """How many tests a run may share `alpha_run` among before no bound exists at `n` values: with one
    more, no red is possible at a look of that size."""
    return int(Fraction(alpha_run) * 2**n / looks)
