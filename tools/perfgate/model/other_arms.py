"""The arms that need no clock: instructions, memory, result. Each says what it found."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Dict, List, Optional

from .config import Config
from .entry import Entry

# Two runs of the same program must agree to this, or instructions say nothing.
AGREEMENT = 0.0005
# Counters that have no noise, so that any growth is a regression, and what they are called.
EXACT = {"allocs": "allocations", "alloc_bytes": "bytes allocated",
         "bytes_per_halfedge": "bytes per half-edge"}
PEAK = "peak_bytes"
# Resident sizes are counted in pages, and the allocator asks for several at a time.
PEAK_SLACK_BYTES = 256 * 1024


@dataclass(frozen=True)
class Finding:
    """What one arm says of one benchmark. `ratio` is head to base where both are known."""

    arm: str
    is_red: bool
    text: str
    ratio: Optional[float] = None

    def as_dict(self) -> Dict[str, Any]:
        return asdict(self)


def ratio_of(base: float, head: float) -> Optional[float]:
    return head / base if base > 0 else None


def instructions(entry: Entry, config: Config) -> List[Finding]:
    counted = entry["ir"]
    if counted is None:
        return []
    if counted.get("void"):
        return [Finding("instructions", False, f"instructions do not count: {counted['void']}")]
    base, head = (min(counted[side]) for side in ("base", "head"))
    ratio = ratio_of(base, head)
    if ratio is None:
        return [Finding("instructions", False, "instructions do not count: none on the base side")]
    return [Finding("instructions", ratio > 1 + config.instruction_margin,
                    f"{base:.0f} to {head:.0f} instructions an iteration ({ratio - 1:+.2%})", ratio)]


def disagreement(counts: List[float]) -> Optional[str]:
    """Why two counts of one program do not count."""
    if len(counts) < 2:
        return "counted once only"
    low, high = min(counts), max(counts)
    if low <= 0:
        return "an iteration without instructions"
    if high / low - 1 > AGREEMENT:
        return f"two runs differ by {high / low - 1:.2%}, more than {AGREEMENT:.2%}"
    return None


def exact_counter(key: str, base: List[float], head: List[float]) -> Optional[Finding]:
    name = EXACT[key]
    if len(set(base)) > 1 or len(set(head)) > 1:
        return Finding("memory", False, f"{name} differ from process to process: not compared")
    if head[0] == base[0]:
        return None
    return Finding("memory", head[0] > base[0], f"{base[0]:.6g} to {head[0]:.6g} {name}",
                   ratio_of(base[0], head[0]))


def peak(base: List[float], head: List[float], margin: float) -> Optional[Finding]:
    """Every process of the head needs more than any of the base, by more than the margin."""
    low, high = max(base), min(head)
    if high <= low * (1 + margin) or high <= low + PEAK_SLACK_BYTES:
        return None
    return Finding("memory", True, f"peak resident size {low / 1e6:.1f} to {high / 1e6:.1f} MB",
                   ratio_of(low, high))


def memory(entry: Entry, config: Config) -> List[Finding]:
    if entry["mem"] is None or not config.memory:
        return []
    base, head = entry["mem"]["base"], entry["mem"]["head"]
    found: List[Optional[Finding]] = []
    for key in EXACT:
        if base.get(key) and head.get(key):
            found.append(exact_counter(key, base[key], head[key]))
    if base.get(PEAK) and head.get(PEAK):
        found.append(peak(base[PEAK], head[PEAK], config.peak_margin))
    if config.is_frame_path(entry["name"]) and any(head.get("allocs", [])):
        found.append(Finding("memory", True, f"{max(head['allocs']):.0f} allocations on the frame "
                             "path, where none are allowed"))
    return [finding for finding in found if finding is not None]


def result(entry: Entry, config: Config) -> List[Finding]:
    """Red: another answer, or one that is not the same twice."""
    base, head = (sorted(set(entry["checksum"][side])) for side in ("base", "head"))
    if not config.result or not base or not head:
        return []
    for side, seen in (("base", base), ("head", head)):
        if len(seen) > 1:
            return [Finding("result", True, f"the {side} gives {len(seen)} different results in "
                            f"different processes: {', '.join(seen[:3])}")]
    if base != head:
        return [Finding("result", True, f"a different result: checksum {base[0]} to {head[0]}", 1.0)]
    return []
