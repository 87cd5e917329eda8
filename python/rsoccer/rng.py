"""Random streams: one per world, so that what a world draws never depends on its neighbours.

A stream is a SplitMix64 counter (Steele, Lea and Flood, OOPSLA 2014): 64 bits of state, a fixed
stride, and a mixing function on top. It is counter-based, so a batch draws in one stride, and
row `i` of a batch seeded `s` draws the same bits as a single world seeded `s + i`.
"""

import math
import zlib
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.frame import Floats, Mask

Words = NDArray[np.uint64]
Seeds = list[int | None]  # of each world; None where its streams go on

_WORD: Final = 2**64
_GOLDEN: Final = 0x9E3779B97F4A7C15  # 2**64 / golden ratio, odd
_STRIDE: Final = np.uint64(_GOLDEN)
_UNIT: Final = np.float32(2.0**-24)  # float32 holds 24 bits exactly
_TURN: Final = np.float32(2.0 * math.pi)


class WorldRng:
    """n independent random streams, one a world. Every draw is (n, *shape)."""

    __slots__ = ("_state",)

    def __init__(self, state: Words) -> None:
        """Continue the streams whose state (n,) uint64 this is; the array becomes ours."""
        self._state = state

    @classmethod
    def seeded(cls, base: int, n: int) -> "WorldRng":
        """Streams of n worlds: row i is the stream of a single world seeded `base + i`."""
        return cls(_begun(np.arange(n, dtype=np.uint64) + np.uint64(base % _WORD)))

    @classmethod
    def seeded_each(cls, seeds: Sequence[int]) -> "WorldRng":
        """Streams of worlds with seeds of their own: row i as a single world's, `seeds[i]`."""
        return cls(_begun(np.array([seed % _WORD for seed in seeds], np.uint64)))

    @classmethod
    def from_state(cls, state: Words) -> "WorldRng":
        """The streams that `state` (n,) was read from, at the same point."""
        if state.dtype != np.uint64 or state.ndim != 1:
            raise ValueError(f"state: expected (n,) uint64, got {state.shape} {state.dtype}")
        return cls(state.copy())

    @property
    def state(self) -> Words:
        """(n,) uint64, all there is to a stream; a copy."""
        return self._state.copy()

    def split(self, stream: int | str) -> "WorldRng":
        """Independent streams derived from these, which stay as they are; one for each name."""
        label = zlib.crc32(stream.encode()) + _WORD // 2 if isinstance(stream, str) else stream
        salt = _mixed(np.array([label % _WORD], np.uint64) + _STRIDE)
        return WorldRng(_mixed(_mixed(self._state ^ salt) + salt))

    def uniform(self, low: float, high: float, shape: tuple[int, ...] = ()) -> Floats:
        """Evenly between `low` and `high`, float32 (n, *shape)."""
        words = self._words(math.prod(shape))
        unit = (words >> np.uint64(40)).astype(np.float32) * _UNIT
        drawn = np.float32(low) + np.float32(high - low) * unit
        return drawn.reshape(len(self), *shape)

    def normal(self, shape: tuple[int, ...] = ()) -> Floats:
        """Standard normal, float32 (n, *shape), by Box and Muller: two numbers a word."""
        count = math.prod(shape)
        words = self._words((count + 1) // 2)
        # Never 0, so that the logarithm is finite.
        high = ((words >> np.uint64(40)).astype(np.float32) + np.float32(1.0)) * _UNIT
        low = ((words >> np.uint64(8)) & np.uint64(0xFFFFFF)).astype(np.float32) * _UNIT
        radius = np.sqrt(np.float32(-2.0) * np.log(high))
        angle = _TURN * low
        drawn = np.concatenate([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
        return np.ascontiguousarray(drawn[:, :count]).reshape(len(self), *shape)

    def integers(self, high: int, shape: tuple[int, ...] = ()) -> NDArray[np.int64]:
        """Whole numbers 0 <= k < high (at most 2**32), int64 (n, *shape)."""
        if not 1 <= high <= 2**32:
            raise ValueError(f"high: expected 1 to 2**32, got {high}")
        words = self._words(math.prod(shape)) >> np.uint64(32)
        drawn = ((words * np.uint64(high)) >> np.uint64(32)).astype(np.int64)
        return drawn.reshape(len(self), *shape)

    def put(self, worlds: Mask | NDArray[np.intp], part: "WorldRng") -> None:
        """Set the streams of `worlds` to where those of `part` are now."""
        self._state[worlds] = part._state

    def __getitem__(self, worlds: Mask | NDArray[np.intp]) -> "WorldRng":
        """A copy of some streams; hand it back with `put` once it has drawn."""
        return WorldRng(self._state[worlds])

    def __len__(self) -> int:
        return len(self._state)

    def _words(self, count: int) -> Words:
        """(n, count) random words; each stream moves on by `count`."""
        steps = np.arange(1, count + 1, dtype=np.uint64) * _STRIDE
        words = _mixed(self._state[:, None] + steps)
        self._state = self._state + np.uint64(count * _GOLDEN % _WORD)
        return words


def next_streams(
    streams: dict[str, WorldRng], worlds: NDArray[np.intp], seeds: Seeds | None
) -> list[WorldRng]:
    """Copies of the streams of some worlds, in order: as they are, or seeded, each by its name."""
    parts = {name: rng[worlds] for name, rng in streams.items()}
    if seeds is not None:
        fresh = {i: seed for i, w in enumerate(worlds) if (seed := seeds[w]) is not None}
        told, root = np.array(list(fresh), np.intp), WorldRng.seeded_each([*fresh.values()])
        for name, rng in parts.items():
            rng.put(told, root.split(name))
    return list(parts.values())


def _begun(seeds: Words) -> Words:
    """Where the streams of these seeds begin."""
    return _mixed(_mixed(seeds * _STRIDE + _STRIDE))


def _mixed(words: Words) -> Words:
    """Words whose every bit depends on every bit of the given ones."""
    words = (words ^ (words >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    words = (words ^ (words >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return words ^ (words >> np.uint64(31))
