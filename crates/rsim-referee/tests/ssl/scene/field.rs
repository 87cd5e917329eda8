//! Fields of both divisions, and their referees.

use rsim_referee::config::RefereeConfig;
use rsim_referee::pitch::Pitch;
use rsim_referee::sight::Layout;
use rsim_referee::{Lines, Referee};

use super::{BALL, ROBOT};

/// Duration of a step, s.
pub(crate) const TIME_STEP: f32 = 0.025;
/// Radius of a robot, m.
pub(crate) const ROBOT_RADIUS: f32 = 0.09;
/// Radius of the ball, m.
pub(crate) const BALL_RADIUS: f32 = 0.0215;

/// Division of SSL.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Division {
    A,
    B,
}
pub(crate) use Division::{A, B};

/// Lines of a field of division A or B. Source: ssl-rules 4300196, chapter "Playing Environment".
pub(crate) fn lines(division: Division) -> Lines {
    let b = Lines {
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
    };
    match division {
        B => b,
        A => Lines {
            half_length: 6.0,
            half_width: 4.5,
            half_goal_width: 0.9,
            area_depth: 1.8,
            half_area_width: 1.8,
            penalty_mark_distance: 8.0,
            boundary_x: 6.6,
            boundary_y: 4.8,
            ..b
        },
    }
}

/// A referee of a division.
pub(crate) fn referee(division: Division, change: impl FnOnce(&mut RefereeConfig)) -> Referee {
    let (preset, size) = match division {
        A => ("ssl_2026_a", 11),
        B => ("ssl_2026_b", 6),
    };
    let mut config = RefereeConfig::preset(preset).expect("a preset");
    change(&mut config);
    let pitch = Pitch {
        lines: lines(division),
        robot_radius: ROBOT_RADIUS,
        ball_radius: BALL_RADIUS,
        time_step: TIME_STEP,
    };
    let layout = Layout::new(&BALL, &ROBOT, size, size).expect("all columns");
    Referee::new(config, pitch, layout).expect("a valid configuration")
}
