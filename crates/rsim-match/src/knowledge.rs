//! Numbers of a configuration that referees and scripted sides read.

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use rsim_core::{Body, Drive, RobotModel, SimConfig};
use rsim_referee::pitch::Pitch;
use rsim_referee::sight::Layout;
use rsim_referee::{Lines, RefereeError};
use rsim_teams::{BallNumbers, RobotNumbers, TeamConfig};

/// Columns of the state rows of a configuration.
///
/// # Errors
/// More robots than a referee can see.
pub fn layout(config: &SimConfig) -> Result<Layout, RefereeError> {
    Layout::new(&BALL_COLUMNS, &ROBOT_COLUMNS, config.blue.len(), config.yellow.len())
}

/// Lines and walls of the field of a configuration.
pub fn lines(config: &SimConfig) -> Lines {
    let field = &config.field;
    Lines {
        half_length: field.half_length(),
        half_width: field.half_width(),
        half_goal_width: field.goal_width / 2.0,
        goal_height: field.goal_height,
        area_depth: field.goal_area_depth,
        half_area_width: field.goal_area_width / 2.0,
        inner_area_depth: field.inner_area_depth,
        half_inner_area_width: field.inner_area_width / 2.0,
        line_width: field.line_width,
        corner_leg: field.corner_leg,
        goal_wall_thickness: field.goal_wall_thickness,
        center_circle_radius: field.center_circle_radius,
        penalty_mark_distance: field.penalty_mark_distance,
        boundary_x: field.half_length() + field.goal_line_margin,
        boundary_y: field.half_width() + field.touch_line_margin,
        free_ball_x: field.free_ball_x,
        free_ball_y: field.free_ball_y,
    }
}

/// Numbers of a configuration that the rules read.
pub fn pitch(config: &SimConfig) -> Pitch {
    Pitch {
        lines: lines(config),
        robot_radius: config.robots().map(RobotModel::bounding_radius).fold(0.0, f32::max),
        ball_radius: config.ball.radius,
        time_step: config.time_step,
    }
}

/// Configuration of a scripted side of a skill, for a ball and robots like the first one; `None` without a robot,
/// and for one that such a side cannot drive: not round, without an omnidirectional drive or a mouth.
pub fn team_config(config: &SimConfig, layout: Layout, skill: f32) -> Option<TeamConfig> {
    let ball = &config.ball;
    Some(TeamConfig {
        lines: lines(config),
        layout,
        time_step: config.time_step,
        robot: robot_numbers(config.robots().next()?)?,
        ball: BallNumbers {
            radius: ball.radius,
            sliding_deceleration: ball.sliding_deceleration,
            rolling_deceleration: ball.rolling_deceleration,
            slide_to_roll_ratio: ball.slide_to_roll_ratio,
        },
        skill,
    })
}

/// Numbers of a robot that scripted sides read; `None` for one that is not round, without an
/// omnidirectional drive or without a mouth.
fn robot_numbers(robot: &RobotModel) -> Option<RobotNumbers> {
    let (Body::Round { radius, front_distance }, Drive::Omni(drive), Some(mouth)) =
        (robot.body, robot.drive, &robot.mouth)
    else {
        return None;
    };
    Some(RobotNumbers {
        radius,
        front_distance,
        max_speed: drive.max_speed,
        max_acceleration: drive.max_acceleration,
        max_deceleration: drive.max_deceleration,
        max_angular_velocity: drive.max_angular_velocity,
        max_kick_speed: mouth.max_kick_speed,
        max_chip_speed: mouth.max_chip_speed,
    })
}
