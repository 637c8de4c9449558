"""Judge a report.json again, from the samples in it. Without options the same bytes come out.

With --out all outputs are written there; the text goes to standard output, or with --json the report.
"""

from __future__ import annotations

import argparse
import pathlib
import sys

from .model.config import config_of
from .model.jsonio import dumps, read
from .model.report import judge, raw_of
from .output.text import text
from .output.write import github_lines, write_all


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("report", help="a report.json that `perfgate run` wrote")
    parser.add_argument("--margin", type=float, help="another margin, as a share: 0.03")
    parser.add_argument("--strict", action="store_true", help="what is not decided is an error")
    parser.add_argument("--out", type=pathlib.Path, help="folder for all outputs")
    parser.add_argument("--json", action="store_true", help="the report on standard output")
    parser.add_argument("--all", action="store_true", help="show every benchmark")


def main(options: argparse.Namespace) -> int:
    raw = raw_of(read(options.report), options.report)
    if options.margin is not None:
        changed = {**raw["config"], "margin": options.margin, "margins": {}}
        raw["config"] = config_of(changed, "--margin").as_dict()
    if options.strict:
        raw["is_strict"] = True
    report = judge(raw)
    if options.out is not None:
        write_all(report, options.out)
    sys.stdout.write(dumps(report) if options.json else text(report, options.all))
    if not options.json:
        sys.stdout.write(github_lines(report))
    return int(report["exit"])
