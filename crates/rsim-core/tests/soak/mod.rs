//! Random play on every field with every team size: no body leaves the arena, none stays inside another,
//! speeds stay bounded. A million ticks; `make soak` runs ten million.

mod crowds;
mod depths;

use depths::Depths;
use rsim_core::columns::ball_column;
use rsim_core::scenes::{self, Driver, Scene, robot_depth, robots, uniform};
use rsim_core::{BallModel, Field, RobotModel, SimConfig};

/// Ticks of the whole run, unless `RSIM_SOAK_TICKS` sets another number.
const TICKS: u64 = 1_000_000;
/// Steps between two starts of a scene.
const EPISODE: u64 = 400;

fn ticks() -> u64 {
    let asked = std::env::var("RSIM_SOAK_TICKS").ok();
    asked.map_or(TICKS, |text| text.parse().expect("RSIM_SOAK_TICKS is a number"))
}

/// Every field with every size of the first team; sizes of the second and models mixed.
fn configs() -> Vec<SimConfig> {
    let mut configs = Vec::new();
    for field in Field::PRESETS {
        let vss = field.name.starts_with("vss");
        let ball = if vss { BallModel::VSS_RSIM } else { BallModel::SSL_TIGERS };
        let of_league = |model: &RobotModel| model.name.starts_with("vss") == vss;
        let models: Vec<_> = RobotModel::PRESETS.into_iter().filter(of_league).collect();
        for n_blue in 0..=field.max_robots {
            let n_yellow = (n_blue * 7 + 3) % (field.max_robots + 1);
            let mut config = scenes::config(field.clone(), ball.clone(), &models[0], 0, 0);
            let team = |n: usize| models.iter().cycle().take(n).cloned().collect::<Vec<_>>();
            (config.blue, config.yellow) = (team(n_blue), team(n_yellow));
            configs.push(config);
        }
    }
    configs
}

/// The fault of a state, if any. Robots may overlap by more than 2 mm in `moments` consecutive states.
fn fault(config: &SimConfig, row: &[f32], apart: &mut [u32], moments: u32) -> Option<String> {
    if !row.iter().all(|value| value.is_finite()) {
        return Some("a number is not finite".into());
    }
    let field = &config.field;
    let bodies = std::iter::once(row).chain(robots(row));
    for (who, at) in bodies.enumerate() {
        if at[0].abs() > field.max_x() || at[1].abs() > field.max_y() {
            return Some(format!("body {who} left the arena, to {:?}", &at[..2]));
        }
    }
    if row[ball_column("z")] < 0.0 || row[ball_column("z")] > 8.0 {
        return Some(format!("the ball is at height {}", row[ball_column("z")]));
    }
    let all: Vec<_> = config.robots().zip(robots(row)).collect();
    let mut pair = 0;
    for first in 0..all.len() {
        for second in first + 1..all.len() {
            // A collision may press deeper for a moment; a lasting overlap is a fault.
            let deep = robot_depth(all[first], all[second]) > 0.002;
            apart[pair] = if deep { apart[pair] + 1 } else { 0 };
            if apart[pair] > moments {
                return Some(format!("robots {first} and {second} stay in each other"));
            }
            pair += 1;
        }
    }
    None
}

#[test]
fn random_play_stays_sound_on_every_field_with_every_team_size() {
    let configs = configs();
    let steps = ticks() / 5 / configs.len() as u64;
    let mut contacts = 0;
    for (nth, config) in configs.iter().enumerate() {
        let mut scene = Scene::lined_up("soak", config.clone(), Driver::Random);
        let mut world = scene.world();
        let mut row = scene.start.clone();
        let mut apart = vec![0; 300];
        for step in 0..steps {
            if step % EPISODE == 0 {
                let draw = |part: u64| uniform(step + part * 1_000_003 + nth as u64 * 7919);
                scene.set_ball([0.0, 0.0], [draw(1) * 6.0, draw(2) * 6.0]);
                world.place(&scene.start, None).expect("valid");
                row.copy_from_slice(&scene.start);
                apart.fill(0);
            }
            world.step(&scene.commands(&row, step, nth as u64 * 104_729)).expect("finite");
            world.write_row(&mut row);
            contacts += world.contacts() as u64;
            let teams = format!("{} against {}", config.blue.len(), config.yellow.len());
            if let Some(fault) = fault(config, &row, &mut apart, 2) {
                panic!("{} {teams}, step {step}: {fault}\n{row:?}", config.field.name);
            }
        }
    }
    assert!(contacts > steps, "only {contacts} contacts");
}

#[test]
fn twenty_two_robots_that_push_into_a_corner_stay_sound() {
    let config = SimConfig { field: Field::SSL_A, ..scenes::ssl(11, 11) };
    let mut scene = Scene::lined_up("corner", config.clone(), Driver::Chase);
    // The ball lies in the corner, and all robots chase it.
    scene.set_ball([6.55, 4.75], [0.0, 0.0]);
    let mut world = scene.world();
    let (mut row, mut apart, mut contacts) = (scene.start.clone(), vec![0; 300], 0);
    let mut depths = Depths::default();
    for step in 0..2400 {
        world.step(&scene.commands(&row, step, 0)).expect("finite");
        world.write_row(&mut row);
        contacts += world.contacts();
        if let Some(fault) = fault(&config, &row, &mut apart, 2) {
            panic!("step {step}: {fault}\n{row:?}");
        }
        depths.look(&config, &row);
        if step > 600 {
            let fastest = robots(&row).map(|robot| robot[4].hypot(robot[5])).fold(0.0, f32::max);
            assert!(fastest < 4.0, "step {step}: {fastest} m/s");
        }
    }
    assert!(contacts > 20_000, "only {contacts} contacts");
    depths.check("11 v 11 in a corner", [0.2, 0.5, 6.0], [1.0, 1.0, 2.0]);
}
