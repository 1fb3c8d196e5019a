//! `[leaves.NAME.compound.…]`: the leaf is the largest leaflet of a compound one.

use leafmodel::compound::{Arrangement, CompoundError, CompoundForm, Feather};
use leafmodel::leaf::LeafPlan;

use super::limits::Limits;
use super::petiole::RADII_MM;
use super::reader::Block;
use crate::scene::error::SceneError;

/// The ways in which leaflets stand.
const KINDS: [&str; 3] = ["pinnate", "palmate", "bipinnate"];
/// Lengths of stalks in leaflets.
const LENGTHS: Limits = Limits::closed(0.01, 100.0);
/// Sizes in shares of the largest leaflet.
const SIZES: Limits = Limits::closed(0.01, 1.0);
/// Angles at which leaflets stand, degrees.
const ANGLES_DEG: Limits = Limits::closed(3.0, 170.0);

/// A form as read, with the block that it stands in.
#[derive(Debug)]
pub(super) struct ReadForm<'a> {
    pub(super) form: CompoundForm,
    block: Block<'a>,
}

/// Reads `compound` of a leaf; `None` where it is left out, or has an error.
pub(super) fn read_compound<'a>(leaf: &Block<'a>) -> Option<ReadForm<'a>> {
    // A survey of keys must not ask which kind of a block that is not there.
    leaf.entry("compound")?;
    let (kind, block) = leaf.optional_block("compound")?.variant(&KINDS)?;
    let arrangement = match kind {
        "pinnate" => {
            let rachis = block.number("rachis", LENGTHS);
            read_feather(&block, rachis).map(Arrangement::Pinnate)
        }
        "palmate" => read_palmate(&block),
        _ => read_bipinnate(&block),
    };
    let usual = CompoundForm::new(Arrangement::Palmate {
        leaflets: 2,
        spread: 1.0,
        sizes: [1.0; 2],
    });
    let angle = |key, most: f64| {
        block
            .number_or(key, Limits::closed(-most, most), 0.0)
            .to_radians()
    };
    let petiole = block.number_or("petiole", Limits::closed(0.0, 100.0), usual.petiole);
    let petiolule = block.number_or("petiolule", Limits::closed(0.0, 10.0), usual.petiolule);
    let stalk_radius_mm = block.number_or("stalk_radius_mm", RADII_MM, usual.stalk_radius_mm);
    let variants = block.integer_or("variants", 1, 50, usual.variants.into()) as u32;
    let (curl, fold) = (angle("curl_deg", 355.0), angle("fold_deg", 80.0));
    let tilt = block.number_or("tilt_deg", Limits::closed(0.0, 57.0), 0.0);
    block.finish();
    let form = CompoundForm {
        arrangement: arrangement?,
        petiole,
        petiolule,
        stalk_radius_mm,
        variants,
        curl,
        fold,
        tilt: tilt.to_radians(),
    };
    Some(ReadForm { form, block })
}

fn read_palmate(block: &Block<'_>) -> Option<Arrangement> {
    let leaflets = block.integer("leaflets", 2, 100);
    let spread = block.number("spread_deg", Limits::closed(3.0, 355.0));
    let sizes = block.optional_numbers("sizes", SIZES);
    Some(Arrangement::Palmate {
        leaflets: leaflets? as u32,
        spread: spread?.to_radians(),
        sizes: sizes.unwrap_or([1.0; 2]),
    })
}

fn read_bipinnate(block: &Block<'_>) -> Option<Arrangement> {
    let stalk = block.number("stalk", LENGTHS);
    let feather = |key| {
        let inner = block.block(key, &[])?;
        let rachis = inner.number("rachis", LENGTHS);
        let feather = read_feather(&inner, rachis);
        inner.finish();
        feather
    };
    let (pinnae, leaflets) = (feather("pinnae"), feather("leaflets"));
    Some(Arrangement::Bipinnate {
        pinnae: pinnae?,
        leaflets: leaflets?,
        stalk: stalk?,
    })
}

/// The keys of two rows along a rachis.
fn read_feather(block: &Block<'_>, rachis: Option<f64>) -> Option<Feather> {
    let pairs = block.integer("pairs", 1, 200);
    let terminal = block.flag_or("terminal", true);
    let alternation = block.number_or("alternation", Limits::closed(0.0, 0.9), 0.0);
    let angles: Option<[f64; 2]> = block.numbers("angles_deg", ANGLES_DEG);
    let sizes = block.optional_numbers("sizes", SIZES);
    let turn = block.number_or("turn_deg", Limits::closed(-114.0, 114.0), 0.0);
    Some(Feather {
        pairs: pairs? as u32,
        terminal,
        rachis: rachis?,
        alternation,
        angles: angles?.map(f64::to_radians),
        sizes: sizes.unwrap_or([1.0; 3]),
        turn: turn.to_radians(),
    })
}

impl ReadForm<'_> {
    /// Reports leaflets that are in each other's way, at the key to change.
    pub(super) fn check(&self, leaflet: &LeafPlan) -> bool {
        let Err(error) = self.form.arrange(leaflet) else {
            return true;
        };
        let (key, help) = match (&error, &self.form.arrangement) {
            (CompoundError::OnStalk { .. }, _) => (
                "petiolule",
                "let leaflets stand on longer stalks, or at wider angles",
            ),
            (CompoundError::OutOfRange { .. }, Arrangement::Bipinnate { .. }) => {
                ("leaflets", "use fewer pairs, here or of pinnae")
            }
            (CompoundError::OutOfRange { .. }, _) => ("pairs", "use fewer pairs"),
            // Right before left: these two are opposite each other.
            (CompoundError::Overlap { first, second }, Arrangement::Pinnate(_))
                if first % 2 == 0 && second - first == 1 =>
            {
                (
                    "angles_deg",
                    "use wider angles, longer petiolules, or leaflets that are narrower at the base",
                )
            }
            (_, Arrangement::Pinnate(_)) => (
                "rachis",
                "use a longer rachis, or narrower or fewer leaflets",
            ),
            // All round, the last comes up to the first from the other side.
            (
                CompoundError::Overlap { first: 0, second },
                Arrangement::Palmate {
                    leaflets, spread, ..
                },
            ) if second + 1 == *leaflets as usize && *spread > std::f64::consts::PI => (
                "spread_deg",
                "use a smaller spread, longer petiolules, or narrower leaflets",
            ),
            (_, Arrangement::Palmate { .. }) => (
                "spread_deg",
                "use a wider spread, longer petiolules, or narrower or fewer leaflets",
            ),
            (_, Arrangement::Bipinnate { .. }) => (
                "pinnae",
                "use a longer rachis, of pinnae or of their leaflets, or narrower or fewer leaflets",
            ),
        };
        let error = SceneError::Impossible {
            key: key.to_owned(),
            problem: error.to_string(),
            help: help.to_owned(),
        };
        let node = self.block.node(key);
        let at = node.map_or(&self.block.at, |node| &node.at);
        self.block.cx.error(at, error);
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_in_degrees_lie_within_those_of_the_model() {
        for end in [-1.0_f64, 1.0] {
            let rows = Feather {
                pairs: 1,
                terminal: true,
                rachis: 1.0,
                alternation: 0.0,
                angles: [3.0_f64, 170.0].map(f64::to_radians),
                sizes: [1.0; 3],
                turn: (114.0 * end).to_radians(),
            };
            let palmate = |spread: f64| Arrangement::Palmate {
                leaflets: 2,
                spread: spread.to_radians(),
                sizes: [1.0; 2],
            };
            for arrangement in [Arrangement::Pinnate(rows), palmate(3.0), palmate(355.0)] {
                let form = CompoundForm {
                    curl: (355.0 * end).to_radians(),
                    fold: (80.0 * end).to_radians(),
                    tilt: 57.0_f64.to_radians(),
                    ..CompoundForm::new(arrangement)
                };
                form.validate().expect("all in range");
            }
        }
    }
}
