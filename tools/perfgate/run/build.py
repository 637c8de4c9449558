"""Two git refs, built on this host in the same way: from the configuration's table `build`.

    configure   arguments for cmake; {source} and {build} stand for the folders
    build       arguments for cmake --build {build}
    executable  the program, below the build folder
    layouts     {name: [more arguments for configure]}: the same code, linked in other ways
    folder      where worktrees and builds are kept from run to run (below the output folder)
"""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
from typing import Any, Dict, List, Mapping, Optional, Sequence

from ..errors import GateError, UNFIT, usage
from ..model.config import Config

# With functions in sections of their own, sorting these puts the code into another order.
DEFAULT_LAYOUTS = {
    "functions at 64 bytes": ["-DCMAKE_CXX_FLAGS=-falign-functions=64"],
    "functions in another order": ["-DCMAKE_CXX_FLAGS=-ffunction-sections",
                                   "-DCMAKE_EXE_LINKER_FLAGS=-Wl,--sort-section=name"],
}
DEFAULT_CONFIGURE = ["-DCMAKE_BUILD_TYPE=Release"]


def git(arguments: Sequence[str], folder: Optional[str] = None) -> str:
    try:
        ran = subprocess.run(["git", *arguments], check=False, stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, text=True, cwd=folder)
    except OSError as error:
        raise usage(f"git cannot be started: {error.strerror}") from None
    if ran.returncode != 0:
        said = ran.stderr.strip().splitlines() or ["no message"]
        raise usage(f"git {' '.join(arguments[:3])}: {said[-1]}")
    return ran.stdout.strip()


def commit_of(ref: str) -> str:
    return git(["rev-parse", "--verify", "--quiet", f"{ref}^{{commit}}"]) if ref else ""


def resolve(base_ref: str, head_ref: str, is_exact: bool) -> Dict[str, str]:
    """The two commits. The base is where the head left it, unless the very commit is wanted."""
    for ref in (base_ref, head_ref):
        try:
            commit_of(ref)
        except GateError:
            raise usage(f"{ref}: no such commit in this repository") from None
    head = commit_of(head_ref)
    base = commit_of(base_ref)
    return {"base": base if is_exact else git(["merge-base", base, head]), "head": head}


def quiet(command: Sequence[str], log: pathlib.Path, environment: Mapping[str, str]) -> None:
    """Runs a command with its output in a log; GateError with the log's end where it fails."""
    with open(log, "w", encoding="utf-8") as file:
        try:
            ran = subprocess.run(command, check=False, stdout=file, stderr=subprocess.STDOUT,
                                 stdin=subprocess.DEVNULL, env=dict(environment))
        except OSError as error:
            raise GateError(UNFIT, f"{command[0]} cannot be started: {error.strerror}") from None
    if ran.returncode != 0:
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
        raise GateError(UNFIT, f"{' '.join(command[:3])} ... failed (see {log}): "
                        + " / ".join(lines[-3:])[:400])


class Builder:
    """Worktrees and builds below one folder."""

    def __init__(self, config: Config, folder: pathlib.Path) -> None:
        if "executable" not in config.build:
            raise usage("--base-ref and --head-ref need the table 'build' of the configuration, with "
                        "at least 'executable'")
        self.table = config.build
        self.folder = pathlib.Path(config.build.get("folder") or folder / "builds").resolve()

    def worktree(self, commit: str) -> pathlib.Path:
        path = self.folder / commit[:12] / "source"
        if not (path / ".git").exists():
            shutil.rmtree(path, ignore_errors=True)
            path.parent.mkdir(parents=True, exist_ok=True)
            git(["worktree", "prune"])
            git(["worktree", "add", "--detach", "--force", str(path), commit])
        return path

    def program(self, commit: str, layout: str = "", more: Sequence[str] = ()) -> str:
        """The path of the built program."""
        source = self.worktree(commit)
        name = "build" + "".join(c if c.isalnum() else "_" for c in layout and f" {layout}")
        build = source.parent / name
        build.mkdir(exist_ok=True)
        places = {"{source}": str(source), "{build}": str(build)}

        # The same file names in both programs: else assertions and logs would make code differ.
        same_names = f"-ffile-prefix-map={source}=."

        def filled(arguments: Sequence[str]) -> List[str]:
            texts = []
            for text in arguments:
                for place, path in places.items():
                    text = text.replace(place, path)
                # Flags given here take the place of those of the environment.
                if text.startswith(("-DCMAKE_C_FLAGS=", "-DCMAKE_CXX_FLAGS=")):
                    text = f"{text} {same_names}"
                texts.append(text)
            return texts

        environment = {**os.environ}
        for key in ("CFLAGS", "CXXFLAGS"):
            environment[key] = f"{os.environ.get(key, '')} {same_names}".strip()
        configure = self.table.get("configure", DEFAULT_CONFIGURE)
        quiet(["cmake", "-S", str(source), "-B", str(build), *filled(configure), *filled(more)],
              build / "configure.log", environment)
        quiet(["cmake", "--build", str(build), *filled(self.table.get("build", []))],
              build / "build.log", environment)
        path = build / self.table["executable"]
        if not path.is_file():
            raise GateError(UNFIT, f"{path} was not built (build.executable)")
        return str(path)

    def layouts(self) -> Mapping[str, List[str]]:
        chosen: Any = self.table.get("layouts", DEFAULT_LAYOUTS)
        return dict(chosen)
