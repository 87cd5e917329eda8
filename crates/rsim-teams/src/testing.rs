//! Shared parts of the tests of this crate: division B, and rows with bodies at places.

use rsim_referee::sight::{Layout, Placed};
use rsim_referee::{Lines, Team, Vector};

use crate::config::{BallNumbers, RobotNumbers, TeamConfig};
use crate::intercept::Meetings;
use crate::phase::{Mode, Phase, Restart};
use crate::pitch::Pitch;
use crate::random::Random;
use crate::rolling::BallPath;
use crate::situation::Situation;
use crate::skill::Skill;
use crate::tactics::Tactics;
use crate::view::View;

/// The ball in play.
pub(crate) const PLAY: Phase =
    Phase { mode: Mode::Play, restart: Restart::Free, ours: false, kicks_next: false };

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
    "last_touch",
    "seconds_since_touch",
    "speed_after_touch",
    "height_since_touch",
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

/// Division B.
pub(crate) fn pitch() -> Pitch {
    Pitch { lines: config().lines }
}

/// Six robots a side of the generic model in division B, at full skill.
pub(crate) fn config() -> TeamConfig {
    config_of(6, 6)
}

pub(crate) fn config_of(n_blue: usize, n_yellow: usize) -> TeamConfig {
    TeamConfig {
        lines: Lines {
            half_length: 4.5,
            half_width: 3.0,
            half_goal_width: 0.5,
            goal_height: 0.16,
            area_depth: 1.0,
            half_area_width: 1.0,
            inner_area_depth: 0.0,
            half_inner_area_width: 0.0,
            line_width: 0.01,
            corner_leg: 0.0,
            goal_wall_thickness: 0.02,
            center_circle_radius: 0.5,
            penalty_mark_distance: 6.0,
            boundary_x: 4.8,
            boundary_y: 3.3,
            free_ball_x: 0.0,
            free_ball_y: 0.0,
        },
        layout: Layout::new(&BALL, &ROBOT, n_blue, n_yellow).expect("all columns"),
        time_step: 0.025,
        robot: RobotNumbers {
            radius: 0.09,
            front_distance: 0.0715,
            max_speed: 3.7,
            max_acceleration: 4.7,
            max_deceleration: 5.9,
            max_angular_velocity: 26.2,
            max_kick_speed: 8.0,
            max_chip_speed: 8.0,
        },
        ball: BallNumbers {
            radius: 0.0215,
            sliding_deceleration: 3.0,
            rolling_deceleration: 0.26,
            slide_to_roll_ratio: 2.0 / 3.0,
        },
        skill: 1.0,
    }
}

/// A state row that tests change.
pub(crate) struct Scene {
    pub(crate) config: TeamConfig,
    pub(crate) row: Vec<f32>,
}

impl Scene {
    /// Robots far from each other, blue at x < 0 and yellow at x > 0.
    pub(crate) fn new(n_blue: usize, n_yellow: usize) -> Self {
        let config = config_of(n_blue, n_yellow);
        let row = vec![0.0; config.layout.row_size()];
        let mut scene = Self { config, row };
        scene.ball([0.0, 0.0], [0.0, 0.0]);
        for index in 0..n_blue + n_yellow {
            let (side, nth) = if index < n_blue { (-1.0, index) } else { (1.0, index - n_blue) };
            scene.robot(index, [side * 2.0, nth as f32 * 0.5 - 1.25]);
        }
        scene
    }

    pub(crate) fn ball(&mut self, [x, y]: [f32; 2], [v_x, v_y]: [f32; 2]) {
        let since_touch = [-1.0, 0.0, 0.0, 0.0]; // nobody has touched it
        let motion = [x, y, 0.0, v_x, v_y, 0.0, 0.0, 0.0, 0.0];
        self.row[..BALL.len()].copy_from_slice(&[&motion[..], &since_touch].concat());
    }

    /// Puts a robot at rest, facing +x.
    pub(crate) fn robot(&mut self, robot: usize, [x, y]: [f32; 2]) {
        let position = Vector::new(x, y);
        let faces = Some(position + Vector::new(1.0, 0.0));
        let layout = self.config.layout.clone();
        layout.put_robot(&mut self.row, &Placed { robot, position, faces });
    }

    /// Sets a column of a robot.
    pub(crate) fn set(&mut self, robot: usize, column: &str, value: f32) {
        let place = ROBOT.iter().position(|name| *name == column).expect("a column");
        self.row[BALL.len() + robot * ROBOT.len() + place] = value;
    }

    pub(crate) fn take_out(&mut self, robot: usize) {
        let layout = self.config.layout.clone();
        layout.take_out(&mut self.row, robot);
    }

    /// Situation of blue, with the ball to be placed where it is.
    pub(crate) fn situation<R>(&self, phase: Phase, check: impl FnOnce(&Situation) -> R) -> R {
        let (view, pitch) = (self.view(Team::Blue), pitch());
        let skill = Skill::new(self.config.skill, self.config.time_step);
        let mut situation = Situation {
            config: &self.config,
            pitch: &pitch,
            skill: &skill,
            tactics: &Tactics::DEFAULT,
            view: &view,
            phase,
            command_time: 2.0,
            in_play: phase.mode == Mode::Play,
            place: view.ball.position,
            barred: None,
            barred_opponent: None,
            path: BallPath::new(&view.ball, view.ball.velocity.length(), &self.config.ball),
            own: Meetings::default(),
            others: Meetings::default(),
            random: Random::new(1, 2),
            step: 5,
        };
        situation.meet();
        check(&situation)
    }

    pub(crate) fn view(&self, team: Team) -> View {
        let sight = self.config.layout.sight(&self.row).expect("a row");
        View::new(&sight, team, [0, self.config.layout.team_size(Team::Blue)])
    }
}
