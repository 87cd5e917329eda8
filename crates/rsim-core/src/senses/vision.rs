//! Cameras above the field, and the tracker that follows all bodies by their frames.

use serde::{Deserialize, Serialize};

use crate::blocks::blocks_of;
use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::senses::Watched;
use crate::senses::cameras::{Cameras, ROUNDING};
use crate::senses::driven::{DrivenRobots, Orders, Tracked};
use crate::senses::exposed::Film;
use crate::senses::fetch::Fetched;
use crate::senses::followed::Followed;
use crate::senses::frames::{CameraFrame, Frames};
use crate::senses::held::Beams;
use crate::senses::queue::most_under_way;
use crate::senses::random::Draws;
use crate::senses::tracker::Tracker;
use crate::state::State;

/// Cameras and tracker of both teams, or of one.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Vision {
    /// Key of the random numbers.
    pub(super) key: u64,
    cameras: Cameras,
    frames: Frames,
    /// `None` where one camera sees all, and where nothing is filtered.
    followed: Option<Followed>,
    pub(super) tracker: Tracker,
    /// Estimates for forecasts; `None` where nobody forecasts.
    pub(super) driven: Option<Box<DrivenRobots>>,
}

impl Vision {
    pub(super) fn new(config: &SimConfig, sensing: &Sensing, key: u64, draws: &mut Draws) -> Self {
        let cameras = Cameras::new(config, sensing, draws);
        let (robots, period) = (config.n_robots(), cameras.period());
        // Those on their way, those of a step, and the one to come.
        let seconds = sensing.delay + sensing.delay_jitter + config.time_step;
        let frames = Frames::new(blocks_of(robots), most_under_way(seconds, period));
        let tracker = Tracker::new(robots, sensing, period);
        let has_driven = sensing.forecast >= 0.5 && sensing.tracker >= 0.5;
        let driven = has_driven.then(|| Box::new(DrivenRobots::new(robots, sensing, period)));
        let has_others = cameras.count() > 1 && sensing.tracker >= 0.5;
        let followed = has_others.then(|| Followed::new(blocks_of(robots), period));
        Self { key, cameras, frames, followed, tracker, driven }
    }

    /// Fetches cameras, frames and tracker; what forecasts need besides is left out.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        self.cameras.fetch(fetched);
        self.frames.fetch(fetched);
        self.tracker.fetch(fetched);
    }

    /// Looks at bodies that were placed. Frames on their way show where they were before.
    pub(super) fn look(
        &mut self,
        now: f64,
        sensing: &Sensing,
        draws: &mut Draws,
        watched: Watched<'_>,
    ) {
        self.frames.forget_on_way();
        let mut first = Frames::new(blocks_of(watched.config.n_robots()), 1);
        self.cameras.look(now, sensing, draws, watched, &mut first);
        let Some(frame) = first.last() else { return };
        if let Some(followed) = &mut self.followed {
            followed.begin(frame.time, frame.blocks);
        }
        self.tracker.begin(frame);
        if let Some(driven) = &mut self.driven {
            driven.begin(frame);
        }
    }

    /// Exposes the frames that are due at a time (s), the end of a tick of a length (s).
    pub(super) fn expose(&mut self, now: (f64, f32), state: &State, film: &mut Film) {
        self.cameras.expose(now, self.key, state, film);
    }

    /// Number of ticks at whose end the next frame is exposed.
    pub(super) fn due(&self) -> u64 {
        self.cameras.due()
    }

    /// Takes in the frames that have arrived, with the break beams that are known to be cut and the commands that
    /// were sent.
    pub(super) fn receive<'a>(
        &mut self,
        now: f64,
        film: &Film,
        sensing: &Sensing,
        beams: Beams<'_>,
        orders: impl Fn() -> Orders<'a>,
    ) {
        self.frames.forget_arrived();
        let exposures = film.of(self.key, beams.parameters);
        self.cameras.develop(exposures, sensing, self.followed.as_mut(), &mut self.frames);
        while let Some(frame) = self.frames.arrive(now + ROUNDING) {
            self.tracker.take(sensing, frame, beams.parameters.ball.radius, Some(beams));
            if let Some(driven) = &mut self.driven {
                let held = self.tracker.held();
                driven.take(Tracked { frame, held, beams: Some(beams), sensing }, orders());
            }
        }
    }

    /// The frames that arrived in the last control step, in the order of their arrival.
    pub(super) fn camera_frames(&self) -> Vec<CameraFrame> {
        self.frames.camera_frames()
    }
}
