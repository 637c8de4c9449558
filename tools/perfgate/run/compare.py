"""A run with programs: from two paths or refs to everything that was measured."""

from __future__ import annotations

import argparse
import os
import re
from typing import Any, Dict, List, Mapping, Optional

from ..errors import BROKEN, GateError, UNFIT, usage
from ..model.config import Config
from ..model.entry import IDENTICAL, NEW, REMOVED, Entry, median_times, new_entry
from ..stats.binomial import most_tests
from .build import Builder, resolve
from .calibration import own_mads
from .fingerprint import (cpu_ticks, host_class, host_facts, program_facts, refuse_unfit,
                          steal_percent)
from .instructions import count_entry, estimated_seconds, unavailable
from .probe import probe
from .process import Interrupted
from .program import BY_TIME, FIXED, BenchmarkError, Program, detect_way
from .progress import Progress
from .session import Session

PROBE_SECONDS = 9.0
QUICK_PROBE_SECONDS = 3.0


def pin(config: Config) -> None:
    """All that is started from here on runs on these cores."""
    if not config.cores or not hasattr(os, "sched_setaffinity"):
        return
    try:
        os.sched_setaffinity(0, config.cores)
    except OSError as error:
        raise usage(f"cores {config.cores}: {error.strerror}") from None


def programs_of(raw: Dict[str, Any], options: argparse.Namespace, config: Config,
                progress: Progress) -> Dict[str, Any]:
    """Both programs, and pairs of them in other layouts, which are built when they are needed."""
    if not options.base_ref:
        base, head = (Program(side, paths[0], config)
                      for side, paths in (("base", options.base), ("head", options.head)))
        layouts = [{"name": row["name"], "base": Program("base", row["base"], config),
                    "head": Program("head", row["head"], config)} for row in config.layouts]
        return {"base": base, "head": head, "layouts": lambda: layouts}
    builder = Builder(config, options.out)
    commits = resolve(options.base_ref, options.head_ref or "HEAD", options.exact_base)
    found: Dict[str, Any] = {}
    for side, commit in commits.items():
        progress.show(f"building {side} {commit[:12]}")
        found[side] = Program(side, builder.program(commit), config)
        raw[side]["sha"] = commit

    def layouts_built() -> List[Dict[str, Any]]:
        built = []
        for name, more in builder.layouts().items():
            progress.show(f"linking both in layout {name}")
            row: Dict[str, Any] = {"name": name}
            for side, commit in commits.items():
                row[side] = Program(side, builder.program(commit, name, more), config)
                row[side].way = found[side].way
            built.append(row)
        return built

    found["layouts"] = layouts_built
    return found


def probe_host(raw: Dict[str, Any], options: argparse.Namespace, config: Config,
               progress: Progress) -> None:
    """Refuses a host whose own kernels vary too much, or widens all margins, or says so."""
    raw["host"] = host_facts()
    raw["host"]["class"] = host_class(raw["host"])
    if options.no_probe:
        return
    progress.show("probing the host")
    before = cpu_ticks()
    found = probe(QUICK_PROBE_SECONDS if options.quick else PROBE_SECONDS)
    raw["host"]["probe"] = found
    raw["host"]["steal_pct"] = steal_percent(before, cpu_ticks())
    worst = max(found, key=lambda kernel: found[kernel])
    if found[worst] <= config.noise_limit:
        return
    text = (f"the host is noisy: paired deviation {found[worst]:.1%} in kernel {worst[:-3]}, limit "
            f"{config.noise_limit:.1%}, load {raw['host']['load'][0]}")
    if config.noise_policy == "refuse":
        raise GateError(UNFIT, text)
    if config.noise_policy == "widen":
        raw["margin_floor"] = found[worst]
        text += f"; every margin is at least {found[worst]:.1%}"
    raw["notes"].append(text)


def names_of(base: Program, head: Program, config: Config) -> Dict[str, List[str]]:
    """What both have, what is new and what is gone, as chosen by the filter."""
    before = [name for name in base.names() if config.is_chosen(name)]
    after = [name for name in head.names() if config.is_chosen(name)]
    if not before and not after:
        raise GateError(BROKEN, f"no benchmark is called {config.filter!r} in either program")
    return {"both": [name for name in before if name in set(after)],
            "gone": [name for name in before if name not in set(after)],
            "new": [name for name in after if name not in set(before)]}


def count_instructions(session: Session, progress: Progress) -> None:
    """As many benchmarks as the budget has time for, the cheapest first."""
    base, head, config = session.programs["A"], session.programs["B"], session.config
    why = unavailable(base)
    if why is not None:
        session.notes.append(f"instructions were not counted: {why}")
        return
    entries = [entry for name, entry in session.entries.items()
               if session.is_alive(name) and config.is_chosen(name) and entry["pairs"]]
    chosen = [(times["base"] or 0.0, entry) for entry in entries
              for times in [median_times(entry)] if is_counted(entry, times["base"], config)]
    late = 0
    for base_ns, entry in sorted(chosen, key=lambda item: (item[0], item[1]["name"])):
        seconds = estimated_seconds(base_ns, 0.05)
        if session.elapsed() + seconds > config.budget_s:
            late += 1
            continue
        progress.show(f"counting instructions: {entry['name']}", seconds)
        count_entry(entry, base, head, base_ns, config)
    if late:
        session.notes.append(f"the budget left no time to count the instructions of {late} benchmarks")


def is_counted(entry: Entry, base_ns: Optional[float], config: Config) -> bool:
    return base_ns is not None and base_ns <= config.instruction_max_ns and \
        bool(re.search(config.instruction_filter, entry["name"]))


def describe_way(session: Session) -> None:
    way = session.programs["A"].way
    if way == BY_TIME:
        session.notes.append("weaker: the programs take no number of iterations "
                             "(--fixed-iterations N, or --benchmark_min_time=Nx of Google Benchmark "
                             "1.8), so each side chose its own, and the least of the epochs is compared")
    elif way != FIXED:
        session.notes.append(f"iterations are set by {way}")
    plan, tests = session.config.plan(), len(session.entries) + 1
    most = most_tests(plan.looks[0], plan.alpha_run, len(plan.looks))
    if tests > most:
        session.notes.append(f"{tests} tests share the chance of a false red: none can be red at "
                             f"{plan.looks[0]} pairs (with {most} it could), the next look decides")


def compare(raw: Dict[str, Any], options: argparse.Namespace, config: Config) -> None:
    """Fills `raw`. An interruption leaves in it what was measured until then."""
    progress = Progress(not options.no_progress)
    session: Optional[Session] = None
    others: List[Entry] = []
    try:
        pin(config)
        found = programs_of(raw, options, config, progress)
        base, head = found["base"], found["head"]
        known: Dict[str, Optional[str]] = {}
        names = names_of(base, head, config)
        others += [new_entry(name, REMOVED) for name in names["gone"]]
        others += [new_entry(name, NEW) for name in names["new"]]
        contexts = contexts_of(base, head, names["both"])
        for program, context in zip((base, head), contexts):
            raw[program.side].update(program_facts(program, context, known))
        raw["notes"] += refuse_unfit(raw["base"], raw["head"], contexts, config)
        if is_same_code(raw) and not options.aa:
            raw["host"] = host_facts()
            others += [new_entry(name, IDENTICAL) for name in names["both"]]
            return
        probe_host(raw, options, config, progress)
        session = Session(base, head, config, config.seed, raw["margin_floor"], progress)
        session.prepare(names["both"])
        mads = own_mads(config.calibration, raw["host"]["class"], raw["notes"])
        for name, entry in session.entries.items():
            entry["own_mad"] = mads.get(name)
        describe_way(session)
        session.measure()
        if config.instructions:
            count_instructions(session, progress)
        session.confirm(found["layouts"]() if needs_layouts(session) else [])
    except Interrupted as interruption:
        raw["interrupted"] = interruption.name
    finally:
        progress.clear()
        if session is not None:
            raw["benchmarks"] = [*session.entries.values()]
            raw["notes"] += session.notes
        raw["benchmarks"] = raw["benchmarks"] + others


def needs_layouts(session: Session) -> bool:
    return any(outcome.verdict == "REGRESSION" for outcome in session.outcomes().values())


def is_same_code(raw: Mapping[str, Any]) -> bool:
    code = raw["base"].get("text_sha256")
    return code is not None and code == raw["head"].get("text_sha256")


def contexts_of(base: Program, head: Program, names: List[str]) -> List[Mapping[str, Any]]:
    """What both programs say of themselves, and by what way they take iterations."""
    way = detect_way([base, head], names)
    contexts: List[Mapping[str, Any]] = []
    for program in (base, head):
        program.way = way
        context: Mapping[str, Any] = {}
        for name in names[:3]:
            try:
                context = program.sample(name, 1, 1, 0).context
                break
            except BenchmarkError:
                continue
        contexts.append(context)
    return contexts
