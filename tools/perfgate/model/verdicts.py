"""The verdict on one benchmark, from all arms, waivers and declarations."""

from __future__ import annotations

import math
from typing import Any, Dict, List, Optional

from ..stats.sequential import (EQUIVALENT, IMPROVEMENT, INCONCLUSIVE, PASS, REGRESSION,
                                SMALL_SLOWDOWN, UNSTABLE, Outcome)
from . import other_arms
from .config import Config
from .entry import IDENTICAL as SAME_CODE
from .entry import NEW as ADDED
from .entry import REMOVED as GONE
from .entry import SKIPPED, Entry
from .other_arms import Finding
from .time_arm import LAYOUT, NOT_REPRODUCED, UNCONFIRMED, confirmation_of
from .waivers import Waiver, find

ERROR = "ERROR"
NEW = "NEW"
REMOVED = "REMOVED"
IDENTICAL = "IDENTICAL"
WAIVED = "WAIVED"
LAYOUT_SENSITIVE = "LAYOUT_SENSITIVE"

# Worst first: the order of tables.
ORDER = [ERROR, REGRESSION, WAIVED, LAYOUT_SENSITIVE, SMALL_SLOWDOWN, UNSTABLE, INCONCLUSIVE, REMOVED,
         IMPROVEMENT, PASS, EQUIVALENT, IDENTICAL, NEW]
WARNINGS = (LAYOUT_SENSITIVE, SMALL_SLOWDOWN, UNSTABLE)
UNDECIDED = (INCONCLUSIVE, UNSTABLE)


class Judged:
    """A verdict, the findings behind it, and what the reader should know besides."""

    def __init__(self, verdict: str) -> None:
        self.verdict = verdict
        self.findings: List[Finding] = []
        self.notes: List[str] = []
        self.confirmation: Optional[str] = None
        self.waiver: Optional[Waiver] = None


def without_times(entry: Entry, config: Config) -> Optional[Judged]:
    """The verdict where nothing is to be measured."""
    state = entry["state"]
    if state == ADDED:
        return Judged(NEW)
    if state == SAME_CODE:
        judged = Judged(IDENTICAL)
        judged.notes.append("the machine code of both programs is the same: nothing was timed")
        return judged
    if state == SKIPPED:
        judged = Judged(INCONCLUSIVE)
        judged.notes.append(entry["error"] or "not measured")
        return judged
    if state == GONE:
        name = entry["name"]
        is_declared = name in config.removed or name in config.renamed
        judged = Judged(REMOVED if is_declared else ERROR)
        judged.notes.append("declared in the configuration" if is_declared else
                            "the head does not have it, and the configuration does not declare it "
                            "as removed or renamed")
        return judged
    if entry["error"] is not None:
        judged = Judged(ERROR)
        judged.notes.append(entry["error"])
        return judged
    return None


def judge_time(judged: Judged, entry: Entry, outcome: Optional[Outcome], margin: float,
               pass_alpha: float, is_red_elsewhere: bool) -> None:
    if outcome is None:
        judged.notes.append("no pair has a time on both sides")
        return
    judged.verdict = outcome.verdict
    if outcome.verdict != REGRESSION:
        return
    judged.confirmation = confirmation_of(entry, margin, pass_alpha)
    if judged.confirmation == UNCONFIRMED:
        judged.notes.append("not re-measured")
    elif judged.confirmation == NOT_REPRODUCED and not is_red_elsewhere:
        judged.verdict = INCONCLUSIVE
        judged.notes.append(f"{len(entry['fresh'])} fresh pairs do not show it again")
    elif judged.confirmation == LAYOUT and not is_red_elsewhere:
        judged.verdict = LAYOUT_SENSITIVE
        judged.notes.append("it vanishes when the same code is linked in another layout")


def apply_waivers(judged: Judged, entry: Entry, time_ratio: Optional[float], config: Config) -> None:
    """A regression or another result that somebody answers for, in each arm that is red."""
    red = [(f.arm, f.ratio, f.text) for f in judged.findings if f.is_red]
    if judged.confirmation is not None and judged.verdict == REGRESSION:
        red.append(("time", time_ratio, "slower"))
    left = []
    for arm, ratio, text in red:
        waiver = find(config.waivers, entry["name"], arm)
        if waiver is None:
            left.append(arm)
            continue
        judged.waiver = waiver
        if ratio is None or ratio > waiver.max_ratio:
            left.append(arm)
            shown = "without a ratio" if ratio is None else f"{ratio:.3f}"
            judged.notes.append(f"{text}: {shown} is beyond the waiver's {waiver.max_ratio:.3f}")
    if red and not left:
        judged.verdict = WAIVED
    elif red:
        judged.verdict = ERROR if "result" in left else REGRESSION


def judge_entry(entry: Entry, outcome: Optional[Outcome], margin: float, config: Config) -> Judged:
    judged = without_times(entry, config)
    if judged is not None:
        return judged
    judged = Judged(INCONCLUSIVE)
    for arm in (other_arms.instructions, other_arms.memory, other_arms.result):
        judged.findings += arm(entry, config)
    has_more_instructions = any(f.is_red for f in judged.findings if f.arm == "instructions")
    plan = config.plan()
    judge_time(judged, entry, outcome, margin, plan.pass_alpha, has_more_instructions)
    ratio: Optional[float] = None
    if outcome is not None:
        ratio = as_ratio(outcome.bounds.estimate)
    apply_waivers(judged, entry, ratio, config)
    return judged


def as_ratio(log: Optional[float]) -> Optional[float]:
    return None if log is None else math.exp(min(700.0, max(-700.0, log)))


def waiver_dict(judged: Judged) -> Optional[Dict[str, Any]]:
    return judged.waiver.as_dict() if judged.waiver is not None else None
