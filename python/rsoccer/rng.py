"""Random number streams, one per world: the numbers of a world do not depend on other worlds.

A stream is a SplitMix64 counter (Steele, Lea and Flood, OOPSLA 2014): 64 bits of state, a fixed
stride, and a mixing function of the state. All worlds draw in one array operation, and row `i` of a
batch with seed `s` draws the same bits as a single world with seed `s + i`.
"""

import math
import zlib
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer import _core
from rsoccer.arrays import Floats, Mask

Words = NDArray[np.uint64]
Seeds = list[int | None]
"""Seed of each world; None where its streams continue."""

_WORD: Final = 2**64
_GOLDEN: Final = 0x9E3779B97F4A7C15  # 2**64 / golden ratio, odd
_STRIDE: Final = np.uint64(_GOLDEN)
_BOX_MULLER: Final = np.float32(-2.0)


class WorldRng:
    """n independent random streams, one per world. Every draw has shape (n, *shape).

    Example:
        >>> from rsoccer import WorldRng
        >>> rng = WorldRng.seeded(7, n=4)
        >>> rng.uniform(-1.0, 1.0, (2,)).shape
        (4, 2)
    """

    __slots__ = ("_state",)

    def __init__(self, state: Words) -> None:
        """Create streams from their state.

        Args:
            state: (n,) uint64; the streams own the array from now on.
        """
        self._state = state

    @classmethod
    def seeded(cls, base: int, n: int) -> "WorldRng":
        """Return the streams of n worlds; row i is the stream of a single world seeded `base + i`.

        Args:
            base: seed of the first world, taken modulo 2**64.
            n: number of worlds.
        """
        return cls(_initial_states(np.arange(n, dtype=np.uint64) + np.uint64(base % _WORD)))

    @classmethod
    def seeded_each(cls, seeds: Sequence[int]) -> "WorldRng":
        """Return streams with one seed each; row i is the stream of a single world `seeds[i]`.

        Args:
            seeds: seed of each world, taken modulo 2**64.
        """
        return cls(_initial_states(np.array([seed % _WORD for seed in seeds], np.uint64)))

    @classmethod
    def from_state(cls, state: Words) -> "WorldRng":
        """Return streams that continue from a saved state.

        Args:
            state: (n,) uint64 from the property `state`; copied.

        Raises:
            ValueError: an array of another shape or type.
        """
        if state.dtype != np.uint64 or state.ndim != 1:
            raise ValueError(f"state: expected (n,) uint64, got {state.shape} {state.dtype}")
        return cls(state.copy())

    @property
    def state(self) -> Words:
        """(n,) uint64 complete state of the streams; a copy."""
        return self._state.copy()

    def split(self, stream: int | str) -> "WorldRng":
        """Return independent streams that are derived from these; these do not change.

        Args:
            stream: label of the new streams; different labels give independent streams.
        """
        label = zlib.crc32(stream.encode()) + _WORD // 2 if isinstance(stream, str) else stream
        salt = _mixed(np.array([label % _WORD], np.uint64) + _STRIDE)
        return WorldRng(_mixed(_mixed(self._state ^ salt) + salt))

    def uniform(self, low: float, high: float, shape: tuple[int, ...] = ()) -> Floats:
        """Draw from a uniform distribution.

        Args:
            low: lower bound, included.
            high: upper bound, excluded except by rounding to float32.
            shape: shape of one world's numbers; one number by default.

        Returns:
            (n, *shape) float32 with 24 random bits each.
        """
        count = math.prod(shape)
        drawn = _core.uniform(self._state, count, low, high - low)
        self._advance(count)
        return drawn.reshape(len(self), *shape)

    def normal(self, shape: tuple[int, ...] = ()) -> Floats:
        """Draw from the standard normal distribution, by the Box-Muller transform.

        Args:
            shape: shape of one world's numbers; one number by default. One 64-bit word of a
                stream gives two numbers.

        Returns:
            (n, *shape) float32.
        """
        count = math.prod(shape)
        pairs = (count + 1) // 2
        radius, angle = _core.normal_inputs(self._state, pairs)
        self._advance(pairs)
        np.log(radius, out=radius)  # of numbers above 0
        radius *= _BOX_MULLER
        np.sqrt(radius, out=radius)
        drawn = np.empty((len(self), 2 * pairs), np.float32)
        np.multiply(radius, np.cos(angle), out=drawn[:, :pairs])
        np.multiply(radius, np.sin(angle, out=angle), out=drawn[:, pairs:])
        return np.ascontiguousarray(drawn[:, :count]).reshape(len(self), *shape)

    def integers(self, high: int, shape: tuple[int, ...] = ()) -> NDArray[np.int64]:
        """Draw integers from a uniform distribution.

        Args:
            high: upper bound, excluded, 1 to 2**32; the lower bound is 0.
            shape: shape of one world's numbers; one number by default.

        Returns:
            (n, *shape) int64.

        Raises:
            ValueError: `high` out of range.
        """
        if not 1 <= high <= 2**32:
            raise ValueError(f"high: expected 1 to 2**32, got {high}")
        words = self._words(math.prod(shape)) >> np.uint64(32)
        drawn = ((words * np.uint64(high)) >> np.uint64(32)).astype(np.int64)
        return drawn.reshape(len(self), *shape)

    def put(self, worlds: Mask | NDArray[np.intp], part: "WorldRng") -> None:
        """Overwrite the streams of some worlds.

        Args:
            worlds: (k,) indices of worlds, or (n,) bool with k True.
            part: k streams; copied.
        """
        self._state[worlds] = part._state

    def __getitem__(self, worlds: Mask | NDArray[np.intp]) -> "WorldRng":
        """Return a copy of some streams; `put` writes it back after its draws."""
        return WorldRng(self._state[worlds])

    def __len__(self) -> int:
        return len(self._state)

    def _words(self, count: int) -> Words:
        """Draw (n, count) random words; each stream advances by `count`."""
        words = _core.random_words(self._state, count)
        self._advance(count)
        return words

    def _advance(self, count: int) -> None:
        """Advance each stream by some words."""
        self._state = self._state + np.uint64(count * _GOLDEN % _WORD)


def next_streams(
    streams: dict[str, WorldRng], worlds: NDArray[np.intp], seeds: Seeds | None
) -> dict[str, WorldRng]:
    """Return the streams that some worlds use from their next episode on.

    Args:
        streams: streams of n worlds by name; not changed.
        worlds: (k,) indices of the worlds.
        seeds: seeds of all n worlds. Worlds with a seed restart all their streams, each derived
            from the seed by the stream's name; elsewhere, and for None, streams continue.

    Returns:
        Copies with k streams each, by the same names.
    """
    parts = {name: rng[worlds] for name, rng in streams.items()}
    if seeds is not None:
        given = {i: seed for i, w in enumerate(worlds) if (seed := seeds[w]) is not None}
        seeded, root = np.array(list(given), np.intp), WorldRng.seeded_each([*given.values()])
        for name, rng in parts.items():
            rng.put(seeded, root.split(name))
    return parts


def _initial_states(seeds: Words) -> Words:
    """Initial states of the streams with these seeds."""
    return _mixed(_mixed(seeds * _STRIDE + _STRIDE))


def _mixed(words: Words) -> Words:
    """Mix words, so that every bit depends on every bit of the input word."""
    words = (words ^ (words >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    words = (words ^ (words >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return words ^ (words >> np.uint64(31))
