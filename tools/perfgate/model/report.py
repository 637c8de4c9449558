"""The report: what was measured, and all that follows from it. No clock, no files, no processes, so
that the same measurements give the same bytes whenever and wherever they are judged."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

from .. import SCHEMA, __version__
from ..errors import BROKEN, OK, REGRESSION as EXIT_REGRESSION, UNDECIDED as EXIT_UNDECIDED, usage
from ..stats.bounds import Bounds, detectable
from ..stats.margins import margin_of
from ..stats.sequential import REGRESSION, Outcome
from .config import Config, config_of
from .entry import Entry, check_entry, median_times
from .headline import headline
from .time_arm import Family, family_of, margin_for, mean_of_suite, outcomes_of, spread_of
from .verdicts import ERROR, UNDECIDED, Judged, as_ratio, judge_entry, waiver_dict
from .waivers import find

Report = Dict[str, Any]

# What a report is computed from, besides the entries of its benchmarks.
RAW_KEYS: Mapping[str, Any] = {
    "schema": SCHEMA, "tool": f"perfgate {__version__}", "seed": 0, "started": "", "mode": "paired",
    "is_quick": False, "is_strict": False, "is_aa": False, "interrupted": None, "command": "",
    "host": {}, "base": {}, "head": {}, "margin_floor": 0.0, "notes": [], "config": {},
    "benchmarks": [],
}


def interval(bounds: Optional[Bounds]) -> Dict[str, Any]:
    if bounds is None:
        return {"ratio": None, "lower": None, "upper": None, "pass_upper": None, "n": 0, "k": 0,
                "alpha": None, "ties": 0}
    return {"ratio": as_ratio(bounds.estimate), "lower": as_ratio(bounds.lower),
            "upper": as_ratio(bounds.upper), "pass_upper": as_ratio(bounds.pass_upper),
            "n": bounds.n, "k": bounds.k, "alpha": bounds.alpha, "ties": bounds.ties}


def report_entry(entry: Entry, judged: Judged, outcome: Optional[Outcome], margin: float,
                 is_gated: bool) -> Dict[str, Any]:
    bounds = outcome.bounds if outcome is not None else None
    times = median_times(entry)
    return {"name": entry["name"], "verdict": judged.verdict, **interval(bounds),
            "margin": as_ratio(margin), "detectable": as_ratio(detectable(bounds, margin)),
            "sd": spread_of(entry), "base_ns": times["base"], "head_ns": times["head"],
            "gated": is_gated, "confirmation": judged.confirmation,
            "findings": [finding.as_dict() for finding in judged.findings],
            "notes": judged.notes, "waiver": waiver_dict(judged),
            **{key: value for key, value in entry.items() if key != "name"}}


def suite_rows(entries: Sequence[Entry], family: Family, config: Config,
               floor: float) -> List[Dict[str, Any]]:
    margin = margin_of(max(config.suite_margin, floor), None, 0.0, None)
    rows = []
    for suite, members in family.suites.items():
        bounds = mean_of_suite(entries, members, family, config.plan())
        is_red = bounds is not None and bounds.lower is not None and bounds.lower > margin
        found = interval(bounds)
        rows.append({"name": suite, "geomean": found.pop("ratio"), **found, "members": len(members),
                     "margin": as_ratio(margin), "detectable": as_ratio(detectable(bounds, margin)),
                     "is_red": is_red})
    return rows


def conclusion(report: Report, rows: Sequence[Dict[str, Any]]) -> Tuple[str, int]:
    """The verdict on the run and the exit code. What is broken comes before what is slow: the time of
    a wrong answer means nothing."""
    gated = [row for row in rows if row["gated"]]
    if report["interrupted"]:
        return "INTERRUPTED", EXIT_UNDECIDED
    if any(row["verdict"] == ERROR for row in gated):
        return "ERROR", BROKEN
    if any(row["verdict"] == REGRESSION for row in gated) or \
            any(row["is_red"] for row in report["suites"]):
        return "REGRESSION", EXIT_REGRESSION
    if report["is_strict"] and any(row["verdict"] in UNDECIDED for row in gated):
        return "INCONCLUSIVE", EXIT_UNDECIDED
    return "OK", OK


def judge(raw: Mapping[str, Any]) -> Report:
    """The report on what was measured: the keys of RAW_KEYS, and entries as entry.py has them.
    Judging a report gives the same report."""
    config = config_of(raw["config"], "config")
    plan = config.plan()
    entries = raw["benchmarks"]
    waived = {entry["name"]: find(config.waivers, entry["name"], "time") is not None
              for entry in entries}
    family = family_of(entries, config, waived)
    margins = {entry["name"]: margin_for(entry, config, raw["margin_floor"]) for entry in entries}
    outcomes = outcomes_of(entries, family, margins, plan)
    rows = []
    for entry in entries:
        name = entry["name"]
        judged = judge_entry(entry, outcomes.get(name), margins[name], config)
        rows.append(report_entry(entry, judged, outcomes.get(name), margins[name],
                                 not config.is_informational(name)))
    suites = suite_rows(entries, family, config, raw["margin_floor"])
    report = {key: raw[key] for key in RAW_KEYS}
    report.update(tests=family.tests, benchmarks=rows, suites=suites,
                  suite=suites[0] if suites else None)
    report["verdict"], report["exit"] = conclusion(report, rows)
    report["headline"] = headline(report)
    return report


def raw_of(report: Any, where: str) -> Dict[str, Any]:
    """The measured part of a report that was read from a file."""
    if not isinstance(report, dict):
        raise usage(f"{where}: {type(report).__name__} instead of an object")
    if report.get("schema") != SCHEMA:
        raise usage(f"{where}: schema is {report.get('schema')!r}; this program knows {SCHEMA}")
    if not isinstance(report.get("benchmarks"), list):
        raise usage(f"{where}: no list 'benchmarks': not a report of perfgate")
    raw = {key: report.get(key, default) for key, default in RAW_KEYS.items()}
    for key, default in RAW_KEYS.items():
        kind = (int, float) if isinstance(default, float) else type(default)
        if default is not None and not isinstance(raw[key], kind):  # type: ignore[arg-type]
            raise usage(f"{where}: {key} is {raw[key]!r}; {type(default).__name__} is wanted")
    raw["benchmarks"] = [check_entry(entry, number)
                         for number, entry in enumerate(report["benchmarks"], 1)]
    names = [entry["name"] for entry in raw["benchmarks"]]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise usage(f"{where}: benchmark {repeated[0]} is there twice")
    config_of(raw["config"], f"{where}: config")
    return raw
