//! A match of two sides: physics, referee, and what is counted.

use rsim_core::SimConfig;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, ball_column, robot_column};
use rsim_core::{Drive, RobotModel, World};
use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::{Placement, RefereeConfig};
use rsim_referee::events::{Event, EventKind};
use rsim_referee::game::Game;
use rsim_referee::pitch::Pitch;
use rsim_referee::sight::Layout;
use rsim_referee::statistics::{OFFENSES, Statistics};
use rsim_referee::{Decisions, Lines, Referee, Team};
use rsim_teams::{BallNumbers, COMMAND_COLUMNS, RobotNumbers, ScriptedTeam, TeamConfig};

/// What is counted in a match, by team where there are two.
#[derive(Debug, Default, Clone)]
pub(crate) struct Counts {
    pub(crate) events: std::collections::BTreeMap<&'static str, [u32; 2]>,
    pub(crate) passes: [u32; 2],
    pub(crate) fouls: [u32; 2],
    pub(crate) in_play: u32,
    pub(crate) steps: u32,
    pub(crate) acting_seconds: f64,
    pub(crate) seconds: f64,
}

/// A match.
pub(crate) struct Arena {
    pub(crate) config: SimConfig,
    pub(crate) world: World,
    pub(crate) referee: Referee,
    pub(crate) sides: [ScriptedTeam; 2],
    pub(crate) memories: [Vec<f32>; 2],
    pub(crate) game: Game,
    pub(crate) statistics: Statistics,
    pub(crate) row: Vec<f32>,
    before: Vec<f32>,
    restart: Vec<f32>,
    commands: Vec<f32>,
    decisions: Decisions,
    pub(crate) counts: Counts,
    pub(crate) ended: bool,
    kicker: Option<usize>,
}

pub(crate) fn lines(config: &SimConfig) -> Lines {
    let field = &config.field;
    Lines {
        half_length: field.half_length(),
        half_width: field.half_width(),
        half_goal_width: field.goal_width / 2.0,
        goal_height: field.goal_height,
        area_depth: field.goal_area_depth,
        half_area_width: field.goal_area_width / 2.0,
        inner_area_depth: field.inner_area_depth,
        half_inner_area_width: field.inner_area_width / 2.0,
        line_width: field.line_width,
        corner_leg: field.corner_leg,
        goal_wall_thickness: field.goal_wall_thickness,
        center_circle_radius: field.center_circle_radius,
        penalty_mark_distance: field.penalty_mark_distance,
        boundary_x: field.half_length() + field.goal_line_margin,
        boundary_y: field.half_width() + field.touch_line_margin,
        free_ball_x: field.free_ball_x,
        free_ball_y: field.free_ball_y,
    }
}

fn robot_numbers(robot: &RobotModel) -> RobotNumbers {
    let Drive::Omni(drive) = robot.drive else { panic!("an omnidirectional robot") };
    let mouth = robot.mouth.expect("it kicks");
    RobotNumbers {
        radius: robot.bounding_radius(),
        front_distance: robot.front_distance(),
        max_speed: drive.max_speed,
        max_acceleration: drive.max_acceleration,
        max_deceleration: drive.max_deceleration,
        max_angular_velocity: robot.top_angular_velocity(),
        max_kick_speed: mouth.max_kick_speed,
        max_chip_speed: mouth.max_chip_speed,
    }
}

pub(crate) fn side(config: &SimConfig, skill: f32) -> ScriptedTeam {
    let ball = &config.ball;
    let (n_blue, n_yellow) = (config.blue.len(), config.yellow.len());
    ScriptedTeam::new(&TeamConfig {
        lines: lines(config),
        layout: Layout::new(&BALL_COLUMNS, &ROBOT_COLUMNS, n_blue, n_yellow).expect("columns"),
        time_step: config.time_step,
        robot: robot_numbers(&config.blue[0]),
        ball: BallNumbers {
            radius: ball.radius,
            sliding_deceleration: ball.sliding_deceleration,
            rolling_deceleration: ball.rolling_deceleration,
            slide_to_roll_ratio: ball.slide_to_roll_ratio,
        },
        skill,
    })
    .expect("a valid side")
}

impl Arena {
    pub(crate) fn new(
        config: SimConfig,
        skills: [f32; 2],
        half_seconds: f32,
        placement: Placement,
        seed: u32,
    ) -> Self {
        let layout =
            Layout::new(&BALL_COLUMNS, &ROBOT_COLUMNS, config.blue.len(), config.yellow.len())
                .expect("columns");
        let rules = RefereeConfig {
            half_seconds,
            placement,
            extra_half_seconds: 0.0,
            shootout_kicks: 0.0,
            early_end_goals: 0.0,
            ..RefereeConfig::preset("ssl_2026_b").expect("a preset")
        };
        let pitch = Pitch {
            lines: lines(&config),
            robot_radius: config.blue[0].bounding_radius(),
            ball_radius: config.ball.radius,
            time_step: config.time_step,
        };
        let referee = Referee::new(rules, pitch, layout).expect("valid rules");
        let mut world = World::new(&config).expect("a valid world");
        let mut row = vec![0.0; config.row_size()];
        world.write_row(&mut row);
        referee.line_up(&mut row).expect("a row");
        world.place(&row, None).expect("a valid line-up");
        let mut game = Game::new(Team::Blue);
        referee.begin(&row, &mut game).expect("a row");
        let sides = skills.map(|skill| side(&config, skill));
        let mut memories = [(); 2].map(|()| vec![0.0; sides[0].memory_columns().len()]);
        for (nth, (side, memory)) in sides.iter().zip(&mut memories).enumerate() {
            side.begin(memory, seed * 2 + nth as u32).expect("a memory");
        }
        let commands = vec![0.0; config.command_size()];
        Self {
            before: row.clone(),
            restart: row.clone(),
            config,
            world,
            referee,
            sides,
            memories,
            game,
            statistics: Statistics::default(),
            row,
            commands,
            decisions: Decisions::default(),
            counts: Counts::default(),
            ended: false,
            kicker: None,
        }
    }

    /// One step; returns its events.
    pub(crate) fn step(&mut self) -> Vec<Event> {
        let begin = std::time::Instant::now();
        let split = self.config.blue.len() * COMMAND_COLUMNS.len();
        let (blue, yellow) = self.commands.split_at_mut(split);
        for (team, commands) in Team::BOTH.into_iter().zip([blue, yellow]) {
            let nth = team.index();
            self.sides[nth]
                .act(&self.row, &self.game, team, &mut self.memories[nth], commands)
                .expect("rows that fit");
        }
        self.counts.acting_seconds += begin.elapsed().as_secs_f64();
        self.before.copy_from_slice(&self.row);
        self.world.step(&self.commands).expect("finite");
        self.world.write_row(&mut self.row);
        let was_in_play = self.game.in_play;
        self.referee
            .judge(
                &self.before,
                &self.row,
                &mut self.game,
                &mut self.statistics,
                &mut self.restart,
                &mut self.decisions,
            )
            .expect("rows that fit");
        self.count(was_in_play);
        if self.decisions.restarts {
            self.world.restart(&self.restart).expect("a valid restart");
            self.row.copy_from_slice(&self.restart);
            self.referee.begin(&self.row, &mut self.game).expect("a row");
        }
        self.ended = self.game.stage == Stage::PostGame;
        self.counts.seconds += begin.elapsed().as_secs_f64();
        self.decisions.events.clone()
    }

    fn count(&mut self, in_play: bool) {
        self.counts.steps += 1;
        self.counts.in_play += u32::from(in_play);
        for event in &self.decisions.events {
            let counts = self.counts.events.entry(name(event.kind)).or_default();
            for team in Team::BOTH {
                if event.team.is_none_or(|own| own == team) {
                    counts[team.index()] += 1;
                    self.counts.fouls[team.index()] += u32::from(OFFENSES.contains(&event.kind));
                }
            }
        }
        if !self.game.in_play {
            self.kicker = None;
            return;
        }
        // A pass: the ball goes from one robot to a mate over some way.
        let touched = self.row[ball_column("last_touch")];
        if touched < 0.0 {
            return;
        }
        let robot = touched as usize;
        let column =
            BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len() + robot_column("touched_ball");
        if self.row[column] > 0.5 {
            let n_blue = self.config.blue.len();
            let team = usize::from(robot >= n_blue);
            if let Some(kicker) = self.kicker.filter(|kicker| *kicker != robot) {
                if usize::from(kicker >= n_blue) == team {
                    self.counts.passes[team] += 1;
                }
            }
            self.kicker = Some(robot);
        }
    }

    pub(crate) fn last_commands(&self) -> &[f32] {
        &self.commands
    }

    pub(crate) fn run(&mut self) {
        while !self.ended && self.counts.steps < 200_000 {
            self.step();
        }
    }

    pub(crate) fn fouls(&self) -> [u32; 2] {
        self.counts.fouls
    }

    pub(crate) fn is(&self, command: Command) -> bool {
        self.game.command == command
    }
}

pub(crate) fn name(kind: EventKind) -> &'static str {
    Box::leak(format!("{kind:?}").into_boxed_str())
}
