//! A match: physics, referee, sides and people, step by step.

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use rsim_core::streams::words;
use rsim_core::{Batch, Knowledge, SimConfig};
use rsim_referee::draws::Draws;
use rsim_referee::game::Game;
use rsim_referee::statistics::Statistics;
use rsim_referee::{Decisions, Referee, Team, Vector};

use crate::actions::Actions;
use crate::conditions::Conditions;
use crate::error::MatchError;
use crate::knowledge::{layout, pitch};
use crate::network::Network;
use crate::observations::robots_of;
use crate::person::Controls;
use crate::player::Player;
use crate::policy_file::PolicyFile;
use crate::self_play;
use crate::setup::{Play, Setup};
use crate::side::{Known, Side};

/// One match.
pub struct Match {
    setup: Setup,
    config: SimConfig,
    batch: Batch,
    actions: Actions,
    referee: Referee,
    game: Game,
    statistics: Statistics,
    decisions: Decisions,
    sides: [Side; 2],
    /// Controls of people, by robot.
    people: Vec<Option<Controls>>,
    row: Vec<f32>,
    /// Row of a world in which nothing has moved yet.
    rest: Vec<f32>,
    before: Vec<f32>,
    restart: Vec<f32>,
    /// Rows that each team knows.
    known: [Vec<f32>; 2],
    commands: Vec<f32>,
    steps: u64,
}

/// Observation of a robot of a network's team, and the means of its action.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// Stacked observation.
    pub observation: Vec<f32>,
    /// Output of the network's last layer.
    pub means: Vec<f32>,
}

impl Match {
    /// A match before its first kick-off, with nobody at the robots.
    ///
    /// # Errors
    /// A setup that cannot be played.
    pub fn new(setup: Setup) -> Result<Self, MatchError> {
        let config = setup.config()?;
        let referee = Referee::new(setup.rules(&config), pitch(&config), layout(&config)?)?;
        let actions = Actions::new(&config)?;
        let batch = Batch::new(&config, 1, 1)?;
        let mut row = vec![0.0; config.row_size()];
        batch.read(&mut row);
        let rest = row.clone();
        let [first, others] = halves(drawn(setup.seed, 7));
        referee.line_up(&mut row, first)?;
        let kickoff = Team::BOTH[usize::from(drawn(setup.seed, 0) & 1 == 1)];
        let game = Game { placements: Draws::new(others), ..Game::new(kickoff) };
        let mut created = Self {
            people: vec![None; config.n_robots()],
            commands: vec![0.0; config.command_size()],
            before: row.clone(),
            restart: row.clone(),
            rest,
            known: [row.clone(), row.clone()],
            row,
            game,
            statistics: Statistics::default(),
            decisions: Decisions::default(),
            sides: [Side::Idle, Side::Idle],
            steps: 0,
            setup,
            config,
            batch,
            actions,
            referee,
        };
        match created.setup.play {
            Play::Match => {
                created.place()?;
                created.referee.begin(&created.row, &mut created.game)?;
            }
            Play::SelfPlay => created.begin_episode()?,
        }
        Ok(created)
    }

    /// The match before it began.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Configuration of the physics.
    pub fn config(&self) -> &SimConfig {
        &self.config
    }

    /// State row.
    pub fn row(&self) -> &[f32] {
        &self.row
    }

    /// Row of what a team knows: the state row without senses.
    pub fn known(&self, team: Team) -> &[f32] {
        &self.known[team.index()]
    }

    /// Commands of the last step, robot by robot.
    pub fn commands(&self) -> &[f32] {
        &self.commands
    }

    /// State of the match besides the bodies.
    pub fn game(&self) -> &Game {
        &self.game
    }

    /// Decisions of the referee in the last step.
    pub fn decisions(&self) -> &Decisions {
        &self.decisions
    }

    /// Control steps since the match began.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Has nobody drive a team.
    pub fn set_idle(&mut self, team: Team) {
        self.set_side(team, Side::Idle);
    }

    /// Has the scripted SSL team drive a team.
    ///
    /// # Errors
    /// A skill that is not from 0 to 1, or a match of VSSS.
    pub fn set_scripted(&mut self, team: Team, skill: f32) -> Result<(), MatchError> {
        self.set_scripted_by(team, skill, None)
    }

    fn set_scripted_by(
        &mut self,
        team: Team,
        skill: f32,
        tactics: Option<&[f32]>,
    ) -> Result<(), MatchError> {
        let [low, _] = halves(drawn(self.setup.seed, 1 + team.index()));
        let side = Side::scripted(&self.config, &self.referee, skill, low, tactics)?;
        self.set_side(team, side);
        Ok(())
    }

    /// Has the content of a policy file drive a team.
    ///
    /// # Errors
    /// A network with other observations or actions, or tactics out of their ranges or in a match of VSSS.
    pub fn set_policy(&mut self, team: Team, policy: PolicyFile) -> Result<(), MatchError> {
        match policy {
            PolicyFile::Network(network) => self.set_network(team, *network),
            PolicyFile::Tactics(tactics) => self.set_scripted_by(team, 1.0, Some(&tactics)),
        }
    }

    /// Has a network drive a team.
    ///
    /// # Errors
    /// A network with other observations or actions.
    pub fn set_network(&mut self, team: Team, network: Network) -> Result<(), MatchError> {
        let robots = robots_of(team, &self.config).len();
        let seed = drawn(self.setup.seed, 3 + team.index());
        let sizes = self.actions.sizes();
        let player = Player::new(network, &self.config, sizes, robots, seed)?;
        self.set_side(team, Side::Network(Box::new(player)));
        Ok(())
    }

    /// Gives a robot to a person, with these controls from the next step on, or back to its side.
    ///
    /// # Errors
    /// No such robot.
    pub fn control(&mut self, robot: usize, controls: Option<Controls>) -> Result<(), MatchError> {
        self.check_robot(robot)?;
        self.people[robot] = controls;
        Ok(())
    }

    /// Advances the match by a control step.
    ///
    /// # Errors
    /// A state that is not finite any more.
    pub fn step(&mut self) -> Result<(), MatchError> {
        self.command()?;
        self.before.copy_from_slice(&self.row);
        self.batch.step(&self.commands, &mut self.row, None)?;
        self.steps += 1;
        self.referee.judge(
            &self.before,
            &self.row,
            &mut self.game,
            &mut self.statistics,
            &mut self.restart,
            &mut self.decisions,
        )?;
        match self.setup.play {
            Play::Match if self.decisions.restarts => {
                self.batch.restart(&[true], &self.restart, &mut self.row)?;
                self.referee.begin(&self.row, &mut self.game)?;
            }
            Play::Match => (),
            Play::SelfPlay if self_play::has_ended(&self.game) => self.begin_episode()?,
            Play::SelfPlay => self.reposition_ball(),
        }
        self.sense();
        Ok(())
    }

    /// Begins an episode of self-play at random places.
    fn begin_episode(&mut self) -> Result<(), MatchError> {
        self.row.copy_from_slice(&self.rest);
        let key = drawn(self.setup.seed, 6) ^ self.steps;
        self_play::scatter(&self.config, key, &mut self.row);
        self.place()?;
        self.game = self_play::begun(&self.game, self.config.time_step);
        self.referee.begin(&self.row, &mut self.game)?;
        Ok(())
    }

    /// Repositions a ball that has left the field, to the nearest place that robots leave free.
    fn reposition_ball(&mut self) {
        let ball = Vector::new(self.row[0], self.row[1]);
        let radius = self.config.ball.radius;
        for place in self_play::places_inside(&self.config.field, ball, radius) {
            let mut columns = [0.0; BALL_COLUMNS.len()];
            (columns[0], columns[1]) = (place.x, place.y);
            if self.batch.reposition_balls(&[true], &columns, &mut self.row).is_ok() {
                return;
            }
        }
    }

    /// Fills the commands of all robots.
    fn command(&mut self) -> Result<(), MatchError> {
        let size = self.actions.command_size();
        for team in Team::BOTH {
            let robots = robots_of(team, &self.config);
            let known = Known {
                config: &self.config,
                actions: &self.actions,
                referee: &self.referee,
                game: &self.game,
                row: &self.known[team.index()],
                team,
                judges_areas: self.setup.play == Play::Match,
            };
            let out = &mut self.commands[robots.start * size..robots.end * size];
            self.sides[team.index()].act(known, out)?;
            for robot in robots {
                let Some(controls) = self.people[robot] else { continue };
                let out = &mut self.commands[robot * size..][..size];
                let (wheels, motion) = (controls.wheels(), controls.motion(team));
                let action: &[f32] =
                    if let Actions::Wheels(_) = self.actions { &wheels } else { &motion };
                // A person sees the picture, not what the robots know.
                self.actions.command(action, &self.row, robot, team == Team::Yellow, out);
            }
        }
        Ok(())
    }

    /// Changes physics and senses while the match goes on. Wheels and kickers begin anew.
    ///
    /// # Errors
    /// Conditions that cannot be; then nothing has changed.
    pub fn change(&mut self, conditions: Conditions) -> Result<(), MatchError> {
        let setup = Setup { conditions, ..self.setup.clone() };
        let config = setup.config()?;
        setup.conditions.parameters(&config)?;
        let batch = Batch::new(&config, 1, 1)?;
        let old = (
            std::mem::replace(&mut self.setup, setup),
            std::mem::replace(&mut self.config, config),
            std::mem::replace(&mut self.batch, batch),
        );
        let row = self.row.clone();
        let placed = self.place();
        if placed.is_err() {
            (self.setup, self.config, self.batch) = old;
            self.row = row;
        }
        placed
    }

    /// Moves the ball, where it comes to rest at once; everything else goes on.
    ///
    /// # Errors
    /// A place outside the field, or within a robot; then nothing has changed.
    pub fn move_ball(&mut self, [x, y]: [f32; 2], [v_x, v_y]: [f32; 2]) -> Result<(), MatchError> {
        let mut ball = [0.0; BALL_COLUMNS.len()];
        (ball[0], ball[1], ball[3], ball[4]) = (x, y, v_x, v_y);
        self.batch.reposition_balls(&[true], &ball, &mut self.row)?;
        self.sense();
        Ok(())
    }

    /// Moves a robot, with the same heading, and at rest; everything else goes on.
    ///
    /// # Errors
    /// No such robot, a place outside the field, or within another body; then nothing has changed.
    pub fn move_robot(&mut self, robot: usize, [x, y]: [f32; 2]) -> Result<(), MatchError> {
        self.check_robot(robot)?;
        let mut row = self.row.clone();
        let columns = &mut row[BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len()..];
        (columns[0], columns[1]) = (x, y);
        columns[4..7].fill(0.0);
        let mut moved = vec![false; self.config.n_robots()];
        moved[robot] = true;
        self.batch.reposition_robots(&[true], &moved, &row, &mut self.row)?;
        self.sense();
        Ok(())
    }

    /// Goes on from a situation: a state row, and the row of a state of the match.
    ///
    /// # Errors
    /// Rows of other lengths, or with numbers that cannot be; then nothing has changed.
    pub fn resume(&mut self, row: &[f32], game: &[f32]) -> Result<(), MatchError> {
        if row.len() != self.row.len() {
            let expected = format!("{} numbers", self.row.len());
            return Err(MatchError::argument("row", expected, &row.len()));
        }
        let game = Game::read(game)?;
        let old = self.row.clone();
        self.row.copy_from_slice(row);
        if let Err(error) = self.place() {
            self.row = old;
            return Err(error);
        }
        self.game = game;
        Ok(())
    }

    /// Input of the network of a robot's team, and the means of its decision; `None` if another side
    /// drives the team.
    ///
    /// # Errors
    /// No such robot.
    pub fn decision(&self, robot: usize) -> Result<Option<Decision>, MatchError> {
        self.check_robot(robot)?;
        let team = if robot < self.config.blue.len() { Team::Blue } else { Team::Yellow };
        let Side::Network(player) = &self.sides[team.index()] else { return Ok(None) };
        let nth = robot - robots_of(team, &self.config).start;
        let mut observation = vec![0.0; player.observations().size()];
        player.observations().observe(
            self.known(team),
            (&self.referee, &self.game),
            robot,
            player.last_action(nth),
            &mut observation,
        )?;
        let observation = player.stacked(nth, &observation);
        let means = player.network().means(&observation);
        Ok(Some(Decision { observation, means }))
    }

    /// Begins the physics anew from the nearest valid state to the row.
    fn place(&mut self) -> Result<(), MatchError> {
        let parameters = self.setup.conditions.parameters(&self.config)?;
        let (mask, start) = ([true], self.row.clone());
        let mut moved = vec![0.0; 1 + self.config.n_robots()];
        self.batch.place_estimates(&mask, &start, &mut self.row, &mut moved)?;
        let start = self.row.clone();
        self.batch.place(&mask, &start, parameters.as_deref(), &mut self.row)?;
        let key = drawn(self.setup.seed, 5) ^ self.steps;
        self.batch.begin_senses(&mask, &[key], None)?;
        self.sense();
        Ok(())
    }

    /// Finds what the teams know: by a forecast if they expect one, or if the conditions have it.
    fn sense(&mut self) {
        let all = self.setup.conditions.forecasts();
        let teams = [Knowledge::Blue, Knowledge::Yellow];
        for ((knowledge, side), known) in teams.into_iter().zip(&self.sides).zip(&mut self.known) {
            if all || side.forecasts() {
                self.batch.sense_as(knowledge, known, None);
            } else {
                self.batch.sense_without_forecast(knowledge, known, None);
            }
        }
    }

    fn set_side(&mut self, team: Team, side: Side) {
        self.sides[team.index()] = side;
        self.sense();
    }

    fn check_robot(&self, robot: usize) -> Result<(), MatchError> {
        let robots = self.config.n_robots();
        if robot < robots {
            return Ok(());
        }
        Err(MatchError::argument("robot", format!("an index below {robots}"), &robot))
    }
}

/// The n-th word that a seed gives.
fn drawn(seed: u32, nth: usize) -> u64 {
    words(&[u64::from(seed)], nth + 1).last().unwrap_or_default()
}

/// The halves of a word, the lower one first.
#[allow(clippy::cast_possible_truncation)] // it is the aim
const fn halves(word: u64) -> [u32; 2] {
    [word as u32, (word >> 32) as u32]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::tests::file;

    fn scripted(field: &str, seed: u32) -> Match {
        let mut one = Match::new(Setup::new(field, 3, 3, seed)).expect("valid");
        one.set_scripted(Team::Blue, 1.0).expect("SSL");
        one.set_scripted(Team::Yellow, 0.5).expect("SSL");
        one
    }

    fn play(one: &mut Match, steps: usize) -> Vec<f32> {
        (0..steps).for_each(|_| one.step().expect("finite"));
        one.row().to_vec()
    }

    fn named(name: &str, value: f32) -> std::collections::BTreeMap<String, f32> {
        std::collections::BTreeMap::from([(name.to_owned(), value)])
    }

    #[test]
    fn tactics_of_a_file_change_how_a_side_plays() {
        let known = rsim_teams::TACTICS;
        let with = |tactics: Option<Vec<f32>>| {
            let mut one = scripted("ssl_b", 3);
            if let Some(tactics) = tactics {
                one.set_policy(Team::Blue, PolicyFile::Tactics(tactics)).expect("SSL");
            }
            play(&mut one, 600)
        };
        let by_hand = with(None);
        assert_eq!(with(Some(known.map(|tactic| tactic.default).to_vec())), by_hand);
        assert_ne!(with(Some(known.map(|tactic| tactic.most).to_vec())), by_hand);
        let mut one = scripted("ssl_b", 3);
        let wrong = PolicyFile::Tactics(vec![1.0; known.len()]);
        let error = one.set_policy(Team::Blue, wrong).expect_err("out of range").to_string();
        assert!(error.contains("tactics: expected"), "{error}");
    }

    #[test]
    fn a_match_is_a_function_of_its_setup() {
        let rows = [3, 3, 4].map(|seed| play(&mut scripted("ssl_b", seed), 600));
        assert!(rows[0] == rows[1] && rows[0] != rows[2]);
        let mut one = scripted("ssl_b", 3);
        let touched = (0..600).any(|_| {
            play(&mut one, 1);
            one.game().last_touch.is_some()
        });
        assert!(touched, "somebody plays the ball");
    }

    #[test]
    fn self_play_begins_anew_at_random_places_after_a_goal_and_after_its_time() {
        let begun = |field: &str, seed| {
            let play = Play::SelfPlay;
            Match::new(Setup { play, ..Setup::new(field, 3, 3, seed) }).expect("valid")
        };
        let mut one = begun("vss_3v3", 4);
        assert_ne!(one.row(), begun("vss_3v3", 5).row());
        assert!(one.game().in_play);
        let start = one.row().to_vec();
        one.move_ball([0.7, 0.0], [2.0, 0.0]).expect("a free place");
        let scored = (0..40).any(|_| {
            play(&mut one, 1);
            one.game().score[Team::Blue] == 1
        });
        assert!(scored && one.game().in_play);
        let after = one.row().to_vec();
        assert!(after[0].abs() < 0.65 && after != start, "a new start");
        let left = one.game().stage_steps_left;
        assert_eq!(left, 1200);
        play(&mut one, 1200);
        assert_eq!((one.game().stage_steps_left, one.game().score[Team::Blue]), (1200, 1));
        assert_ne!(one.row(), after);
    }

    #[test]
    fn in_self_play_a_ball_that_leaves_an_ssl_field_is_repositioned_and_nothing_is_whistled() {
        let setup = Setup { play: Play::SelfPlay, ..Setup::new("ssl_challenge", 3, 3, 1) };
        let mut one = Match::new(setup).expect("valid");
        one.set_scripted(Team::Blue, 1.0).expect("SSL");
        one.set_scripted(Team::Yellow, 0.5).expect("SSL");
        let across = one.config().field.half_width();
        one.move_ball([0.0, across - 0.1], [0.0, 3.0]).expect("a free place");
        let mut farthest = 0.0_f32;
        for _ in 0..2400 {
            play(&mut one, 1);
            farthest = farthest.max(one.row()[1].abs());
            assert!(one.game().in_play);
        }
        assert!(farthest < across + 0.03, "{farthest}");
    }

    #[test]
    fn a_person_drives_one_robot_and_gives_it_back() {
        let mut one = Match::new(Setup::new("ssl_b", 2, 2, 0)).expect("valid");
        let before = one.row().to_vec();
        let controls = Controls { up: 1.0, ..Controls::default() };
        one.control(1, Some(controls)).expect("a robot");
        let driven = play(&mut one, 40);
        let place = |row: &[f32], robot: usize| {
            let at = BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len();
            [row[at], row[at + 1]]
        };
        assert!(place(&driven, 1)[1] > place(&before, 1)[1] + 0.3);
        assert!((place(&driven, 0)[1] - place(&before, 0)[1]).abs() < 1e-3);
        one.control(1, None).expect("a robot");
        let rolled = play(&mut one, 40);
        assert!((play(&mut one, 10)[18] - rolled[18]).abs() < 1e-3, "it stands");
        assert!(one.control(4, None).is_err());
    }

    #[test]
    fn scripted_teams_forecast_and_others_know_what_is_sensed() {
        let sensing = [("delay", 0.1), ("command_delay", 0.05)];
        let sensing = sensing.map(|(name, value)| (name.to_owned(), value)).into();
        let late = Conditions { sensing, ..Conditions::default() };
        let mut setup = Setup::new("ssl_b", 3, 3, 2);
        setup.conditions = late;
        let mut one = Match::new(setup).expect("valid");
        one.set_scripted(Team::Blue, 1.0).expect("SSL");
        play(&mut one, 200);
        let before = one.known(Team::Blue).to_vec();
        assert_ne!(before, one.known(Team::Yellow));
        one.set_idle(Team::Blue);
        assert_eq!(one.known(Team::Blue), one.known(Team::Yellow));
        one.set_scripted(Team::Blue, 1.0).expect("SSL");
        assert_eq!(one.known(Team::Blue), before);
    }

    #[test]
    fn conditions_change_in_play_and_wrong_ones_change_nothing() {
        let mut one = scripted("ssl_b", 1);
        let before = play(&mut one, 200);
        assert_eq!(one.known(Team::Blue), before);
        let wrong = Conditions { ball: named("mass", -1.0), ..Conditions::default() };
        assert!(one.change(wrong).is_err());
        assert_eq!(one.row(), before);
        assert_eq!(one.setup().conditions, Conditions::default());
        let late = Conditions { sensing: named("delay", 0.1), ..Conditions::default() };
        one.change(late.clone()).expect("valid");
        assert_eq!(one.setup().conditions, late);
        let near = one.row().iter().zip(&before).take(2).all(|(a, b)| (a - b).abs() < 1e-3);
        assert!(near, "bodies stay where they are");
        play(&mut one, 100);
        assert_ne!(one.known(Team::Blue), one.row());
    }

    #[test]
    fn bodies_move_by_hand_where_there_is_room() {
        let mut one = Match::new(Setup::new("vss_3v3", 3, 3, 0)).expect("valid");
        one.move_ball([0.3, 0.2], [1.0, 0.0]).expect("room");
        assert!((one.row()[0] - 0.3).abs() < 1e-6 && (one.row()[3] - 1.0).abs() < 1e-6);
        let before = one.row().to_vec();
        assert!(one.move_ball([5.0, 0.0], [0.0; 2]).is_err());
        assert!(one.move_robot(0, [0.3, 0.2]).is_err(), "the ball is there");
        assert_eq!(one.row(), before);
        one.move_robot(0, [-0.5, 0.5]).expect("room");
        assert!((one.row()[BALL_COLUMNS.len()] + 0.5).abs() < 1e-6);
    }

    #[test]
    fn a_network_plays_both_teams_and_stands_still_while_play_is_stopped() {
        let network = Network::read(&file(80, 2, &[("action_repeat", "3")])).expect("a policy");
        let mut one = Match::new(Setup::new("vss_3v3", 3, 3, 0)).expect("valid");
        for team in Team::BOTH {
            one.set_network(team, network.clone()).expect("it fits");
        }
        one.step().expect("finite");
        assert!(one.commands().iter().all(|command| command.abs() < 1e-9), "before the kick-off");
        let decision = one.decision(4).expect("a robot").expect("a network");
        assert_eq!((decision.observation.len(), decision.means.len()), (80, 2));
        let driven = (0..400).any(|_| {
            play(&mut one, 1);
            one.commands().iter().any(|command| command.abs() > 1e-3)
        });
        assert!(driven, "after the kick-off");
        one.set_idle(Team::Blue);
        assert_eq!(one.decision(0).expect("a robot"), None);
        assert!(one.set_scripted(Team::Blue, 1.0).is_err(), "a script of another league");
    }

    #[test]
    fn a_situation_goes_on_elsewhere() {
        let mut first = scripted("ssl_b", 9);
        let row = play(&mut first, 300);
        let mut second = Match::new(first.setup().clone()).expect("valid");
        second.resume(&row, &first.game().row()).expect("a situation");
        assert_eq!(second.game(), first.game());
        assert!(second.row().iter().zip(&row).take(2).all(|(a, b)| (a - b).abs() < 1e-3));
        assert!(second.resume(&row[1..], &first.game().row()).is_err());
        assert!(second.resume(&row, &[0.0]).is_err());
        assert_eq!(second.game(), first.game());
    }
}
