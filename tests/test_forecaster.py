"""The forecaster of the core, on its own and in matches."""

import copy
import pickle
from typing import Any, cast

import numpy as np
import pytest

import rsoccer
from rsoccer import Forecaster, Matches, Sensing, SimConfig, Simulator
from rsoccer._core import SENSING_NUMBERS
from rsoccer.arrays import Floats
from rsoccer.controllers import Controllers
from rsoccer.evaluate.episodes import LearnerPolicy
from rsoccer.frame import Frame
from rsoccer.human.driver import Driver, HumanPolicy
from rsoccer.policies import list_policies, make_policy
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.registry import list_tasks
from rsoccer.replay import Recorder, Replay, ReplayError, record_replay
from rsoccer.replay.evaluation import record_last_match
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.tasks import SslSelfPlay, VssSelfPlay
from rsoccer.train.clock import Clock
from rsoccer.train.opponents.policy_mix import PolicyMix
from tests.helpers import same

DELAY = 0.1
LATE: dict[str, Any] = {"command_delay": DELAY, "forecast": 1.0}
STEPS_LATE = 4
TASKS = {"VSSSelfPlay-v0": VssSelfPlay(), "SSLSelfPlay-v0": SslSelfPlay(n_blue=2, n_yellow=2)}


def actions_of(matches: Matches, steps: int, seed: int = 0) -> Floats:
    """Random actions, the same for all worlds, that change every four steps."""
    shape = (1 + steps // 4, 1, len(matches.agents), matches.action_size)
    drawn = np.random.default_rng(seed).uniform(-0.7, 0.7, shape).astype(np.float32)
    if matches.action_size > 3:
        drawn[..., 3:] = 0.0  # neither kicks nor dribbling
    return np.repeat(np.repeat(drawn, 4, axis=0)[:steps], matches.worlds, axis=1)


def motion(frame: Frame) -> Floats:
    """(n, robots, 7) positions, headings and velocities of the robots."""
    robots = frame.robots
    parts = (robots.position, robots.heading, robots.velocity, robots.angular_velocity[..., None])
    return np.concatenate(parts, axis=-1)


def play(task: str, sensing: Sensing | None, steps: int, worlds: int = 1, **settings: Any) -> Any:  # noqa: ANN401
    """True and known frames and observations of matches after each step."""
    matches = Matches(TASKS[task], worlds, 3, sensing=sensing, **settings)
    matches.reset()
    truth, known, observations = [], [], []
    for actions in actions_of(matches, steps):
        outcome = matches.step(actions)
        truth.append(matches.frame.copy())
        known.append([matches.play.known_to(team).copy() for team in (0, 1)])
        observations.append(outcome.observations)
    return truth, known, observations


@pytest.mark.parametrize("task", TASKS)
def test_robots_of_ones_own_are_known_where_they_will_be(task: str) -> None:
    """The others coast, so that the known state of both teams differs where they meet, too."""
    truth, known, _ = play(task, Sensing(**LATE), 24)
    n_blue = truth[0].n_blue
    own, others = [], []
    for step in range(4, 20):
        then = motion(truth[step + STEPS_LATE])
        blue, yellow = (np.abs(motion(frame) - then) for frame in known[step])
        own += [blue[:, :n_blue], yellow[:, n_blue:]]
        others += [blue[:, n_blue:], yellow[:, :n_blue]]
    assert np.quantile(own, 0.9) < 1e-5
    assert np.quantile(others, 0.5) > 1e-3


@pytest.mark.parametrize("task", TASKS)
def test_all_commands_known_give_both_teams_one_forecast(task: str) -> None:
    truth, known, observations = play(task, Sensing(**LATE, forecast_others=1.0), 24)
    for step in range(4, 20):
        assert same(known[step][0].rows, known[step][1].rows)
        then = motion(truth[step + STEPS_LATE])
        np.testing.assert_allclose(motion(known[step][0]), then, atol=2e-3)
    assert np.abs(motion(truth[19]) - motion(truth[15])).max() > 0.05
    _, _, exact = play(task, None, 24)
    assert observations[0].shape == exact[0].shape


def test_each_team_observes_its_own_forecast() -> None:
    matches = Matches(TASKS["SSLSelfPlay-v0"], 3, 0, sensing=Sensing(**LATE))
    matches.reset()
    for actions in actions_of(matches, 20):
        outcome = matches.step(actions)
    state = matches.play
    blue, yellow = state.known_to(0), state.known_to(1)
    assert not same(blue.rows, yellow.rows)
    assert same(state.sensed.blue.data, blue.blue.data)
    assert same(state.sensed.yellow.data, yellow.yellow.data)
    robots = np.arange(4)
    assert state.known_to_robots(robots[:2]) is blue
    assert state.known_to_robots(robots[2:]) is yellow
    with pytest.raises(ValueError, match=r"expected robots of one team.*got \[0, 1, 2, 3\]"):
        state.known_to_robots(robots)
    for team, known in enumerate((blue, yellow)):
        view = state.viewpoint.new_view(3)
        state.viewpoint.fill(known, view)
        mine = state.viewpoint.teams == team
        assert same(view.robots.data[:, mine], state.sensed_view.robots.data[:, mine])
        shared = state.take(np.arange(3))
        assert shared.senses is not None
        shared.senses.teams = (known, known)
        shared.expire_views()
        alone = TASKS["SSLSelfPlay-v0"].layout.observe(shared)
        assert same(alone[:, mine], outcome.observations[:, mine])
        assert not same(alone[:, ~mine], outcome.observations[:, ~mine])


@pytest.mark.parametrize("preset", ["none", "rc2021", "vsss"])
@pytest.mark.parametrize("task", TASKS)
def test_a_world_forecasts_the_same_whatever_batch_and_threads(task: str, preset: str) -> None:
    sensing = Sensing(preset, **LATE)
    _, alone, first = play(task, sensing, 30)
    _, among, others = play(task, sensing, 30, worlds=5, threads=2)
    for step in range(30):
        assert same(first[step][0], others[step][0])
        for team in (0, 1):
            assert same(alone[step][team].rows[0], among[step][team].rows[0])


@pytest.mark.parametrize("task", TASKS)
def test_matches_continue_exactly_from_a_saved_state(task: str) -> None:
    sensing = Sensing("vsss", **LATE)
    ours = Matches(TASKS[task], 3, 3, sensing=sensing)
    theirs = Matches(TASKS[task], 3, 9, sensing=sensing)
    ours.reset()
    theirs.reset()
    actions = actions_of(ours, 40)
    for step in range(15):
        ours.step(actions[step])
    saved = ours.state_dict()
    assert {"senses.frame", "senses.blue", "senses.yellow"} <= set(saved)
    theirs.load_state_dict(saved)
    copied = pickle.loads(pickle.dumps(ours))
    for step in range(15, 40):
        first = ours.step(actions[step])
        for other in (theirs, copied):
            assert same(first.observations, other.step(actions[step]).observations)
            assert same(ours.play.known_to(1).rows, other.play.known_to(1).rows)


class Watcher(Policy):
    """A policy that notes what it is given of the match, and drives in circles."""

    observes: Observes = "view"

    def __init__(self, task: Task) -> None:
        super().__init__(task)
        self.given: list[tuple[list[int], Floats]] = []

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        assert inputs.match is not None
        self.given.append((inputs.match.robots.tolist(), inputs.match.rows.copy()))
        chosen = np.zeros(inputs.action_shape, np.float32)
        chosen[..., :2] = inputs.match.rows[:, None, :2] + rng.uniform(-1, 1)[:, None, None]
        return np.tanh(chosen)


@pytest.mark.parametrize(
    ("sensing", "groups"),
    [
        (Sensing(**LATE), [[0, 1], [2, 3]]),
        (Sensing(**LATE, forecast_others=1.0), [[0, 1, 2, 3]]),
        (Sensing(command_delay=DELAY), [[0, 1, 2, 3]]),
        (None, [[0, 1, 2, 3]]),
    ],
    ids=["forecasts", "forecasts of all", "late", "exact"],
)
def test_a_policy_of_both_teams_knows_of_each_what_that_team_knows(
    sensing: Sensing | None, groups: list[list[int]]
) -> None:
    task = TASKS["SSLSelfPlay-v0"]
    watcher = Watcher(task)
    matches = Matches(task, 2, 3, controllers={"all": watcher}, sensing=sensing)
    learning = Matches(task, 2, 3, sensing=sensing)
    observations = learning.reset()
    learner = Watcher(task)
    learners = LearnerPolicy(learner, learning, 3)
    matches.reset()
    none = np.zeros((2, 0, matches.action_size), np.float32)
    differ = False
    for _ in range(12):
        for policy, play in ((watcher, matches.play), (learner, learning.play)):
            known = [play.known_to(team).rows.copy() for team in (0, 1)]
            policy.given.clear()
            if policy is watcher:
                matches.step(none)
            else:
                observations = learning.step(learners.act(observations)).observations
            assert [robots for robots, _ in policy.given] == groups
            for robots, rows in policy.given:
                assert same(rows, known[robots[0] // 2])
            differ |= not same(known[0], known[1])
    assert differ == (len(groups) == 2)


class Spinner(Policy):
    """A policy that looks, and acts without regard to it."""

    observes: Observes = "view"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        chosen = np.zeros(inputs.action_shape, np.float32)
        chosen[..., 2] = rng.uniform(0.5, 1.0)[:, None]  # it turns
        return chosen


@pytest.mark.parametrize("task", TASKS)
def test_a_policy_of_both_teams_plays_as_two_policies(task: str) -> None:
    both: tuple[Controllers, Controllers] = (
        {"all": "scripted"},
        {"blue": "scripted", "yellow": make_policy("scripted", TASKS[task])},
    )
    one, two = (
        Matches(TASKS[task], 2, 3, controllers=controllers, sensing=Sensing(**LATE))
        for controllers in both
    )
    one.reset()
    two.reset()
    none = np.zeros((2, 0, one.action_size), np.float32)
    start = one.frame.rows.copy()
    for _ in range(40):
        one.step(none)
        two.step(none)
        assert same(one.frame.rows, two.frame.rows)
    assert not same(one.frame.rows, start)


@pytest.mark.parametrize("blind", ["blue", "yellow", "all"])
def test_only_teams_that_observe_forecast(blind: str) -> None:
    """The others know what is sensed, which is what a match without forecasts has."""
    task = TASKS["SSLSelfPlay-v0"]
    forecasting, plain = (
        Matches(
            task,
            2,
            3,
            controllers={"all": Spinner(task), blind: "ou"},
            sensing=Sensing(command_delay=DELAY, forecast=forecast),
        )
        for forecast in (1.0, 0.0)
    )
    none = np.zeros((2, 0, forecasting.action_size), np.float32)
    for matches in (forecasting, plain):
        matches.reset()
        for _ in range(12):
            matches.step(none)
    play = forecasting.play
    known = {"blue": play.known_to(0), "yellow": play.known_to(1)}
    assert same(forecasting.frame.rows, plain.frame.rows)
    for team, frame in known.items():
        sensed = plain.play.known_to(0)
        assert same(frame.rows, sensed.rows) == (blind in (team, "all"))
        assert same(getattr(play.sensed, team).data, getattr(frame, team).data)
    assert same(play.sensed.ball.data, known["blue"].ball.data)
    saved = forecasting.state_dict()
    forecasting.step(none)
    after = play.known_to(0).rows.copy(), play.known_to(1).rows.copy()
    forecasting.load_state_dict(saved)
    forecasting.step(none)
    assert same(play.known_to(0).rows, after[0])
    assert same(play.known_to(1).rows, after[1])


def test_a_team_without_opponents_forecasts_into_one_frame() -> None:
    matches = Matches("SSLGoToBall-v0", 2, sensing=Sensing(**LATE))
    matches.reset()
    assert matches.play.known_to(0) is matches.play.known_to(1) is matches.play.sensed


def test_drawn_delays_are_not_known() -> None:
    """A match whose commands arrive earlier forecasts with the delay of its configuration."""
    sensing = Sensing(**LATE, forecast_others=1.0, command_timeout=0.5)
    drawn = Sensing(command_delay=0.04, command_timeout=0.06, forecast=1.0, forecast_others=1.0)
    config = SimConfig("ssl_b", 2, 1, sensing=sensing)
    simulator, forecaster = Simulator(config), Forecaster(config)
    numbers = np.array([[getattr(drawn, name) for name in SENSING_NUMBERS]], np.float32)
    simulator.begin_senses(np.ones(1, np.bool_), np.ones(1, np.uint64), numbers)
    row = np.zeros((1, config.row_size), np.float32)
    simulator.read(row)
    rng = np.random.default_rng(0)
    commands = np.zeros((1, 3, 6), np.float32)
    known, forecast, ahead = np.empty_like(row), np.empty_like(row), 0.0
    for step in range(20):
        before = np.array([step * config.time_step])
        if step % 5 == 0:
            commands[..., :3] = rng.uniform(-1, 1, (1, 3, 3))
        forecaster.send(commands, before)
        simulator.step(commands, out=row)
        simulator.sense(known)
        now = before + config.time_step
        forecaster.forecast(row, now, now, forecast)
        motions = [motion(Frame(rows, 2, 1)) for rows in (known, forecast, row)]
        np.testing.assert_allclose(motions[0], motions[1], atol=1e-5)
        ahead = max(ahead, np.abs(motions[0] - motions[2]).max())
    assert ahead > 0.05


def test_a_forecast_is_of_the_models_and_not_of_the_varied_world() -> None:
    varied = {"robot.acceleration": (0.3, 0.31)}
    errors = []
    for randomization in (None, varied):
        truth, known, _ = play("SSLSelfPlay-v0", Sensing(**LATE), 24, randomization=randomization)
        late = [
            motion(truth[s + STEPS_LATE])[:, :2] - motion(known[s][0])[:, :2] for s in range(20)
        ]
        errors.append(np.abs(late).max())
    assert errors[0] < 1e-5
    assert errors[1] > 0.01


def test_waiting_worlds_keep_what_they_know() -> None:
    task = VssSelfPlay(max_steps=5)
    matches = Matches(task, 3, autoreset="disabled", sensing=Sensing(**LATE))
    matches.reset()
    actions = actions_of(matches, 9)
    for step in range(9):
        outcome = matches.step(actions[step])
    assert matches.done.all()
    rows = matches.play.known_to(1).rows.copy()
    assert same(outcome.observations, matches.step(actions[0]).observations)
    assert same(rows, matches.play.known_to(1).rows)


def test_a_forecaster_on_its_own_bridges_the_delay() -> None:
    config = SimConfig("ssl_b", 2, 1, sensing=Sensing(command_delay=DELAY))
    simulator = Simulator(config)  # which delays commands as its senses say
    forecaster = Forecaster(config, known="all")
    row = np.zeros((1, config.row_size), np.float32)
    simulator.read(row)
    rng = np.random.default_rng(0)
    rows, forecasts = [], []
    commands = np.zeros((1, 3, 6), np.float32)
    for step in range(30):
        time = np.array([step * config.time_step])
        out = np.empty_like(row)
        forecaster.forecast(row, seen=time, now=time, out=out)
        forecasts.append(out)
        rows.append(row.copy())
        commands[..., :3] = rng.uniform(-1, 1, (1, 3, 3))
        forecaster.send(commands, time)
        simulator.step(commands, out=row)
    moved = 0.0
    for step in range(26):
        then = rows[step + STEPS_LATE]
        np.testing.assert_allclose(forecasts[step][:, :9], then[:, :9], atol=1e-6)
        np.testing.assert_allclose(forecasts[step][:, 17:24], then[:, 17:24], atol=1e-5)
        moved = max(moved, np.abs(then - rows[step]).max())
    assert moved > 0.1
    copied = pickle.loads(pickle.dumps(forecaster))
    ours, theirs = np.empty_like(row), np.empty_like(row)
    now = np.array([30 * config.time_step])
    forecaster.forecast(row, now, now, ours)
    copied.forecast(row, now, now, theirs)
    assert same(ours, theirs)
    assert repr(copied) == 'Forecaster(1 worlds, known="all")'


def test_rows_of_forgotten_times_are_refused() -> None:
    forecaster = Forecaster(CONFIG)
    rows = [np.empty_like(ROW) for _ in range(3)]
    for time, speed in ((0.0, 5.0), (0.1, 20.0), (0.2, -10.0)):
        forecaster.send(np.full((1, 1, 2), speed, np.float32), ZERO + time)
    forecaster.forecast(ROW, ZERO + 0.05, ZERO + 0.3, rows[0])
    forecaster.forecast(ROW, ZERO + 0.15, ZERO + 0.3, rows[1])
    restored = pickle.loads(pickle.dumps(forecaster))
    for each in (forecaster, restored):
        before = each.snapshot()
        message = r"seen: the row of world 0 is of 0.05 s, expected 0.1 s or later"
        with pytest.raises(ValueError, match=message):
            each.forecast(ROW, ZERO + 0.05, ZERO + 0.3, rows[2])
        assert each.snapshot() == before
        each.forecast(ROW, ZERO + 0.1, ZERO + 0.3, rows[2])  # the commands since are known
        each.forecast(ROW, ZERO + 0.15, ZERO + 0.3, rows[2])
        assert same(rows[2], rows[1])
    assert not same(rows[0], rows[1])
    forecaster.reset(np.ones(1, np.bool_))
    forecaster.forecast(ROW, ZERO, ZERO + 0.3, rows[2])


def test_commands_of_other_robots_are_ignored() -> None:
    config = SimConfig("vss_3v3", 1, 1)
    row = np.zeros((1, config.row_size), np.float32)
    Simulator(config).read(row)
    seen = {}
    for known in ("blue", "yellow", "all"):
        forecaster = Forecaster(config, known=known)
        forecaster.send(np.full((1, 2, 2), 20.0, np.float32), np.zeros(1))
        seen[known] = np.empty_like(row)
        forecaster.forecast(row, np.zeros(1), np.array([0.1]), seen[known])
    frames = {known: Frame(rows, 1, 1) for known, rows in seen.items()}
    start = Frame(row, 1, 1)
    assert same(frames["blue"].yellow.position, start.yellow.position)
    assert same(frames["yellow"].blue.position, start.blue.position)
    assert same(frames["all"].blue.position, frames["blue"].blue.position)
    assert same(frames["all"].yellow.position, frames["yellow"].yellow.position)
    assert not same(frames["blue"].blue.position, start.blue.position)


CONFIG = SimConfig("vss_3v3", 1, 0)
ROW = np.zeros((1, CONFIG.row_size), np.float32)
Simulator(CONFIG).read(ROW)
ZERO = np.zeros(1)


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda f: f.send(np.zeros((1, 1, 3), np.float32), ZERO), ValueError, "commands must have"),
        (lambda f: f.send(np.full((1, 1, 2), np.nan, np.float32), ZERO), ValueError, "commands"),
        (lambda f: f.send(np.zeros((1, 1, 2), np.float32), ZERO - 1), ValueError, "times"),
        (lambda f: f.send(np.zeros((1, 1, 2), np.float32), ZERO + np.inf), ValueError, "times"),
        (
            lambda f: f.send(np.zeros((1, 1, 2), np.float32), np.zeros(1, np.float32)),
            TypeError,
            "t",
        ),
        (lambda f: f.forecast(ROW, ZERO, ZERO + 3, ROW.copy()), ValueError, "at most 2 s"),
        (lambda f: f.forecast(ROW * np.nan, ZERO, ZERO, ROW.copy()), ValueError, "world 0"),
        (lambda f: f.forecast(ROW[:, :5], ZERO, ZERO, ROW.copy()), ValueError, "rows must have"),
        (lambda f: f.forecast(ROW, np.zeros(2), ZERO, ROW.copy()), ValueError, "seen must have"),
        (lambda f: f.reset(np.ones(2, np.bool_)), ValueError, "worlds must have"),
        (lambda f: f.restore(b"junk"), ValueError, "not a snapshot"),
        (lambda _: Forecaster(CONFIG, known="red"), ValueError, "known must be 'blue', 'yellow'"),
        (lambda _: Forecaster(CONFIG, known=cast(str, 1)), TypeError, "known must be"),
        (lambda _: Forecaster(CONFIG, 0), ValueError, "worlds must be at least 1"),
        (lambda _: Forecaster(CONFIG, cast(int, 1.5)), TypeError, "worlds: expected a whole"),
        (lambda _: Forecaster(cast(SimConfig, "ssl_b")), TypeError, "config: expected a SimConfig"),
        (lambda _: Sensing(forecast=2.0), ValueError, "sensing.forecast must be between 0 and 1"),
    ],
)
def test_bad_input_is_refused_and_changes_nothing(
    call: Any,  # noqa: ANN401
    error: type[Exception],
    message: str,
) -> None:
    forecaster = Forecaster(CONFIG)
    forecaster.send(np.ones((1, 1, 2), np.float32), ZERO)
    before = forecaster.snapshot()
    with pytest.raises(error, match=message):
        call(forecaster)
    assert forecaster.snapshot() == before


def test_files_of_versions_without_forecasts_are_read() -> None:
    text = Sensing("rc2021").to_json().replace(',"forecast":0.0,"forecast_others":0.0', "")
    assert "forecast" not in text
    assert Sensing.from_json(text) == Sensing("rc2021")


def test_a_policy_trained_on_the_truth_plays_with_late_commands() -> None:
    def score(sensing: Sensing | None) -> float:
        return rsoccer.evaluate("best", None, 20, 0, task="SSLGoToBall-v0", sensing=sensing).score

    late, forecast = score(Sensing(command_delay=DELAY)), score(Sensing(**LATE))
    assert late < 0.6
    assert forecast > 0.9


class Turner(Spinner):
    """A policy that turns its robots alike, whatever their group."""

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        chosen = np.zeros(inputs.action_shape, np.float32)
        chosen[..., -1 if chosen.shape[-1] == 2 else 2] = 0.7
        return chosen


class Expecting(Turner):
    """A policy that expects a forecast."""

    forecasts = needs_forecast = True


@pytest.mark.parametrize("team", ["blue", "yellow"])
@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_the_team_of_a_policy_that_expects_it_forecasts(team: str, noise: float) -> None:
    """Its opponents, who look, know what is sensed."""
    task, late = TASKS["SSLSelfPlay-v0"], Sensing(command_delay=DELAY, position_noise=noise)
    all_forecast = Sensing(command_delay=DELAY, forecast=1.0, position_noise=noise)
    other = "yellow" if team == "blue" else "blue"
    one = {"all": Turner(task), team: Expecting(task)}
    ways: dict[str, Matches] = {
        "expected": Matches(task, 2, 3, controllers=one, sensing=late),
        "asked": Matches(
            task, 2, 3, controllers={"all": Turner(task)}, sensing=late, forecasting=[team]
        ),
        "all": Matches(task, 2, 3, controllers={"all": Turner(task)}, sensing=all_forecast),
        "none": Matches(task, 2, 3, controllers={"all": Turner(task)}, sensing=late),
    }
    known = {}
    for name, matches in ways.items():
        matches.reset()
        for _ in range(12):
            matches.step(np.zeros((2, 0, matches.action_size), np.float32))
        known[name] = {
            side: matches.play.known_to(index).rows.copy()
            for index, side in enumerate(("blue", "yellow"))
        }
    assert not same(known["all"][team], known["none"][team]), "the forecast is another state"
    for name in ("expected", "asked"):
        assert same(known[name][team], known["all"][team])
        assert same(known[name][other], known["none"][other])
    assert ways["expected"].sensing == late, "files name what was asked for"


def test_nothing_forecasts_on_the_true_state_and_in_training_with_it_nothing_changes() -> None:
    task = TASKS["VSSSelfPlay-v0"]
    exact = Matches(task, controllers={"yellow": Expecting(task)}, forecasting=["blue"])
    exact.reset()
    assert exact.play.senses is None
    asked = Matches(task, sensing=Sensing(**LATE), forecasting=["blue", "yellow"])
    asked.reset()
    asked.step(np.ones((1, len(asked.agents), asked.action_size), np.float32))
    given = Matches(task, sensing=Sensing(**LATE))
    given.reset()
    given.step(np.ones((1, len(given.agents), given.action_size), np.float32))
    assert same(asked.play.sensed.rows, given.play.sensed.rows)


def test_varied_numbers_stay_with_an_expected_forecast() -> None:
    task = TASKS["VSSSelfPlay-v0"]
    matches = Matches(
        task,
        3,
        controllers={"all": "ou", "blue": Expecting(task)},
        randomization={"sensing.delay": (0.05, 0.1)},
    )
    matches.reset()
    for _ in range(6):
        matches.step(np.zeros((3, 0, matches.action_size), np.float32))
    blue, yellow = matches.play.known_to(0), matches.play.known_to(1)
    assert not same(blue.rows, yellow.rows)


@pytest.mark.parametrize("asked", [True, 3])
def test_what_has_no_names_of_teams_is_refused(asked: Any) -> None:  # noqa: ANN401
    with pytest.raises(TypeError, match=rf"^forecasting: expected some of .*, got {asked}"):
        Matches("VSS-v0", sensing=Sensing(**LATE), forecasting=asked)


@pytest.mark.parametrize("asked", ["blue", ["green"], ["blue", 3]])
def test_unknown_teams_are_asked_in_vain(asked: Any) -> None:  # noqa: ANN401
    with pytest.raises(ValueError, match=r"forecasting: expected some of \['blue', 'yellow'\]"):
        Matches("VSS-v0", sensing=Sensing(**LATE), forecasting=asked)
    with pytest.raises(ValueError, match=r"forecasting: expected some of \['blue'\], got \['y"):
        Matches("SSLGoToBall-v0", sensing=Sensing(**LATE), forecasting=["yellow"])


def test_a_policy_that_expects_a_forecast_joins_no_team_without() -> None:
    task = TASKS["VSSSelfPlay-v0"]
    late = Sensing(command_delay=DELAY)
    matches = Matches(task, controllers={"yellow": Turner(task)}, sensing=late)
    with pytest.raises(ValueError, match="without forecasts for yellow, got Expecting"):
        matches.change_controllers({"yellow": Expecting(task)})
    for allowed in (
        Matches(task, controllers={"yellow": Turner(task)}),
        Matches(task, controllers={"yellow": Expecting(task)}, sensing=late),
    ):
        allowed.change_controllers({"yellow": Expecting(task)})


def test_an_evaluated_policy_that_expects_a_forecast_gets_it() -> None:
    """Against opponents who look and know what is sensed."""
    late = Sensing("rc2021", command_delay=DELAY)

    def score(policy: Policy, sensing: Sensing) -> tuple[float, ...]:
        found = rsoccer.evaluate(policy, "zero", 10, task="VSSSelfPlay-v0", sensing=sensing)
        return found.score, found.seconds.mean, found.returns.mean

    best = make_policy("best", "VSSSelfPlay-v0")
    expecting = make_policy("best", "VSSSelfPlay-v0")
    expecting.forecasts = True
    forecast = Sensing("rc2021", command_delay=DELAY, forecast=1.0)
    assert score(expecting, late) == score(best, forecast) != score(best, late)


@pytest.mark.parametrize("number", ["own_cameras", "forecast_others"])
def test_both_teams_forecast_where_one_cannot_alone(number: str) -> None:
    task, late = TASKS["VSSSelfPlay-v0"], f"command_delay={DELAY}, {number}=1"
    expected = Matches(task, controllers={"yellow": Expecting(task)}, sensing=late)
    given = Matches(task, controllers={"yellow": Turner(task)}, sensing=f"{late}, forecast=1")
    for matches in (expected, given):
        matches.reset()
        for _ in range(6):
            matches.step(np.ones((1, 3, matches.action_size), np.float32))
    for team in (0, 1):
        assert same(expected.play.known_to(team).rows, given.play.known_to(team).rows)
    expected.change_controllers({"yellow": Expecting(task)})


def test_copies_of_an_environment_go_on_to_forecast() -> None:
    task = TASKS["VSSSelfPlay-v0"]
    env = rsoccer.parallel_env(
        task, controllers={"yellow": Expecting(task)}, sensing=Sensing(command_delay=DELAY)
    )
    env.reset(seed=0)
    env.matches.change_controllers({"yellow": "scripted"})
    copied = copy.deepcopy(env)
    actions = {agent: np.ones(2, np.float32) for agent in env.agents}
    for each in (env, copied):
        each.step(actions)
    ours, other = env.matches, copied.matches
    assert ours.forecasting == other.forecasting == ("yellow",)
    assert same(ours.play.known_to(1).rows, other.play.known_to(1).rows)


def test_a_replay_goes_on_from_a_match_with_a_forecast() -> None:
    task, late = "SSLStaticDefenders-v0", Sensing("rc2021", command_delay=0.05)
    policies = {"blue": "best:robust"}
    recorded = record_replay(task, policies, 3, 0.6, sensing=late, snapshot_interval=0.2)
    replay = Replay.from_bytes(recorded.to_bytes())
    assert replay.forecasting == ("blue",)
    frame = max(replay.snapshots)
    for controllers in ({"blue": "best"}, {"blue": "zero"}, policies):
        branch = replay.branch(frame - 1, controllers)
        assert branch.forecasting == ("blue",)
        branch.step(np.zeros((1, 0, branch.action_size), np.float32))
    plain = record_replay(task, {"blue": "best"}, 3, 0.6, sensing=late, snapshot_interval=0.2)
    with pytest.raises(ReplayError, match="without forecasts for blue"):
        plain.branch(max(plain.snapshots), policies)
    script = plain.branch(max(plain.snapshots), {"blue": "strike"})
    assert script.forecasting == (), "a script plays without one, too"


def test_the_replay_of_an_evaluation_shows_the_match_that_it_played() -> None:
    task, late = "SSLStaticDefenders-v0", Sensing("rc2021", command_delay=0.05)
    found = rsoccer.evaluate("best:robust", None, 1, 3, task=task, sensing=late)
    replay = record_last_match("best:robust", None, 1, 3, task=task, sensing=late)
    step = rsoccer.make_task(task).config.time_step
    assert found.seconds.mean == pytest.approx((len(replay) - 1) * step)


def test_scripts_that_look_play_from_a_forecast_but_can_do_without() -> None:
    looking = set()
    for name in list_policies():
        for task in list_tasks() if name != "best" else ():
            try:
                policy = make_policy(name, rsoccer.make_task(task))
            except ValueError:
                continue  # it plays other tasks
            assert not policy.needs_forecast, name
            assert policy.forecasts == (policy.observes == "view"), name
            looking |= {type(policy)} if policy.forecasts else set()
    assert len(looking) >= 9
    assert PolicyMix(rsoccer.make_task("VSS-v0"), {"ou": 1.0, "chase": 1.0}, Clock()).forecasts


def test_a_script_is_as_strong_with_late_senses() -> None:
    """Without its forecast it loses to `chase` (-.3), and wins with it (.8)."""
    found = rsoccer.evaluate("scripted", "chase", 20, task="VSSSelfPlay-v0", sensing="rc2021")
    assert found.score > 0.5


def test_a_scripted_teammate_does_not_change_what_others_observe() -> None:
    late = Sensing(command_delay=DELAY)

    def forecasting(**controllers: str) -> tuple[str, ...]:
        return Matches("VSSSelfPlay-v0", controllers=controllers, sensing=late).forecasting

    assert forecasting(blue="scripted", yellow="ou") == ("blue",)
    assert forecasting(blue="scripted", blue_0="chase", yellow="best") == ("blue",)
    assert forecasting(blue="scripted", blue_0="zero", yellow="best") == ("blue",)
    assert forecasting(blue="scripted", blue_0="best", yellow="best") == ()
    assert forecasting(blue_1="scripted") == (), "a learner is in the team"


@pytest.mark.parametrize("number", ["own_cameras", "forecast_others"])
def test_a_scripted_opponent_does_not_make_others_forecast(number: str) -> None:
    """A team that need not forecast waits for the other where both do or none."""
    late = f"command_delay={DELAY}, {number}=1"

    def forecasting(yellow: str, blue: str | None = None) -> tuple[str, ...]:
        controllers = {"yellow": yellow} | ({} if blue is None else {"blue": blue})
        return Matches("VSSSelfPlay-v0", controllers=controllers, sensing=late).forecasting

    assert forecasting("scripted") == forecasting("scripted", "best") == ()
    for blue in ("chase", "zero"):
        assert forecasting("scripted", blue) != ()
    drawn = Matches(
        "VSSSelfPlay-v0",
        controllers={"yellow": "scripted"},
        sensing=Sensing(command_delay=DELAY),
        randomization={"sensing.own_cameras": (0.0, 1.0)},
    )
    assert drawn.forecasting == ()


def test_forecasts_that_are_asked_for_are_all_there_are() -> None:
    late = Sensing(command_delay=DELAY)
    both = {"blue": "chase", "yellow": "scripted"}
    for asked in ((), ("blue",), ("blue", "yellow")):
        matches = Matches("VSSSelfPlay-v0", controllers=both, sensing=late, forecasting=asked)
        assert matches.forecasting == asked
    env = rsoccer.parallel_env("VSSSelfPlay-v0", controllers={"yellow": "best"}, sensing=late)
    env.reset(seed=0)
    env.matches.change_controllers({"yellow": "scripted"})
    again = cast(Any, env.matches).with_seed(3)
    assert env.matches.forecasting == again.forecasting == ()


def test_an_evaluation_forecasts_as_matches_of_its_policies_do() -> None:
    late = Sensing("rc2021", command_delay=DELAY)
    cases: list[tuple[str, str, str | None]] = [
        ("SSLPassEndurance-v1", "passer", None),
        ("SSLPassEndurance-v1", "best", None),
        ("VSSSelfPlay-v0", "best", "scripted"),
        ("VSSSelfPlay-v0", "chase", "best"),
    ]
    for name, policy, opponent in cases:
        task = rsoccer.make_task(name)
        controllers = {} if opponent is None else {"yellow": opponent}
        own = Matches(name, controllers={**controllers, "blue_0": policy}, sensing=late)
        if opponent is not None:
            own = Matches(name, controllers={**controllers, "blue": policy}, sensing=late)
        asked = Matches(
            name, controllers=controllers, sensing=late, forecasting=make_policy(policy, task)
        )
        assert own.forecasting == asked.forecasting, (name, policy, opponent)


def test_recordings_with_changed_policies_go_on() -> None:
    """Their teams forecast as in the recording, not as the last policies would have them."""
    matches = Matches(
        "VSSSelfPlay-v0",
        controllers={"blue": "chase", "yellow": "best:mean"},
        sensing=Sensing(command_delay=DELAY),
        autoreset="disabled",
    )
    matches.reset(seed=3)
    matches.change_controllers({"yellow": "scripted"})
    names = {"blue": "chase", "yellow": "scripted"}
    recorder = Recorder(matches, controllers=names, snapshot_interval=0.1)
    recorder.begin()
    for _ in range(12):
        recorder.add(matches.step(np.zeros((1, 0, 2), np.float32)))
    replay = Replay.from_bytes(recorder.replay().to_bytes())
    assert replay.forecasting == ("blue",)
    frame = max(replay.snapshots)
    assert replay.resume(frame).forecasting == ("blue",)


def test_policies_over_another_one_expect_what_it_expects() -> None:
    task = rsoccer.make_task("SSLGoToBall-v0")
    robust = make_policy("best:robust", task)
    assert robust.forecasts
    assert HumanPolicy(robust, ["blue_0"], Driver(task)).forecasts
    assert PolicyMix(task, {"best:robust": 1.0}, Clock()).forecasts
    assert not PolicyMix(task, {"best:robust": 1.0, "best": 1.0}, Clock()).forecasts
