//! Fouls that are raised once while they last, or again after a time.

use crate::game::Game;
use crate::team::Team;

/// Number of [`Repeated`] fouls.
pub const REPEATED: usize = 4;

/// A foul that does not stop play. SSL rules, "Non Stopping Fouls": it is not raised again before it has
/// ceased, or before some time has passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Repeated {
    /// An attacker touches the ball in the area that it attacks.
    AttackerTouch,
    /// A ball that is too fast.
    BallSpeed,
    /// A crash.
    Crash,
    /// A robot too close to the opponents' kick: "Fouls While Ball Out Of Play", once per team and time.
    KickPoint,
}

/// Pause in a foul below which it lasts: contacts of driving robots flicker, s.
pub const PAUSE_SECONDS: f32 = 0.1;

/// Lets the times of all repeated fouls pass by one step.
pub fn pass(game: &mut Game) {
    for team in Team::BOTH {
        for steps in &mut game.repeat_steps[team] {
            *steps = (*steps - 1).max(0);
        }
        for steps in &mut game.ceased_steps[team] {
            *steps = (*steps + 1).min(MANY);
        }
    }
}

/// A time that no comparison reaches, in steps.
const MANY: i32 = 1 << 20;

impl Repeated {
    /// Records that a team commits the foul in this step. Returns whether it is raised.
    ///
    /// `repeat` and `pause` are the times until it is raised again, and of a pause that ends it, in steps.
    pub fn commit(self, game: &mut Game, team: Team, repeat: i32, pause: i32) -> bool {
        let nth = self as usize;
        let lasts = self == Self::KickPoint || game.ceased_steps[team][nth] <= pause;
        game.ceased_steps[team][nth] = 0;
        if lasts && game.repeat_steps[team][nth] > 0 {
            return false;
        }
        game.repeat_steps[team][nth] = repeat;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps in which a foul that is committed in some steps is raised.
    fn raised(foul: Repeated, committed: impl Fn(i32) -> bool) -> Vec<i32> {
        let mut game = Game::new(Team::Blue);
        (0..100)
            .filter(|step| {
                pass(&mut game);
                committed(*step) && foul.commit(&mut game, Team::Yellow, 40, 4)
            })
            .collect()
    }

    #[test]
    fn a_foul_that_lasts_is_raised_again_after_the_time() {
        assert_eq!(raised(Repeated::Crash, |_| true), [0, 40, 80]);
        assert_eq!(raised(Repeated::Crash, |step| step % 4 == 0), [0, 40, 80], "it flickers");
    }

    #[test]
    fn a_foul_that_ceased_is_raised_at_once() {
        assert_eq!(raised(Repeated::BallSpeed, |step| step % 10 == 0).len(), 10);
        assert_eq!(raised(Repeated::KickPoint, |step| step % 10 == 0), [0, 40, 80]);
    }

    #[test]
    fn teams_and_fouls_have_times_of_their_own() {
        let mut game = Game::new(Team::Blue);
        assert!(Repeated::Crash.commit(&mut game, Team::Blue, 40, 4));
        assert!(!Repeated::Crash.commit(&mut game, Team::Blue, 40, 4));
        assert!(Repeated::Crash.commit(&mut game, Team::Yellow, 40, 4));
        assert!(Repeated::BallSpeed.commit(&mut game, Team::Blue, 40, 4));
    }
}
