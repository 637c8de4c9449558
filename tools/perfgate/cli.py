"""The command line."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from typing import List

from . import __version__
from .errors import GateError, UNDECIDED, UNFIT, USAGE
from . import analyze
from .history import command as history
from .run import aa, host
from .run import command as run
from .run.process import Interrupted
from .simulate import command as simulate

COMMANDS = [
    ("run", run, "compare two builds"),
    ("analyze", analyze, "judge a stored report again"),
    ("aa", aa, "compare a program with itself, to know its noise"),
    ("host", host, "say how noisy this host is"),
    ("history", history, "keep times, and find what drifts"),
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
        return int(options.main(options))
    except GateError as error:
        print(f"perfgate: error: {error}", file=sys.stderr)
        return error.code
    except Interrupted as error:
        print(f"perfgate: interrupted ({error.name})", file=sys.stderr)
        return UNDECIDED
    except BrokenPipeError:
        # Whoever read our output has gone; nothing is left to say it to.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return USAGE
    except Exception:  # pylint: disable=broad-except
        # Python would end with 1, which means a regression.
        traceback.print_exc()
        print("perfgate: error: a mistake in perfgate itself; there is no verdict", file=sys.stderr)
        return UNFIT
