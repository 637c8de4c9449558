"""Exit codes, and the error that carries one."""

from __future__ import annotations

OK = 0            # no confirmed regression
REGRESSION = 1    # at least one, or the suite's mean
USAGE = 2         # command line, configuration, waiver past its date, input that cannot be read
UNFIT = 3         # the host or a build cannot give a verdict
BROKEN = 4        # a benchmark crashed, hung, vanished or gave another result
UNDECIDED = 5     # inconclusive under --strict, or interrupted

MEANING = {
    OK: "no confirmed regression",
    REGRESSION: "confirmed regression",
    USAGE: "usage or configuration error",
    UNFIT: "host or build unfit for a verdict",
    BROKEN: "a benchmark crashed, timed out, vanished or gave a different result",
    UNDECIDED: "inconclusive under --strict, or interrupted",
}


class GateError(Exception):
    """Ends the program with a message and an exit code."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


def usage(message: str) -> GateError:
    return GateError(USAGE, message)
