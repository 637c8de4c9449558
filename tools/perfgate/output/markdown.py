"""The report as Markdown for one comment on a pull request, edited in place: at most 20 rows open,
and less than the 65,536 characters that a comment may have."""

from __future__ import annotations

from typing import Any, List, Mapping, Sequence

from . import words

MARKER = "<!-- perfgate -->"  # by which the comment is found again
OPEN_ROWS = 20
MAX_BYTES = 65000
HEADER = "| verdict | benchmark | change | interval | base | margin | could detect | remarks |"
RULE = "|---|---|---:|---|---:|---:|---:|---|"


def cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ").replace("<", "&lt;")


def table_row(row: Mapping[str, Any]) -> str:
    sight = words.percent(row["detectable"]) if row["detectable"] is not None else "nothing"
    is_timed = row["n"] > 0
    name = row["name"].replace("`", "'").replace("|", "\\|")
    cells = [row["verdict"], words.percent(row["ratio"]) if is_timed else "",
             words.interval(row) + f" n={row['n']}" if is_timed else "",
             words.nanoseconds(row["base_ns"]) if is_timed else "",
             f"{100 * (row['margin'] - 1):.1f}%" if is_timed else "", sight if is_timed else "",
             "; ".join(filter(None, [words.instructions(row), *words.remarks(row)]))]
    cells = [cell(text) for text in cells]
    cells.insert(1, f"`{name}`")  # in code, nothing but the bar has a meaning
    return "| " + " | ".join(cells) + " |"


def fit(lines: Sequence[str], budget: int, what: str) -> List[str]:
    """As many lines as fit into so many bytes, and a word on the rest."""
    kept: List[str] = []
    for number, line in enumerate(lines):
        budget -= len(line.encode("utf-8")) + 1
        if budget < 100:
            kept.append(f"{len(lines) - number} more {what}: see report.html")
            break
        kept.append(line)
    return kept


def shortened(text: str, limit: int) -> str:
    return text if len(text) <= limit else text[:limit - 3] + "..."


def markdown(report: Mapping[str, Any]) -> str:
    rows = words.worst_first(report["benchmarks"])
    failures = [row for row in rows if words.is_failure(row)]
    lines = [MARKER, f"**{cell(shortened(report['headline'], 2000))}**", "",
             f"{words.tally(rows)}."]
    lines += [f"- {words.suite_line(suite)}" for suite in report["suites"]]
    lines += fit([f"- {shortened(note, 500)}" for note in report["notes"]], 5000, "notes")
    if rows:
        lines += ["", HEADER, RULE]
        lines += fit([table_row(row) for row in rows[:OPEN_ROWS]], 25000, "rows")
    if failures:
        lines += ["", "Measure again:", "```sh"]
        lines += fit([words.reproduce(report, row) for row in failures[:OPEN_ROWS]], 8000, "commands")
        lines.append("```")
    if len(rows) > OPEN_ROWS:
        used = sum(len(line.encode("utf-8")) + 1 for line in lines)
        rest = [table_row(row) for row in rows[OPEN_ROWS:]]
        lines += ["", f"<details><summary>{len(rest)} more</summary>", "", HEADER, RULE]
        lines += fit(rest, MAX_BYTES - used - 600, "rows")
        lines += ["", "</details>"]
    host = report["host"]
    lines += ["", f"{cell(str(host.get('cpu', 'host not recorded')))}; seed {report['seed']}; "
              f"{cell(report['tool'])}; exit {report['exit']}."]
    return "\n".join(lines) + "\n"
