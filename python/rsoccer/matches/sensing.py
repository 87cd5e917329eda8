"""The senses of matches: of a model in Python, or of the simulator."""

from rsoccer._core import Sensing
from rsoccer.frame import Frame
from rsoccer.randomization import NumberRanges
from rsoccer.rng import WorldRng
from rsoccer.senses import ModelSenses, Senses, SensorModel
from rsoccer.simulated_senses import SimulatedSenses, sensing_stepper
from rsoccer.simulator_interface import Stepper


def simulated(sensing: SensorModel | Sensing | None) -> Sensing | None:
    """Return the senses that the simulator computes, or None if it computes none.

    Args:
        sensing: what robots know of the true state.
    """
    return sensing if isinstance(sensing, Sensing) else None


def new_senses(
    sensing: SensorModel | Sensing | None,
    stepper: Stepper,
    worlds: int,
    ranges: NumberRanges | None,
    frame: Frame,
    rng: WorldRng,
) -> Senses | None:
    """Return the senses of n worlds before their episodes begin.

    Args:
        sensing: what robots know of the true state; None if they know it exactly.
        stepper: the simulator.
        worlds: number of its worlds.
        ranges: ranges of the numbers of a `Sensing`.
        frame: frame of n worlds; copied.
        rng: (n,) random streams.

    Raises:
        TypeError: a `Sensing` with a simulator that has no senses.
        ValueError: a column of a model whose first axis is not n.
    """
    if sensing is None:
        return None
    if isinstance(sensing, Sensing):
        return SimulatedSenses(sensing_stepper(stepper), worlds, ranges, frame.copy(), rng)
    return ModelSenses.new(sensing, frame, rng)
