//! Places in which robots may stand before a kick: the distances of the rules, and room for their bodies.

use std::sync::LazyLock;

use crate::codes::Command;
use crate::config::League;
use crate::game::Game;
use crate::moment::Moment;
use crate::pitch::{Pitch, ROOM};
use crate::sight::Robot;
use crate::team::Team;
use crate::vector::Vector;

/// Distance between the rings on which a free place is searched, m.
const RING: f32 = 0.03;
/// Most places on a ring.
const MAX_ON_RING: u16 = 48;
/// Rings that cover the largest field.
const RINGS: u16 = 600;
/// Rings from which on all have as many places as allowed.
const FULL_RING: u16 = MAX_ON_RING / 6;

/// Directions of the places on each ring up to the first full one: sines and cosines take a good part of a
/// search.
static DIRECTIONS: LazyLock<Vec<Vec<Vector>>> = LazyLock::new(|| {
    (0..=FULL_RING)
        .map(|ring| {
            let places = (6 * ring).clamp(1, MAX_ON_RING);
            let angle = |nth| std::f32::consts::TAU * f32::from(nth) / f32::from(places);
            (0..places)
                .map(|nth| Vector::new(libm::cosf(angle(nth)), libm::sinf(angle(nth))))
                .collect()
        })
        .collect()
});

/// Places in which robots may stand, with the ball at a place.
#[derive(Debug)]
pub(crate) struct Positions<'a> {
    moment: &'a Moment<'a>,
    /// The command that decides it.
    command: Command,
    /// Whether all robots keep their distance from the ball, the kicking team's too.
    is_stopped: bool,
    ball: Vector,
    /// The robot that takes the kick.
    taker: Option<usize>,
}

impl<'a> Positions<'a> {
    /// The positions that the present command allows, or in a stop the next one.
    pub(crate) fn new(game: &Game, moment: &'a Moment<'a>, ball: Vector) -> Self {
        let command = command_of_positions(game);
        let is_stopped = matches!(game.command, Command::Stop | Command::Halt);
        let taker = command.team().and_then(|team| nearest_to(moment, team, ball));
        Self { moment, command, is_stopped, ball, taker }
    }

    /// The place of the ball.
    pub(crate) const fn ball(&self) -> Vector {
        self.ball
    }

    /// Whether a robot may stand at a place, whatever other robots do.
    pub(crate) fn allows(&self, robot: &Robot, place: Vector) -> bool {
        self.moment.pitch.has_room(place)
            && place.distance(self.ball) - self.moment.pitch.robot_radius >= self.ball_gap(robot)
            && (self.moment.config.league == League::Vsss || self.obeys_areas(robot, place))
    }

    /// The allowed place nearest to `wanted` that is clear of the robots that have their places.
    pub(crate) fn nearest(&self, robot: &Robot, wanted: Vector, settled: &[Vector]) -> Vector {
        let wanted = self.toward_allowed(robot, wanted);
        let between = 2.0 * self.moment.pitch.robot_radius + ROOM;
        let is_free = |place: &Vector| {
            self.allows(robot, *place) // refuses most places, and takes less time than the robots
                && settled.iter().all(|other| other.distance(*place) >= between)
        };
        // The first place of a ring lies toward the own goal and the next ones toward the middle, so that the
        // choice is the same for both teams and on both sides.
        let home = robot.team.own_side();
        let inward = if wanted.y == 0.0 { home } else { -wanted.y.signum() };
        (0..RINGS)
            .flat_map(|ring| {
                DIRECTIONS[usize::from(ring.min(FULL_RING))].iter().map(move |direction| {
                    let out = Vector::new(home * direction.x, inward * direction.y);
                    wanted + out * (RING * f32::from(ring))
                })
            })
            .find(is_free)
            .unwrap_or(wanted)
    }

    /// A place that is within the bounds of a special role, before the search for a free one.
    fn toward_allowed(&self, robot: &Robot, wanted: Vector) -> Vector {
        let lines = self.moment.lines();
        match self.command {
            Command::PreparePenalty(attacker)
                if self.moment.config.league == League::Ssl
                    && self.is_penalty_keeper(robot, attacker) =>
            {
                let half = (lines.half_goal_width - self.moment.pitch.robot_radius).max(0.0);
                Vector::new(lines.goal(robot.team).x, wanted.y.clamp(-half, half))
            }
            _ => wanted,
        }
    }

    /// Distance that the hull of a robot keeps from the center of the ball.
    fn ball_gap(&self, robot: &Robot) -> f32 {
        let config = self.moment.config;
        let touching = self.moment.pitch.ball_radius + ROOM;
        let is_kicking = self.command.team() == Some(robot.team);
        if !self.is_stopped && is_kicking {
            touching + config.placement_clearance
        } else {
            touching.max(config.ball_distance)
        }
    }

    /// Whether a robot keeps to the areas and halves of the rules of SSL.
    fn obeys_areas(&self, robot: &Robot, place: Vector) -> bool {
        let (lines, radius) = (self.moment.lines(), self.moment.pitch.robot_radius);
        let from_area = lines.distance_to_area(place, robot.team.opponent()) - radius;
        match self.command {
            Command::PrepareKickoff(team) => {
                let in_own_half = robot.team.own_side() * place.x >= radius;
                let from_circle = place.length() - radius - lines.center_circle_radius;
                let is_kicker = self.taker == Some(robot.index) && robot.team == team;
                if is_kicker {
                    in_own_half || from_circle <= -2.0 * radius
                } else {
                    in_own_half && from_circle >= 0.0
                }
            }
            Command::PreparePenalty(attacker) => self.obeys_penalty(robot, place, attacker),
            _ => from_area >= self.moment.config.area_distance,
        }
    }

    /// "Penalty Kick": the keeper on its line, the kicker anywhere, all others behind the ball.
    fn obeys_penalty(&self, robot: &Robot, place: Vector, attacker: Team) -> bool {
        if self.is_penalty_keeper(robot, attacker) {
            return is_on_goal_line(self.moment, robot.team, place);
        }
        let behind = attacker.own_side() * (place.x - self.ball.x) - self.moment.pitch.robot_radius;
        self.taker == Some(robot.index) && behind >= 0.0
            || behind >= self.moment.config.penalty_distance
    }

    fn is_penalty_keeper(&self, robot: &Robot, attacker: Team) -> bool {
        robot.team != attacker && robot.index == self.moment.keeper(robot.team)
    }
}

/// Distance between the centers of ball and robot from which they do not touch, m.
pub(crate) fn clear_of_ball(pitch: &Pitch) -> f32 {
    pitch.robot_radius + pitch.ball_radius + ROOM
}

/// The command that decides where robots may stand.
pub(crate) fn command_of_positions(game: &Game) -> Command {
    match game.command {
        Command::Stop | Command::Halt | Command::BallPlacement(_) => {
            game.next_command.unwrap_or(Command::ForceStart)
        }
        Command::NormalStart => game.kick.unwrap_or(Command::ForceStart),
        command => command,
    }
}

/// Whether a robot at a place touches the goal line of its team, and is between the posts.
pub(crate) fn is_on_goal_line(moment: &Moment, team: Team, place: Vector) -> bool {
    let (lines, radius) = (moment.lines(), moment.pitch.robot_radius);
    (place.x - lines.goal(team).x).abs() <= radius
        && place.y.abs() <= lines.half_goal_width - radius
}

/// The robot of a team that is nearest to a place; the keeper only if there is no other.
pub(crate) fn nearest_to(moment: &Moment, team: Team, place: Vector) -> Option<usize> {
    let keeper = moment.keeper(team);
    let rank = |robot: &Robot| (robot.index == keeper, robot.position.distance(place));
    let nearest = moment.now.team(team).min_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    nearest.map(|robot| robot.index)
}
