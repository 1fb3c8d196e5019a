//! What the tissue holds at every point of the lamina.

use thiserror::Error;

use super::vein_field::VeinCover;
use crate::optics::Contents;

/// Contents between veins, and factors on them in veins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tissue {
    /// Contents of the lamina between veins.
    pub lamina: Contents,
    /// Factor on each of the contents over the middle of a fully developed vein (each ≥ 0; structure ≥ 0,
    /// and the result at least 1). Below 1 for chlorophyll makes veins bright in transmitted light, above 1 dark.
    pub vein_factors: Contents,
    /// Radius, mm, from which a vein counts as fully developed; finer ones take part of the factors.
    pub full_vein_radius_mm: f64,
    /// Width, mm, over which a vein's edge (bundle sheath extension) blends into the lamina, > 0.
    pub sheath_width_mm: f64,
    /// Share by which chlorophyll and carotenoids vary from patch to patch, 0 to 1.
    pub mottle: f64,
    /// Size of those patches, mm, > 0.
    pub mottle_scale_mm: f64,
}

/// Factors on the contents over a fully developed vein: pale, watery, dense (our choice within the ranges that
/// `docs/src/format/leaf.md` names).
const VEIN_FACTORS: Contents = Contents {
    structure: 1.3,
    chlorophyll: 0.1,
    carotenoids: 0.12,
    anthocyanins: 1.0,
    betacyanins: 1.0,
    betaxanthins: 1.0,
    brown: 1.0,
    water: 2.0,
    dry_matter: 2.5,
};

impl Tissue {
    /// Size of patches where nothing is said, mm.
    pub const MOTTLE_SCALE_MM: f64 = 1.0;

    /// Tissue of which only the contents are said: usual veins, no mottle.
    pub fn of(lamina: Contents) -> Self {
        Self {
            lamina,
            vein_factors: VEIN_FACTORS,
            full_vein_radius_mm: 0.06,
            sheath_width_mm: 0.1,
            mottle: 0.0,
            mottle_scale_mm: Self::MOTTLE_SCALE_MM,
        }
    }
}

/// A number of a tissue, or of what it is painted with, outside the range in which the model holds.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{field} is {value}, it must be {range}")]
pub struct TissueError {
    /// Which number.
    pub field: &'static str,
    /// What it was.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

impl TissueError {
    /// `Ok` if `valid`, which should be false for a NaN.
    pub(super) fn unless(
        valid: bool,
        field: &'static str,
        value: f64,
        range: &'static str,
    ) -> Result<(), Self> {
        if valid {
            Ok(())
        } else {
            Err(Self {
                field,
                value,
                range,
            })
        }
    }
}

const LAMINA: [&str; Contents::COUNT] = [
    "lamina.structure",
    "lamina.chlorophyll",
    "lamina.carotenoids",
    "lamina.anthocyanins",
    "lamina.betacyanins",
    "lamina.betaxanthins",
    "lamina.brown",
    "lamina.water",
    "lamina.dry_matter",
];

const FACTORS: [&str; Contents::COUNT] = [
    "vein_factors.structure",
    "vein_factors.chlorophyll",
    "vein_factors.carotenoids",
    "vein_factors.anthocyanins",
    "vein_factors.betacyanins",
    "vein_factors.betaxanthins",
    "vein_factors.brown",
    "vein_factors.water",
    "vein_factors.dry_matter",
];

/// Which of the contents are there because a vein is thick, in the order of [`Contents::to_array`]:
/// structure, water and dry matter.
const BULK: [bool; Contents::COUNT] = [true, false, false, false, false, false, false, true, true];

/// Which of the contents the mottle varies: chlorophyll and carotenoids.
const MOTTLED: [bool; Contents::COUNT] =
    [false, true, true, false, false, false, false, false, false];

impl Tissue {
    /// Whether every field is in its range. The upper ends are far above any leaf; they keep what
    /// follows finite in single precision and the search for veins local.
    ///
    /// # Errors
    ///
    /// [`TissueError`] for the first field that is not, by name.
    pub fn validate(&self) -> Result<(), TissueError> {
        for (index, (field, value)) in LAMINA.into_iter().zip(self.lamina.to_array()).enumerate() {
            if index == 0 {
                let valid = (1.0..=100.0).contains(&value);
                TissueError::unless(valid, field, value, "from 1 to 100")?;
            } else {
                let valid = (0.0..=1000.0).contains(&value);
                TissueError::unless(valid, field, value, "from 0 to 1000")?;
            }
        }
        for (field, value) in FACTORS.into_iter().zip(self.vein_factors.to_array()) {
            let valid = (0.0..=100.0).contains(&value);
            TissueError::unless(valid, field, value, "from 0 to 100")?;
        }
        let full = self.full_vein_radius_mm;
        let valid = (0.001..=100.0).contains(&full);
        TissueError::unless(valid, "full_vein_radius_mm", full, "from 0.001 to 100")?;
        let sheath = self.sheath_width_mm;
        let valid = (0.001..=5.0).contains(&sheath);
        TissueError::unless(valid, "sheath_width_mm", sheath, "from 0.001 to 5")?;
        let valid = (0.0..=1.0).contains(&self.mottle);
        TissueError::unless(valid, "mottle", self.mottle, "from 0 to 1")?;
        let scale = self.mottle_scale_mm;
        let valid = (0.01..=1000.0).contains(&scale);
        TissueError::unless(valid, "mottle_scale_mm", scale, "from 0.01 to 1000")
    }

    /// Contents where veins cover the lamina as `cover` says and the mottle has the value `mottle`, in [−1, 1].
    ///
    /// Each of the contents is `C (1 + (f − 1) w)`, with its value `C` between veins, its factor `f` and the
    /// veins' weight `w`. Structure, water and dry matter, where `f > 1`, are `C (1 + (f − 1)(w + e))`: they
    /// come with a vein's thickness, so that their surplus goes on growing with the radius (`e`,
    /// [`VeinCover::excess`]) while the concentrations of pigments do not. Chlorophyll and carotenoids are
    /// multiplied by `1 + mottle share × mottle`. Structure is at least 1, the others at least 0.
    #[must_use]
    pub fn contents(&self, cover: VeinCover, mottle: f64) -> Contents {
        self.contents_of(self.lamina, cover, mottle)
    }

    /// As [`Tissue::contents`] where the tissue between veins holds `lamina`.
    #[must_use]
    pub fn contents_of(&self, lamina: Contents, cover: VeinCover, mottle: f64) -> Contents {
        let patch = 1.0 + self.mottle * mottle;
        let factors = self.vein_factors.to_array();
        let mut values = lamina.to_array();
        for (index, (value, factor)) in values.iter_mut().zip(factors).enumerate() {
            let thick = BULK[index] && factor > 1.0;
            let share = cover.weight + if thick { cover.excess } else { 0.0 };
            *value *= 1.0 + (factor - 1.0) * share;
            if MOTTLED[index] {
                *value *= patch;
            }
            // A factor of 0 at full weight may round to just below nothing.
            *value = value.max(0.0);
        }
        values[0] = values[0].max(1.0);
        Contents::from_array(values)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A thin green broad leaf, bright veins.
    pub(in crate::blade) const GREEN: Tissue = Tissue {
        lamina: Contents {
            structure: 1.5,
            chlorophyll: 40.0,
            carotenoids: 9.0,
            anthocyanins: 0.5,
            betacyanins: 0.0,
            betaxanthins: 0.0,
            brown: 0.01,
            water: 0.01,
            dry_matter: 0.006,
        },
        vein_factors: Contents {
            structure: 1.3,
            chlorophyll: 0.25,
            carotenoids: 0.25,
            anthocyanins: 1.0,
            betacyanins: 1.0,
            betaxanthins: 1.0,
            brown: 1.0,
            water: 2.0,
            dry_matter: 2.5,
        },
        full_vein_radius_mm: 0.25,
        sheath_width_mm: 0.1,
        mottle: 0.0,
        mottle_scale_mm: 1.0,
    };

    const LAMINA_ONLY: VeinCover = VeinCover {
        weight: 0.0,
        excess: 0.0,
    };
    const FULL: VeinCover = VeinCover {
        weight: 1.0,
        excess: 0.0,
    };

    #[test]
    fn each_field_out_of_range_is_refused_by_name() {
        type Set = fn(&mut Tissue, f64);
        let others: [(&str, Set, [f64; 2]); 4] = [
            (
                "full_vein_radius_mm",
                |t, x| t.full_vein_radius_mm = x,
                [0.0, 101.0],
            ),
            (
                "sheath_width_mm",
                |t, x| t.sheath_width_mm = x,
                [0.0, 5.001],
            ),
            ("mottle", |t, x| t.mottle = x, [-0.01, 1.01]),
            (
                "mottle_scale_mm",
                |t, x| t.mottle_scale_mm = x,
                [0.0, 1001.0],
            ),
        ];
        let mut broken = Vec::new();
        for (field, set, [low, high]) in others {
            for bad in [low, high, f64::NAN, f64::INFINITY] {
                let mut tissue = GREEN;
                set(&mut tissue, bad);
                broken.push((tissue, field, bad));
            }
        }
        for index in 0..Contents::COUNT {
            for bad in [-0.001, 1001.0, f64::NAN, f64::INFINITY] {
                let mut values = GREEN.lamina.to_array();
                values[index] = bad;
                let lamina = Contents::from_array(values);
                broken.push((Tissue { lamina, ..GREEN }, LAMINA[index], bad));
                let mut values = GREEN.vein_factors.to_array();
                values[index] = bad;
                let vein_factors = Contents::from_array(values);
                broken.push((
                    Tissue {
                        vein_factors,
                        ..GREEN
                    },
                    FACTORS[index],
                    bad,
                ));
            }
        }
        assert_eq!(GREEN.validate(), Ok(()));
        for (tissue, field, bad) in broken {
            let error = tissue.validate().expect_err("a field is out of range");
            assert_eq!(
                (error.field, error.value.to_bits()),
                (field, bad.to_bits()),
                "{error}"
            );
        }
    }

    #[test]
    fn a_refusal_names_field_value_and_range() {
        let tissue = Tissue {
            sheath_width_mm: -0.5,
            ..GREEN
        };
        let message = tissue.validate().expect_err("negative").to_string();
        assert_eq!(
            message,
            "sheath_width_mm is -0.5, it must be from 0.001 to 5"
        );
    }

    #[test]
    fn between_veins_there_is_exactly_the_lamina() {
        assert_eq!(GREEN.contents(LAMINA_ONLY, 0.7), GREEN.lamina);
    }

    #[test]
    fn a_full_vein_holds_the_lamina_times_its_factors() {
        let vein = GREEN.contents(FULL, 0.0).to_array();
        for (index, value) in vein.into_iter().enumerate() {
            let expected = GREEN.lamina.to_array()[index] * GREEN.vein_factors.to_array()[index];
            assert!(
                (value - expected).abs() <= 1e-15 * expected,
                "{value} {expected}"
            );
        }
    }

    #[test]
    fn thickness_adds_bulk_and_leaves_pigments_alone() {
        let thick = VeinCover {
            weight: 1.0,
            excess: 3.0,
        };
        let (full, thick) = (GREEN.contents(FULL, 0.0), GREEN.contents(thick, 0.0));
        let surplus = |contents: Contents| contents.dry_matter - GREEN.lamina.dry_matter;
        assert!((surplus(thick) - 4.0 * surplus(full)).abs() < 1e-15);
        assert!(thick.water > full.water && thick.structure > full.structure);
        assert_eq!(thick.chlorophyll, full.chlorophyll);
        // Contents that veins lack do not become negative where they are thick.
        let mut dry = GREEN;
        dry.vein_factors.water = 0.0;
        let drained = dry.contents(
            VeinCover {
                weight: 1.0,
                excess: 3.0,
            },
            0.0,
        );
        assert_eq!(drained.water, 0.0);
    }

    #[test]
    fn fewer_plates_than_one_become_one() {
        let mut tissue = GREEN;
        tissue.vein_factors.structure = 0.0;
        assert_eq!(tissue.contents(FULL, 0.0).structure, 1.0);
    }

    #[test]
    fn the_mottle_varies_chlorophyll_and_carotenoids_alone() {
        let tissue = Tissue {
            mottle: 0.2,
            ..GREEN
        };
        let patch = tissue.contents(LAMINA_ONLY, -0.5);
        let mut expected = GREEN.lamina;
        expected.chlorophyll *= 0.9;
        expected.carotenoids *= 0.9;
        assert_eq!(patch, expected);
    }
}
