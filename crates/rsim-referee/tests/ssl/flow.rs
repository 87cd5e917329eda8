//! Errors, and matches that begin.

use rsim_referee::statistics::Statistics;
use rsim_referee::{Decisions, RefereeError, Team};

use crate::scene::{A, B, Side, expect_near, referee, views};

#[test]
fn rows_of_another_length_are_refused_and_change_nothing() {
    let referee = referee(B, |_| {});
    let mut game = rsim_referee::game::Game::new(Team::Blue);
    let before = game.clone();
    let size = referee.layout().row_size();
    let (row, short) = (vec![0.0; size], vec![0.0; size - 1]);
    for (first, second) in [(&row, &short), (&short, &row)] {
        let error = referee
            .judge(
                first,
                second,
                &mut game,
                &mut Statistics::default(),
                &mut row.clone(),
                &mut Decisions::default(),
            )
            .expect_err("too short");
        assert_eq!(error, RefereeError::RowSize { expected: size, got: size - 1 });
    }
    assert!(referee.begin(&short, &mut game).is_err());
    assert_eq!(game, before);
}

#[test]
fn a_line_up_is_one_that_a_kick_off_allows() {
    for division in [A, B] {
        for mut scene in views(division) {
            scene.game = rsim_referee::game::Game::new(scene.team(crate::scene::Us));
            let before = scene.robots();
            for _ in 0..scene.steps(2.0) {
                scene.step();
                assert!(!scene.restarted);
            }
            assert_eq!(scene.robots(), before, "nobody was put elsewhere");
            assert_eq!(scene.game.command, rsim_referee::codes::Command::NormalStart);
            expect_near(scene.ball_at(), (0.0, 0.0));
        }
    }
}

#[test]
fn a_match_begins_where_its_ball_is() {
    for mut scene in views(B) {
        scene.ball(1.0, 1.0);
        scene.free_kick(Side::Us);
        let row: Vec<f32> = {
            let mut row = vec![0.0; scene.referee.layout().row_size()];
            row[0] = 0.5;
            row
        };
        scene.referee.begin(&row, &mut scene.game).expect("a row of this layout");
        assert!((scene.game.kick_position.x - 0.5).abs() < 1e-6);
        assert!((scene.game.stuck_position.x - 0.5).abs() < 1e-6);
    }
}
