"""One gate at a time on a host: two would measure each other."""

from __future__ import annotations

import fcntl
import os
import pathlib
import tempfile
from typing import IO, Optional

from ..errors import GateError, UNFIT


def lock_path() -> pathlib.Path:
    return pathlib.Path(os.environ.get("PERFGATE_LOCK", "") or
                        pathlib.Path(tempfile.gettempdir()) / "perfgate.lock")


class HostLock:
    """Held while the block runs; the system lets go of it when the process dies."""

    def __init__(self) -> None:
        self.file: Optional[IO[str]] = None

    def __enter__(self) -> "HostLock":
        path = lock_path()
        try:
            # Whoever made it, everybody must be able to hold it.
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        except OSError as error:
            raise GateError(UNFIT, f"{path}: cannot be locked: {error.strerror}") from None
        self.file = os.fdopen(descriptor, "r+")
        try:
            fcntl.flock(self.file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            holder = self.file.read(20).strip() or "unknown"
            self.file.close()
            raise GateError(UNFIT, f"another gate measures on this host (process {holder}, "
                            f"{path}): two would measure each other") from None
        self.file.seek(0)
        self.file.truncate()
        self.file.write(f"{os.getpid()}\n")
        self.file.flush()
        return self

    def __exit__(self, *_: object) -> None:
        if self.file is not None:
            self.file.close()
