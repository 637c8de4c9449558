"""How noisy the host is: three fixed kernels, run in C by the interpreter, timed in pairs."""

from __future__ import annotations

import hashlib
import time
from typing import Callable, Dict, List, Tuple

from ..stats.bounds import log_ratio, robust_sd

L2_BYTES = 192 * 1024
DRAM_BYTES = 64 * 1024 * 1024
SAMPLE_SECONDS = 0.02


def alu() -> Callable[[], object]:
    """SHA-256 of one kilobyte, over and over: arithmetic in registers."""
    block = bytes(range(256)) * 4

    def work() -> object:
        found = hashlib.sha256()
        for _ in range(64):
            found.update(block)
        return found.digest()
    return work


def second_level() -> Callable[[], object]:
    """Copies within what a second-level cache holds."""
    source, target = bytearray(b"x" * (L2_BYTES // 2)), bytearray(L2_BYTES // 2)

    def work() -> object:
        for _ in range(8):
            target[:] = source
        return target
    return work


def dram() -> Callable[[], object]:
    """Copies of more than any cache holds."""
    source, target = bytearray(b"x" * (DRAM_BYTES // 2)), bytearray(DRAM_BYTES // 2)

    def work() -> object:
        target[:] = source
        return target
    return work


KERNELS: List[Tuple[str, Callable[[], Callable[[], object]]]] = [
    ("alu_sd", alu), ("l2_sd", second_level), ("dram_sd", dram)]


def times_of(work: Callable[[], object], seconds: float) -> List[float]:
    """Times of samples of equal work, for so many seconds; at least 8."""
    start = time.perf_counter()
    work()
    count = max(1, round(SAMPLE_SECONDS / max(time.perf_counter() - start, 1e-7)))
    times: List[float] = []
    end = time.perf_counter() + seconds
    while len(times) < 8 or time.perf_counter() < end:
        start = time.perf_counter()
        for _ in range(count):
            work()
        times.append(time.perf_counter() - start)
    return times


def paired_sd(times: List[float]) -> float:
    """The deviation of the log ratio of two samples in a row."""
    ratios = [log_ratio(a, b) for a, b in zip(times[::2], times[1::2])]
    return robust_sd([value for value in ratios if value is not None])


def probe(seconds: float) -> Dict[str, float]:
    """The paired deviation of each kernel."""
    return {name: round(paired_sd(times_of(make(), seconds / len(KERNELS))), 5)
            for name, make in KERNELS}
