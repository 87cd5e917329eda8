"""Ways to say which simulator moves the robots, and which sensor model they have.

Every interface takes the arguments `simulator` and `sensing` as they are described here. A text
"module:name" suits settings that are stored, environments that are made by name, and worker
processes: the module is imported where the matches are made.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from contextlib import (
    AbstractContextManager,
    ExitStack,
    closing,
    contextmanager,
    nullcontext,
)
from typing import Any, Final, TypeAlias, TypeVar

from rsoccer import plugins
from rsoccer._core import Sensing, SimConfig, Simulator, Threads
from rsoccer.senses import SensorModel
from rsoccer.simulator_interface import Closer, Stepper

SimulatorFactory: TypeAlias = Callable[[SimConfig, int, Threads], Stepper]
"""Makes a simulator from robots, ball and field, the number of worlds, and the threads of the
matches. `rsoccer.Simulator` is one."""
NETWORK_SIMULATORS: Final = {
    "grsim": "rsoccer.drive:grsim",
    "firasim": "rsoccer.drive:firasim",
    "ssl-simulation": "rsoccer.drive:ssl_simulation",
}
"""Names of simulators on the network of this machine, which step one match at a time."""
SimulatorSource: TypeAlias = SimulatorFactory | Stepper | str
"""A factory, its "module:name", a name of `NETWORK_SIMULATORS`, or a simulator of one's own, which
serves one object only: an environment with it cannot be copied."""
SensingSource: TypeAlias = Sensing | SensorModel | str
"""A `Sensing`, its text as in "rc2021" or "rc2021, delay=0.1", its .json file, a sensor model, or
"module:name" of one of them or of a function without arguments that makes it."""
_Closer = TypeVar("_Closer", bound=Closer)


def plays_one_match(source: SimulatorSource | None) -> bool:
    """Return whether a simulator steps one match at a time, as those on a network do.

    Args:
        source: the factory or the simulator; None for `rsoccer.Simulator`.

    Raises:
        ImportError: a text whose module or name does not exist.
        ValueError: a text of another form.
    """
    return bool(getattr(_found(source), "plays_one_match", False))


def _found(source: SimulatorSource | None) -> object:
    """A source, with a text replaced by what it names."""
    if isinstance(source, str):
        if source not in NETWORK_SIMULATORS and ":" not in source:
            names = ", ".join(NETWORK_SIMULATORS)
            raise ValueError(f"simulator: expected {names} or a text 'module:name', got {source!r}")
        return plugins.find("simulator", NETWORK_SIMULATORS.get(source, source))
    return source


def make_simulator(
    source: SimulatorSource | None, config: SimConfig, worlds: int, threads: Threads
) -> Stepper:
    """Return the simulator of some matches.

    Args:
        source: the factory or the simulator; None for `rsoccer.Simulator`.
        config: robots, ball and field to simulate.
        worlds: number of worlds, at least 1.
        threads: threads that do other work too.

    Raises:
        ImportError: a text whose module or name does not exist.
        TypeError: neither a factory nor a simulator, or a factory that makes none.
        ValueError: a text of another form.
    """
    if source is None:
        return Simulator(config, worlds, threads)
    factory: Any = _found(source)
    made: Any = factory
    if callable(factory):
        expected = "a function (config, worlds, threads)"
        _check_signature("simulator", expected, factory, config, worlds, threads)
        made = factory(config, worlds, threads)
    if not callable(getattr(made, "step", None)):
        expected = "a simulator, a function (config, worlds, threads) that makes one, or its text"
        got = f"{factory!r}, which made {made!r}" if callable(factory) else repr(made)
        raise TypeError(f"simulator: expected {expected}, got {got}")
    stepper: Stepper = made
    return stepper


def _check_signature(
    argument: str, expected: str, factory: Callable[..., object], *arguments: object
) -> None:
    """Refuse a factory that does not take the arguments; errors in it are its own."""
    try:
        signature = inspect.signature(factory)
    except ValueError:  # of compiled functions without a signature
        return
    try:
        signature.bind(*arguments)
    except TypeError as error:
        raise TypeError(
            f"{argument}: expected {expected}, got {factory!r} with {signature}: {error}"
        ) from error


def is_shared(source: object) -> bool:
    """Return whether a source is a simulator itself, which two objects cannot both use.

    Args:
        source: a `SimulatorSource` or None.
    """
    return not (source is None or isinstance(source, str) or callable(source))


def closed_after(
    matches: _Closer, source: SimulatorSource | None
) -> AbstractContextManager[_Closer]:
    """Return a context manager that closes matches at its end, also after an error.

    A simulator that was given itself stays open: its owner closes it.

    Args:
        matches: what `Matches` is.
        source: what their simulator was made from.
    """
    return nullcontext(matches) if is_shared(source) else closing(matches)


@contextmanager
def closed_on_error(matches: Closer, source: SimulatorSource | None = None) -> Iterator[None]:
    """Return a context manager that closes matches if its block raises, as `closed_after` does.

    Args:
        matches: what `Matches` is.
        source: what their simulator was made from; None to close it whatever it was.
    """
    with ExitStack() as on_error:
        on_error.enter_context(closed_after(matches, source))
        yield
        on_error.pop_all()


def make_sensing(source: SensingSource | None) -> Sensing | SensorModel | None:
    """Return what lies between the true state of some matches and what robots know.

    Args:
        source: the model or its text; None if robots know the true state.

    Returns:
        The model; None also for a `Sensing` without any effect.

    Raises:
        ImportError: a text whose module or name does not exist.
        TypeError: no sensor model, or a function that takes arguments.
        ValueError: a text that is no preset's name.
    """
    model: Any = source
    if isinstance(source, str) and ":" in source:
        model = plugins.find("sensing", source)
        if callable(model):
            _check_signature("sensing", "a model or a function without arguments", model)
            model = model()
    elif isinstance(source, str):
        model = Sensing(source)
    methods = ("columns", "begin", "sense")
    if model is None and source is None:
        return None
    if isinstance(model, Sensing):
        return None if model.is_off else model
    if isinstance(model, type) or not all(callable(getattr(model, m, None)) for m in methods):
        raise TypeError(
            "sensing: expected a rsoccer.Sensing, the name of its preset, a "
            f"rsoccer.senses.SensorModel or its text, got {model!r}"
        )
    found: SensorModel = model
    return found
