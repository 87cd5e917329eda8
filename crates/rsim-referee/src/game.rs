//! State of a match besides the bodies: one row of numbers in named columns.

use crate::codes::{Command, Stage};
use crate::column::{ByTeam, row};
use crate::draws::Draws;
use crate::repeats::REPEATED;
#[cfg(doc)]
use crate::repeats::Repeated;
use crate::team::Team;
use crate::vector::Vector;

/// Most yellow cards of a team that run at once; another one is a red card (SSL rules, "Red Card").
pub const MAX_YELLOW_CARDS: usize = 2;

row! {
    /// State of a match. Times are in control steps, and end at 0; -1 is none.
    pub struct Game {
        /// Command of the referee.
        command: Command,
        /// Command that follows the present one, where it is decided.
        next_command: Option<Command>,
        /// Command that prepared or allowed the kick that is to be taken, or was taken last.
        kick: Option<Command>,
        /// Part of the match.
        stage: Stage,
        /// Time that the stage has left.
        stage_steps_left: i32,
        /// Time since the command began.
        command_steps: i32,
        /// Duration of the present stop or ball placement.
        wait_steps: i32,
        /// Goals that count.
        score: ByTeam<i32>,
        /// Place where the ball has to be for the next kick, m.
        designated_position: Vector,
        /// Whether the ball is in play.
        in_play: bool,
        /// Place where the ball was when the kick was allowed, m.
        kick_position: Vector,
        /// Robot that took the last kick and may not touch the ball again before another one.
        kick_taker: Option<usize>,
        /// Robot that touched the ball last since play went on.
        last_touch: Option<usize>,
        /// Place where the ball was when that robot touched it last, m.
        last_touch_position: Vector,
        /// Maximum height of the ball since each team touched it last, m.
        height_since_touch: ByTeam<f32>,
        /// Robot that has the ball.
        dribbler: Option<usize>,
        /// Place where it began to have it, m.
        dribble_start: Vector,
        /// Place where the ball is stuck, m.
        stuck_position: Vector,
        /// Time since it is stuck there.
        stuck_steps: i32,
        /// Time since the ball is in the area of a team.
        area_steps: ByTeam<i32>,
        /// VSSS: time since a team has too many robots in its own area, with the ball.
        defenders_steps: ByTeam<i32>,
        /// VSSS: time since a team has too many robots in the opponents' area, with the ball.
        attackers_steps: ByTeam<i32>,
        /// VSSS: whether a team had too many defenders since the ball came into its area.
        had_defenders: ByTeam<bool>,
        /// VSSS: whether a team had too many attackers since the ball came into the opponents' area.
        had_attackers: ByTeam<bool>,
        /// Robot that pushes an opponent.
        pusher: Option<usize>,
        /// The opponent.
        pushed: Option<usize>,
        /// Places of both when the contact began, m.
        push_start: [Vector; 2],
        /// Fouls that count for cards.
        fouls: ByTeam<i32>,
        /// Time since a foul of the team that did not stop play; -1 for none.
        foul_steps: ByTeam<i32>,
        /// Time in which a foul is not raised again, by [`Repeated`].
        repeat_steps: ByTeam<[i32; REPEATED]>,
        /// Time since the same fouls were last committed.
        ceased_steps: ByTeam<[i32; REPEATED]>,
        /// Yellow cards of the match.
        yellow_cards: ByTeam<i32>,
        /// Time that each running yellow card has left; 0 for none.
        yellow_steps_left: ByTeam<[i32; MAX_YELLOW_CARDS]>,
        /// Red cards of the match.
        red_cards: ByTeam<i32>,
        /// Robots that the referee has taken out, one bit each.
        removed_robots: i32,
        /// Time until robots over the limit are taken out; -1 if there are none.
        removal_steps_left: ByTeam<i32>,
        /// Time since robots are too close to the opponents' area.
        close_steps: ByTeam<i32>,
        /// Fouls by it in the present stop and kick.
        close_fouls: ByTeam<i32>,
        /// Robots that were too fast in the present stop, one bit each.
        fast_robots: i32,
        /// Time since robots stand in the way of a ball placement.
        interference_steps: i32,
        /// Whether that was a foul already in the present placement.
        has_interfered: bool,
        /// Ball placements that failed, less those that succeeded.
        placement_failures: ByTeam<i32>,
        /// Whether the team failed to place the ball in the present stop.
        has_failed_placement: ByTeam<bool>,
        /// Ball placements for a force start, which the teams take in turns.
        neutral_placements: i32,
        /// Way toward the goal that the ball of a penalty kick has made, m.
        penalty_way: f32,
        /// Penalty kicks taken in the shoot-out.
        shootout_kicks: ByTeam<i32>,
        /// Team with the first kick-off of the match.
        first_kickoff: Team,
        /// State of the random numbers of placements.
        placements: Draws,
    }
}

impl Game {
    /// A match whose first kick-off, which `kickoff` has, is prepared.
    pub fn new(kickoff: Team) -> Self {
        Self {
            command: Command::PrepareKickoff(kickoff),
            next_command: Some(Command::NormalStart),
            kick: Some(Command::PrepareKickoff(kickoff)),
            stage: Stage::FirstHalfPre,
            stage_steps_left: 0,
            command_steps: 0,
            wait_steps: 0,
            score: ByTeam::default(),
            designated_position: Vector::default(),
            in_play: false,
            kick_position: Vector::default(),
            kick_taker: None,
            last_touch: None,
            last_touch_position: Vector::default(),
            height_since_touch: ByTeam::default(),
            dribbler: None,
            dribble_start: Vector::default(),
            stuck_position: Vector::default(),
            stuck_steps: 0,
            area_steps: ByTeam::default(),
            defenders_steps: ByTeam::default(),
            attackers_steps: ByTeam::default(),
            had_defenders: ByTeam::default(),
            had_attackers: ByTeam::default(),
            pusher: None,
            pushed: None,
            push_start: [Vector::default(); 2],
            fouls: ByTeam::default(),
            foul_steps: ByTeam::new(-1, -1),
            repeat_steps: ByTeam::default(),
            ceased_steps: ByTeam::default(),
            yellow_cards: ByTeam::default(),
            yellow_steps_left: ByTeam::default(),
            red_cards: ByTeam::default(),
            removed_robots: 0,
            removal_steps_left: ByTeam::new(-1, -1),
            close_steps: ByTeam::default(),
            close_fouls: ByTeam::default(),
            fast_robots: 0,
            interference_steps: 0,
            has_interfered: false,
            placement_failures: ByTeam::default(),
            has_failed_placement: ByTeam::default(),
            neutral_placements: 0,
            penalty_way: 0.0,
            shootout_kicks: ByTeam::default(),
            first_kickoff: kickoff,
            placements: Draws::default(),
        }
    }

    /// Begins a command.
    pub fn give(&mut self, command: Command, next: Option<Command>) {
        (self.command, self.next_command) = (command, next);
        self.command_steps = 0;
    }

    /// The team that takes a penalty kick, from the permission on.
    pub fn penalty_taker(&self) -> Option<Team> {
        match (self.command, self.kick) {
            (Command::NormalStart, Some(Command::PreparePenalty(team))) => Some(team),
            _ => None,
        }
    }

    /// The team that may bring the ball into play; `None` if none may, or the ball is in play.
    pub fn kicking_team(&self) -> Option<Team> {
        if self.in_play {
            return None;
        }
        match self.command {
            Command::NormalStart => self.kick.and_then(Command::team),
            Command::DirectFree(team) => Some(team),
            _ => None,
        }
    }

    /// Whether some team may play the ball, or the ball is in play.
    pub const fn is_running(&self) -> bool {
        matches!(self.command, Command::ForceStart | Command::NormalStart | Command::DirectFree(_))
    }

    /// Whether a team may touch the ball.
    pub fn may_touch(&self, team: Team) -> bool {
        match self.command {
            Command::ForceStart => true,
            Command::NormalStart | Command::DirectFree(_) => {
                self.in_play || self.kicking_team() == Some(team)
            }
            Command::BallPlacement(placing) => placing == team,
            Command::Halt
            | Command::Stop
            | Command::PrepareKickoff(_)
            | Command::PreparePenalty(_)
            | Command::FreeBall
            | Command::GoalKick(_) => false,
        }
    }

    /// Whether a robot of a team may touch the ball.
    pub fn robot_may_touch(&self, robot: usize, team: Team) -> bool {
        self.may_touch(team) && self.kick_taker != Some(robot)
    }

    /// Forgets what rules followed while the ball was in play: a new kick begins.
    pub(crate) fn forget_play(&mut self) {
        self.in_play = false;
        self.kick_taker = None;
        self.last_touch = None;
        self.height_since_touch = ByTeam::default();
        self.dribbler = None;
        self.stuck_steps = 0;
        self.area_steps = ByTeam::default();
        self.defenders_steps = ByTeam::default();
        self.attackers_steps = ByTeam::default();
        self.had_defenders = ByTeam::default();
        self.had_attackers = ByTeam::default();
        (self.pusher, self.pushed) = (None, None);
        self.penalty_way = 0.0;
    }

    /// Robots that cards leave a team of `robots`.
    pub fn max_robots(&self, team: Team, robots: usize) -> usize {
        let yellow = self.yellow_steps_left[team].iter().filter(|steps| **steps > 0).count();
        let red = usize::try_from(self.red_cards[team]).unwrap_or(0);
        robots.saturating_sub(yellow + red)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::RefereeError;

    #[test]
    fn a_match_comes_back_from_its_row() {
        let mut game = Game::new(Team::Yellow);
        game.give(Command::BallPlacement(Team::Blue), Some(Command::DirectFree(Team::Blue)));
        game.score[Team::Yellow] = 3;
        game.yellow_steps_left[Team::Blue] = [17, 4800];
        game.height_since_touch[Team::Blue] = 0.25;
        game.kick_taker = Some(4);
        let row = game.row();
        assert_eq!(row.len(), Game::columns().len());
        assert_eq!(Game::read(&row), Ok(game));
    }

    #[test]
    fn columns_have_names_of_their_own() {
        let mut names = Game::columns();
        assert!(names.contains(&"score_blue".to_owned()));
        assert!(names.contains(&"yellow_steps_left_yellow_1".to_owned()));
        assert!(names.contains(&"designated_position_x".to_owned()));
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn rows_of_another_kind_are_refused_by_the_name_of_the_column() {
        let mut row = Game::new(Team::Blue).row();
        row[3] = 99.0;
        assert_eq!(Game::read(&row), Err(RefereeError::Column { name: "stage" }));
        row[3] = 0.0;
        row.push(0.0);
        assert!(matches!(Game::read(&row), Err(RefereeError::RowSize { .. })));
        row.truncate(4);
        assert_eq!(Game::read(&row), Err(RefereeError::Column { name: "stage_steps_left" }));
    }
}
