//! How a leaf stands on its axis: away from it, and towards the light.

use glam::{DMat3, DVec3};

use super::Foot;
use super::plan::Posture;
use crate::random::{Use, bell};
use crate::rotation::about;

/// Least cosine of the petiole's foot to the direction away from the axis that turning to the light
/// leaves: it does not bend into the axis.
pub(super) const LEAST_AWAY: f64 = 0.12;
/// Halvings of a turn that would bend it there.
const HALVINGS: u32 = 10;

/// A place where a leaf stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    /// Direction of the axis.
    pub(super) along: DVec3,
    /// Away from the axis, at right angles to it.
    pub(super) radial: DVec3,
    /// Angle of the petiole's foot from the axis.
    pub(super) angle: f64,
    /// Number of the leaf within the plant.
    pub(super) number: u64,
}

impl Stand {
    /// Direction of the petiole's foot before it turns to the light.
    pub(super) fn petiole(&self) -> DVec3 {
        self.along * libm::cos(self.angle) + self.radial * libm::sin(self.angle)
    }

    /// From the leaf's frame to the plant's, of a leaf whose adaxial side faces the tip of its axis.
    pub(super) fn facing_tip(&self, foot: &Foot) -> DMat3 {
        let petiole = self.petiole();
        let adaxial = self.along - petiole * self.along.dot(petiole);
        let adaxial = adaxial.try_normalize().unwrap_or(-self.radial);
        let frame = DMat3::from_cols(petiole.cross(adaxial), petiole, adaxial);
        frame * foot.frame.transpose()
    }
}

impl Posture {
    /// From the leaf's frame to the plant's, of a leaf that is held so: a rotation.
    ///
    /// First its adaxial side faces the tip of the axis. Then the petiole twists about itself until
    /// the blade faces the light best, and what is missing it bends, as far as it stays off the
    /// axis.
    pub(super) fn turned(&self, stand: &Stand, foot: &Foot, seed: u64) -> DMat3 {
        let petiole = stand.petiole();
        let mut turn = stand.facing_tip(foot);
        let facing = |turn: &DMat3| turn.z_axis;
        let flat = |v: DVec3| v - petiole * v.dot(petiole);
        let (from, to) = (flat(facing(&turn)), flat(self.light));
        if from.length() > 1e-6 && to.length() > 1e-6 {
            let twist = libm::atan2(from.cross(to).dot(petiole), from.dot(to));
            turn = about(petiole, self.to_light * twist) * turn;
        }
        let normal = facing(&turn).cross(self.light);
        if let Some(axis) = normal.try_normalize() {
            let angle = libm::atan2(normal.length(), facing(&turn).dot(self.light));
            let away = |angle: f64| {
                let bent = about(axis, angle) * petiole;
                bent.dot(stand.radial)
            };
            // One that stands along its axis anyway bends no nearer.
            let least = LEAST_AWAY.min(away(0.0));
            let mut angle = self.to_light * angle;
            for _ in 0..HALVINGS {
                if away(angle) >= least {
                    break;
                }
                angle *= 0.5;
            }
            if away(angle) >= least {
                turn = about(axis, angle) * turn;
            }
        }
        let stray = |which: u64| self.stray * bell(seed, Use::BorneLeaf, 3 * stand.number + which);
        let [x, y, z] = [stray(0), stray(1), stray(2)];
        let own = about(DVec3::X, x) * about(DVec3::Y, y) * about(DVec3::Z, z);
        // About the foot, whose place does not change.
        turn * own
    }

    /// The factor on the size of a leaf at a share of its axis.
    pub(super) fn size_at(&self, share: f64) -> f64 {
        let [foot, middle, tip] = self.size;
        if share < 0.5 {
            foot + (middle - foot) * 2.0 * share
        } else {
            middle + (tip - middle) * (2.0 * share - 1.0)
        }
    }
}
