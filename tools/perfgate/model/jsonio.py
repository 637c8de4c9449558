"""JSON, read with sentences for what is wrong and written the same way every time."""

from __future__ import annotations

import json
import os
import pathlib
import re
import tempfile
from typing import Any, Union

from ..errors import GateError, USAGE, usage

PathLike = Union[str, pathlib.Path]

# A list of plain values, as json.dumps lays it out with an indent. A string holds no line break, so
# nothing inside one can match.
SHORT_LIST = re.compile(r"\[\n\s+([^\[\]{}]*?)\n\s+\]")


def dumps(value: Any) -> str:
    """The text of `value`: the same bytes for the same value, lists of plain values on one line."""
    text = json.dumps(value, indent=1, ensure_ascii=True, allow_nan=False)
    return SHORT_LIST.sub(lambda m: "[" + re.sub(r"\n\s+", " ", m.group(1)) + "]", text) + "\n"


def loads(text: str, where: str) -> Any:
    try:
        return json.loads(text)
    except RecursionError:
        raise usage(f"{where}: nested too deeply to be read") from None
    except ValueError as error:
        raise usage(f"{where}: not JSON: {error}") from None


def read_text(path: PathLike) -> str:
    try:
        return pathlib.Path(path).read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise usage(f"{path}: not UTF-8: byte {error.start}") from None
    except OSError as error:
        raise usage(f"{path}: cannot be read: {error.strerror}") from None


def read(path: PathLike) -> Any:
    return loads(read_text(path), str(path))


def write_text(path: PathLike, text: str) -> None:
    """The whole file or none of it: a failed or killed write leaves what was there."""
    path = pathlib.Path(path)
    handle = None
    try:
        handle = tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=path.parent,
                                             prefix=path.name + ".", delete=False)
        with handle:
            handle.write(text)
            handle.flush()
            os.fsync(handle.fileno())
        os.chmod(handle.name, 0o644)
        os.replace(handle.name, path)
    except OSError as error:
        if handle is not None and os.path.exists(handle.name):
            os.unlink(handle.name)
        raise GateError(USAGE, f"{path}: cannot be written: {error.strerror}") from None
