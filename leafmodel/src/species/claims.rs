//! Claims of the captions of Runions et al. 2005, tested on the presets' networks.

use glam::DVec2;

use super::{find, grown_once};
use crate::leaf::{Lamina, LeafPlan};
use crate::measure::{Measures, measure};
use crate::shape::outline::Outline;
use crate::venation::network::{VeinSegment, VenationNetwork};
use crate::venation::plan::{AuxinPlan, Pattern};
use crate::venation::{Stage, VeinGrowth};

mod architecture;
mod beyond;
mod colours;
mod developed;
mod forms;
mod junctions;
mod open;
mod traits;
mod young;

/// A preset and the leaf that it grows.
struct Grown {
    /// The preset's name, if the leaf is a preset's.
    name: Option<&'static str>,
    plan: LeafPlan,
    outline: Outline,
    network: VenationNetwork,
}

impl Grown {
    fn preset(name: &str) -> Self {
        let preset = find(name).expect("a preset");
        let lamina = grown_once::lamina(name);
        Self::with(Some(preset.name), preset.plan(), lamina)
    }

    fn of(plan: LeafPlan) -> Self {
        let lamina = plan.grow_lamina().expect("a good plan");
        Self::with(None, plan, lamina)
    }

    fn with(name: Option<&'static str>, plan: LeafPlan, lamina: Lamina) -> Self {
        let Lamina {
            outline, network, ..
        } = lamina;
        Self {
            name,
            plan,
            outline,
            network,
        }
    }

    fn auxin(&self) -> &AuxinPlan {
        let auxin = self.plan.venation.auxin();
        auxin.expect("the figures' veins grow towards auxin")
    }

    /// The same leaf with other veins.
    fn with_veins(&self, veins: AuxinPlan) -> Self {
        Self::of(LeafPlan {
            venation: veins.into(),
            ..self.plan.clone()
        })
    }

    fn measures(&self) -> Measures {
        if let Some(name) = self.name {
            return grown_once::measures(name);
        }
        let exponent = self.plan.venation.murray_exponent();
        measure(&self.outline, &self.network, exponent)
    }

    fn number(&self, key: &str) -> f64 {
        self.measures().number(key).expect("the net has it")
    }

    fn length(&self) -> f64 {
        self.outline.length()
    }

    /// Pieces of veins of this order and coarser ones.
    fn major(&self, order: u8) -> Vec<VeinSegment> {
        let segments = self.network.segments();
        segments.filter(|segment| segment.order <= order).collect()
    }

    fn stages(&self, steps: &[u32]) -> Vec<Stage> {
        VeinGrowth::new(&self.outline, self.auxin(), self.plan.seed)
            .stages(steps)
            .expect("a good plan")
    }
}

/// Mean angle, in degrees, between pieces of vein and the midrib's direction, weighted by length.
fn mean_angle(segments: &[VeinSegment]) -> f64 {
    let weigh = |s: &VeinSegment| {
        let way = s.to - s.from;
        let angle = libm::atan2(way.x.abs(), way.y.abs()).to_degrees();
        (angle * way.length(), way.length())
    };
    let (sum, weight) = segments
        .iter()
        .map(weigh)
        .fold((0.0, 0.0), |(a, b), (c, d)| (a + c, b + d));
    sum / weight
}

/// By how many degrees veins of orders 1 and 2 turn, on average, from one stretch of `scale`
/// segments to the next.
fn roughness(grown: &Grown, scale: usize) -> f64 {
    let network = &grown.network;
    let at = |node: u32| network.nodes()[node as usize].position;
    let edges = network.edges();
    // The edge before this one on the same vein; edges are sorted by the node to which they lead.
    let before = |i: usize| {
        let first = edges.partition_point(|edge| edge.to < edges[i].from);
        let entering = first..edges.len();
        let mut entering = entering.take_while(|&k| edges[k].to == edges[i].from);
        entering.find(|&k| edges[k].order == edges[i].order)
    };
    let back = |i: usize| std::iter::successors(Some(i), |&i| before(i)).nth(scale - 1);
    let (mut sum, mut count) = (0.0, 0.0);
    for end in (0..edges.len()).filter(|&i| edges[i].order <= 2) {
        let start = back(end);
        let Some((start, earlier)) = start.zip(start.and_then(before).and_then(back)) else {
            continue;
        };
        let turn_at = at(edges[start].from);
        let (a, b) = (
            turn_at - at(edges[earlier].from),
            at(edges[end].to) - turn_at,
        );
        sum += libm::atan2(a.perp_dot(b).abs(), a.dot(b)).to_degrees();
        count += 1.0;
    }
    sum / count
}

#[test]
fn fig_9_a_to_e_density_rises_as_the_kill_distance_falls_and_veins_meet_at_last() {
    let leaves = ["a", "b", "c", "d", "e"].map(|x| Grown::preset(&format!("runions-9{x}")));
    let densities = leaves
        .each_ref()
        .map(|l| l.number("vein_density_mm_per_mm2"));
    assert!(
        densities.windows(2).all(|pair| pair[1] > 1.2 * pair[0]),
        "{densities:?}"
    );
    assert_eq!(leaves[0].network.loops(), 0);
    assert!(leaves[4].network.loops() > 40);
    // Orders that hold more than a veinlet or two.
    let orders = leaves.each_ref().map(|leaf| {
        let length = |order| -> f64 {
            let of = leaf.network.segments().filter(|s| s.order == order);
            of.map(|s| (s.to - s.from).length()).sum()
        };
        (1..=12).filter(|&order| length(order) > 10.0).count()
    });
    assert!(
        orders.is_sorted() && orders[4] >= orders[0] + 2,
        "{orders:?}"
    );
}

#[test]
fn fig_9_f_to_h_more_darts_make_denser_nets_and_smoother_major_veins() {
    let mut roughnesses = [0.0; 3];
    let mut densities = [0.0; 3];
    for (i, x) in ["f", "g", "h"].into_iter().enumerate() {
        for seed in 0..10 {
            let plan = find(&format!("runions-9{x}")).expect("a preset").plan();
            let leaf = Grown::of(LeafPlan { seed, ..plan });
            roughnesses[i] += roughness(&leaf, 10) / 10.0;
            densities[i] += leaf.number("vein_density_mm_per_mm2") / 10.0;
        }
    }
    assert!(densities.windows(2).all(|p| p[1] > p[0]), "{densities:?}");
    assert!(
        roughnesses.windows(2).all(|p| p[1] < p[0]),
        "{roughnesses:?}"
    );
}

#[test]
fn fig_13a_the_venation_reaches_into_the_lobe() {
    let leaf = Grown::preset("toothed");
    let length = leaf.length();
    let in_lobe = |p: DVec2| p.x > 0.34 * length;
    let veins: Vec<VeinSegment> = leaf.network.segments().filter(|s| in_lobe(s.to)).collect();
    let widest = veins.iter().map(|s| s.order).min();
    assert!(widest.is_some_and(|order| order <= 2), "order {widest:?}");
    assert!(leaf.network.loops() > 100);
    let reach = leaf
        .network
        .nodes()
        .iter()
        .map(|n| n.position.x)
        .fold(0.0, f64::max);
    let (_, high) = leaf.outline.bounds();
    assert!(reach > high.x - 0.03 * length, "{reach} of {}", high.x);
}

#[test]
fn fig_13b_tertiary_veins_run_from_the_lowest_secondaries_towards_the_margin() {
    let leaf = Grown::preset("tertiary");
    let network = &leaf.network;
    let edges = network.edges();
    let at = |node: u32| network.nodes()[node as usize].position;
    // Starts of tertiaries on secondaries in the lowest third, on the side away from the midrib.
    let outward = edges.iter().filter(|edge| {
        let (from, to) = (at(edge.from), at(edge.to));
        let first = edges.partition_point(|e| e.to < edge.from);
        let parent = edges[first..].iter().find(|e| e.to == edge.from);
        edge.order == 3
            && from.y < leaf.length() / 3.0
            && (to.x - from.x) * from.x > 0.0
            && parent.is_some_and(|parent| parent.order == 2)
    });
    assert!(outward.count() >= 12);
}

#[test]
fn fig_14_orchid_and_grass_have_parallel_veins_with_rungs_between() {
    let orchid = Grown::preset("orchid");
    let (primary, secondary): (Vec<_>, Vec<_>) =
        orchid.major(2).into_iter().partition(|s| s.order == 1);
    assert!(mean_angle(&primary) < 8.0, "{}", mean_angle(&primary));
    assert!(mean_angle(&secondary) < 25.0, "{}", mean_angle(&secondary));
    let rungs = orchid.number("tertiary_angle_deg_mean");
    assert!((60.0..120.0).contains(&rungs), "{rungs}");

    let grass = Grown::preset("grass");
    assert_eq!(grass.network.origins(), 13);
    let along = grass.major(1);
    assert!(mean_angle(&along) < 8.0, "{}", mean_angle(&along));
    // A parallel vein from every origin, over the whole length of the piece.
    let length: f64 = along.iter().map(|s| (s.to - s.from).length()).sum();
    assert!(length > 0.9 * 13.0 * grass.length(), "{length}");
    let rungs: Vec<VeinSegment> = grass.network.segments().filter(|s| s.order > 1).collect();
    assert!(mean_angle(&rungs) > 50.0, "{}", mean_angle(&rungs));
    assert!(grass.network.loops() > 100);
}

#[test]
fn fig_15_isogonic_growth_gives_a_net_and_marginal_growth_ladders() {
    let (net, ladder) = (Grown::preset("reticulate"), Grown::preset("orchid"));
    let elongation = |leaf: &Grown| leaf.number("areole_elongation_median");
    assert!(
        elongation(&net) < elongation(&ladder),
        "{} {}",
        elongation(&net),
        elongation(&ladder)
    );
    // Tertiaries of the net have no common direction; if their directions were uniform, each 15
    // degrees would hold a twelfth of them.
    let spread = |leaf: &Grown| {
        let mut bins = [0.0; 6];
        for s in leaf.network.segments().filter(|s| s.order >= 3) {
            let way = s.to - s.from;
            let angle = libm::atan2(way.x.abs(), way.y.abs()).to_degrees();
            bins[((angle / 15.0) as usize).min(5)] += way.length();
        }
        bins.iter().fold(0.0, |a: f64, &b| a.max(b)) / bins.iter().sum::<f64>()
    };
    assert!(
        spread(&net) < spread(&ladder),
        "{} {}",
        spread(&net),
        spread(&ladder)
    );
}

#[test]
fn fig_18_urquhart_changes_the_layout_but_not_the_character() {
    let key = [
        "vein_density_mm_per_mm2",
        "areoles_per_mm2",
        "areole_circularity_median",
    ];
    let mut means = [[0.0; 3]; 2];
    let mut differ = 0;
    for seed in 0..6 {
        let of = |name: &str| {
            let plan = find(name).expect("a preset").plan();
            Grown::of(LeafPlan { seed, ..plan })
        };
        let pair = [of("poplar"), of("poplar-urquhart")];
        differ += u32::from(pair[0].network.nodes().len() != pair[1].network.nodes().len());
        for (mean, leaf) in means.iter_mut().zip(&pair) {
            let measures = leaf.measures();
            for (sum, key) in mean.iter_mut().zip(key) {
                *sum += measures.number(key).expect("a net has it") / 6.0;
            }
        }
    }
    assert_eq!(differ, 6);
    // Urquhart's neighbours include all relative neighbours, so there are some more veins and
    // areoles.
    let ratio = |i: usize| means[1][i] / means[0][i];
    assert!((1.0..1.15).contains(&ratio(0)), "density {}", ratio(0));
    assert!((1.0..1.35).contains(&ratio(1)), "areoles {}", ratio(1));
    assert!((0.97..1.03).contains(&ratio(2)), "circularity {}", ratio(2));
}

#[test]
fn fig_20_veins_come_by_rising_order_while_a_narrow_leaf_grows_round() {
    let leaf = Grown::preset("developmental");
    let last = leaf.network.steps();
    let stages = leaf.stages(&[0, last]);
    let slenderness = |outline: &Outline| {
        let (low, high) = outline.bounds();
        (high.x - low.x) / outline.length()
    };
    let (young, old) = (
        slenderness(&stages[0].outline),
        slenderness(&stages[1].outline),
    );
    assert!(young < 0.5 * old && old > 0.85, "{young} {old}");
    // Mean step at which veins of an order began, over edges that start on a vein of another order.
    let edges = leaf.network.edges();
    let born = |order: u8| {
        let starts = edges.iter().filter(|edge| {
            let first = edges.partition_point(|e| e.to < edge.from);
            edge.order == order
                && edges[first..]
                    .iter()
                    .any(|e| e.to == edge.from && e.order < order)
        });
        let steps: Vec<f64> = starts
            .map(|edge| f64::from(leaf.network.nodes()[edge.to as usize].born))
            .collect();
        steps.iter().sum::<f64>() / steps.len() as f64
    };
    let births = [2, 3, 4].map(born);
    assert!(births.is_sorted(), "{births:?}");
    // A node keeps its number and its step of birth from stage to stage.
    let stages = leaf.stages(&[last / 3, last / 2]);
    let [first, second] = [&stages[0].network, &stages[1].network].map(VenationNetwork::nodes);
    assert!(first.len() < second.len());
    assert!(first.iter().zip(second).all(|(a, b)| a.born == b.born));
}

#[test]
fn fig_21_the_petal_has_fewer_areoles_than_the_leaf_for_its_veins() {
    let (petal, leaf) = (Grown::preset("trillium"), Grown::preset("orchid"));
    let per_length = |g: &Grown| g.network.loops() as f64 / g.network.nodes().len() as f64;
    assert!(petal.network.loops() > 0);
    assert!(per_length(&petal) < per_length(&leaf));
}

/// Whether a plan's veins may meet.
fn is_closed(plan: &AuxinPlan) -> bool {
    plan.pattern != Pattern::Open
}

#[test]
#[ignore = "deep: 14 s"]
fn every_preset_settles_is_sound_and_has_loops_only_if_it_is_closed() {
    // Veins of coloured leaves are those of green ones, or grow by the same numbers.
    for preset in super::PRESETS
        .iter()
        .filter(|preset| preset.name != "poplar-x10" && !preset.is_coloured())
    {
        let leaf = Grown::preset(preset.name);
        assert_eq!(leaf.network.validate(), Ok(()), "{}", preset.name);
        assert_eq!(
            leaf.network.ending(),
            crate::venation::network::Ending::Settled,
            "{}",
            preset.name
        );
        let may_meet = leaf.plan.venation.auxin().is_none_or(is_closed);
        assert!(may_meet || leaf.network.loops() == 0, "{}", preset.name);
    }
}
