//! Cameras above the field, and the tracker that follows all bodies by their frames.

use serde::{Deserialize, Serialize};

use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::senses::Watched;
use crate::senses::cameras::Cameras;
use crate::senses::detections::{CameraFrame, Detections};
use crate::senses::driven::{DrivenRobots, Orders, Tracked};
use crate::senses::held::Beams;
use crate::senses::random::Draws;
use crate::senses::tracker::Tracker;

/// Cameras and tracker of both teams, or of one.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Vision {
    /// Key of the random numbers.
    pub(super) key: u64,
    cameras: Cameras,
    /// Frames that arrived in the last control step. The match does not depend on them.
    arrived: Vec<Detections>,
    pub(super) tracker: Tracker,
    /// Estimates for forecasts; `None` where nobody forecasts.
    pub(super) driven: Option<DrivenRobots>,
}

impl Vision {
    pub(super) fn new(config: &SimConfig, sensing: &Sensing, key: u64, draws: &mut Draws) -> Self {
        let cameras = Cameras::new(config, sensing, draws);
        let (robots, period) = (config.n_robots(), cameras.period());
        let tracker = Tracker::new(robots, sensing, period);
        let has_driven = sensing.forecast >= 0.5 && sensing.tracker >= 0.5;
        let driven = has_driven.then(|| DrivenRobots::new(robots, sensing, period));
        Self { key, cameras, arrived: Vec::new(), tracker, driven }
    }

    /// Looks at bodies that were placed.
    pub(super) fn look(
        &mut self,
        now: f64,
        sensing: &Sensing,
        draws: &mut Draws,
        watched: Watched<'_>,
    ) {
        self.cameras.forget();
        let frame = self.cameras.look(now, sensing, draws, watched.state, watched.parameters);
        self.tracker.begin(&frame);
        if let Some(driven) = &mut self.driven {
            driven.begin(&frame);
        }
    }

    /// Exposes the frames that are due.
    pub(super) fn expose(&mut self, now: f64, sensing: &Sensing, watched: Watched<'_>) {
        self.cameras.expose(now, (sensing, self.key), watched.state, watched.parameters);
    }

    /// Takes in the frames that have arrived, with the break beams that are known to be cut and the commands that
    /// were sent.
    pub(super) fn receive(
        &mut self,
        now: f64,
        sensing: &Sensing,
        beams: Beams<'_>,
        orders: Orders<'_>,
    ) {
        for frame in self.arrived.drain(..) {
            self.cameras.recycle(frame);
        }
        while let Some(frame) = self.cameras.arrived(now) {
            self.tracker.take(sensing, &frame, beams.parameters.ball.radius, Some(beams));
            if let Some(driven) = &mut self.driven {
                let held = self.tracker.held();
                let tracked = Tracked { frame: &frame, held, beams: Some(beams), sensing };
                driven.take(tracked, orders);
            }
            self.arrived.push(frame);
        }
    }

    /// The frames that arrived in the last control step, in the order of their arrival.
    pub(super) fn camera_frames(&self) -> Vec<CameraFrame> {
        self.arrived.iter().map(Detections::to_camera_frame).collect()
    }
}
