//! Bodies and walls in rapier, and settings for bodies of a few centimeters.

use rapier2d::dynamics::{
    CoefficientCombineRule, IntegrationParameters, IslandManager, RigidBodyBuilder, RigidBodySet,
};
use rapier2d::geometry::{
    BroadPhaseBvh, BvhOptimizationStrategy, ColliderBuilder, ColliderSet, NarrowPhase, SharedShape,
};
use rapier2d::pipeline::ActiveHooks;
use rapier2d::prelude::SpringCoefficients;

use super::RapierSolver;
use super::report::{BALL_LABEL, label};
use crate::body_parameters::BodyParameters;
use crate::columns::MAX_PLACED_SPEED;
use crate::engine::contacts::Partner;
use crate::engine::{SUB_STEPS, Shape, WALL_FRICTION};
use crate::geometry::arena::Wall;
use crate::models::config::SimConfig;
use crate::models::robot::Body;

impl RapierSolver {
    pub(in crate::engine) fn new(
        config: &SimConfig,
        parameters: &BodyParameters,
        walls: &[Wall],
    ) -> Self {
        let mut solver = Self {
            integration: integration_parameters(config.tick),
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::with_optimization_strategy(BvhOptimizationStrategy::None),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            handles: Vec::new(),
            moved: 0,
            ball_mass: parameters.ball.mass,
        };
        solver.insert_ball(parameters, config.tick);
        for index in 0..parameters.robots.len() {
            solver.insert_robot(parameters, index);
        }
        for (index, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.stands_on_floor()) {
            let collider = ColliderBuilder::new(Shape::of_wall(wall).0)
                .position(wall.pose)
                .restitution(0.0)
                .friction(WALL_FRICTION);
            solver.colliders.insert(collider.user_data(label(Partner::Wall(index))));
        }
        solver.set_parameters(parameters);
        solver
    }

    fn insert_ball(&mut self, parameters: &BodyParameters, tick: f32) {
        let ball = &parameters.ball;
        // Bounce and friction of the ball are solved in closed form, and its spin has three axes: the
        // engine only keeps the ball out of other bodies.
        let collider = ColliderBuilder::new(SharedShape::ball(ball.radius))
            .restitution(0.0)
            .restitution_combine_rule(CoefficientCombineRule::Min)
            .friction(0.0)
            .friction_combine_rule(CoefficientCombineRule::Min)
            .active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS | ActiveHooks::MODIFY_SOLVER_CONTACTS)
            .user_data(BALL_LABEL);
        // Predicted ahead, so that the fastest ball does not pass through a robot between two ticks.
        let prediction = MAX_BALL_SPEED_FACTOR * MAX_PLACED_SPEED * tick;
        let body = awake_body().soft_ccd_prediction(prediction).lock_rotations();
        self.insert(body, collider);
    }

    fn insert_robot(&mut self, parameters: &BodyParameters, index: usize) {
        let model = &parameters.robots[index].model;
        // The engine would bounce one point of a contact after the other, which turns two squares that
        // meet face to face. So nothing bounces in the solver.
        let collider = ColliderBuilder::new(Shape::of_robot(model.body).0)
            .restitution(0.0)
            .friction(model.friction)
            .user_data(label(Partner::Robot(index)));
        let collider = match model.body {
            Body::Square { .. } => collider.active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS),
            Body::Round { .. } => collider,
        };
        self.insert(awake_body(), collider);
    }

    fn insert(&mut self, body: RigidBodyBuilder, collider: ColliderBuilder) {
        let handle = self.bodies.insert(body);
        self.colliders.insert_with_parent(collider, handle, &mut self.bodies);
        self.handles.push(handle);
    }
}

/// A body that never sleeps: sleep would freeze a slowly rolling ball, and a robot that waits for its
/// command.
fn awake_body() -> RigidBodyBuilder {
    RigidBodyBuilder::dynamic().can_sleep(false)
}

/// Prediction distance of contacts, by the distance that the fastest robot drives in a tick: the
/// distance that two robots which drive at each other close in a tick, and a tenth. It holds around
/// bodies at rest too, since others may push them along within the tick. With 8 mm, predicted along
/// their own paths, robots that chase a ball sometimes overlapped by 12 mm; with this distance, by 3.
pub(super) const PREDICTION_FACTOR: f32 = 2.2;

/// Minimum prediction distance, m, for slow robots whose corners spin.
pub(super) const MIN_PREDICTION: f32 = 0.008;

/// Passes over all contacts in each sub-step, usually and while a ball is jammed between bodies that
/// weigh twice as much: with one pass, three robots in line at 2.8 m/s sink 4.0 mm into a ball at a
/// wall, with four 2.1 mm.
pub(super) const SOLVER_PASSES: usize = 1;
pub(super) const SOLVER_PASSES_JAMMED: usize = 4;

/// Speed of the fastest ball whose contacts are predicted, by the maximum speed of a start: a ball that
/// bounces between robots which meet gets faster.
const MAX_BALL_SPEED_FACTOR: f32 = 3.0;

/// Scale of the engine's tolerances, a tenth of their default.
pub(super) const LENGTH_UNIT: f32 = 0.1;

/// Settings for bodies of a few centimeters; the engine's defaults suit bodies of a meter.
fn integration_parameters(tick: f32) -> IntegrationParameters {
    IntegrationParameters {
        dt: tick,
        num_solver_iterations: SUB_STEPS,
        length_unit: LENGTH_UNIT,
        // Stiff: bodies sink in by tenths of a millimeter, measured in crowds (default: 2 to 4 mm).
        contact_softness: SpringCoefficients::new(200.0, 2.0),
        static_contact_softness: SpringCoefficients::new(400.0, 2.0),
        normalized_allowed_linear_error: 0.000_5,
        normalized_max_corrective_velocity: 10.0,
        // Continuous detection would stop the ball where its larger collider touches a wall.
        max_ccd_substeps: 0,
        // The drift that recycling allows is a quarter of the ball at this scale.
        contact_recycling: false,
        ..IntegrationParameters::default()
    }
}
