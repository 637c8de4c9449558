"""One line on a terminal: how far, and how long still."""

from __future__ import annotations

import sys
import time


def duration(seconds: float) -> str:
    if seconds < 90:
        return f"{max(1, round(seconds))} s"
    return f"{round(seconds / 60)} min"


class Progress:
    """Silent where standard error is no terminal, or when told so."""

    def __init__(self, is_wanted: bool = True) -> None:
        self.is_shown = is_wanted and sys.stderr.isatty()
        self.last = 0.0

    def show(self, text: str, left_seconds: float = 0.0) -> None:
        now = time.monotonic()
        if not self.is_shown or now - self.last < 0.1:
            return
        self.last = now
        left = f", about {duration(left_seconds)} left" if left_seconds > 0 else ""
        print(f"\r\033[K{text}{left}", end="", file=sys.stderr, flush=True)

    def clear(self) -> None:
        if self.is_shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
