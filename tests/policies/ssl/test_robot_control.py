import numpy as np
import pytest

from rsoccer import SimConfig, policies
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.policies.ssl.hold import Hold
from rsoccer.policies.ssl.robot_control import RobotControl
from rsoccer.rng import WorldRng
from rsoccer.task import Play, Task
from rsoccer.tasks import SslSelfPlay
from rsoccer.view import Viewpoint


class OtherTask(Task):
    """A task of SSL robots that does not derive from `Ssl`."""

    name = "other"
    action_size = 5
    max_steps = 10

    @property
    def config(self) -> SimConfig:
        return SimConfig("ssl_challenge", 2, 0)

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        return Frame.empty(len(rng), 2, 0)

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        return np.zeros_like(play.commands)

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        return {"ball": play.view.ball.position}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        n = len(play.frame)
        return {"none": np.zeros((n, 1), np.float32)}, np.zeros(n, np.bool_)


@pytest.mark.parametrize("name", ["fetch", "passer", "strike", "weave"])
def test_scripts_that_drive_need_an_ssl_task(name: str) -> None:
    with pytest.raises(ValueError, match=f"task: {name} needs a subclass of Ssl, got other"):
        policies.make_policy(name, OtherTask())


@pytest.mark.parametrize("name", ["hold", "receive"])
def test_scripts_that_stand_fit_any_robots_with_a_dribbler(name: str) -> None:
    assert isinstance(policies.make_policy(name, OtherTask()), Hold)


@pytest.mark.parametrize(("aside", "has"), [(0.0, True), (0.03, True), (0.06, False)])
@pytest.mark.parametrize("absent", [0.0, 1.0])
def test_opponents_have_a_ball_in_their_mouth_whatever_their_beam_says(
    aside: float, has: bool, absent: float
) -> None:
    task = SslSelfPlay(n_blue=1, n_yellow=2)
    control, frame = RobotControl(task), Frame.empty(1, 1, 2)
    frame.robots.position[0] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]
    frame.robots.heading[0] = [(1.0, 0.0), (-1.0, 0.0), (-1.0, 0.0)]
    frame.ball.position[0] = (2.0 - control.mouth_distance, aside)
    frame.yellow.absent[0, 1] = absent
    viewpoint = Viewpoint(1, 2, [0], ("blue",))
    view = viewpoint.new_view(1)
    viewpoint.fill(frame, view)
    expected = [False, has and absent == 0.0]
    assert control.opponents_have_ball(view).tolist() == [[expected]]
    assert not control.has_ball(view).any()
