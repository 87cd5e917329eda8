//! State rows as views of robots: itself, teammates, opponents and the ball, always attacking +x.

use crate::columns::{
    ABSENT_COLUMN, BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS, ball_column, is_absent,
};
use crate::math::Vector;

/// The observers of a match, with the robots in the slots of each.
#[derive(Debug, Clone, PartialEq)]
pub struct Viewpoint {
    observers: Vec<Observer>,
    /// Signs of the ball's and a robot's columns, unrotated and rotated by 180 degrees.
    ball_signs: [[f32; BALL_COLUMNS.len()]; 2],
    robot_signs: [[f32; ROBOT_COLUMNS.len()]; 2],
    /// Code of each crossing on the rotated field.
    rotated_crossings: [f32; CROSSINGS.len()],
    crossed: usize,
}

/// A robot that observes a match.
#[derive(Debug, Clone, PartialEq)]
pub struct Observer {
    /// Whether the field is rotated by 180 degrees in its view.
    pub rotated: bool,
    /// Indices of robots in the row: itself, teammates, opponents; `None` for an empty slot.
    pub slots: Vec<Option<usize>>,
}

/// Columns of a robot that is not there.
const ABSENT: [f32; ROBOT_COLUMNS.len()] = {
    let mut columns = [0.0; ROBOT_COLUMNS.len()];
    columns[ABSENT_COLUMN] = 1.0;
    columns
};

impl Viewpoint {
    /// The views of these observers, which must have equal numbers of slots.
    pub fn new(observers: Vec<Observer>) -> Self {
        debug_assert!(observers.windows(2).all(|pair| pair[0].slots.len() == pair[1].slots.len()));
        Self {
            observers,
            ball_signs: [[1.0; BALL_COLUMNS.len()], BALL_COLUMNS.map(rotation_sign)],
            robot_signs: [[1.0; ROBOT_COLUMNS.len()], ROBOT_COLUMNS.map(rotation_sign)],
            rotated_crossings: CROSSINGS.map(rotated_crossing),
            crossed: ball_column("crossed"),
        }
    }

    /// The observers, in the order of views.
    pub fn observers(&self) -> &[Observer] {
        &self.observers
    }

    /// Number of observers.
    pub fn n_observers(&self) -> usize {
        self.observers.len()
    }

    /// Number of slots of each observer.
    pub fn slots(&self) -> usize {
        self.observers.first().map_or(0, |observer| observer.slots.len())
    }

    /// Writes the views of all observers: of the first row, or of the second for those on the rotated field,
    /// which may know another state. Into `ball` the ball's columns for each observer, into
    /// `robots` a robot's columns for each slot of each observer. The columns of an absent robot and of an
    /// empty slot are 0, except for `absent`, which is 1.
    pub fn fill(&self, rows: [&[f32]; 2], ball: &mut [f32], robots: &mut [f32]) {
        let balls = ball.chunks_exact_mut(BALL_COLUMNS.len());
        let views = robots.chunks_exact_mut(self.slots().max(1) * ROBOT_COLUMNS.len());
        for (observer, (ball, robots)) in self.observers.iter().zip(balls.zip(views)) {
            let side = usize::from(observer.rotated);
            let (the_ball, the_robots) = rows[side].split_at(BALL_COLUMNS.len());
            write(&self.ball_signs[side], the_ball, ball);
            if observer.rotated {
                let crossed = ball[self.crossed];
                let mut codes = (0_u8..).map(f32::from).zip(self.rotated_crossings);
                if let Some((_, other)) = codes.find(|(code, _)| (code - crossed).abs() < 0.5) {
                    ball[self.crossed] = other;
                }
            }
            let signs = &self.robot_signs[side];
            for (slot, robot) in observer.slots.iter().zip(robots.chunks_exact_mut(signs.len())) {
                let columns = slot.map(|place| &the_robots[place * signs.len()..][..signs.len()]);
                match columns.filter(|columns| !is_absent(columns)) {
                    Some(columns) => write(signs, columns, robot),
                    None => robot.copy_from_slice(&ABSENT),
                }
            }
        }
    }
}

impl Observer {
    /// Index of the observer itself in the row; `None` for an observer without a robot.
    pub fn robot(&self) -> Option<usize> {
        self.slots.first().copied().flatten()
    }

    /// Sign of components along the field's x and y axes in the observer's view.
    fn flip(&self) -> f32 {
        if self.rotated { -1.0 } else { 1.0 }
    }

    /// The ball of a row in the observer's view.
    pub(super) fn ball(&self, row: &[f32]) -> ViewedBall {
        let &[x, y, z, v_x, v_y, v_z, ..] = row else { unreachable!("{BALL_COLUMNS:?}") };
        let flip = self.flip();
        ViewedBall {
            position: Vector::new(x, y) * flip,
            height: z,
            velocity: Vector::new(v_x, v_y) * flip,
            vertical_velocity: v_z,
        }
    }

    /// Whether the observing robot is absent in a row.
    pub(super) fn is_absent(&self, row: &[f32]) -> bool {
        self.robot().is_some_and(|place| is_absent(columns_of(row, place)))
    }

    /// The observer itself and the robots in its other slots, in its view of a row; zeros for an absent
    /// robot and an empty slot.
    pub(super) fn robots(&self, row: &[f32]) -> impl Iterator<Item = ViewedRobot> {
        let flip = self.flip();
        self.slots.iter().map(move |slot| {
            let Some(place) = slot else { return ViewedRobot::default() };
            let columns = columns_of(row, *place);
            if is_absent(columns) {
                return ViewedRobot { presence: Presence::Absent, ..ViewedRobot::default() };
            }
            let &[x, y, cos, sin, v_x, v_y, angular_velocity, beam, ..] = columns else {
                unreachable!("{ROBOT_COLUMNS:?}")
            };
            ViewedRobot {
                position: Vector::new(x, y) * flip,
                heading: Vector::new(cos, sin) * flip,
                velocity: Vector::new(v_x, v_y) * flip,
                angular_velocity,
                beam,
                presence: Presence::Present,
            }
        })
    }
}

/// The ball in the view of an observer, which attacks +x, SI units.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ViewedBall {
    pub(super) position: Vector,
    pub(super) height: f32,
    pub(super) velocity: Vector,
    pub(super) vertical_velocity: f32,
}

/// A robot in the view of an observer, which attacks +x, SI units; `beam` is 1 if the ball is in its
/// break beam.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ViewedRobot {
    pub(super) position: Vector,
    pub(super) heading: Vector,
    pub(super) velocity: Vector,
    pub(super) angular_velocity: f32,
    pub(super) beam: f32,
    pub(super) presence: Presence,
}

/// Whether a robot fills a slot, and is on the field.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Presence {
    /// No robot belongs to the slot.
    #[default]
    Empty,
    Absent,
    Present,
}

/// The columns of a robot in a row.
fn columns_of(row: &[f32], place: usize) -> &[f32] {
    &row[BALL_COLUMNS.len()..][place * ROBOT_COLUMNS.len()..][..ROBOT_COLUMNS.len()]
}

fn write<const N: usize>(signs: &[f32; N], from: &[f32], to: &mut [f32]) {
    for ((to, from), sign) in to.iter_mut().zip(from).zip(signs) {
        *to = from * sign;
    }
}

/// Sign of a column under a rotation by 180 degrees: -1 for components along the field's x and y axes.
fn rotation_sign(column: &str) -> f32 {
    let flips = ["x", "y", "cos", "sin"].contains(&column)
        || column.ends_with("_x")
        || column.ends_with("_y");
    if flips { -1.0 } else { 1.0 }
}

/// Code of a crossing under a rotation by 180 degrees.
fn rotated_crossing(crossing: &str) -> f32 {
    let swapped = crossing.split('_').map(|word| match word {
        "right" => "left",
        "left" => "right",
        other => other,
    });
    let name = swapped.collect::<Vec<_>>().join("_");
    let place = CROSSINGS.iter().position(|crossing| *crossing == name);
    place.expect("each crossing has one on the other side") as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{crossing_name, robot_column, row_size};

    #[test]
    #[allow(clippy::float_cmp)] // only signs change, so bits are compared
    fn a_rotated_view_has_the_other_goal_and_empty_slots_are_zero() {
        let slots = vec![Some(1), None, Some(0)];
        let viewpoint = Viewpoint::new(vec![
            Observer { rotated: false, slots: vec![Some(0), None, Some(1)] },
            Observer { rotated: true, slots },
        ]);
        let mut row: Vec<f32> = (0_u8..).map(f32::from).take(row_size(2)).collect();
        row[ball_column("crossed")] = 1.0;
        for robot in 0..2 {
            row[BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len() + robot_column("absent")] = 0.0;
        }
        let mut ball = vec![f32::NAN; 2 * BALL_COLUMNS.len()];
        let mut robots = vec![f32::NAN; 2 * 3 * ROBOT_COLUMNS.len()];
        viewpoint.fill([&row; 2], &mut ball, &mut robots);
        let (upright, rotated) = ball.split_at(BALL_COLUMNS.len());
        assert_eq!(upright, &row[..BALL_COLUMNS.len()]);
        assert_eq!(crossing_name(upright[ball_column("crossed")]), "goal_right");
        assert_eq!(crossing_name(rotated[ball_column("crossed")]), "goal_left");
        assert_eq!(rotated[ball_column("v_y")], -upright[ball_column("v_y")]);
        assert_eq!(rotated[ball_column("z")], upright[ball_column("z")]);
        let robots: Vec<_> = robots.chunks_exact(ROBOT_COLUMNS.len()).collect();
        for (slot, sign, place) in [(0, 1.0, 0), (2, 1.0, 1), (3, -1.0, 1), (5, -1.0, 0)] {
            let expected = &row[BALL_COLUMNS.len() + place * ROBOT_COLUMNS.len()..];
            for (name, sign) in [("x", sign), ("sin", sign), ("v_theta", 1.0)] {
                let column = robot_column(name);
                assert_eq!(robots[slot][column], sign * expected[column], "{name} of slot {slot}");
            }
        }
        assert!([1, 4].iter().all(|&slot| robots[slot] == ABSENT));
    }

    #[test]
    #[allow(clippy::float_cmp)] // numbers are copied
    fn an_absent_robot_looks_like_an_empty_slot() {
        let slots = vec![Some(1), Some(0), None];
        let viewpoint = Viewpoint::new(vec![Observer { rotated: true, slots }]);
        let mut row = vec![0.5; row_size(2)];
        row[BALL_COLUMNS.len() + ABSENT_COLUMN] = 1.0;
        row[BALL_COLUMNS.len() + ROBOT_COLUMNS.len() + ABSENT_COLUMN] = 0.0;
        let mut ball = vec![f32::NAN; BALL_COLUMNS.len()];
        let mut robots = vec![f32::NAN; 3 * ROBOT_COLUMNS.len()];
        viewpoint.fill([&row; 2], &mut ball, &mut robots);
        let robots: Vec<_> = robots.chunks_exact(ROBOT_COLUMNS.len()).collect();
        assert_eq!(robots[0][robot_column("x")], -0.5);
        assert_eq!([robots[1], robots[2]], [ABSENT, ABSENT]);
    }
}
