//! A state row as robots see it: me, mates, foes and the ball, always attacking +x.

use crate::columns::{BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS, ball_column};

/// Who looks, and what each has where.
#[derive(Debug, Clone, PartialEq)]
pub struct Viewpoint {
    seats: Vec<Seat>,
    /// Signs of the ball's and a robot's columns, as they are and turned half round.
    ball_signs: [[f32; BALL_COLUMNS.len()]; 2],
    robot_signs: [[f32; ROBOT_COLUMNS.len()]; 2],
    /// What who sees the field turned reads for each crossing.
    other_side: [f32; CROSSINGS.len()],
    crossed: usize,
}

/// One robot that looks.
#[derive(Debug, Clone, PartialEq)]
pub struct Seat {
    /// Whether it sees the field turned half round.
    pub turned: bool,
    /// Robots by their place in the row: itself, mates, foes; none where a slot is empty.
    pub slots: Vec<Option<usize>>,
}

impl Viewpoint {
    /// The view of these seats, which must have equally many slots.
    pub fn new(seats: Vec<Seat>) -> Self {
        debug_assert!(seats.windows(2).all(|pair| pair[0].slots.len() == pair[1].slots.len()));
        Self {
            seats,
            ball_signs: [[1.0; BALL_COLUMNS.len()], BALL_COLUMNS.map(turned)],
            robot_signs: [[1.0; ROBOT_COLUMNS.len()], ROBOT_COLUMNS.map(turned)],
            other_side: CROSSINGS.map(other_side),
            crossed: ball_column("crossed"),
        }
    }

    /// Robots that look.
    pub fn seers(&self) -> usize {
        self.seats.len()
    }

    /// Robots that one of them sees.
    pub fn slots(&self) -> usize {
        self.seats.first().map_or(0, |seat| seat.slots.len())
    }

    /// Writes what all see of a row: `ball` has the ball's columns for each seer, `robots` a robot's
    /// for each slot of each seer, zeros where it is empty.
    pub fn fill(&self, row: &[f32], ball: &mut [f32], robots: &mut [f32]) {
        let (the_ball, the_robots) = row.split_at(BALL_COLUMNS.len());
        let balls = ball.chunks_exact_mut(BALL_COLUMNS.len());
        let views = robots.chunks_exact_mut(self.slots().max(1) * ROBOT_COLUMNS.len());
        for (seat, (ball, robots)) in self.seats.iter().zip(balls.zip(views)) {
            let side = usize::from(seat.turned);
            write(&self.ball_signs[side], the_ball, ball);
            if seat.turned {
                let crossed = ball[self.crossed];
                let mut codes = (0_u8..).map(f32::from).zip(self.other_side);
                if let Some((_, other)) = codes.find(|(code, _)| (code - crossed).abs() < 0.5) {
                    ball[self.crossed] = other;
                }
            }
            let signs = &self.robot_signs[side];
            for (slot, robot) in seat.slots.iter().zip(robots.chunks_exact_mut(signs.len())) {
                match slot {
                    Some(place) => {
                        let first = place * signs.len();
                        write(signs, &the_robots[first..first + signs.len()], robot);
                    }
                    None => robot.fill(0.0),
                }
            }
        }
    }
}

fn write<const N: usize>(signs: &[f32; N], from: &[f32], to: &mut [f32]) {
    for ((to, from), sign) in to.iter_mut().zip(from).zip(signs) {
        *to = from * sign;
    }
}

/// -1 where a half turn flips the sign: components along the field's x and y axes.
fn turned(column: &str) -> f32 {
    let flips = ["x", "y", "cos", "sin"].contains(&column)
        || column.ends_with("_x")
        || column.ends_with("_y");
    if flips { -1.0 } else { 1.0 }
}

/// What a crossing is called with the field turned half round.
fn other_side(crossing: &str) -> f32 {
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
    fn who_sees_the_field_turned_sees_the_other_goal_and_slots_that_nobody_fills_are_zero() {
        let slots = vec![Some(1), None, Some(0)];
        let viewpoint = Viewpoint::new(vec![
            Seat { turned: false, slots: vec![Some(0), None, Some(1)] },
            Seat { turned: true, slots },
        ]);
        let mut row: Vec<f32> = (0_u8..).map(f32::from).take(row_size(2)).collect();
        row[ball_column("crossed")] = 1.0;
        let mut ball = vec![f32::NAN; 2 * BALL_COLUMNS.len()];
        let mut robots = vec![f32::NAN; 2 * 3 * ROBOT_COLUMNS.len()];
        viewpoint.fill(&row, &mut ball, &mut robots);
        let (upright, turned) = ball.split_at(BALL_COLUMNS.len());
        assert_eq!(upright, &row[..BALL_COLUMNS.len()]);
        assert_eq!(crossing_name(upright[ball_column("crossed")]), "goal_right");
        assert_eq!(crossing_name(turned[ball_column("crossed")]), "goal_left");
        assert_eq!(turned[ball_column("v_y")], -upright[ball_column("v_y")]);
        assert_eq!(turned[ball_column("z")], upright[ball_column("z")]);
        let robots: Vec<_> = robots.chunks_exact(ROBOT_COLUMNS.len()).collect();
        for (slot, sign, place) in [(0, 1.0, 0), (2, 1.0, 1), (3, -1.0, 1), (5, -1.0, 0)] {
            let seen = &row[BALL_COLUMNS.len() + place * ROBOT_COLUMNS.len()..];
            for (name, sign) in [("x", sign), ("sin", sign), ("v_theta", 1.0)] {
                let column = robot_column(name);
                assert_eq!(robots[slot][column], sign * seen[column], "{name} of slot {slot}");
            }
        }
        assert!([1, 4].iter().all(|&slot| robots[slot].iter().all(|&number| number == 0.0)));
    }
}
