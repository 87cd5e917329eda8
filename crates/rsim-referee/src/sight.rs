//! Sight of a referee: ball and robots, read from rows of columns by name.

use crate::error::RefereeError;
use crate::team::Team;
use crate::vector::Vector;

/// Places of the columns that the rules read, in a row of a match.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layout {
    ball: [usize; BALL.len()],
    robot: [usize; ROBOT.len()],
    ball_size: usize,
    robot_size: usize,
    n_blue: usize,
    n_yellow: usize,
}

const BALL: [&str; 13] = [
    "x",
    "y",
    "z",
    "v_x",
    "v_y",
    "v_z",
    "spin_x",
    "spin_y",
    "spin_z",
    "seconds_since_touch",
    "speed_after_touch",
    "height_since_touch",
    "last_touch",
];
const ROBOT: [&str; 12] = [
    "x",
    "y",
    "cos",
    "sin",
    "v_x",
    "v_y",
    "v_theta",
    "infrared",
    "touched_ball",
    "touched_opponent",
    "collision_speed",
    "absent",
];

/// The ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Position of the center, m.
    pub position: Vector,
    /// Height of the lowest point, m.
    pub height: f32,
    /// Velocity over the floor, m/s.
    pub velocity: Vector,
    /// Vertical velocity, m/s.
    pub vertical_velocity: f32,
    /// Index of the last robot that touched the ball.
    pub last_touch: Option<usize>,
    /// Time since then, s.
    pub seconds_since_touch: f32,
    /// Speed right after that touch, in three dimensions, m/s.
    pub speed_after_touch: f32,
    /// Maximum height of the lowest point since that touch, m.
    pub height_since_touch: f32,
}

impl Ball {
    /// Speed in three dimensions, m/s.
    pub fn speed(&self) -> f32 {
        (self.velocity.dot(self.velocity) + self.vertical_velocity * self.vertical_velocity).sqrt()
    }
}

/// A robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Robot {
    /// Index in the order of a row.
    pub index: usize,
    /// Its team.
    pub team: Team,
    /// Position of the center, m.
    pub position: Vector,
    /// Direction that it faces, of length 1.
    pub heading: Vector,
    /// Velocity, m/s.
    pub velocity: Vector,
    /// Angular velocity, rad/s, counterclockwise.
    pub angular_velocity: f32,
    /// Whether the ball is in its mouth.
    pub has_ball: bool,
    /// Whether it touched the ball in the step.
    pub touched_ball: bool,
    /// Whether it touched an opponent in the step.
    pub touched_opponent: bool,
    /// Closing speed of its hardest contact with a robot in the step, m/s.
    pub collision_speed: f32,
}

impl Robot {
    /// A robot that stands somewhere, and touches nothing.
    pub const fn at_rest(index: usize, team: Team, position: Vector) -> Self {
        Self {
            index,
            team,
            position,
            heading: Vector::new(1.0, 0.0),
            velocity: Vector::new(0.0, 0.0),
            angular_velocity: 0.0,
            has_ball: false,
            touched_ball: false,
            touched_opponent: false,
            collision_speed: 0.0,
        }
    }
}

/// State of a match after a step, as the referee sees it.
#[derive(Debug, Clone, Copy)]
pub struct Sight<'a> {
    layout: &'a Layout,
    row: &'a [f32],
}

impl Layout {
    /// Finds the columns that the rules read.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn new(
        ball_columns: &[&str],
        robot_columns: &[&str],
        n_blue: usize,
        n_yellow: usize,
    ) -> Result<Self, RefereeError> {
        let mut layout = Self {
            ball: [0; BALL.len()],
            robot: [0; ROBOT.len()],
            ball_size: ball_columns.len(),
            robot_size: robot_columns.len(),
            n_blue,
            n_yellow,
        };
        find(&BALL, ball_columns, &mut layout.ball)?;
        find(&ROBOT, robot_columns, &mut layout.robot)?;
        Ok(layout)
    }

    /// Number of robots of a team.
    pub const fn team_size(&self, team: Team) -> usize {
        match team {
            Team::Blue => self.n_blue,
            Team::Yellow => self.n_yellow,
        }
    }

    /// Number of robots of both teams.
    pub const fn robots(&self) -> usize {
        self.n_blue + self.n_yellow
    }

    /// Numbers in a row.
    pub const fn row_size(&self) -> usize {
        self.ball_size + self.robots() * self.robot_size
    }

    /// Team of the robot with an index in the order of a row.
    pub const fn team_of(&self, robot: usize) -> Team {
        if robot < self.n_blue { Team::Blue } else { Team::Yellow }
    }

    /// The state in a row.
    ///
    /// # Errors
    /// If the row has another length.
    pub fn sight<'a>(&'a self, row: &'a [f32]) -> Result<Sight<'a>, RefereeError> {
        if row.len() == self.row_size() {
            return Ok(Sight { layout: self, row });
        }
        Err(RefereeError::RowSize { expected: self.row_size(), got: row.len() })
    }
}

/// Pose in which a restart puts a robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Index of the robot.
    pub robot: usize,
    /// Position of the center, m.
    pub position: Vector,
    /// Point that it faces, m; `None` to keep its heading.
    pub faces: Option<Vector>,
}

impl Layout {
    /// Puts the ball at rest on the floor.
    pub fn put_ball(&self, row: &mut [f32], position: Vector) {
        let [x, y, rest @ .., _] = self.ball;
        for column in rest {
            row[column] = 0.0;
        }
        (row[x], row[y]) = (position.x, position.y);
    }

    /// Puts a robot at rest on the field.
    pub fn put_robot(&self, row: &mut [f32], placed: &Placed) {
        let first = self.ball_size + placed.robot * self.robot_size;
        let [x, y, cos, sin, v_x, v_y, v_theta, .., absent] =
            self.robot.map(|column| first + column);
        (row[x], row[y]) = (placed.position.x, placed.position.y);
        for column in [v_x, v_y, v_theta, absent] {
            row[column] = 0.0;
        }
        let ahead = placed.faces.map_or(Vector::default(), |point| point - placed.position);
        let length = ahead.length();
        if length > 0.0 {
            (row[cos], row[sin]) = (ahead.x / length, ahead.y / length);
        }
    }

    /// Takes a robot off the field.
    pub fn take_out(&self, row: &mut [f32], robot: usize) {
        let first = self.ball_size + robot * self.robot_size;
        let [_, _, _, _, v_x, v_y, v_theta, .., absent] = self.robot.map(|column| first + column);
        for column in [v_x, v_y, v_theta] {
            row[column] = 0.0;
        }
        row[absent] = 1.0;
    }
}

fn find(
    names: &[&'static str],
    columns: &[&str],
    places: &mut [usize],
) -> Result<(), RefereeError> {
    for (name, place) in names.iter().zip(places) {
        *place = columns
            .iter()
            .position(|column| column == name)
            .ok_or(RefereeError::MissingColumn { name })?;
    }
    Ok(())
}

impl Sight<'_> {
    /// The ball.
    pub fn ball(&self) -> Ball {
        let [x, y, height, v_x, v_y, vertical_velocity, _, _, _, seconds, speed, highest, touch] =
            self.layout.ball.map(|place| self.row[place]);
        Ball {
            position: Vector::new(x, y),
            height,
            velocity: Vector::new(v_x, v_y),
            vertical_velocity,
            last_touch: index_of(touch),
            seconds_since_touch: seconds,
            speed_after_touch: speed,
            height_since_touch: highest,
        }
    }

    /// A robot; `None` for one that is absent, and for an index that no robot has.
    #[inline]
    pub fn robot(&self, index: usize) -> Option<Robot> {
        if index >= self.layout.robots() {
            return None;
        }
        let first = self.layout.ball_size + index * self.layout.robot_size;
        let [x, y, cos, sin, v_x, v_y, v_theta, mouth, ball, opponent, collision_speed, absent] =
            self.layout.robot.map(|place| self.row[first + place]);
        let robot = Robot {
            index,
            team: self.layout.team_of(index),
            position: Vector::new(x, y),
            heading: Vector::new(cos, sin),
            velocity: Vector::new(v_x, v_y),
            angular_velocity: v_theta,
            has_ball: mouth > 0.5,
            touched_ball: ball > 0.5,
            touched_opponent: opponent > 0.5,
            collision_speed,
        };
        (absent < 0.5).then_some(robot)
    }

    /// Team of a robot by its index.
    pub const fn team_of(&self, robot: usize) -> Team {
        self.layout.team_of(robot)
    }

    /// The keeper of a team: its first robot.
    pub const fn keeper(&self, team: Team) -> usize {
        self.first_of(team)
    }

    /// Index of the first robot of a team.
    pub const fn first_of(&self, team: Team) -> usize {
        match team {
            Team::Blue => 0,
            Team::Yellow => self.layout.n_blue,
        }
    }

    /// Indices of the robots of a team, absent ones too.
    pub const fn indices(&self, team: Team) -> std::ops::Range<usize> {
        let first = self.first_of(team);
        first..first + self.layout.team_size(team)
    }

    /// All robots on the field, in the order of a row.
    pub fn robots(&self) -> impl Iterator<Item = Robot> {
        (0..self.layout.robots()).filter_map(|index| self.robot(index))
    }

    /// Number of robots of a team on the field.
    pub fn count(&self, team: Team) -> usize {
        self.team(team).count()
    }

    /// The robots of a team on the field.
    pub fn team(&self, team: Team) -> impl Iterator<Item = Robot> {
        self.indices(team).filter_map(|index| self.robot(index))
    }
}

/// Index in a column that has -1 for none.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small whole number
fn index_of(value: f32) -> Option<usize> {
    (value > -0.5).then_some((value + 0.5) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns in another order than that of the rules, with one more of each.
    fn columns(names: &[&'static str]) -> Vec<&'static str> {
        names.iter().rev().copied().chain(["other"]).collect()
    }

    fn layout() -> Layout {
        Layout::new(&columns(&BALL), &columns(&ROBOT), 1, 2).expect("all columns are there")
    }

    /// Numbers of the columns of a body, from those in the order of the rules.
    fn numbers<const N: usize>(in_order: [f32; N]) -> impl Iterator<Item = f32> {
        in_order.into_iter().rev().chain([9.0])
    }

    #[test]
    fn ball_and_robots_are_read_by_the_names_of_columns() {
        let layout = layout();
        let row: Vec<f32> =
            numbers([1.0, 2.0, 0.1, 3.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.05, 6.0, 0.2, 2.0])
                .chain(numbers([0.5, 0.6, 0.0, 1.0, 0.7, 0.8, 2.0, 1.0, 0.0, 1.0, 1.25, 0.0]))
                .chain(numbers([0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))
                .chain(numbers([
                    -1.0, -1.0, 1.0, 0.0, -1.0, -1.0, 0.0, -1.0, -1.0, -1.0, -1.0, 0.0,
                ]))
                .collect();
        let sight = layout.sight(&row).expect("a row of this layout");
        let ball = sight.ball();
        assert_eq!(ball.position, Vector::new(1.0, 2.0));
        assert!((ball.speed() - 5.0).abs() < 1e-6);
        assert_eq!(ball.last_touch, Some(2));
        let since = (ball.seconds_since_touch, ball.speed_after_touch, ball.height_since_touch);
        assert_eq!(since, (0.05, 6.0, 0.2));
        let blue = sight.robot(0).expect("on the field");
        assert_eq!(blue.velocity, Vector::new(0.7, 0.8));
        assert_eq!((blue.has_ball, blue.touched_ball, blue.touched_opponent), (true, false, true));
        assert!((blue.collision_speed - 1.25).abs() < 1e-6);
        assert_eq!(sight.robot(1), None);
        let indices: Vec<usize> = sight.robots().map(|robot| robot.index).collect();
        assert_eq!(indices, [0, 2]);
        assert_eq!(sight.team(Team::Yellow).count(), 1);
    }

    #[test]
    fn nobody_and_nothing_are_none() {
        let layout = layout();
        let mut row = vec![0.0; layout.row_size()];
        let touch = columns(&BALL).iter().position(|name| *name == "last_touch");
        row[touch.expect("the ball has it")] = -1.0;
        let ball = layout.sight(&row).expect("a row of this layout").ball();
        assert_eq!(ball.last_touch, None);
    }

    #[test]
    fn missing_columns_and_other_rows_are_refused() {
        let error = Layout::new(&BALL[1..], &ROBOT, 1, 1).expect_err("no x");
        assert_eq!(error, RefereeError::MissingColumn { name: "x" });
        let layout = layout();
        let error = layout.sight(&[0.0; 3]).expect_err("too short");
        assert_eq!(error, RefereeError::RowSize { expected: layout.row_size(), got: 3 });
    }
}
