//! Decisions of a referee in a scene.

use rsim_referee::Team;
use rsim_referee::codes::Command;
use rsim_referee::events::EventKind;

use super::{Bot, Scene, Seen, Side, Them, Us};

impl Scene {
    /// Events of the last step, or of the last wait.
    pub(crate) fn events(&self) -> &[Seen] {
        &self.events
    }

    /// Events of a kind among them.
    pub(crate) fn count_of(&self, kind: EventKind) -> usize {
        self.events.iter().filter(|event| event.kind == kind).count()
    }

    /// The only event of a kind.
    pub(crate) fn only(&self, kind: EventKind) -> Seen {
        let mut found = self.events.iter().filter(|event| event.kind == kind);
        let first = *found.next().unwrap_or_else(|| panic!("no {kind:?} in {:?}", self.events));
        assert!(found.next().is_none(), "more than one {kind:?} in {:?}", self.events);
        first
    }

    /// Checks that a robot is at fault, or has scored, at a place.
    pub(crate) fn expect_bot(&self, kind: EventKind, bot: Bot, at: (f32, f32)) {
        let event = self.only(kind);
        assert_eq!((event.side, event.bot), (Some(bot.0), Some(bot)), "{event:?}");
        expect_near(event.at, at);
    }

    /// Checks that an event is about a team, and no robot of it.
    pub(crate) fn expect_team(&self, kind: EventKind, side: Option<Side>, at: (f32, f32)) {
        let event = self.only(kind);
        assert_eq!((event.side, event.bot), (side, None), "{event:?}");
        expect_near(event.at, at);
    }

    /// Checks that nothing happened, and play runs.
    pub(crate) fn expect_play(&self) {
        assert_eq!(self.events, [], "{:?}", self.game.command);
        assert!(self.game.is_running(), "{:?}", self.game.command);
    }

    /// Checks that play is stopped before a command for a team, with the ball at a place.
    pub(crate) fn expect_next(&self, next: fn(Team) -> Command, side: Side, place: (f32, f32)) {
        self.expect_next_for(next(self.team(side)), place);
    }

    /// Checks that play is stopped before a command, with the ball at a place.
    pub(crate) fn expect_next_for(&self, next: Command, place: (f32, f32)) {
        assert_eq!((self.game.command, self.game.next_command), (Command::Stop, Some(next)));
        expect_near(self.back(self.game.designated_position), place);
    }

    /// Checks the command.
    pub(crate) fn expect_command(&self, command: fn(Team) -> Command, side: Side) {
        assert_eq!(self.game.command, command(self.team(side)));
    }

    /// Checks the fouls of us and of them.
    pub(crate) fn expect_fouls(&self, us: i32, them: i32) {
        assert_eq!((self.fouls(Us), self.fouls(Them)), (us, them));
    }

    /// Fouls of a team.
    pub(crate) fn fouls(&self, side: Side) -> i32 {
        self.game.fouls[self.team(side)]
    }

    /// Goals of us and of them.
    pub(crate) fn score(&self) -> (i32, i32) {
        (self.game.score[self.team(Us)], self.game.score[self.team(Them)])
    }
}

/// Checks that two places are the same, but for rounding.
#[track_caller]
pub(crate) fn expect_near(got: (f32, f32), expected: (f32, f32)) {
    let distance = (got.0 - expected.0).hypot(got.1 - expected.1);
    assert!(distance < 2e-3, "expected {expected:?}, got {got:?}");
}
