"""The file format of trained policies: its definition, reading, checks and writing.

A policy file is one safetensors file, `policy.safetensors`. It holds a perceptron, the
normalization of its observations, and how it acts. With observation size o, action size a, layers
0 to k and c choices:

| array | shape | dtype | content |
| --- | --- | --- | --- |
| `layers.<i>.weight` | (out, in) | float32 | weights of layer i; layer 0 takes o |
| `layers.<i>.bias` | (out,) | float32 | biases of layer i |
| `mean` | (o,) | float32 | mean of the observations in training |
| `std` | (o,) | float32 | standard deviation of the observations in training, above 0 |
| `action_std` | (a,) | float32 | standard deviation of the actions in training, above 0; optional |
| `action_table` | (c, a) | float32 | actions that the policy chooses from; only with such a head |
| `value.<i>.weight` | (out, in) | float32 | weights of layer i of the value network; optional |
| `value.<i>.bias` | (out,) | float32 | biases of layer i of the value network; the last has 1 |

All numbers are finite. Arrays may be float16, which is half the size; they are read as float32.
The metadata are text:

| key | value | meaning |
| --- | --- | --- |
| `format` | `rsoccer-policy-2`; `-3` with a head or deviation | version of this format |
| `task` | a task's name | task of the training, for `make_task` |
| `task_options` | JSON object; optional | options of `make_task` that the training set |
| `sensing` | JSON of a `Sensing`, or `module:name`; optional | what robots know, see below |
| `randomization` | JSON object; optional | distributions of numbers in training, by name |
| `observation_size` | o | numbers in an observation, a stacked one with a `history` |
| `action_size` | a | numbers in an action |
| `activation` | `tanh`, `relu`, ... | after each layer but the last, see `activations` |
| `head` | `gaussian` (default), ... | meaning of the outputs of layer k, see `heads` |
| `deviation` | such as `exp -20 2`; optional | standard deviation as a function of outputs |
| `clip` | above 0, default 10 | bound of a normalized observation, in standard deviations |
| `action_repeat` | 1 (default) to 1000000 | control steps for which an action is held |
| `history` | 1 (default) or more | observations in a stacked one, see `rsoccer.history` |
| `shield` | `vsss` or `ssl_attack`; optional | changes actions against rules, see `shield` |
| `value` | JSON object; with `value.<i>` | `discount`, `action_repeat`, `reward_std`, see below |
| `layout` | `Task.layout`; optional | observation blocks of the task; must equal those in play |
| `training` | JSON object; optional | `command`, `samples`, `seed`, `package`, `physics` |
| `scores` | JSON list; optional | results: objects with the fields of `Score` |

Other heads than the plain Gaussian, and deviations, are described in `rsoccer.policies.heads`.

`training` says how the policy was made: the command, the decisions that it learned from, the seed,
and the versions of the package and of its physics in which the scores were measured. `sensing` and
`randomization` are those of the matches in which it learned, as `Matches` takes them, or for which
a policy that learned on the true state was found to be good behind a forecast; they are absent
where robots knew the true state and no numbers varied. Of them `forecast` alone changes how it
plays: its team forecasts where senses are on.

The outputs for an observation x are

    h = clip((x - mean) / std, -clip, clip)
    h = activation(weight @ h + bias)   for layers 0 to k - 1
    outputs = weight @ h + bias         for layer k

The value network reads the same h, has the same activation, and says what return a robot expects:
the sum over later decisions of their rewards, divided by `reward_std` and discounted by `discount`
a decision, which lasts `action_repeat` control steps. `rsoccer.policies.lookahead` plays with it.

With the head `gaussian` they are the mean action. With `action_std` an action is drawn as
`mean + action_std * N(0, 1)`. Then it is clipped to [-1, 1]. Equal policies give equal bytes.
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from rsoccer import checks
from rsoccer.arrays import Array, Floats
from rsoccer.files import read_safetensors, safetensors_bytes, write_atomically
from rsoccer.history import ObservationStack
from rsoccer.policies.activations import ACTIVATIONS
from rsoccer.policies.heads import Head
from rsoccer.policies.shield import SHIELDS, Shield

FORMAT: Final = "rsoccer-policy-2"
"""Version of the format. A new number makes older readers refuse the file."""

HEAD_FORMAT: Final = "rsoccer-policy-3"
"""Version for files with another head than the plain Gaussian, which older readers do not know."""

MAX_ACTION_REPEAT: Final = 1_000_000
"""Upper bound of `action_repeat`, control steps: some seven hours of play."""

SUFFIX: Final = ".safetensors"
"""End of the names of policy files."""

ONNX_SUFFIX: Final = ".onnx"
"""End of the names of ONNX files, which play as policies too."""

SUFFIXES: Final = (SUFFIX, ONNX_SUFFIX)
"""Ends of the names of files that play as policies."""

LOOKAHEAD: Final = "lookahead"
"""Word after the path of a file, or after the name of its policy: it plays with a lookahead."""

TACTICS_FORMAT: Final = "rsoccer-tactics-1"
"""Version of the files of `rsoccer.policies.evolved`. A new one makes older readers refuse them."""
INSTALL_HINT: Final = "writing policy files needs safetensors: pip install 'rsoccer[train]'"


POLICY: Final = "layers"
"""First part of the names of the policy's layers."""
VALUE: Final = "value"
"""First part of the names of the value network's layers, and key of its numbers."""


@dataclass(frozen=True)
class Value:
    """A value network: the return that a robot expects from what it observes."""

    layers: list[tuple[Floats, Floats]]
    """weight (out, in) and bias (out,) of each layer; the last has one output"""
    discount: float
    """discount of a decision, 0 to 1"""
    action_repeat: int
    """control steps of a decision in the training"""
    reward_std: float
    """rewards are divided by it, above 0"""

    def __post_init__(self) -> None:
        """Raise TypeError for numbers of other types, and ValueError for those out of range."""
        checks.number_in_range("value.discount", self.discount, 0.0, 1.0)
        checks.integer("value.action_repeat", self.action_repeat, 1)
        checks.positive_number("value.reward_std", self.reward_std)

    @property
    def text(self) -> str:
        """Its numbers, for the metadata."""
        names = ("discount", "action_repeat", "reward_std")
        return json.dumps({name: getattr(self, name) for name in names})

    def arrays(self) -> dict[str, Floats]:
        """Return its layers by their names in the file; not copied."""
        return named_layers(VALUE, self.layers)


@dataclass(frozen=True)
class Score:
    """Mean score of a policy over some matches, as `rsoccer.evaluate` measured it."""

    opponent: str
    """policies of the other team; "-" if there is none"""
    metric: str
    """metric of the task whose mean is the score"""
    matches: int
    """number of matches, half of them for each team in two-sided tasks"""
    score: float
    """mean"""
    low: float
    """lower bound of the 95% interval"""
    high: float
    """upper bound of the 95% interval"""
    sensing: str = ""
    """senses of the robots, as in "rc2021, forecast=1"; empty where they knew the true state"""


def read_metadata(metadata: Mapping[str, str]) -> tuple[np.float32, int]:
    """Check the metadata, except the sizes and the layout.

    Args:
        metadata: text by key, see the table of the module.

    Returns:
        `clip` (standard deviations) and `action_repeat` (control steps).

    Raises:
        ValueError: a missing or wrong value.
    """
    version = HEAD_FORMAT if {"head", "deviation"} & set(metadata) else FORMAT
    got = metadata.get("format")
    if got != version:
        hint = ", learned tactics, which rsoccer.policies.evolved.Evolved.load reads"
        hint = hint if got == TACTICS_FORMAT else ""
        raise ValueError(f"metadata 'format' should be {version!r}, got {got!r}{hint}")
    if metadata.get("activation") not in ACTIVATIONS:
        raise ValueError(
            f"metadata 'activation' should be one of {tuple(ACTIVATIONS)}, "
            f"got {metadata.get('activation')!r}"
        )
    if not metadata.get("task"):
        raise ValueError("metadata 'task' should name the task of the training, got nothing")
    clip = _read_number(metadata, "clip", "10")
    repeat = _read_whole_number(metadata, "action_repeat")
    if repeat > MAX_ACTION_REPEAT:
        raise ValueError(
            f"metadata 'action_repeat' should be at most {MAX_ACTION_REPEAT}, "
            f"got {metadata['action_repeat']!r}"
        )
    return np.float32(clip), repeat


def read_shield(metadata: Mapping[str, str]) -> Shield | None:
    """Read the shield of the policy's actions.

    Args:
        metadata: text by key.

    Returns:
        The shield; None for a policy without one.

    Raises:
        ValueError: an unknown shield.
    """
    name = metadata.get("shield")
    if name is None:
        return None
    if name not in SHIELDS:
        raise ValueError(f"metadata 'shield' should be one of {SHIELDS}, got {name!r}")
    return Shield(name)


def read_stack(metadata: Mapping[str, str], size: int, action_size: int) -> ObservationStack | None:
    """Read what the observations are stacked of.

    Args:
        metadata: text by key.
        size: numbers in a stacked observation.
        action_size: numbers in an action.

    Returns:
        The stack; None for a policy that reads plain observations.

    Raises:
        ValueError: a history that is no whole number of at least 1, or that does not fit the sizes.
    """
    history = _read_whole_number(metadata, "history")
    if history == 1:
        return None
    plain, rest = divmod(size - (history - 1) * action_size, history)
    if plain < 1 or rest:
        raise ValueError(
            f"metadata 'history' should fit the layers, which take {size} numbers: with actions of "
            f"{action_size} numbers, stacked observations of a history of {metadata['history']} "
            "have other sizes"
        )
    return ObservationStack(history, plain, action_size)


def _read_whole_number(metadata: Mapping[str, str], name: str) -> int:
    """A whole number of at least 1, which is the default."""
    number = _read_number(metadata, name, "1")
    if not number.is_integer():
        raise ValueError(f"metadata {name!r} should be a whole number, got {number}")
    return int(number)


def _read_number(metadata: Mapping[str, str], name: str, default: str) -> float:
    """A finite number above 0."""
    text = metadata.get(name, default)
    try:
        number = float(text)
    except ValueError:
        number = float("nan")
    if not (np.isfinite(number) and number > 0.0):
        raise ValueError(f"metadata {name!r} should be a finite number above 0, got {text!r}")
    return number


def read_layers(arrays: Mapping[str, Array]) -> list[tuple[Floats, Floats]]:
    """Read the layers of the policy, and check that there are no missing or unknown arrays.

    Args:
        arrays: all arrays of the file, by name.

    Returns:
        Weight (out, in) and bias (out,) of each layer, the input layer first.

    Raises:
        ValueError: missing or unknown arrays, or layers of sizes that do not match.
    """
    count, values = (_count(arrays, network) for network in (POLICY, VALUE))
    expected = {"mean", "std", *_names(POLICY, count), *_names(VALUE, values)}
    given = set(arrays) - {"action_std", "action_table"}
    if count == 0 or given != expected:
        odd = sorted(given ^ expected) or [f"{POLICY}.0.weight"]
        raise ValueError(f"missing or unknown arrays: {', '.join(odd)}")
    return _read_network(arrays, POLICY)


def read_value(arrays: Mapping[str, Array], metadata: Mapping[str, str], size: int) -> Value | None:
    """Read the value network.

    Args:
        arrays: all arrays of the file, by name.
        metadata: text by key.
        size: numbers in an observation, a stacked one with a history.

    Returns:
        The value network; None for a policy without one.

    Raises:
        ValueError: layers of sizes that do not match, or numbers that are missing or out of range.
    """
    text = metadata.get(VALUE)
    if not _count(arrays, VALUE):
        if text is not None:
            raise ValueError(f"metadata 'value' needs the arrays of a value network, got {text!r}")
        return None
    layers = _read_network(arrays, VALUE)
    sizes = layers[0][0].shape[1], len(layers[-1][1])
    if sizes != (size, 1):
        raise ValueError(
            f"the value network should take {size} numbers and give 1, got {sizes[0]} and "
            f"{sizes[1]}"
        )
    try:
        return Value(layers, **json.loads(text or ""))
    except (TypeError, ValueError) as error:
        raise ValueError(
            "metadata 'value' should be a JSON object with discount (0 to 1), action_repeat (1 or "
            f"more) and reward_std (above 0), got {text!r}: {error}"
        ) from error


def _count(arrays: Mapping[str, Array], network: str) -> int:
    """Number of layers of a network."""
    return sum(name.startswith(f"{network}.") and name.endswith(".weight") for name in arrays)


def _names(network: str, count: int) -> list[str]:
    """Names of the arrays of a network with some layers."""
    return [f"{network}.{index}.{part}" for index in range(count) for part in ("weight", "bias")]


def named_layers(network: str, layers: Sequence[tuple[Floats, Floats]]) -> dict[str, Floats]:
    """Return the arrays of a network by their names in the file; not copied.

    Args:
        network: `POLICY` or `VALUE`.
        layers: weight and bias of each layer.
    """
    arrays = itertools.chain.from_iterable(layers)
    return dict(zip(_names(network, len(layers)), arrays, strict=True))


def _read_network(arrays: Mapping[str, Array], network: str) -> list[tuple[Floats, Floats]]:
    """Weights and biases of a network."""
    layers: list[tuple[Floats, Floats]] = []
    for index in range(_count(arrays, network)):
        weight = _read_array(arrays, f"{network}.{index}.weight", (None, None))
        bias = _read_array(arrays, f"{network}.{index}.bias", (weight.shape[0],))
        if layers and weight.shape[1] != layers[-1][0].shape[0]:
            raise ValueError(
                f"{network}.{index}.weight takes {weight.shape[1]} numbers, "
                f"but the layer before gives {layers[-1][0].shape[0]}"
            )
        layers.append((weight, bias))
    return layers


def read_normalizer(arrays: Mapping[str, Array], size: int) -> tuple[Floats, Floats]:
    """Read the normalization of observations.

    Args:
        arrays: arrays by name, with `mean` and `std`.
        size: numbers in an observation.

    Returns:
        Mean and standard deviation, (o,) each.

    Raises:
        ValueError: an array of another shape or type, or a deviation that is not above 0.
    """
    mean, std = _read_array(arrays, "mean", (size,)), _read_array(arrays, "std", (size,))
    if not (std > 0.0).all():
        raise ValueError(f"array 'std' should be above 0 everywhere, got {std.min()}")
    return mean, std


def read_head(arrays: Mapping[str, Array], metadata: Mapping[str, str], outputs: int) -> Head:
    """Read the head.

    Args:
        arrays: arrays by name, with or without `action_std` and `action_table`.
        metadata: text by key, with or without `head` and `deviation`.
        outputs: numbers that the last layer gives.

    Returns:
        The head.

    Raises:
        ValueError: an unknown head or deviation, parts that do not belong together, an array of
            another shape or type, or a deviation that is not above 0.
    """
    std = table = None
    if "action_table" in arrays:
        table = _read_array(arrays, "action_table", (None, None))
        if np.abs(table).max() > 1.0:
            raise ValueError(
                f"array 'action_table' should be within [-1, 1], got {np.abs(table).max()}"
            )
    if "action_std" in arrays:
        std = _read_array(arrays, "action_std", (outputs,))
        if not (std > 0.0).all():
            raise ValueError(f"array 'action_std' should be above 0 everywhere, got {std.min()}")
    return Head.read(metadata, outputs, std, table)


def _read_array(arrays: Mapping[str, Array], name: str, shape: tuple[int | None, ...]) -> Floats:
    """Copy of one array, float32 and finite; None in `shape` is any size above 0."""
    array = np.asarray(arrays[name])
    fits = array.ndim == len(shape) and all(
        size > 0 if wanted is None else size == wanted
        for size, wanted in zip(array.shape, shape, strict=True)
    )
    if array.dtype != np.float32 or not fits:
        sizes = ", ".join("any" if size is None else str(size) for size in shape)
        raise ValueError(
            f"array {name!r} should be float32 ({sizes}), got {array.dtype} {array.shape}"
        )
    if not np.isfinite(array).all():
        raise ValueError(f"array {name!r} has NaN or infinite numbers")
    return array.copy()


def read_task_options(metadata: Mapping[str, str]) -> dict[str, Any]:
    """Read the options of the task of the training.

    Args:
        metadata: text by key.

    Returns:
        Options by name; none if it names none.

    Raises:
        ValueError: other values than a JSON object.
    """
    text = metadata.get("task_options", "{}")
    try:
        options = json.loads(text)
    except ValueError:
        options = None
    if not isinstance(options, dict):
        raise ValueError(f"metadata 'task_options' should be a JSON object, got {text!r}")
    return options


def read_scores(metadata: Mapping[str, str]) -> list[Score]:
    """Read what a policy scores.

    Args:
        metadata: text by key.

    Returns:
        The scores in the order of the file; none if it names none.

    Raises:
        ValueError: other values than a JSON list of objects with the fields of `Score`.
    """
    text = metadata.get("scores", "[]")
    try:
        scores = [Score(**entry) for entry in json.loads(text)]
    except (TypeError, ValueError) as error:
        raise ValueError(f"metadata 'scores' should be a list of scores, got {text!r}") from error
    for score in scores:
        _check_score(score)
    return scores


def _check_score(score: Score) -> None:
    """Refuse a score with fields of other types, and numbers that are not finite."""
    texts = (score.opponent, score.metric, score.sensing)
    numbers = (score.score, score.low, score.high)
    valid = all(type(text) is str for text in texts) and type(score.matches) is int
    valid = valid and all(type(number) in (int, float) for number in numbers)
    if not (valid and np.isfinite(numbers).all()):
        raise ValueError(f"metadata 'scores' should have texts and numbers, got {score}")


def scores_text(scores: list[Score]) -> str:
    """Return the value of the metadata `scores`.

    Args:
        scores: what a policy scores.
    """
    rows = [asdict(score) for score in scores]
    # Files of policies that know the true state stay as they were before there were senses.
    return json.dumps([{n: v for n, v in row.items() if (n, v) != ("sensing", "")} for row in rows])


def write_file(path: Path, arrays: Mapping[str, Array], metadata: Mapping[str, str]) -> None:
    """Write a policy file atomically; equal content gives equal bytes.

    Args:
        path: the file; an existing one is replaced.
        arrays: arrays by name.
        metadata: text by key.

    Raises:
        ImportError: safetensors is not installed.
    """
    try:
        content = safetensors_bytes(arrays, metadata)
    except ImportError as error:
        raise ImportError(INSTALL_HINT, name=error.name) from error
    write_atomically(path, content)


def read_file(path: Path) -> tuple[dict[str, Array], dict[str, str]]:
    """Read a policy file without checking its content.

    It needs NumPy alone, so that policies play wherever the package does.

    Args:
        path: the file.

    Returns:
        Arrays by name, and metadata by key.

    Raises:
        FileNotFoundError: no such file.
        ValueError: not a safetensors file, a truncated one, or arrays of other types.
    """
    if path.is_dir():
        raise ValueError("it is a folder")
    return read_safetensors(path.read_bytes())
