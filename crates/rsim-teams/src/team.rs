//! A scripted side.

use rsim_referee::game::Game;
use rsim_referee::{Team, Vector};

use crate::aim;
use crate::approach;
use crate::bounds::{Bounds, Part};
use crate::config::{MAX_ROBOTS, TeamConfig};
use crate::error::TeamsError;
use crate::intercept::Meetings;
use crate::keeper;
use crate::memory::Memory;
use crate::motion::Driving;
use crate::order::Order;
use crate::phase::{Mode, Phase};
use crate::pitch::Pitch;
use crate::placement;
use crate::plane::Plane;
use crate::possession;
use crate::random::Random;
use crate::restart;
use crate::roles;
use crate::rolling::BallPath;
use crate::situation::{KEEPER, Situation};
use crate::skill::Skill;
use crate::support::{self, RUNNER};
use crate::view::{Player, View};

/// Names of the columns of a command: velocity forward and to the left (m/s), angular velocity (rad/s), speed
/// of a kick along the heading and upward (m/s), dribbler (0 to 1).
pub const COMMAND_COLUMNS: [&str; 6] =
    ["v_x", "v_y", "v_theta", "kick_v_x", "kick_v_z", "dribbler"];

/// Change of the ball's velocity in a step by which a kick is told from friction, m/s.
const KICKED: f32 = 0.3;
/// Time for which an error of aim lasts, s.
const AIM_SECONDS: f32 = 1.0;
/// Distance from the ball within which a robot reacts at once, m.
const CLOSE: f32 = 0.6;
/// Distance from the ball of the robot that blocks a kick of the opponents, m.
const BLOCK_DISTANCE: f32 = 0.8;
/// Time by which an opponent is earlier at the ball from which a robot without mates guards its goal, s.
const ALONE: f32 = 0.2;
/// Cosine of the angle between the ways to the ball and on with it up to which a robot drives behind the
/// ball, with time and without.
const AIMED_WITH_TIME: f32 = -0.3;
const AIMED: f32 = 0.6;
/// Distance from the ball of robots that leave it to a mate, m.
const MATE_DISTANCE: f32 = 0.3;

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

    /// Sets the memory of a team before its first step.
    ///
    /// # Errors
    /// A memory of another length.
    pub fn begin(&self, memory: &mut [f32], seed: u32) -> Result<(), TeamsError> {
        check_size("memory", self.memory_columns().len(), memory.len())?;
        Memory::new(seed).write(memory, self.robots());
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
        let situation = self.situation(view, game, team, phase, memory);
        possession::follow(&situation, &mut memory.team);
        roles::follow(&situation, &mut memory.team);
        memory.team.taker = roles::taker(&situation, &memory.team);
        let orders = orders(&situation, memory);
        let driving =
            Driving { config: &self.config, pitch: &self.pitch, skill: &self.skill, view };
        for player in view.own.iter() {
            let part = part_of(&situation, player, memory.team.taker);
            let ends = [view.ball.position, situation.place];
            let radius = self.config.robot.radius;
            let max_speed = self.skill.speed * self.config.robot.max_speed;
            let mut bounds = Bounds::new(phase, part, ends, max_speed, &self.pitch, radius);
            if player.index == KEEPER {
                bounds.own_area = None;
            }
            let leaves_ball = phase.mode == Mode::Play && part == Part::Other
                || situation.barred == Some(player.index);
            if leaves_ball {
                bounds.distance = bounds.distance.max(MATE_DISTANCE);
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
    ) -> Situation<'a> {
        let first = if team == Team::Blue { 0 } else { self.config.layout.team_size(Team::Blue) };
        let own_index = |robot: usize| robot.checked_sub(first).filter(|index| *index < MAX_ROBOTS);
        let seconds = AIM_SECONDS / self.config.time_step;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a count of seconds
        let counter = (memory.team.step as f32 / seconds) as u32;
        let mut situation = Situation {
            config: &self.config,
            pitch: &self.pitch,
            skill: &self.skill,
            view,
            phase,
            command_time: game.command_steps as f32 * self.config.time_step,
            place: game.designated_position * -team.own_side(),
            barred: game.kick_taker.and_then(own_index),
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

/// Orders of all robots, by index.
fn orders(s: &Situation, memory: &mut Memory) -> [Order; MAX_ROBOTS] {
    let stay = Order::to(Vector::default(), Vector::new(1.0, 0.0));
    let mut orders = [stay; MAX_ROBOTS];
    let taker = memory.team.taker;
    let mut free = 0;
    for player in s.view.own.iter() {
        if s.keeps(player.index) {
            let order = keeper_order(s, memory, player);
            orders[player.index] = reacting(s, memory, player, order);
        } else if taker == Some(player.index) {
            let order = taker_order(s, memory, player);
            orders[player.index] = reacting(s, memory, player, order);
        } else {
            free |= 1 << player.index;
        }
    }
    let jobs = roles::jobs(s, memory, free);
    let is_runner = |index: usize| jobs[index].is_some_and(|job| job.number == RUNNER);
    let runners = (0..MAX_ROBOTS).filter(|index| is_runner(*index)).fold(0, |all, i| all | 1 << i);
    for player in s.view.own.iter().filter(|player| free >> player.index & 1 == 1) {
        let Some(job) = jobs[player.index] else { continue };
        let target =
            job.place.unwrap_or_else(|| support::spot(s, player, runners, &mut memory.robots));
        memory.robots[player.index].job = job.number;
        let order = Order::to(target, s.ball() - player.position);
        orders[player.index] = reacting(s, memory, player, order);
    }
    if let Some(index) = taker {
        memory.robots[index].job = -1;
    }
    orders
}

/// The order as the robot follows it: it sees a new place only after its reaction time.
fn reacting(s: &Situation, memory: &mut Memory, player: &Player, order: Order) -> Order {
    let kept = &mut memory.robots[player.index];
    let steps = s.skill.reaction_steps;
    let turn = i32::try_from(player.index).unwrap_or(0) * 3;
    let is_close = player.index != KEEPER && player.position.distance(s.ball()) < CLOSE;
    if s.phase.mode != Mode::Play || is_close || (s.step + turn) % steps == 0 {
        (kept.target, kept.facing) = (order.target, order.facing);
        return order;
    }
    Order { target: kept.target, facing: kept.facing, ..order }
}

fn keeper_order(s: &Situation, memory: &mut Memory, keeper: &Player) -> Order {
    if roles::is_penalty(s) && !s.phase.ours && s.path.speed < 0.1 {
        return keeper::on_line(s, keeper);
    }
    if s.phase.mode == Mode::Play && s.barred != Some(KEEPER) && keeper::takes_ball(s) {
        return ball_order(s, memory, keeper);
    }
    keeper::guard(s, keeper)
}

fn taker_order(s: &Situation, memory: &mut Memory, robot: &Player) -> Order {
    match s.phase.mode {
        Mode::Play | Mode::Halt => ball_order(s, memory, robot),
        Mode::Kick if s.phase.ours => restart::take_kick(s, &mut memory.team, robot),
        Mode::Place if s.phase.ours => placement::place(s, &mut memory.team, robot),
        Mode::Stop | Mode::Prepare if s.phase.ours => restart::wait_for_kick(s),
        _ => Order::to(block_place(s), s.ball() - robot.position),
    }
}

/// Takes the ball, or plays it.
fn ball_order(s: &Situation, memory: &mut Memory, robot: &Player) -> Order {
    if possession::controls(s, robot) {
        return possession::play(s, &mut memory.team, robot);
    }
    if possession::is_too_far(s, &memory.team, robot) {
        return possession::stand(robot);
    }
    let meeting = s.own.of(robot.index).unwrap_or_default();
    let to_ball = (meeting.place - robot.position).unit_or(robot.heading);
    let rival = s.others.first(|_| true).map_or(f32::INFINITY, |(_, meeting)| meeting.time);
    let is_alone = s.view.own.len() == 1;
    if is_alone && rival + ALONE < meeting.time {
        return keeper::guard(s, robot);
    }
    let place = meeting.place;
    let kick = possession::chosen(s, &mut memory.team, robot.index, || {
        aim::best_kick(s, place, robot.index)
    });
    let aim = (kick.at - place).unit_or(Vector::new(1.0, 0.0));
    let least = if robot.index == KEEPER {
        -1.0 // it never drives the ball toward its goal
    } else if rival > meeting.time + 0.5 {
        AIMED_WITH_TIME
    } else {
        AIMED
    };
    approach::take(s, robot, meeting, if aim.dot(to_ball) > least { aim } else { to_ball })
}

/// Place of the robot nearest to the ball where it may not play it: between ball and goal.
fn block_place(s: &Situation) -> Vector {
    let ball = s.ball();
    let to_goal = (s.pitch.own_goal() - ball).unit_or(Vector::new(-1.0, 0.0));
    ball + to_goal * BLOCK_DISTANCE
}

fn check_size(name: &'static str, expected: usize, got: usize) -> Result<(), TeamsError> {
    if expected == got { Ok(()) } else { Err(TeamsError::Size { name, expected, got }) }
}
