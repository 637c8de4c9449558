"""How large a change must be before it counts."""

from __future__ import annotations

import math
from typing import Optional

# A change within three deviations of what a benchmark does against itself is its own noise.
NOISE_FACTOR = 3.0


def margin_of(configured: float, own_mad: Optional[float], min_effect_ns: float,
              base_ns: Optional[float]) -> float:
    """The margin as a log ratio: the largest of the configured share (0.02 is 2 %), three times the
    benchmark's deviation against itself on this class of host, and the least time worth a word."""
    # Not log1p: a time of 102 for one of 100 is no more than 2 %, so both are rounded alike.
    margin = math.log(1.0 + configured)
    if own_mad is not None:
        margin = max(margin, NOISE_FACTOR * own_mad)
    if min_effect_ns > 0 and base_ns is not None and base_ns > 0:
        margin = max(margin, math.log1p(min_effect_ns / base_ns))
    return margin
