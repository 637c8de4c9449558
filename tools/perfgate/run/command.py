"""Compare two builds of a benchmark program and say whether one is slower.

  --base EXE --head EXE            Google Benchmark programs: fresh processes, in pairs (the main way)
  --base-ref REF --head-ref REF    the same, built here from git (table `build` of the configuration)
  --base FILE... --head FILE...    stored JSON of Google Benchmark: unpaired, and so weaker

Exit: 0 no confirmed regression, 1 regression, 2 usage, 3 host or build unfit, 4 broken benchmark,
5 undecided under --strict or interrupted.

Example: perfgate run --base old/bench --head new/bench --config bench/perfgate.toml --out out
"""

from __future__ import annotations

import argparse
import datetime
import os
import pathlib
import shlex
import sys
import time
from typing import Any, Dict, List

from ..errors import usage
from ..model.config import CHECKS, Config
from ..model.config_file import read_config
from ..model.report import RAW_KEYS, judge
from ..model.waivers import refuse_expired
from ..output.text import text
from ..output.write import github_lines, prepare, write_all
from .compare import compare
from .files import compare_files
from .lock import HostLock
from .process import raise_on_signals

QUICK = {"looks": [16], "budget_s": 110.0, "epochs": 3, "sample_ms": 10.0}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--base", nargs="+", metavar="EXE", default=[], help="the program before")
    parser.add_argument("--head", nargs="+", metavar="EXE", default=[], help="the program after")
    parser.add_argument("--base-ref", metavar="REF", help="the commit before; where the head left it")
    parser.add_argument("--head-ref", metavar="REF", help="the commit after (HEAD)")
    parser.add_argument("--exact-base", action="store_true", help="--base-ref is the very commit")
    parser.add_argument("--config", help="a .toml or .json file; see GUIDE.md")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("perfgate-out"),
                        help="folder for report.json and the other outputs (perfgate-out)")
    parser.add_argument("--filter", help="only benchmarks with such a name")
    parser.add_argument("--budget", type=float, help="seconds (600)")
    parser.add_argument("--seed", type=int, help="of all that is random (from the clock)")
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--quick", action="store_true", help="two minutes: screening only")
    how.add_argument("--strict", action="store_true", help="what is not decided is an error")
    parser.add_argument("--instructions", action="store_true", help="count instructions, too")
    parser.add_argument("--aa", action="store_true", help="measure even if both have the same code")
    parser.add_argument("--no-probe", action="store_true", help="trust the host without probing it")
    parser.add_argument("--all", action="store_true", help="show every benchmark")
    parser.add_argument("--no-progress", action="store_true")


def configured(options: argparse.Namespace) -> Config:
    """The configuration of a run: the file, then --quick, then the options."""
    config = read_config(options.config) if options.config else Config()
    changes: Dict[str, Any] = dict(QUICK) if options.quick else {}
    for key, value in (("filter", options.filter), ("budget_s", options.budget),
                       ("seed", options.seed)):
        if value is not None:
            changes[key] = value
    if options.instructions:
        changes["instructions"] = True
    for key, value in changes.items():
        setattr(config, key, CHECKS[key](f"--{key.partition('_')[0]}", value))
    if config.seed == 0:
        config.seed = time.time_ns() % 2**31 + 1
    return config


def again(options: argparse.Namespace) -> str:
    """The command without what chooses and seeds."""
    parts: List[str] = ["perfgate", "run"]
    for key, value in (("--base", options.base), ("--head", options.head)):
        parts += [key, *value] if value else []
    for key, value in (("--base-ref", options.base_ref), ("--head-ref", options.head_ref),
                       ("--config", options.config)):
        parts += [key, value] if value else []
    return " ".join(shlex.quote(part) for part in parts)


def is_stored(paths: List[str]) -> bool:
    """Whether these are results rather than programs."""
    for path in paths:
        if not os.path.isfile(path):
            raise usage(f"{path}: no such file")
    return len(paths) > 1 or paths[0].endswith(".json") or not os.access(paths[0], os.X_OK)


def new_raw(options: argparse.Namespace, config: Config, started: datetime.datetime
            ) -> Dict[str, Any]:
    return {**RAW_KEYS, "seed": config.seed, "started": started.strftime("%Y-%m-%dT%H:%M:%SZ"),
            "is_quick": options.quick, "is_strict": options.strict, "is_aa": options.aa,
            "command": again(options), "config": config.as_dict(), "notes": [], "benchmarks": []}


def check_inputs(options: argparse.Namespace) -> None:
    by_ref = bool(options.base_ref or options.head_ref)
    by_path = bool(options.base or options.head)
    if by_ref and by_path:
        raise usage("--base-ref and --head-ref, or --base and --head, not both")
    if by_ref and not options.base_ref:
        raise usage("--base-ref is missing")
    if not by_ref and not (options.base and options.head):
        raise usage("--base and --head are wanted, or --base-ref and --head-ref")


def main(options: argparse.Namespace) -> int:
    check_inputs(options)
    config = configured(options)
    started = datetime.datetime.now(datetime.timezone.utc)
    refuse_expired(config.waivers, started.date())
    raw = new_raw(options, config, started)
    prepare(options.out)
    raise_on_signals()
    if options.base and is_stored(options.base) != is_stored(options.head):
        raise usage("--base and --head are two programs or two sets of stored results")
    if options.base and is_stored(options.base):
        compare_files(raw, options.base, options.head, config)
    else:
        with HostLock():
            compare(raw, options, config)
    report = judge(raw)
    # The verdict first: it is there even if the files cannot be written.
    sys.stdout.write(text(report, options.all) + github_lines(report))
    sys.stdout.flush()
    write_all(report, options.out)
    return int(report["exit"])
