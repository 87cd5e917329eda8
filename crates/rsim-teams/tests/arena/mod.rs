//! Matches of two sides with physics and referee, and what is counted in them.

use std::collections::BTreeMap;

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, ball_column, robot_column};
use rsim_core::{SimConfig, World};
use rsim_match::{layout, lines, pitch, team_config};
use rsim_referee::codes::Stage;
use rsim_referee::config::{Placement, RefereeConfig};
use rsim_referee::events::EventKind;
use rsim_referee::game::Game;
use rsim_referee::statistics::{OFFENSES, Statistics};
use rsim_referee::{Decisions, Referee, Team, Vector};
use rsim_teams::{COMMAND_COLUMNS, ScriptedTeam};

/// Control steps after which a match is broken off, in case its last half never ends.
const MAX_STEPS: u32 = 200_000;

/// Counts of a match, blue first.
#[derive(Debug, Default, Clone)]
pub(crate) struct Counts {
    /// Events by their kind.
    pub(crate) events: BTreeMap<&'static str, [u32; 2]>,
    /// Balls that came from one robot to a teammate.
    pub(crate) passes: [u32; 2],
    /// Offenses.
    pub(crate) offenses: [u32; 2],
    /// Control steps with the ball in play.
    pub(crate) in_play: u32,
    /// Control steps.
    pub(crate) steps: u32,
}

impl Counts {
    /// Number of events of a kind, of both teams.
    pub(crate) fn of(&self, event: &str) -> u32 {
        self.events.get(event).map_or(0, |teams| teams.iter().sum())
    }
}

/// A match.
#[derive(Clone)]
pub(crate) struct Arena {
    /// Field, robots and ball.
    pub(crate) config: SimConfig,
    /// State of the match.
    pub(crate) game: Game,
    /// State row.
    pub(crate) row: Vec<f32>,
    /// Counts so far.
    pub(crate) counts: Counts,
    world: World,
    referee: Referee,
    sides: [ScriptedTeam; 2],
    memories: [Vec<f32>; 2],
    statistics: Statistics,
    before: Vec<f32>,
    restart: Vec<f32>,
    commands: Vec<f32>,
    decisions: Decisions,
    /// Robot that touched the ball last.
    toucher: Option<usize>,
}

impl Arena {
    /// A match of two halves before its first kick-off, without extra time.
    pub(crate) fn new(
        config: SimConfig,
        skills: [f32; 2],
        half_seconds: f32,
        placement: Placement,
        seed: u32,
    ) -> Self {
        let rules = RefereeConfig {
            half_seconds,
            placement,
            extra_half_seconds: 0.0,
            shootout_kicks: 0.0,
            early_end_goals: 0.0,
            ..RefereeConfig::preset("ssl_2026_b").expect("a preset")
        };
        let layout = layout(&config).expect("all columns");
        let referee = Referee::new(rules, pitch(&config), layout).expect("valid rules");
        let mut world = World::new(&config).expect("a valid world");
        let mut row = vec![0.0; config.row_size()];
        world.write_row(&mut row);
        referee.line_up(&mut row, 0).expect("a row");
        world.place(&row, None).expect("a valid line-up");
        let mut game = Game::new(Team::Blue);
        referee.begin(&row, &mut game).expect("a row");
        let sides = skills.map(|skill| side(&config, skill));
        let mut memories = [(); 2].map(|()| vec![0.0; sides[0].memory_columns().len()]);
        for (nth, (side, memory)) in (0..).zip(sides.iter().zip(&mut memories)) {
            side.begin(memory, 2 * seed + nth, None).expect("a memory");
        }
        Self {
            before: row.clone(),
            restart: row.clone(),
            commands: vec![0.0; config.command_size()],
            statistics: Statistics::default(),
            decisions: Decisions::default(),
            counts: Counts::default(),
            toucher: None,
            config,
            game,
            row,
            world,
            referee,
            sides,
            memories,
        }
    }

    /// Place of a team's penalty kick, m.
    pub(crate) fn penalty_mark(&self, team: Team) -> Vector {
        lines(&self.config).penalty_mark(team)
    }

    /// Puts a robot at a place (m), at rest.
    pub(crate) fn set_robot(&mut self, robot: usize, place: [f32; 2]) {
        let first = BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len();
        for (name, value) in [("x", place[0]), ("y", place[1]), ("v_x", 0.0), ("v_y", 0.0)] {
            self.row[first + robot_column(name)] = value;
        }
        self.world.place(&self.row, None).expect("a valid place");
        self.world.write_row(&mut self.row);
    }

    /// Puts the ball at a place (m) with a velocity (m/s).
    pub(crate) fn set_ball(&mut self, place: [f32; 2], velocity: [f32; 2]) {
        let values = [place[0], place[1], velocity[0], velocity[1]];
        for (name, value) in ["x", "y", "v_x", "v_y"].into_iter().zip(values) {
            self.row[ball_column(name)] = value;
        }
        self.world.place(&self.row, None).expect("a valid place");
        self.world.write_row(&mut self.row);
    }

    /// Plays until the end of the match.
    pub(crate) fn run(&mut self) {
        while self.game.stage != Stage::PostGame && self.counts.steps < MAX_STEPS {
            self.step();
        }
    }

    /// Plays a control step.
    pub(crate) fn step(&mut self) {
        self.act();
        self.before.copy_from_slice(&self.row);
        self.world.step(&self.commands).expect("finite");
        self.world.write_row(&mut self.row);
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
        self.count();
        if self.decisions.restarts {
            self.world.restart(&self.restart).expect("a valid restart");
            self.row.copy_from_slice(&self.restart);
            self.referee.begin(&self.row, &mut self.game).expect("a row");
        }
    }

    /// Lets both sides decide.
    fn act(&mut self) {
        let split = self.config.blue.len() * COMMAND_COLUMNS.len();
        let (blue, yellow) = self.commands.split_at_mut(split);
        for (team, commands) in Team::BOTH.into_iter().zip([blue, yellow]) {
            let memory = &mut self.memories[team.index()];
            self.sides[team.index()]
                .act(&self.row, &self.game, team, memory, commands)
                .expect("rows that fit");
        }
    }

    fn count(&mut self) {
        self.counts.steps += 1;
        self.counts.in_play += u32::from(self.game.in_play);
        for event in &self.decisions.events {
            let counts = self.counts.events.entry(name(event.kind)).or_default();
            for team in Team::BOTH {
                if event.team.is_none_or(|own| own == team) {
                    counts[team.index()] += 1;
                    let is_offense = OFFENSES.contains(&event.kind);
                    self.counts.offenses[team.index()] += u32::from(is_offense);
                }
            }
        }
        self.count_passes();
    }

    fn count_passes(&mut self) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small index
        let toucher = Some(self.row[ball_column("last_touch")])
            .filter(|index| *index >= 0.0 && self.game.in_play)
            .map(|index| index as usize);
        let Some(robot) = toucher else {
            self.toucher = None;
            return;
        };
        let first = BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len();
        if self.row[first + robot_column("touched_ball")] < 0.5 {
            return;
        }
        let team = |robot: usize| usize::from(robot >= self.config.blue.len());
        let last = self.toucher.replace(robot).filter(|last| *last != robot);
        if last.is_some_and(|last| team(last) == team(robot)) {
            self.counts.passes[team(robot)] += 1;
        }
    }
}

fn name(kind: EventKind) -> &'static str {
    let found = EventKind::ALL.iter().find(|(event, ..)| *event == kind);
    found.expect("all kinds are listed").2
}

/// A scripted side with the numbers of a simulator's first robot and its ball.
fn side(config: &SimConfig, skill: f32) -> ScriptedTeam {
    let layout = layout(config).expect("all columns");
    let numbers = team_config(config, layout, skill).expect("robots of the league");
    ScriptedTeam::new(&numbers).expect("valid numbers")
}
