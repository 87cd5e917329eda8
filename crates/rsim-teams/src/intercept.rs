//! Places and times at which robots can reach the ball.

use rsim_referee::Vector;

use crate::config::MAX_ROBOTS;
use crate::pitch::Pitch;
use crate::rolling::{BallPath, INTERVAL};
use crate::view::{Player, Players};

/// Time that a robot needs beside driving, s.
const DELAY: f32 = 0.2;
/// Distance beyond the lines at which a ball is out of reach, m.
const OUT: f32 = 0.05;

/// Speed and acceleration of robots.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pace {
    /// m/s.
    pub(crate) speed: f32,
    /// m/s².
    pub(crate) acceleration: f32,
}

/// Place where a robot meets the ball.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Meeting {
    /// Time until then, s.
    pub(crate) time: f32,
    /// Place of the ball then, m.
    pub(crate) place: Vector,
}

/// Time in which a robot reaches a place, without braking there, s.
pub(crate) fn travel_time(robot: &Player, to: Vector, distance: f32, pace: Pace) -> f32 {
    let way = to - robot.position;
    let length = way.length();
    let left = (length - distance).max(0.0);
    if left <= 0.0 {
        return 0.0;
    }
    let ahead = (robot.velocity.dot(way) / length).min(pace.speed);
    let (a, v) = (pace.acceleration, pace.speed);
    let speeding_up = (v * v - ahead * ahead) / (2.0 * a);
    if left < speeding_up || ahead < 0.0 && left < v * v / (2.0 * a) {
        ((ahead * ahead + 2.0 * a * left).sqrt() - ahead) / a
    } else {
        (v - ahead) / a + (left - speeding_up) / v
    }
}

/// Place where a robot that reaches as far as `reach` meets the ball first.
pub(crate) fn meeting(
    robot: &Player,
    path: &BallPath,
    pitch: &Pitch,
    pace: Pace,
    reach: f32,
) -> Meeting {
    if path.speed < 0.1 {
        let time = travel_time(robot, path.places[0], reach, pace) + DELAY;
        return Meeting { time, place: path.places[0] };
    }
    for (nth, place) in path.places.iter().enumerate() {
        let time = nth as f32 * INTERVAL;
        if time < path.flight {
            continue;
        }
        if nth > 0 && !pitch.lines.is_inside(*place, OUT) {
            // It leaves the field first: this robot can only go where it leaves.
            let late = travel_time(robot, *place, reach, pace) + DELAY;
            return Meeting { time: late.max(time) + 1.0, place: path.places[nth - 1] };
        }
        let needed = travel_time(robot, *place, reach, pace) + DELAY;
        if needed <= time {
            return Meeting { time: needed.max(time - INTERVAL), place: *place };
        }
    }
    let last = pitch.inside(path.rest, 0.0);
    Meeting { time: travel_time(robot, last, reach, pace) + DELAY, place: last }
}

/// Meetings of all robots of a team, by the index of the robot.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Meetings([Option<Meeting>; MAX_ROBOTS]);

impl Meetings {
    pub(crate) fn new(
        players: &Players,
        path: &BallPath,
        pitch: &Pitch,
        pace: Pace,
        reach: f32,
    ) -> Self {
        let mut all = Self::default();
        for player in players.iter() {
            all.0[player.index] = Some(meeting(player, path, pitch, pace, reach));
        }
        all
    }

    /// The meeting of a robot; `None` if it is absent.
    pub(crate) fn of(&self, index: usize) -> Option<Meeting> {
        self.0[index]
    }

    /// The robot that is first, of those that may.
    pub(crate) fn first(&self, may: impl Fn(usize) -> bool) -> Option<(usize, Meeting)> {
        let all = self.0.iter().enumerate().filter(|(index, _)| may(*index));
        all.filter_map(|(index, meeting)| meeting.map(|meeting| (index, meeting)))
            .min_by(|a, b| a.1.time.total_cmp(&b.1.time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{config, pitch};
    use crate::view::Ball;

    const PACE: Pace = Pace { speed: 3.0, acceleration: 4.0 };

    fn at(x: f32, y: f32) -> Player {
        Player { position: Vector::new(x, y), ..Player::default() }
    }

    #[test]
    fn times_are_those_of_a_robot_that_speeds_up() {
        let mut robot = at(0.0, 0.0);
        let near = travel_time(&robot, Vector::new(0.5, 0.0), 0.0, PACE);
        assert!((near - 0.5).abs() < 1e-5, "s = a t² / 2: {near}");
        let far = travel_time(&robot, Vector::new(4.125, 0.0), 0.0, PACE);
        assert!((far - 1.75).abs() < 1e-5, "{far}");
        robot.velocity = Vector::new(-2.0, 0.0);
        assert!(travel_time(&robot, Vector::new(0.5, 0.0), 0.0, PACE) > 1.0);
    }

    #[test]
    fn a_robot_beside_the_path_meets_the_ball_ahead() {
        let ball = Ball { velocity: Vector::new(2.0, 0.0), ..Ball::default() };
        let path = BallPath::new(&ball, 2.0, &config().ball);
        let met = meeting(&at(1.5, 0.6), &path, &pitch(), PACE, 0.09);
        assert!(met.place.x > 0.5 && met.place.x < 1.8, "{met:?}");
        let late = meeting(&at(-2.0, 0.0), &path, &pitch(), PACE, 0.09);
        assert!(late.time > met.time + 0.5, "{late:?}");
    }

    #[test]
    fn a_ball_that_leaves_the_field_is_met_late_at_its_line() {
        let ball = Ball {
            position: Vector::new(0.0, 2.5),
            velocity: Vector::new(0.0, 3.0),
            ..Ball::default()
        };
        let path = BallPath::new(&ball, 3.0, &config().ball);
        let met = meeting(&at(-3.0, -2.0), &path, &pitch(), PACE, 0.09);
        assert!(met.time > 2.0 && met.place.y <= 3.05, "{met:?}");
    }
}
