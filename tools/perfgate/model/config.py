"""The configuration: what may be set, within which limits, and what holds otherwise."""

from __future__ import annotations

import difflib
import math
import re
from dataclasses import dataclass, field, fields
from typing import Any, Callable, Dict, List

from ..errors import GateError, usage
from ..stats.sequential import Plan
from .waivers import Waiver, waivers_of


@dataclass
class Config:
    """Patterns are regular expressions that are searched in the names of benchmarks."""

    filter: str = ""                    # what is compared
    exclude: str = "^$"                 # and what of that is not
    suites: Dict[str, str] = field(default_factory=lambda: {"all": ""})  # means of these are gated
    metric: str = "real_time"           # or cpu_time, or a counter that is in nanoseconds
    # Statistics.
    margin: float = 0.02                # a change up to this share counts as none
    margins: Dict[str, float] = field(default_factory=dict)  # by pattern; the first that matches
    min_effect_ns: float = 0.0          # and up to this time
    suite_margin: float = 0.02
    alpha_run: float = 0.01
    looks: List[int] = field(default_factory=lambda: [16, 24, 48, 96])
    calibration: str = ""               # a file that `perfgate aa` wrote
    # Measuring.
    arguments: List[str] = field(default_factory=list)   # for the programs, besides the gate's own
    environment: Dict[str, str] = field(default_factory=dict)
    epochs: int = 5
    sample_ms: float = 20.0
    budget_s: float = 600.0
    timeout_s: float = 120.0            # of one process
    seed: int = 0                       # 0: from the clock
    cores: List[int] = field(default_factory=list)       # none: those that are allowed
    aslr: bool = True                   # False: setarch -R
    confirm_pairs: int = 30
    noise_limit: float = 0.05           # paired deviation of the host's own kernels
    noise_policy: str = "refuse"        # or widen, or warn
    # Arms besides time.
    instructions: bool = False
    instruction_filter: str = ""
    instruction_margin: float = 0.01
    instruction_max_ns: float = 2e6     # longer iterations take too long under valgrind
    memory: bool = True
    peak_margin: float = 0.02           # resident sizes depend on the host a little
    frame_path: List[str] = field(default_factory=list)  # patterns of what may not allocate
    result: bool = True
    # Exceptions.
    informational: List[str] = field(default_factory=list)  # patterns of what is shown, not judged
    removed: List[str] = field(default_factory=list)
    renamed: Dict[str, str] = field(default_factory=dict)   # old name to new
    allow_different: List[str] = field(default_factory=list)  # keys of the context
    refuse_debug_library: bool = False
    waivers: List[Waiver] = field(default_factory=list)
    # Other layouts of both programs, for confirmation: [{"name", "base", "head"}].
    layouts: List[Dict[str, str]] = field(default_factory=list)
    # How --base-ref and --head-ref are built.
    build: Dict[str, Any] = field(default_factory=dict)

    def plan(self) -> Plan:
        return Plan(looks=tuple(self.looks), alpha_run=self.alpha_run)

    def margin_of(self, name: str) -> float:
        for pattern, margin in self.margins.items():
            if re.search(pattern, name):
                return margin
        return self.margin

    def is_chosen(self, name: str) -> bool:
        return bool(re.search(self.filter, name)) and not re.search(self.exclude, name)

    def is_informational(self, name: str) -> bool:
        return any(re.search(pattern, name) for pattern in self.informational)

    def is_frame_path(self, name: str) -> bool:
        return any(re.search(pattern, name) for pattern in self.frame_path)

    def as_dict(self) -> Dict[str, Any]:
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        values["waivers"] = [waiver.as_dict() for waiver in self.waivers]
        return values


def number(low: float, high: float) -> Callable[[str, Any], float]:
    def check(key: str, value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or math.isnan(value) \
                or not low <= value <= high:
            raise usage(f"{key} is {value!r}; a number from {low:g} to {high:g} is wanted")
        return float(value)
    return check


def whole(low: int, high: int) -> Callable[[str, Any], int]:
    def check(key: str, value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise usage(f"{key} is {value!r}; a whole number from {low} to {high} is wanted")
        return value
    return check


def truth(key: str, value: Any) -> bool:
    if not isinstance(value, bool):
        raise usage(f"{key} is {value!r}; true or false is wanted")
    return value


def text(key: str, value: Any) -> str:
    if not isinstance(value, str):
        raise usage(f"{key} is {value!r}; text is wanted")
    return value


def pattern(key: str, value: Any) -> str:
    try:
        re.compile(text(key, value))
    except re.error as error:
        raise usage(f"{key}: {value!r} is no regular expression: {error}") from None
    return str(value)


def choice(*known: str) -> Callable[[str, Any], str]:
    def check(key: str, value: Any) -> str:
        if value not in known:
            raise usage(f"{key} is {value!r}; known are {', '.join(known)}")
        return str(value)
    return check


def list_of(item: Callable[[str, Any], Any]) -> Callable[[str, Any], List[Any]]:
    def check(key: str, value: Any) -> List[Any]:
        if not isinstance(value, list):
            raise usage(f"{key} is {value!r}; a list is wanted")
        return [item(f"{key}[{i}]", entry) for i, entry in enumerate(value)]
    return check


def table_of(name: Callable[[str, Any], str],
             item: Callable[[str, Any], Any]) -> Callable[[str, Any], Dict[str, Any]]:
    def check(key: str, value: Any) -> Dict[str, Any]:
        if not isinstance(value, dict):
            raise usage(f"{key} is {value!r}; a table is wanted")
        return {name(key, k): item(f"{key}.{k}", v) for k, v in value.items()}
    return check


def looks(key: str, value: Any) -> List[int]:
    found = list_of(whole(2, 10000))(key, value)
    if not found or any(n % 2 for n in found) or any(b <= a for a, b in zip(found, found[1:])):
        raise usage(f"{key} is {value!r}; even numbers in ascending order are wanted")
    return found


def layout(key: str, value: Any) -> Dict[str, str]:
    table = table_of(text, text)(key, value)
    if set(table) != {"name", "base", "head"}:
        raise usage(f"{key}: the keys name, base and head are wanted")
    return table


BUILD_KEYS: Dict[str, Callable[[str, Any], Any]] = {
    "configure": list_of(text), "build": list_of(text), "executable": text,
    "layouts": table_of(text, list_of(text)), "folder": text,
}


def build(key: str, value: Any) -> Dict[str, Any]:
    if not isinstance(value, dict):
        raise usage(f"{key} is {value!r}; a table is wanted")
    for name in value:
        if name not in BUILD_KEYS:
            raise usage(f"{key}.{name}: unknown; known are {', '.join(BUILD_KEYS)}")
    return {name: BUILD_KEYS[name](f"{key}.{name}", entry) for name, entry in value.items()}


share = number(0.0, 10.0)
CHECKS: Dict[str, Callable[[str, Any], Any]] = {
    "filter": pattern, "exclude": pattern, "suites": table_of(text, pattern), "metric": text,
    "margin": share, "margins": table_of(pattern, share), "min_effect_ns": number(0.0, 1e12),
    "suite_margin": share, "alpha_run": number(1e-9, 0.5), "looks": looks, "calibration": text,
    "arguments": list_of(text), "environment": table_of(text, text), "epochs": whole(1, 1000),
    "sample_ms": number(0.001, 1e5), "budget_s": number(1.0, 1e6), "timeout_s": number(0.05, 1e6),
    "seed": whole(0, 2**63), "cores": list_of(whole(0, 100000)), "aslr": truth,
    "confirm_pairs": whole(2, 1000), "noise_limit": share,
    "noise_policy": choice("refuse", "widen", "warn"), "instructions": truth,
    "instruction_filter": pattern, "instruction_margin": share,
    "instruction_max_ns": number(1.0, 1e12), "memory": truth, "peak_margin": share,
    "frame_path": list_of(pattern), "result": truth, "informational": list_of(pattern),
    "removed": list_of(text), "renamed": table_of(text, text), "allow_different": list_of(text),
    "refuse_debug_library": truth, "layouts": list_of(layout), "build": build,
    "waivers": lambda key, value: waivers_of(value),
}


def config_of(table: Any, where: str) -> Config:
    """The configuration that a table of the keys above describes."""
    if not isinstance(table, dict):
        raise usage(f"{where}: a table is wanted")
    config = Config()
    for key, value in table.items():
        if key not in CHECKS:
            raise usage(f"{where}: unknown key {key!r}{nearest(key)}")
        try:
            setattr(config, key, CHECKS[key](key, value))
        except GateError as error:
            raise usage(f"{where}: {error}") from None
    return config


def nearest(key: str) -> str:
    close = difflib.get_close_matches(key, CHECKS, 1)
    return f"; meant is perhaps {close[0]!r}" if close else ""
