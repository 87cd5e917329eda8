//! Positions and velocities in the plane of the field.

use std::ops::{Add, Mul, Sub};

/// A position (m) or a velocity (m/s) in the plane of the field.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vector {
    /// Along the field, from the goal that blue defends to the goal that yellow defends.
    pub x: f32,
    /// Across the field, to the left of x.
    pub y: f32,
}

impl Vector {
    /// The vector with these components.
    pub const fn new(x: f32, y: f32) -> Self {
        Self { x, y }
    }

    /// Length.
    pub fn length(self) -> f32 {
        self.dot(self).sqrt()
    }

    /// Distance to another position.
    pub fn distance(self, other: Self) -> f32 {
        (self - other).length()
    }

    /// Scalar product.
    pub fn dot(self, other: Self) -> f32 {
        self.x * other.x + self.y * other.y
    }

    /// Distance to the segment from `start` to `end`.
    pub fn distance_to_segment(self, start: Self, end: Self) -> f32 {
        let along = end - start;
        let squared = along.dot(along);
        let share = if squared > 0.0 { (self - start).dot(along) / squared } else { 0.0 };
        self.distance(start + along * share.clamp(0.0, 1.0))
    }
}

impl Add for Vector {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl Sub for Vector {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y)
    }
}

impl Mul<f32> for Vector {
    type Output = Self;

    fn mul(self, factor: f32) -> Self {
        Self::new(self.x * factor, self.y * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_to_a_segment_is_that_to_its_nearest_point() {
        let (start, end) = (Vector::new(0.0, 0.0), Vector::new(2.0, 0.0));
        for (x, y, expected) in [(1.0, 0.5, 0.5), (-3.0, 4.0, 5.0), (5.0, -4.0, 5.0)] {
            let distance = Vector::new(x, y).distance_to_segment(start, end);
            assert!((distance - expected).abs() < 1e-6, "{x} {y}: {distance}");
        }
        assert!((Vector::new(3.0, 4.0).distance_to_segment(start, start) - 5.0).abs() < 1e-6);
    }
}
