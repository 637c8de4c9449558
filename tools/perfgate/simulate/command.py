"""`perfgate simulate`: false reds and detection, by simulation."""

from __future__ import annotations

import argparse
import json
import time
from typing import List, Tuple

from ..stats.sequential import Plan
from .noise import MODELS
from .trials import Setting, Tally, tallies

FALSE_RED_SD = 0.02
FALSE_RED_LIMIT = 0.01
# (paired sd, true change, pairs, share that must be red by then)
DETECTION = [
    (0.01, 0.05, 24, 0.95), (0.02, 0.05, 48, 0.95), (0.01, 0.03, 48, 0.70), (0.01, 0.03, 96, 0.99),
    (0.02, 0.10, 24, 0.97),
]
# AR(1) breaks what the test assumes; a run without a change may be red more often there.
ASSUMPTION_BROKEN = ("ar1",)


def false_red_rows(runs: int, effect: float, processes: int) -> List[Tuple[str, Tally]]:
    settings = [(Setting(model, FALSE_RED_SD, effect), runs) for model in MODELS]
    return list(zip(MODELS, tallies(settings, processes)))


def detection_rows(runs: int, processes: int) -> List[Tuple[Tuple[float, float, int, float], float]]:
    """One benchmark of fifty is slower; the share of runs in which it is red at that look."""
    settings = [(Setting("gaussian", sd, effect, slow=1), runs) for sd, effect, _, _ in DETECTION]
    looks = Plan().looks
    return [(row, part.reds_by_look[looks.index(row[2])] / part.benchmarks)
            for row, part in zip(DETECTION, tallies(settings, processes))]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--runs", type=int, default=10000, help="of each noise model (10000)")
    parser.add_argument("--detection-runs", type=int, default=2000, help="of each cell (2000)")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--json", action="store_true", help="one object on standard output")


def main(options: argparse.Namespace) -> int:
    start = time.monotonic()
    unchanged = false_red_rows(options.runs, 0.0, options.processes)
    detected = detection_rows(options.detection_runs, options.processes)
    failed = [model for model, part in unchanged
              if part.red_runs > FALSE_RED_LIMIT * part.runs and model not in ASSUMPTION_BROKEN]
    missed = [row for row, share in detected if share < row[3]]
    if options.json:
        print(json.dumps({
            "false_reds": {model: [part.red_runs, part.runs] for model, part in unchanged},
            "detection": [[*row, share] for row, share in detected]}, indent=1))
    else:
        print(f"no change, 50 benchmarks, paired sd {FALSE_RED_SD:.0%}, margin 2 %: runs with a red")
        for model, part in unchanged:
            pairs = part.pairs / (part.runs * 50)
            print(f"  {model:<13} {part.red_runs:>5} of {part.runs}   ({pairs:.0f} pairs a benchmark)")
        print("one of fifty slower, Gaussian noise: share of runs in which it is red")
        for (sd, effect, pairs, goal), share in detected:
            print(f"  +{effect:.0%} at sd {sd:.0%} by {pairs} pairs: {share:.1%} (goal {goal:.0%})")
        print(f"{time.monotonic() - start:.0f} s")
    return 1 if failed or missed else 0
