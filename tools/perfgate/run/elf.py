"""What of a program decides how it runs: its machine code and its constants, and those of the
libraries it loads. Debug information, names and build ids do not count."""

from __future__ import annotations

import hashlib
import pathlib
import re
import struct
import subprocess
from typing import Dict, Iterator, List, Optional, Tuple

EXECUTABLE = 0x4  # SHF_EXECINSTR
DATA = (".rodata", ".data", ".init_array", ".tdata")
NO_BITS = 8       # SHT_NOBITS


def sections(data: bytes) -> Iterator[Tuple[str, int, bytes]]:
    """Name, flags and contents of each section. Raises ValueError or struct.error on what is no
    64-bit little-endian ELF file, or a broken one."""
    if data[:6] != b"\x7fELF\x02\x01":
        raise ValueError("no 64-bit little-endian ELF file")
    offset, = struct.unpack_from("<Q", data, 0x28)
    size, count, names = struct.unpack_from("<HHH", data, 0x3A)
    headers = [struct.unpack_from("<IIQQQQ", data, offset + i * size) for i in range(count)]
    if names >= count:
        raise ValueError("no names of sections")
    texts = data[headers[names][4]:headers[names][4] + headers[names][5]]
    for name, kind, flags, _address, start, length in headers:
        end = texts.find(b"\0", name)
        yield (texts[name:end].decode("ascii", "replace"), flags,
               b"" if kind == NO_BITS else data[start:start + length])


def own_code_hash(path: str) -> Optional[str]:
    """Of one file; None where it is no such program."""
    try:
        found = hashlib.sha256()
        for name, flags, contents in sections(pathlib.Path(path).read_bytes()):
            if flags & EXECUTABLE or name.startswith(DATA):
                found.update(f"{name} {len(contents)}\n".encode())
                found.update(contents)
        return found.hexdigest()
    except (OSError, ValueError, struct.error):
        return None


def libraries(path: str) -> Optional[List[str]]:
    """Paths of the shared libraries that would be loaded; None if one would not be found."""
    try:
        ran = subprocess.run(["ldd", path], check=False, stdout=subprocess.PIPE,
                             stderr=subprocess.DEVNULL, timeout=30, text=True)
    except (OSError, subprocess.TimeoutExpired):
        return None
    if "not found" in ran.stdout:
        return None
    return sorted(re.findall(r"(?:=>|^)\s*(/\S+) \(0x", ran.stdout, re.MULTILINE))


def code_hash(path: str, known: Optional[Dict[str, Optional[str]]] = None) -> Optional[str]:
    """Of a program with its libraries. None where it is not known, and so never equal to another."""
    known = {} if known is None else known
    own = own_code_hash(path)
    loaded = libraries(path) if own is not None else None
    if own is None or loaded is None:
        return None
    whole = hashlib.sha256(own.encode())
    for library in loaded:
        if library not in known:
            known[library] = own_code_hash(library)
        if known[library] is None:
            return None
        whole.update(str(known[library]).encode())
    return whole.hexdigest()


def compiler_of(path: str) -> Optional[str]:
    """What the compilers left in the section .comment."""
    try:
        for name, _, contents in sections(pathlib.Path(path).read_bytes()):
            if name == ".comment":
                parts = {part.decode("ascii", "replace") for part in contents.split(b"\0") if part}
                return "; ".join(sorted(parts))
    except (OSError, ValueError, struct.error):
        pass
    return None
