//! The ball and robots along a row of square robots: no edge at a joint stops or deflects them, unless it
//! protrudes.

use rsim_core::columns::{BALL_PARAMETERS, ROBOT_PARAMETERS, ball_column};
use rsim_core::scenes::{self, Driver, Scene, deepest_robots, driving, robots};
use rsim_core::{RobotModel, SimConfig};

/// Robots of the row; they stand.
const ROW: usize = 8;

/// Masses of the robots of the row by their model's; a moving robot cannot push heavy ones out of line.
const HEAVY: f32 = 30.0;

/// A row of square robots side by side.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// Between two robots, m.
    gap: f32,
    /// By which every second robot stands out, m.
    step: f32,
    mass: f32,
    /// Direction of the row, degrees.
    turned: f32,
    /// Of the middle of the row, m.
    center: [f32; 2],
}

/// A row in the middle of the field.
const FLUSH: Row = Row { gap: 0.0, step: 0.0, mass: HEAVY, turned: 0.0, center: [0.0; 2] };

impl Row {
    /// A place of the field by its way along the row, from its middle, and its height over it, m.
    fn place(&self, [along, over]: [f32; 2]) -> [f32; 2] {
        let [x, y] = turned([along, over], self.turned);
        [x + self.center[0], y + self.center[1]]
    }

    /// The reverse of `place`.
    fn seen(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        turned([x - self.center[0], y - self.center[1]], -self.turned)
    }

    /// Half the length between the centers of the last robots, m.
    fn half_length(&self) -> f32 {
        (2.0 * half_side() + self.gap) * (ROW as f32 - 1.0) / 2.0
    }

    /// The row and, if there is a command, a robot after it with that pose and command.
    fn scene(&self, moving: Option<([f32; 3], Vec<f32>)>) -> Scene {
        let length = 2.0 * half_side() + self.gap;
        let robots = ROW + usize::from(moving.is_some());
        let config = scenes::vss(robots.div_ceil(2), robots / 2);
        let mut poses: Vec<[f32; 3]> = (0..ROW)
            .map(|nth| {
                let along = nth as f32 * length - self.half_length();
                let [x, y] = self.place([along, self.step * (nth % 2) as f32]);
                [x, y, self.turned + 90.0 * (nth % 4) as f32]
            })
            .collect();
        let mut commands = vec![Vec::new(); ROW];
        if let Some((pose, command)) = moving {
            poses.push(pose);
            commands.push(command);
        }
        let mut scene = Scene::at("row", config, &poses, Driver::Constant(commands));
        let mut parameters = vec![1.0; scene.config.parameters_size()];
        let of_robots =
            parameters[BALL_PARAMETERS.len()..].chunks_exact_mut(ROBOT_PARAMETERS.len());
        of_robots.take(ROW).for_each(|robot| robot[0] = self.mass);
        scene.parameters = Some(parameters);
        scene
    }
}

fn turned([x, y]: [f32; 2], degrees: f32) -> [f32; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

fn half_side() -> f32 {
    RobotModel::VSS_440RPM.front_distance()
}

/// Kinetic energy of the ball with its spin and of robots with `mass` times their model's, J.
fn energy_of(scene: &Scene, mass: f32, state: &[f32]) -> f32 {
    let (ball, model) = (&scene.config.ball, &scene.config.blue[0]);
    let square = |name: &str| {
        let first = ball_column(name);
        state[first..first + 3].iter().map(|part| part * part).sum::<f32>()
    };
    let rolling = 0.4 * ball.radius * ball.radius * square("spin_x");
    // A square plate, by its mass.
    let plate = (2.0 * half_side()).powi(2) / 6.0;
    let robots = robots(state).map(|robot| {
        let [v_x, v_y, angular_velocity] = [robot[4], robot[5], robot[6]];
        mass * (model.mass * (v_x * v_x + v_y * v_y + plate * angular_velocity * angular_velocity))
    });
    f32::midpoint(ball.mass * (square("v_x") + rolling), robots.sum())
}

/// Speeds of a ball that rolls at `speed` (m/s) into the row at an angle (degrees): across before, and across
/// at most and along after the way along the row. Energies are checked.
fn roll(row: &Row, speed: f32, angle: f32) -> [f32; 3] {
    let mut scene = row.scene(None);
    let radius = scene.config.ball.radius;
    let [along, across] = [angle.to_radians().cos() * speed, angle.to_radians().sin() * speed];
    // Over the first robot, lower than one that stands out.
    let start = [-row.half_length() - 0.01, half_side() + radius + 3e-4];
    let velocity = turned([along, -across], row.turned);
    scene.set_ball(row.place(start), velocity);
    scene.set_ball_column("spin_x", -velocity[1] / radius);
    scene.set_ball_column("spin_y", velocity[0] / radius);
    let (mut leaving, mut kept) = (0.0_f32, along);
    let mut energy = energy_of(&scene, row.mass, &scene.start);
    let v_x = ball_column("v_x");
    for state in scene.every_tick((0.65 / speed).min(2.0)) {
        if row.seen([state[0], state[1]])[0] > row.half_length() {
            break;
        }
        let [along, across] = turned([state[v_x], state[v_x + 1]], -row.turned);
        (leaving, kept) = (leaving.max(across), along);
        let now = energy_of(&scene, row.mass, &state);
        assert!(now <= energy * 1.0001, "{row:?} {speed} {angle}: from {energy} J to {now} J");
        energy = now;
    }
    [across, leaving, kept]
}

/// Share of the way along the row that a robot makes, which drives into it at an angle (degrees), and the
/// maximum angle by which it is turned, degrees.
fn slide(row: &Row, speed: f32, angle: f32) -> [f32; 2] {
    let (half, model) = (half_side(), RobotModel::VSS_440RPM);
    let clear = 5e-4 + half * angle.to_radians().sin() + row.step;
    let [x, y] = row.place([-row.half_length(), 2.0 * half + clear]);
    let heading = row.turned - angle;
    let velocity = turned([speed, 0.0], heading);
    let mut scene = row.scene(Some(([x, y, heading], driving(&model, heading, velocity))));
    scene.set_ball([0.6, -0.6], [0.0, 0.0]);
    scene.set_velocity(ROW, velocity);
    let way = 2.0 * row.half_length();
    let (mut turn, mut made) = (0.0_f32, 0.0);
    for state in scene.every_tick(way / speed) {
        let robot = robots(&state).nth(ROW).expect("it moves");
        let [cos, sin] = turned([robot[2], robot[3]], -heading);
        turn = turn.max(sin.atan2(cos).to_degrees().abs());
        made = row.seen([robot[0], robot[1]])[0] + row.half_length();
        let depth = deepest_robots(&scene.config, &state);
        assert!(depth < 1e-3, "{row:?} {speed} {angle}: {depth} m in each other");
    }
    [made / way, turn]
}

const GAPS: [f32; 4] = [0.0, 1e-4, 3e-4, 1e-3];
const DIRECTIONS: [f32; 4] = [0.0, 17.0, 90.0, 200.0];

/// It left the row at up to 13 times its speed across: at each joint it hit the edge of the next robot.
#[test]
fn a_ball_along_a_row_left_it_faster_than_it_came() {
    for (mass, angles) in [(HEAVY, [0.5, 1.0, 2.0, 5.0].as_slice()), (1.0, &[0.5, 1.0, 2.0])] {
        for gap in GAPS {
            for turned in DIRECTIONS {
                let row = Row { gap, mass, turned, ..FLUSH };
                for speed in [0.5, 1.0, 2.0, 5.0] {
                    for angle in angles.iter().copied() {
                        let [across, leaving, along] = roll(&row, speed, angle);
                        let label = format!("{row:?}, {speed} m/s, {angle} degrees");
                        assert!(leaving < 0.6 * across + 1e-3, "{label}: {across} to {leaving}");
                        assert!(along > 0.5 * speed, "{label}: slowed to {along} m/s");
                    }
                }
            }
        }
    }
}

/// It was caught at a joint, turned by 90 degrees and made 30% of its way.
#[test]
fn a_robot_along_a_row_was_caught_at_a_joint() {
    let wall = SimConfig { tick: 0.005, ..scenes::vss(1, 0) }.field.max_y();
    let at_wall = Row { mass: 1.0, center: [0.0, half_side() - wall], ..FLUSH };
    let rows = DIRECTIONS.map(|turned| Row { turned, ..FLUSH }).into_iter().chain([at_wall]);
    for row in rows {
        for gap in GAPS {
            for (speed, angle) in [0.2, 0.5, 1.1]
                .into_iter()
                .flat_map(|speed| [0.0, 0.5, 2.0, 5.0].map(|a| (speed, a)))
            {
                let row = Row { gap, ..row };
                let [made, turn] = slide(&row, speed, angle);
                let label = format!("{row:?}, {speed} m/s, {angle} degrees");
                assert!(made > 0.97, "{label}: {made} of its way");
                assert!(turn < angle + 1.0, "{label}: turned by {turn} degrees");
            }
        }
    }
}

/// Robots out of line by less than an edge protrudes are a flush row.
#[test]
fn edges_of_a_tenth_of_a_millimeter_do_not_count() {
    for turned in DIRECTIONS {
        let row = Row { step: 1e-4, turned, ..FLUSH };
        for speed in [0.5, 1.0] {
            let [made, _] = slide(&row, speed, 1.0);
            assert!(made > 0.97, "{row:?}, {speed} m/s: {made} of its way");
            let [across, leaving, _] = roll(&row, speed, 1.0);
            assert!(leaving < across, "{row:?}, {speed} m/s: {across} to {leaving}");
        }
    }
}

/// An edge that protrudes deflects the ball along its normal there, and stops a robot.
#[test]
fn edges_that_protrude_are_solid() {
    for step in [1e-3, 3e-3] {
        for turned in DIRECTIONS {
            let row = Row { step, turned, ..FLUSH };
            let [_, leaving, along] = roll(&row, 2.0, 0.5);
            assert!(leaving > 0.2, "{row:?}: leaves at {leaving} m/s");
            assert!(along > 0.0, "{row:?}: thrown back at {along} m/s");
            let [made, _] = slide(&row, 0.5, 1.0);
            assert!(made < 0.9, "{row:?}: {made} of its way");
        }
    }
}

/// Two faces that pass each other never meet, though one engine predicts contacts around corners.
#[test]
fn a_robot_that_passed_others_without_touching_was_caught() {
    for turned in DIRECTIONS {
        for speed in [0.5, 1.1] {
            let row = Row { turned, ..FLUSH };
            let [made, turn] = slide(&row, speed, 0.0);
            assert!(made > 0.99 && turn < 0.01, "{row:?}, {speed} m/s: {made}, {turn} degrees");
        }
    }
}
