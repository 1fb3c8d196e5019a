//! `[lights.NAME.rig]`: lights by name.

use leafmodel::document::coverage::require_coverage;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Degrees, Number, Vector, Word};

use super::camera::COORDINATES_M;
use super::spectrum::D65_NM;
use crate::scene::authored::{Rig, RigPreset};

const PRESETS: [(&str, RigPreset); 6] = [
    ("studio", RigPreset::Studio),
    ("tent", RigPreset::Tent),
    ("lightbox", RigPreset::Lightbox),
    ("overcast", RigPreset::Overcast),
    ("golden-hour", RigPreset::GoldenHour),
    ("forest-edge", RigPreset::ForestEdge),
];

impl Rig {
    /// A studio for a leaf.
    pub(in crate::scene) fn usual() -> Self {
        Self {
            preset: RigPreset::Studio,
            subject: None,
            size: 0.1,
            azimuth: None,
            ev: 0.0,
        }
    }
}

impl RigPreset {
    /// Whether its lamps or its sky have the spectrum of D65.
    fn shines_as_d65(self) -> bool {
        match self {
            Self::Studio | Self::Tent | Self::Lightbox | Self::Overcast => true,
            Self::GoldenHour | Self::ForestEdge => false,
        }
    }
}

/// The keys of the block.
pub(super) fn rig(rig: &mut Rig, keys: &mut Keys<'_>) {
    let about = "How the lights stand.";
    keys.required("preset", &mut rig.preset, Word(&PRESETS), about);
    if let Some(block) = keys.reader().filter(|_| rig.preset.shines_as_d65()) {
        let at = block.node("preset").map_or(&block.at, |node| &node.at);
        require_coverage(block.cx, at, "the lamps' D65", D65_NM);
    }
    let about = "What is lit; left out, the point that the camera looks at.";
    keys.optional("subject_m", &mut rig.subject, Vector(COORDINATES_M), about);
    let limits = Number(Limits::closed(1e-4, 1e4));
    let about = "Size of the subject, of which sizes and distances of lamps are multiples.";
    keys.key("size_m", &mut rig.size, limits, about);
    let limits = Degrees(Limits::closed(-360.0, 360.0));
    let about = "Direction along the ground in which the camera is taken to look, from +x towards \
        +y; left out, that in which it does.";
    keys.optional("azimuth_deg", &mut rig.azimuth, limits, about);
    let limits = Number(Limits::closed(-30.0, 30.0));
    let about = "Light more or less than for a picture with `exposure_ev = 0`, as a power of 2.";
    keys.key("ev", &mut rig.ev, limits, about);
}
