//! Invalid input is refused with the name of the argument, and changes nothing.

use rsim_core::columns::ball_column;
use rsim_core::scenes::{self, robots_mut};
use rsim_core::{
    BallModel, Batch, EngineKind, Field, Forecaster, Knowledge, PlaceError, RobotModel, SimConfig,
    SnapshotError, Threads, World,
};

fn message(config: &SimConfig) -> String {
    World::new(config).err().expect("refused").to_string()
}

#[test]
fn configurations_are_checked_by_name() {
    let good = scenes::vss(3, 3);
    assert!(World::new(&good).is_ok());
    let spoilt = |spoil: &dyn Fn(&mut SimConfig)| {
        let mut config = good.clone();
        spoil(&mut config);
        message(&config)
    };
    assert!(spoilt(&|config| config.time_step = -0.025).contains("time_step"));
    assert!(spoilt(&|config| config.time_step = f32::NAN).contains("time_step"));
    assert!(spoilt(&|config| config.tick = 0.0).contains("tick"));
    assert!(spoilt(&|config| config.tick = 0.004).contains("whole number of ticks"));
    assert!(message(&scenes::vss(6, 3)).contains("n_blue must be at most 5"));
    assert!(message(&scenes::ssl(3, 12)).contains("n_yellow must be at most 11"));
    assert!(spoilt(&|config| config.yellow[1].mass = -1.0).contains("robot.mass"));
    assert!(spoilt(&|config| config.field.goal_width = 2.0).contains("field.goal_width"));
    assert!(
        spoilt(&|config| config.field.goal_wall_thickness = 0.02)
            .contains("field.goal_wall_thickness")
    );
    assert!(spoilt(&|config| config.ball.wall_restitution = 1.2).contains("wall_restitution"));
    assert!(
        spoilt(&|config| config.ball.slide_to_roll_ratio = 1.0).contains("slide_to_roll_ratio")
    );
}

#[test]
fn ticks_too_long_to_be_accurate_were_accepted() {
    for (tick, time_step) in [(0.006, 0.024), (0.01, 0.02), (0.0125, 0.025), (0.025, 0.025)] {
        for config in [scenes::vss(1, 1), scenes::ssl(1, 1)] {
            let error = message(&SimConfig { tick, time_step, ..config });
            assert!(error.contains("tick must be at most 0.005 s"), "{error}");
            assert!(error.contains(&format!("got {tick}")), "{error}");
        }
    }
    for tick in [0.005, 0.0025, 0.001] {
        assert!(World::new(&SimConfig { tick, ..scenes::vss(1, 1) }).is_ok(), "{tick}");
    }
}

#[test]
fn every_preset_makes_a_match() {
    for field in Field::PRESETS {
        for robot in RobotModel::PRESETS {
            for ball in BallModel::PRESETS {
                let config = scenes::config(field.clone(), ball.clone(), &robot, 1, 2);
                let label = format!("{} {} {}", field.name, robot.name, ball.name);
                let mut world = World::new(&config).expect(&label);
                world.step(&vec![1.0; config.command_size()]).expect(&label);
            }
        }
    }
}

#[test]
fn presets_are_found_by_name() {
    for field in Field::PRESETS {
        assert_eq!(Field::preset(&field.name).expect("known"), field);
    }
    let error = RobotModel::preset("vss_900rpm").expect_err("unknown").to_string();
    assert!(error.contains("vss_440rpm") && error.contains("vss_900rpm"), "{error}");
}

#[test]
fn a_batch_needs_worlds_and_threads() {
    for (worlds, threads, name) in [(0, 1, "worlds"), (1, 0, "threads"), (1, 100_000, "threads")] {
        let error = Batch::new(&scenes::vss(3, 3), worlds, threads).err().expect("refused");
        assert!(error.to_string().contains(name), "{error}");
    }
}

#[test]
fn impossible_starts_are_refused_and_change_nothing() {
    let scene = scenes::random_play();
    let mut world = scene.world();
    let spoil = |change: &dyn Fn(&mut Vec<f32>)| {
        let mut row = scene.start.clone();
        change(&mut row);
        row
    };
    let set = |row: &mut Vec<f32>, robot: usize, column: usize, value: f32| {
        robots_mut(row).nth(robot).expect("a robot")[column] = value;
    };
    let cases: [(&str, Vec<f32>); 9] = [
        ("blue_0", spoil(&|row| set(row, 0, 0, 0.9))),
        ("outside", spoil(&|row| set(row, 4, 1, 0.63))),
        (
            "outside",
            spoil(&|row| {
                set(row, 4, 0, 0.71);
                set(row, 4, 1, 0.61);
            }),
        ),
        ("yellow_2", spoil(&|row| set(row, 5, 2, 0.5))),
        ("ball moves at 21.0 m/s", spoil(&|row| row[ball_column("v_x")] = 21.0)),
        ("below the floor", spoil(&|row| row[ball_column("z")] = -0.1)),
        ("x of ball must be finite, got NaN", spoil(&|row| row[0] = f32::NAN)),
        (
            "ball and blue_1 overlap",
            spoil(&|row| {
                row[0] = -0.3;
                row[1] = 0.35;
            }),
        ),
        (
            "blue_0 and blue_2 overlap",
            spoil(&|row| {
                set(row, 2, 0, -0.6);
                set(row, 2, 1, 0.05);
            }),
        ),
    ];
    let before = scene.play(&mut world.clone(), 3).0;
    for (expected, row) in cases {
        let error = world.place(&row, None).expect_err(expected).to_string();
        assert!(error.contains(expected), "{error} should say {expected}");
    }
    assert_eq!(scene.play(&mut world, 3).0, before);
}

#[test]
fn an_impossible_start_in_one_world_changes_no_world() {
    let scene = scenes::random_play();
    let (mut batch, mut rows) = scene.batch(3, 1);
    let before = rows.clone();
    let mut starts = scene.start.repeat(2);
    starts[0] = 0.1;
    starts[scene.start.len()] = f32::INFINITY;
    let error = batch.place(&[true, false, true], &starts, None, &mut rows).expect_err("refused");
    assert!(matches!(error, PlaceError::InWorld { world: 2, .. }), "{error}");
    batch.read(&mut rows);
    assert_eq!(rows, before);
}

#[test]
fn foreign_and_damaged_snapshots_are_refused() {
    let (mut batch, _) = scenes::chase().batch(2, 1);
    let good = batch.snapshot();
    assert_eq!(batch.restore(b"something else"), Err(SnapshotError::Foreign));
    assert_eq!(batch.restore(b"rsimsna0 and more"), Err(SnapshotError::Layout));
    for cut in [8, 20, 60, good.len() - 1] {
        assert!(
            matches!(batch.restore(&good[..cut]), Err(SnapshotError::Damaged(_))),
            "cut at {cut}"
        );
    }
    let mut flipped = good.clone();
    flipped[good.len() / 2] ^= 4;
    assert!(matches!(batch.restore(&flipped), Err(SnapshotError::Damaged(_))));
    let mut older = good.clone();
    older[8] ^= 0xff;
    assert!(matches!(batch.restore(&older), Err(SnapshotError::Version { .. })));
    let (other, _) = scenes::lone_robot([0.0, 0.0]).batch(2, 1);
    assert_eq!(batch.restore(&other.snapshot()), Err(SnapshotError::OtherConfig));
    let (fewer, _) = scenes::chase().batch(1, 1);
    assert_eq!(batch.restore(&fewer.snapshot()), Err(SnapshotError::OtherConfig));
    for engine in EngineKind::ALL.into_iter().filter(|engine| *engine != scenes::engine()) {
        let mut other = scenes::chase();
        other.config.engine = engine;
        let (other, _) = other.batch(2, 1);
        assert_eq!(batch.restore(&other.snapshot()), Err(SnapshotError::OtherConfig));
    }
    assert_eq!(batch.restore(&good), Ok(()));
    assert_eq!(batch.snapshot(), good, "nothing had changed");
}

#[test]
fn a_forecaster_takes_no_snapshot_of_a_simulator_and_the_reverse() {
    let (mut batch, _) = scenes::chase().batch(2, 1);
    let threads = Threads::new(1).expect("one");
    let mut forecaster =
        Forecaster::new(batch.config(), 2, Knowledge::All, threads).expect("valid");
    let own = forecaster.snapshot();
    assert_eq!(forecaster.restore(&batch.snapshot()), Err(SnapshotError::OtherConfig));
    assert_eq!(batch.restore(&own), Err(SnapshotError::OtherConfig));
    assert_eq!(forecaster.restore(&own), Ok(()));
}

#[test]
fn ticks_and_teams_have_limits() {
    let config = scenes::chase().config;
    let tick = SimConfig { tick: 1e-40, time_step: 2e-40, ..config.clone() };
    let error = tick.validate().expect_err("too short").to_string();
    assert!(error.starts_with("tick must be at least 0.00001 s, got"), "{error}");
    let field = Field { max_robots: 32, ..config.field };
    let error = field.validate().expect_err("too many").to_string();
    assert_eq!(error, "field.max_robots must be at most 31, got 32");
}

#[test]
fn engines_have_the_names_by_which_they_are_found() {
    for engine in EngineKind::ALL {
        assert_eq!(EngineKind::named(engine.name()), Ok(engine));
    }
    let error = EngineKind::named("box2d").expect_err("no engine").to_string();
    assert_eq!(error, "engine must be \"rapier\" or \"compact\", got \"box2d\"");
}
