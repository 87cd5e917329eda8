from typing import cast

import numpy as np
import pytest

from rsoccer import Matches, policies
from rsoccer.controllers import Controllers
from rsoccer.evaluate import Evaluation, Results, evaluate
from rsoccer.frame import Frame
from rsoccer.game import Command
from rsoccer.policies.base import PolicyInput
from rsoccer.policies.vss.roles import KEEPER
from rsoccer.policies.vss.scripted import Scripted
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslSelfPlay, VssMatch, VssMulti, VssSelfPlay, VssSingle
from rsoccer.view import SIDES
from tests.games import begin_play, set_game
from tests.helpers import Crowd, bounds, same
from tests.test_view import rotated

TASK = VssSelfPlay()


def no_actions(worlds: int) -> np.ndarray:
    """Actions of no learners."""
    return np.zeros((worlds, 0, 2), np.float32)


def score(policy: str, opponent: str, matches: int, task: VssSelfPlay = TASK) -> Evaluation:
    return evaluate(policy, opponent, matches, seed=2, task=task, worlds=matches, threads=2)


def wilson_low(wins: int, of: int) -> float:
    """Lower end of the 95% interval of a share (Wilson, 1927)."""
    z, share = 1.96, wins / of
    spread = z * (share * (1 - share) / of + z**2 / (4 * of**2)) ** 0.5
    return float((share + z**2 / (2 * of) - spread) / (1 + z**2 / of))


# -- Strength ---------------------------------------------------------------------------------


def test_it_beats_ou_from_either_side() -> None:
    """Nine in ten of the matches that are decided, and a goal score of 0.8."""
    found = score("scripted", "ou", 100)
    for part in (found, found.sides["blue"], found.sides["yellow"]):
        assert part.wins / (part.wins + part.losses) >= 0.9
        assert part.score >= 0.8
    assert bounds(found)[0] > 0.8
    assert wilson_low(found.wins, found.wins + found.losses) > 0.9


def test_it_beats_chase_from_either_side() -> None:
    found = score("scripted", "chase", 160, VssSelfPlay(max_steps=600))
    assert min(bounds(found.sides[side])[0] for side in SIDES) > 0.3


def test_it_scores_against_standing_robots_and_hardly_into_its_own_goal() -> None:
    found = score("scripted", "zero", 320, VssSelfPlay(max_steps=800))
    assert min(bounds(found.sides[side])[0] for side in SIDES) > 0.8
    assert found.losses <= 4


@pytest.mark.parametrize(("better", "worse"), [("1", "0.5"), ("0.5", "0")])
def test_more_skill_is_stronger(better: str, worse: str) -> None:
    found = score(f"scripted:{better}", f"scripted:{worse}", 40, VssSelfPlay(max_steps=400))
    assert bounds(found)[0] > 0.0


@pytest.mark.parametrize(("blue", "yellow"), [(1, 1), (5, 5), (2, 4)])
def test_teams_of_any_size_play(blue: int, yellow: int) -> None:
    task = VssSelfPlay(n_blue=blue, n_yellow=yellow, max_steps=400)
    found: Results = score("scripted", "ou", 20, task).sides["blue"]
    assert found.wins - found.losses >= 5


# -- Behavior --------------------------------------------------------------------------------


def test_the_keeper_stays_home() -> None:
    worlds = 60  # with fewer, one long scramble in a corner would weigh too much
    controllers = {"blue": "scripted", "yellow": "ou"}
    matches = Matches(TASK, worlds, 4, 2, controllers=controllers, autoreset="disabled")
    matches.reset()
    out = []
    for step in range(300):
        matches.step(no_actions(worlds))
        keeper = matches.state_dict()["blue_0.roles"][:, 0] == KEEPER
        assert (keeper.sum(axis=1) == 1).all()
        if step >= 80:  # once it is there
            playing = keeper & ~matches.done[:, None]
            out.extend(matches.frame.blue.position[playing] + [TASK.config.field.half_length, 0.0])
    away = np.array(out)
    assert len(away) > 500, "few matches last"
    assert np.quantile(away[:, 0], 0.95) < 0.2
    assert np.quantile(np.abs(away[:, 1]), 0.95) < 0.3


def test_both_sides_act_alike() -> None:
    rows = Crowd().get_initial_positions_frame(WorldRng.seeded(0, 8)).rows
    actions = []
    for start in (rows, rotated(Frame(rows, 3, 3)).rows):
        matches = Matches(TASK, 8, controllers={"all": "scripted"})
        matches.reset(rows=start)
        matches.step(no_actions(8))
        actions.append(matches.play.actions)
    assert np.array_equal(actions[0][:, [3, 4, 5, 0, 1, 2]], actions[1])
    assert np.abs(actions[0]).max() > 0.5


@pytest.mark.parametrize("skill", [0.5, 1.0])
def test_worlds_are_independent(skill: float) -> None:
    worlds, policy = 4, Scripted(TASK, skill)
    every: Controllers = {"all": policy}
    batch = Matches(TASK, worlds, 3, controllers=every)
    singles = [Matches(TASK, 1, 3 + i, controllers=every) for i in range(worlds)]
    for each in (batch, *singles):
        each.reset()
    backed_off = 0
    for _ in range(200):
        batch.step(no_actions(worlds))
        for single in singles:
            single.step(no_actions(1))
        expected = np.concatenate([single.play.actions for single in singles])
        assert same(batch.play.actions, expected)
        backed_off += int((batch.state_dict()["blue_0.slow_steps"] < 0).sum())
    assert backed_off > 0, "no random draws were compared"


def test_the_same_seed_is_the_same_match() -> None:
    rows = []
    for _ in range(2):
        matches = Matches(TASK, 5, 9, controllers={"all": "scripted:0.7"})
        matches.reset()
        for _ in range(150):
            matches.step(no_actions(5))
        rows.append(matches.frame.rows.copy())
    assert same(*rows)


def test_a_robot_plays_its_role_whichever_policy_drives_its_teammates() -> None:
    """In the first step roles follow from the start alone, so each robot acts as in a full team."""
    full = Matches(TASK, 6, 3, controllers={"all": "scripted"})
    mixed: Controllers = {"all": "ou", "blue_1": "scripted", "yellow_2": Scripted(TASK)}
    some = Matches(TASK, 6, 3, controllers=mixed)
    for matches in (full, some):
        matches.reset()
        matches.step(no_actions(6))
    assert np.array_equal(full.play.actions[:, [1, 5]], some.play.actions[:, [1, 5]])


@pytest.mark.parametrize(
    "task",
    [
        VssSingle(teammates="scripted", opponent="scripted:0.3"),
        VssMulti(n_blue=1, n_yellow=5, opponent="scripted"),
        VssMulti(n_blue=3, n_yellow=1, opponent="scripted"),
        VssMulti(n_blue=2, n_yellow=0),
        VssSelfPlay(n_blue=1, n_yellow=0),
        VssSelfPlay(robot="vss_650rpm"),
    ],
)
def test_it_drives_in_every_task_with_differential_drive(task: VssSelfPlay) -> None:
    controllers: Controllers = {f"blue_{task.n_blue - 1}": "scripted"}
    matches = Matches(task, 3, controllers=controllers)
    matches.reset()
    for _ in range(60):
        matches.step(np.zeros((3, len(matches.agents), 2), np.float32))
    actions = matches.play.actions[:, task.n_blue - 1]
    assert np.isfinite(actions).all()
    assert np.abs(actions).max() > 0.0


# -- Under a referee -------------------------------------------------------------------------


def referee_matches(task: VssMatch, worlds: int, steps: int, policy: str) -> Matches:
    """Matches under a referee that were played for some steps."""
    matches = Matches(task, worlds, 3, controllers={"all": policy}, autoreset="disabled")
    matches.reset()
    for _ in range(steps):
        matches.step(no_actions(worlds))
    return matches


@pytest.mark.parametrize(
    ("size", "field", "policy"),
    [
        (3, "vss_3v3", "scripted"),
        (3, "vss_3v3", "scripted:0.5"),
        (5, "vss_5v5", "scripted"),
    ],
)
def test_it_commits_hardly_a_foul(size: int, field: str, policy: str) -> None:
    """Less than one a minute of both teams; without respect for the rules it is up to ten."""
    task = VssMatch(n_blue=size, n_yellow=size, field=field)
    matches = referee_matches(task, 16, 700, policy)
    minutes = task.metrics(matches.play)["in_play"].sum() / 60.0
    offenses = sum(float(count.sum()) for count in task.offenses(matches.play).values())
    assert minutes > 2.0
    assert offenses / minutes < 1.0
    assert matches.play.game.score.sum() > 0


def test_it_stands_while_play_is_stopped() -> None:
    matches = Matches(VssMatch(), 4, 3, controllers={"all": "scripted"}, autoreset="disabled")
    matches.reset()
    stopped, played = 0, 0
    for _ in range(600):
        may_touch = matches.play.game.may_touch.copy()
        matches.step(no_actions(4))
        assert not matches.play.actions[~may_touch].any()
        moves = matches.play.actions.any(axis=2)
        stopped, played = stopped + (~may_touch).sum(), played + (moves & may_touch).sum()
    assert stopped > 1000 < played


@pytest.mark.parametrize("command", [Command.GOAL_KICK_BLUE, Command.PREPARE_PENALTY_BLUE])
def test_it_takes_its_kicks(command: Command) -> None:
    """Away from the own goal, or into that of the others."""
    matches = Matches(VssMatch(), controllers={"blue": "scripted", "yellow": "zero"})
    matches.reset()
    begin_play(matches)
    x = -0.6 if command == Command.GOAL_KICK_BLUE else 0.375
    y = 0.35 if command == Command.GOAL_KICK_BLUE else 0.0
    set_game(matches, command=command, next_command=Command.NORMAL_START, kick=command)
    set_game(matches, in_play=False, designated_position_x=x, designated_position_y=y)
    farthest = x
    for _ in range(400):
        matches.step(no_actions(1))
        if matches.play.game.command[0] == Command.NORMAL_START:
            farthest = max(farthest, float(matches.frame.ball.position[0, 0]))
    assert farthest > x + 0.25
    assert matches.play.game.score[0, 1] == 0
    assert not any(count.any() for count in VssMatch().offenses(matches.play).values())


# -- Skill ------------------------------------------------------------------------------------


def test_skill_limits_speed_and_decision_rate() -> None:
    changes = {}
    for skill in (0.0, 0.5, 1.0):
        matches = Matches(TASK, 4, 1, controllers={"blue": Scripted(TASK, skill), "yellow": "zero"})
        matches.reset()
        targets = []
        for _ in range(48):
            matches.step(no_actions(4))
            targets.append(matches.state_dict()["blue_0.targets"].copy())
        changes[skill] = int((np.diff(targets, axis=0) != 0.0).any(axis=(1, 2, 3)).sum())
        wheel_speeds = np.abs(matches.play.actions[:, :3]).max()
        assert wheel_speeds <= 0.03 + 0.97 * skill + 1e-6
        assert wheel_speeds > 0.5 * skill
    assert changes[0.0] < changes[0.5] < changes[1.0] == 47
    assert changes[0.0] == 3, "every 0.3 s"


def test_a_name_may_carry_a_skill() -> None:
    actions = []
    for policy in ("scripted:0.5", Scripted(TASK, 0.5), "scripted"):
        matches = Matches(TASK, 4, 1, controllers={"all": policy})
        matches.reset()
        for _ in range(20):
            matches.step(no_actions(4))
        actions.append(matches.play.actions.copy())
    assert same(actions[0], actions[1])
    assert not same(actions[0], actions[2])
    assert "scripted" in policies.list_policies()
    assert policies.list_policies_with_skill() == ["scripted", "take"]


@pytest.mark.parametrize("skill", ["2", "-0.1", "x", "", "nan", "0.5:1"])
def test_invalid_skills_are_refused(skill: str) -> None:
    with pytest.raises(ValueError, match=f"scripted: expected a skill from 0 to 1, got '?{skill}"):
        policies.make_policy(f"scripted:{skill}", TASK)


@pytest.mark.parametrize("name", ["zero:0.5", "chase:1", "ou:"])
def test_other_policies_have_no_skill(name: str) -> None:
    first = name.split(":")[0]
    message = f"'{first}' has no skill: expected '{first}', got '{name}'.*'scripted'"
    with pytest.raises(ValueError, match=message):
        policies.make_policy(name, TASK)


# -- Invalid input ----------------------------------------------------------------------------


def test_it_refuses_other_robots() -> None:
    with pytest.raises(ValueError, match="scripted needs robots with a differential drive"):
        Scripted(SslSelfPlay())
    assert not isinstance(policies.make_policy("scripted:0.5", SslSelfPlay()), Scripted)


@pytest.mark.parametrize("name", ["VSSSelfPlay-v0", "SSLSelfPlay-v0"])
def test_a_policy_built_for_other_teams_is_refused(name: str) -> None:
    other = Scripted(VssSelfPlay(n_blue=2))
    with pytest.raises(ValueError, match=f"field, robots and teams of {name}, got a Scripted"):
        Matches(name, controllers={"blue": other})
    assert policies.make_policy(other, VssSelfPlay(n_blue=2, max_steps=9)) is other


def test_it_needs_a_view() -> None:
    scripted, rng = cast(Scripted, policies.make_policy("scripted", TASK)), WorldRng.seeded(0, 1)
    shape = (1, 1, 2)
    with pytest.raises(ValueError, match="scripted needs a view"):
        scripted.act(PolicyInput(shape, None, None), rng, scripted.new_memory(shape, rng))
