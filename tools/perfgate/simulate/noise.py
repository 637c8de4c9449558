"""Models of what a host does to paired times. Each is an endless series of log ratios, pair by pair.

A pair is two processes run one after the other, in blocks of two pairs ABBA or BAAB. Models of what
changes with time give each process its place in that order; the others draw the ratio itself. `sd` is
the scale of the ratio's noise, `effect` the true log ratio.
"""

from __future__ import annotations

import math
import random
from typing import Callable, Dict, Iterator, Tuple

Model = Callable[[random.Random, float, float], Iterator[float]]

HALF = math.sqrt(0.5)  # noise of a process, when that of a ratio of two is 1


def places(rng: random.Random) -> Iterator[Tuple[int, int]]:
    """The places in time of base and head in each pair."""
    start = 0
    while True:
        base_first = rng.random() < 0.5
        yield (start, start + 1) if base_first else (start + 1, start)
        yield (start + 3, start + 2) if base_first else (start + 2, start + 3)
        start += 4


def gaussian(rng: random.Random, sd: float, effect: float) -> Iterator[float]:
    gauss = rng.gauss
    while True:
        yield gauss(effect, sd)


def log_normal(rng: random.Random, sd: float, effect: float) -> Iterator[float]:
    """Delays that are never negative and sometimes long, on both sides."""
    gauss, exp, log1p = rng.gauss, math.exp, math.log1p
    scale = 0.6 * sd
    while True:
        base, head = scale * exp(gauss(0.0, 1.0)), scale * exp(gauss(0.0, 1.0))
        yield effect + log1p(head) - log1p(base)


def spikes(rng: random.Random, sd: float, effect: float) -> Iterator[float]:
    """One pair in ten is off by five deviations on average, either way."""
    gauss, uniform = rng.gauss, rng.random
    while True:
        value = gauss(effect, sd)
        if uniform() < 0.1:
            value += 5 * sd * rng.expovariate(1.0) * (1 if uniform() < 0.5 else -1)
        yield value


def linear_drift(rng: random.Random, sd: float, effect: float) -> Iterator[float]:
    """The host becomes slower or faster by up to one deviation a process."""
    slope = rng.uniform(-sd, sd)
    for base, head in places(rng):
        yield effect + slope * (head - base) + rng.gauss(0.0, sd)


def periodic(rng: random.Random, sd: float, effect: float) -> Iterator[float]:
    """A neighbour that comes and goes: two deviations up and down, every 3 to 40 processes."""
    rate = 2 * math.pi / rng.uniform(3.0, 40.0)
    phase = rng.uniform(0.0, 2 * math.pi)
    for base, head in places(rng):
        wave = math.sin(rate * head + phase) - math.sin(rate * base + phase)
        yield effect + 2 * sd * wave + rng.gauss(0.0, sd)


def autoregressive(rng: random.Random, sd: float, effect: float) -> Iterator[float]:
    """AR(1), rho = 0.3, in the ratios themselves: neighbouring pairs err alike, which no test that
    counts pairs allows for."""
    rho = 0.3
    fresh = sd * math.sqrt(1.0 - rho * rho)
    gauss = rng.gauss
    error = gauss(0.0, sd)
    while True:
        yield effect + error
        error = rho * error + gauss(0.0, fresh)


def bimodal(rng: random.Random, sd: float, effect: float) -> Iterator[float]:
    """Each process runs fast or, three times in ten, four deviations slower, as layouts of memory
    have it."""
    uniform, gauss = rng.random, rng.gauss
    while True:
        yield effect + 4 * sd * ((uniform() < 0.3) - (uniform() < 0.3)) + gauss(0.0, sd)


def ticks(rng: random.Random, sd: float, effect: float) -> Iterator[float]:
    """Times of 100 us read from a clock of 1 us: many pairs tie."""
    gauss, exp, log = rng.gauss, math.exp, math.log
    scale = sd * HALF
    while True:
        base, head = exp(gauss(0.0, scale)), exp(gauss(effect, scale))
        yield log(round(100 * head) / round(100 * base))


MODELS: Dict[str, Model] = {
    "gaussian": gaussian, "log-normal": log_normal, "spikes": spikes, "linear-drift": linear_drift,
    "periodic": periodic, "ar1": autoregressive, "bimodal": bimodal, "ticks": ticks,
}
