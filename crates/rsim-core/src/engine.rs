//! The contact engine behind one match: bodies, walls, and rapier2d that solves what they do to
//! each other. Nothing outside this file knows which engine it is.

use rapier2d::math::{Pose, Rotation, Vector};
use rapier2d::prelude::*;
use serde::{Deserialize, Serialize};

use crate::SimConfig;
use crate::arena;

/// Where a body is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motion {
    pub(crate) position: Vector,
    /// Cosine and sine of the heading.
    pub(crate) heading: Vector,
    pub(crate) velocity: Vector,
    /// rad/s, counter-clockwise.
    pub(crate) spin: f32,
}

/// Bodies of one match. The ball is body 0, robot `i` is body `i + 1`.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Engine {
    parameters: IntegrationParameters,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    handles: Vec<RigidBodyHandle>,
}

/// What the engine works with during a step: one per thread, empty between steps.
pub(crate) struct Scratch {
    pipeline: PhysicsPipeline,
    ccd: CCDSolver,
    // A match has no joints and no soft bodies; the pipeline wants to see that for itself.
    joints: ImpulseJointSet,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            pipeline: PhysicsPipeline::new(),
            ccd: CCDSolver::new(),
            joints: ImpulseJointSet::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
        }
    }
}

/// A body's state left the finite numbers.
#[derive(Debug)]
pub(crate) struct NonFinite;

impl Engine {
    pub(crate) fn new(config: &SimConfig) -> Self {
        let materials = Materials::of(config);
        let mut engine = Self {
            parameters: parameters(config.tick),
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::new(),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            handles: Vec::new(),
        };
        for wall in arena::walls(&config.field) {
            let collider = ColliderBuilder::new(SharedShape::new(wall.shape)).position(wall.pose);
            engine.colliders.insert(materials.wall.apply(collider));
        }
        engine.insert_ball(config, &materials);
        for _ in 0..config.n_robots() {
            engine.insert_robot(config, &materials);
        }
        engine
    }

    fn insert_ball(&mut self, config: &SimConfig, materials: &Materials) {
        let ball = &config.ball;
        // A solid sphere, not the disc that the plane would make of it.
        let inertia = 0.4 * ball.mass * ball.radius * ball.radius;
        let collider = ColliderBuilder::ball(ball.radius).mass_properties(MassProperties::new(
            Vector::ZERO,
            ball.mass,
            inertia,
        ));
        // Seen ahead, so that a fast ball does not pass through a robot between two ticks.
        let body = awake().soft_ccd_prediction(3.0 * ball.radius);
        self.insert(body, materials.ball.apply(collider));
    }

    fn insert_robot(&mut self, config: &SimConfig, materials: &Materials) {
        let half = config.robot.size / 2.0;
        let collider = ColliderBuilder::cuboid(half, half).mass(config.robot.mass);
        self.insert(awake(), materials.robot.apply(collider));
    }

    fn insert(&mut self, body: RigidBodyBuilder, collider: ColliderBuilder) {
        let handle = self.bodies.insert(body);
        self.colliders.insert_with_parent(collider, handle, &mut self.bodies);
        self.handles.push(handle);
    }

    pub(crate) fn motion(&self, body: usize) -> Motion {
        let body = &self.bodies[self.handles[body]];
        let rotation = body.rotation();
        Motion {
            position: body.translation(),
            heading: Vector::new(rotation.re, rotation.im),
            velocity: body.linvel(),
            spin: body.angvel(),
        }
    }

    /// Puts a body somewhere. `heading` must be a unit vector.
    pub(crate) fn set_motion(&mut self, body: usize, motion: &Motion) {
        let body = &mut self.bodies[self.handles[body]];
        let rotation = Rotation { re: motion.heading.x, im: motion.heading.y };
        body.set_position(Pose::from_parts(motion.position, rotation), true);
        body.set_linvel(motion.velocity, true);
        body.set_angvel(motion.spin, true);
    }

    pub(crate) fn set_velocity(&mut self, body: usize, velocity: Vector) {
        self.bodies[self.handles[body]].set_linvel(velocity, true);
    }

    /// Force (N) and torque (N m) on a body during the next tick.
    pub(crate) fn push(&mut self, body: usize, force: Vector, torque: f32) {
        let body = &mut self.bodies[self.handles[body]];
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(force, true);
        body.add_torque(torque, true);
    }

    /// One tick.
    pub(crate) fn step(&mut self, scratch: &mut Scratch) -> Result<(), NonFinite> {
        scratch.pipeline.step(
            Vector::ZERO,
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut scratch.joints,
            &mut scratch.multibodies,
            &mut scratch.soft_bodies,
            &mut scratch.ccd,
            &(),
            &(),
        );
        if scratch.pipeline.quarantine().bodies().is_empty() { Ok(()) } else { Err(NonFinite) }
    }

    /// Pairs of bodies or walls that touch.
    pub(crate) fn contacts(&self) -> usize {
        self.narrow_phase.contact_pairs().filter(|pair| pair.has_any_active_contact()).count()
    }
}

fn awake() -> RigidBodyBuilder {
    // Sleeping would freeze a slowly rolling ball, and a robot that waits for its command.
    RigidBodyBuilder::dynamic().can_sleep(false)
}

/// Settings for bodies of a few centimetres. The engine's defaults suit bodies of a metre.
fn parameters(tick: f32) -> IntegrationParameters {
    IntegrationParameters {
        dt: tick,
        // Scales the engine's tolerances: contacts are predicted 2 mm ahead instead of 20 mm.
        length_unit: 0.1,
        // Stiff: bodies sink in by tenths of a millimetre, measured in crowds (default: 2 to 4 mm).
        contact_softness: SpringCoefficients::new(200.0, 2.0),
        static_contact_softness: SpringCoefficients::new(400.0, 2.0),
        normalized_allowed_linear_error: 0.000_5,
        normalized_max_corrective_velocity: 10.0,
        // Its allowed drift is a quarter of the ball at this scale.
        contact_recycling: false,
        ..IntegrationParameters::default()
    }
}

/// Restitution and friction of a kind of body. The engine multiplies those of a pair.
struct Material {
    restitution: f32,
    friction: f32,
}

impl Material {
    fn apply(&self, collider: ColliderBuilder) -> ColliderBuilder {
        collider
            .restitution(self.restitution)
            .restitution_combine_rule(CoefficientCombineRule::Multiply)
            .friction(self.friction)
            .friction_combine_rule(CoefficientCombineRule::Multiply)
    }
}

/// Factors whose products are the coefficients of each pair: robot-robot, ball-robot and ball-wall
/// come out as configured; robot-wall follows from them.
struct Materials {
    robot: Material,
    ball: Material,
    wall: Material,
}

impl Materials {
    fn of(config: &SimConfig) -> Self {
        let (robot, ball) = (&config.robot, &config.ball);
        let restitution = factors(robot.restitution, ball.robot_restitution, ball.wall_restitution);
        let friction = factors(robot.friction, ball.robot_friction, ball.wall_friction);
        let [robot, ball, wall] = std::array::from_fn(|kind| Material {
            restitution: restitution[kind],
            friction: friction[kind],
        });
        Self { robot, ball, wall }
    }
}

/// Factors (robot, ball, wall) whose products are these coefficients.
fn factors(robot_robot: f32, ball_robot: f32, ball_wall: f32) -> [f32; 3] {
    let robot = robot_robot.sqrt();
    let ball = ball_robot / robot;
    [robot, ball, ball_wall / ball]
}
