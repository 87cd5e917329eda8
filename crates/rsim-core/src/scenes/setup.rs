//! Starts of scenes beyond robots at given poses.

use super::{Scene, robots_mut, uniform};
use crate::models::robot::RobotModel;

impl Scene {
    /// Sets the velocity of a robot, in the field's frame.
    pub fn set_velocity(&mut self, robot: usize, [v_x, v_y]: [f32; 2]) {
        self.set_robot_column(robot, "v_x", v_x);
        self.set_robot_column(robot, "v_y", v_y);
    }

    /// Puts all robots somewhere else, apart from each other, facing anywhere. `seed` decides.
    pub fn scatter(&mut self, seed: u64) {
        let field = &self.config.field;
        let radius = self.config.robots().map(RobotModel::bounding_radius).fold(0.0, f32::max);
        let apart = 2.0 * radius + 0.005;
        // Clear of walls, goals and corner blocks.
        let half = [field.half_length() - 0.1 - radius, field.half_width() - 0.1 - radius];
        let mut places: Vec<[f32; 2]> = vec![[self.start[0], self.start[1]]];
        let mut key = seed << 20;
        for robot in robots_mut(&mut self.start) {
            let place = loop {
                key += 3;
                let place = [uniform(key) * half[0], uniform(key + 1) * half[1]];
                if places.iter().all(|at| (at[0] - place[0]).hypot(at[1] - place[1]) > apart) {
                    break place;
                }
            };
            places.push(place);
            let (sin, cos) = (uniform(key + 2) * std::f32::consts::PI).sin_cos();
            robot[..4].copy_from_slice(&[place[0], place[1], cos, sin]);
        }
    }
}
