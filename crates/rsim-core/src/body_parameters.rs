//! Parameters of the bodies of one match, prepared for stepping: those of the models, or a world's
//! own variation of them.

use serde::{Deserialize, Serialize};

use crate::ball::impact::ContactBody;
use crate::blocks::{BALL, Lanes, bits_of, place_of, robot};
use crate::columns::{BALL_PARAMETERS, MAX_FACTOR, ROBOT_PARAMETERS};
use crate::drive::{BlockWheels, wheels_of};
use crate::error::ConfigError;
use crate::geometry::motion::Motion;
use crate::geometry::outline::Outline;
use crate::math::Vector;
use crate::models::ball::{BallModel, Surface};
use crate::models::config::SimConfig;
use crate::models::robot::{Drive, RobotModel};

/// Errors of sums of distances, with much to spare, m.
const ROUNDING: f32 = 1e-4;

/// Parameters of all bodies of a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct BodyParameters {
    pub(crate) ball: BallModel,
    pub(crate) robots: Vec<RobotParameters>,
    /// Wheels of the robots, by block.
    pub(crate) wheels: Vec<BlockWheels>,
    /// Inertia and size of all bodies, by block.
    pub(crate) inertia: Vec<BlockInertia>,
    /// Height of the highest robot, m.
    pub(crate) highest: f32,
    /// Robots with a mouth, one bit each.
    pub(crate) mouths: u64,
    /// Distance between the circles around ball and robot up to which the ball may be in a mouth, m.
    pub(crate) mouth_reach: f32,
}

/// Inertia and size of the bodies of a block.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(crate) struct BlockInertia {
    /// 1/kg.
    inverse_mass: Lanes,
    /// 1/(kg m²).
    inverse_inertia: Lanes,
    /// Radii of circles around the bodies, m.
    pub(crate) bounding_radius: Lanes,
}

/// Inverse mass (1/kg) and inverse moment of inertia (1/(kg m²)) of a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InverseInertia {
    pub(crate) mass: f32,
    pub(crate) inertia: f32,
}

impl BlockInertia {
    fn set(&mut self, lane: usize, inverse: InverseInertia, bounding_radius: f32) {
        self.inverse_mass.as_mut_array()[lane] = inverse.mass;
        self.inverse_inertia.as_mut_array()[lane] = inverse.inertia;
        self.bounding_radius.as_mut_array()[lane] = bounding_radius;
    }
}

/// Parameters of a robot, prepared for stepping.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct RobotParameters {
    pub(crate) model: RobotModel,
    pub(crate) outline: Outline,
    /// m.
    pub(crate) bounding_radius: f32,
    /// 1/kg.
    pub(crate) inverse_mass: f32,
    /// 1/(kg m²).
    pub(crate) inverse_inertia: f32,
    /// Factor on the speed of kicks.
    pub(crate) kick_gain: f32,
}

impl RobotParameters {
    fn of(model: RobotModel, kick_gain: f32) -> Self {
        Self {
            outline: Outline::of(model.body),
            bounding_radius: model.bounding_radius(),
            inverse_mass: 1.0 / model.mass,
            inverse_inertia: 1.0 / model.inertia(),
            model,
            kick_gain,
        }
    }

    /// Inverse effective mass along `normal` at `arm` (m) from the center, 1/kg: the speed that a unit
    /// impulse gives that point.
    pub(crate) fn inverse_effective_mass(&self, arm: Vector, normal: Vector) -> f32 {
        let turn = arm.perp_dot(normal);
        self.inverse_mass + turn * turn * self.inverse_inertia
    }

    /// The robot as the body that a ball touches at `point` of the field.
    pub(crate) fn contact_body(
        &self,
        motion: &Motion,
        point: Vector,
        surface: Surface,
    ) -> ContactBody {
        let arm = point - motion.position;
        ContactBody {
            velocity: (motion.velocity + arm.perp() * motion.angular_velocity).extend(0.0),
            arm,
            inverse_mass: self.inverse_mass,
            inverse_inertia: self.inverse_inertia,
            surface,
        }
    }
}

impl BodyParameters {
    /// Parameters of the models.
    pub(crate) fn of(config: &SimConfig) -> Self {
        let robots = config.robots().map(|model| RobotParameters::of(model.clone(), 1.0));
        Self::new(config.ball.clone(), robots.collect(), config.tick)
    }

    fn new(ball: BallModel, robots: Vec<RobotParameters>, tick: f32) -> Self {
        let wheels = wheels_of(robots.iter().map(|body| &body.model), tick);
        let mut inertia = vec![BlockInertia::default(); wheels.len()];
        // The ball does not rotate in the plane: its spin has three axes and is kept elsewhere.
        let inverse = InverseInertia { mass: 1.0 / ball.mass, inertia: 0.0 };
        let (block, lane) = place_of(BALL);
        inertia[block].set(lane, inverse, ball.radius);
        for (index, body) in robots.iter().enumerate() {
            let inverse = InverseInertia { mass: body.inverse_mass, inertia: body.inverse_inertia };
            let (block, lane) = place_of(robot(index));
            inertia[block].set(lane, inverse, body.bounding_radius);
        }
        let highest = robots.iter().map(|body| body.model.height).fold(0.0, f32::max);
        let has_mouth = |index: &usize| robots[*index].model.mouth.is_some();
        let mouths = bits_of((0..robots.len()).filter(has_mouth));
        let reach = |body: &RobotParameters| Some(body.model.mouth_reach()? - body.bounding_radius);
        let mouth_reach = robots.iter().filter_map(reach).fold(0.0, f32::max) + ROUNDING;
        Self { ball, robots, wheels, inertia, highest, mouths, mouth_reach }
    }

    /// Inverse inertia of a body.
    pub(crate) fn inverse(&self, body: usize) -> InverseInertia {
        let (block, lane) = place_of(body);
        let block = &self.inertia[block];
        InverseInertia {
            mass: block.inverse_mass.as_array()[lane],
            inertia: block.inverse_inertia.as_array()[lane],
        }
    }

    /// Parameters of the models times a world's own factors: [`BALL_PARAMETERS`], then
    /// [`ROBOT_PARAMETERS`] of each robot.
    pub(crate) fn varied(config: &SimConfig, parameters: &[f32]) -> Result<Self, ConfigError> {
        debug_assert_eq!(parameters.len(), config.parameters_size());
        for (index, factor) in parameters.iter().enumerate() {
            let of_robot = index >= BALL_PARAMETERS.len();
            let may_be_0 = !of_robot && name_of(index) != "mass";
            let least = if may_be_0 { 0.0 } else { 1.0 / MAX_FACTOR };
            if !(least..=MAX_FACTOR).contains(factor) {
                let expected =
                    "a factor from 0.001 to 1000 (0 allowed for the ball, except its mass)";
                return Err(ConfigError::Number { name: name_of(index), expected, got: *factor });
            }
        }
        let (ball, robots) = parameters.split_at(BALL_PARAMETERS.len());
        let ball = varied_ball(&config.ball, ball);
        ball.validate()?;
        let robots = config.robots().zip(robots.chunks_exact(ROBOT_PARAMETERS.len()));
        let robots = robots.map(|(model, parameters)| {
            let body = varied_robot(model, parameters);
            body.model.validate().map(|()| body)
        });
        Ok(Self::new(ball, robots.collect::<Result<_, _>>()?, config.tick))
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

fn varied_ball(model: &BallModel, parameters: &[f32]) -> BallModel {
    let [mass, slide, roll, hop, robot_bounce, robot_friction, wall_bounce, wall_friction] =
        *parameters
    else {
        unreachable!("a ball has {BALL_PARAMETERS:?}")
    };
    let mut ball = model.clone();
    ball.mass *= mass;
    ball.sliding_deceleration *= slide;
    ball.rolling_deceleration *= roll;
    ball.rolling_drag *= roll;
    for (restitution, factor) in [
        (&mut ball.vertical_restitution, hop),
        (&mut ball.robot_restitution, robot_bounce),
        (&mut ball.wall_restitution, wall_bounce),
        (&mut ball.goal_back_restitution, wall_bounce),
    ] {
        *restitution = (*restitution * factor).min(1.0);
    }
    ball.robot_friction *= robot_friction;
    ball.wall_friction *= wall_friction;
    ball.goal_back_friction *= wall_friction;
    ball
}

fn varied_robot(model: &RobotModel, parameters: &[f32]) -> RobotParameters {
    let [mass, height, acceleration, speed, traction, kick, grip] = *parameters else {
        unreachable!("a robot has {ROBOT_PARAMETERS:?}")
    };
    let mut robot = model.clone();
    robot.mass *= mass;
    robot.height *= height;
    match &mut robot.drive {
        Drive::Differential(drive) => {
            drive.motor_torque *= acceleration;
            drive.longitudinal_grip *= acceleration;
            drive.lateral_grip *= traction;
            drive.max_wheel_speed *= speed;
        }
        Drive::Omni(drive) | Drive::OmniWheels(drive) => {
            for limit in [
                &mut drive.max_acceleration,
                &mut drive.max_deceleration,
                &mut drive.max_angular_acceleration,
                &mut drive.max_angular_deceleration,
            ] {
                *limit *= acceleration;
            }
            for limit in
                [&mut drive.max_speed, &mut drive.max_angular_velocity, &mut drive.max_wheel_speed]
            {
                *limit *= speed;
            }
            drive.max_traction *= traction;
        }
    }
    if let Some(mouth) = &mut robot.mouth {
        mouth.dribbler_grip *= grip;
    }
    RobotParameters::of(robot, kick)
}
