//! Where a path is.

use super::drops::Drops;
use crate::walk;
use crate::world::World;

/// Where a path is.
#[derive(Clone, Copy, Default)]
pub(in crate::integrator) struct Passage {
    /// The bodies around, in scenes with media.
    pub(in crate::integrator) around: walk::Passage,
    /// The drops around.
    pub(in crate::integrator) drops: Drops,
}

impl Passage {
    /// Where the camera stands.
    pub(super) fn of_camera(world: &World) -> Self {
        Self {
            around: walk::Passage {
                inside: world.media.around_camera,
                flights: 0,
            },
            drops: Drops::default(),
        }
    }
}

impl AsMut<walk::Passage> for Passage {
    fn as_mut(&mut self) -> &mut walk::Passage {
        &mut self.around
    }
}
