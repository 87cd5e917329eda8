//! Velocities and random poses of the robots of a scene.

use super::{Scene, robots_mut, uniform};
use crate::models::robot::RobotModel;

impl Scene {
    /// Sets the velocity of a robot, in the field's frame.
    pub fn set_velocity(&mut self, robot: usize, [v_x, v_y]: [f32; 2]) {
        self.set_robot_column(robot, "v_x", v_x);
        self.set_robot_column(robot, "v_y", v_y);
    }

    /// Gives all robots random poses, apart from each other. `seed` decides.
    pub fn scatter(&mut self, seed: u64) {
        let field = &self.config.field;
        let radius = self.config.robots().map(RobotModel::bounding_radius).fold(0.0, f32::max);
        let apart = 2.0 * radius + 0.005;
        // Clear of walls, goals and corner blocks.
        let half = [field.half_length() - 0.1 - radius, field.half_width() - 0.1 - radius];
        let mut positions: Vec<[f32; 2]> = vec![[self.start[0], self.start[1]]];
        let mut key = seed << 20;
        for robot in robots_mut(&mut self.start) {
            let position = loop {
                key += 3;
                let position = [uniform(key) * half[0], uniform(key + 1) * half[1]];
                if positions
                    .iter()
                    .all(|at| (at[0] - position[0]).hypot(at[1] - position[1]) > apart)
                {
                    break position;
                }
            };
            positions.push(position);
            let (sin, cos) = (uniform(key + 2) * std::f32::consts::PI).sin_cos();
            robot[..4].copy_from_slice(&[position[0], position[1], cos, sin]);
        }
    }
}
