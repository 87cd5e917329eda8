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

#[test]
fn a_line_up_is_that_of_the_other_team_after_half_a_turn() {
    for division in [A, B] {
        let referee = referee(division, |_| {});
        let mut row = vec![0.0; referee.layout().row_size()];
        referee.line_up(&mut row, 0).expect("a row of this layout");
        let sight = referee.layout().sight(&row).expect("a row of this layout");
        let (lines, size) = (&referee.pitch().lines, referee.layout().team_size(Team::Blue));
        for number in 0..size {
            let [blue, yellow] =
                [number, size + number].map(|index| sight.robot(index).expect("present").position);
            expect_near((blue.x, blue.y), (-yellow.x, -yellow.y));
            assert!(blue.x < 0.0);
        }
        // The third robot of blue is on the left of the second, as blue sees the field.
        let third = sight.robot(2).expect("present").position;
        expect_near((third.x, third.y), (-0.5 * lines.half_length, 0.25 * lines.half_width));
        assert_eq!(sight.ball().position, rsim_referee::Vector::default());
        assert!(sight.robots().all(|robot| robot.heading.x * robot.position.x < 0.0));
    }
}
