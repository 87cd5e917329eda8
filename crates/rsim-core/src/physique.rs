//! What the bodies of one match are, ready for stepping: the models, or a world's own variations
//! of them.

use rapier2d::math::Vector;
use serde::{Deserialize, Serialize};

use crate::ball_model::Surface;
use crate::columns::{BALL_PARAMETERS, ROBOT_PARAMETERS};
use crate::drive::Limits;
use crate::engine::Motion;
use crate::impact::Other;
use crate::outline::Outline;
use crate::robot_model::Drive;
use crate::{BallModel, ConfigError, RobotModel, SimConfig};

/// Bodies of a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Physique {
    pub(crate) ball: BallModel,
    pub(crate) robots: Vec<RobotBody>,
}

/// A robot, ready for stepping.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct RobotBody {
    pub(crate) model: RobotModel,
    pub(crate) outline: Outline,
    pub(crate) limits: Limits,
    /// 1/kg and 1/(kg m²).
    pub(crate) inverse_mass: f32,
    pub(crate) inverse_inertia: f32,
    /// Factor on the speed of kicks.
    pub(crate) kick_gain: f32,
}

impl RobotBody {
    fn of(model: RobotModel, kick_gain: f32, tick: f32) -> Self {
        Self {
            outline: Outline::of(model.body),
            limits: Limits::of(&model, tick),
            inverse_mass: 1.0 / model.mass,
            inverse_inertia: 1.0 / model.inertia(),
            model,
            kick_gain,
        }
    }

    /// Speed that a unit impulse along `normal`, at `arm` from the centre, gives that point, 1/kg.
    pub(crate) fn yields(&self, arm: Vector, normal: Vector) -> f32 {
        let turn = arm.perp_dot(normal);
        self.inverse_mass + turn * turn * self.inverse_inertia
    }

    /// The robot as what a ball meets at the point `at` of the field.
    pub(crate) fn at(&self, motion: &Motion, at: Vector, surface: Surface) -> Other {
        let arm = at - motion.position;
        Other {
            velocity: (motion.velocity + arm.perp() * motion.spin).extend(0.0),
            arm,
            inverse_mass: self.inverse_mass,
            inverse_inertia: self.inverse_inertia,
            surface,
        }
    }
}

impl Physique {
    /// The models as they are.
    pub(crate) fn of(config: &SimConfig) -> Self {
        Self {
            ball: config.ball.clone(),
            robots: config
                .robots()
                .map(|model| RobotBody::of(model.clone(), 1.0, config.tick))
                .collect(),
        }
    }

    /// The models with a world's own factors: [`BALL_PARAMETERS`], then [`ROBOT_PARAMETERS`] of each
    /// robot.
    pub(crate) fn varied(config: &SimConfig, factors: &[f32]) -> Result<Self, ConfigError> {
        debug_assert_eq!(factors.len(), config.parameters_size());
        for (index, factor) in factors.iter().enumerate() {
            let bound = if name_of(index).ends_with("mass") || index >= BALL_PARAMETERS.len() {
                f32::MIN_POSITIVE
            } else {
                0.0
            };
            if !(*factor >= bound && factor.is_finite()) {
                let expected = "a finite factor, positive (friction, restitution: or 0)";
                return Err(ConfigError::Number { name: name_of(index), expected, got: *factor });
            }
        }
        let (ball, robots) = factors.split_at(BALL_PARAMETERS.len());
        let ball = varied_ball(&config.ball, ball);
        ball.validate()?;
        let robots = config.robots().zip(robots.chunks_exact(ROBOT_PARAMETERS.len()));
        let robots = robots.map(|(model, factors)| {
            let body = varied_robot(model, factors, config.tick);
            body.model.validate().map(|()| body)
        });
        Ok(Self { ball, robots: robots.collect::<Result<_, _>>()? })
    }
}

/// Name of a column of a row of parameters.
fn name_of(index: usize) -> &'static str {
    let robots = BALL_PARAMETERS.len();
    if index < robots {
        BALL_PARAMETERS[index]
    } else {
        ROBOT_PARAMETERS[(index - robots) % ROBOT_PARAMETERS.len()]
    }
}

fn varied_ball(model: &BallModel, factors: &[f32]) -> BallModel {
    let [mass, slide, roll, hop, robot_bounce, robot_friction, wall_bounce, wall_friction] =
        *factors
    else {
        unreachable!("a ball has {BALL_PARAMETERS:?}")
    };
    let scaled = |surface: Surface, restitution: f32, friction: f32| Surface {
        restitution: (surface.restitution * restitution).min(1.0),
        friction: surface.friction * friction,
    };
    let mut ball = model.clone();
    ball.mass *= mass;
    ball.sliding_deceleration *= slide;
    ball.rolling_deceleration *= roll;
    ball.hop.up = (ball.hop.up * hop).min(1.0);
    ball.robot = scaled(model.robot, robot_bounce, robot_friction);
    ball.wall = scaled(model.wall, wall_bounce, wall_friction);
    ball.goal_back = scaled(model.goal_back, wall_bounce, wall_friction);
    ball
}

fn varied_robot(model: &RobotModel, factors: &[f32], tick: f32) -> RobotBody {
    let [mass, height, acceleration, speed, traction, kick, grip] = *factors else {
        unreachable!("a robot has {ROBOT_PARAMETERS:?}")
    };
    let mut robot = model.clone();
    robot.mass *= mass;
    robot.height *= height;
    match &mut robot.drive {
        Drive::Differential(drive) => {
            drive.motor_torque *= acceleration;
            drive.forward_grip *= acceleration;
            drive.side_grip *= traction;
            drive.max_wheel_speed *= speed;
        }
        Drive::Omni(drive) | Drive::OmniWheels(drive) => {
            for limit in [
                &mut drive.speed_up,
                &mut drive.brake,
                &mut drive.turn_speed_up,
                &mut drive.turn_brake,
            ] {
                *limit *= acceleration;
            }
            for limit in
                [&mut drive.max_speed, &mut drive.max_turn_rate, &mut drive.max_wheel_speed]
            {
                *limit *= speed;
            }
            drive.traction *= traction;
        }
    }
    if let Some(mouth) = &mut robot.mouth {
        mouth.grip *= grip;
    }
    RobotBody::of(robot, kick, tick)
}
