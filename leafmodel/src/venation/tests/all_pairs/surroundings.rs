//! The oracle's queries around sources and edges: neighbours, the margin, edges to subdivide.

use glam::DVec2;

use super::{Oracle, Source};
use crate::plane::polygon;
use crate::venation::open::lot;
use crate::venation::plan::{Neighbourhood, Pattern};
use crate::venation::urquhart::SURROUNDINGS;
use crate::venation::veins::catmull_rom;

impl Oracle<'_> {
    /// `V(s)`: the nearest node, or all relative neighbours by Eq. 2.
    pub(super) fn neighbours(&self, source: &Source) -> Vec<usize> {
        let squared = |p: DVec2, q: DVec2| (p - q).length_squared();
        let s = source.place;
        let all = 0..self.nodes.len();
        match self.plan.pattern {
            Pattern::Open => {
                let key = |v: usize| {
                    let bits = squared(self.nodes[v], s).to_bits();
                    (bits, lot(self.seed, source.id, v as u32))
                };
                all.min_by_key(|&v| key(v)).into_iter().collect()
            }
            Pattern::Closed(Neighbourhood::Urquhart) => {
                let delaunay: Vec<usize> = all.filter(|&v| self.is_delaunay(v, s)).collect();
                let excludes = |u: usize, v: usize| {
                    let (u, v) = (self.nodes[u], self.nodes[v]);
                    squared(v, s) >= squared(u, s).max(squared(v, u))
                };
                let mut chosen = delaunay.clone();
                chosen.retain(|&v| delaunay.iter().all(|&u| u == v || !excludes(u, v)));
                chosen
            }
            Pattern::Closed(Neighbourhood::Relative) => all
                .filter(|&v| {
                    let at = self.nodes[v];
                    self.nodes
                        .iter()
                        .enumerate()
                        .all(|(i, &u)| i == v || squared(at, s) < squared(u, s).max(squared(at, u)))
                })
                .collect(),
            Pattern::Closed(Neighbourhood::Bipolar) => {
                let axis = source.axis;
                let nearest = |ways: &dyn Fn(DVec2) -> bool| {
                    let all = (0..self.nodes.len()).filter(|&v| ways(self.nodes[v] - s));
                    all.min_by(|&v, &u| {
                        squared(self.nodes[v], s).total_cmp(&squared(self.nodes[u], s))
                    })
                };
                let cosine = libm::cos(35.0_f64.to_radians());
                let ahead = nearest(&|way| way.dot(axis) >= cosine * way.length());
                let behind = nearest(&|way| -way.dot(axis) >= cosine * way.length());
                match (ahead, behind) {
                    (None, None) => nearest(&|_| true).into_iter().collect(),
                    (ahead, behind) => ahead.into_iter().chain(behind).collect(),
                }
            }
        }
    }

    /// Whether some part of the bisector of node `v` and a source is nearer to these two than to
    /// any other node.
    fn is_delaunay(&self, v: usize, source: DVec2) -> bool {
        let offset = self.nodes[v] - source;
        let (foot, along) = (offset * 0.5, offset.perp());
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut clip = |normal: DVec2, limit: f64| {
            let (slope, rest) = (normal.dot(along), limit - normal.dot(foot));
            if slope > 0.0 {
                high = high.min(rest / slope);
            } else if slope < 0.0 {
                low = low.max(rest / slope);
            } else if rest < 0.0 {
                high = f64::NEG_INFINITY;
            }
        };
        let (corner, other) = self.lamina.room();
        let far = SURROUNDINGS * (other - corner).max_element();
        for normal in [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y] {
            clip(normal, far);
        }
        for (u, &node) in self.nodes.iter().enumerate() {
            if u != v {
                clip(node - source, 0.5 * (node - source).length_squared());
            }
        }
        low < high
    }

    /// Whether the straight line, except its very beginning, stays on the blade.
    pub(super) fn stays(&self, from: DVec2, to: DVec2) -> bool {
        let (from, to) = (self.lamina.full_grown(from), self.lamina.full_grown(to));
        let from = from + (to - from) * 1e-6;
        let margin = self.lamina.blade.points();
        self.lamina.blade.contains(to) && !polygon::is_crossed_by(margin, from, to)
    }

    pub(super) fn subdivide(&mut self, unit: f64) {
        let longest = 1.5 * unit;
        let squared = |oracle: &Self, e: usize| {
            let [from, to] = oracle.edges[e];
            let (from, to) = (oracle.nodes[from], oracle.nodes[to]);
            let enlargement = oracle.lamina.enlargement((from + to) * 0.5);
            (to - from).length_squared() / (enlargement * enlargement)
        };
        loop {
            let edge = (0..self.edges.len())
                .filter(|&e| !self.uncut[e] && squared(self, e) > longest * longest)
                // `max_by` keeps the last of equals; in reverse order that is the oldest.
                .rev()
                .max_by(|&a, &b| squared(self, a).total_cmp(&squared(self, b)));
            let Some(edge) = edge else { return };
            let pieces = (squared(self, edge).sqrt() / longest).ceil().max(2.0) as usize;
            self.cut(edge, pieces);
        }
    }

    fn cut(&mut self, edge: usize, pieces: usize) {
        let [from, to] = self.edges[edge];
        let (p1, p2) = (self.nodes[from], self.nodes[to]);
        let other = |node: Option<usize>, mirrored: DVec2, of: DVec2| {
            node.map(|n| self.nodes[n])
                .filter(|&p| p != of)
                .unwrap_or(mirrored)
        };
        let p0 = other(self.parents[from], 2.0 * p1 - p2, p1);
        let p3 = other(self.first_children[to], 2.0 * p2 - p1, p2);
        let places = [true, false].into_iter().find_map(|curved| {
            let place = |i: usize| {
                let u = i as f64 / pieces as f64;
                let straight = p1 + (p2 - p1) * u;
                if curved {
                    catmull_rom([p0, p1, p2, p3], u)
                } else {
                    straight
                }
            };
            let places: Vec<DVec2> = (1..pieces).map(place).collect();
            let path: Vec<DVec2> = [&[p1], &places[..], &[p2]].concat();
            let stays = path.windows(2).all(|way| self.stays(way[0], way[1]));
            stays.then_some(places)
        });
        let Some(places) = places else {
            self.uncut[edge] = true;
            return;
        };
        let (mut tail, mut tail_edge) = (from, edge);
        for place in places {
            let node = self.add(place);
            self.edges[tail_edge] = [tail, node];
            if self.first_children[tail] == Some(to) {
                self.first_children[tail] = Some(node);
            }
            self.parents[node] = Some(tail);
            self.first_children[node] = Some(to);
            if self.parents[to] == Some(tail) {
                self.parents[to] = Some(node);
            }
            self.edges.push([node, to]);
            self.uncut.push(false);
            (tail, tail_edge) = (node, self.edges.len() - 1);
        }
    }
}
