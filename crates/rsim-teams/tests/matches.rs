//! Whole matches.

use rsim_core::SimConfig;
use rsim_referee::Team;
use rsim_referee::config::Placement;

use crate::arena::Arena;

#[test]
#[ignore = "a tool"]
fn report() {
    let number = |name: &str, default: f32| {
        std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
    };
    let skills = [number("BLUE", 1.0), number("YELLOW", 1.0)];
    let (half, matches) = (number("HALF", 300.0), number("MATCHES", 1.0) as u32);
    let robots = number("ROBOTS", 6.0) as usize;
    let placement =
        if number("PLACE", 0.0) > 0.0 { Placement::Robots } else { Placement::Teleport };
    let mut wins = [0, 0, 0];
    for seed in 0..matches {
        let mut arena = Arena::new(config(robots), skills, half, placement, seed);
        arena.run();
        let score = Team::BOTH.map(|team| arena.game.score[team]);
        let c = &arena.counts;
        let minutes = f64::from(c.steps) * 0.025 / 60.0;
        let nth = usize::from(score[1] > score[0]) + 2 * usize::from(score[0] == score[1]);
        wins[nth] += 1;
        println!(
            "{score:?} passes {:?} fouls {:?} shots {:?} minutes {minutes:.1} in play {:.2} us/robot {:.2} x real time {:.0}",
            c.passes,
            arena.fouls(),
            Team::BOTH.map(|team| arena.statistics.shots[team]),
            f64::from(c.in_play) / f64::from(c.steps),
            c.acting_seconds * 1e6 / f64::from(c.steps) / (2.0 * robots as f64),
            minutes * 60.0 / c.seconds
        );
        println!("{:?}", c.events);
    }
    println!("wins {wins:?}");
}

#[test]
#[ignore = "a tool"]
fn trace() {
    let number = |name: &str, default: f32| {
        std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
    };
    let skills = [number("BLUE", 1.0), number("YELLOW", 1.0)];
    let (from, to) = (number("FROM", 0.0) as u32, number("TO", 400.0) as u32);
    let every = number("EVERY", 4.0) as u32;
    let placement =
        if number("PLACE", 0.0) > 0.0 { Placement::Robots } else { Placement::Teleport };
    let robots = number("ROBOTS", 6.0) as usize;
    let mut arena = Arena::new(
        SimConfig::ssl(robots, robots),
        skills,
        number("HALF", 60.0),
        placement,
        number("SEED", 0.0) as u32,
    );
    let mut last = None;
    for step in 0..to {
        if arena.ended {
            break;
        }
        let events = arena.step();
        if step < from {
            continue;
        }
        if last != Some(arena.game.command) {
            println!(
                "{step} {:?} next {:?} at {:?}",
                arena.game.command, arena.game.next_command, arena.game.designated_position
            );
            last = Some(arena.game.command);
        }
        for event in events {
            println!(
                "{step} !! {:?} {:?} {:?} {:?}",
                event.kind, event.team, event.robot, event.position
            );
            if let Some(robot) = event.robot {
                let nth = usize::from(robot >= robots);
                let names = arena.sides[0].memory_columns();
                let kept = &arena.memories[nth];
                let at = |name: &str| kept[names.iter().position(|n| n == name).expect("a column")];
                println!(
                    "      taker {} carrier {} start {:.2},{:.2} steps {} receiver {}",
                    at("taker"),
                    at("carrier"),
                    at("carry_start_x"),
                    at("carry_start_y"),
                    at("carry_steps"),
                    at("receiver")
                );
                println!("      {:?}", &arena.row[14 + robot * 12..][..12]);
                println!(
                    "      ball {:?} dribbler {:?} {:?}",
                    &arena.row[..6],
                    arena.game.dribbler,
                    arena.game.dribble_start
                );
            }
        }
        if step % every == 0 {
            let row = &arena.row;
            print!(
                "{step} {} ball {:.2} {:.2} z{:.2} v {:.2} {:.2} |",
                arena.game.in_play, row[0], row[1], row[2], row[3], row[4]
            );
            for robot in 0..2 * robots {
                let r = &row[14 + robot * 12..][..12];
                let mark = if r[7] > 0.5 { "*" } else { "" };
                print!(
                    " {}{:.2},{:.2}{mark}",
                    if robot == robots { "|| " } else { "" },
                    r[0],
                    r[1]
                );
            }
            println!();
            if std::env::var("COMMANDS").is_ok() {
                let [blue, _] = &arena.memories;
                let names = arena.sides[0].memory_columns();
                let at = |name: &str| blue[names.iter().position(|n| n == name).expect("a column")];
                println!(
                    "    taker {} carrier {} receiver {} aimer {} aim {:.2},{:.2} value {:.2} rec {} attacks {}",
                    at("taker"),
                    at("carrier"),
                    at("receiver"),
                    at("aimer"),
                    at("aim_x"),
                    at("aim_y"),
                    at("aim_value"),
                    at("aim_receiver"),
                    at("attacks")
                );
            }
        }
    }
}

#[test]
#[ignore = "a tool"]
fn story() {
    let number = |name: &str, default: f32| {
        std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
    };
    let skills = [number("BLUE", 1.0), number("YELLOW", 1.0)];
    let placement =
        if number("PLACE", 0.0) > 0.0 { Placement::Robots } else { Placement::Teleport };
    let mut arena = Arena::new(
        SimConfig::ssl(6, 6),
        skills,
        number("HALF", 60.0),
        placement,
        number("SEED", 0.0) as u32,
    );
    let names = arena.sides[0].memory_columns();
    let place = |name: &str| names.iter().position(|n| n == name).expect("a column");
    let mut last = [-1.0; 2];
    let mut command = None;
    while !arena.ended {
        let old = arena.memories.clone();
        let before = arena.row.clone();
        let events = arena.step();
        let step = arena.counts.steps;
        if command != Some(arena.game.command) {
            command = Some(arena.game.command);
            println!("{step} {:?} {:?}", arena.game.command, arena.game.designated_position);
        }
        for event in events {
            println!(
                "{step} !! {:?} {:?} {:?} heights {:?} fouls {:?} yellow {:?} removal {:?} ball v {:?}",
                event.kind,
                event.team,
                event.robot,
                arena.game.height_since_touch,
                arena.game.foul_steps,
                arena.game.yellow_steps_left,
                arena.game.removal_steps_left,
                &before[..6]
            );
        }
        for nth in 0..2 {
            let at = |name: &str| arena.memories[nth][place(name)];
            let was = |name: &str| old[nth][place(name)];
            if at("carrier") != last[nth] {
                println!(
                    "{step} team {nth} carrier {} at {:.2},{:.2} after {} steps",
                    at("carrier"),
                    before[0],
                    before[1],
                    was("carry_steps")
                );
                last[nth] = at("carrier");
            }
            if at("pass_steps") == 100.0 {
                println!(
                    "{step} team {nth} KICK by {} at {:.2},{:.2} to {:.2},{:.2} speed {:.1} chip {} receiver {} value {:.2} after {} steps",
                    at("carrier"),
                    before[0],
                    before[1],
                    was("aim_x"),
                    was("aim_y"),
                    was("aim_speed"),
                    was("aim_chip"),
                    at("receiver"),
                    was("aim_value"),
                    was("carry_steps")
                );
            }
        }
    }
}

#[test]
#[ignore = "a tool"]
fn watch() {
    let number = |name: &str, default: f32| {
        std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
    };
    let placement =
        if number("PLACE", 0.0) > 0.0 { Placement::Robots } else { Placement::Teleport };
    let skills = [number("BLUE", 1.0), number("YELLOW", 1.0)];
    let mut arena = Arena::new(
        SimConfig::ssl(6, 6),
        skills,
        number("HALF", 60.0),
        placement,
        number("SEED", 0.0) as u32,
    );
    let robot = number("ROBOT", 0.0) as usize;
    let (from, to) = (number("FROM", 0.0) as u32, number("TO", 400.0) as u32);
    while arena.counts.steps < to && !arena.ended {
        arena.step();
        let step = arena.counts.steps;
        if step >= from {
            let r = &arena.row[14 + robot * 12..][..12];
            let b = &arena.row;
            let c = &arena.last_commands()[robot * 6..][..6];
            println!(
                "{step} ball {:.3},{:.3} v {:.2},{:.2} | robot {:.3},{:.3} h {:.2},{:.2} v {:.2},{:.2} w {:.1} ir {} t {} | gap {:.3} cmd {:.2} {:.2} {:.1} k {:.1} {:.1} d {}",
                b[0],
                b[1],
                b[3],
                b[4],
                r[0],
                r[1],
                r[2],
                r[3],
                r[4],
                r[5],
                r[6],
                r[7],
                r[8],
                ((r[0] - b[0]).powi(2) + (r[1] - b[1]).powi(2)).sqrt(),
                c[0],
                c[1],
                c[2],
                c[3],
                c[4],
                c[5]
            );
        }
    }
}

fn config(robots: usize) -> SimConfig {
    let mut config = SimConfig::ssl(robots, robots);
    if std::env::var("FIELD_A").is_ok() {
        config.field = rsim_core::Field::SSL_A;
    }
    config
}
