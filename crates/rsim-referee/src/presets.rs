//! Rules of the leagues, with the source of each number.

use crate::config::{HalfEnd, League, RefereeConfig};

impl RefereeConfig {
    /// Names of the presets.
    pub const PRESETS: [&'static str; 4] = ["ssl_2026_a", "ssl_2026_b", "vsss_3v3", "vsss_5v5"];

    /// A preset by name; `None` if there is none.
    pub fn preset(name: &str) -> Option<Self> {
        match name {
            "ssl_2026_a" => Some(Self::ssl_2026_a()),
            "ssl_2026_b" => Some(Self::ssl_2026_b()),
            "vsss_3v3" => Some(Self::vsss_3v3()),
            "vsss_5v5" => Some(Self::vsss_5v5()),
            _ => None,
        }
    }

    /// SSL division A. Source: RoboCup-SSL/ssl-rules 4300196 (2026-05-21), chapters "Game Structure",
    /// "Referee Commands", "Ball Leaves The Field", "Scoring Goals" and "Offenses". The duration of a stop,
    /// the time to prepare and the way that is no progress are those of the game controller 78a9b3b
    /// (2026-08-03, `DefaultControllerConfig`); the way of pushing is that of the autoref Sumatra; the walls
    /// are 0.1 m high in ER-Force's and grSim's fields. The rules see no progress in a shoot-out after 10 kicks
    /// of each team, and name no end: here it ends then.
    fn ssl_2026_a() -> Self {
        Self {
            half_end: HalfEnd::NextStop,
            failed_placement_passes: true,
            half_seconds: 300.0,
            halves: 2.0,
            extra_half_seconds: 150.0,
            shootout_kicks: 5.0,
            max_shootout_kicks: 10.0,
            early_end_goals: 10.0,
            early_end_lead: 2.0,
            stop_seconds: 2.0,
            goal_stop_seconds: 2.0,
            halt_seconds: 2.0,
            prepare_seconds: 2.0,
            max_prepare_seconds: 10.0,
            kickoff_seconds: 10.0,
            free_kick_seconds: 5.0,
            penalty_seconds: 10.0,
            no_progress_seconds: 5.0,
            held_ball_seconds: 5.0,
            placement_seconds: 30.0,
            min_placement_seconds: 2.0,
            interference_seconds: 10.0,
            grace_seconds: 2.0,
            repeat_seconds: 2.0,
            goal_foul_seconds: 2.0,
            removal_seconds: 10.0,
            yellow_card_seconds: 120.0,
            in_play_distance: 0.05,
            dribble_distance: 1.0,
            no_progress_distance: 0.1,
            ball_distance: 0.5,
            area_distance: 0.2,
            push_distance: 0.2,
            goal_height: 0.15,
            boundary_height: 0.1,
            placement_tolerance: 0.15,
            placement_clearance: 0.05,
            placement_distance: 1.0,
            placement_area_distance: 0.7,
            kick_line_distance: 0.2,
            kick_area_distance: 1.0,
            goal_kick_distance: 1.0,
            penalty_distance: 1.0,
            ball_speed: 6.5,
            stop_speed: 1.5,
            crash_speed: 1.5,
            crash_difference: 0.3,
            stuck_speed: 0.1,
            fouls_per_card: 3.0,
            placement_failures: 5.0,
            ..Self::zero(League::Ssl)
        }
    }

    /// SSL division B: as division A, with more time to act, and aimless kicks.
    fn ssl_2026_b() -> Self {
        Self {
            aimless_kick: true,
            failed_placement_passes: false,
            free_kick_seconds: 10.0,
            no_progress_seconds: 10.0,
            held_ball_seconds: 10.0,
            ..Self::ssl_2026_a()
        }
    }

    /// VSSS, three a side. Source: the league's referee, VSSSLeague/VSSReferee 2862742 (2022-03-12),
    /// `src/constants/constants.json` and `referee/checkers`. Numbers of rules that only SSL has are 0. The
    /// numbers of the shoot-out are SSL's, since the league's referee leaves its end to people: the kicks of a
    /// team, and the time of a kick.
    fn vsss_3v3() -> Self {
        Self {
            half_seconds: 300.0,
            halves: 2.0,
            extra_half_seconds: 180.0,
            shootout_kicks: 5.0,
            max_shootout_kicks: 10.0,
            stop_seconds: 4.0,
            goal_stop_seconds: 8.0,
            prepare_seconds: 4.0,
            max_prepare_seconds: 4.0,
            penalty_seconds: 10.0,
            no_progress_seconds: 5.0,
            held_ball_seconds: 3.0,
            contest_distance: 1.5 * 0.075, // robot lengths
            stuck_speed: 0.1,
            area_robots: 2.0,
            ..Self::zero(League::Vsss)
        }
    }

    /// VSSS, five a side: as three a side, with limits of the larger area.
    fn vsss_5v5() -> Self {
        Self { large_area_defenders: 5.0, large_area_attackers: 4.0, ..Self::vsss_3v3() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_valid_and_come_back_as_text() {
        for name in RefereeConfig::PRESETS {
            let config = RefereeConfig::preset(name).expect("a preset");
            config.validate().expect(name);
            assert_eq!(config.numbers().count(), RefereeConfig::NUMBERS.len());
        }
        assert!(RefereeConfig::preset("ssl").is_none());
    }

    #[test]
    fn wrong_numbers_and_unknown_rules_are_named() {
        let mut config = RefereeConfig::preset("ssl_2026_a").expect("a preset");
        config.ball_speed = f32::NAN;
        let error = config.validate().expect_err("not a number").to_string();
        assert!(error.contains("ball_speed"), "{error}");
        config.ball_speed = 6.5;
        config.off = vec!["OFFSIDE".to_owned()];
        let error = config.validate().expect_err("no such rule").to_string();
        assert!(error.contains("OFFSIDE") && error.contains("BOT_CRASH_UNIQUE"), "{error}");
    }
}
