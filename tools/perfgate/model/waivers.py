"""Waivers: regressions that somebody answers for, until a date."""

from __future__ import annotations

import datetime
import re
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Sequence

from ..errors import usage

KEYS = ("benchmark", "reason", "owner", "expires", "max_ratio", "arm")
ARMS = ("time", "instructions", "memory", "result")
MIN_REASON = 8  # characters


@dataclass(frozen=True)
class Waiver:
    benchmark: str  # the whole name, or a regular expression that matches the whole name
    reason: str
    owner: str
    expires: str    # YYYY-MM-DD, the last day on which it holds
    max_ratio: float
    arm: str

    def as_dict(self) -> Dict[str, Any]:
        return {key: getattr(self, key) for key in KEYS}

    def covers(self, name: str, arm: str) -> bool:
        return self.arm == arm and (self.benchmark == name or
                                    re.fullmatch(self.benchmark, name) is not None)


def date_of(text: Any, where: str) -> datetime.date:
    try:
        return datetime.date.fromisoformat(str(text))
    except ValueError:
        raise usage(f"{where}: expires is {text!r}; a date like 2027-01-31 is wanted") from None


def waiver_of(entry: Any, number: int) -> Waiver:
    where = f"waiver {number}"
    if not isinstance(entry, dict):
        raise usage(f"{where}: a table is wanted")
    unknown = sorted(set(entry) - set(KEYS))
    if unknown:
        raise usage(f"{where}: unknown key {unknown[0]!r}; known are {', '.join(KEYS)}")
    for key in ("benchmark", "reason", "owner"):
        value = entry.get(key)
        if not isinstance(value, str) or not value.strip():
            raise usage(f"{where}: {key} is missing; a waiver names benchmark, reason, owner, expires")
    if len(entry["reason"].strip()) < MIN_REASON:
        raise usage(f"{where}: the reason {entry['reason']!r} says nothing; write a sentence")
    try:
        re.compile(entry["benchmark"])
    except re.error as error:
        raise usage(f"{where}: benchmark {entry['benchmark']!r}: {error}") from None
    expires = date_of(entry.get("expires"), where).isoformat()
    arm = entry.get("arm", "time")
    if arm not in ARMS:
        raise usage(f"{where}: arm is {arm!r}; known are {', '.join(ARMS)}")
    ratio = entry.get("max_ratio", None if arm != "result" else 1.0)
    if isinstance(ratio, bool) or not isinstance(ratio, (int, float)) or not 1.0 <= ratio < 1e6:
        raise usage(f"{where}: max_ratio is {ratio!r}; the largest ratio waived, from 1, is wanted")
    return Waiver(entry["benchmark"], entry["reason"].strip(), entry["owner"].strip(), expires,
                  float(ratio), arm)


def waivers_of(entries: Any) -> List[Waiver]:
    if not isinstance(entries, list):
        raise usage("waivers: a list of tables is wanted")
    return [waiver_of(entry, number) for number, entry in enumerate(entries, 1)]


def refuse_expired(waivers: Sequence[Waiver], today: datetime.date) -> None:
    for number, waiver in enumerate(waivers, 1):
        if datetime.date.fromisoformat(waiver.expires) < today:
            raise usage(f"waiver {number} for {waiver.benchmark} expired on {waiver.expires}: "
                        f"{waiver.owner} removes it or gives it a new date ({waiver.reason})")


def find(waivers: Sequence[Waiver], name: str, arm: str) -> Optional[Waiver]:
    for waiver in waivers:
        if waiver.covers(name, arm):
            return waiver
    return None
