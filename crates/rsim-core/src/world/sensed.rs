//! A match whose robots do not know the true state or do not obey exactly.

use std::sync::Arc;

use crate::body_parameters::BodyParameters;
use crate::engine::{NonFinite, Scratch};
use crate::forecast::Knowledge;
use crate::models::sensing::Sensing;
use crate::senses::exposed::Film;
use crate::senses::frames::CameraFrame;
use crate::senses::{Senses, Watched};
use crate::state::{Setup, State};
use crate::tick::Tick;
use crate::world::World;

impl World {
    /// Begins senses anew. `key` makes their errors the match's own.
    pub(super) fn set_senses(&mut self, key: u64, sensing: Option<Arc<Sensing>>) {
        // The new ones take the memory of the old.
        self.senses = None;
        self.senses = sensing.map(|sensing| Box::new(Senses::new(sensing, key, self.watched())));
    }

    /// Replaces numbers of the senses that are those of the configuration by the shared ones.
    pub(super) fn share_sensing(&mut self) {
        if let (Some(senses), Some(shared)) = (&mut self.senses, &self.shared.sensing) {
            senses.share(shared);
        }
    }

    /// Has the senses look at bodies that were moved by hand.
    pub(super) fn look_again(&mut self) {
        if let Some(mut senses) = self.senses.take() {
            senses.look(self.watched());
            self.senses = Some(senses);
        }
    }

    /// Writes the row of what the first team's robots know: the state row without senses.
    pub fn write_sensed_row(&self, out: &mut [f32]) {
        self.write_row_known_to(Knowledge::Blue, out);
    }

    /// Writes the row of what a team's cameras and robots have reported: the state row without senses.
    pub(super) fn write_row_as_seen(&self, knowledge: Knowledge, out: &mut [f32]) {
        match &self.senses {
            None => self.write_row(out),
            Some(senses) => senses.write_row(knowledge, &self.state, out),
        }
    }

    /// The frames of the cameras, of the first team's where each has its own, that arrived in the last control
    /// step; none without senses.
    pub fn camera_frames(&self) -> Vec<CameraFrame> {
        self.senses.as_ref().map_or_else(Vec::new, |senses| senses.camera_frames())
    }

    /// Begins a control step: commands are sent to the robots.
    pub(super) fn begin_step(&mut self, commands: &[f32]) {
        if self.is_lost() {
            return;
        }
        if let Some(senses) = &mut self.senses {
            senses.send(commands, &self.shared.setup.config);
        }
    }

    /// Ends a control step with the exposures of its ticks: robots report, and what has arrived is known.
    pub(super) fn end_step(&mut self, film: &Film) {
        if self.is_lost() {
            return;
        }
        if let Some(mut senses) = self.senses.take() {
            senses.end_step(film, self.watched(), &self.shared.setup.parameters);
            self.senses = Some(senses);
        }
    }

    fn watched(&self) -> Watched<'_> {
        let config = &self.shared.setup.config;
        Watched { config, parameters: self.parameters(), state: &self.state }
    }
}

/// Advances a match by the ticks of a control step, between commands that were sent and cameras.
pub(super) fn advance_sensed(
    engine: &mut Scratch,
    setup: &Setup,
    parameters: &BodyParameters,
    state: &mut State,
    (senses, film): (&mut Senses, &mut Film),
) -> Result<(), NonFinite> {
    let config = &setup.config;
    for _ in 0..config.ticks_per_step() {
        senses.receive(setup, parameters, state);
        Tick { setup, parameters, commands: senses.obeyed() }.advance(state, engine)?;
        senses.watch(Watched { config, parameters, state }, film);
    }
    Ok(())
}
