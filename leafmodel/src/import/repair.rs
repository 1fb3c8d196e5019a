//! Mending what can be mended without a choice: what is there twice, and what has no length.

use super::draft::{Draft, DraftEdge};
use super::faults::{Fault, FaultKind};

/// Makes nodes at one place one, leaves out edges without length, second edges between two nodes,
/// and nodes without edges. Tells what it did.
pub(super) fn mend(draft: &mut Draft, faults: &mut Vec<Fault>) {
    let is_merged = merge(draft, faults);
    let mut short = Fault::new(FaultKind::NoLength);
    let places = &draft.places;
    draft.edges.retain(|edge| {
        let is_short = edge.ends[0] == edge.ends[1];
        if is_short {
            short.at(places[edge.ends[0] as usize]);
        }
        !is_short
    });
    single(draft, faults);
    leave_out_bare(draft, &is_merged, faults);
    faults.extend((short.count > 0).then_some(short));
}

/// Gives all nodes at one place the least of their numbers; which have lost their edges by that.
fn merge(draft: &mut Draft, faults: &mut Vec<Fault>) -> Vec<bool> {
    let places = &draft.places;
    let mut order: Vec<u32> = (0..places.len() as u32).collect();
    let at = |node: u32| places[node as usize];
    order.sort_by(|&a, &b| {
        let (p, q) = (at(a), at(b));
        p.x.total_cmp(&q.x)
            .then(p.y.total_cmp(&q.y))
            .then(a.cmp(&b))
    });
    let mut same = Fault::new(FaultKind::SamePlace);
    let mut stands_for: Vec<u32> = (0..places.len() as u32).collect();
    for pair in order.windows(2) {
        if at(pair[0]) == at(pair[1]) {
            stands_for[pair[1] as usize] = stands_for[pair[0] as usize];
            same.at(at(pair[1]));
        }
    }
    for edge in &mut draft.edges {
        edge.ends = edge.ends.map(|end| stands_for[end as usize]);
    }
    faults.extend((same.count > 0).then_some(same));
    (0..)
        .zip(&stands_for)
        .map(|(node, other): (u32, &u32)| node != *other)
        .collect()
}

/// Keeps the wider of two edges between the same nodes, of equally wide ones the first.
fn single(draft: &mut Draft, faults: &mut Vec<Fault>) {
    let width = |edge: &DraftEdge| {
        edge.radii
            .iter()
            .flatten()
            .fold(0.0, |w, r| f64::max(w, *r))
    };
    let mut order: Vec<u32> = (0..draft.edges.len() as u32).collect();
    let edges = &draft.edges;
    let key = |edge: u32| {
        let [a, b] = edges[edge as usize].ends;
        (a.min(b), a.max(b))
    };
    order.sort_by(|&a, &b| {
        let widths = width(&edges[b as usize]).total_cmp(&width(&edges[a as usize]));
        key(a).cmp(&key(b)).then(widths).then(a.cmp(&b))
    });
    let mut twice = Fault::new(FaultKind::TwiceJoined);
    let mut is_gone = vec![false; edges.len()];
    for pair in order.windows(2) {
        if key(pair[0]) == key(pair[1]) {
            is_gone[pair[1] as usize] = true;
            let [a, b] = edges[pair[1] as usize].ends;
            let [a, b] = [a, b].map(|node| draft.places[node as usize]);
            twice.at(0.5 * (a + b));
        }
    }
    let mut gone = is_gone.into_iter();
    draft.edges.retain(|_| !gone.next().unwrap_or(false));
    faults.extend((twice.count > 0).then_some(twice));
}

/// Leaves out nodes without edges and closes up the numbers. Those that were made one with another
/// are not told again.
pub(super) fn leave_out_bare(draft: &mut Draft, is_merged: &[bool], faults: &mut Vec<Fault>) {
    let mut has_edge = vec![false; draft.places.len()];
    for end in draft.edges.iter().flat_map(|edge| edge.ends) {
        has_edge[end as usize] = true;
    }
    let mut bare = Fault::new(FaultKind::Bare);
    let mut numbers = Vec::with_capacity(has_edge.len());
    let mut next = 0_u32;
    for ((has, merged), place) in has_edge.iter().zip(is_merged).zip(&draft.places) {
        numbers.push(next);
        next += u32::from(*has);
        if !has && !merged {
            bare.at(*place);
        }
    }
    keep(&mut draft.names, &has_edge);
    keep(&mut draft.places, &has_edge);
    keep(&mut draft.born, &has_edge);
    for edge in &mut draft.edges {
        edge.ends = edge.ends.map(|end| numbers[end as usize]);
    }
    faults.extend((bare.count > 0).then_some(bare));
}

/// Keeps those entries of a list that are wanted; the list may be empty.
fn keep<T>(list: &mut Vec<T>, wanted: &[bool]) {
    let mut wanted = wanted.iter();
    list.retain(|_| *wanted.next().unwrap_or(&false));
}
