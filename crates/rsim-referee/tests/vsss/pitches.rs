//! Fields, robots and rules of both sizes of VSSS.

use rsim_referee::Lines;
use rsim_referee::config::RefereeConfig;
use rsim_referee::pitch::Pitch;

/// Side of a robot, m.
pub(crate) const ROBOT_SIDE: f32 = 0.075;
/// Radius of the ball, m.
pub(crate) const BALL_RADIUS: f32 = 0.021_35;
/// Duration of a step, s.
pub(crate) const TIME_STEP: f32 = 0.025;

/// Robots of a team.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Size {
    Three,
    Five,
}

impl Size {
    pub(crate) const BOTH: [Self; 2] = [Self::Three, Self::Five];

    pub(crate) const fn robots(self) -> usize {
        match self {
            Self::Three => 3,
            Self::Five => 5,
        }
    }

    pub(crate) fn config(self) -> RefereeConfig {
        let name = match self {
            Self::Three => "vsss_3v3",
            Self::Five => "vsss_5v5",
        };
        RefereeConfig::preset(name).expect("a preset")
    }

    pub(crate) fn pitch(self) -> Pitch {
        Pitch {
            lines: self.lines(),
            robot_radius: ROBOT_SIDE / 2_f32.sqrt(),
            ball_radius: BALL_RADIUS,
            time_step: TIME_STEP,
        }
    }

    fn lines(self) -> Lines {
        let three = Lines {
            half_length: 0.75,
            half_width: 0.65,
            half_goal_width: 0.2,
            goal_height: 0.05,
            area_depth: 0.15,
            half_area_width: 0.35,
            inner_area_depth: 0.0,
            half_inner_area_width: 0.0,
            line_width: 0.003,
            corner_leg: 0.07,
            goal_wall_thickness: 0.0,
            center_circle_radius: 0.2,
            penalty_mark_distance: 0.375,
            boundary_x: 0.75,
            boundary_y: 0.65,
            free_ball_x: 0.375,
            free_ball_y: 0.4,
        };
        match self {
            Self::Three => three,
            Self::Five => Lines {
                half_length: 1.1,
                half_width: 0.9,
                area_depth: 0.35,
                half_area_width: 0.4,
                inner_area_depth: 0.15,
                half_inner_area_width: 0.25,
                center_circle_radius: 0.25,
                boundary_x: 1.1,
                boundary_y: 0.9,
                free_ball_x: 0.55,
                free_ball_y: 0.6,
                ..three
            },
        }
    }
}
