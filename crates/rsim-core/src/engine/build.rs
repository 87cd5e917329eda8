//! Which bodies and walls a match has, and the engine's settings for bodies of a few centimetres.

use rapier2d::math::Vector;
use rapier2d::prelude::*;

use super::{BALL_LABEL, Engine, Inverse, Motion, Partner, Push, label};
use crate::SimConfig;
use crate::arena::Wall;
use crate::physique::Physique;
use crate::placement::FASTEST;
use crate::robot_model::Body;

impl Engine {
    pub(crate) fn new(config: &SimConfig, physique: &Physique, walls: &[Wall]) -> Self {
        let mut engine = Self {
            parameters: parameters(config.tick),
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::with_optimization_strategy(BvhOptimizationStrategy::None),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            handles: Vec::new(),
            motions: Vec::new(),
            pushes: Vec::new(),
            inverses: Vec::new(),
            ball_mass: physique.ball.mass,
            moved: Vec::new(),
            clear: false,
            skips: true,
            skipped: 0,
        };
        engine.insert_ball(physique, config.tick);
        for index in 0..physique.robots.len() {
            engine.insert_robot(physique, index);
        }
        for (index, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.stands_on_floor()) {
            let collider = ColliderBuilder::new(SharedShape::new(wall.shape()))
                .position(wall.pose)
                .restitution(0.0)
                .friction(WALL_FRICTION);
            engine.colliders.insert(collider.user_data(label(Partner::Wall(index))));
        }
        engine.fit(physique);
        engine
    }

    fn insert_ball(&mut self, physique: &Physique, tick: f32) {
        let ball = &physique.ball;
        // Its bounce and friction are solved in closed form, and its spin has three axes: the engine
        // only keeps it out of others.
        let collider = ColliderBuilder::ball(ball.radius)
            .restitution(0.0)
            .restitution_combine_rule(CoefficientCombineRule::Min)
            .friction(0.0)
            .friction_combine_rule(CoefficientCombineRule::Min)
            .active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS | ActiveHooks::MODIFY_SOLVER_CONTACTS)
            .user_data(BALL_LABEL);
        // Seen ahead, so that the fastest ball does not pass through a robot between two ticks.
        let body = awake().soft_ccd_prediction(FASTER * FASTEST * tick).lock_rotations();
        self.insert(body, collider);
    }

    fn insert_robot(&mut self, physique: &Physique, index: usize) {
        let model = &physique.robots[index].model;
        let shape = match model.body {
            Body::Square { side } => SharedShape::cuboid(side / 2.0, side / 2.0),
            // Among robots and walls the cheapest shape does; the ball meets the true outline.
            Body::Round { radius, .. } => SharedShape::ball(radius),
        };
        // Nothing bounces for the engine: it would bounce one point of a contact after the other, which
        // turns two squares that meet face to face.
        let collider = ColliderBuilder::new(shape)
            .restitution(0.0)
            .friction(model.friction)
            .user_data(label(Partner::Robot(index)));
        self.insert(awake(), collider);
    }

    fn insert(&mut self, body: RigidBodyBuilder, collider: ColliderBuilder) {
        let handle = self.bodies.insert(body);
        self.colliders.insert_with_parent(collider, handle, &mut self.bodies);
        self.handles.push(handle);
        self.motions.push(Motion {
            position: Vector::ZERO,
            heading: Vector::X,
            velocity: Vector::ZERO,
            spin: 0.0,
        });
        self.pushes.push(Push::default());
        self.inverses.push(Inverse::default());
        self.moved.push(false);
    }
}

/// Robots against walls, averaged with the robot's own: as robots against robots. Nobody has
/// published how a robot slides along a wall.
const WALL_FRICTION: f32 = 0.2;

fn awake() -> RigidBodyBuilder {
    // Sleeping would freeze a slowly rolling ball, and a robot that waits for its command.
    RigidBodyBuilder::dynamic().can_sleep(false)
}

/// Sub-steps of the solver in a tick. `cargo bench -p rsim-bench --bench solver` shows what fewer
/// and more give.
const SUB_STEPS: usize = 4;

/// Bodies are seen so far ahead, by the way that the fastest robot drives in a tick: what two that
/// drive at each other close in one, and a tenth. Also bodies at rest are, since others may push them
/// along within the tick. Seen 8 mm ahead, and along their own ways, robots that chase a ball came now
/// and then 12 mm into each other; so they come 3 mm.
pub(super) const SEEN_AHEAD: f32 = 2.2;

/// The least, m, for slow robots whose corners spin.
pub(super) const SEEN_LEAST: f32 = 0.008;

/// Passes over all contacts in each sub-step, and while a ball is jammed between bodies that weigh
/// twice as much: with one, three robots in line at 2.8 m/s sink 4.0 mm into a ball at a wall, with
/// four 2.1 mm.
pub(super) const PASSES: usize = 1;
pub(super) const PASSES_JAMMED: usize = 4;

/// Fastest ball that is seen to meet others, by what a start may have: balls that bounce between
/// robots that meet get faster.
const FASTER: f32 = 3.0;

/// Scales the engine's tolerances, here to a tenth.
pub(super) const LENGTH_UNIT: f32 = 0.1;

/// Settings for bodies of a few centimetres. The engine's defaults suit bodies of a metre.
fn parameters(tick: f32) -> IntegrationParameters {
    IntegrationParameters {
        dt: tick,
        num_solver_iterations: SUB_STEPS,
        length_unit: LENGTH_UNIT,
        // Stiff: bodies sink in by tenths of a millimetre, measured in crowds (default: 2 to 4 mm).
        contact_softness: SpringCoefficients::new(200.0, 2.0),
        static_contact_softness: SpringCoefficients::new(400.0, 2.0),
        normalized_allowed_linear_error: 0.000_5,
        normalized_max_corrective_velocity: 10.0,
        // It would stop the ball where the larger one that the engine sees touches a wall.
        max_ccd_substeps: 0,
        // Its allowed drift is a quarter of the ball at this scale.
        contact_recycling: false,
        ..IntegrationParameters::default()
    }
}
