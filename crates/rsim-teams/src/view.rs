//! The match as a team sees it: its own goal is at -x.

use std::ops::{Deref, DerefMut};

use rsim_referee::sight::{Robot, Sight};
use rsim_referee::{Team, Vector};

use crate::config::MAX_ROBOTS;

/// A robot.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Player {
    /// Index in its team.
    pub(crate) index: usize,
    /// m.
    pub(crate) position: Vector,
    /// Direction of the front, a unit vector.
    pub(crate) heading: Vector,
    /// m/s.
    pub(crate) velocity: Vector,
    /// rad/s.
    pub(crate) angular_velocity: f32,
    /// Whether the ball is in its mouth.
    pub(crate) has_ball: bool,
}

/// The ball.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Ball {
    /// m.
    pub(crate) position: Vector,
    /// Velocity over the floor, m/s.
    pub(crate) velocity: Vector,
    /// Height of the lowest point, m.
    pub(crate) height: f32,
    /// m/s.
    pub(crate) vertical_velocity: f32,
}

/// The robots of a team that are on the field.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Players {
    all: [Player; MAX_ROBOTS],
    count: usize,
}

impl Players {
    pub(crate) fn push(&mut self, player: Player) {
        self.all[self.count] = player;
        self.count += 1;
    }

    /// The robot with an index in its team.
    pub(crate) fn with_index(&self, index: usize) -> Option<&Player> {
        self.iter().find(|player| player.index == index)
    }
}

impl Deref for Players {
    type Target = [Player];

    fn deref(&self) -> &[Player] {
        &self.all[..self.count]
    }
}

impl DerefMut for Players {
    fn deref_mut(&mut self) -> &mut [Player] {
        &mut self.all[..self.count]
    }
}

/// The match as a team sees it.
#[derive(Debug, Clone, Default)]
pub(crate) struct View {
    /// The ball.
    pub(crate) ball: Ball,
    /// The own robots.
    pub(crate) own: Players,
    /// The opponents.
    pub(crate) others: Players,
}

impl View {
    /// The match in a state row, seen by a team. `first` has the index of each team's first robot.
    pub(crate) fn new(sight: &Sight, team: Team, first: [usize; 2]) -> Self {
        let turn = -team.own_side();
        let seen = sight.ball();
        let ball = Ball {
            position: seen.position * turn,
            velocity: seen.velocity * turn,
            height: seen.height,
            vertical_velocity: seen.vertical_velocity,
        };
        let mut view = Self { ball, ..Self::default() };
        for robot in sight.robots() {
            let player = player(&robot, turn, first[robot.team.index()]);
            if robot.team == team {
                view.own.push(player);
            } else {
                view.others.push(player);
            }
        }
        view
    }
}

fn player(robot: &Robot, turn: f32, first: usize) -> Player {
    Player {
        index: robot.index - first,
        position: robot.position * turn,
        heading: robot.heading * turn,
        velocity: robot.velocity * turn,
        angular_velocity: robot.angular_velocity,
        has_ball: robot.has_ball,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Scene;

    #[test]
    fn both_teams_see_their_own_goal_on_the_same_side() {
        let mut scene = Scene::new(1, 2);
        scene.ball([1.0, 2.0], [0.5, 0.0]);
        scene.robot(0, [-3.0, 1.0]);
        scene.robot(2, [2.0, -1.0]);
        scene.take_out(1);
        let blue = scene.view(Team::Blue);
        assert_eq!(blue.ball.position, Vector::new(1.0, 2.0));
        assert_eq!(blue.own[0].position, Vector::new(-3.0, 1.0));
        assert_eq!((blue.others.len(), blue.others[0].index), (1, 1));
        let yellow = scene.view(Team::Yellow);
        assert_eq!(yellow.ball.position, Vector::new(-1.0, -2.0));
        assert_eq!(yellow.ball.velocity, Vector::new(-0.5, 0.0));
        assert_eq!(yellow.own[0].position, Vector::new(-2.0, 1.0));
        assert_eq!(yellow.others[0].heading, Vector::new(-1.0, 0.0));
        assert!(yellow.own.with_index(0).is_none() && yellow.own.with_index(1).is_some());
    }
}
