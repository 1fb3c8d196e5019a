//! Presets of compound leaves.
//!
//! Nothing here is measured on one specimen. Kinds of leaves, usual numbers of leaflets and their
//! lengths are general knowledge. Outlines, veins, angles, stalks and forms are by eye. Contents
//! lie in the range of broad leaves.

use super::contours::{curve, pointed};
use super::green_leaf;
use crate::compound::{Arrangement, CompoundForm, Feather};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::{Contour, OutlinePlan};
use crate::optics::Constituent::{Carotenoids, Chlorophyll, DryMatter, Structure, Water};
use crate::shape::specimen::Specimen;
use crate::shape::teeth::ToothWave;
use crate::venation::plan::{AuxinPlan, Growth};

/// The leaflets of a species.
struct Leaflet {
    length_mm: f64,
    seed: u64,
    outline: OutlinePlan,
    /// Length of the grown leaflet in vein segments.
    segments: f64,
    /// Structure, chlorophyll and carotenoids in µg/cm², water in cm, dry matter in g/cm².
    contents: [f64; 5],
    /// Fold and curl, degrees.
    bend: [f64; 2],
    map_size: u32,
}

fn leaf(leaflet: Leaflet, compound: CompoundForm) -> LeafPlan {
    let venation = AuxinPlan {
        final_length: leaflet.segments,
        source_birth_distance: 3.5,
        vein_birth_distance: 3.5,
        darts_per_area: 0.01,
        growth: Growth::Isogonic {
            initial_length: 0.15 * leaflet.segments,
            length_step: 2.5,
        },
        murray_exponent: 2.3,
        // The finest veins have a diameter of about a fifth of a segment.
        veinlet_radius_mm: 0.09 * leaflet.length_mm / leaflet.segments,
        ..AuxinPlan::default()
    };
    let mut leaf = green_leaf(leaflet.length_mm, leaflet.seed, leaflet.outline, venation);
    let lamina = &mut leaf.tissue.lamina;
    [
        lamina[Structure],
        lamina[Chlorophyll],
        lamina[Carotenoids],
        lamina[Water],
        lamina[DryMatter],
    ] = leaflet.contents;
    [leaf.form.fold, leaf.form.curl] = leaflet.bend.map(f64::to_radians);
    leaf.form.max_edge_mm = leaflet.length_mm / 50.0;
    leaf.map_size = leaflet.map_size;
    leaf.compound = Some(compound);
    leaf
}

fn toothed(contour: Contour, wave: ToothWave) -> OutlinePlan {
    OutlinePlan {
        contour,
        specimen: Specimen::default(),
        teeth: vec![wave],
    }
}

/// Teeth that fade over these shares of the side towards base and apex.
fn wave(per_side: u32, height: f64, lean: f64, [fade_base, fade_apex]: [f64; 2]) -> ToothWave {
    ToothWave {
        per_side,
        height,
        lean,
        fade_base,
        fade_apex,
        ..ToothWave::default()
    }
}

/// A lanceolate leaflet, widest below the middle.
fn lanceolate() -> Contour {
    pointed(&[
        (0.0, 0.0),
        (0.05, 0.035),
        (0.125, 0.14),
        (0.165, 0.32),
        (0.15, 0.52),
        (0.095, 0.74),
        (0.032, 0.92),
        (0.0, 1.0),
    ])
}

/// A rounded leaflet with a short point.
fn elliptic() -> Contour {
    pointed(&[
        (0.0, 0.0),
        (0.1, 0.045),
        (0.24, 0.2),
        (0.295, 0.42),
        (0.26, 0.64),
        (0.15, 0.86),
        (0.05, 0.965),
        (0.0, 1.0),
    ])
}

/// A wedge that is widest near its tip, and ends in a short point.
fn obovate() -> Contour {
    pointed(&[
        (0.0, 0.0),
        (0.028, 0.08),
        (0.08, 0.3),
        (0.15, 0.53),
        (0.196, 0.7),
        (0.17, 0.83),
        (0.07, 0.925),
        (0.022, 0.972),
        (0.0, 1.0),
    ])
}

/// A narrow strip with round ends.
fn oblong() -> Contour {
    pointed(&[
        (0.0, 0.0),
        (0.075, 0.03),
        (0.12, 0.15),
        (0.13, 0.5),
        (0.11, 0.84),
        (0.05, 0.96),
        (0.0, 1.0),
    ])
}

/// An inverted heart.
fn obcordate() -> Contour {
    curve(
        &[
            (0.0, 0.0),
            (0.1, 0.1),
            (0.26, 0.38),
            (0.35, 0.66),
            (0.3, 0.9),
            (0.16, 1.02),
            (0.05, 1.02),
            (0.0, 1.0),
        ],
        &[0, 7],
        true,
    )
}

pub(super) fn ash() -> LeafPlan {
    let leaflet = Leaflet {
        length_mm: 75.0,
        seed: 5,
        outline: toothed(lanceolate(), wave(26, 0.006, 0.7, [0.25, 0.12])),
        segments: 420.0,
        contents: [1.6, 45.0, 10.0, 0.011, 0.0065],
        bend: [10.0, 28.0],
        map_size: 1024,
    };
    let rows = Feather {
        pairs: 5,
        terminal: true,
        rachis: 2.55,
        alternation: 0.0,
        angles: [66.0, 49.0].map(f64::to_radians),
        sizes: [0.72, 0.98, 0.9],
        turn: 7.0_f64.to_radians(),
    };
    let form = CompoundForm {
        petiole: 0.6,
        petiolule: 0.035,
        stalk_radius_mm: 0.28,
        variants: 4,
        curl: 25.0_f64.to_radians(),
        fold: 14.0_f64.to_radians(),
        tilt: 9.0_f64.to_radians(),
        irregularity: 0.06,
        ..CompoundForm::new(Arrangement::Pinnate(rows))
    };
    leaf(leaflet, form)
}

pub(super) fn rose() -> LeafPlan {
    let leaflet = Leaflet {
        length_mm: 42.0,
        seed: 2,
        outline: toothed(elliptic(), wave(20, 0.02, 0.75, [0.12, 0.08])),
        segments: 360.0,
        contents: [1.6, 48.0, 10.0, 0.011, 0.007],
        bend: [12.0, 18.0],
        map_size: 1024,
    };
    let rows = Feather {
        pairs: 3,
        terminal: true,
        rachis: 2.05,
        alternation: 0.0,
        angles: [74.0, 69.0].map(f64::to_radians),
        sizes: [0.68, 0.85, 1.0],
        turn: 0.0,
    };
    let form = CompoundForm {
        petiole: 0.55,
        petiolule: 0.07,
        stalk_radius_mm: 0.3,
        curl: 20.0_f64.to_radians(),
        fold: 18.0_f64.to_radians(),
        tilt: 8.0_f64.to_radians(),
        irregularity: 0.06,
        ..CompoundForm::new(Arrangement::Pinnate(rows))
    };
    leaf(leaflet, form)
}

pub(super) fn horse_chestnut() -> LeafPlan {
    let leaflet = Leaflet {
        length_mm: 150.0,
        seed: 7,
        outline: toothed(obovate(), wave(44, 0.008, 0.6, [0.3, 0.1])),
        segments: 520.0,
        contents: [1.5, 46.0, 10.0, 0.010, 0.006],
        bend: [10.0, 40.0],
        map_size: 1600,
    };
    let form = CompoundForm {
        petiole: 0.9,
        petiolule: 0.03,
        stalk_radius_mm: 0.65,
        variants: 4,
        curl: 15.0_f64.to_radians(),
        fold: -12.0_f64.to_radians(),
        tilt: 6.0_f64.to_radians(),
        irregularity: 0.08,
        ..CompoundForm::new(Arrangement::Palmate {
            leaflets: 7,
            spread: 250.0_f64.to_radians(),
            sizes: [0.5, 1.0],
        })
    };
    leaf(leaflet, form)
}

pub(super) fn mimosa() -> LeafPlan {
    let leaflet = Leaflet {
        length_mm: 9.0,
        seed: 3,
        outline: oblong().into(),
        segments: 90.0,
        contents: [1.4, 38.0, 9.0, 0.009, 0.005],
        bend: [4.0, 6.0],
        map_size: 256,
    };
    let pinnae = Feather {
        pairs: 5,
        terminal: false,
        rachis: 1.75,
        alternation: 0.0,
        angles: [69.0, 43.0].map(f64::to_radians),
        sizes: [0.72, 1.0, 0.9],
        turn: 0.0,
    };
    let rows = Feather {
        pairs: 18,
        terminal: false,
        rachis: 6.1,
        alternation: 0.0,
        angles: [74.0, 60.0].map(f64::to_radians),
        sizes: [0.8, 1.0, 0.7],
        turn: 9.0_f64.to_radians(),
    };
    let form = CompoundForm {
        petiole: 3.5,
        petiolule: 0.03,
        stalk_radius_mm: 0.045,
        variants: 8,
        curl: 20.0_f64.to_radians(),
        fold: 12.0_f64.to_radians(),
        tilt: 7.0_f64.to_radians(),
        irregularity: 0.1,
        ..CompoundForm::new(Arrangement::Bipinnate {
            pinnae,
            leaflets: rows,
            stalk: 0.9,
        })
    };
    leaf(leaflet, form)
}

pub(super) fn clover() -> LeafPlan {
    let leaflet = Leaflet {
        length_mm: 18.0,
        seed: 1,
        outline: toothed(obcordate(), wave(24, 0.006, 0.5, [0.3, 0.15])),
        segments: 260.0,
        contents: [1.5, 40.0, 9.0, 0.012, 0.0045],
        bend: [14.0, 12.0],
        map_size: 768,
    };
    let form = CompoundForm {
        petiole: 3.0,
        petiolule: 0.03,
        stalk_radius_mm: 0.2,
        curl: 10.0_f64.to_radians(),
        fold: 10.0_f64.to_radians(),
        tilt: 6.0_f64.to_radians(),
        irregularity: 0.04,
        ..CompoundForm::new(Arrangement::Palmate {
            leaflets: 3,
            spread: 220.0_f64.to_radians(),
            sizes: [1.0; 2],
        })
    };
    leaf(leaflet, form)
}

#[cfg(test)]
mod tests {
    use crate::species::find;

    #[test]
    fn compound_leaves_have_their_usual_leaflets_and_none_in_anothers_way() {
        for (name, leaflets) in [
            ("ash", 11),
            ("rose", 7),
            ("horse-chestnut", 7),
            ("mimosa", 360),
            ("clover", 3),
        ] {
            let plan = find(name).expect("a preset").plan();
            let form = plan.compound.as_ref().expect("it is compound");
            let leaf = form
                .arrange(&plan)
                .unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(leaf.leaflets.len(), leaflets, "{name}");
        }
    }
}
