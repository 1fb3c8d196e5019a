//! Vein architectures of the presets of trees and shrubs.
//!
//! Patterns, endings and numbers of veins are what is typical of the species; angles and spacings
//! are by eye. None was counted on a specimen.

use crate::venation::architecture::{
    Architecture, Arrangement, Attachment, Primaries, PrimaryPattern, Secondaries, SecondaryCourse,
    SecondaryEnding, SecondarySpacing, Tertiaries, TertiaryCourse,
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
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.022, 92.0),
        irregularity: 0.3,
        is_fimbrial: false,
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
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.022, 95.0),
        irregularity: 0.4,
        is_fimbrial: false,
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
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.5,
        is_fimbrial: false,
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
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.02, 95.0),
        irregularity: 0.3,
        is_fimbrial: false,
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
        },
        tertiaries: across(TertiaryCourse::OppositePercurrent, 0.025, 95.0),
        irregularity: 0.3,
        is_fimbrial: false,
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
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.5,
        is_fimbrial: false,
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
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.016, 95.0),
        irregularity: 0.4,
        is_fimbrial: false,
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
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        is_fimbrial: false,
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
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        is_fimbrial: false,
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

/// Ginkgo: veins that fork again and again and never meet.
pub(super) fn ginkgo() -> Architecture {
    Architecture {
        primaries: Primaries {
            pattern: PrimaryPattern::Flabellate,
            lateral_angles_deg: vec![15.0, 30.0, 45.0],
            fork_spacing: 0.018,
            ..pinnate()
        },
        secondaries: none(),
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// Lady's mantle: nine primaries, one a lobe, secondaries into the teeth.
pub(super) fn alchemilla() -> Architecture {
    Architecture {
        primaries: actinodromous(&[27.0, 55.0, 84.0, 118.0]),
        secondaries: Secondaries {
            pairs: 2,
            angles_deg: [36.0, 34.0, 27.0],
            course: SecondaryCourse::Straight,
            ending: SecondaryEnding::Craspedodromous,
            span: [0.6, 0.85],
            ..birch().secondaries
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// Sweetgum: five primaries into the lobes; their secondaries meet in arches inside the margin.
pub(super) fn sweetgum() -> Architecture {
    Architecture {
        primaries: actinodromous(&[53.0, 107.0]),
        secondaries: Secondaries {
            pairs: 9,
            angles_deg: [57.0, 52.0, 46.0],
            ending: SecondaryEnding::Festooned,
            span: [0.16, 0.9],
            inset: 0.025,
            ..smoke_tree().secondaries
        },
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// Nankin cherry: arches with branches into the teeth.
pub(super) fn cherry() -> Architecture {
    Architecture {
        secondaries: Secondaries {
            pairs: 6,
            angles_deg: [48.0, 46.0, 40.0],
            ending: SecondaryEnding::Semicraspedodromous,
            span: [0.1, 0.86],
            inset: 0.03,
            ..cottonwood().secondaries
        },
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.026, 95.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// An orchid: arches from base to apex, cross veins between them.
pub(super) fn orchid() -> Architecture {
    Architecture {
        primaries: Primaries {
            pattern: PrimaryPattern::Parallelodromous,
            laterals: 4,
            ..pinnate()
        },
        secondaries: none(),
        tertiaries: across(TertiaryCourse::AlternatePercurrent, 0.022, 80.0),
        irregularity: 0.3,
        ..Architecture::default()
    }
}

/// A grass: many veins side by side, short cross veins.
pub(super) fn grass() -> Architecture {
    Architecture {
        primaries: Primaries {
            pattern: PrimaryPattern::Parallelodromous,
            laterals: 9,
            ..pinnate()
        },
        secondaries: none(),
        tertiaries: across(TertiaryCourse::OppositePercurrent, 0.012, 88.0),
        irregularity: 0.3,
        ..Architecture::default()
    }
}

/// A trillium's petal: arches that converge, a loose net between them.
pub(super) fn trillium() -> Architecture {
    Architecture {
        primaries: Primaries {
            pattern: PrimaryPattern::Parallelodromous,
            laterals: 3,
            ..pinnate()
        },
        secondaries: none(),
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        ..Architecture::default()
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
