"""What host and what programs the numbers come from, and what makes them unfit for a verdict."""

from __future__ import annotations

import hashlib
import os
import pathlib
import platform
from typing import Any, Dict, List, Mapping, Optional

from ..errors import GateError, UNFIT
from ..model.config import Config
from .elf import code_hash, compiler_of
from .program import Program, contexts_differ

# What must be the same on both sides, where both say it.
SAME = ["compiler", "flags", "build_type", "CMAKE_BUILD_TYPE", "library_build_type",
        "json_schema_version", "index_bits", "num_cpus", "host_name"]
# Of the context, what stands in the report.
SHOWN = ["compiler", "flags", "build_type", "library_build_type", "library_version", "commit",
         "git_sha", "index_bits", "peers", "benchmark_library", "transparent_huge_pages"]


def first_line(path: str) -> Optional[str]:
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.readline().strip() or None
    except OSError:
        return None


def cpu_model() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8", errors="replace") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine() or "unknown"


def cpu_ticks() -> Optional[List[int]]:
    line = first_line("/proc/stat")
    return [int(part) for part in line.split()[1:]] if line and line.startswith("cpu ") else None


def steal_percent(before: Optional[List[int]], after: Optional[List[int]]) -> Optional[float]:
    """Share of time that the host of a virtual machine kept for others."""
    if before is None or after is None or len(before) < 8 or len(after) < 8:
        return None
    passed = sum(after[:8]) - sum(before[:8])
    return round(100.0 * (after[7] - before[7]) / passed, 2) if passed > 0 else None


def turbo() -> str:
    no_turbo = first_line("/sys/devices/system/cpu/intel_pstate/no_turbo")
    if no_turbo is not None:
        return "off" if no_turbo == "1" else "on"
    boost = first_line("/sys/devices/system/cpu/cpufreq/boost")
    return "not reported" if boost is None else ("on" if boost == "1" else "off")


def host_facts() -> Dict[str, Any]:
    allowed = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
    return {"cpu": cpu_model(), "cores": os.cpu_count() or 1, "allowed_cores": allowed,
            "governor": first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor") or
            "not reported",
            "turbo": turbo(),
            "smt": {"1": "on", "0": "off"}.get(
                first_line("/sys/devices/system/cpu/smt/active") or "", "not reported"),
            "load": [round(value, 2) for value in os.getloadavg()],
            "kernel": f"{platform.system()} {platform.release()}",
            "python": platform.python_version()}


def host_class(facts: Mapping[str, Any]) -> str:
    """Hosts of one class are taken to have the same noise and comparable times."""
    return f"{facts.get('cpu', 'unknown')}, {facts.get('cores', '?')} cores"


def program_facts(program: Program, context: Mapping[str, Any],
                  known: Dict[str, Optional[str]]) -> Dict[str, Any]:
    data = pathlib.Path(program.path).read_bytes()
    facts: Dict[str, Any] = {"path": program.path,
                             "exe_sha256": hashlib.sha256(data).hexdigest(),
                             "text_sha256": code_hash(program.path, known),
                             "bytes": len(data)}
    facts.update({key: context[key] for key in SHOWN if key in context})
    if "compiler" not in facts:
        facts["compiler"] = compiler_of(program.path)
    return facts


def is_debug(value: Any) -> bool:
    return isinstance(value, str) and value.strip().lower().startswith("debug")


def refuse_unfit(base: Mapping[str, Any], head: Mapping[str, Any],
                 contexts: List[Mapping[str, Any]], config: Config) -> List[str]:
    """Raises where no comparison would mean anything. Returns what is doubtful."""
    notes = []
    keys = [key for key in SAME if key not in config.allow_different]
    differences = contexts_differ(contexts[0], contexts[1], keys)
    if "compiler" not in config.allow_different and not differences:
        differences = contexts_differ(base, head, ["compiler"])
    if differences:
        raise GateError(UNFIT, "the programs were built differently: " + "; ".join(differences))
    for side, context in zip(("base", "head"), contexts):
        for key in ("flags", "build_type", "CMAKE_BUILD_TYPE"):
            if is_debug(context.get(key)):
                raise GateError(UNFIT, f"the {side} is a debug build ({key}: {context[key]})")
        if is_debug(context.get("library_build_type")):
            text = f"the {side}'s Google Benchmark library calls itself a debug build"
            if config.refuse_debug_library:
                raise GateError(UNFIT, text)
            if side == "head":
                notes.append(text + ", as Debian's does; what it times need not be one")
    return notes
