"""The compiled module as its stub describes it."""

import __future__

from pathlib import Path
from types import ModuleType
from typing import Final

import rsoccer
from rsoccer import _core

NAME: Final = "rsoccer._core"
PATH: Final = Path(rsoccer.__file__).parent / "_core.pyi"


def load() -> ModuleType:
    """Return a module made of the stub: signatures with types, and full docstrings.

    Its constants have the values of the compiled module, which a stub does not hold.
    """
    module = ModuleType(NAME)
    vars(module).update(vars(_core))
    module.__file__ = str(PATH)
    flags = __future__.annotations.compiler_flag  # a class may name itself in annotations
    exec(compile(PATH.read_text(), str(PATH), "exec", flags), module.__dict__)
    return module
