//! Contents of the tissue at every point of the lamina.

use std::sync::LazyLock;

use thiserror::Error;

use super::vein_body::VeinBody;
use super::vein_cover::VeinCover;
use crate::optics::{Constituent, Contents, PerConstituent, VeinFactors};

/// Most that tissue may hold of anything, in the unit of its constituent.
pub(crate) const MOST_HELD: f64 = 1000.0;

/// Contents between veins, and factors on them in veins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tissue {
    /// Contents of the lamina between veins.
    pub lamina: Contents,
    /// Factors on these contents in veins; structure stays at least 1.
    pub vein_factors: VeinFactors,
    /// What thick veins are made of. Without it the surplus of structure, water and dry matter
    /// follows from the factors and grows with the radius over `full_vein_radius_mm`.
    pub vein_body: Option<VeinBody>,
    /// Radius, mm, from which a vein counts as fully developed. The factors act only partly on
    /// finer veins.
    pub full_vein_radius_mm: f64,
    /// Width, mm, over which a vein's edge (bundle sheath extension) blends into the lamina, > 0.
    pub sheath_width_mm: f64,
    /// Share by which chlorophyll and carotenoids vary from patch to patch, 0 to 1.
    pub mottle: f64,
    /// Size of those patches, mm, > 0.
    pub mottle_scale_mm: f64,
}

impl Tissue {
    /// Default size of patches, mm.
    pub const MOTTLE_SCALE_MM: f64 = 1.0;

    /// Tissue with these contents, the usual veins and no mottle.
    pub fn of(lamina: Contents) -> Self {
        Self {
            lamina,
            vein_factors: VeinFactors::default(),
            vein_body: None,
            full_vein_radius_mm: 0.06,
            sheath_width_mm: 0.1,
            mottle: 0.0,
            mottle_scale_mm: Self::MOTTLE_SCALE_MM,
        }
    }
}

/// A number of a tissue, or of anything painted on it, is outside the range in which the model
/// holds.
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

/// `lamina.structure` and so on.
static LAMINA: LazyLock<PerConstituent<String>> = LazyLock::new(|| fields_of("lamina"));

/// `vein_factors.structure` and so on.
static FACTORS: LazyLock<PerConstituent<String>> = LazyLock::new(|| fields_of("vein_factors"));

fn fields_of(whole: &str) -> PerConstituent<String> {
    PerConstituent::from_fn(|constituent| format!("{whole}.{}", constituent.name()))
}

/// What the mottle varies, and what makes tissue green.
const GREENS: [Constituent; 2] = [Constituent::Chlorophyll, Constituent::Carotenoids];

impl Tissue {
    /// Checks that every field is in its range. Upper limits are far above the values of leaves;
    /// they keep results finite in single precision and the search for veins local.
    ///
    /// # Errors
    ///
    /// [`TissueError`] for the first field out of range, by name.
    pub fn validate(&self) -> Result<(), TissueError> {
        for (constituent, value) in *self.lamina {
            let field = LAMINA[constituent].as_str();
            if constituent == Constituent::Structure {
                let valid = (1.0..=100.0).contains(&value);
                TissueError::unless(valid, field, value, "from 1 to 100")?;
            } else {
                let valid = (0.0..=MOST_HELD).contains(&value);
                TissueError::unless(valid, field, value, "from 0 to 1000")?;
            }
        }
        for (constituent, value) in *self.vein_factors {
            let valid = (0.0..=VeinFactors::MOST).contains(&value);
            let field = FACTORS[constituent].as_str();
            TissueError::unless(valid, field, value, "from 0 to 100")?;
        }
        if let Some(body) = &self.vein_body {
            let (thickness, valid) = (body.blade_mm, (0.001..=10.0).contains(&body.blade_mm));
            TissueError::unless(valid, "vein_body.blade_mm", thickness, "from 0.001 to 10")?;
            for (_, share) in body.shares {
                let valid = (0.0..=VeinBody::MOST).contains(&share);
                TissueError::unless(valid, "vein_body", share, "from 0 to 100")?;
            }
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

    /// Contents where veins cover the lamina as `cover` says and the mottle has the value `mottle`,
    /// in [−1, 1].
    ///
    /// Each of the contents is `C (1 + (f − 1) w)`, with its value `C` between veins, its factor
    /// `f` and the veins' weight `w`. Structure, water and dry matter with `f > 1` are
    /// `C (1 + (f − 1)(w + e))`: their surplus grows with a vein's thickness, so with its radius
    /// (`e`, [`VeinCover::excess`]), whereas pigment contents do not. With a [`VeinBody`] it is
    /// `C (1 + (f − 1) w + b e)` for all of them, with the body's share `b`. Chlorophyll and carotenoids
    /// have [`VeinCover::greens`] for `w` and are multiplied by `1 + mottle share × mottle`. Structure
    /// is at least 1, the others at least 0.
    #[must_use]
    pub fn contents(&self, cover: VeinCover, mottle: f64) -> Contents {
        self.contents_of(self.lamina, cover, mottle)
    }

    /// As [`Tissue::contents`] where the tissue between veins holds `lamina`.
    #[must_use]
    pub fn contents_of(&self, lamina: Contents, cover: VeinCover, mottle: f64) -> Contents {
        let patch = 1.0 + self.mottle * mottle;
        let mut contents = lamina;
        for (constituent, value) in contents.iter_mut() {
            let factor = self.vein_factors[constituent];
            let thick = constituent.is_bulk() && factor > 1.0;
            let is_green = GREENS.contains(&constituent);
            let weight = if is_green { cover.greens } else { cover.weight };
            let body = self.vein_body.as_ref();
            *value *= if let Some(body) = body {
                1.0 + (factor - 1.0) * weight + body.shares[constituent] * cover.excess
            } else {
                let share = weight + if thick { cover.excess } else { 0.0 };
                1.0 + (factor - 1.0) * share
            };
            if is_green {
                *value *= patch;
            }
            // A factor of 0 at full weight may round to slightly below 0.
            *value = value.max(constituent.least());
        }
        contents
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A thin green broad leaf, bright veins.
    pub(in crate::blade) const GREEN: Tissue = Tissue {
        lamina: Contents::of(&[
            (Constituent::Structure, 1.5),
            (Constituent::Chlorophyll, 40.0),
            (Constituent::Carotenoids, 9.0),
            (Constituent::Anthocyanins, 0.5),
            (Constituent::Brown, 0.01),
            (Constituent::Water, 0.01),
            (Constituent::DryMatter, 0.006),
        ]),
        vein_factors: VeinFactors::of(&[
            (Constituent::Structure, 1.3),
            (Constituent::Chlorophyll, 0.25),
            (Constituent::Carotenoids, 0.25),
            (Constituent::Water, 2.0),
            (Constituent::DryMatter, 2.5),
        ]),
        vein_body: None,
        full_vein_radius_mm: 0.25,
        sheath_width_mm: 0.1,
        mottle: 0.0,
        mottle_scale_mm: 1.0,
    };

    const LAMINA_ONLY: VeinCover = VeinCover::NONE;
    const FULL: VeinCover = VeinCover::of(1.0, 0.0);

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
        for constituent in Constituent::ALL {
            for bad in [-0.001, 1001.0, f64::NAN, f64::INFINITY] {
                let mut tissue = GREEN;
                tissue.lamina[constituent] = bad;
                broken.push((tissue, LAMINA[constituent].as_str(), bad));
                let mut tissue = GREEN;
                tissue.vein_factors[constituent] = bad;
                broken.push((tissue, FACTORS[constituent].as_str(), bad));
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
        for (constituent, value) in *GREEN.contents(FULL, 0.0) {
            let expected = GREEN.lamina[constituent] * GREEN.vein_factors[constituent];
            assert!(
                (value - expected).abs() <= 1e-15 * expected,
                "{value} {expected}"
            );
        }
    }

    #[test]
    fn thickness_adds_bulk_and_leaves_pigments_alone() {
        let thick = VeinCover::of(1.0, 3.0);
        let (full, thick) = (GREEN.contents(FULL, 0.0), GREEN.contents(thick, 0.0));
        let surplus = |contents: Contents| {
            contents[Constituent::DryMatter] - GREEN.lamina[Constituent::DryMatter]
        };
        assert!((surplus(thick) - 4.0 * surplus(full)).abs() < 1e-15);
        assert!(
            thick[Constituent::Water] > full[Constituent::Water]
                && thick[Constituent::Structure] > full[Constituent::Structure]
        );
        assert_eq!(
            thick[Constituent::Chlorophyll],
            full[Constituent::Chlorophyll]
        );
        // Contents with a factor below 1 do not become negative in thick veins.
        let mut dry = GREEN;
        dry.vein_factors[Constituent::Water] = 0.0;
        let drained = dry.contents(VeinCover::of(1.0, 3.0), 0.0);
        assert_eq!(drained[Constituent::Water], 0.0);
    }

    #[test]
    fn a_body_adds_its_share_of_everything_for_each_layer() {
        let tissue = Tissue {
            vein_body: Some(VeinBody::USUAL),
            ..GREEN
        };
        let thick = VeinCover::of(1.0, 3.0);
        let (full, thick) = (tissue.contents(FULL, 0.0), tissue.contents(thick, 0.0));
        assert_eq!(full, GREEN.contents(FULL, 0.0));
        for (constituent, share) in VeinBody::USUAL.shares {
            let added = thick[constituent] - full[constituent];
            let expected = 3.0 * share * GREEN.lamina[constituent];
            assert!((added - expected).abs() < 1e-12, "{constituent:?}");
        }
    }

    #[test]
    fn fewer_plates_than_one_become_one() {
        let mut tissue = GREEN;
        tissue.vein_factors[Constituent::Structure] = 0.0;
        assert_eq!(tissue.contents(FULL, 0.0)[Constituent::Structure], 1.0);
    }

    #[test]
    fn the_mottle_varies_chlorophyll_and_carotenoids_alone() {
        let tissue = Tissue {
            mottle: 0.2,
            ..GREEN
        };
        let patch = tissue.contents(LAMINA_ONLY, -0.5);
        let mut expected = GREEN.lamina;
        expected[Constituent::Chlorophyll] *= 0.9;
        expected[Constituent::Carotenoids] *= 0.9;
        assert_eq!(patch, expected);
    }
}
