//! The state of a match in one allocation, and its copies.

use super::State;
use crate::bodies::BodyBlock;

impl State<Vec<BodyBlock>> {
    /// The state in one allocation.
    pub(crate) fn boxed(self) -> Box<State> {
        // A box of a slice's size is made from one of an array's, which is a constant.
        macro_rules! with_blocks {
            ($($count:literal)*) => {
                match self.bodies.blocks.len() {
                    $($count => Box::new(self.in_array::<$count>()),)*
                    count => panic!("a match has 1 to 16 blocks of bodies, got {count}"),
                }
            };
        }
        with_blocks!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16)
    }

    fn in_array<const N: usize>(self) -> State<[BodyBlock; N]> {
        let Self { engine, ball, touches, crossing, absent, own_parameters, broken, bodies } = self;
        let bodies = bodies.map_blocks(|blocks| blocks.try_into().expect("N blocks"));
        State { engine, ball, touches, crossing, absent, own_parameters, broken, bodies }
    }
}

impl State {
    /// Takes the state of another match of the same configuration, without an allocation where neither
    /// has parameters of its own nor rapier.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        let Self { engine, ball, touches, crossing, absent, own_parameters, broken, bodies } =
            other;
        self.engine.clone_from(engine);
        self.ball = *ball;
        self.touches = *touches;
        self.crossing = *crossing;
        self.absent = *absent;
        self.own_parameters.clone_from(own_parameters);
        self.broken = *broken;
        self.bodies.copy_from(bodies);
    }
}

impl Clone for Box<State> {
    fn clone(&self) -> Self {
        let State { engine, ball, touches, crossing, absent, own_parameters, broken, bodies } =
            &**self;
        let copy = State {
            engine: engine.clone(),
            ball: *ball,
            touches: *touches,
            crossing: *crossing,
            absent: *absent,
            own_parameters: own_parameters.clone(),
            broken: *broken,
            bodies: bodies.to_vec(),
        };
        copy.boxed()
    }
}

#[cfg(test)]
mod tests {
    use std::mem::size_of_val;

    use super::*;
    use crate::body_parameters::BodyParameters;
    use crate::geometry::arena::walls;
    use crate::models::config::{EngineKind, SimConfig};

    fn state(config: &SimConfig) -> Box<State> {
        State::new(config, &BodyParameters::of(config), &walls(&config.field)).boxed()
    }

    fn bytes(state: &State) -> Vec<u8> {
        postcard::to_stdvec(state).expect("plain data")
    }

    #[test]
    fn a_state_is_a_block_of_few_kibibytes() {
        let size = |config: SimConfig| size_of_val::<State>(&state(&config));
        let [vss, ssl] = [size(SimConfig::vss(3, 3)), size(SimConfig::ssl(11, 11))];
        assert!(vss <= 3 * 512 && ssl <= 4 * 1024, "{vss} {ssl} bytes");
    }

    #[test]
    fn copies_have_every_number_of_a_state() {
        for engine in EngineKind::ALL {
            let config = SimConfig { engine, ..SimConfig::ssl(3, 2) };
            let (mut changed, pristine) = (state(&config), state(&config));
            let mut motion = changed.bodies.motion(4);
            motion.angular_velocity = 2.0;
            changed.place(4, &motion);
            changed.bodies.set_dribbling(1, 0.5);
            changed.bodies.add_collision(2, 0.25);
            changed.touches.add_ball(2);
            changed.ball.z = 0.1;
            changed.absent = 1 << 3;
            changed.broken = true;
            changed.own_parameters = Some(Box::new(BodyParameters::of(&config)));
            let clone = changed.clone();
            assert_eq!(bytes(&clone), bytes(&changed));
            assert_ne!(bytes(&clone), bytes(&pristine));
            changed.copy_from(&pristine);
            assert_eq!(bytes(&changed), bytes(&pristine));
        }
    }
}
