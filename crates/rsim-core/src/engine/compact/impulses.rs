//! Impulses of a contact, from which the next sub-step starts.

/// Impulses of a contact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Impulses {
    /// Feature and impulse along the normal (N s) of each point; feature 0 is none.
    pub(super) normals: [(u32, f32); 2],
    /// N s.
    pub(super) tangent: f32,
}

impl Impulses {
    /// Whether a point presses.
    pub(super) fn press(&self) -> bool {
        self.normals[0].1 > 0.0 || self.normals[1].1 > 0.0
    }

    /// Impulse along the normal of the point with this feature, N s.
    pub(super) fn normal_of(&self, feature: u32) -> f32 {
        let [(first, impulse), (second, other)] = self.normals;
        if first == feature {
            impulse
        } else if second == feature {
            other
        } else {
            0.0
        }
    }
}
