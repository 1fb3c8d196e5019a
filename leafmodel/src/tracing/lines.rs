//! From a graph of pixels to smooth veins with radii.

use glam::DVec2;

use super::assembly::{Vein, Veins};
use super::curves::{cut, smooth};
use super::error::TraceError;
use super::findings::{Finding, FindingKind};
use super::graph::Graph;
use super::grid::Raster;
use super::pruning::Pruning;
use super::radii::measured;
use super::settings::Settings;
use super::through::straightened;

/// Greatest distance of a smooth line from the pieces that stand for it, pixels.
pub(super) const BOUND: f64 = 0.25;

/// Least length of a piece, pixels.
const SHORTEST_PIECE: f64 = 4.0;

/// Radius below which veins are too thin to be traced for certain, pixels.
const THIN: f64 = 1.0;

/// Veins in pixels, and the length of their pieces.
pub(super) struct Lines {
    pub(super) veins: Veins,
    pub(super) segment_px: f64,
}

/// Cleans a graph and measures its veins.
pub(super) fn lines(
    graph: Graph,
    ink: &Raster,
    settings: &Settings,
    findings: &mut Vec<Finding>,
) -> Result<Lines, TraceError> {
    let mut pruning = Pruning::new(graph);
    let spurs = pruning.cut_spurs(settings.spur_radii);
    pruning.trim_ends();
    let crossings = pruning.join_near_nodes(settings.crossing_radii);
    let mut graph = pruning.finished();
    if graph.chains.is_empty() {
        return Err(TraceError::NoVeins(format!(
            "{spurs} spurs were cut off and nothing was left"
        )));
    }
    for (count, kind) in [
        (spurs, FindingKind::Spurs { count: spurs }),
        (crossings, FindingKind::Crossings { count: crossings }),
    ] {
        if count > 0 {
            findings.push(Finding {
                kind,
                place_px: None,
            });
        }
    }
    let mut degree = vec![0_u32; graph.nodes.len()];
    for end in graph.chains.iter().flat_map(|chain| chain.ends) {
        degree[end as usize] += 1;
    }
    let mut chains = std::mem::take(&mut graph.chains);
    let radii: Vec<Vec<f64>> = chains
        .iter_mut()
        .map(|chain| {
            let is_junction = chain.ends.map(|end| degree[end as usize] > 2);
            measured(chain, &graph, ink, is_junction)
        })
        .collect();
    for chain in &chains {
        // Free ends were moved to the middle of their veins.
        for (end, point) in [(0, 0), (1, chain.points.len() - 1)] {
            if degree[chain.ends[end] as usize] == 1 {
                graph.nodes[chain.ends[end] as usize].place = chain.points[point];
            }
        }
    }
    straightened(&mut chains, &radii, &mut graph);
    for chain in &mut chains {
        chain.points = smooth(&chain.points);
    }
    report_thin_veins(&chains, &radii, settings, findings);
    let segment_px = match settings.segment_mm {
        Some(segment_mm) => segment_mm / settings.mm_per_pixel,
        None => (2.0 * median_by_length(&chains, &radii)).max(SHORTEST_PIECE),
    };
    let places: Vec<DVec2> = graph.nodes.iter().map(|node| node.place).collect();
    let mut pairs: Vec<[u32; 2]> = chains.iter().map(|chain| sorted(chain.ends)).collect();
    pairs.sort_unstable();
    let list = chains
        .into_iter()
        .zip(radii)
        .map(|(chain, radii)| {
            let mut kept = cut(&chain.points, segment_px, BOUND);
            let pair = sorted(chain.ends);
            let from = pairs.partition_point(|other| *other < pair);
            let is_alone = pairs.get(from + 1) != Some(&pair);
            let wanted = match (chain.ends[0] == chain.ends[1], is_alone) {
                (true, _) => 4,
                (false, false) => 3,
                (false, true) => 2,
            };
            if kept.len() < wanted {
                let last = chain.points.len() - 1;
                let most = wanted.min(chain.points.len()) - 1;
                kept = (0..=most).map(|i| i * last / most).collect();
            }
            Vein {
                ends: chain.ends,
                points: kept.iter().map(|&i| chain.points[i]).collect(),
                radii: kept.iter().map(|&i| radii[i]).collect(),
            }
        })
        .collect();
    Ok(Lines {
        veins: Veins {
            nodes: places,
            list,
        },
        segment_px,
    })
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The radius that half of the length of all veins has at least.
fn median_by_length(chains: &[super::graph::Chain], radii: &[Vec<f64>]) -> f64 {
    let pieces = chains.iter().zip(radii).flat_map(|(chain, radii)| {
        let pairs = chain.points.windows(2).zip(radii);
        pairs.map(|(p, radius)| (*radius, p[0].distance(p[1])))
    });
    let mut pieces: Vec<(f64, f64)> = pieces.collect();
    pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = pieces.iter().map(|piece| piece.1).sum();
    let mut passed = 0.0;
    let middle = pieces.iter().find(|piece| {
        passed += piece.1;
        passed >= 0.5 * total
    });
    middle.map_or(1.0, |piece| piece.0)
}

/// Tells how much of the veins is narrower than two pixels.
fn report_thin_veins(
    chains: &[super::graph::Chain],
    radii: &[Vec<f64>],
    settings: &Settings,
    findings: &mut Vec<Finding>,
) {
    let (mut length, mut thinnest) = (0.0, (f64::INFINITY, DVec2::ZERO));
    for (chain, radii) in chains.iter().zip(radii) {
        for (pair, &radius) in chain.points.windows(2).zip(radii) {
            if radius < THIN {
                length += pair[0].distance(pair[1]);
                if radius < thinnest.0 {
                    thinnest = (radius, pair[0]);
                }
            }
        }
    }
    if length > 0.0 {
        let length_mm = length * settings.mm_per_pixel;
        findings.push(Finding::at(thinnest.1, FindingKind::Thin { length_mm }));
    }
}
