"""The command line."""

from __future__ import annotations

import argparse
import sys
from typing import List

from . import __version__
from .errors import GateError, USAGE
from .simulate import command as simulate

COMMANDS = [
    ("simulate", simulate, "count false reds and detections in simulated runs"),
]


class Parser(argparse.ArgumentParser):
    """Reports mistakes in one line, with the exit code of all usage errors."""

    def error(self, message: str) -> None:  # type: ignore[override]
        raise GateError(USAGE, f"{message} (see {self.prog} --help)")


def make_parser() -> argparse.ArgumentParser:
    parser = Parser(prog="perfgate", description="Says whether one build of a Google Benchmark "
                    "program is slower than another.")
    parser.add_argument("--version", action="version", version=f"perfgate {__version__}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=Parser)
    for name, module, summary in COMMANDS:
        command = commands.add_parser(name, help=summary, description=module.__doc__,
                                      formatter_class=argparse.RawDescriptionHelpFormatter)
        module.add_arguments(command)
        command.set_defaults(main=module.main)
    return parser


def main(arguments: List[str]) -> int:
    parser = make_parser()
    try:
        options = parser.parse_args(arguments)
        if options.command is None:
            parser.error("no command")
        return options.main(options)
    except GateError as error:
        print(f"perfgate: error: {error}", file=sys.stderr)
        return error.code
