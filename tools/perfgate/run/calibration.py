"""calibration.json: what benchmarks do against themselves on one class of host."""

from __future__ import annotations

from typing import Any, Dict, List

from .. import SCHEMA
from ..errors import usage
from ..model.jsonio import read


def check(document: Any, path: str) -> Dict[str, Any]:
    if not isinstance(document, dict) or document.get("schema") != SCHEMA or \
            not isinstance(document.get("benchmarks"), dict):
        raise usage(f"{path}: not a calibration of perfgate (schema {SCHEMA})")
    for name, row in document["benchmarks"].items():
        mad = row.get("mad") if isinstance(row, dict) else None
        if isinstance(mad, bool) or not isinstance(mad, (int, float)) or not 0 <= mad < 10:
            raise usage(f"{path}: {name}: mad is {mad!r}; a number from 0 is wanted")
    return document


def own_mads(path: str, host: str, notes: List[str]) -> Dict[str, float]:
    """The deviation of each benchmark; none, and a note, where it was measured on other hosts."""
    if not path:
        return {}
    document = check(read(path), path)
    if document.get("host_class") != host:
        notes.append(f"{path} is for {document.get('host_class')!r}, not for this host: not used")
        return {}
    return {name: float(row["mad"]) for name, row in document["benchmarks"].items()}
