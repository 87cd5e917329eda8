//! Collisions of robots: speeds after them, and the reaction of the wheels.

use rsim_core::columns::robot_column;
use rsim_core::scenes::{self, Driver, Scene, deepest_robots, kinetic_energy, robots, uniform};
use rsim_core::{EngineKind, RobotModel, SimConfig};

const TICKS: [f32; 2] = [0.005, 0.0025];

/// Two squares that approach along x, face to face, commanded to drive on at `wheel_speed` rad/s.
fn face_to_face(model: &RobotModel, tick: f32, speed: f32, gap: f32, wheel_speed: f32) -> Scene {
    let config = scenes::vss(1, 1);
    let team = vec![model.clone()];
    let config = SimConfig { tick, blue: team.clone(), yellow: team, ..config };
    let away = model.front_distance() + gap / 2.0;
    let poses = [[-away, 0.0, 0.0], [away, 0.0, 180.0]];
    let driver = Driver::Constant(vec![vec![wheel_speed; 2]; 2]);
    let mut scene = Scene::at("face_to_face", config, &poses, driver);
    scene.set_ball([0.0, 0.6], [0.0, 0.0]);
    scene.set_robot_column(0, "v_x", speed);
    scene.set_robot_column(1, "v_x", -speed);
    scene
}

/// Plays squares of `models` that meet face to face, in ticks of one of `ticks`. From `after` on (s),
/// they must not turn; they must never slide off each other.
fn check_faces(models: &[RobotModel], ticks: &[f32], after: f32) {
    for model in models {
        for (tick, speed) in ticks.iter().flat_map(|tick| SPEEDS.map(|speed| (*tick, speed))) {
            for (gap, wheel_speed) in
                [(0.0, 46.0), (0.0, 20.0), (0.003, 20.0), (0.05, 46.0), (0.001, 0.0)]
            {
                let scene = face_to_face(model, tick, speed, gap, wheel_speed);
                let label = format!("{} {tick} s {speed} m/s {gap} m {wheel_speed}", model.name);
                check_face(&scene, after, &label);
            }
        }
    }
}

const SPEEDS: [f32; 6] = [0.2, 0.3, 0.5, 0.7, 0.9, 1.2];

fn check_face(scene: &Scene, after: f32, label: &str) {
    let rows = scene.every_tick(2.0);
    let touched = rows.iter().any(|row| deepest_robots(&scene.config, row) > -2e-4);
    assert!(touched, "{label}: they never met");
    for (tick, row) in rows.iter().enumerate() {
        for robot in robots(row) {
            let turns = robot[6].abs() > 0.05 && tick as f32 * scene.config.tick >= after;
            assert!(!turns, "{label}: tick {tick}: {} rad/s", robot[6]);
            assert!(robot[1].abs() < 5e-4, "{label}: {} m aside", robot[1]);
        }
    }
}

#[test]
fn squares_that_met_face_to_face_turned() {
    check_faces(&[RobotModel::VSS_440RPM], &TICKS[..1], 0.0);
}

#[test]
fn squares_that_met_face_to_face_slid_off_each_other() {
    check_faces(&[RobotModel::VSS_440RPM, RobotModel::VSS_650RPM], &TICKS, 0.3);
}

/// A face with the smallest misalignment touches with a corner first, and is flush after a few ticks.
#[test]
fn squares_that_meet_face_to_face_never_turn_by_half_a_degree() {
    for model in [RobotModel::VSS_440RPM, RobotModel::VSS_650RPM] {
        for (tick, speed) in TICKS.iter().flat_map(|tick| SPEEDS.map(|speed| (*tick, speed))) {
            let scene = face_to_face(&model, tick, speed, 0.0, 46.0);
            for row in scene.every_tick(1.0) {
                for robot in robots(&row) {
                    let sin = robot[3];
                    assert!(sin.abs() < 0.009, "{} {tick} s {speed} m/s: {sin}", model.name);
                }
            }
        }
    }
}

/// A fast robot that hits a spinning or standing one, both commanded to stand.
fn crash(config: SimConfig, nth: u64) -> Scene {
    let draw = |part: u64| uniform(nth * 16 + part);
    let vss = config.blue[0].mouth.is_none();
    let near = 2.2 * config.blue[0].bounding_radius();
    let poses = [
        [-near * (0.75 + 0.2 * draw(0)), 0.3 * near * draw(1), 180.0 * draw(2)],
        [near * 0.5, 0.3 * near * draw(3), 180.0 * draw(4)],
    ];
    let mut scene = Scene::at("crash", config, &poses, Driver::STILL);
    scene.set_ball([0.0, 0.6], [0.0, 0.0]);
    let speed = if vss { 1.5 } else { 2.5 } + 0.8 * draw(5);
    scene.set_robot_column(0, "v_x", speed);
    scene.set_robot_column(0, "v_theta", if vss { 15.0 } else { 6.0 } * draw(6));
    scene.set_robot_column(1, "v_x", 0.3 * speed * draw(7));
    scene.set_robot_column(1, "v_theta", if vss { 20.0 } else { 8.0 } * draw(8));
    scene
}

/// Plays crashes and counts those in which robots met.
fn check_crashes(config: &SimConfig, check: impl Fn(&Scene, &[Vec<f32>], &str)) {
    let (mut met, collision_speed) = (0, robot_column("collision_speed"));
    for nth in 0..200 {
        let tick = TICKS[usize::from(nth % 2 == 1)];
        let scene = crash(SimConfig { tick, ..config.clone() }, nth);
        let rows = scene.every_tick(0.3);
        met += usize::from(
            rows.iter().any(|row| robots(row).any(|robot| robot[collision_speed] > 0.3)),
        );
        check(&scene, &rows, &format!("{} {nth}", scene.config.blue[0].name));
    }
    assert!(met > 120, "only {met} met");
}

fn both_leagues() -> [SimConfig; 3] {
    let mut faster = scenes::vss(1, 1);
    (faster.blue, faster.yellow) = (vec![RobotModel::VSS_650RPM], vec![RobotModel::VSS_650RPM]);
    [scenes::vss(1, 1), faster, scenes::ssl(1, 1)]
}

#[test]
fn robots_commanded_to_stand_gained_energy_after_a_crash() {
    for config in both_leagues() {
        check_crashes(&config, |scene, rows, label| {
            let energies: Vec<f32> =
                rows.iter().map(|row| kinetic_energy(&scene.config, row)).collect();
            for (tick, pair) in energies.windows(2).enumerate() {
                let risen = (pair[1] - pair[0]) / energies[0];
                assert!(risen < 1e-4, "{label}, tick {tick}: energy rises by {risen}");
            }
        });
    }
}

#[test]
fn the_load_of_a_crash_was_compensated_in_the_next_tick() {
    // A robot without contact that is commanded to stand only slows down. A corner that rubs on it may leave slowly
    // within a tick: a lasting contact, whose small load is compensated for one more tick. The load of a crash would
    // give 0.03 m/s and 1 rad/s in a tick.
    let (speed_gain, angular_gain) = match scenes::vss(1, 1).engine {
        EngineKind::Rapier => (0.01, 0.5),
        EngineKind::Compact => (0.01, 0.2),
    };
    let touched_opponent = robot_column("touched_opponent");
    for config in both_leagues() {
        check_crashes(&config, |scene, rows, label| {
            for (tick, pair) in rows.windows(2).enumerate() {
                let touch = robots(&pair[1]).any(|robot| robot[touched_opponent] > 0.0);
                if touch || deepest_robots(&scene.config, &pair[0]) > 0.0 {
                    continue;
                }
                for (before, after) in robots(&pair[0]).zip(robots(&pair[1])) {
                    let [slow, fast] = [after, before].map(|robot| robot[4].hypot(robot[5]));
                    assert!(
                        slow <= fast + speed_gain,
                        "{label}, tick {tick}: {fast} to {slow} m/s"
                    );
                    let [slow, fast] = [after, before].map(|robot| robot[6].abs());
                    assert!(
                        slow <= fast + angular_gain,
                        "{label}, tick {tick}: {fast} to {slow} rad/s"
                    );
                }
            }
        });
    }
}

/// Two discs that meet 30 degrees off the line of their centers: friction stops the slip, so both get
/// the angular velocity of closed form, the same for both, at whatever part of a tick they meet. Of impacts in the last
/// sub-step of a tick it once was down to 4%.
#[test]
fn discs_that_meet_off_center_turn_at_the_same_angular_velocity() {
    let model = RobotModel::SSL_GENERIC;
    let radius = model.bounding_radius();
    for speed in [1.0, 3.0] {
        let ticks = speed * TICKS[0];
        for part in 0_u8..20 {
            let gap = 0.02 + ticks * f32::from(part) / 20.0;
            let ahead = (3.0_f32.sqrt() * radius) + gap;
            let poses = [[0.0, 0.0, 0.0], [ahead, radius, 0.0]];
            let driver = Driver::Constant(vec![vec![speed, 0.0, 0.0, 0.0, 0.0, 0.0], vec![0.0; 6]]);
            let mut scene = Scene::at("off_center", scenes::ssl(1, 1), &poses, driver);
            scene.set_ball([0.0, 2.0], [0.0, 0.0]);
            scene.set_robot_column(0, "v_x", speed);
            let rows = scene.every_tick(gap / speed + 0.03);
            let expected = 0.5 * speed / (3.0 * radius);
            // rapier places the contact of a pair that still has a gap beside both.
            let has_gap = part > 0 && scene.config.engine == EngineKind::Rapier;
            let tolerance = if has_gap { 0.3 } else { 0.05 };
            for robot in 0..2 {
                let all = rows.iter().map(|row| robots(row).nth(robot).expect("two")[6].abs());
                let got = all.fold(0.0, f32::max);
                let error = (got / expected - 1.0).abs();
                let label = format!("{speed} m/s, gap {gap} m, robot {robot}");
                assert!(error < tolerance, "{label}: {got} rad/s, not {expected}");
            }
        }
    }
}

/// A corner that hits a face has its friction at the corner: the impulse along the face that moves the
/// struck robot aside turns the other one about that lever.
#[test]
fn a_corner_that_hits_a_face_is_turned_by_friction_at_the_corner() {
    let model = RobotModel::VSS_440RPM;
    let (half, corner) = (model.front_distance(), model.bounding_radius());
    let config = SimConfig { tick: 0.001, ..scenes::vss(1, 1) };
    let poses = [[0.0, 0.0, 45.0], [corner + half + 0.01, 0.01, 0.0]];
    let mut scene = Scene::at("corner", config, &poses, Driver::Constant(vec![vec![0.0; 2]; 2]));
    scene.set_ball([0.0, 0.6], [0.0, 0.0]);
    scene.set_robot_column(0, "v_x", 1.0);
    let rows = scene.every_tick(0.05);
    let struck = rows.iter().find(|row| robots(row).nth(1).expect("two")[4] > 0.1);
    let all: Vec<&[f32]> = robots(struck.expect("they meet")).collect();
    let expected = -model.mass * all[1][5] * corner / (model.mass * (2.0 * half).powi(2) / 6.0);
    let error = (all[0][6] / expected - 1.0).abs();
    assert!(error < 0.05, "{} rad/s, expected {expected}", all[0][6]);
}
