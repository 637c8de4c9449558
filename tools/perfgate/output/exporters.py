"""The times of the head for services that keep histories."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping


def measured(report: Mapping[str, Any]) -> List[Mapping[str, Any]]:
    return [row for row in report["benchmarks"] if row["head_ns"] is not None]


def bencher(report: Mapping[str, Any]) -> Dict[str, Any]:
    """Bencher Metric Format. The bounds are those of the ratio, put on the base's time. Names of
    informational benchmarks end in the suffix that Bencher ignores."""
    found: Dict[str, Any] = {}
    for row in measured(report):
        latency = {"value": row["head_ns"]}
        if row["lower"] is not None and row["base_ns"] is not None:
            latency["lower_value"] = row["base_ns"] * row["lower"]
            latency["upper_value"] = row["base_ns"] * row["upper"]
        metrics: Dict[str, Any] = {"latency": latency}
        if row["ir"] is not None and not row["ir"].get("void") and row["ir"]["head"]:
            metrics["instructions"] = {"value": min(row["ir"]["head"])}
        name = row["name"] if row["gated"] else row["name"] + "_bencher_ignore"
        found[name] = metrics
    return found


def smaller_is_better(report: Mapping[str, Any]) -> List[Dict[str, Any]]:
    """github-action-benchmark, tool customSmallerIsBetter."""
    entries = []
    for row in measured(report):
        entry = {"name": row["name"], "unit": "ns", "value": row["head_ns"],
                 "extra": f"{row['verdict']}, n={row['n']}"}
        if row["lower"] is not None and row["base_ns"] is not None:
            half = 0.5 * row["base_ns"] * (row["upper"] - row["lower"])
            entry["range"] = f"{half:.4g}"
        entries.append(entry)
    return entries
