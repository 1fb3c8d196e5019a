//! Finds where edges meet without a common node, and cuts them there.

use glam::DVec2;

use super::VeinEdge;
use super::grid::EdgeGrid;
use crate::numeric::Sets;

/// Points nearer together than this share of the mean edge length are merged: far above rounding,
/// far below any grown distance.
const SLACK: f64 = 1e-9;

/// All places where edges meet without a common node.
#[derive(Debug, Default)]
pub(super) struct Contacts {
    /// Two crossing edges, and the place of the crossing on each, in (0, 1).
    crossings: Vec<(u32, u32, f64, f64)>,
    /// An edge, a node that lies on it, and its place on the edge, in (0, 1).
    touches: Vec<(u32, u32, f64)>,
    /// Two nodes at the same place.
    meetings: Vec<(u32, u32)>,
    slack: f64,
}

impl Contacts {
    pub(super) fn are_none(&self) -> bool {
        self.crossings.is_empty() && self.touches.is_empty() && self.meetings.is_empty()
    }

    /// Where pairs of edges cross.
    pub(super) fn crossings(&self, nodes: &[DVec2], edges: &[VeinEdge]) -> Vec<DVec2> {
        let place = |&(first, _, t, _): &(u32, u32, f64, f64)| {
            let edge = &edges[first as usize];
            nodes[edge.from as usize].lerp(nodes[edge.to as usize], t)
        };
        self.crossings.iter().map(place).collect()
    }

    /// Where nodes lie on edges or on other nodes.
    pub(super) fn touches(&self, nodes: &[DVec2]) -> Vec<DVec2> {
        let on_edges = self.touches.iter().map(|touch| touch.1);
        let on_nodes = self.meetings.iter().map(|meeting| meeting.1);
        on_edges
            .chain(on_nodes)
            .map(|node| nodes[node as usize])
            .collect()
    }
}

/// Compares all pairs of edges that share a cell of the grid.
pub(super) fn find(
    nodes: &[DVec2],
    edges: &[VeinEdge],
    grid: &EdgeGrid,
    mean_length: f64,
) -> Contacts {
    let mut contacts = Contacts {
        slack: SLACK * mean_length,
        ..Contacts::default()
    };
    let slack = DVec2::splat(contacts.slack);
    let mut held: Vec<Piece> = Vec::new();
    for list in grid.lists() {
        held.clear();
        for &number in list {
            let e = &edges[number as usize];
            let piece = Piece {
                number,
                nodes: [e.from, e.to],
                ends: [nodes[e.from as usize], nodes[e.to as usize]],
            };
            let (low, high) = piece.bounds();
            for other in &held {
                let (other_low, other_high) = other.bounds();
                if low.cmple(other_high + slack).all() && other_low.cmple(high + slack).all() {
                    contacts.compare(other, &piece);
                }
            }
            held.push(piece);
        }
    }
    // A pair that shares several cells was found several times.
    contacts.crossings.sort_unstable_by_key(|c| (c.0, c.1));
    contacts.crossings.dedup_by_key(|c| (c.0, c.1));
    contacts.touches.sort_unstable_by_key(|t| (t.0, t.1));
    contacts.touches.dedup_by_key(|t| (t.0, t.1));
    contacts.meetings.sort_unstable();
    contacts.meetings.dedup();
    contacts
}

#[derive(Clone, Copy)]
struct Piece {
    number: u32,
    nodes: [u32; 2],
    ends: [DVec2; 2],
}

impl Piece {
    fn bounds(&self) -> (DVec2, DVec2) {
        let [a, b] = self.ends;
        (a.min(b), a.max(b))
    }

    /// Signed distance of `p` from the edge's line, times the edge's length.
    fn side(&self, p: DVec2) -> f64 {
        (self.ends[1] - self.ends[0]).perp_dot(p - self.ends[0])
    }
}

impl Contacts {
    fn compare(&mut self, first: &Piece, second: &Piece) {
        let shared = first.nodes.iter().any(|node| second.nodes.contains(node));
        let (c, d) = (first.side(second.ends[0]), first.side(second.ends[1]));
        let (a, b) = (second.side(first.ends[0]), second.side(first.ends[1]));
        let squared = |piece: &Piece| (piece.ends[1] - piece.ends[0]).length_squared();
        let (first_squared, second_squared) = (squared(first), squared(second));
        let limit = self.slack * self.slack;
        let near = |side: f64, squared: f64| side * side <= limit * squared;
        let apart =
            |p: f64, q: f64, squared: f64| p * q > 0.0 && !near(p, squared) && !near(q, squared);
        if apart(c, d, first_squared) || apart(a, b, second_squared) {
            return;
        }
        let mut touching = false;
        for (on, on_squared, of, sides) in [
            (first, first_squared, second, [c, d]),
            (second, second_squared, first, [a, b]),
        ] {
            for (end, side) in sides.into_iter().enumerate() {
                if near(side, on_squared) && !on.nodes.contains(&of.nodes[end]) {
                    touching |= self.touch(on, on_squared, of.nodes[end], of.ends[end]);
                }
            }
        }
        if !touching && !shared && c * d < 0.0 && a * b < 0.0 {
            self.crossings
                .push((first.number, second.number, a / (a - b), c / (c - d)));
        }
    }

    /// Records a touch if `node`, which lies on the line of `on`, lies on the edge itself; returns
    /// whether it does.
    fn touch(&mut self, on: &Piece, squared: f64, node: u32, place: DVec2) -> bool {
        let limit = self.slack * self.slack;
        for (end, &other) in on.ends.iter().zip(&on.nodes) {
            if (place - end).length_squared() <= limit {
                self.meetings.push((node.min(other), node.max(other)));
                return true;
            }
        }
        let t = (place - on.ends[0]).dot(on.ends[1] - on.ends[0]) / squared;
        let inside = t > 0.0 && t < 1.0;
        if inside {
            self.touches.push((on.number, node, t));
        }
        inside
    }
}

/// Makes a node of every contact, and cuts the edges there.
pub(super) fn cut(nodes: &mut Vec<DVec2>, edges: &mut Vec<VeinEdge>, contacts: Contacts) {
    let slack = contacts.slack;
    // (edge, how far along, node)
    let mut cuts: Vec<(u32, f64, u32)> = contacts
        .touches
        .iter()
        .map(|&(edge, node, t)| (edge, t, node))
        .collect();
    let first_new = nodes.len() as u32;
    for (first, second, t, u) in contacts.crossings {
        let node = nodes.len() as u32;
        let e = &edges[first as usize];
        let (a, b) = (nodes[e.from as usize], nodes[e.to as usize]);
        nodes.push(a + (b - a) * t);
        cuts.extend([(first, t, node), (second, u, node)]);
    }
    let mut sets = Sets::new(nodes.len());
    // Marks the ends of cut edges and merged nodes.
    let mut changed = vec![false; nodes.len()];
    changed[first_new as usize..].fill(true);
    for &(edge, _, node) in &cuts {
        let e = &edges[edge as usize];
        for node in [e.from, e.to, node] {
            changed[node as usize] = true;
        }
    }
    for (p, q) in contacts.meetings {
        changed[p as usize] = true;
        changed[q as usize] = true;
        sets.join(p, q);
    }
    // Several edges through one point cross there in pairs, and if a node lies there they also
    // touch it.
    let mut new: Vec<u32> = cuts.iter().map(|cut| cut.2).collect();
    let x = |node: u32| nodes[node as usize].x;
    new.sort_unstable_by(|&p, &q| x(p).total_cmp(&x(q)).then(p.cmp(&q)));
    new.dedup();
    for (i, &p) in new.iter().enumerate() {
        for &q in &new[i + 1..] {
            let apart = nodes[q as usize] - nodes[p as usize];
            if apart.x > slack {
                break;
            }
            if apart.length_squared() <= slack * slack {
                sets.join(p, q);
            }
        }
    }
    cuts.sort_unstable_by(|p, q| p.0.cmp(&q.0).then(p.1.total_cmp(&q.1)));
    let mut cuts = cuts.into_iter().peekable();
    let mut pieces = Vec::with_capacity(edges.len() + 2 * cuts.len());
    for (number, edge) in edges.iter().enumerate() {
        let (mut tail, mut radius) = (edge.from, edge.radius_from);
        while let Some((_, t, node)) = cuts.next_if(|cut| cut.0 == number as u32) {
            let there = edge.radius_from + (edge.radius_to - edge.radius_from) * t;
            pieces.push(VeinEdge {
                from: tail,
                to: node,
                radius_from: radius,
                radius_to: there,
                ..*edge
            });
            (tail, radius) = (node, there);
        }
        pieces.push(VeinEdge {
            from: tail,
            radius_from: radius,
            ..*edge
        });
    }
    // Overlapping edges have become duplicate pieces. That can happen only at changed nodes.
    let mut pairs: Vec<(u32, u32, u32)> = Vec::new();
    for (i, piece) in pieces.iter_mut().enumerate() {
        if changed[piece.from as usize] || changed[piece.to as usize] {
            piece.from = sets.leader(piece.from);
            piece.to = sets.leader(piece.to);
            pairs.push((piece.from.min(piece.to), piece.from.max(piece.to), i as u32));
        }
    }
    pairs.sort_unstable();
    let repeated = |w: &&[(u32, u32, u32)]| (w[0].0, w[0].1) == (w[1].0, w[1].1);
    let mut gone: Vec<u32> = pairs.windows(2).filter(repeated).map(|w| w[1].2).collect();
    gone.extend(pairs.iter().filter(|p| p.0 == p.1).map(|p| p.2));
    gone.sort_unstable();
    gone.dedup();
    let mut gone = gone.into_iter().peekable();
    let mut number = 0;
    pieces.retain(|_| {
        number += 1;
        gone.next_if_eq(&(number - 1)).is_none()
    });
    *edges = pieces;
}
