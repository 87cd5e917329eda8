//! Ball and robots of a scene.

use rsim_referee::Vector;
use rsim_referee::sight::{Placed, Robot, Sight};

use super::{Bot, Scene, Side, TIME_STEP};

/// Columns of the ball, as the physics has them.
pub(crate) const BALL: [&str; 13] = [
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
/// Columns of a robot.
pub(crate) const ROBOT: [&str; 12] = [
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

impl Scene {
    fn robot_column(&mut self, bot: Bot, name: &str) -> &mut f32 {
        let first = BALL.len() + self.index(bot) * ROBOT.len();
        let place = ROBOT.iter().position(|column| *column == name).expect("a column");
        &mut self.row[first + place]
    }

    /// Puts the ball somewhere, at rest.
    pub(crate) fn ball(&mut self, x: f32, y: f32) {
        let place = self.turn((x, y));
        let touch = self.row[BALL.len() - 1];
        self.row[..BALL.len()].fill(0.0);
        (self.row[0], self.row[1]) = (place.x, place.y);
        self.row[BALL.len() - 1] = touch;
    }

    /// Gives the ball a velocity.
    pub(crate) fn ball_velocity(&mut self, x: f32, y: f32, up: f32) {
        let velocity = self.turn((x, y));
        (self.row[3], self.row[4], self.row[5]) = (velocity.x, velocity.y, up);
    }

    /// Lifts the ball.
    pub(crate) fn ball_height(&mut self, height: f32) {
        self.row[2] = height;
    }

    /// Place of the ball.
    pub(crate) fn ball_at(&self) -> (f32, f32) {
        self.back(Vector::new(self.row[0], self.row[1]))
    }

    /// Puts a robot somewhere, at rest.
    pub(crate) fn robot(&mut self, bot: Bot, x: f32, y: f32) {
        let placed = Placed { robot: self.index(bot), position: self.turn((x, y)), faces: None };
        self.referee.layout().put_robot(&mut self.row, &placed);
    }

    /// Gives a robot a velocity.
    pub(crate) fn robot_velocity(&mut self, bot: Bot, x: f32, y: f32) {
        let velocity = self.turn((x, y));
        *self.robot_column(bot, "v_x") = velocity.x;
        *self.robot_column(bot, "v_y") = velocity.y;
    }

    /// Place of a robot; `None` for one that is absent.
    pub(crate) fn robot_at(&self, bot: Bot) -> Option<(f32, f32)> {
        self.sight().robot(self.index(bot)).map(|robot| self.back(robot.position))
    }

    /// Takes a robot off the field, as its team does.
    pub(crate) fn take_out(&mut self, bot: Bot) {
        *self.robot_column(bot, "absent") = 1.0;
    }

    /// Robots of a team on the field.
    pub(crate) fn count(&self, side: Side) -> usize {
        self.sight().count(self.team(side))
    }

    /// A robot touches the ball in the next step.
    pub(crate) fn touch(&mut self, bot: Bot) {
        *self.robot_column(bot, "touched_ball") = 1.0;
        self.row[BALL.len() - 1] = f32::from(u8::try_from(self.index(bot)).expect("few robots"));
    }

    /// A robot touched the ball in the last step.
    pub(crate) fn touched_before(&mut self, bot: Bot) {
        let row = self.row.clone();
        *self.robot_column(bot, "touched_ball") = 1.0;
        let touched = std::mem::replace(&mut self.row, row);
        self.before = touched;
    }

    /// Says how fast the ball was right after its last touch in the step, and how high since.
    pub(crate) fn since_touch(&mut self, speed: f32, height: f32) {
        self.since_touch = Some((speed, height));
    }

    /// Writes the facts about the last touch: those of the end of the step, unless the test says others.
    pub(super) fn write_since_touch(&mut self) {
        let ball = self.sight().ball();
        let before =
            self.referee.layout().sight(&self.before).expect("a row of this layout").ball();
        let has_touch = self.sight().robots().any(|robot| robot.touched_ball);
        let (speed, height) = self.since_touch.take().unwrap_or(if has_touch {
            (ball.speed(), ball.height)
        } else {
            (before.speed_after_touch, before.height_since_touch.max(ball.height))
        });
        let seconds = if has_touch { 0.0 } else { before.seconds_since_touch + TIME_STEP };
        let first = BALL.len() - 4;
        self.row[first..first + 3].copy_from_slice(&[seconds, speed, height]);
    }

    /// A robot has the ball between its jaws in the next step, without touching it.
    pub(crate) fn hold(&mut self, bot: Bot) {
        *self.robot_column(bot, "infrared") = 1.0;
    }

    /// Two opponents touch each other in the next step, with a closing speed.
    pub(crate) fn collide(&mut self, first: Bot, second: Bot, speed: f32) {
        for bot in [first, second] {
            *self.robot_column(bot, "touched_opponent") = 1.0;
            *self.robot_column(bot, "collision_speed") = speed;
        }
    }

    /// The bodies as a row.
    pub(crate) fn row(&self) -> &[f32] {
        &self.row
    }

    /// Takes over the bodies of another scene.
    pub(crate) fn take_state(&mut self, other: &Self) {
        self.row.clone_from(&other.row);
        self.before.clone_from(&other.before);
    }

    /// The state of the bodies.
    pub(crate) fn sight(&self) -> Sight<'_> {
        self.referee.layout().sight(&self.row).expect("a row of this layout")
    }

    /// All robots on the field.
    pub(crate) fn robots(&self) -> Vec<Robot> {
        self.sight().robots().collect()
    }

    /// Ends all touches.
    pub(super) fn clear_touches(&mut self) {
        for side in Side::BOTH {
            for number in 0..self.size() {
                for name in ["infrared", "touched_ball", "touched_opponent", "collision_speed"] {
                    *self.robot_column((side, number), name) = 0.0;
                }
            }
        }
    }
}
