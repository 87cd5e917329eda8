//! The shoot-out: alternating penalty kicks until one team has won (SSL rules, "Shoot-Out").

use crate::config::RefereeConfig;
use crate::game::Game;
use crate::team::Team;

/// The team that kicks after a kick of `taker`; `None` if the match is decided. Goals of the shoot-out count
/// to the score, which was even before.
#[allow(clippy::cast_possible_truncation)] // a few kicks
pub(crate) fn next(game: &mut Game, config: &RefereeConfig, taker: Team) -> Option<Team> {
    game.shootout_kicks[taker] += 1;
    let kicks = config.shootout_kicks as i32;
    let lead = game.score[Team::Blue] - game.score[Team::Yellow];
    let [blue_left, yellow_left] = Team::BOTH.map(|team| kicks - game.shootout_kicks[team]);
    let is_decided = if blue_left > 0 || yellow_left > 0 {
        lead > yellow_left || -lead > blue_left
    } else {
        blue_left == yellow_left && lead != 0
    };
    (!is_decided).then(|| taker.opponent())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kicks of a shoot-out in which `goals` says for each kick whether it is a goal.
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
    fn it_ends_when_one_team_cannot_catch_up() {
        let blue_scores = [true, false, true, false, true, false];
        assert_eq!(kicks(&blue_scores), (6, 3), "two kicks are left for a lead of three");
        let blue_fails = [false, true, false, true, false, true];
        assert_eq!(kicks(&blue_fails), (6, -3));
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
}
