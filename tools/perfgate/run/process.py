"""One child process: its own group, killed whole; its time, its peak memory, its output."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from typing import IO, Mapping, Optional, Sequence

MAX_OUTPUT_BYTES = 64 * 1024 * 1024
POLL_SECONDS = 0.01


class Interrupted(BaseException):
    """A signal asked this program to end. Not an Exception: nothing catches it by accident."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name


def raise_on_signals() -> None:
    """From now on SIGINT and SIGTERM raise Interrupted wherever the program is."""
    def handle(number: int, _frame: object) -> None:
        raise Interrupted(signal.Signals(number).name)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, handle)


@dataclass(frozen=True)
class Finished:
    """How a process ended."""

    pid: int
    status: int          # exit status, or minus the signal
    is_timed_out: bool
    seconds: float
    peak_bytes: int      # largest resident size
    stdout: str
    stderr: str

    def failure(self, timeout: float) -> Optional[str]:
        """Why nothing it said counts; None if it ended well."""
        if self.is_timed_out:
            return f"timed out after {timeout:g} s and was killed"
        if self.status == 0:
            return None
        lines = self.stderr.strip().splitlines()
        said = f": {lines[-1][:200]}" if lines else ""
        if self.status < 0:
            try:
                name = signal.Signals(-self.status).name
            except ValueError:
                name = f"signal {-self.status}"
            return f"crashed with {name}{said}"
        return f"ended with status {self.status}{said}"


def kill_group(pid: int) -> None:
    """The process and all it started, as far as they stayed in its group."""
    try:
        os.killpg(pid, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass


def wait_until(pid: int, timeout: float) -> bool:
    """Whether the child ended in time. Sleeps without waking up, so as not to disturb the measured
    process, where the system can tell (Linux 5.3)."""
    try:
        descriptor = os.pidfd_open(pid)
    except (AttributeError, OSError):
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            if os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None:
                return True
            time.sleep(POLL_SECONDS)
        return False
    try:
        return bool(select.select([descriptor], [], [], timeout)[0])
    finally:
        os.close(descriptor)


def contents(file: IO[bytes]) -> str:
    file.seek(0)
    return file.read(MAX_OUTPUT_BYTES).decode("utf-8", errors="replace")


def run_process(command: Sequence[str], timeout: float,
                environment: Optional[Mapping[str, str]] = None,
                folder: Optional[str] = None) -> Finished:
    """Runs a command to its end, or kills it and all it started. An OSError where it cannot be
    started."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        start = time.monotonic()
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                 env=environment, cwd=folder, start_new_session=True)
        is_in_time = False
        try:
            is_in_time = wait_until(child.pid, timeout)
        finally:
            # Also what it left behind when it ended by itself, or when this program is interrupted.
            kill_group(child.pid)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.WEXITSTATUS(status) if os.WIFEXITED(status) else \
                -os.WTERMSIG(status)
        return Finished(child.pid, child.returncode, not is_in_time, time.monotonic() - start,
                        usage.ru_maxrss * 1024, contents(out), contents(err))
