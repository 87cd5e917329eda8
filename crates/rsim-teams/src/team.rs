//! A scripted side.

use rsim_referee::Team;
use rsim_referee::game::Game;

use crate::bounds::{Bounds, Part};
use crate::config::TeamConfig;
use crate::error::TeamsError;
use crate::intercept::Meetings;
use crate::memory::Memory;
use crate::motion::Driving;
use crate::orders::orders;
use crate::phase::{Mode, Phase};
use crate::pitch::Pitch;
use crate::possession;
use crate::random::Random;
use crate::roles;
use crate::rolling::BallPath;
use crate::situation::{KEEPER, Situation};
use crate::skill::Skill;
use crate::tactics::Tactics;
use crate::view::{Player, View};

/// Names of the columns of a command: velocity forward and to the left (m/s), angular velocity (rad/s), speed
/// of a kick along the heading and upward (m/s), dribbler (0 to 1).
pub const COMMAND_COLUMNS: [&str; 6] =
    ["v_x", "v_y", "v_theta", "kick_v_x", "kick_v_z", "dribbler"];

/// Change of the ball's velocity in a step by which a kick differs from friction, m/s.
const KICKED: f32 = 0.3;
/// Time for which an error of aim lasts, s.
const AIM_SECONDS: f32 = 1.0;
/// Distance from the ball of robots that leave it to a teammate, m.
const TEAMMATE_DISTANCE: f32 = 0.3;

/// A scripted side: the same for all matches, and without state of its own.
#[derive(Debug, Clone)]
pub struct ScriptedTeam {
    config: TeamConfig,
    pitch: Pitch,
    skill: Skill,
}

impl ScriptedTeam {
    /// A side.
    ///
    /// # Errors
    /// A number outside its range.
    pub fn new(config: &TeamConfig) -> Result<Self, TeamsError> {
        config.validate()?;
        let pitch = Pitch { lines: config.lines.clone() };
        let skill = Skill::new(config.skill, config.time_step);
        Ok(Self { config: config.clone(), pitch, skill })
    }

    /// Names of the columns of a team's memory.
    pub fn memory_columns(&self) -> Vec<String> {
        Memory::columns(self.robots())
    }

    /// Sets the memory of a team before its first step. `tactics` has the numbers by which it plays, in the order
    /// of [`TACTICS`](crate::TACTICS); `None` for those that were set by hand.
    ///
    /// # Errors
    /// A memory or tactics of another length, or a number out of its range.
    pub fn begin(
        &self,
        memory: &mut [f32],
        seed: u32,
        tactics: Option<&[f32]>,
    ) -> Result<(), TeamsError> {
        check_size("memory", self.memory_columns().len(), memory.len())?;
        let tactics = tactics.map_or(Ok(Tactics::DEFAULT), Tactics::read)?;
        Memory { tactics, ..Memory::new(seed) }.write(memory, self.robots());
        Ok(())
    }

    /// Writes the commands of a team's robots for a state row and a match, robot by robot with
    /// [`COMMAND_COLUMNS`], and brings the memory up to date. Absent robots get zeros.
    ///
    /// # Errors
    /// Rows of other lengths, or a memory with a number that its column cannot have.
    pub fn act(
        &self,
        row: &[f32],
        game: &Game,
        team: Team,
        memory: &mut [f32],
        commands: &mut [f32],
    ) -> Result<(), TeamsError> {
        let layout = &self.config.layout;
        let size = layout.team_size(team) * COMMAND_COLUMNS.len();
        check_size("commands", size, commands.len())?;
        let sight = layout.sight(row)?;
        let first = [0, layout.team_size(Team::Blue)];
        let view = View::new(&sight, team, first);
        let mut kept = Memory::read(memory, self.robots())?;
        commands.fill(0.0);
        self.decide(&view, game, team, &mut kept, commands);
        kept.write(memory, self.robots());
        Ok(())
    }

    /// Robots whose memory is kept: those of the larger team, so that both can play with it.
    fn robots(&self) -> usize {
        let [blue, yellow] = Team::BOTH.map(|team| self.config.layout.team_size(team));
        blue.max(yellow)
    }

    fn decide(
        &self,
        view: &View,
        game: &Game,
        team: Team,
        memory: &mut Memory,
        commands: &mut [f32],
    ) {
        let phase = Phase::of(game, team);
        memory.team.step = (memory.team.step + 1) % (1 << 23);
        follow_kicks(view, memory);
        if phase.mode == Mode::Halt {
            return;
        }
        let tactics = memory.tactics;
        let situation = self.situation(view, game, team, phase, memory, &tactics);
        possession::follow(&situation, &mut memory.team);
        roles::follow(&situation, &mut memory.team);
        memory.team.taker = roles::taker(&situation, &memory.team);
        let orders = orders(&situation, memory);
        let Situation { config, pitch, skill, tactics, .. } = situation;
        let driving = Driving { config, pitch, skill, tactics, view };
        for player in view.own.iter() {
            let part = part_of(&situation, player, memory.team.taker);
            let ends = [view.ball.position, situation.place];
            let radius = self.config.robot.radius;
            let max_speed = situation.speed();
            let mut bounds = Bounds::new(phase, part, ends, max_speed, &self.pitch, radius);
            if player.index == KEEPER {
                bounds.own_area = None;
            }
            let leaves_ball = phase.mode == Mode::Play && part == Part::Other
                || situation.barred == Some(player.index);
            if leaves_ball {
                bounds.avoided.distance = bounds.avoided.distance.max(TEAMMATE_DISTANCE);
            }
            let order = &orders[player.index];
            let command = driving.command(player, order, &bounds);
            commands[player.index * COMMAND_COLUMNS.len()..][..COMMAND_COLUMNS.len()]
                .copy_from_slice(&command);
        }
    }

    fn situation<'a>(
        &'a self,
        view: &'a View,
        game: &Game,
        team: Team,
        phase: Phase,
        memory: &Memory,
        tactics: &'a Tactics,
    ) -> Situation<'a> {
        let barred = |of: Team| {
            let first = if of == Team::Blue { 0 } else { self.config.layout.team_size(Team::Blue) };
            let index = game.kick_taker?.checked_sub(first)?;
            (index < self.config.layout.team_size(of)).then_some(index)
        };
        let seconds = AIM_SECONDS / self.config.time_step;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a count of seconds
        let counter = (memory.team.step as f32 / seconds) as u32;
        let mut situation = Situation {
            config: &self.config,
            pitch: &self.pitch,
            skill: &self.skill,
            tactics,
            view,
            phase,
            command_time: game.command_steps as f32 * self.config.time_step,
            in_play: game.in_play,
            place: game.designated_position * -team.own_side(),
            barred: barred(team),
            barred_opponent: barred(team.opponent()),
            path: BallPath::new(&view.ball, memory.team.kick_speed, &self.config.ball),
            own: Meetings::default(),
            others: Meetings::default(),
            random: Random::new(memory.team.seed(), counter),
            step: memory.team.step,
        };
        situation.meet();
        situation
    }
}

fn check_size(name: &'static str, expected: usize, got: usize) -> Result<(), TeamsError> {
    if expected == got { Ok(()) } else { Err(TeamsError::Size { name, expected, got }) }
}

/// Follows the speed that the last kick gave the ball.
fn follow_kicks(view: &View, memory: &mut Memory) {
    let velocity = view.ball.velocity;
    if velocity.distance(memory.team.ball_velocity) > KICKED {
        memory.team.kick_speed = velocity.length();
    }
    memory.team.ball_velocity = velocity;
}

fn part_of(s: &Situation, player: &Player, taker: Option<usize>) -> Part {
    if s.keeps(player.index) {
        Part::Keeper
    } else if taker == Some(player.index) {
        Part::Taker
    } else {
        Part::Other
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Scene;
    use rsim_referee::codes::Command;

    fn in_play() -> Game {
        let mut game = Game::new(Team::Blue);
        game.give(Command::ForceStart, None);
        game.in_play = true;
        game
    }

    fn acted(scene: &Scene, game: &Game, team: Team, memory: &mut [f32]) -> Vec<f32> {
        let side = ScriptedTeam::new(&scene.config).expect("valid numbers");
        let length = scene.config.layout.team_size(team) * COMMAND_COLUMNS.len();
        let mut commands = vec![7.0; length];
        side.act(&scene.row, game, team, memory, &mut commands).expect("rows that fit");
        assert!(commands.iter().all(|number| number.is_finite()));
        commands
    }

    fn begun(scene: &Scene, seed: u32) -> Vec<f32> {
        let side = ScriptedTeam::new(&scene.config).expect("valid numbers");
        let mut memory = vec![0.0; side.memory_columns().len()];
        side.begin(&mut memory, seed, None).expect("a memory");
        memory
    }

    #[test]
    fn lone_robots_fetch_balls_that_the_opponent_may_not_touch() {
        let mut scene = Scene::new(1, 1);
        for (team, side, opponent) in [(Team::Blue, 1.0, 1), (Team::Yellow, -1.0, 0)] {
            scene.robot(1 - opponent, [-2.0 * side, 0.0]);
            scene.robot(opponent, [1.3 * side, 0.0]);
            scene.ball([1.0 * side, 0.0], [0.0, 0.0]);
            let ahead = |kick_taker| {
                let game = Game { kick_taker, ..in_play() };
                // All robots face +x.
                side * acted(&scene, &game, team, &mut begun(&scene, 5))[0]
            };
            assert!(ahead(Some(opponent)) > 0.0, "{team:?}: {}", ahead(Some(opponent)));
            assert!(
                ahead(Some(1 - opponent)) < 0.0 && ahead(None) < 0.0,
                "{team:?} guards its goal"
            );
        }
    }

    #[test]
    fn commands_depend_on_row_match_and_memory_alone() {
        let scene = Scene::new(3, 2);
        let mut memory = begun(&scene, 5);
        let mut copy = memory.clone();
        for _ in 0..3 {
            let first = acted(&scene, &in_play(), Team::Blue, &mut memory);
            assert_eq!(first, acted(&scene, &in_play(), Team::Blue, &mut copy));
            assert_eq!(memory, copy);
        }
    }

    #[test]
    fn both_teams_play_the_same_from_mirrored_places() {
        let mut scene = Scene::new(3, 3);
        for robot in 0..3 {
            let (x, y) = (-1.0 - robot as f32, 0.7 * robot as f32 - 0.5);
            scene.robot(robot, [x, y]);
            scene.robot(robot + 3, [-x, -y]);
            scene.set(robot + 3, "cos", -1.0);
        }
        let [blue, yellow] = Team::BOTH.map(|team| {
            let mut memory = begun(&scene, 5);
            acted(&scene, &in_play(), team, &mut memory)
        });
        for (ours, theirs) in blue.iter().zip(&yellow) {
            assert!((ours - theirs).abs() < 1e-5, "{blue:?} {yellow:?}");
        }
    }

    #[test]
    fn absent_robots_and_halted_ones_get_zeros() {
        let mut scene = Scene::new(3, 2);
        scene.take_out(1);
        let mut memory = begun(&scene, 5);
        let commands = acted(&scene, &in_play(), Team::Blue, &mut memory);
        assert!(commands[6..12].iter().all(|number| number.abs() < 1e-9));
        assert!(commands[12..].iter().any(|number| number.abs() > 1e-3));
        let mut halted = in_play();
        halted.give(Command::Halt, None);
        let commands = acted(&scene, &halted, Team::Blue, &mut memory);
        assert!(commands.iter().all(|number| number.abs() < 1e-9));
    }

    #[test]
    fn rows_of_other_lengths_are_refused() {
        let scene = Scene::new(3, 2);
        let side = ScriptedTeam::new(&scene.config).expect("valid numbers");
        let mut memory = begun(&scene, 5);
        let act = |row: &[f32], memory: &mut [f32], size: usize| {
            side.act(row, &in_play(), Team::Blue, memory, &mut vec![0.0; size])
        };
        assert!(matches!(act(&scene.row[1..], &mut memory, 18), Err(TeamsError::Row(_))));
        let wrong = act(&scene.row, &mut memory, 17);
        assert_eq!(wrong, Err(TeamsError::Size { name: "commands", expected: 18, got: 17 }));
        let short = act(&scene.row, &mut memory[1..].to_vec(), 18);
        assert!(short.is_err());
        assert!(side.begin(&mut memory[1..].to_vec(), 5, None).is_err());
    }
}
