//! Halves, extra time, and the end of a match.

use rsim_referee::Team;
use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::{Clock, RefereeConfig};
use rsim_referee::events::EventKind;
use rsim_referee::game::Game;

use crate::crowds::defend;
use crate::pitches::{BALL_RADIUS, Size};
use crate::scene::{Scene, seen_by, steps};

/// Rules with short halves.
fn short() -> RefereeConfig {
    RefereeConfig { half_seconds: 2.0, extra_half_seconds: 1.0, ..Size::Three.config() }
}

/// A match with these rules before the kick-off of a team.
fn begun(config: RefereeConfig, first: Team) -> Scene {
    let mut scene = Scene::with(config, Size::Three.pitch(), [3, 3]);
    scene.game = Game::new(first);
    scene
}

/// Plays up to the end of the present half with a ball that rolls at the center. Returns the steps of play.
fn play_half(scene: &mut Scene) -> usize {
    let kickoff = scene.game.command;
    if kickoff == Command::Stop {
        let next = scene.game.next_command.expect("a kick-off");
        scene.wait_for(next);
    }
    assert_eq!(scene.wait_for(Command::NormalStart), steps(4.0));
    scene.roll([0.0, 0.0], [1.0, 0.0]);
    let stage = scene.game.stage;
    (1..=steps(400.0))
        .find(|_| {
            assert_eq!(scene.step(), []);
            scene.game.stage != stage
        })
        .expect("it ends")
}

/// Shoots a goal of a team in the present play.
fn score(scene: &mut Scene, team: Team) {
    let x = scene.referee.pitch().lines.half_length + BALL_RADIUS + 0.01;
    scene.roll(seen_by(team, [x, 0.0]), [1.0, 0.0]);
    scene.step_to(EventKind::Goal);
}

#[test]
fn halves_last_five_minutes_and_extra_halves_three() {
    use Stage::{
        ExtraFirstHalf, ExtraFirstHalfPre, ExtraSecondHalf, ExtraSecondHalfPre, FirstHalf,
        SecondHalf, SecondHalfPre, Shootout,
    };
    let mut scene = begun(Size::Three.config(), Team::Blue);
    for (played, seconds, next) in [
        (FirstHalf, 300.0, SecondHalfPre),
        (SecondHalf, 300.0, ExtraFirstHalfPre),
        (ExtraFirstHalf, 180.0, ExtraSecondHalfPre),
        (ExtraSecondHalf, 180.0, Shootout),
    ] {
        assert_eq!(play_half(&mut scene), steps(seconds), "{played:?}");
        assert_eq!((scene.game.stage, scene.game.command), (next, Command::Stop));
        assert_eq!(scene.game.stage_steps_left, 0);
        assert!(!scene.game.in_play);
    }
}

#[test]
fn the_teams_take_turns_at_the_kick_offs_of_halves() {
    for first in Team::BOTH {
        let mut scene = begun(short(), first);
        for kickoff in [first, first.opponent(), first, first.opponent()] {
            let command = match scene.game.command {
                Command::Stop => scene.game.next_command,
                command => Some(command),
            };
            assert_eq!(command, Some(Command::PrepareKickoff(kickoff)));
            play_half(&mut scene);
        }
        assert_eq!(scene.game.next_command, Some(Command::PreparePenalty(first)));
    }
}

#[test]
fn a_match_that_is_won_ends_after_its_halves() {
    for winner in Team::BOTH {
        let mut scene = begun(short(), Team::Blue);
        scene.wait_for(Command::NormalStart);
        score(&mut scene, winner);
        play_half(&mut scene);
        play_half(&mut scene);
        assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Command::Halt));
        assert_eq!(scene.game.next_command, None);
        let score = scene.game.score;
        scene.roll([0.0, 0.0], [0.0, 0.0]);
        assert_eq!(scene.run(20.0), [], "nothing happens any more");
        assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Command::Halt));
        assert_eq!(scene.game.score, score);
    }
}

#[test]
fn a_goal_in_extra_time_decides_at_its_end() {
    let mut scene = begun(short(), Team::Blue);
    play_half(&mut scene);
    play_half(&mut scene);
    scene.wait_for(Command::NormalStart);
    score(&mut scene, Team::Yellow);
    play_half(&mut scene);
    assert_eq!(scene.game.stage, Stage::ExtraSecondHalfPre);
    play_half(&mut scene);
    assert_eq!(scene.game.stage, Stage::PostGame);
}

#[test]
fn a_goal_in_the_last_step_of_a_half_counts() {
    let mut scene = begun(short(), Team::Blue);
    scene.wait_for(Command::NormalStart);
    scene.roll([0.0, 0.0], [1.0, 0.0]);
    assert_eq!(scene.run(1.975), []);
    assert_eq!((scene.game.stage, scene.game.stage_steps_left), (Stage::FirstHalf, 1));
    score(&mut scene, Team::Yellow);
    assert_eq!(scene.game.stage, Stage::SecondHalfPre);
    assert_eq!(scene.game.score[Team::Yellow], 1);
    let kickoff = Command::PrepareKickoff(Team::Yellow);
    assert_eq!(scene.game.next_command, Some(kickoff), "not that of the team without the goal");
}

#[test]
fn a_goal_in_the_last_step_of_a_match_decides_it() {
    let mut scene = begun(short(), Team::Blue);
    play_half(&mut scene);
    scene.wait_for(Command::NormalStart);
    scene.roll([0.0, 0.0], [1.0, 0.0]);
    assert_eq!(scene.run(1.975), []);
    score(&mut scene, Team::Yellow);
    assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Command::Halt));
    assert_eq!(scene.game.score[Team::Yellow], 1);
}

#[test]
fn after_the_match_nothing_counts_any_more() {
    let mut scene = begun(RefereeConfig { halves: 1.0, ..short() }, Team::Blue);
    scene.wait_for(Command::NormalStart);
    score(&mut scene, Team::Yellow);
    play_half(&mut scene);
    assert_eq!(scene.game.stage, Stage::PostGame);
    defend(&mut scene, Team::Yellow, 2);
    assert_eq!(scene.run(6.0), []);
    scene.ball([0.0, 0.0]);
    assert_eq!(scene.run(6.0), [], "nor is it stuck");
    assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Command::Halt));
    assert_eq!(scene.game.score[Team::Yellow], 1);
}

#[test]
fn a_half_ends_on_time_after_a_penalty_kick() {
    let mut scene = begun(short(), Team::Blue);
    scene.wait_for(Command::NormalStart);
    scene.park();
    defend(&mut scene, Team::Yellow, 2);
    scene.run(0.5);
    scene.roll([0.0, 0.0], [1.0, 0.0]);
    scene.step_to(EventKind::DefenderInDefenseArea);
    scene.wait_for(Command::NormalStart);
    scene.roll([0.0, 0.0], [1.0, 0.0]);
    let left = usize::try_from(scene.game.stage_steps_left).expect("some time");
    assert_eq!(left, steps(2.0 - 0.525));
    assert_eq!(scene.wait_for(Command::Stop), left);
    assert_eq!(scene.game.stage, Stage::SecondHalfPre);
}

#[test]
fn a_half_does_not_wait_for_a_penalty_kick() {
    let mut scene = begun(short(), Team::Blue);
    scene.wait_for(Command::NormalStart);
    scene.park();
    defend(&mut scene, Team::Yellow, 2);
    scene.run(1.975);
    scene.roll([0.0, 0.0], [1.0, 0.0]);
    scene.step_to(EventKind::DefenderInDefenseArea);
    assert_eq!(scene.game.stage, Stage::SecondHalfPre);
    assert_eq!(scene.game.next_command, Some(Command::PrepareKickoff(Team::Yellow)));
}

#[test]
fn with_a_running_clock_a_half_ends_in_a_stop_too() {
    let mut scene = begun(RefereeConfig { clock: Clock::Running, ..short() }, Team::Blue);
    scene.wait_for(Command::NormalStart);
    score(&mut scene, Team::Blue);
    scene.run(1.95);
    assert_eq!(scene.game.stage, Stage::FirstHalf);
    scene.step();
    assert_eq!(scene.game.stage, Stage::SecondHalfPre);
    assert_eq!(scene.game.command_steps, 0, "a new stop");
}

#[test]
fn a_lead_ends_a_match_early_where_the_rules_say_so() {
    let config = RefereeConfig { early_end_goals: 1.0, early_end_lead: 1.0, ..short() };
    for (config, is_over) in [(config, true), (short(), false)] {
        let mut scene = begun(config, Team::Blue);
        scene.wait_for(Command::NormalStart);
        score(&mut scene, Team::Yellow);
        assert_eq!(scene.game.stage == Stage::PostGame, is_over);
    }
}

#[test]
fn a_half_is_followed_by_a_stop_and_a_kick_off_at_the_center() {
    let mut scene = begun(short(), Team::Blue);
    scene.wait_for(Command::NormalStart);
    scene.ball([0.3, 0.3]);
    scene.run(2.0);
    assert_eq!(scene.game.stage, Stage::SecondHalfPre);
    let kickoff = Command::PrepareKickoff(Team::Yellow);
    assert_eq!(scene.wait_for(kickoff), steps(4.0), "breaks have no duration");
    assert_eq!(scene.ball_position().length().to_bits(), 0.0_f32.to_bits());
}
