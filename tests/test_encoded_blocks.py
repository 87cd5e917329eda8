"""Blocks that are computed when they are read behave like a dict of arrays."""

import copy
from typing import Any

import numpy as np
import pytest

from rsoccer.arrays import Floats
from rsoccer.encoded_blocks import EncodedBlocks
from rsoccer.play import Play
from rsoccer.tasks import VssSelfPlay
from tests.helpers import begun, same

LAYOUT = (("a", slice(0, 2), (2,)), ("b", slice(2, 6), (2, 2)))


class Counted:
    """An encoder that counts its calls."""

    def __init__(self) -> None:
        self.calls = 0
        self.play = begun(VssSelfPlay(), 3).play

    def encode(self, play: Play, out: Floats, bounds: Floats | None) -> None:
        assert play is self.play
        self.calls += 1
        out[..., :6] = np.arange(6)
        if bounds is not None:
            np.clip(out[..., :6], -bounds, bounds, out=out[..., :6])

    def blocks(self) -> EncodedBlocks:
        return EncodedBlocks(self.encode, self.play, LAYOUT)


def test_blocks_are_computed_once_when_they_are_read() -> None:
    encoder = Counted()
    blocks = encoder.blocks()
    assert encoder.calls == 0
    assert blocks["a"].shape == (3, 6, 2)
    assert blocks["b"][2, 5].tolist() == [[2.0, 3.0], [4.0, 5.0]]
    assert list(blocks) == ["a", "b"]
    assert encoder.calls == 1
    assert not blocks.write(np.empty((3, 6, 6), np.float32), np.ones(6, np.float32))
    assert encoder.calls == 1


def test_unread_blocks_are_written_where_they_are_wanted() -> None:
    encoder = Counted()
    out = np.empty((3, 6, 6), np.float32)
    assert encoder.blocks().write(out, np.full(6, 2.5, np.float32))
    assert out[1, 1].tolist() == [0.0, 1.0, 2.0, 2.5, 2.5, 2.5]
    assert not encoder.blocks().write(np.empty((3, 6, 7), np.float32), np.ones(7, np.float32))
    assert encoder.calls == 1


@pytest.mark.parametrize(
    "change",
    [
        lambda blocks, more: {**blocks, **more},
        lambda blocks, more: blocks | more,
        lambda blocks, more: blocks.copy() | more,
        lambda blocks, more: dict(blocks) | more,
        lambda blocks, more: copy.copy(blocks) | more,
        lambda blocks, more: copy.deepcopy(blocks) | more,
    ],
)
def test_blocks_are_joined_as_dicts(change: Any) -> None:  # noqa: ANN401
    more = {"b": np.zeros((3, 6, 1), np.float32), "c": np.ones((3, 6, 1), np.float32)}
    joined = change(Counted().blocks(), more)
    assert type(joined) is dict
    assert list(joined) == ["a", "b", "c"]
    assert joined["b"] is more["b"]
    assert ({"c": 1} | Counted().blocks()).keys() == {"a", "b", "c"}


def test_blocks_of_other_names_are_added_without_reading() -> None:
    encoder = Counted()
    more = {"c": np.full((3, 6, 2), 9.0, np.float32)}
    joined = encoder.blocks() | more
    assert encoder.calls == 0
    out = np.empty((3, 6, 8), np.float32)
    assert joined.write(out, np.full(8, 4.5, np.float32))
    assert out[2, 5].tolist() == [0.0, 1.0, 2.0, 3.0, 4.0, 4.5, 4.5, 4.5]
    assert not joined.write(np.empty((3, 6, 6), np.float32), np.ones(6, np.float32))
    doubles = encoder.blocks() | {"c": np.full((3, 6, 2), 9.0)[..., ::-1]}
    assert doubles.write(out, np.full(8, 4.0, np.float32))
    assert out[0, 3].tolist() == [0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 4.0]
    assert list(joined) == ["a", "b", "c"]
    assert joined["c"] is more["c"]


def test_blocks_can_be_replaced_and_deleted() -> None:
    blocks = Counted().blocks()
    blocks["a"] = blocks["a"] * 2
    del blocks["b"]
    assert list(blocks) == ["a"]
    assert blocks["a"][0, 0].tolist() == [0.0, 2.0]
    assert not blocks.write(np.empty((3, 6, 6), np.float32), np.ones(6, np.float32))


def test_a_task_that_changes_a_block_in_place_observes_the_change() -> None:
    class Halved(VssSelfPlay):
        def frame_to_observations(self, play: Play) -> dict[str, Floats]:
            blocks = super().frame_to_observations(play)
            blocks["ball"] *= np.float32(0.5)
            return blocks

    halved, usual = begun(Halved(), 3), begun(VssSelfPlay(), 3)
    zeros = np.zeros((3, 6, 2), np.float32)
    ours, theirs = halved.step(zeros).observations, usual.step(zeros).observations
    ball = usual.task.layout.blocks["ball"].columns
    assert same(ours[..., ball], theirs[..., ball] * np.float32(0.5))
    assert same(ours[..., ball.stop :], theirs[..., ball.stop :])
