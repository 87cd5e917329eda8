//! Shield of SSL policies in the attack challenges: it brakes a robot before what ends an episode.
//!
//! A robot fails there by a touch of an opponent, in the opponents' goal area, outside the field, and in its own half.
//! A policy of a small network sees such limits as slopes of the value of a place, and cuts corners. The shield takes
//! from a commanded velocity the part toward each of them from which the robot could not stop in front of it
//! (velocity damping: Faverjon and Tournassoud, "A Local Based Approach for Path Planning of Manipulators with a High
//! Number of Degrees of Freedom", 1987).

use rsim_core::{Drive, SimConfig};
use rsim_referee::sight::{Layout, Robot, Sight};
use rsim_referee::{Team, Vector};

use crate::error::MatchError;
use crate::knowledge::layout;

/// Distance that robots keep from limits, m: the control of a moving robot is not exact.
const MARGIN: f32 = 0.02;
/// Distance that they may drive into their own half, m: the tasks allow .2 m.
const OWN_HALF: f32 = 0.15;
/// Share of the robot's deceleration that stops it in time.
const BRAKING: f32 = 0.7;
/// Time until a new velocity acts, s: a control step and the robot's response.
const LAG: f32 = 0.05;
/// Speed at which a robot that is too near leaves, per distance that it lacks, 1/s, and its limit, m/s.
const LEAVING: f32 = 5.0;
const MAX_LEAVING: f32 = 0.5;
/// Passes over all limits: between two of them a velocity that keeps one may break the other.
const PASSES: usize = 4;
/// Distance below which a place has no direction, m.
const TINY: f32 = 1e-6;

/// Shield of the robots of both teams of a configuration.
#[derive(Debug, Clone)]
pub struct AttackShield {
    layout: Layout,
    half_length: f32,
    half_width: f32,
    area_front: f32,
    area_half_width: f32,
    robots: Vec<Body>,
}

/// Size, speed and deceleration of a robot.
#[derive(Debug, Clone, Copy)]
struct Body {
    radius: f32,
    /// Velocity of an action of 1, m/s.
    top_speed: f32,
    /// Deceleration that it may count on, m/s².
    braking: f32,
}

/// A limit to the way of a robot: where it is from there, and how far.
#[derive(Debug, Clone, Copy)]
struct Limit {
    direction: Vector,
    gap: f32,
}

impl Limit {
    /// Greatest speed toward the limit of a robot with a velocity and a deceleration.
    fn speed(&self, velocity: Vector, braking: f32) -> f32 {
        let gap = self.gap - velocity.dot(self.direction).max(0.0) * LAG;
        if gap > 0.0 { (2.0 * braking * gap).sqrt() } else { (gap * LEAVING).max(-MAX_LEAVING) }
    }
}

impl AttackShield {
    /// The shield for the robots and the field of a configuration.
    ///
    /// # Errors
    /// A robot without an omnidirectional drive, or more robots than a referee can see.
    pub fn new(config: &SimConfig) -> Result<Self, MatchError> {
        let body = |robot: &rsim_core::RobotModel| {
            let Drive::Omni(drive) = &robot.drive else {
                return Err(MatchError::argument(
                    "config",
                    "robots with an omnidirectional drive",
                    &robot.name,
                ));
            };
            Ok(Body {
                radius: robot.bounding_radius(),
                top_speed: robot.top_speed(),
                braking: BRAKING * drive.max_deceleration.min(drive.max_traction),
            })
        };
        let field = &config.field;
        Ok(Self {
            robots: config.robots().map(body).collect::<Result<_, _>>()?,
            layout: layout(config)?,
            half_length: field.half_length(),
            half_width: field.half_width(),
            area_front: field.half_length() - field.goal_area_depth,
            area_half_width: field.goal_area_width / 2.0,
        })
    }

    /// Changes the action of a robot where its velocity, the first two numbers, would break a limit; they are
    /// shares of full speed toward the attacked goal and to the left. `row` is the state that the robot knows.
    pub fn apply(&self, row: &[f32], robot: usize, action: &mut [f32]) {
        let Ok(sight) = self.layout.sight(row) else { return };
        let Some(robot) = sight.robot(robot) else { return };
        let [ahead, left, ..] = action else { return };
        let body = self.robots[robot.index];
        // Actions and limits are those of a team that attacks +x.
        let sign = forward(robot.team);
        let now = robot.velocity * sign;
        let limits = self.limits(&sight, &robot);
        let speeds: Vec<f32> = limits.iter().map(|limit| limit.speed(now, body.braking)).collect();
        let commanded = Vector::new(*ahead, *left) * body.top_speed;
        let mut velocity = commanded;
        for _ in 0..PASSES {
            for (limit, allowed) in limits.iter().zip(&speeds) {
                let excess = velocity.dot(limit.direction) - allowed;
                if excess > 0.0 {
                    velocity = velocity - limit.direction * excess;
                }
            }
        }
        velocity = braked_first(velocity, now, &limits, &speeds);
        if velocity != commanded {
            *ahead = (velocity.x / body.top_speed).clamp(-1.0, 1.0);
            *left = (velocity.y / body.top_speed).clamp(-1.0, 1.0);
        }
    }

    /// Limits to the way of a robot, turned so that its team attacks +x.
    fn limits(&self, sight: &Sight, robot: &Robot) -> Vec<Limit> {
        let sign = forward(robot.team);
        let place = robot.position * sign;
        let radius = self.robots[robot.index].radius;
        let line = |x: f32, y: f32, distance: f32| {
            let direction = Vector::new(x, y);
            Limit { direction, gap: distance - place.dot(direction) - MARGIN }
        };
        let mut limits = vec![
            line(1.0, 0.0, self.half_length),
            line(0.0, 1.0, self.half_width),
            line(0.0, -1.0, self.half_width),
            line(-1.0, 0.0, OWN_HALF),
            self.area_limit(place),
        ];
        limits.extend(sight.team(robot.team.opponent()).map(|other| {
            let offset = other.position * sign - place;
            let apart = radius + self.robots[other.index].radius;
            Limit { direction: direction(offset), gap: offset.length() - apart - MARGIN }
        }));
        limits
    }

    /// Limit of the goal area at +x; its sides go on behind the goal line.
    fn area_limit(&self, place: Vector) -> Limit {
        let half_width = self.area_half_width;
        let nearest =
            Vector::new(place.x.max(self.area_front), place.y.clamp(-half_width, half_width));
        let offset = nearest - place;
        if offset.length() > TINY {
            return Limit { direction: direction(offset), gap: offset.length() - MARGIN };
        }
        let to_front = place.x - self.area_front;
        let to_side = half_width - place.y.abs();
        if to_front <= to_side {
            Limit { direction: Vector::new(1.0, 0.0), gap: -to_front - MARGIN }
        } else {
            let inward = Vector::new(0.0, -1.0_f32.copysign(place.y));
            Limit { direction: inward, gap: -to_side - MARGIN }
        }
    }
}

/// A velocity for a robot that may be too fast for a limit: it turns aside no faster than it brakes, as its wheels
/// have the grip for one of them at once.
fn braked_first(velocity: Vector, now: Vector, limits: &[Limit], speeds: &[f32]) -> Vector {
    let excess =
        |(limit, allowed): (&Limit, &f32)| (now.dot(limit.direction) - allowed, limit.direction);
    let worst = limits.iter().zip(speeds).map(excess).max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((excess, direction)) = worst.filter(|(excess, _)| *excess > 0.0) else {
        return velocity;
    };
    let across = Vector::new(-direction.y, direction.x);
    let change = (velocity - now).dot(across);
    velocity + across * (change.clamp(-excess, excess) - change)
}

/// Sign of the direction that a team attacks.
fn forward(team: Team) -> f32 {
    -team.own_side()
}

/// Direction of an offset; +x for one of length 0.
fn direction(offset: Vector) -> Vector {
    let length = offset.length();
    if length > TINY { offset * (1.0 / length) } else { Vector::new(1.0, 0.0) }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // what the shield leaves as it is has the same bits
mod tests {
    use rsim_core::Field;
    use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};

    use super::*;

    /// One attacker of blue in the middle of the half, and an opponent of yellow 1 m to its left.
    fn scene() -> (AttackShield, Vec<f32>) {
        let config = SimConfig { field: Field::SSL_CHALLENGE, ..SimConfig::ssl(1, 1) };
        let mut row = vec![0.0; config.row_size()];
        put(&mut row, 0, [1.2, 0.0], [0.0, 0.0]);
        put(&mut row, 1, [1.2, 1.0], [0.0, 0.0]);
        (AttackShield::new(&config).expect("omnidirectional"), row)
    }

    fn put(row: &mut [f32], robot: usize, [x, y]: [f32; 2], [v_x, v_y]: [f32; 2]) {
        let at = BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len();
        row[at..at + 6].copy_from_slice(&[x, y, 1.0, 0.0, v_x, v_y]);
    }

    fn applied(shield: &AttackShield, row: &[f32], robot: usize, velocity: [f32; 2]) -> [f32; 5] {
        let mut action = [velocity[0], velocity[1], 0.3, 0.5, -0.5];
        shield.apply(row, robot, &mut action);
        assert_eq!(action[2..], [0.3, 0.5, -0.5], "only the velocity changes");
        action
    }

    #[test]
    fn slow_robots_far_from_limits_do_as_commanded() {
        let (shield, row) = scene();
        assert_eq!(applied(&shield, &row, 0, [0.1, 0.1])[..2], [0.1, 0.1]);
        assert_eq!(applied(&shield, &row, 0, [0.0, -0.5])[..2], [0.0, -0.5]);
    }

    #[test]
    fn a_robot_may_pass_an_opponent_but_not_drive_at_it_faster_than_it_can_brake() {
        let (shield, mut row) = scene();
        put(&mut row, 0, [1.2, 0.7], [0.0, 0.0]);
        let [x, y, ..] = applied(&shield, &row, 0, [0.2, 1.0]);
        let gap: f32 = 0.3 - 0.18 - MARGIN;
        let braking = BRAKING * 5.9;
        assert_eq!(x, 0.2, "the way past it is free");
        assert!((y * 3.7 - (2.0 * braking * gap).sqrt()).abs() < 1e-4, "{y}");
        put(&mut row, 0, [1.2, 0.7], [0.0, 2.0]);
        assert!(applied(&shield, &row, 0, [0.2, 1.0])[1] < y, "a moving one is nearer by its lag");
        put(&mut row, 0, [1.2, 0.815], [0.0, 0.0]);
        assert!(applied(&shield, &row, 0, [0.0, 0.0])[1] < 0.0, "one that is too near leaves");
    }

    #[test]
    fn a_robot_that_is_too_fast_brakes_before_it_turns_aside() {
        let (shield, mut row) = scene();
        // 0.2 m before the opponent at 1.3 m/s, where it may have 1.07 m/s.
        put(&mut row, 0, [1.2, 0.6], [0.0, 1.3]);
        let [x, ..] = applied(&shield, &row, 0, [0.5, 1.0]);
        assert!(0.0 < x && x * 3.7 < 0.3, "{x}: as much as it is too fast");
        put(&mut row, 0, [1.2, 0.6], [0.0, 0.8]);
        assert_eq!(applied(&shield, &row, 0, [0.5, 1.0])[0], 0.5, "a slower one turns");
    }

    #[test]
    fn robots_that_are_absent_stop_no_one() {
        let (shield, mut row) = scene();
        put(&mut row, 0, [1.2, 0.7], [0.0, 0.0]);
        *row.last_mut().expect("columns") = 1.0;
        assert_eq!(applied(&shield, &row, 0, [0.0, 0.5])[..2], [0.0, 0.5]);
    }

    #[test]
    fn lines_the_goal_area_and_the_own_half_stop_robots_of_both_teams() {
        for ([x, y], full) in [
            ([2.95, 1.5], [1.0, 0.0]),   // goal line
            ([1.0, -1.95], [0.0, -1.0]), // touch line
            ([-0.12, 0.0], [-1.0, 0.0]), // own half
            ([2.15, 0.3], [1.0, 0.0]),   // front of the goal area
            ([2.5, 1.05], [0.0, -1.0]),  // its side
        ] {
            let (shield, mut row) = scene();
            put(&mut row, 0, [x, y], [0.0, 0.0]);
            put(&mut row, 1, [1.2, 0.5], [0.0, 0.0]);
            let blue = applied(&shield, &row, 0, full);
            let speed = blue[0].hypot(blue[1]);
            assert!(speed < 0.25, "{blue:?} at {x}, {y}");
            put(&mut row, 0, [-1.2, -0.5], [0.0, 0.0]);
            put(&mut row, 1, [-x, -y], [0.0, 0.0]);
            let yellow = applied(&shield, &row, 1, full);
            assert!((yellow[0] - blue[0]).abs() < 1e-6 && (yellow[1] - blue[1]).abs() < 1e-6);
        }
    }

    #[test]
    fn a_robot_in_the_goal_area_leaves_by_the_shortest_way() {
        let (shield, mut row) = scene();
        put(&mut row, 0, [2.3, 0.2], [0.0, 0.0]);
        assert!(applied(&shield, &row, 0, [0.0, 0.0])[0] < 0.0, "over the front");
        put(&mut row, 0, [2.8, 0.9], [0.0, 0.0]);
        assert!(applied(&shield, &row, 0, [0.0, 0.0])[1] > 0.0, "over the side");
    }

    #[test]
    fn robots_with_other_drives_have_no_shield() {
        let error = AttackShield::new(&SimConfig::vss(1, 1)).expect_err("differential");
        assert!(error.to_string().contains("omnidirectional"), "{error}");
    }
}
