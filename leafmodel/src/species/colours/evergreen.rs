//! Leaves whose colour does not come from ageing: purple, variegated, chlorotic, patterned, red
//! with betalains.

use super::super::leaf_traits::coloured::{
    AMARANTH as AMARANTH_TRAITS, BOX_ELDER, RED_MAPLE, SMOKE_TREE,
};
use super::super::{architectures, leaf_traits, specimens, trees};
use super::autumn::red_maple;
use super::contours;
use super::numbers::{angers, betacyanin, betaxanthin, one_leaf, red};
use super::{ColouredLeaf, Holding};
use crate::blade::layers::{Change, Layer, Mode};
use crate::blade::masks::{Mask, RimWidth};
use crate::compound::{Arrangement, CompoundForm, Feather};
use crate::leaf::LeafPlan;
use crate::mosaic::MosaicPlan;
use crate::mosaic::pattern::{LeafFaces, MosaicPattern};
use crate::optics::Constituent::{self, Anthocyanins, Betacyanins, Carotenoids, Chlorophyll};
use crate::optics::pigments::AnthocyaninMix;
use crate::optics::{Contents, PerConstituent};

pub(super) const COTINUS: ColouredLeaf = ColouredLeaf {
    preset: "cotinus",
    species: "Cotinus coggygria, purple-leaved, in summer",
    green: &SMOKE_TREE,
    tissues: &[
        Holding::new("blade")
            .chlorophyll(angers(30.0, [0.8, 35.0]))
            .carotenoids(angers(7.0, [5.0, 12.0]))
            .anthocyanins(red(52.0, [10.0, 60.0])),
        Holding::new("rim")
            .chlorophyll(angers(14.0, [0.8, 35.0]))
            .carotenoids(angers(4.0, [0.0, 8.0]))
            .anthocyanins(red(46.0, [10.0, 60.0])),
    ],
    age: None,
    plan: |leaf| {
        let outline = specimens::smoke_tree(contours::smoke_tree());
        let veins = trees::dense(leaf.green, architectures::smoke_tree(), 3.5);
        let mut plan = trees::leaf(leaf.green, 2, outline, veins);
        plan.tissue.lamina = leaf.of("blade");
        plan.tissue.vein_factors[Anthocyanins] = 0.75;
        // With cyanidin alone, whose band PROSPECT's column is, dark leaves are brown.
        plan.pigments.anthocyanins = AnthocyaninMix::Aglycones {
            shares: [0.0, 0.3, 0.0, 0.5, 0.2, 0.0],
            shift_nm: 4.0,
            blue_fraction: 0.0,
        };
        let rim = Mask::Margin {
            width: RimWidth::Mm(0.3),
            softness_mm: 1.4,
            wander: 0.6,
            wander_scale_mm: 6.0,
        };
        plan.layers = vec![whole("rim", rim, leaf.of("rim"))];
        plan
    },
};

pub(super) const ACER_VARIEGATED: ColouredLeaf = ColouredLeaf {
    preset: "acer-variegated",
    species: "Acer negundo 'Variegatum'",
    green: &BOX_ELDER,
    tissues: &[
        Holding::new("grey-green")
            .chlorophyll(angers(16.0, [0.8, 33.0]))
            .carotenoids(angers(4.0, [0.0, 9.0])),
        Holding::new("white")
            .structure(one_leaf(1.2, WHITE))
            .chlorophyll(one_leaf(1.6, WHITE))
            .carotenoids(one_leaf(0.04, WHITE))
            .water(one_leaf(0.0084, WHITE))
            .dry_matter(one_leaf(0.0022, WHITE)),
    ],
    age: None,
    plan: |leaf| {
        let outline = specimens::serrate(contours::box_elder());
        let mut plan = trees::leaf(
            leaf.green,
            6,
            outline,
            trees::dense(leaf.green, architectures::box_elder(), 3.6),
        );
        plan.layers = sectors(leaf, "white", [0.58, 0.37], 9.0);
        plan.map_size = 1024;
        let rows = Feather {
            pairs: 2,
            terminal: true,
            rachis: 1.25,
            alternation: 0.0,
            angles: [68.0, 58.0].map(f64::to_radians),
            sizes: [0.86, 0.92, 1.0],
            turn: 4.0_f64.to_radians(),
        };
        plan.compound = Some(CompoundForm {
            petiole: 0.7,
            petiolule: 0.09,
            stalk_radius_mm: 0.35,
            variants: 4,
            curl: 18.0_f64.to_radians(),
            fold: 10.0_f64.to_radians(),
            tilt: 8.0_f64.to_radians(),
            irregularity: 0.06,
            ..CompoundForm::new(Arrangement::Pinnate(rows))
        });
        plan
    },
};
/// Source of the white sector's contents.
const WHITE: &str = "a white sector of this cultivar (ANGERS); range ours, 20 % about it";

pub(super) const IVY: ColouredLeaf = ColouredLeaf {
    preset: "ivy-variegated",
    species: "Hedera helix with a cream margin",
    green: &leaf_traits::IVY,
    tissues: &[
        Holding::new("grey-green")
            .chlorophyll(angers(24.0, [0.8, 58.0]))
            .carotenoids(angers(6.5, [0.0, 14.0])),
        Holding::new("cream")
            .structure(one_leaf(1.9, CREAM))
            .chlorophyll(one_leaf(1.8, CREAM))
            .carotenoids(one_leaf(0.7, CREAM))
            .water(one_leaf(0.0157, CREAM))
            .dry_matter(one_leaf(0.0047, CREAM)),
    ],
    age: None,
    plan: |leaf| LeafPlan {
        layers: sectors(leaf, "cream", [0.27, 0.15], 9.0),
        ..trees::ivy()
    },
};
/// Source of the cream sector's contents.
const CREAM: &str = "a cream sector of a variegated ivy (ANGERS); range ours, 20 % about it";

pub(super) const IRON_CHLOROSIS: ColouredLeaf = ColouredLeaf {
    preset: "iron-chlorosis",
    species: "Acer rubrum on alkaline soil",
    green: &RED_MAPLE,
    tissues: &[
        Holding::new("between veins")
            .chlorophyll(angers(6.0, [0.8, 10.0]))
            .carotenoids(angers(3.0, [0.0, 5.0]))
            .water(angers(0.010, [0.0044, 0.034]))
            .dry_matter(angers(0.004, [0.0017, 0.033])),
        Holding::new("at major veins")
            .chlorophyll(angers(28.0, [15.0, 40.0]))
            .carotenoids(angers(7.3, [4.0, 10.0])),
        Holding::new("at minor veins")
            .chlorophyll(angers(17.0, [8.0, 30.0]))
            .carotenoids(angers(4.9, [3.0, 8.0])),
    ],
    age: None,
    plan: |leaf| {
        let mut plan = red_maple(leaf);
        plan.tissue.lamina = leaf.of("between veins");
        // Veins and the tissue near them stay green.
        plan.tissue.vein_factors[Chlorophyll] = 0.55;
        plan.tissue.vein_factors[Carotenoids] = 0.6;
        let near = |orders, width_mm, softness_mm| Mask::Veins {
            orders,
            width_mm,
            softness_mm,
            outside: false,
        };
        plan.layers = vec![
            pigments("minor", near([3, 4], 0.22, 0.9), leaf.of("at minor veins")),
            pigments("major", near([1, 2], 0.5, 1.9), leaf.of("at major veins")),
        ];
        plan
    },
};

pub(super) const CROTON: ColouredLeaf = ColouredLeaf {
    preset: "croton-variegated",
    species: "Codiaeum variegatum with yellow blotches",
    green: &leaf_traits::CROTON,
    tissues: &[Holding::new("yellow")
        .chlorophyll(angers(3.0, [0.8, 10.0]))
        .carotenoids(angers(10.0, [0.0, 25.3]))],
    age: None,
    plan: |leaf| {
        // Fig. 1 of the paper on clonal mosaics, Table I [binsfeld2011].
        let mut mosaic = MosaicPlan::default();
        for (kind, name) in mosaic.types.iter_mut().zip(["yellow", "green"]) {
            name.clone_into(&mut kind.name);
        }
        let mut plan = trees::croton();
        plan.mosaic = Some(MosaicPattern {
            plan: mosaic,
            contents: vec![leaf.of("yellow"), plan.tissue.lamina],
            blend_mm: 0.35,
            faces: LeafFaces::Through,
        });
        plan.tissue.vein_factors[Carotenoids] = 0.7;
        plan
    },
};

pub(super) const AMARANTH: ColouredLeaf = ColouredLeaf {
    preset: "amaranth",
    species: "Amaranthus tricolor 'Joseph's Coat', a leaf near the top",
    green: &AMARANTH_TRAITS,
    tissues: &[
        Holding::new("yellow")
            .chlorophyll(angers(3.0, [0.8, 10.0]))
            .carotenoids(angers(4.5, [0.0, 10.0]))
            .betaxanthins(betaxanthin(9.0)),
        Holding::new("red")
            .chlorophyll(angers(5.0, [0.8, 20.0]))
            .carotenoids(angers(2.5, [0.0, 10.0]))
            .betacyanins(betacyanin(20.0))
            .betaxanthins(betaxanthin(5.0)),
    ],
    age: None,
    plan: |leaf| {
        let outline = specimens::amaranth(contours::amaranth());
        let veins = trees::dense(leaf.green, architectures::amaranth(), 3.2);
        let mut plan = trees::leaf(leaf.green, 2, outline, veins);
        // From base to tip red, yellow, green; red extends farther along the veins.
        let up_to = |to, from| Mask::BaseToTip { from, to };
        let [yellow, red] = ["yellow", "red"].map(|tissue| leaf.of(tissue));
        let patches = Mask::Noise {
            scale_mm: 7.0,
            threshold: 0.25,
            softness: 0.7,
            repeat_cells: None,
        };
        let along = Mask::Veins {
            orders: [1, 2],
            width_mm: 0.4,
            softness_mm: 1.6,
            outside: false,
        };
        plan.layers = vec![
            Layer {
                share: 0.55,
                ..pigments("yellow-patches", patches, yellow)
            },
            pigments("yellow", up_to(0.5, 0.9), yellow),
            Layer {
                share: 0.4,
                ..pigments("red-veins", along, red)
            },
            pigments("red", up_to(0.12, 0.52), red),
        ];
        plan.tissue.vein_factors[Betacyanins] = 0.8;
        plan
    },
};

/// A marginal sector without chlorophyll above a sector with less of it. Their widths are in half
/// widths of the leaf.
fn sectors(leaf: &ColouredLeaf, pale: &str, [outer, inner]: [f64; 2], scale: f64) -> Vec<Layer> {
    let rim = |width, softness_mm| Mask::Margin {
        width: RimWidth::HalfWidths(width),
        softness_mm,
        wander: 1.0,
        wander_scale_mm: scale,
    };
    vec![
        pigments("grey-green", rim(outer, 0.9), leaf.of("grey-green")),
        whole(pale, rim(inner, 0.45), leaf.of(pale)),
    ]
}

/// A layer that replaces all contents.
fn whole(name: &str, mask: Mask, contents: Contents) -> Layer {
    replacing(name, mask, contents, |_| true)
}

/// A layer that replaces pigments.
fn pigments(name: &str, mask: Mask, contents: Contents) -> Layer {
    replacing(name, mask, contents, |content| !content.is_bulk())
}

fn replacing(
    name: &str,
    mask: Mask,
    contents: Contents,
    which: impl Fn(Constituent) -> bool,
) -> Layer {
    let values = PerConstituent::from_fn(|content| which(content).then_some(contents[content]));
    Layer {
        name: name.to_owned(),
        mask,
        share: 1.0,
        change: Change::Values {
            mode: Mode::Replace,
            values,
        },
    }
}
