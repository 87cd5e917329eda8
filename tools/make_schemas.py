"""Modules of the messages in python/rsoccer/protocols/schemas, from the schemas beside them.

python -m tools.make_schemas [FOLDER]

It needs grpcio-tools, which has the compiler. FOLDER is for tests: the modules are written there.
"""

import importlib
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

from google.protobuf.descriptor_pb2 import FileDescriptorProto, FileDescriptorSet

from tools.paths import ROOT

PACKAGE: Final = "rsoccer/protocols/schemas"
"""Folder of the schemas in the package."""
LINE: Final = 96
"""Greatest length of a line of bytes."""


def make(folder: Path) -> list[Path]:
    """Write the modules of all schemas.

    Args:
        folder: folder for the files.

    Returns:
        The files, in the order of their names.
    """
    schemas = sorted((ROOT / "python" / PACKAGE).glob("*.proto"))
    with tempfile.TemporaryDirectory() as name:
        made = Path(name)
        _compile(schemas, made)
        files = FileDescriptorSet.FromString((made / "all").read_bytes()).file
        for file in files:
            (folder / _module_file(file.name)).write_text(module(file))
        for stub in (made / PACKAGE).glob("*_pb2.pyi"):
            (folder / stub.name).write_text(stub.read_text())
    return sorted(folder.glob("*_pb2.py*"))


def _compile(schemas: list[Path], made: Path) -> None:
    """Write a set of descriptors and stubs."""
    tool = importlib.import_module("grpc_tools")
    command = [sys.executable, "-W", "ignore", "-m", "grpc_tools.protoc"]
    folders = [f"-I{ROOT / 'python'}", f"-I{Path(tool.__path__[0]) / '_proto'}"]
    outputs = [f"--descriptor_set_out={made / 'all'}", f"--pyi_out={made}"]
    subprocess.run([*command, *folders, *outputs, *map(str, schemas)], check=True)


def module(file: FileDescriptorProto) -> str:
    """Return the text of the module of a schema.

    Args:
        file: descriptor of the schema.
    """
    needed = [Path(_module_file(name)).stem for name in file.dependency if PACKAGE in name]
    names = ", ".join(sorted([*needed, "pool"]))
    contents = "".join(f"    {line}\n" for line in _literals(file.SerializeToString()))
    arguments = "".join(f"    {name},\n" for name in needed)
    return (
        f'"""Messages of {Path(file.name).name}, made by `python -m tools.make_schemas`."""\n\n'
        f"from rsoccer.protocols.schemas import {names}\n\n"
        f"_SERIALIZED = (\n{contents})\n"
        f"globals().update(pool.load(\n    _SERIALIZED,\n{arguments}))\n"
    )


def _literals(data: bytes) -> list[str]:
    """Literals of bytes, a line each."""
    lines, start = [], 0
    for end in range(1, len(data) + 1):
        if end == len(data) or len(repr(data[start : end + 1])) > LINE:
            lines.append(repr(data[start:end]))
            start = end
    return lines


def _module_file(schema: str) -> str:
    return Path(schema).stem + "_pb2.py"


if __name__ == "__main__":
    for path in make(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "python" / PACKAGE):
        print(path)
