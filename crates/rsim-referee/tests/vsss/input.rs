//! Input that a referee refuses.

use rsim_referee::game::Game;
use rsim_referee::statistics::Statistics;
use rsim_referee::{Decisions, RefereeError, Team};

use crate::pitches::Size;
use crate::scene::Scene;

#[test]
fn rows_of_another_length_are_refused_and_change_nothing() {
    let scene = Scene::in_play(Size::Three);
    let size = scene.row.len();
    for lengths in [[size - 1, size, size], [size, size + 1, size], [size, size, 0]] {
        let [before, after, mut restart] = lengths.map(|length| vec![0.0; length]);
        let (mut game, mut statistics) = (scene.game.clone(), Statistics::default());
        let decisions = &mut Decisions::default();
        let (referee, restart) = (&scene.referee, &mut restart);
        let error = referee.judge(&before, &after, &mut game, &mut statistics, restart, decisions);
        let got = lengths.into_iter().find(|length| *length != size).expect("one is wrong");
        assert_eq!(error, Err(RefereeError::RowSize { expected: size, got }));
        assert_eq!((game, statistics), (scene.game.clone(), Statistics::default()));
    }
    let error = scene.referee.begin(&[0.0; 3], &mut Game::new(Team::Blue));
    assert_eq!(error, Err(RefereeError::RowSize { expected: size, got: 3 }));
}

#[test]
fn a_match_that_begins_elsewhere_has_a_ball_that_is_not_stuck() {
    let mut scene = Scene::in_play(Size::Three);
    scene.ball([0.1, 0.1]);
    scene.run(4.0);
    scene.referee.begin(&scene.row, &mut scene.game).expect("its row");
    assert_eq!(scene.run(4.9), []);
    assert_eq!(scene.run(0.1).len(), 1);
}
