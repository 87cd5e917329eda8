//! Robots that drive the ball into a corner, on the floor and in the air.

use rsim_core::columns::ball_column;
use rsim_core::scenes::{self, Driver, Scene, deepest_ball, deepest_robots, driving};
use rsim_core::{Body, Field, RobotModel, SimConfig};

const TICKS: [f32; 2] = [0.005, 0.0025];

/// Robots one behind the other along a diagonal, driving the ball into a corner.
#[derive(Debug, Clone, Copy)]
struct Corner {
    robots: usize,
    /// Of x and y of the corner.
    signs: [f32; 2],
    /// Of the ball's lowest point, m.
    z: f32,
    speed: f32,
    tick: f32,
}

/// Angle between heading and driving direction of round robots, degrees. The sides of a robot would reach
/// the walls before its flat front reaches a ball in a corner.
const TURNED: f32 = 120.0;

impl Corner {
    fn scene(&self, config: SimConfig) -> Scene {
        let config = SimConfig { tick: self.tick, ..config };
        let (model, radius) = (config.blue[0].clone(), config.ball.radius);
        let diagonal = std::f32::consts::FRAC_1_SQRT_2;
        let (field, clear) = (&config.field, 0.002);
        // The ball lies at both walls, or at the middle of the block in the corner.
        let inset = if field.corner_leg > 0.0 {
            field.corner_leg / 2.0 + (radius + clear) * diagonal
        } else {
            radius + clear
        };
        let end = field.half_length() + field.goal_line_margin;
        let ball = [end - inset, field.max_y() - inset];
        let length = 2.0 * behind(&model) + 0.01;
        let [x, y] = self.signs;
        let turned = if matches!(model.body, Body::Round { .. }) { TURNED } else { 0.0 };
        let degrees = y.atan2(x).to_degrees() + turned;
        let poses: Vec<_> = (0..self.robots)
            .map(|nth| {
                let away = behind(&model) + radius + 0.01 + length * nth as f32;
                let away = diagonal * away;
                [x * (ball[0] - away), y * (ball[1] - away), degrees]
            })
            .collect();
        let velocity = [x, y].map(|sign| sign * diagonal * self.speed);
        let commands = vec![driving(&model, degrees, velocity); self.robots];
        let mut scene = Scene::at("corner", config, &poses, Driver::Constant(commands));
        scene.set_ball([x * ball[0], y * ball[1]], [0.0, 0.0]);
        scene.set_ball_column("z", self.z);
        (0..self.robots).for_each(|robot| scene.set_velocity(robot, velocity));
        scene
    }

    /// Checks the overlap of robots, and the ball's velocity against its motion.
    fn check(&self, config: &SimConfig) {
        let scene = self.scene(config.clone());
        let rows = scene.every_tick(1.5);
        let depth = rows.iter().map(|row| deepest_robots(config, row)).fold(0.0, f32::max);
        assert!(depth > -5e-4, "{self:?}: they never met");
        assert!(depth <= 3e-3, "{self:?}: robots {depth} m in each other");
        for (tick, three) in rows.windows(3).enumerate() {
            let way = |a: &[f32], b: &[f32]| (b[0] - a[0]).hypot(b[1] - a[1]) / self.tick;
            // A ball that is hit at the end of a tick moves in the next.
            let moved = way(&three[0], &three[1]).max(way(&three[1], &three[2]));
            let [v_x, v_y] = ["v_x", "v_y"].map(|name| three[1][ball_column(name)]);
            let settled = tick as f32 * self.tick > 0.5;
            let most = if settled { moved + 0.05 } else { 0.3 };
            let lying = moved < 0.05 && v_x.hypot(v_y) < most;
            let rolling = moved >= 0.05 && (!settled || v_x.hypot(v_y) < most);
            assert!(lying || rolling, "{self:?}, tick {tick}: {moved} m/s and says {v_x} {v_y}");
        }
        if self.z == 0.0 {
            let inside = rows.iter().map(|row| deepest_ball(config, row)).fold(0.0, f32::max);
            assert!(inside <= 5e-3, "{self:?}: the ball is {inside} m in a robot");
        }
    }
}

/// Distance from a robot's center to its round side, or to its back.
fn behind(model: &RobotModel) -> f32 {
    match model.body {
        Body::Round { radius, .. } => radius,
        Body::Square { side_length: side } => side / 2.0,
    }
}

const CORNERS: [[f32; 2]; 4] = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];

fn check_corners(config: impl Fn(usize) -> SimConfig, speed: f32, heights: &[f32]) {
    for robots in [3, 4] {
        for signs in CORNERS {
            for z in heights.iter().copied() {
                for tick in TICKS {
                    Corner { robots, signs, z, speed, tick }.check(&config(robots));
                }
            }
        }
    }
}

fn ssl(robots: usize) -> SimConfig {
    SimConfig { field: Field::SSL_B, ..scenes::ssl(robots, 0) }
}

fn vss(robots: usize) -> SimConfig {
    scenes::vss(robots, 0)
}

#[test]
fn robots_in_line_push_a_ball_on_the_floor_into_a_corner_and_stay_solid() {
    check_corners(ssl, 2.0, &[0.0]);
    check_corners(vss, 1.2, &[0.0]);
}

#[test]
fn a_flying_ball_in_a_corner_pushed_robots_into_each_other() {
    check_corners(ssl, 2.0, &[0.03, 0.05, 0.08, 0.115]);
}

/// A ball that ran off a robot's cover was pushed against the wall, got faster, and did not move.
#[test]
fn a_ball_between_a_cover_and_the_wall_had_a_velocity_without_motion() {
    check_corners(ssl, 2.0, &[0.145, 0.16]);
}

#[test]
fn a_flying_ball_in_a_corner_pushed_vsss_robots_into_each_other() {
    check_corners(vss, 1.2, &[0.03, 0.05, 0.08, 0.15]);
}
