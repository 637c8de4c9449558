"""Reading a configuration file: TOML where Python has a reader for it (3.11), JSON everywhere."""

from __future__ import annotations

import pathlib
from typing import Any

from ..errors import usage
from .config import Config, config_of
from .jsonio import loads, read_text


def parse_toml(text: str, where: str) -> Any:
    try:
        import tomllib  # type: ignore[import-not-found,unused-ignore]
    except ImportError:
        raise usage(f"{where}: TOML needs Python 3.11; write the same table as JSON") from None
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise usage(f"{where}: not TOML: {error}") from None


def read_config(path: str) -> Config:
    text = read_text(path)
    suffix = pathlib.PurePath(path).suffix.lower()
    if suffix not in (".toml", ".json"):
        raise usage(f"{path}: a configuration is a .toml or a .json file")
    return config_of(parse_toml(text, path) if suffix == ".toml" else loads(text, path), path)
