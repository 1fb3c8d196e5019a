//! Which teeth, lobes and sinuses secondaries run into, and from where on their primary.

use glam::DVec2;

use super::laid::{Draft, Site};
use crate::venation::architecture::ends::{assign, tip_cost};
use crate::venation::architecture::ground::Ground;
use crate::venation::architecture::margin::{Margin, Tip};

/// Radians by which a vein to a tooth is turned as gladly as it is moved half a spacing.
const TURN: f64 = 0.14;

/// How far from its angle a vein leaves for a tooth, radians: 35°.
const MOST_TURN: f64 = 0.611;

/// What it costs that the straight way to a tooth leaves the blade.
const OFF_BLADE: f64 = 40.0;

/// A place just inside a tooth.
pub(super) fn inward(tip: DVec2, from: DVec2, length: f64) -> DVec2 {
    tip + (from - tip).normalize_or_zero() * (0.006 * length)
}

/// Gives each draft one of these tips or sinuses, and moves its start so that it reaches that at
/// about its angle, on a way that stays on the blade.
pub(super) fn run_into(
    drafts: &mut [Draft],
    targets: &[Tip],
    site: Site<'_>,
    number: usize,
    gap: f64,
    taken: &mut Vec<DVec2>,
) {
    let Site { ground, axes } = site;
    let Ground { margin, blade, .. } = ground;
    let axis = &axes[number];
    let length = blade.length();
    let free = |tip: &&Tip| {
        taken
            .iter()
            .all(|p| (*p - tip.place).length() > 0.03 * length)
    };
    let mut tips: Vec<Tip> = targets.iter().filter(free).copied().collect();
    let [Some(first), Some(last)] = [drafts.first(), drafts.last()] else {
        return;
    };
    // In the order in which the veins come.
    if first.hit.at > last.hit.at {
        tips.reverse();
    }
    let is_open = |share: f64, tip: &Tip| {
        let (place, _) = axis.at(share);
        let from = place + (tip.place - place) * 0.02;
        // The tip itself lies on the margin.
        let to = inward(tip.place, place, length);
        let mut others = axes.iter().enumerate().filter(|(i, _)| *i != number);
        !blade.is_crossed_by(from, to)
            && others.all(|(_, other)| !other.course.is_crossed_by(from, to))
    };
    // The best start for a tip, and what it costs.
    let best = |draft: &Draft, tip: &Tip| {
        let starts = (-12..=12).map(|i| draft.share + gap * 0.1 * f64::from(i));
        let cost = |share: f64| {
            let (place, ahead) = axis.at(share);
            let turned = ((tip.place - place).angle_to(ahead).abs() - draft.angle) / TURN;
            let moved = (share - draft.share) / (0.5 * gap);
            turned * turned + moved * moved
        };
        let mut ways: Vec<(f64, f64)> = starts
            .filter(|share| (0.01..0.97).contains(share))
            .map(|share| (cost(share), share))
            .collect();
        ways.sort_by(|a, b| a.0.total_cmp(&b.0));
        let turned_little = |share: f64| {
            let (place, ahead) = axis.at(share);
            ((tip.place - place).angle_to(ahead).abs() - draft.angle).abs() < MOST_TURN
        };
        let open = ways
            .iter()
            .find(|&&(_, share)| turned_little(share) && is_open(share, tip));
        open.copied().or_else(|| {
            let &(cost, share) = ways.first()?;
            Some((cost + OFF_BLADE, share))
        })
    };
    let highest = tips.iter().map(|tip| tip.height).fold(0.0, f64::max);
    // What is out of all reach is not looked at.
    let apex = margin.apex_at();
    let near = |draft: &Draft, tip: &Tip| {
        let same_half = (tip.at < apex) == (draft.hit.at < apex);
        same_half && (tip.at - draft.hit.at).abs() < 0.15
    };
    let costs: Vec<Vec<Option<(f64, f64)>>> = drafts
        .iter()
        .map(|draft| {
            let of = |tip: &Tip| best(draft, tip).filter(|_| near(draft, tip));
            tips.iter().map(of).collect()
        })
        .collect();
    let cost = |i: usize, t: usize| match costs[i][t] {
        Some((cost, _)) => tip_cost(cost.sqrt(), &tips[t], highest),
        None => 4.0 * OFF_BLADE,
    };
    let Some(chosen) = assign(drafts.len(), tips.len(), cost) else {
        return;
    };
    let mut least = 0.01;
    for (i, &t) in chosen.iter().enumerate() {
        let Some((cost, share)) = costs[i][t] else {
            continue;
        };
        drafts[i].share = share.max(least);
        least = drafts[i].share + 0.35 * gap;
        if cost < OFF_BLADE {
            drafts[i].tip = Some(tips[t].place);
            taken.push(tips[t].place);
        }
    }
}

/// Gives each draft the tooth nearest to where it would meet the margin.
pub(super) fn branch_into_teeth(drafts: &mut [Draft], margin: &Margin) {
    let tips = margin.tips();
    let highest = tips.iter().map(|tip| tip.height).fold(0.0, f64::max);
    let mut order: Vec<usize> = (0..drafts.len()).collect();
    order.sort_by(|&a, &b| drafts[a].hit.at.total_cmp(&drafts[b].hit.at));
    let wanted: Vec<f64> = order.iter().map(|&i| drafts[i].hit.at).collect();
    let spread = wanted
        .last()
        .zip(wanted.first())
        .map_or(0.0, |(b, a)| b - a);
    let spacing = (spread / wanted.len().max(2) as f64).max(0.01);
    let away = |i: usize, t: usize| (tips[t].at - wanted[i]) / spacing;
    let cost = |i: usize, t: usize| tip_cost(away(i, t), &tips[t], highest);
    for (i, t) in assign(wanted.len(), tips.len(), cost)
        .into_iter()
        .flatten()
        .enumerate()
    {
        // A tooth far from where the vein would end is another vein's.
        if away(i, t).abs() < 2.0 {
            drafts[order[i]].tip = Some(tips[t].place);
        }
    }
}
