//! Vein architectures of the presets of trees and shrubs.
//!
//! Patterns, endings and numbers of veins are what is typical of the species; angles and spacings
//! are by eye. None was counted on a specimen.

mod table_1;

pub(super) use self::table_1::{
    alchemilla, cherry, ginkgo, grass, orchid, sweetgum, trillium, trillium_green,
};
use crate::venation::architecture::{
    Agrophic, Architecture, Arrangement, Attachment, Primaries, PrimaryPattern, Secondaries,
    SecondaryCourse, SecondaryEnding, SecondarySpacing, Tertiaries, TertiaryCourse,
};

fn pinnate() -> Primaries {
    Primaries {
        pattern: PrimaryPattern::Pinnate,
        lateral_angles_deg: Vec::new(),
        ..Architecture::default().primaries
    }
}

fn actinodromous(lateral_angles_deg: &[f64]) -> Primaries {
    Primaries {
        pattern: PrimaryPattern::Actinodromous,
        lateral_angles_deg: lateral_angles_deg.to_vec(),
        ..Architecture::default().primaries
    }
}

const fn across(course: TertiaryCourse, spacing: f64, angle_deg: f64) -> Tertiaries {
    Tertiaries {
        course,
        spacing,
        angle_deg,
    }
}

/// Silver birch: straight secondaries into the greater teeth.
pub(super) fn birch() -> Architecture {
    Architecture {
        primaries: pinnate(),
        secondaries: Secondaries {
            pairs: 7,
            angles_deg: [50.0, 45.0, 40.0],
            course: SecondaryCourse::Straight,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Craspedodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Alternate,
            span: [0.04, 0.8],
            inset: 0.03,
            intersecondaries: 0.0,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.022, 92.0),
        irregularity: 0.3,
        ..Architecture::default()
    }
}

/// Eastern cottonwood: three primaries, arches with branches into the teeth.
pub(super) fn cottonwood() -> Architecture {
    Architecture {
        primaries: actinodromous(&[52.0]),
        secondaries: Secondaries {
            pairs: 5,
            angles_deg: [55.0, 50.0, 45.0],
            course: SecondaryCourse::Arching,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Semicraspedodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Alternate,
            span: [0.2, 0.8],
            inset: 0.035,
            intersecondaries: 0.3,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.022, 95.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// Quaking aspen: the lowest veins strongly ascending, as primaries, then arches.
pub(super) fn aspen() -> Architecture {
    let cottonwood = cottonwood();
    Architecture {
        primaries: actinodromous(&[48.0]),
        secondaries: Secondaries {
            pairs: 6,
            angles_deg: [56.0, 52.0, 46.0],
            span: [0.2, 0.86],
            inset: 0.04,
            intersecondaries: 0.2,
            ..cottonwood.secondaries
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.028, 95.0),
        irregularity: 0.45,
        ..Architecture::default()
    }
}

/// Southern magnolia: many arches well inside an entire margin, and intersecondaries.
pub(super) fn magnolia() -> Architecture {
    Architecture {
        primaries: pinnate(),
        secondaries: Secondaries {
            pairs: 10,
            angles_deg: [60.0, 58.0, 52.0],
            course: SecondaryCourse::Upturned,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Brochidodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Alternate,
            span: [0.06, 0.88],
            inset: 0.035,
            intersecondaries: 0.8,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.5,
        ..Architecture::default()
    }
}

/// White oak: a secondary to each rounded lobe.
pub(super) fn white_oak() -> Architecture {
    Architecture {
        primaries: pinnate(),
        secondaries: Secondaries {
            pairs: 4,
            angles_deg: [55.0, 50.0, 40.0],
            course: SecondaryCourse::Straight,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Craspedodromous,
            spacing: SecondarySpacing::DecreasingProximally,
            arrangement: Arrangement::Opposite,
            span: [0.08, 0.8],
            inset: 0.03,
            intersecondaries: 0.0,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.02, 95.0),
        irregularity: 0.3,
        ..Architecture::default()
    }
}

/// Red oak: a secondary to each bristle-pointed lobe.
pub(super) fn red_oak() -> Architecture {
    Architecture {
        secondaries: Secondaries {
            angles_deg: [60.0, 56.0, 48.0],
            spacing: SecondarySpacing::Regular,
            span: [0.06, 0.8],
            ..white_oak().secondaries
        },
        ..white_oak()
    }
}

/// Maple: five primaries into the lobes, straight secondaries into their teeth.
pub(super) fn maple() -> Architecture {
    Architecture {
        primaries: actinodromous(&[53.0, 110.0]),
        secondaries: Secondaries {
            pairs: 2,
            angles_deg: [45.0, 42.0, 38.0],
            course: SecondaryCourse::Straight,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Craspedodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Opposite,
            span: [0.42, 0.72],
            inset: 0.03,
            intersecondaries: 0.0,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::OppositePercurrent, 0.025, 95.0),
        irregularity: 0.3,
        ..Architecture::default()
    }
}

/// Ivy: five primaries into the lobes, secondaries that dwindle inside the margin.
pub(super) fn ivy() -> Architecture {
    Architecture {
        primaries: actinodromous(&[62.0, 113.0]),
        secondaries: Secondaries {
            pairs: 3,
            angles_deg: [50.0, 45.0, 40.0],
            course: SecondaryCourse::Arching,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Eucamptodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Alternate,
            span: [0.28, 0.8],
            inset: 0.04,
            intersecondaries: 0.0,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.5,
        ..Architecture::default()
    }
}

/// White willow: secondaries that run up along the margin.
pub(super) fn willow() -> Architecture {
    Architecture {
        primaries: pinnate(),
        secondaries: Secondaries {
            pairs: 14,
            angles_deg: [48.0, 46.0, 40.0],
            course: SecondaryCourse::Arching,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Eucamptodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Alternate,
            span: [0.06, 0.88],
            inset: 0.02,
            intersecondaries: 0.0,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.016, 95.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// Croton: many wide-angled secondaries that meet in arches.
pub(super) fn croton() -> Architecture {
    Architecture {
        primaries: pinnate(),
        secondaries: Secondaries {
            pairs: 15,
            angles_deg: [68.0, 66.0, 58.0],
            course: SecondaryCourse::Upturned,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Brochidodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Alternate,
            span: [0.05, 0.9],
            inset: 0.02,
            intersecondaries: 0.5,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// Smoke tree: straight-running, wide-angled secondaries that dwindle near an entire margin.
pub(super) fn smoke_tree() -> Architecture {
    Architecture {
        primaries: pinnate(),
        secondaries: Secondaries {
            pairs: 9,
            angles_deg: [68.0, 64.0, 55.0],
            course: SecondaryCourse::Upturned,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Eucamptodromous,
            spacing: SecondarySpacing::Regular,
            arrangement: Arrangement::Alternate,
            span: [0.06, 0.88],
            inset: 0.025,
            intersecondaries: 0.5,
            agrophic: Agrophic::Absent,
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// Amaranth: arching secondaries that dwindle near an entire margin.
pub(super) fn amaranth() -> Architecture {
    Architecture {
        secondaries: Secondaries {
            pairs: 8,
            angles_deg: [52.0, 48.0, 42.0],
            course: SecondaryCourse::Arching,
            attachment: Attachment::Excurrent,
            ending: SecondaryEnding::Eucamptodromous,
            intersecondaries: 0.3,
            ..smoke_tree().secondaries
        },
        ..smoke_tree()
    }
}

/// Red maple: as the maple, with three great lobes and two small ones.
pub(super) fn red_maple() -> Architecture {
    Architecture {
        primaries: actinodromous(&[46.0, 88.0]),
        ..maple()
    }
}

/// A box elder's leaflet: straight secondaries into few teeth.
pub(super) fn box_elder() -> Architecture {
    Architecture {
        secondaries: Secondaries {
            pairs: 7,
            angles_deg: [50.0, 46.0, 40.0],
            course: SecondaryCourse::Arching,
            ending: SecondaryEnding::Eucamptodromous,
            span: [0.08, 0.84],
            ..birch().secondaries
        },
        ..birch()
    }
}

/// No secondaries, where many primaries take their place.
fn none() -> Secondaries {
    Secondaries {
        pairs: 0,
        ..Architecture::default().secondaries
    }
}
