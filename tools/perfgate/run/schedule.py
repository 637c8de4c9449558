"""Who runs when: everything random in a run comes from its seed, in a fixed order."""

from __future__ import annotations

import random
from typing import List, Sequence, Tuple

from .program import random_pad

BLOCK = 2  # pairs


class Schedule:
    """ABBA and BAAB cancel what drifts steadily; which of the two comes is drawn, so that nothing
    periodic keeps step with it."""

    def __init__(self, seed: int) -> None:
        self.rng = random.Random(seed)

    def shuffled(self, names: Sequence[str]) -> List[str]:
        drawn = list(names)
        self.rng.shuffle(drawn)
        return drawn

    def orders(self) -> Tuple[str, str]:
        """The orders of the two pairs of a block."""
        return ("AB", "BA") if self.rng.random() < 0.5 else ("BA", "AB")

    def pads(self) -> Tuple[int, int]:
        """Environment padding for base and head of one pair."""
        return random_pad(self.rng), random_pad(self.rng)
