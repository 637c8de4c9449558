"""One of the two programs that are compared, and how it takes a number of iterations."""

from __future__ import annotations

import os
import pathlib
import platform
import random
import re
import shutil
from dataclasses import dataclass
from typing import Dict, List, Mapping, Optional, Tuple

from ..errors import BROKEN, GateError, UNFIT, usage
from ..model.config import Config
from ..model.google_json import Document, Row, parse
from ..model.names import exact_pattern
from .process import Finished, run_process

# Ways to ask for a number of iterations, best first.
FIXED = "--fixed-iterations N"
TIMES = "--benchmark_min_time=Nx"     # Google Benchmark from 1.8 on
BY_TIME = "--benchmark_min_time"      # a time only: each side chooses its own number
WAYS = (FIXED, TIMES, BY_TIME)
MAX_PAD_BYTES = 4096
MAX_ITERATIONS = 1_000_000_000


class BenchmarkError(Exception):
    """One benchmark gave no time; the others may."""


@dataclass(frozen=True)
class Sample:
    """What one process said of one benchmark."""

    times_ns: Tuple[float, ...]  # of each epoch, without the first, which warms up
    iterations: int
    counters: Mapping[str, float]
    pid: int
    pad: int
    seconds: float               # that the whole process took
    peak_bytes: int
    context: Mapping[str, object]


class Program:
    """Side "base" or "head"."""

    def __init__(self, side: str, path: str, config: Config) -> None:
        self.side = side
        self.path = str(pathlib.Path(path).resolve())
        self.config = config
        self.way = FIXED
        if not os.path.isfile(self.path):
            raise usage(f"--{side} {path}: no such file")
        if not os.access(self.path, os.X_OK):
            raise usage(f"--{side} {path}: not executable")

    def command(self, options: List[str]) -> List[str]:
        prefix: List[str] = []
        if not self.config.aslr and shutil.which("setarch"):
            prefix = ["setarch", platform.machine(), "-R"]
        return [*prefix, self.path, *self.config.arguments, *options]

    def start(self, options: List[str], pad: int = 0) -> Finished:
        environment = {**os.environ, **self.config.environment, "PERFGATE_PAD": "x" * pad}
        try:
            return run_process(self.command(options), self.config.timeout_s, environment)
        except OSError as error:
            raise GateError(BROKEN, f"{self.path}: cannot be started: {error.strerror}") from None

    def names(self) -> List[str]:
        """What the program lists, in its order, each once."""
        ended = self.start(["--benchmark_list_tests=true"])
        failure = ended.failure(self.config.timeout_s)
        if failure:
            raise GateError(BROKEN, f"{self.path} --benchmark_list_tests=true {failure}")
        lines = [line.strip() for line in ended.stdout.splitlines() if line.strip()]
        if not lines:
            raise GateError(BROKEN, f"{self.path} lists no benchmarks")
        return list(dict.fromkeys(lines))

    def iteration_options(self, iterations: int) -> List[str]:
        if self.way == FIXED:
            return ["--fixed-iterations", str(iterations)]
        if self.way == TIMES:
            return [f"--benchmark_min_time={iterations}x"]
        return [f"--benchmark_min_time={self.config.sample_ms / 1000:g}"]

    def sample(self, name: str, iterations: int, epochs: int, pad: int) -> Sample:
        """One fresh process. BenchmarkError where it fails, or says nothing of this benchmark."""
        ended = self.start([f"--benchmark_filter={exact_pattern(name)}", "--benchmark_format=json",
                            f"--benchmark_repetitions={epochs + 1}",
                            *self.iteration_options(iterations)], pad)
        failure = ended.failure(self.config.timeout_s)
        if failure:
            raise BenchmarkError(f"the {self.side} {failure}")
        try:
            document = parse(ended.stdout, f"the {self.side}'s output")
        except GateError as error:
            if error.code == UNFIT:
                raise
            raise BenchmarkError(str(error)) from None
        rows = self.rows_of(document, name)
        kept = rows[1:] if len(rows) > 1 else rows
        if self.way != BY_TIME and any(row.iterations != iterations for row in rows):
            raise BenchmarkError(f"the {self.side} ran {rows[0].iterations} iterations instead of "
                                 f"{iterations}")
        times = [row.metric(self.config.metric) for row in kept]
        if any(value is None for value in times):
            raise BenchmarkError(f"the {self.side} has no counter {self.config.metric!r}")
        return Sample(tuple(value for value in times if value is not None), kept[0].iterations,
                      kept[-1].counters, ended.pid, pad, ended.seconds, ended.peak_bytes,
                      document.context)

    def rows_of(self, document: Document, name: str) -> List[Row]:
        rows = document.by_name().get(name, [])
        if not rows:
            others = ", ".join(list(document.by_name())[:3]) or "nothing"
            raise BenchmarkError(f"the {self.side} has no row of that name (it has {others})")
        for row in rows:
            if row.error is not None:
                raise BenchmarkError(f"the {self.side} says: {row.error}")
        return rows


def detect_way(programs: List[Program], names: List[str]) -> str:
    """The best way that all programs follow, tried on the first benchmark that runs at all."""
    for way in WAYS:
        for program in programs:
            program.way = way
        if way == BY_TIME or any(all(follows(p, name) for p in programs) for name in names[:3]):
            return way
    return BY_TIME


def follows(program: Program, name: str) -> bool:
    """Whether the program runs exactly as many iterations as it is told."""
    try:
        return program.sample(name, 2, 1, 0).iterations == 2
    except BenchmarkError:
        return False


def calibrate(program: Program, name: str, sample_ms: float) -> Tuple[int, float]:
    """How many iterations take a sample's time, and seconds of a process at that; counted on the base
    and used on both sides."""
    iterations, seconds = 1, 0.0
    for _ in range(6):
        sample = program.sample(name, iterations, 1, 0)
        seconds = sample.seconds
        if program.way == BY_TIME:
            break
        each = max(min(sample.times_ns), 0.1)
        enough = min(MAX_ITERATIONS, max(1, -int(-sample_ms * 1e6 // each)))
        if enough <= 1.5 * iterations:
            iterations = max(iterations, enough) if iterations > 1 else enough
            break
        # A first iteration is slow, so the next guess may be too low, never far too high.
        iterations = min(enough, 100 * iterations)
    return iterations, seconds


def random_pad(rng: random.Random) -> int:
    """Bytes of environment: they move the stack, whose place is then sampled instead of fixed."""
    return rng.randrange(0, MAX_PAD_BYTES + 1)


def comparable(value: object) -> object:
    """Flags without those that give files the same names in builds of different folders."""
    if not isinstance(value, str):
        return value
    return " ".join(re.sub(r"-f(file|macro|debug)-prefix-map=\S*", "", value).split())


def contexts_differ(base: Mapping[str, object], head: Mapping[str, object],
                    keys: List[str]) -> List[str]:
    return [f"{key}: {base[key]!r} and {head[key]!r}" for key in keys
            if None not in (base.get(key), head.get(key)) and
            comparable(base[key]) != comparable(head[key])]


def counters_of(sample: Sample) -> Tuple[Dict[str, float], Optional[str]]:
    """The counters of the memory arm, and the checksum as 16 hex digits if there is one."""
    counters = {key: sample.counters[key] for key in ("allocs", "alloc_bytes", "bytes_per_halfedge")
                if key in sample.counters}
    counters["peak_bytes"] = sample.counters.get("peak_bytes", float(sample.peak_bytes))
    high, low = sample.counters.get("digest_hi"), sample.counters.get("digest_lo")
    if high is None or low is None:
        return counters, None
    return counters, f"{(int(high) << 32) + int(low):016x}"
