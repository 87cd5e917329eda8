//! The ball along a row of square robots of their own mass, which it pushes out of line: it leaves the row faster
//! than it came only at an edge that it made by its push.

use rsim_core::columns::{ball_column, robot_column};
use rsim_core::scenes::{self, Driver, Scene, robots};
use rsim_core::{BallModel, RobotModel};

/// Robots of the row; they stand side by side.
const ROW: u8 = 8;

/// A ball that rolls into a row.
#[derive(Debug, Clone, Copy)]
struct Roll<'a> {
    model: &'a RobotModel,
    /// Between two robots, m.
    gap: f32,
    /// Direction of the row, degrees.
    turned: f32,
    /// Of the ball, m/s.
    speed: f32,
    /// To the row, degrees.
    angle: f32,
    /// From the middle of the first robot, m.
    start: f32,
}

/// Motion of a ball along a row.
#[derive(Debug, Clone, Copy)]
struct Outcome {
    /// Speed across the row before it met it, m/s.
    across: f32,
    /// Maximum speed away from the row, m/s.
    leaving: f32,
    /// Height of the highest edge that it came to, m.
    edge: f32,
}

impl Roll<'_> {
    fn half_side(&self) -> f32 {
        self.model.front_distance()
    }

    /// Half the length between the centers of the last robots, m.
    fn half_length(&self) -> f32 {
        (2.0 * self.half_side() + self.gap) * f32::from(ROW - 1) / 2.0
    }

    fn scene(&self) -> Scene {
        let mut config = scenes::vss(usize::from(ROW / 2), usize::from(ROW / 2));
        config.blue.fill(self.model.clone());
        config.yellow.fill(self.model.clone());
        let length = 2.0 * self.half_side() + self.gap;
        let poses: Vec<[f32; 3]> = (0..ROW)
            .map(|nth| {
                let along = f32::from(nth) * length - self.half_length();
                let [x, y] = turned([along, 0.0], self.turned);
                [x, y, self.turned + 90.0 * f32::from(nth % 4)]
            })
            .collect();
        let mut scene = Scene::at("pushed_row", config, &poses, Driver::STILL);
        let radius = scene.config.ball.radius;
        let (sin, cos) = self.angle.to_radians().sin_cos();
        let velocity = turned([cos * self.speed, -sin * self.speed], self.turned);
        let start = [self.start - self.half_length(), self.half_side() + radius + 3e-4];
        scene.set_ball(turned(start, self.turned), velocity);
        scene.set_ball_column("spin_x", -velocity[1] / radius);
        scene.set_ball_column("spin_y", velocity[0] / radius);
        scene
    }

    fn play(&self) -> Outcome {
        let across = self.angle.to_radians().sin() * self.speed;
        let mut outcome = Outcome { across, leaving: 0.0, edge: 0.0 };
        let v_x = ball_column("v_x");
        for state in self.scene().every_tick(0.65 / self.speed) {
            let [x, _] = turned([state[0], state[1]], -self.turned);
            if x > self.half_length() {
                break;
            }
            outcome.edge = outcome.edge.max(self.edge_at(&state, x));
            let [_, leaving] = turned([state[v_x], state[v_x + 1]], -self.turned);
            outcome.leaving = outcome.leaving.max(leaving);
        }
        outcome
    }

    /// Height of a robot's edge above the face before it, m, at the joint nearest to `x` along the row.
    fn edge_at(&self, state: &[f32], x: f32) -> f32 {
        let corners: Vec<_> = robots(state).map(|robot| self.upper_corners(robot)).collect();
        let joints = corners.windows(2).map(|pair| (pair[0][1], pair[1][0]));
        let away = |corner: [f32; 2]| (corner[0] - x).abs();
        let nearest = joints.min_by(|one, other| away(one.1).total_cmp(&away(other.1)));
        nearest.map_or(0.0, |(before, after)| after[1] - before[1])
    }

    /// The corners of a robot at the ball's side of the row, in the direction of the row.
    fn upper_corners(&self, robot: &[f32]) -> [[f32; 2]; 2] {
        let [x, y, cos, sin] = ["x", "y", "cos", "sin"].map(|name| robot[robot_column(name)]);
        let center = turned([x, y], -self.turned);
        // Squares look alike after a quarter of a turn.
        let tilt = (sin.atan2(cos).to_degrees() - self.turned + 45.0).rem_euclid(90.0) - 45.0;
        let half = self.half_side();
        [-half, half].map(|along| {
            let corner = turned([along, half], tilt);
            [center[0] + corner[0], center[1] + corner[1]]
        })
    }
}

fn turned([x, y]: [f32; 2], degrees: f32) -> [f32; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

/// Calls `visit` with balls of many speeds, angles and starts.
fn for_each_roll(visit: &mut impl FnMut(&Roll)) {
    for model in [RobotModel::VSS_440RPM, RobotModel::VSS_650RPM] {
        for speed in [1.0, 2.0, 4.0, 6.0] {
            for angle in [0.5, 1.0, 2.0, 4.0, 7.0, 12.0, 20.0] {
                for gap in [0.0, 3e-4, 1e-3] {
                    for nth in 0..6_u8 {
                        let turned = [0.0, 17.0, 90.0][usize::from(nth % 3)];
                        let start = 0.0125 * f32::from(nth) - 0.01;
                        visit(&Roll { model: &model, gap, turned, speed, angle, start });
                    }
                }
            }
        }
    }
}

/// Height from which an edge counts, m.
const PROTRUDING: f32 = 5e-4;

/// Maximum restitution of a ball and a robot.
const RESTITUTION: f32 = 0.6;

/// Maximum speed across a row, m/s, of a ball that rolls along it at `speed` and hits an edge of that height: its
/// normal there is inclined, at most by 45 degrees for the most speed.
fn kick(speed: f32, edge: f32) -> f32 {
    let cos = (1.0 - edge / BallModel::VSS_RSIM.radius).max(std::f32::consts::FRAC_1_SQRT_2);
    (1.0 + RESTITUTION) * speed * cos * (1.0 - cos * cos).sqrt()
}

/// Of these balls 22% (rapier: 16%) left the row faster than by their restitution, since a ball stayed at the robot
/// that it pushed until the tick of its bounce ended. With ticks of 0.25 ms 8 or 9% do.
#[test]
fn a_ball_along_a_row_fell_behind_the_robots_that_it_pushed() {
    let (mut all, mut kicked) = (0, 0);
    for_each_roll(&mut |roll| {
        let outcome = roll.play();
        let Outcome { across, leaving, edge } = outcome;
        let bounced = RESTITUTION * across + 1e-3;
        let label = format!("{roll:?}: {outcome:?}");
        all += 1;
        if leaving > bounced {
            kicked += 1;
            assert!(edge > PROTRUDING, "{label}, without an edge");
            assert!(leaving < kick(roll.speed, edge), "{label}, faster than off its edge");
        }
    });
    assert!(kicked > 0 && kicked * 8 < all, "{kicked} of {all} balls left the row faster");
}
