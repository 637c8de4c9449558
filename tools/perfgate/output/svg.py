"""Small pictures as inline SVG. Colours come from the page, so that they follow light and dark."""

from __future__ import annotations

import math
from typing import List, Optional, Sequence, Tuple

WIDTH, HEIGHT, PAD = 640, 84, 8


def number(value: float) -> str:
    return f"{value:.1f}".rstrip("0").rstrip(".")


class Scale:
    """Values to places."""

    def __init__(self, low: float, high: float, start: float, end: float) -> None:
        if high <= low:
            low, high = low - 0.01, high + 0.01
        self.low, self.high, self.start, self.end = low, high, start, end

    def __call__(self, value: float) -> float:
        clipped = min(self.high, max(self.low, value))
        return self.start + (clipped - self.low) / (self.high - self.low) * (self.end - self.start)


def limits(values: Sequence[float], always: Sequence[float]) -> Tuple[float, float]:
    """A range that shows all but the far tails: outliers are drawn at the edge."""
    ordered = sorted(values)
    cut = len(ordered) // 20
    inner = list(ordered[cut:len(ordered) - cut] or ordered) + list(always)
    low, high = min(inner), max(inner)
    room = 0.08 * (high - low) or 0.01
    return low - room, high + room


def step_of(span: float, most: int) -> float:
    """A round step of which at most `most` fit into the span."""
    raw = span / most
    size = 10.0 ** math.floor(math.log10(raw))
    return next(size * factor for factor in (1, 2, 5, 10) if size * factor >= raw)


def ticks(scale: Scale, most: int) -> List[float]:
    step = step_of(scale.high - scale.low, most)
    first = math.ceil(scale.low / step)
    return [step * i for i in range(first, int(math.floor(scale.high / step)) + 1)]


def percent(log: float) -> str:
    value = 100 * math.expm1(log)
    return f"{value:+.3g}%" if abs(value) > 1e-9 else "0"


def frame(label: str, height: int, parts: Sequence[str]) -> str:
    return (f'<svg viewBox="0 0 {WIDTH} {height}" role="img" aria-label="{label}">'
            + "".join(parts) + "</svg>")


def strip_plot(ratios: Sequence[float], margin: float, estimate: float, lower: Optional[float],
               upper: Optional[float]) -> str:
    """All log ratios of one benchmark as dots, the margin as a band, the interval as a bar."""
    always = [-margin, margin, estimate] + [v for v in (lower, upper) if v is not None]
    scale = Scale(*limits(ratios, always), PAD, WIDTH - PAD)
    parts = [f'<rect class="band" x="{number(scale(-margin))}" y="4" height="56" '
             f'width="{number(scale(margin) - scale(-margin))}"/>']
    for value in ticks(scale, 8):
        x = number(scale(value))
        parts.append(f'<line class="grid" x1="{x}" x2="{x}" y1="4" y2="60"/>'
                     f'<text x="{x}" y="78" text-anchor="middle">{percent(value)}</text>')
    x = number(scale(0.0))
    parts.append(f'<line class="zero" x1="{x}" x2="{x}" y1="4" y2="60"/>')
    for i, value in enumerate(ratios):
        y = 12 + 26 * ((i * 0.618034) % 1.0)  # spread evenly, the same every time
        parts.append(f'<circle class="dot" cx="{number(scale(value))}" cy="{number(y)}" r="2.6"/>')
    if lower is not None and upper is not None:
        parts.append(f'<line class="interval" x1="{number(scale(lower))}" '
                     f'x2="{number(scale(upper))}" y1="51" y2="51"/>')
    x = number(scale(estimate))
    parts.append(f'<line class="estimate" x1="{x}" x2="{x}" y1="44" y2="58"/>')
    return frame("log ratios of all pairs", HEIGHT, parts)


def polyline(values: Sequence[float], scale: Scale, css: str) -> str:
    step = (WIDTH - 2 * PAD) / max(1, len(values) - 1)
    points = " ".join(f"{number(PAD + step * i)},{number(scale(v))}" for i, v in enumerate(values))
    return f'<polyline class="{css}" points="{points}"/>'


def drift_plot(base: Sequence[float], head: Sequence[float]) -> str:
    """The times of both sides, round by round: what moves both alike is the host."""
    scale = Scale(*limits(list(base) + list(head), ()), HEIGHT - 6, 6)
    return frame("times of base and head in each round", HEIGHT,
                 [polyline(base, scale, "base"), polyline(head, scale, "head")])


def series_plot(values: Sequence[float], marks: Sequence[int], label: str) -> str:
    """One value a commit, with a line where it changed for good."""
    scale = Scale(*limits(values, (min(values), max(values))), HEIGHT - 6, 6)
    step = (WIDTH - 2 * PAD) / max(1, len(values) - 1)
    parts = [polyline(values, scale, "head")]
    for mark in marks:
        x = number(PAD + step * (mark - 0.5))
        parts.append(f'<line class="change" x1="{x}" x2="{x}" y1="2" y2="{HEIGHT - 2}"/>')
    parts += [f'<circle class="dot" cx="{number(PAD + step * i)}" cy="{number(scale(v))}" r="2.2"/>'
              for i, v in enumerate(values)]
    return frame(label, HEIGHT, parts)
