//! Vein architectures of the species of Table 1 of Runions et al. 2005.

use super::{across, actinodromous, birch, cottonwood, none, pinnate, smoke_tree};
use crate::venation::architecture::{
    Architecture, Primaries, PrimaryPattern, Secondaries, SecondaryCourse, SecondaryEnding,
    TertiaryCourse,
};

/// Ginkgo: veins that fork again and again and never meet.
pub(in crate::species) fn ginkgo() -> Architecture {
    Architecture {
        primaries: Primaries {
            pattern: PrimaryPattern::Flabellate,
            lateral_angles_deg: vec![15.0, 30.0, 45.0],
            fork_spacing: 0.0065,
            ..pinnate()
        },
        secondaries: none(),
        tertiaries: across(TertiaryCourse::Reticulate, 0.03, 90.0),
        irregularity: 0.4,
        ..Architecture::default()
    }
}

/// Lady's mantle: nine primaries, one a lobe, secondaries into the teeth.
pub(in crate::species) fn alchemilla() -> Architecture {
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
pub(in crate::species) fn sweetgum() -> Architecture {
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
pub(in crate::species) fn cherry() -> Architecture {
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
pub(in crate::species) fn orchid() -> Architecture {
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
pub(in crate::species) fn grass() -> Architecture {
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
pub(in crate::species) fn trillium() -> Architecture {
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

/// A trillium's bract or sepal: primaries that arch from the base to the tip, a net between them.
pub(in crate::species) fn trillium_green(lateral_angles_deg: &[f64]) -> Architecture {
    Architecture {
        primaries: Primaries {
            pattern: PrimaryPattern::Acrodromous,
            lateral_angles_deg: lateral_angles_deg.to_vec(),
            ..pinnate()
        },
        ..trillium()
    }
}
