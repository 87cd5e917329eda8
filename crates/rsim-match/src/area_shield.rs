//! Shield of VSSS policies: it keeps robots out of goal areas in which the referee allows no more of their team.
//!
//! A policy that has learned without a referee sends several robots into the area of the opponents, where a goal
//! does not count then. A shield changes such actions alone (Alshiekh et al., "Safe Reinforcement Learning via
//! Shielding", 2018).

use rsim_core::{Drive, SimConfig};
use rsim_referee::Vector;
use rsim_referee::config::RefereeConfig;
use rsim_referee::sight::{Layout, Robot, Sight};

use crate::error::MatchError;
use crate::knowledge::layout;

/// Distance that robots keep from an area, m.
const MARGIN: f32 = 0.05;
/// Time in which they can brake, s: they must not be in the area after it.
const HORIZON: f32 = 0.12;
/// Distance of the ball from an area, along the field, from which on the shield acts, m.
const NEAR: f32 = 0.25;
/// Advantage of a robot that is inside already over one that is as near, m: they do not take turns.
const INSIDE_ADVANTAGE: f32 = 0.05;
/// Distance of the keeper's place from its goal line, m.
const KEEPER_DISTANCE: f32 = 0.08;
/// Share of full speed at which robots leave an area, and of the turn in which they stand before it.
const LEAVING: f32 = 0.8;
const TURNING: f32 = 0.5;
/// Wheel speed per sine of the heading error of a robot that leaves, and its limit.
const TURN_GAIN: f32 = 1.5;
const MAX_TURN: f32 = 0.6;

/// Shield of the robots of both teams of a configuration.
#[derive(Debug, Clone)]
pub struct AreaShield {
    areas: Vec<Area>,
    half_length: f32,
    layout: Layout,
    /// Greatest speed of each robot, m/s.
    top_speeds: Vec<f32>,
}

/// An area in front of each goal.
#[derive(Debug, Clone, Copy)]
struct Area {
    /// Distance of its front from the center of the field along x.
    front: f32,
    half_width: f32,
    /// Robots that the attackers and the defenders may have in it.
    allowed: [usize; 2],
}

impl AreaShield {
    /// The shield for the robots and the field of a configuration.
    ///
    /// # Errors
    /// A robot without a differential drive, or more robots than a referee can see.
    pub fn new(config: &SimConfig) -> Result<Self, MatchError> {
        let is_differential =
            |robot: &&rsim_core::RobotModel| matches!(robot.drive, Drive::Differential(_));
        if let Some(robot) = config.robots().find(|robot| !is_differential(robot)) {
            return Err(MatchError::argument(
                "config",
                "robots with a differential drive",
                &robot.name,
            ));
        }
        let field = &config.field;
        let has_two = field.inner_area_depth > 0.0;
        let rules = rules_of(has_two);
        let area = |depth: f32, width: f32, too_many: [f32; 2]| Area {
            front: field.half_length() - depth,
            half_width: width / 2.0,
            allowed: too_many.map(allowed),
        };
        let (depth, width) = (field.goal_area_depth, field.goal_area_width);
        let one = [rules.area_robots; 2];
        let areas = if has_two {
            let large = [rules.large_area_attackers, rules.large_area_defenders];
            let inner = area(field.inner_area_depth, field.inner_area_width, one);
            vec![area(depth, width, large), inner]
        } else {
            vec![area(depth, width, one)]
        };
        Ok(Self {
            areas,
            half_length: field.half_length(),
            layout: layout(config)?,
            top_speeds: config.robots().map(rsim_core::RobotModel::top_speed).collect(),
        })
    }

    /// Changes the action of a robot, the speeds of its wheels from -1 to 1, where it would be one too many in an
    /// area. `row` is the state that the robot knows.
    pub fn apply(&self, row: &[f32], robot: usize, action: &mut [f32]) {
        let Ok(sight) = self.layout.sight(row) else { return };
        let Some(robot) = sight.robot(robot) else { return };
        let ball = sight.ball().position;
        for area in &self.areas {
            let defenders = [robot.team.opponent(), robot.team];
            for (allowed, defender) in area.allowed.into_iter().zip(defenders) {
                let side = defender.own_side();
                let place = if defender == robot.team {
                    Vector::new(side * (self.half_length - KEEPER_DISTANCE), 0.0)
                } else {
                    ball
                };
                if side * ball.x > area.front - NEAR
                    && area.rank(&sight, &robot, side, place) >= allowed
                {
                    keep_out(&robot, *area, side, self.top_speeds[robot.index], action);
                }
            }
        }
    }
}

/// Stops a robot that is about to enter an area, and has one that is inside leave.
fn keep_out(robot: &Robot, area: Area, side: f32, top_speed: f32, action: &mut [f32]) {
    let [left, right] = action else { return };
    if area.contains(robot.position, side, MARGIN) {
        let outside = area.way_out(robot.position, side);
        let along = robot.heading.dot(outside);
        let aside = robot.heading.x * outside.y - robot.heading.y * outside.x;
        let way = if along < 0.0 { -1.0 } else { 1.0 };
        let turn = (TURN_GAIN * aside * way).clamp(-MAX_TURN, MAX_TURN);
        let forward = LEAVING * along;
        (*left, *right) = ((forward - turn).clamp(-1.0, 1.0), (forward + turn).clamp(-1.0, 1.0));
        return;
    }
    let commanded = robot.heading * (f32::midpoint(*left, *right) * top_speed);
    let enters = [commanded, robot.velocity]
        .into_iter()
        .any(|velocity| area.contains(robot.position + velocity * HORIZON, side, MARGIN));
    if enters {
        let turn = TURNING * (*right - *left) / 2.0;
        (*left, *right) = (-turn, turn);
    }
}

impl Area {
    /// Number of teammates that rather than the robot may be in the area at x of `side`: those nearer to a place,
    /// which is the ball for attackers and the keeper's place for defenders.
    fn rank(&self, sight: &Sight, robot: &Robot, side: f32, place: Vector) -> usize {
        let claim = |robot: &Robot| {
            let is_inside = self.contains(robot.position, side, 0.0);
            robot.position.distance(place) - if is_inside { INSIDE_ADVANTAGE } else { 0.0 }
        };
        let own = claim(robot);
        let teammates = sight.team(robot.team).filter(|other| other.index != robot.index);
        let comes_first = |other: &Robot| {
            claim(other).total_cmp(&own).then(other.index.cmp(&robot.index)).is_lt()
        };
        teammates.filter(comes_first).count()
    }

    /// Whether a place is in the area at x of `side`, or nearer to it than a margin.
    fn contains(&self, place: Vector, side: f32, margin: f32) -> bool {
        side * place.x > self.front - margin && place.y.abs() < self.half_width + margin
    }

    /// Direction of the shortest way out of the area.
    fn way_out(&self, place: Vector, side: f32) -> Vector {
        if side * place.x - self.front <= self.half_width - place.y.abs() {
            Vector::new(-side, 0.0)
        } else {
            Vector::new(0.0, 1.0_f32.copysign(place.y))
        }
    }
}

/// Rules of the league on a field with two areas, or with one.
fn rules_of(has_two: bool) -> RefereeConfig {
    let preset = if has_two { "vsss_5v5" } else { "vsss_3v3" };
    RefereeConfig::preset(preset).expect("a preset's name")
}

/// Robots that are allowed where some number of them is too many; 0 is any number.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few robots
fn allowed(too_many: f32) -> usize {
    if too_many > 0.0 { too_many as usize - 1 } else { usize::MAX }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // what the shield leaves as it is has the same bits
#[allow(clippy::cast_precision_loss)] // a few robots
mod tests {
    use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};

    use super::*;

    const INSIDE: f32 = 0.68;
    const FULL: [f32; 2] = [1.0, 1.0];

    /// Three against three, far from each other, blue's robots facing +x; the ball is in yellow's area.
    fn scene() -> (AreaShield, Vec<f32>) {
        let config = SimConfig::vss(3, 3);
        let mut row = vec![0.0; config.row_size()];
        (row[0], row[1]) = (INSIDE, 0.05);
        for robot in 0..6 {
            put(&mut row, robot, [-0.3, 0.2 * robot as f32 - 0.5], [1.0, 0.0]);
        }
        (AreaShield::new(&config).expect("differential"), row)
    }

    fn put(row: &mut [f32], robot: usize, [x, y]: [f32; 2], [cos, sin]: [f32; 2]) {
        let at = BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len();
        row[at..at + 4].copy_from_slice(&[x, y, cos, sin]);
    }

    fn applied(shield: &AreaShield, row: &[f32], robot: usize, action: [f32; 2]) -> [f32; 2] {
        let mut changed = action;
        shield.apply(row, robot, &mut changed);
        changed
    }

    #[test]
    fn the_robot_nearest_to_the_ball_alone_may_enter() {
        let (shield, mut row) = scene();
        put(&mut row, 0, [0.55, 0.05], [1.0, 0.0]);
        put(&mut row, 1, [0.53, -0.2], [1.0, 0.0]);
        assert_eq!(applied(&shield, &row, 0, FULL), FULL);
        assert_eq!(applied(&shield, &row, 1, FULL), [0.0, 0.0]);
        let turned = applied(&shield, &row, 1, [0.2, 1.0]);
        assert!(turned[0] < 0.0 && turned[0] + turned[1] == 0.0, "it turns where it stands");
        assert_eq!(applied(&shield, &row, 1, [-1.0, -1.0]), [-1.0, -1.0], "it may drive away");
    }

    #[test]
    fn a_robot_that_is_one_too_many_leaves_by_the_shortest_way() {
        let (shield, mut row) = scene();
        put(&mut row, 0, [0.66, 0.05], [1.0, 0.0]);
        put(&mut row, 1, [0.63, 0.15], [1.0, 0.0]);
        let out = applied(&shield, &row, 1, FULL);
        assert!(out[0] < -0.5 && out[1] < -0.5, "backwards: {out:?}");
        put(&mut row, 1, [0.68, 0.33], [0.0, 1.0]);
        let out = applied(&shield, &row, 1, [-1.0, -1.0]);
        assert!(out[0] > 0.5 && out[1] > 0.5, "over the side: {out:?}");
        assert_eq!(applied(&shield, &row, 0, FULL), FULL);
    }

    #[test]
    fn nothing_changes_far_from_the_ball_alone_or_for_absent_teammates() {
        let (shield, mut row) = scene();
        put(&mut row, 0, [0.66, 0.05], [1.0, 0.0]);
        put(&mut row, 1, [0.53, -0.2], [1.0, 0.0]);
        row[0] = 0.2;
        assert_eq!(applied(&shield, &row, 1, FULL), FULL);
        row[0] = INSIDE;
        assert_ne!(applied(&shield, &row, 1, FULL), FULL);
        row[BALL_COLUMNS.len() + ROBOT_COLUMNS.len() - 1] = 1.0;
        assert_eq!(applied(&shield, &row, 1, FULL), FULL);
    }

    #[test]
    fn teams_and_sides_are_alike() {
        let (shield, mut row) = scene();
        for own_side in [1.0, -1.0] {
            let offset = if own_side < 0.0 { 0 } else { 3 };
            for end in [1.0, -1.0] {
                let (mut turned, h) = (row.clone(), end);
                turned[0] = end * INSIDE;
                put(&mut turned, offset, [end * 0.68, 0.0], [h, 0.0]);
                put(&mut turned, offset + 1, [end * 0.53, 0.2], [h, 0.0]);
                assert_eq!(applied(&shield, &turned, offset, FULL), FULL);
                assert_eq!(applied(&shield, &turned, offset + 1, FULL), [0.0, 0.0]);
            }
        }
        row[0] = 0.0;
        assert_eq!(applied(&shield, &row, 0, FULL), FULL);
    }

    #[test]
    fn on_the_large_field_three_attackers_may_be_in_the_large_area_and_one_in_the_smaller() {
        let config = SimConfig { field: rsim_core::Field::VSS_5V5, ..SimConfig::vss(5, 5) };
        let shield = AreaShield::new(&config).expect("differential");
        let mut row = vec![0.0; config.row_size()];
        (row[0], row[1]) = (1.05, 0.0);
        for (robot, place) in
            [[1.0, 0.0], [0.8, 0.3], [0.8, -0.3], [0.7, 0.0], [-1.0, 0.0]].into_iter().enumerate()
        {
            put(&mut row, robot, place, [1.0, 0.0]);
        }
        assert_eq!(applied(&shield, &row, 0, FULL), FULL);
        assert_eq!(applied(&shield, &row, 1, [0.1, 0.1]), [0.1, 0.1]);
        assert_eq!(applied(&shield, &row, 3, FULL), [0.0, 0.0], "a fourth one");
        put(&mut row, 1, [0.92, 0.1], [1.0, 0.0]);
        assert_ne!(applied(&shield, &row, 1, FULL), FULL, "a second one");
    }

    #[test]
    fn robots_with_other_drives_have_no_shield() {
        let error = AreaShield::new(&SimConfig::ssl(1, 1)).expect_err("omnidirectional");
        assert!(error.to_string().contains("differential"), "{error}");
    }
}
