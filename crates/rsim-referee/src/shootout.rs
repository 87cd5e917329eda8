//! The shoot-out: alternating penalty kicks until one team has won (SSL rules, "Shoot-Out").

use crate::config::RefereeConfig;
use crate::game::Game;
use crate::team::Team;

/// The team that kicks after a kick of `taker`; `None` if the match is over. Goals of the shoot-out count to the
/// score, which was even before. Each team has its kicks, even if the other one cannot catch up any more. The rules
/// name no end without a winner; here a match is a draw after `max_shootout_kicks` of each team.
#[allow(clippy::cast_precision_loss)] // a few kicks
pub(crate) fn next(game: &mut Game, config: &RefereeConfig, taker: Team) -> Option<Team> {
    game.shootout_kicks[taker] += 1;
    let [blue, yellow] = Team::BOTH.map(|team| game.shootout_kicks[team]);
    let is_draw = game.score[Team::Blue] == game.score[Team::Yellow];
    let most = config.max_shootout_kicks;
    let least = if is_draw { most } else { most.min(config.shootout_kicks) };
    let is_over = blue == yellow && blue as f32 >= least;
    (!is_over).then(|| taker.opponent())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kicks of a shoot-out in which `goals` says for each kick whether it is a goal, and the lead of the team
    /// that began.
    fn kicks(goals: &[bool]) -> (usize, i32) {
        let config = RefereeConfig::preset("ssl_2026_b").expect("a preset");
        let mut game = Game::new(Team::Blue);
        let mut taker = Team::Blue;
        for (nth, is_goal) in goals.iter().enumerate() {
            game.score[taker] += i32::from(*is_goal);
            match next(&mut game, &config, taker) {
                Some(team) => taker = team,
                None => return (nth + 1, game.score[Team::Blue] - game.score[Team::Yellow]),
            }
        }
        panic!("not decided");
    }

    #[test]
    fn each_team_has_five_kicks() {
        let blue_scores = [true, false, true, false, true, false, false, false, false, false];
        assert_eq!(kicks(&blue_scores), (10, 3), "they had lost after six kicks");
        let blue_fails = [false, true, false, false, false, false, false, false, false, false];
        assert_eq!(kicks(&blue_fails), (10, -1));
    }

    #[test]
    fn after_five_each_it_goes_on_in_pairs() {
        let mut goals = vec![true; 10];
        goals.extend([true, true, false, true]);
        assert_eq!(kicks(&goals), (14, -1));
        let mut goals = vec![false; 10];
        goals.extend([true, false]);
        assert_eq!(kicks(&goals), (12, 1));
    }

    #[test]
    fn it_is_a_draw_after_the_maximum_of_kicks() {
        assert_eq!(kicks(&[false; 20]), (20, 0));
        assert_eq!(kicks(&[true; 20]), (20, 0));
        let mut goals = vec![false; 18];
        goals.extend([false, true]);
        assert_eq!(kicks(&goals), (20, -1), "the last pair decides");
    }
}
