"""The arm of instructions: cachegrind with caches of a fixed size, so that counts do not depend on the
machine. What a process does besides iterating drops out as the difference of two runs."""

from __future__ import annotations

import os
import pathlib
import platform
import re
import shutil
import tempfile
from typing import Any, Dict, List, Optional, Tuple

from ..model.config import Config
from ..model.entry import Entry
from ..model.names import exact_pattern
from ..model.other_arms import disagreement
from .process import run_process
from .program import BY_TIME, BenchmarkError, Program

CACHES = ["--I1=32768,8,64", "--D1=32768,8,64", "--LL=2097152,16,64"]
SLOWER = 60               # than on the processor itself, about
COUNTED_NS = 5e5          # of work that the difference should hold
MAX_ITERATIONS = 10000


def unavailable(program: Program) -> Optional[str]:
    if shutil.which("valgrind") is None:
        return "valgrind is not installed"
    if program.way == BY_TIME:
        return "the program takes no number of iterations"
    return None


def totals(path: pathlib.Path) -> Dict[str, int]:
    """The summary of a cachegrind file, by event."""
    events: List[str] = []
    if not path.exists():
        raise BenchmarkError("cachegrind wrote nothing: a script that starts the program cannot be "
                             "counted")
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith("events:"):
            events = line.split()[1:]
        if line.startswith("summary:"):
            return dict(zip(events, map(int, re.findall(r"\d+", line))))
    raise BenchmarkError("cachegrind wrote no summary")


def count(program: Program, name: str, iterations: int, timeout: float) -> Tuple[int, int]:
    """Instructions and last-level misses of a process."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "cachegrind.out"
        command = ["valgrind", "--tool=cachegrind", "--cache-sim=yes", *CACHES,
                   f"--cachegrind-out-file={out}", program.path, *program.config.arguments,
                   f"--benchmark_filter={exact_pattern(name)}", "--benchmark_format=json",
                   *program.iteration_options(iterations)]
        if shutil.which("setarch"):
            command = ["setarch", platform.machine(), "-R", *command]
        # The same environment for every process: it lies on the stack.
        environment = {key: os.environ[key] for key in ("PATH", "HOME", "LD_LIBRARY_PATH")
                       if key in os.environ}
        ended = run_process(command, timeout, {**environment, **program.config.environment})
        failure = ended.failure(timeout)
        if failure:
            raise BenchmarkError(f"the {program.side} under cachegrind {failure}")
        found = totals(out)
        return found["Ir"], sum(found.get(key, 0) for key in ("ILmr", "DLmr", "DLmw"))


def per_iteration(program: Program, name: str, more: int, timeout: float) -> Tuple[float, float]:
    few, few_misses = count(program, name, 1, timeout)
    many, many_misses = count(program, name, 1 + more, timeout)
    return (many - few) / more, max(0.0, (many_misses - few_misses) / more)


def count_entry(entry: Entry, base: Program, head: Program, base_ns: float, config: Config) -> None:
    """Counts both sides twice, and stores what was found or why it says nothing."""
    more = int(min(MAX_ITERATIONS, max(1, COUNTED_NS // max(base_ns, 1.0))))
    timeout = max(config.timeout_s, 60.0)
    found: Dict[str, Any] = {"base": [], "head": [], "base_ll": 0.0, "head_ll": 0.0, "void": None}
    try:
        for side, program in (("base", base), ("head", head)):
            for _ in range(2):
                instructions, misses = per_iteration(program, entry["name"], more, timeout)
                found[side].append(max(0.0, instructions))
                found[f"{side}_ll"] = misses
            why = disagreement(found[side])
            if why is not None:
                found["void"] = f"the {side}: {why}"
                break
    except BenchmarkError as error:
        found["void"] = str(error)
    entry["ir"] = found


def estimated_seconds(base_ns: float, process_s: float) -> float:
    """Of counting one benchmark: eight processes."""
    more = min(MAX_ITERATIONS, max(1, COUNTED_NS // max(base_ns, 1.0)))
    return 8 * (SLOWER * process_s * 0.5 + SLOWER * more * base_ns * 0.5e-9 + 1.0)
