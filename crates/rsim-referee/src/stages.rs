//! Parts of a match: how long each lasts, and which follows (SSL rules, "Game Structure").

use crate::codes::{Command, Stage};
use crate::config::{Clock, RefereeConfig};
use crate::game::Game;
use crate::team::Team;

impl RefereeConfig {
    /// Duration of a stage, s; 0 for one that ends by events.
    pub const fn seconds(&self, stage: Stage) -> f32 {
        match stage {
            Stage::FirstHalf | Stage::SecondHalf => self.half_seconds,
            Stage::ExtraFirstHalf | Stage::ExtraSecondHalf => self.extra_half_seconds,
            _ => 0.0,
        }
    }

    /// The stage that follows at the end of one. Breaks have no duration, so play goes on at once.
    pub fn after(&self, stage: Stage, is_draw: bool) -> Stage {
        match stage {
            Stage::FirstHalfPre => Stage::FirstHalf,
            Stage::FirstHalf if self.halves > 1.0 => Stage::SecondHalfPre,
            Stage::HalfTime => Stage::SecondHalfPre,
            Stage::SecondHalfPre => Stage::SecondHalf,
            Stage::FirstHalf | Stage::SecondHalf | Stage::ExtraTimeBreak => {
                if is_draw && self.extra_half_seconds > 0.0 {
                    Stage::ExtraFirstHalfPre
                } else {
                    self.after(Stage::ExtraSecondHalf, is_draw)
                }
            }
            Stage::ExtraFirstHalfPre => Stage::ExtraFirstHalf,
            Stage::ExtraFirstHalf | Stage::ExtraHalfTime => Stage::ExtraSecondHalfPre,
            Stage::ExtraSecondHalfPre => Stage::ExtraSecondHalf,
            Stage::ExtraSecondHalf | Stage::ShootoutBreak => {
                if is_draw && self.shootout_kicks > 0.0 { Stage::Shootout } else { Stage::PostGame }
            }
            Stage::Shootout | Stage::PostGame => Stage::PostGame,
        }
    }

    /// Whether the score ends the match early ("Early Termination At A Score Of 10").
    #[allow(clippy::cast_precision_loss)] // few goals
    pub fn ends_early(&self, game: &Game) -> bool {
        let [blue, yellow] = Team::BOTH.map(|team| game.score[team]);
        self.early_end_goals > 0.0
            && game.stage < Stage::ShootoutBreak
            && blue.max(yellow) as f32 >= self.early_end_goals
            && (blue - yellow).abs() as f32 >= self.early_end_lead
    }

    /// Whether the match clock counts a step.
    pub fn counts(&self, game: &Game) -> bool {
        let is_played = match game.command {
            Command::NormalStart | Command::ForceStart | Command::DirectFree(_) => true,
            Command::Halt
            | Command::Stop
            | Command::PrepareKickoff(_)
            | Command::PreparePenalty(_)
            | Command::BallPlacement(_)
            | Command::FreeBall
            | Command::GoalKick(_) => false,
        };
        game.stage.is_played() && (is_played || self.clock == Clock::Running)
    }
}

/// Whether a match is in its shoot-out.
pub fn is_shootout(game: &Game) -> bool {
    game.stage == Stage::Shootout
}

/// The team that kicks off in a stage: the teams take turns.
pub const fn kickoff_of(stage: Stage, first: Team) -> Team {
    match stage {
        Stage::SecondHalfPre
        | Stage::SecondHalf
        | Stage::ExtraSecondHalfPre
        | Stage::ExtraSecondHalf => first.opponent(),
        _ => first,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules() -> RefereeConfig {
        RefereeConfig::preset("ssl_2026_b").expect("a preset")
    }

    fn stages(rules: &RefereeConfig, is_draw: bool) -> Vec<Stage> {
        let mut stages = vec![Stage::FirstHalfPre];
        while *stages.last().expect("one") != Stage::PostGame {
            stages.push(rules.after(*stages.last().expect("one"), is_draw));
        }
        stages
    }

    #[test]
    fn a_match_that_is_won_ends_after_two_halves() {
        use Stage::{FirstHalf, FirstHalfPre, PostGame, SecondHalf, SecondHalfPre};
        let expected = [FirstHalfPre, FirstHalf, SecondHalfPre, SecondHalf, PostGame];
        assert_eq!(stages(&rules(), false), expected);
        let one = RefereeConfig { halves: 1.0, ..rules() };
        assert_eq!(stages(&one, false), [FirstHalfPre, FirstHalf, PostGame]);
    }

    #[test]
    fn a_draw_leads_to_extra_time_and_a_shootout_where_there_are_any() {
        let drawn = stages(&rules(), true);
        assert_eq!(drawn.len(), 10);
        assert_eq!(drawn[4..6], [Stage::ExtraFirstHalfPre, Stage::ExtraFirstHalf]);
        assert_eq!(drawn[8], Stage::Shootout);
        let no_extra = RefereeConfig { extra_half_seconds: 0.0, ..rules() };
        assert_eq!(stages(&no_extra, true)[4..], [Stage::Shootout, Stage::PostGame]);
        let neither = RefereeConfig { shootout_kicks: 0.0, ..no_extra };
        assert_eq!(stages(&neither, true)[4..], [Stage::PostGame]);
    }

    #[test]
    fn a_lead_of_two_from_ten_goals_ends_the_match() {
        let mut game = Game::new(Team::Blue);
        for (blue, yellow, expected) in
            [(9, 0, false), (10, 9, false), (10, 8, true), (0, 10, true)]
        {
            (game.score[Team::Blue], game.score[Team::Yellow]) = (blue, yellow);
            assert_eq!(rules().ends_early(&game), expected, "{blue} {yellow}");
            assert!(!RefereeConfig { early_end_goals: 0.0, ..rules() }.ends_early(&game));
        }
    }

    #[test]
    fn the_clock_counts_while_a_team_may_play_the_ball() {
        let mut game = Game::new(Team::Blue);
        game.stage = Stage::FirstHalf;
        let running = RefereeConfig { clock: Clock::Running, ..rules() };
        for (command, in_play, expected) in [
            (Command::NormalStart, true, true),
            (Command::NormalStart, false, true),
            (Command::PrepareKickoff(Team::Blue), false, false),
            (Command::DirectFree(Team::Blue), false, true),
            (Command::Stop, true, false),
            (Command::BallPlacement(Team::Blue), true, false),
        ] {
            game.give(command, None);
            game.in_play = in_play;
            assert_eq!(rules().counts(&game), expected, "{command:?}");
            assert!(running.counts(&game));
        }
        game.stage = Stage::SecondHalfPre;
        assert!(!running.counts(&game));
    }

    #[test]
    fn the_teams_take_turns_at_kickoffs() {
        let first = Team::Yellow;
        assert_eq!(kickoff_of(Stage::FirstHalfPre, first), first);
        assert_eq!(kickoff_of(Stage::SecondHalfPre, first), first.opponent());
        assert_eq!(kickoff_of(Stage::ExtraFirstHalfPre, first), first);
        assert_eq!(kickoff_of(Stage::ExtraSecondHalfPre, first), first.opponent());
    }
}
