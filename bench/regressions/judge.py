"""The arms of the gate, each as (base, head, rows) -> (finding, whether it is a regression)."""

import json
import math
import os
import re
import statistics
import subprocess

import count as counting
import limits

MARGIN = 0.02
INSTRUCTION_MARGIN = 0.01
MEMORY = ("allocs", "alloc_bytes", "bytes_per_halfedge")
SAMPLE_NS = 20e6
# Of so many pairs the third smallest ratio lies above the true one once in 10,000 runs.
PAIRS = 24
RANK = 3


class RowsError(ValueError):
    """The two programs do not have the same rows, or none of that name."""


def rows_of(program, pattern, iterations):
    ran = subprocess.run([program, f"--benchmark_filter={pattern}", "--benchmark_format=json",
                          f"--fixed-iterations={iterations}"], check=True, stdout=subprocess.PIPE,
                         stderr=subprocess.DEVNULL, env={**os.environ, "HEDGEROW_SIMD": "avx2"})
    return {row["name"]: row for row in json.loads(ran.stdout)["benchmarks"]}


def pairs_of(base, head, pattern):
    before, after = rows_of(base, pattern, 1), rows_of(head, pattern, 1)
    if not before or set(before) != set(after):
        raise RowsError(f"the rows {sorted(before)} before and {sorted(after)} after")
    return [(name, before[name], after[name]) for name in before]


def memory(base, head, pattern):
    for name, before, after in pairs_of(base, head, pattern):
        more = [f"{key} {before[key]:.6g} to {after[key]:.6g}" for key in MEMORY
                if after.get(key, 0) > before.get(key, 0)]
        if more:
            return f"{name}: {', '.join(more)}", True
    return "no more memory", False


def result(base, head, pattern):
    for name, before, after in pairs_of(base, head, pattern):
        if [before[half] for half in ("digest_hi", "digest_lo")] != \
                [after[half] for half in ("digest_hi", "digest_lo")]:
            return f"{name}: another answer", True
    return "the same answers", False


def instructions(base, head, pattern):
    pattern = re.sub(r"/(L1|L2|LLC|DRAM)\$$", "$", pattern)  # what is counted bears no class
    counted = [counting.count(str(program), pattern, "avx2", [], limits.CACHES)
               for program in (base, head)]
    if not counted[0] or len(counted[0]) != len(counted[1]):
        raise RowsError(f"{len(counted[0])} rows counted before, {len(counted[1])} after")
    finding = ""
    for before, after in zip(*counted):
        change = after["instructions"] / before["instructions"] - 1
        finding = f"{before['operation']}/{before['dataset']}: {change:+.1%} instructions"
        if change > INSTRUCTION_MARGIN:
            return finding, True
    return finding, False


def time(base, head, pattern):
    """Pairs of fresh processes in the order ABBA; the sign test's lower bound above the margin."""
    def sample(program, iterations):
        # Time of the processor: other programs take turns with this one, too.
        rows = list(rows_of(program, pattern, iterations).values())
        if len(rows) != 1:
            raise RowsError(f"{len(rows)} rows are called {pattern}; one is timed at a time")
        return rows[0]["processor_ns"]

    iterations = max(1, math.ceil(SAMPLE_NS / sample(base, 3)))
    ratios = []
    for i in range(PAIRS):
        order = (base, head) if i % 4 in (0, 3) else (head, base)
        times = {program: sample(program, iterations) for program in order}
        ratios.append(times[head] / times[base])
    bound = sorted(ratios)[RANK - 1]
    finding = f"{statistics.median(ratios) - 1:+.1%} time, at least {bound - 1:+.1%}"
    return finding, bound > 1 + MARGIN


ARMS = {"time": time, "instructions": instructions, "memory": memory, "result": result}
