"""Sides, numbers and angles."""

import pickle
from typing import Any

import numpy as np
import pytest

from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import WireLayout
from tests.protocols.matches import SSL, VSSS, layout, state


def test_numbers_lead_to_slots_and_back() -> None:
    made = layout()
    assert [made.identity(slot) for slot in range(7)] == [
        *((BLUE, number) for number in (5, 0, 11)),
        *((YELLOW, number) for number in (7, 3, 1, 15)),
    ]
    assert [made.slot(*made.identity(slot)) for slot in range(7)] == list(range(7))
    assert (made.slots(BLUE), made.slots(YELLOW)) == (range(3), range(3, 7))
    assert WireLayout(SSL).ids == ((0, 1, 2), (0, 1, 2, 3))


@pytest.mark.parametrize("identity", [(BLUE, 7), (YELLOW, 5), (BLUE, -1), (YELLOW, 2**32)])
def test_unknown_robots_are_refused(identity: tuple[int, int]) -> None:
    with pytest.raises(MessageError, match=r"^id: expected one of \[") as error:
        layout().slot(*identity)
    assert error.value.code is Code.UNKNOWN_ROBOT


BAD: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"blue_ids": (1, 2)}, ValueError, r"blue_ids: expected 3 different numbers, got \[1, 2\]"),
    ({"blue_ids": (1, 2, 2)}, ValueError, "blue_ids: expected 3 different"),
    ({"yellow_ids": (0, 1, 2, -1)}, ValueError, "yellow_ids: expected at least 0, got -1"),
    ({"yellow_ids": (0, 1, 2, 2**32)}, ValueError, "yellow_ids: expected at most"),
    ({"blue_ids": (0.0, 1, 2)}, TypeError, "blue_ids: expected a whole number"),
    ({"blue_on_positive_half": 1}, TypeError, "blue_on_positive_half: expected"),
]


@pytest.mark.parametrize(("arguments", "kind", "message"), BAD)
def test_bad_layouts_are_refused(
    arguments: dict[str, Any], kind: type[Exception], message: str
) -> None:
    with pytest.raises(kind, match=f"^{message}"):
        WireLayout(SSL, **arguments)


def test_sides_turn_places_and_directions() -> None:
    for positive, sign in ((False, 1.0), (True, -1.0)):
        made = layout(positive=positive)
        assert made.rotated(np.array([1.0, -2.0])).tolist() == [sign, -2.0 * sign]
        headings = np.array([[1.0, 0.0], [0.0, 1.0], [0.6, -0.8]])
        angles = made.angle_to_wire(headings)
        assert np.allclose(np.cos(angles), sign * headings[:, 0])
        assert np.allclose(made.heading_from_wire(angles), headings)


def test_exchanged_colors_are_those_of_the_wire_alone() -> None:
    for positive in (False, True):
        made = WireLayout(
            SSL, blue_ids=(4, 2, 9), blue_on_positive_half=positive, colors_exchanged=True
        )
        # Blue of the package, with its goal at -x, is yellow on the wire.
        assert made.identity(1) == (YELLOW, 2)
        assert made.slot(YELLOW, 2) == 1
        assert list(made.slots(YELLOW)) == [0, 1, 2]
        assert list(made.slots(BLUE)) == [3, 4, 5, 6]
        assert [made.exchanged(team) for team in (BLUE, YELLOW)] == [YELLOW, BLUE]
        assert made.sign == (1.0 if positive else -1.0)
        with pytest.raises(MessageError, match=r"expected one of \[4, 2, 9\] for yellow, got 7"):
            made.slot(YELLOW, 7)


def test_foreign_frames_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^frame: expected \(3, 4\) .* got \(3, 3\)"):
        layout().check_frame(state(VSSS), 0)
    with pytest.raises(ValueError, match=r"^world: expected at most 1, got 2"):
        layout().check_frame(state(), 2)


def test_layouts_and_errors_are_copied_by_pickle() -> None:
    made = layout(positive=True)
    assert pickle.loads(pickle.dumps(made)) == made
    error = pickle.loads(pickle.dumps(MessageError(Code.NOT_FINITE, "text")))
    assert (error.code, str(error)) == (Code.NOT_FINITE, "text")
