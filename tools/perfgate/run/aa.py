"""Compare a program with itself, run after run: how often the gate is wrong here, and the noise of each
benchmark, from which its margin may follow (configuration: calibration).

With --other, another build of the same commit takes the place of the head; such runs are counted
apart, since two builds may differ where no source does.

Example: perfgate aa --exe build/bench --runs 20 --calibration calibration.json
"""

from __future__ import annotations

import argparse
import datetime
import pathlib
import sys
from typing import Any, Dict, List

from .. import SCHEMA, __version__
from ..errors import GateError, USAGE, usage
from ..model.config import CHECKS, Config
from ..model.config_file import read_config
from ..model.entry import ratios
from ..model.headline import percent
from ..model.jsonio import dumps, read, write_text
from ..model.report import RAW_KEYS, judge
from ..stats.bounds import mad, robust_sd
from ..stats.margins import NOISE_FACTOR
from .calibration import check
from .compare import compare
from .lock import HostLock
from .process import raise_on_signals

RED_LIMIT = 0.01  # of all runs


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--exe", required=True, help="the program")
    parser.add_argument("--other", help="another build of the same commit")
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--config", help="a .toml or .json file")
    parser.add_argument("--filter", help="only benchmarks with such a name")
    parser.add_argument("--budget", type=float, help="seconds of one run")
    parser.add_argument("--seed", type=int, default=1, help="of the first run; the others count on")
    parser.add_argument("--calibration", type=pathlib.Path, default=pathlib.Path("calibration.json"),
                        help="the file to write; one that is there is continued")
    parser.add_argument("--no-probe", action="store_true")
    parser.add_argument("--no-progress", action="store_true")


def configured(options: argparse.Namespace) -> Config:
    config = read_config(options.config) if options.config else Config()
    for key, value in (("filter", options.filter), ("budget_s", options.budget)):
        if value is not None:
            setattr(config, key, CHECKS[key](f"--{key.partition('_')[0]}", value))
    if options.runs < 1:
        raise usage(f"--runs is {options.runs}; at least one is wanted")
    return config


def one_run(options: argparse.Namespace, config: Config, number: int) -> Dict[str, Any]:
    """The report of one whole run of the gate."""
    config.seed = options.seed + number
    started = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    raw = {**RAW_KEYS, "seed": config.seed, "started": started, "is_aa": True,
           "config": config.as_dict(), "notes": [], "benchmarks": [], "base": {}, "head": {}}
    as_run = argparse.Namespace(
        base=[options.exe], head=[options.other or options.exe], base_ref=None, head_ref=None,
        exact_base=False, out=pathlib.Path("."), quick=False, strict=False, aa=True,
        no_probe=options.no_probe or number > 0, no_progress=options.no_progress)
    compare(raw, as_run, config)
    return judge(raw)


def red_names(report: Dict[str, Any]) -> List[str]:
    """What was red before any confirmation: the stricter count."""
    return [row["name"] for row in report["benchmarks"] if row["confirmation"] is not None] + \
        [f"suite {suite['name']}" for suite in report["suites"] if suite["is_red"]]


def pooled(old: Dict[str, Any], values: List[float]) -> Dict[str, Any]:
    """The row of a benchmark after more pairs: deviations weighted by their numbers of pairs."""
    pairs, before = len(values), old.get("pairs", 0)
    total = pairs + before

    def merged(key: str, value: float) -> float:
        return round((value * pairs + old.get(key, 0.0) * before) / total, 6)

    row = {"pairs": total, "mad": merged("mad", mad(values)), "sd": merged("sd", robust_sd(values)),
           "tie_rate": merged("tie_rate", sum(1 for v in values if v == 0.0) / pairs)}
    row["recommended_margin"] = round(NOISE_FACTOR * row["mad"], 6)
    return row


def start_document(path: pathlib.Path, host: str) -> Dict[str, Any]:
    empty = {"schema": SCHEMA, "tool": f"perfgate {__version__}", "host_class": host,
             "same_program": {"runs": 0, "red_runs": 0}, "separate_builds": {"runs": 0, "red_runs": 0},
             "benchmarks": {}}
    if not path.exists():
        return empty
    document = check(read(path), str(path))
    if document.get("host_class") != host:
        raise GateError(USAGE, f"{path} is for {document.get('host_class')!r}, this host is {host!r}")
    return {**empty, **document}


def main(options: argparse.Namespace) -> int:
    config = configured(options)
    raise_on_signals()
    document: Dict[str, Any] = {}
    count = "separate_builds" if options.other else "same_program"
    with HostLock():
        for number in range(options.runs):
            report = one_run(options, config, number)
            if report["verdict"] in ("ERROR", "INTERRUPTED"):
                print(report["headline"])
                return int(report["exit"])
            if not document:
                document = start_document(options.calibration, report["host"]["class"])
            reds = red_names(report)
            document[count]["runs"] += 1
            document[count]["red_runs"] += bool(reds)
            for row in report["benchmarks"]:
                known = [value for value in ratios(row["pairs"]) if value is not None]
                if known:
                    old = document["benchmarks"].get(row["name"], {})
                    document["benchmarks"][row["name"]] = pooled(old, known)
            # After each run: what is measured is not lost with the process.
            write_text(options.calibration, dumps(document))
            print(f"run {number + 1} of {options.runs}, seed {config.seed}: "
                  f"{'RED ' + ', '.join(reds) if reds else 'no red'}", flush=True)
    return summary(document, options.calibration)


def summary(document: Dict[str, Any], path: pathlib.Path) -> int:
    print(f"{'benchmark':<48} {'pairs':>6} {'sd':>7} {'ties':>6}  margin")
    for name, row in sorted(document["benchmarks"].items()):
        print(f"{name:<48} {row['pairs']:>6} {row['sd']:>7.2%} {row['tie_rate']:>6.0%}  "
              f"{percent(1 + row['recommended_margin'])}")
    is_bad = False
    for key in ("same_program", "separate_builds"):
        part = document[key]
        if part["runs"]:
            print(f"{key.replace('_', ' ')}: {part['red_runs']} of {part['runs']} runs red")
        is_bad = is_bad or part["red_runs"] > RED_LIMIT * part["runs"]
    print(f"written to {path}")
    sys.stdout.flush()
    return 1 if is_bad else 0
