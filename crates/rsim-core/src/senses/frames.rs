//! Frames of the cameras: detections at one instant, and those on their way.

use serde::{Deserialize, Serialize};

use crate::blocks::{place_of, robot, robot_at, set_bits};
use crate::geometry::motion::Motion;
use crate::senses::block_ring::BlockRing;
use crate::senses::detections::{
    BallMotion, DetectedBall, DetectedBlock, DetectedRobot, Velocities,
};
use crate::senses::fetch::Fetched;
use crate::senses::followed::{Followed, OtherDetections};
use crate::senses::queue::remove_first;

/// A frame: detections of all cameras at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame<'a> {
    /// Time of the exposure since the senses began, s.
    pub(super) time: f64,
    pub(super) balls: &'a [DetectedBall],
    /// Robots, by block.
    pub(super) blocks: &'a [DetectedBlock],
    /// Detections of robots that do not count: another camera has detected these robots, too, or follows them.
    pub(super) again: &'a [DetectedRobot],
    /// Motions of the balls and velocities of the robots, by block; empty where only cameras tell them.
    ball_motions: &'a [BallMotion],
    velocities: &'a [Velocities],
}

impl<'a> Frame<'a> {
    /// A frame of bodies whose motions are unknown.
    pub(super) fn of_positions(
        time: f64,
        balls: &'a [DetectedBall],
        blocks: &'a [DetectedBlock],
    ) -> Self {
        Self { time, balls, blocks, again: &[], ball_motions: &[], velocities: &[] }
    }

    /// The balls with their motions; those of a body at rest where they are unknown.
    pub(super) fn moving_balls(&self) -> impl Iterator<Item = (&'a DetectedBall, BallMotion)> {
        let motions = self.ball_motions;
        let motion = move |nth| motions.get(nth).copied().unwrap_or_default();
        self.balls.iter().enumerate().map(move |(nth, ball)| (ball, motion(nth)))
    }

    /// Indices of the detected robots with their motions, which are those of a body at rest where they are unknown.
    pub(super) fn moving_robots(&self) -> impl Iterator<Item = (usize, Motion)> {
        let velocities = self.velocities;
        self.blocks.iter().enumerate().flat_map(move |(nth, block)| {
            let moving = velocities.get(nth).copied().unwrap_or_default();
            set_bits(block.bodies.into()).map(move |lane| {
                let motion = Motion {
                    position: block.position.get(lane),
                    heading: block.heading.get(lane),
                    velocity: moving.linear.get(lane),
                    angular_velocity: moving.angular.as_array()[lane],
                };
                (robot_at(nth, lane), motion)
            })
        })
    }

    /// The frame as readers outside the senses get it.
    fn to_camera_frame(self) -> CameraFrame {
        let balls = self.balls.iter().map(|ball| {
            let DetectedBall { position, z, camera } = *ball;
            [f32::from(camera), position.x, position.y, z]
        });
        #[expect(clippy::cast_possible_truncation, reason = "at most 63 robots")]
        let first = self.moving_robots().map(|(index, Motion { position, heading, .. })| {
            let (block, lane) = place_of(robot(index));
            let camera = self.blocks[block].cameras[lane];
            DetectedRobot { position, heading, robot: index as u8, camera }
        });
        let all = first.chain(self.again.iter().copied()).map(|seen| {
            let DetectedRobot { position, heading, robot, camera } = seen;
            let [camera, robot] = [camera, robot].map(f32::from);
            [camera, robot, position.x, position.y, heading.x, heading.y]
        });
        let mut robots: Vec<[f32; 6]> = all.collect();
        robots.sort_by(|one, other| one[0].total_cmp(&other[0]));
        CameraFrame { time: self.time, balls: balls.collect(), robots }
    }
}

/// Detections of all cameras at one instant, as software of teams gets them.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraFrame {
    /// Time of the exposure since the senses began, s.
    pub time: f64,
    /// For each detected ball the index of the camera, and position x, y and height, m.
    pub balls: Vec<[f32; 4]>,
    /// For each detected robot the index of the camera, its index in a state row, position x and y (m), and
    /// cosine and sine of the heading, whose length is near 1. Those of a camera follow each other.
    pub robots: Vec<[f32; 6]>,
}

/// Frames in the order of their arrival: those that arrived in the last control step, then those on their way.
///
/// Balls, and robots detected again, of all frames follow each other, the oldest first, and robots by block are in a
/// ring: many matches have to fit into a processor's cache.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Frames {
    ends: Vec<Ends>,
    balls: Vec<DetectedBall>,
    blocks: BlockRing,
    again: Vec<DetectedRobot>,
    ball_motions: Vec<BallMotion>,
    velocities: Vec<Velocities>,
    /// Number of frames that have arrived.
    arrived: usize,
}

/// Times of a frame, and the ends of its detections in those of all frames.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Ends {
    time: f64,
    /// Time of the arrival, s.
    due: f64,
    balls: u32,
    again: u32,
}

/// Robots detected again in the frame to come: those of `all` from the first on.
struct AddedAgain<'a> {
    all: &'a mut Vec<DetectedRobot>,
    first: usize,
}

impl OtherDetections for AddedAgain<'_> {
    fn exchange(&mut self, wanted: u8, given: &mut DetectedRobot) -> bool {
        let mut added = self.all[self.first..].iter_mut();
        let found = added.find(|other| (other.robot, other.camera) == (given.robot, wanted));
        found.is_some_and(|other| {
            std::mem::swap(other, given);
            true
        })
    }

    fn add(&mut self, seen: DetectedRobot) {
        self.all.push(seen);
    }
}

impl Frames {
    /// No frames yet, of robots in a number of blocks, with memory for some frames.
    pub(super) fn new(blocks: usize, frames: usize) -> Self {
        Self {
            ends: Vec::with_capacity(frames),
            balls: Vec::with_capacity(2 * frames),
            blocks: BlockRing::new(blocks, frames),
            again: Vec::with_capacity(2 * frames),
            ball_motions: Vec::new(),
            velocities: Vec::new(),
            arrived: 0,
        }
    }

    /// Fetches the times of all frames, what the next one to arrive has, and the place of the one to come.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        self.ends.iter().for_each(|ends| fetched.number(ends.due.to_bits()));
        self.balls.iter().step_by(4).for_each(|ball| fetched.number(ball.z.to_bits().into()));
        let arrives = self.arrived < self.ends.len();
        let arrives = if arrives { self.blocks.frame(self.arrived) } else { &[] };
        for block in arrives.iter().chain(self.blocks.next_if_any()) {
            fetched.lanes(&block.position.x);
            fetched.lanes(&block.heading.y);
        }
    }

    /// Forgets the frames on their way.
    pub(super) fn forget_on_way(&mut self) {
        self.ends.truncate(self.arrived);
        let [balls, again] = self.ends_of(self.arrived);
        self.balls.truncate(balls);
        self.blocks.truncate(self.arrived);
        self.again.truncate(again);
        self.ball_motions.truncate(balls);
        self.velocities.truncate(self.arrived * self.blocks.each());
    }

    /// Adds a frame that was exposed at `time` and arrives at `due`, s, but not before an earlier one: the detections
    /// that were added since the last one.
    pub(super) fn end_frame(&mut self, time: f64, due: f64) {
        let on_way = &self.ends[self.arrived..];
        let due = on_way.last().map_or(due, |last| due.max(last.due));
        #[expect(clippy::cast_possible_truncation, reason = "detections of a second")]
        let [balls, again] = [self.balls.len(), self.again.len()].map(|end| end as u32);
        self.ends.push(Ends { time, due, balls, again });
        self.blocks.add();
    }

    /// Adds a ball.
    pub(super) fn add_ball(&mut self, ball: DetectedBall, motion: Option<BallMotion>) {
        self.balls.push(ball);
        self.ball_motions.extend(motion);
    }

    /// Robots of the frame to come, by block. What is here means nothing before it is set.
    pub(super) fn blocks(&mut self) -> &mut [DetectedBlock] {
        self.blocks.next()
    }

    /// Adds the velocities of a block of robots of the frame to come.
    pub(super) fn add_velocities(&mut self, velocities: Velocities) {
        self.velocities.push(velocities);
    }

    /// Chooses the detections of the frame to come that count, of those that were added.
    pub(super) fn choose(&mut self, time: f64, followed: &mut Followed) {
        let first = self.ends.last().map_or(0, |last| last.again as usize);
        let mut again = AddedAgain { all: &mut self.again, first };
        followed.choose(time, self.blocks.next(), &mut again);
    }

    /// Adds a robot that another camera has detected.
    pub(super) fn add_again(&mut self, robot: DetectedRobot) {
        self.again.push(robot);
    }

    /// Forgets the frames that have arrived.
    pub(super) fn forget_arrived(&mut self) {
        if self.arrived == 0 {
            return;
        }
        let [balls, again] = self.ends_of(self.arrived);
        remove_first(&mut self.ends, self.arrived);
        remove_first(&mut self.balls, balls);
        remove_first(&mut self.again, again);
        self.blocks.forget_first(self.arrived);
        // These are all there, or none.
        remove_first(&mut self.ball_motions, balls);
        remove_first(&mut self.velocities, self.arrived * self.blocks.each());
        self.arrived = 0;
        #[expect(clippy::cast_possible_truncation, reason = "they were of this size")]
        let [balls, again] = [balls, again].map(|end| end as u32);
        for frame in &mut self.ends {
            frame.balls -= balls;
            frame.again -= again;
        }
    }

    /// Lets the next frame arrive that is due at `now`, s; `None` if there is none.
    pub(super) fn arrive(&mut self, now: f64) -> Option<Frame<'_>> {
        self.ends.get(self.arrived).filter(|next| next.due <= now)?;
        self.arrived += 1;
        Some(self.frame(self.arrived - 1))
    }

    /// The frames that arrived in the last control step, as readers outside the senses get them.
    pub(super) fn camera_frames(&self) -> Vec<CameraFrame> {
        (0..self.arrived).map(|nth| self.frame(nth).to_camera_frame()).collect()
    }

    /// The last frame.
    pub(super) fn last(&self) -> Option<Frame<'_>> {
        self.ends.len().checked_sub(1).map(|last| self.frame(last))
    }

    /// Ends of the detections of the first `count` frames: balls, and robots detected again.
    fn ends_of(&self, count: usize) -> [usize; 2] {
        let last = count.checked_sub(1).map(|last| self.ends[last]);
        last.map_or([0; 2], |last| [last.balls, last.again].map(|end| end as usize))
    }

    fn frame(&self, nth: usize) -> Frame<'_> {
        let ([ball, again], [balls, agains]) = (self.ends_of(nth), self.ends_of(nth + 1));
        let [block, blocks] = [nth, nth + 1].map(|nth| nth * self.blocks.each());
        Frame {
            time: self.ends[nth].time,
            balls: &self.balls[ball..balls],
            blocks: self.blocks.frame(nth),
            again: &self.again[again..agains],
            ball_motions: self.ball_motions.get(ball..balls).unwrap_or_default(),
            velocities: self.velocities.get(block..blocks).unwrap_or_default(),
        }
    }
}
