//! A ball jammed between heavy bodies: it passes pushes on, and stores no energy.

use rsim_core::scenes::{
    self, Driver, Scene, deepest_ball, driving, kinetic_energy, robots, uniform,
};
use rsim_core::{Body, EngineKind, Field, RobotModel, SimConfig};

const TICKS: [f32; 2] = [0.005, 0.0025];

/// Maximum separation speed of bodies with a ball between them, by their closing speed.
const BOUNCE: f32 = 0.25;

/// Result of a squeeze.
#[derive(Debug, Default)]
struct Outcome {
    /// Maximum separation speed, by the closing speed at the start.
    back: f32,
    /// Maximum overlap with the ball, m.
    depth: f32,
    /// Maximum energy, by that at the start.
    energy: f32,
}

impl Outcome {
    fn update(&mut self, back: f32, depth: f32, energy: f32) {
        self.back = self.back.max(back);
        self.depth = self.depth.max(depth);
        self.energy = self.energy.max(energy);
    }
}

/// Distance from a robot's center to its front or its back, m.
fn reach(model: &RobotModel, back: bool) -> f32 {
    match model.body {
        Body::Round { radius, .. } if back => radius,
        _ => model.front_distance(),
    }
}

/// A robot that drives a ball against a wall.
#[derive(Debug, Clone, Copy)]
struct Press {
    speed: f32,
    tick: f32,
    /// Whether the robot meets the ball with its back.
    back: bool,
    /// Gap between robot and ball, m.
    gap: f32,
    /// Offset of the robot along the wall, m.
    offset: f32,
    /// Whether the wall is at +x rather than at +y.
    end: bool,
    drives: bool,
}

impl Press {
    fn scene(&self, config: &SimConfig) -> Scene {
        let mut config = config.clone();
        config.tick = self.tick;
        let (field, radius) = (&config.field, config.ball.radius);
        let wall = self.wall(field);
        let ball = wall - radius - 1e-4;
        let model = config.blue[0].clone();
        let robot = ball - radius - reach(&model, self.back) - self.gap;
        // Away from goals.
        let beside = if self.end { -0.38 * field.width } else { 0.1 };
        let place = |at: f32, offset: f32| {
            if self.end { [at, beside + offset] } else { [beside + offset, at] }
        };
        let along = if self.end { [1.0, 0.0] } else { [0.0, 1.0] };
        let degrees = if self.end { 0.0 } else { 90.0 } + if self.back { 180.0 } else { 0.0 };
        let velocity = along.map(|part: f32| part * self.speed);
        let commands = if self.drives { vec![driving(&model, degrees, velocity)] } else { vec![] };
        let [x, y] = place(robot, self.offset);
        let driver = Driver::Constant(commands);
        let mut scene = Scene::at("squeeze", config, &[[x, y, degrees]], driver);
        scene.set_ball(place(ball, 0.0), [0.0, 0.0]);
        scene.set_velocity(0, velocity);
        scene
    }

    fn wall(&self, field: &Field) -> f32 {
        if self.end { field.half_length() + field.goal_line_margin } else { field.max_y() }
    }

    fn outcome(&self, config: &SimConfig) -> Outcome {
        let scene = self.scene(config);
        let along = usize::from(!self.end);
        let rows = scene.every_tick(0.2);
        let start = kinetic_energy(&scene.config, &rows[0]);
        let wall = self.wall(&config.field) - config.ball.radius;
        let heading = robots(&rows[0]).next().expect("a robot");
        let mut outcome = Outcome::default();
        for row in &rows {
            let robot = robots(row).next().expect("a robot");
            let inside = deepest_ball(&scene.config, row).max(row[along] - wall);
            let energy = kinetic_energy(&scene.config, row) / start;
            // A robot that hit the ball off its middle turns about it, and then drives away.
            let facing = robot[2] * heading[2] + robot[3] * heading[3] > 0.5;
            let back = if facing { -robot[4 + along] / self.speed } else { 0.0 };
            outcome.update(back, inside, energy);
        }
        outcome
    }
}

fn check_presses(config: &SimConfig, speeds: &[(f32, f32)], drives: bool) {
    for (speed, most) in speeds.iter().copied() {
        for nth in 0..160 {
            let draw = |part: u64| uniform(nth * 16 + part);
            let press = Press {
                speed,
                tick: TICKS[usize::from(nth % 2 == 0)],
                back: draw(0) > 0.0,
                gap: if nth % 5 == 0 { 0.0 } else { 0.01 * (1.0 + draw(1)) },
                offset: if nth % 3 == 0 { 0.0 } else { 0.03 * draw(2) },
                end: draw(3) > 0.0,
                drives,
            };
            let outcome = press.outcome(config);
            assert!(outcome.back <= BOUNCE, "{press:?}: {outcome:?}");
            assert!(outcome.depth <= most, "{press:?}: {outcome:?}");
            assert!(drives || outcome.energy <= 1.0001, "{press:?}: {outcome:?}");
        }
    }
}

#[test]
fn a_ball_at_the_wall_threw_ssl_robots_back() {
    let speeds = [(0.5, 2e-3), (0.9, 2e-3), (1.2, 2e-3), (2.2, 5e-3), (3.0, 5e-3), (3.7, 5e-3)];
    check_presses(&scenes::ssl(1, 0), &speeds, true);
    check_presses(&scenes::ssl(1, 0), &speeds, false);
}

#[test]
fn a_ball_at_the_wall_threw_vsss_robots_back() {
    let speeds = [(0.5, 2e-3), (0.8, 2e-3), (1.19, 2e-3)];
    check_presses(&scenes::vss(1, 0), &speeds, true);
    check_presses(&scenes::vss(1, 0), &speeds, false);
}

/// Two robots that meet with the ball between them, along x.
#[derive(Debug, Clone, Copy)]
struct Meeting {
    tick: f32,
    speeds: [f32; 2],
    headings: [f32; 2],
    /// Gap between each robot and the ball along x at the start, m.
    gap: f32,
    /// Lateral offset of the robots, m, each to its side.
    offset: f32,
}

impl Meeting {
    fn scene(&self) -> Scene {
        let mut config = scenes::ssl(1, 1);
        config.tick = self.tick;
        let model = config.blue[0].clone();
        let away = model.bounding_radius() + config.ball.radius + self.gap;
        let [a, b] = self.headings;
        let velocities = [[self.speeds[0], 0.0], [-self.speeds[1], 0.0]];
        let commands = [(a, velocities[0]), (b, velocities[1])];
        let commands =
            commands.map(|(degrees, velocity)| driving(&model, degrees, velocity)).to_vec();
        let poses = [[-away, self.offset, a], [away, -self.offset, b]];
        let mut scene = Scene::at("meeting", config, &poses, Driver::Constant(commands));
        (0..2).for_each(|robot| scene.set_velocity(robot, velocities[robot]));
        scene
    }

    fn outcome(&self) -> Outcome {
        let scene = self.scene();
        let rows = scene.every_tick(0.15);
        let start = kinetic_energy(&scene.config, &rows[0]);
        let mut outcome = Outcome::default();
        for row in &rows {
            let all: Vec<&[f32]> = robots(row).collect();
            let between = [all[1][0] - all[0][0], all[1][1] - all[0][1]];
            let apart = (all[1][4] - all[0][4]) * between[0] + (all[1][5] - all[0][5]) * between[1];
            let apart = apart / between[0].hypot(between[1]) / (self.speeds[0] + self.speeds[1]);
            let energy = kinetic_energy(&scene.config, row) / start;
            outcome.update(apart, deepest_ball(&scene.config, row), energy);
        }
        outcome
    }
}

/// Checks meetings of robots at `speed` and a fraction of it, with random deviations.
fn check_meetings(speed: f32, share: f32) {
    for nth in 0..100 {
        let draw = |part: u64| uniform(nth * 16 + part);
        for tick in TICKS {
            let meeting = Meeting {
                tick,
                speeds: [speed, speed * share],
                headings: [120.0 + 60.0 * draw(0), 300.0 + 60.0 * draw(1)],
                gap: 0.05 + 0.03 * draw(2),
                offset: 0.012 * draw(3),
            };
            let outcome = meeting.outcome();
            let label = || format!("{meeting:?}: {outcome:?}");
            assert!(outcome.depth < 2e-3, "{}", label());
            assert!(outcome.back <= BOUNCE, "{}", label());
        }
    }
}

#[test]
fn robots_met_as_if_there_were_no_ball_between_them() {
    for speed in [1.0, 1.8, 2.5, 3.1, 3.7] {
        for tick in TICKS {
            let headings = [120.0, 300.0];
            let meeting = Meeting { tick, speeds: [speed; 2], headings, gap: 0.05, offset: 0.0 };
            let outcome = meeting.outcome();
            assert!(outcome.depth < 2e-3, "{meeting:?}: {outcome:?}");
            assert!(outcome.back <= BOUNCE, "{meeting:?}: {outcome:?}");
        }
    }
}

/// Sorted overlaps of meetings, m, with headings of up to these degrees around zero, so that fronts meet the
/// ball too.
fn depths_with_headings(speed: f32, [first, second]: [f32; 2]) -> Vec<f32> {
    let mut depths: Vec<_> = (0..300)
        .map(|nth| {
            let draw = |part: u64| uniform(nth * 32 + part + 4096);
            let meeting = Meeting {
                tick: 0.005,
                speeds: [speed; 2],
                headings: [first * draw(0), second * draw(1)],
                gap: 0.09 + 0.04 * draw(2),
                offset: 0.01 * draw(3),
            };
            meeting.outcome().depth
        })
        .collect();
    depths.sort_by(f32::total_cmp);
    depths
}

#[test]
fn a_ball_that_slid_along_an_oblique_front_sank_into_it() {
    for speed in [1.0, 2.5, 3.7] {
        let depths = depths_with_headings(speed, [180.0, 180.0]);
        let [most, all] = [depths[depths.len() * 98 / 100], depths[depths.len() - 1]];
        assert!(most < 3e-3, "{speed} m/s: 98% within {most} m");
        assert!(all < 6e-3, "{speed} m/s: the deepest {all} m");
    }
}

/// Known error of rapier: at full speed a ball that slides out along an oblique front sometimes sinks
/// into it by more than 3 mm, at most 6 mm. rapier treats outlines as straight within a part of a tick.
#[test]
fn a_ball_that_slides_along_an_oblique_front_at_full_speed_sinks_into_it_under_rapier() {
    let depths = depths_with_headings(3.7, [35.0, 180.0]);
    let deep = depths.iter().filter(|depth| **depth > 3e-3).count();
    match scenes::engine() {
        EngineKind::Rapier => assert!(deep > 0, "the error is gone: this test must change"),
        EngineKind::Compact => assert!(deep == 0, "{deep} of {} sink in", depths.len()),
    }
}

#[test]
fn robots_that_met_not_quite_in_line_sank_into_the_ball() {
    for speed in [1.0, 2.5, 3.7] {
        check_meetings(speed, 1.0);
    }
}

#[test]
fn robots_sank_into_a_ball_in_front_of_a_slower_or_a_standing_one() {
    for speed in [1.0, 2.5, 3.7] {
        check_meetings(speed, 0.5);
        check_meetings(speed, 0.0);
    }
}
