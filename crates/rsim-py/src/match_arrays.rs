//! Arrays with the state of many matches under a referee.

use numpy::{Ix1, Ix2, PyReadwriteArray};
use pyo3::prelude::*;
use rsim_referee::game::Game;
use rsim_referee::{Referee, RefereeError};

use crate::arrays::writeable;

/// Numbers of one match in each array.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sizes {
    pub(crate) game: usize,
    /// Statistics that are counted in each step.
    pub(crate) counted: usize,
    /// The same, with the offenses behind them.
    pub(crate) statistics: usize,
    pub(crate) robots: usize,
    pub(crate) row: usize,
}

/// Arrays from Python: state of matches, statistics, and what tasks read of them.
#[derive(FromPyObject)]
pub(crate) struct MatchArrays<'py>(
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
);

/// The same, borrowed for writing.
pub(crate) struct Borrowed<'py> {
    game: PyReadwriteArray<'py, f32, Ix2>,
    statistics: PyReadwriteArray<'py, f32, Ix2>,
    score: PyReadwriteArray<'py, i64, Ix2>,
    seconds_left: PyReadwriteArray<'py, f32, Ix1>,
    may_touch: PyReadwriteArray<'py, bool, Ix2>,
}

impl<'py> MatchArrays<'py> {
    /// Checks the arrays of `n` matches, and borrows them.
    pub(crate) fn borrow(&self, n: usize, sizes: &Sizes) -> PyResult<Borrowed<'py>> {
        Ok(Borrowed {
            game: writeable("game", &self.0, &[n, sizes.game])?,
            statistics: writeable("statistics", &self.1, &[n, sizes.statistics])?,
            score: writeable("score", &self.2, &[n, 2])?,
            seconds_left: writeable("seconds_left", &self.3, &[n])?,
            may_touch: writeable("may_touch", &self.4, &[n, sizes.robots])?,
        })
    }
}

/// State of some matches, one after the other.
pub(crate) struct Matches<'a> {
    pub(crate) game: &'a mut [f32],
    pub(crate) statistics: &'a mut [f32],
    score: &'a mut [i64],
    seconds_left: &'a mut [f32],
    may_touch: &'a mut [bool],
}

impl Borrowed<'_> {
    /// All matches.
    pub(crate) fn matches(&mut self) -> PyResult<Matches<'_>> {
        Ok(Matches {
            game: self.game.as_slice_mut()?,
            statistics: self.statistics.as_slice_mut()?,
            score: self.score.as_slice_mut()?,
            seconds_left: self.seconds_left.as_slice_mut()?,
            may_touch: self.may_touch.as_slice_mut()?,
        })
    }
}

impl<'a> Matches<'a> {
    /// The same matches, `count` at a time.
    pub(crate) fn split(self, count: usize, sizes: &Sizes) -> impl Iterator<Item = Matches<'a>> {
        // Without robots there are no numbers of them, but matches.
        let robots = self.may_touch.chunks_mut((count * sizes.robots).max(1));
        let robots = robots.chain(std::iter::repeat_with(Default::default));
        self.game
            .chunks_mut(count * sizes.game)
            .zip(self.statistics.chunks_mut(count * sizes.statistics))
            .zip(self.score.chunks_mut(count * 2))
            .zip(self.seconds_left.chunks_mut(count))
            .zip(robots)
            .map(|((((game, statistics), score), seconds_left), may_touch)| Matches {
                game,
                statistics,
                score,
                seconds_left,
                may_touch,
            })
    }

    /// Reads the state of the first match.
    pub(crate) fn read(&self) -> Result<Game, RefereeError> {
        Game::read(self.game)
    }

    /// Writes the state of the first match, with what tasks read of it: goals of both teams, time left in
    /// the stage (s), and which robots may touch the ball.
    pub(crate) fn write(&mut self, game: &Game, referee: &Referee) {
        game.write(self.game);
        for (score, team) in self.score.iter_mut().zip(rsim_referee::Team::BOTH) {
            *score = i64::from(game.score[team]);
        }
        self.seconds_left[0] = referee.pitch().seconds(game.stage_steps_left).max(0.0);
        let layout = referee.layout();
        for (robot, may_touch) in self.may_touch.iter_mut().enumerate() {
            *may_touch = game.robot_may_touch(robot, layout.team_of(robot));
        }
    }
}
